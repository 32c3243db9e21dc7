#include "dem/events/bond_healing.hpp"

#include "dem/columns.hpp"
#include "dem/contacts/bond.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>

namespace listric::dem {

namespace {

/// Position and rotation at the last healing.
struct HealedColumns {
    std::span<double> x, y, rotation;
};

HealedColumns healed_columns(State& state) {
    return {state.discs.get<double>("healed_x"), state.discs.get<double>("healed_y"),
            state.discs.get<double>("healed_rotation")};
}

void remember_bonded(State& state) {
    const DiscColumns d = disc_columns(state);
    const HealedColumns h = healed_columns(state);
    std::ranges::copy(d.x, h.x.begin());
    std::ranges::copy(d.y, h.y.begin());
    std::ranges::copy(d.rotation, h.rotation.begin());
}

} // namespace

BondHealing::BondHealing(const BondHealingParameters& parameters, const BondStrength& strength,
                         const Calendar& calendar)
    : Event("bond_healing", {parameters.interval, calendar}, Stage::heal), parameters_(parameters),
      strength_(strength) {}

void BondHealing::begin(State& state) {
    state.discs.add_like<double>("healed_x", "m", columns::x);
    state.discs.add_like<double>("healed_y", "m", columns::y);
    state.discs.add_like<double>("healed_rotation", "rad", columns::rotation);
}

bool BondHealing::apply(State& state, const RigidBase&) {
    const DiscColumns d = disc_columns(state);
    const ContactColumns c = contact_columns(state);
    const HealedColumns h = healed_columns(state);
    const double strain = schedule().strain(parameters_.strain_rate, applied + 1);
    // Discs laid down at the last healing, to half a cycle, have a whole interval behind them.
    const double latest = state.clock.travel.m - 0.75 * schedule().gap(applied + 1).m;
    const std::vector<bool> touches = touching(state);
    in_pieces(c.first.size(), 4096, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k) {
            const auto i = static_cast<std::size_t>(c.first[k]),
                       j = static_cast<std::size_t>(c.second[k]);
            if (c.bonded[k] || !touches[k] ||
                !may_bond(state.materials, d.material[i], d.material[j]) ||
                std::max(d.start_travel[i], d.start_travel[j]) > latest)
                continue;
            const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
            const double old_dx = h.x[j] - h.x[i], old_dy = h.y[j] - h.y[i];
            const double distance = hypotenuse(dx, dy), old_distance = hypotenuse(old_dx, old_dy);
            // Slip at the contact: turning of the line of centres less rolling of the two discs. A
            // pair that turns as one body does not slip.
            const double turn = arc_tangent(old_dx * dy - old_dy * dx, old_dx * dx + old_dy * dy);
            const double half = 0.5 * (d.radius[i] + d.radius[j] - distance);
            const double slip = distance * turn -
                                (d.radius[i] - half) * (d.rotation[i] - h.rotation[i]) -
                                (d.radius[j] - half) * (d.rotation[j] - h.rotation[j]);
            const double opening =
                parameters_.measure == HealingMeasure::slip ? 0.0 : distance - old_distance;
            if (hypotenuse(slip, opening) < strain * (d.radius[i] + d.radius[j]))
                install_bond(state, k, strength_, state.clock.cycle);
        }
    });
    remember_bonded(state);
    return false;
}

} // namespace listric::dem
