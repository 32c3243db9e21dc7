#pragma once

// A packing of unequal discs that genesis settles in a box.

#include "dem/genesis/genesis.hpp"
#include "tests/support.hpp"

namespace listric::support {

using namespace dem;

inline GenesisRequest packing_request(double length, double depth, double mean_radius) {
    constexpr double high = 1e5;
    GenesisRequest r;
    r.hanging_wall.length = length;
    r.hanging_wall.thickness = depth;
    r.hanging_wall.mean_radius = mean_radius;
    r.base.surfaces = {{"floor", {line({0.0, -depth}, {length, -depth})}},
                       {"left", {line({0.0, high}, {0.0, -depth})}},
                       {"right", {line({length, -depth}, {length, high})}}};
    r.materials = {Material{}, Material{}, Material{}};
    r.physics = {0.7, 9.81};
    return r;
}

inline State settled(const GenesisRequest& request) {
    return make_hanging_wall(request, [](std::string_view, double) {});
}

} // namespace listric::support
