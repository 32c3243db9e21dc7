#include "apps/scene/parameters/accuracy.hpp"

#include <algorithm>
#include <array>

namespace listric {

std::span<const AccuracyLevel> accuracy_levels() {
    static constexpr std::array<AccuracyLevel, 4> levels{
        {{"draft", 186.2, 2000.0, 1.25, 24.0, 1.0},
         {"standard", 93.1, 1000.0, 1.0, 24.0, 1.0},
         {"fine", 46.55, 500.0, 1.0, 24.0, 1.0},
         {"sandbox", 18.62, 500.0, 1.0, 24.0, 1.0}}};
    return levels;
}

const AccuracyLevel& accuracy_level(std::string_view name) {
    return *std::ranges::find(accuracy_levels(), name, &AccuracyLevel::name);
}

} // namespace listric
