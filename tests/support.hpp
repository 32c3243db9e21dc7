#pragma once

// Small states and bases that tests start from.

#include "dem/base.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/numbers/random.hpp"
#include "dem/numbers/units.hpp"
#include "dem/state.hpp"

#include <cmath>
#include <numeric>
#include <string_view>
#include <vector>

namespace listric::support {

using namespace dem;

inline constexpr double density = 2600.0; ///< of every disc, kg/m^3

struct Disc {
    double x, y, radius; ///< m
};

/// Uniform numbers in a row, the same in every run.
class Random {
public:
    explicit Random(std::uint64_t seed) : seed_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * uniform(seed_, Purpose::packing_place, drawn_++);
    }

private:
    std::uint64_t seed_, drawn_ = 0;
};

/// A state at rest; contacts are not searched yet.
inline State make_state(const std::vector<Disc>& discs, const Material& material = {}) {
    State state = empty_state();
    const Material soft{material.normal_stiffness / 200.0, material.shear_stiffness / 200.0, 0.0,
                        false};
    state.materials = {material, material, soft};
    add_discs(state, discs.size());
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < discs.size(); ++i) {
        d.x[i] = d.start_x[i] = discs[i].x;
        d.y[i] = d.start_y[i] = discs[i].y;
        d.radius[i] = discs[i].radius;
        d.mass[i] = density * pi * discs[i].radius * discs[i].radius;
        state.ledger.initial += d.mass[i];
        state.mean_radius += discs[i].radius / static_cast<double>(discs.size());
    }
    state.skin = 0.25 * state.mean_radius;
    return state;
}

/// Discs side by side that just touch, the first at the origin.
inline std::vector<Disc> row(std::size_t count, double radius) {
    std::vector<Disc> discs;
    for (std::size_t k = 0; k < count; ++k)
        discs.push_back({2.0 * radius * static_cast<double>(k), 0.0, radius});
    return discs;
}

/// Close-packed rows along x, the first disc at the origin.
inline std::vector<Disc> hexagonal(std::size_t columns, std::size_t rows, double radius) {
    std::vector<Disc> discs;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c)
            discs.push_back({radius * static_cast<double>(2 * c + r % 2),
                             radius * std::sqrt(3.0) * static_cast<double>(r), radius});
    return discs;
}

/// A close-packed lattice with its places and radii disturbed by up to a fifth.
inline std::vector<Disc> cloud(std::size_t columns, std::size_t rows, double radius,
                               std::uint64_t seed) {
    Random random(seed);
    std::vector<Disc> discs = hexagonal(columns, rows, radius);
    for (Disc& disc : discs) {
        disc.x += radius * random.between(-0.2, 0.2);
        disc.y += radius * random.between(-0.2, 0.2);
        disc.radius *= random.between(0.8, 1.2);
    }
    return discs;
}

inline void bond(State& state, std::size_t k, float tensile, float shear) {
    const ContactColumns c = contact_columns(state);
    c.bonded[k] = 1;
    c.tensile_strength[k] = tensile;
    c.shear_strength[k] = shear;
}

/// Searches contacts and bonds every pair whose gap is below a thousandth of the mean radius.
inline void bond_all(State& state, const RigidBase& base, float strength = 1e30f) {
    find_contacts(state, base);
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    const ConstContactColumns c = contact_columns(std::as_const(state));
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]);
        const auto j = static_cast<std::size_t>(c.second[k]);
        if (std::hypot(d.x[j] - d.x[i], d.y[j] - d.y[i]) <
            d.radius[i] + d.radius[j] + 1e-3 * state.mean_radius)
            bond(state, k, strength, strength);
    }
}

/// Floor along y = 0 and two walls, which go on beyond the corners so that outside is outside.
inline RigidBase box(double width, double height, double friction = 0.0) {
    RigidBase base;
    base.surfaces = {{"left", {line({0.0, height}, {0.0, -height})}, friction},
                     {"floor", {line({-width, 0.0}, {2.0 * width, 0.0})}, friction},
                     {"right", {line({width, -height}, {width, height})}, friction}};
    return base;
}

/// Quarter circle from the vertical breakaway at the origin, then a flat.
inline Chain listric_chain(double radius, double flat) {
    Chain chain{arc({0.0, 0.0}, {0.0, -1.0}, radius, 0.5 * pi)};
    chain.push_back(line({radius, -radius}, {radius + flat, -radius}));
    return chain;
}

/// LIS1's detachment, backstop and right wall.
inline RigidBase listric_base(double radius, double length) {
    constexpr double high = 1e5;
    RigidBase base;
    base.surfaces = {{"detachment", listric_chain(radius, 2.0 * length), 0.0, 1.0, {}},
                     {"backstop", {line({0.0, high}, {0.0, 0.0})}, 0.0},
                     {"right wall", {line({length, -high}, {length, high})}, 0.0, 0.0, {1.0, 0.0}}};
    return base;
}

/// Stiffness of the contact of two discs of one material: two springs in series.
inline double contact_stiffness(const Material& m) { return 0.5 * m.normal_stiffness; }

/// Row of the contact of two discs given by their ids; the table's size if there is none.
inline std::size_t find_pair(const State& state, std::int64_t a, std::int64_t b) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    std::size_t k = 0;
    for (; k < c.first.size(); ++k) {
        const std::int64_t p = d.id[static_cast<std::size_t>(c.first[k])];
        const std::int64_t q = d.id[static_cast<std::size_t>(c.second[k])];
        if ((p == a && q == b) || (p == b && q == a))
            break;
    }
    return k;
}

} // namespace listric::support
