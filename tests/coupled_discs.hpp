#pragma once

// Some 400 discs on an elastic base whose compliance is made up: no finite elements are needed to
// see how the coupling behaves.

#include "coupling/base_memory.hpp"
#include "coupling/elastic_base.hpp"
#include "dem/base/place.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/genesis/genesis.hpp"
#include "tests/gravity.hpp"
#include "tests/support.hpp"

#include <cmath>
#include <vector>

namespace listric::support {

using namespace dem;
using namespace coupling;

constexpr double radius = 1500.0, length = 4000.0; // m

inline RigidBase make_listric_base() {
    RigidBase base = listric_base(radius, length);
    base.surfaces[0].friction = 0.5;
    base.surfaces[0].follows = Follows::nodes;
    base.surfaces[1].follows = Follows::breakaway;
    return base;
}

/// A settled hanging wall of some 400 discs, made once.
inline const State& hanging_wall() {
    static const State state = [] {
        GenesisRequest request;
        request.hanging_wall.length = length;
        request.hanging_wall.thickness = radius;
        request.hanging_wall.mean_radius = 60.0;
        request.base = make_listric_base();
        request.materials = {Material{}, Material{}, Material{}};
        request.bonds = BondStrength{};
        request.physics = {0.7, gravity};
        return make_hanging_wall(request, [](std::string_view, double) {});
    }();
    return state;
}

/// Nodes every 98 m, and a base that gives way over a distance of 1 km: C = c exp(-|s - t| / 1 km)
/// in x and in y, which is positive definite.
inline Interface make_interface(double compliance) {
    const Chain chain = listric_chain(radius, 2.0 * length);
    constexpr std::size_t nodes = 61;
    constexpr double spacing = 0.5 * pi * radius / 24.0; // a face ends where the arc does
    Interface interface;
    for (std::size_t k = 0; k < nodes; ++k) {
        const Point p = point_at(chain, spacing * static_cast<double>(k));
        interface.x.push_back(p.x);
        interface.y.push_back(p.y);
    }
    interface.compliance.assign(4 * nodes * nodes, 0.0);
    for (std::size_t i = 0; i < nodes; ++i)
        for (std::size_t k = 0; k < nodes; ++k)
            for (std::size_t c = 0; c < 2; ++c)
                interface.compliance[(2 * i + c) * 2 * nodes + 2 * k + c] =
                    compliance *
                    std::exp(-spacing * std::abs(static_cast<double>(i) - static_cast<double>(k)) /
                             1e3);
    return interface;
}

/// 1e-11 m per N/m: the weight of the hanging wall, 1.4e11 N/m, would bend it by about 1 m.
constexpr double soft = 1e-11;

struct Coupled {
    RigidBase base = make_listric_base();
    CyclePhysics physics{0.7, gravity};
    State state = hanging_wall();
    ElasticBase elastic;

    explicit Coupled(double compliance, CouplingParameters p = {})
        : Coupled(make_interface(compliance), p) {}
    explicit Coupled(Interface interface, CouplingParameters p = {})
        : elastic(std::move(interface), complete(p)) {
        elastic.attach(state);
        find_contacts(state, base);
    }

    static CouplingParameters complete(CouplingParameters p) {
        p.wall_x = length;
        p.gravity = gravity;
        const std::vector<Material> discs{Material{}};
        p.contact_stiffness = node_stiffness(Material{}, discs, 100.0, 60.0);
        return p;
    }

    void settle() {
        elastic.settle(state, base, physics, {1}, [](std::string_view, double) {});
        physics.averaging_time = 50.0;
        add_mean_velocities(state);
    }
    void go(std::int64_t cycles, const Execution& execution = {}) {
        advance(state, base, physics, cycles, execution, &elastic);
    }
    double greatest_displacement() const { return greatest_node_displacement(base_place(state)); }
};

/// A base that was settled on, so that tests need not wait for it again.
inline Coupled settled(Interface interface, CouplingParameters p = {}) {
    static const State state = [] {
        Coupled first(soft);
        first.settle();
        return first.state;
    }();
    Coupled coupled(std::move(interface), p);
    coupled.state = state;
    // All modes are kept: memory is as large as their number.
    add_mode_columns(coupled.state, coupled.elastic.modes().count());
    coupled.physics.averaging_time = 50.0;
    return coupled;
}
inline Coupled settled(double compliance, CouplingParameters p = {}) {
    return settled(make_interface(compliance), p);
}

/// Length of the interface, m, and restoring stress of mantle below, Pa/m.
constexpr double afloat = 6e3, mantle = 3300.0 * gravity;

/// An elastic base that also floats, as one: its compliance over that of rock as stiff as the
/// discs' (50 GPa: 2e-11 m per N/m over a kilometre), and its springs over the mantle's.
inline Interface floating(double softness, double winkler) {
    Interface interface = make_interface(2e-11 * softness);
    const std::size_t n = interface.unknowns();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = i % 2; k < n; k += 2)
            interface.compliance[i * n + k] += 1.0 / (mantle * winkler * afloat);
    return interface;
}

/// Takes from the reference load what moves the base by about a metre: strains stay small.
inline void unload(Coupled& coupled) {
    const auto load = coupled.state.base_nodes.get<double>("reference_load_y");
    std::vector<double> forces(2 * load.size(), 0.0);
    for (std::size_t k = 0; k < load.size(); ++k)
        forces[2 * k + 1] = load[k];
    double moves = 0.0;
    for (const double u : coupled.elastic.displacement(forces))
        moves = std::max(moves, std::abs(u));
    for (double& f : load)
        f *= 1.0 - std::min(0.1, 1.0 / moves);
}

} // namespace listric::support
