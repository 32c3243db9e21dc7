#pragma once

#include "apps/measures/setting.hpp"
#include "dem/base.hpp"
#include "dem/state.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace listric::measures {

/// Where rock can be: above the detachment as it stands, between the walls.
struct RockSpace {
    dem::Chain floor;
    double left = 0.0, right = 0.0; ///< m

    RockSpace(const Setting& setting, const dem::RigidBase& base, const dem::State& state);

    /// Something that is > 0 inside, 0 on floor and walls, and linear near them, m.
    double inside(dem::Point p) const;
};

/// The section as a grid that knows which disc each of its places belongs to: power cells, each as
/// the places within it. Unlike those of dem/contacts/power_cell it has a free surface: the discs'
/// outline with every gap closed that is narrower than a mean radius: then rock has as large a
/// share of the topmost cells as of others.
struct OwnerMap {
    static constexpr std::int32_t air = -1;     ///< above the free surface
    static constexpr std::int32_t outside = -2; ///< beyond the base, or a large pore

    dem::Point corner;    ///< the first place, m
    double spacing = 0.0; ///< m
    std::size_t columns = 0, rows = 0;
    /// Row of the disc, or one of the above; left to right, upward.
    std::vector<std::int32_t> owner;

    OwnerMap(const dem::State& state, const RockSpace& room, double spacing);

    dem::Point place(std::size_t column, std::size_t row) const {
        return {corner.x + spacing * static_cast<double>(column),
                corner.y + spacing * static_cast<double>(row)};
    }
};

} // namespace listric::measures
