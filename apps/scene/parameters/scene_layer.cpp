#include "apps/scene/parameters/scene_layer.hpp"

#include "dem/base/target_line.hpp"

#include <algorithm>
#include <set>

namespace listric {

std::vector<double> SceneLayer::bends() const {
    std::set<double> places;
    for (const auto* line : {&top_line, &bottom_line})
        for (const dem::Point& p : *line)
            places.insert(p.x);
    return {places.begin(), places.end()};
}

double SceneLayer::top_at(double x) const {
    return top_line.empty() ? top.value_or(0.0) : dem::TargetLine(top_line).height(x);
}

double SceneLayer::bottom_at(double x) const {
    if (thickness)
        return top_at(x) + *thickness;
    return bottom_line.empty() ? bottom.value_or(0.0) : dem::TargetLine(bottom_line).height(x);
}

} // namespace listric
