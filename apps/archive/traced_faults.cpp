#include "apps/archive/traced_faults.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

namespace listric::archive {

using namespace measures;

std::string to_json(std::span<const TracedFault> faults) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const TracedFault& f : faults) {
        const dem::Point top = f.trace.points.front(), bottom = f.trace.points.back();
        nlohmann::ordered_json points = nlohmann::ordered_json::array();
        for (const dem::Point p : f.trace.points)
            points.push_back({p.x, -p.y});
        list.push_back({{"x_top_m", top.x},
                        {"z_top_m", -top.y},
                        {"x_bottom_m", bottom.x},
                        {"z_bottom_m", -bottom.y},
                        {"length_m", f.trace.length()},
                        {"dip_deg", f.dip},
                        {"sense", f.normal ? "normal" : "reverse"},
                        {"slip_m", f.slip},
                        {"throw_m", f.throw_down},
                        {"width_diameters", f.width},
                        {"points_m", std::move(points)}});
    }
    return list.dump(2) + "\n";
}

} // namespace listric::archive
