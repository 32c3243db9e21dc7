#include "dem/base/place.hpp"

#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/order_free.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace listric::dem {

namespace {

template <class Distance> double greatest(std::size_t count, Distance&& distance) {
    double most = 0.0;
    for (std::size_t k = 0; k < count; ++k)
        most = greater(most, distance(k));
    return most;
}

} // namespace

BasePlace base_place(const State& state) {
    const ConstBaseNodeColumns n = base_node_columns(state);
    return {state.clock.extension.m, n.x, n.y, n.ux, n.uy};
}

BasePlace searched_base_place(const State& state) {
    const ConstBaseNodeColumns n = base_node_columns(state);
    return {state.searched_extension, n.x, n.y, n.searched_ux, n.searched_uy};
}

std::optional<Foot> nearest(const Surface& surface, const BasePlace& place, Point p) {
    if (!place.deforms(surface))
        return nearest(surface, place.extension, p);
    if (surface.follows == Follows::breakaway)
        return nearest(surface, place.extension, {p.x - place.ux[0], p.y - place.uy[0]});
    const auto point = place.trace(surface).nearest(p);
    return point ? std::optional(point->foot) : std::nullopt;
}

bool is_near_end(const Surface& surface, const BasePlace& place, Point p, double distance) {
    const auto is_near = [&](Point end) {
        const double dx = p.x - end.x, dy = p.y - end.y;
        return dx * dx + dy * dy < 1.001 * distance * distance && // nearly always not, and quick
               hypotenuse(dx, dy) <= distance;
    };
    if (place.deforms(surface) && surface.follows == Follows::nodes) {
        const Trace trace = place.trace(surface);
        return is_near(trace.node(0)) || is_near(trace.node(place.x.size() - 1));
    }
    const Point moved = place.deforms(surface) ? Point{place.ux[0], place.uy[0]}
                                               : Point{surface.translation.x * place.extension,
                                                       surface.translation.y * place.extension};
    p = p - moved;
    return is_near(surface.chain.front().start) || is_near(surface.chain.back().end);
}

RigidBase standing_base(const RigidBase& base, const State& state) {
    RigidBase standing = base;
    const BasePlace place = base_place(state);
    for (Surface& surface : standing.surfaces) {
        if (!place.deforms(surface))
            continue;
        if (surface.follows == Follows::breakaway) {
            surface.chain = moved(surface.chain, {place.ux[0], place.uy[0]});
        } else {
            const Trace trace = place.trace(surface);
            surface.chain.clear();
            for (std::size_t k = 0; k < 2 * trace.faces(); ++k)
                surface.chain.push_back(line(trace.at(0.5 * static_cast<double>(k)),
                                             trace.at(0.5 * static_cast<double>(k + 1))));
        }
        surface.follows = Follows::nothing;
    }
    join_blocks(standing, place.extension);
    return standing;
}

double height_at(const ConstBaseNodeColumns& nodes, double x) {
    assert(nodes.x.size() > 1);
    std::size_t k = 1;
    while (k + 1 < nodes.x.size() && nodes.x[k] + nodes.ux[k] < x)
        ++k;
    const double x0 = nodes.x[k - 1] + nodes.ux[k - 1], x1 = nodes.x[k] + nodes.ux[k];
    const double y0 = nodes.y[k - 1] + nodes.uy[k - 1], y1 = nodes.y[k] + nodes.uy[k];
    return y0 + (y1 - y0) * std::clamp((x - x0) / (x1 - x0), 0.0, 1.0);
}

double greatest_node_displacement(const BasePlace& place) {
    return greatest(place.x.size(),
                    [&](std::size_t k) { return hypotenuse(place.ux[k], place.uy[k]); });
}

double greatest_node_travel(const State& state) {
    const ConstBaseNodeColumns n = base_node_columns(state);
    return greatest(n.x.size(), [&](std::size_t k) {
        return hypotenuse(n.ux[k] - n.searched_ux[k], n.uy[k] - n.searched_uy[k]);
    });
}

double move_nodes(const BaseNodeColumns& n, double time_step) {
    double fastest = 0.0;
    for (std::size_t k = 0; k < n.x.size(); ++k) {
        n.ux[k] += n.vx[k] * time_step;
        n.uy[k] += n.vy[k] * time_step;
        fastest = greater(fastest, greater(std::abs(n.vx[k]), std::abs(n.vy[k])));
    }
    return fastest;
}

} // namespace listric::dem
