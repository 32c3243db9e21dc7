#include "apps/measures/of_effects.hpp"

#include "apps/measures/polyline.hpp"
#include "dem/contacts.hpp"
#include "dem/events/property_update.hpp"
#include "dem/genesis.hpp"
#include "dem/power_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace listric::measures {

using namespace dem;

namespace {

constexpr double porosity_tolerance = 0.02; ///< from which on porosity is off, relative

/// Share of the touching pairs of discs of different strata, one above the other within 45 degrees,
/// whose younger disc is on top. None if there are no such pairs.
std::optional<double> superposition(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const std::vector<bool> touches = touching(state);
    double all = 0.0, right = 0.0;
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]);
        const auto j = static_cast<std::size_t>(c.second[k]);
        const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
        if (!touches[k] || d.stratum[i] == d.stratum[j] || std::abs(dx) > std::abs(dy))
            continue;
        all += 1.0;
        right += (d.stratum[j] > d.stratum[i]) == (dy > 0.0);
    }
    return all > 0.0 ? std::optional(right / all) : std::nullopt;
}

} // namespace

double weak_fraction(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    return static_cast<double>(std::ranges::count(d.material, weak)) /
           static_cast<double>(d.x.size());
}

double volume_error_fraction(const State& state, const RigidBase& base, const Setting& setting) {
    HangingWallParameters wall;
    wall.length = setting.length;
    wall.thickness = setting.thickness;
    return std::abs(weakened_volume_change(state, base)) /
           hanging_wall_area(wall, base.surfaces.front().chain);
}

NamedNumbers weak_shares(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<double> rock = rock_radii(state);
    double area[2] = {}, weak_area[2] = {}; // basement, sediment
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const std::size_t kind = d.stratum[i] == 0 ? 0 : 1;
        area[kind] += rock[i] * rock[i];
        weak_area[kind] += d.material[i] == weak ? rock[i] * rock[i] : 0.0;
    }
    NamedNumbers shares;
    add(shares, "basement_weak_fraction", weak_area[0] / area[0]);
    add(shares, "sediment_weak_fraction", weak_area[1] / area[1]); // not finite without sediment
    return shares;
}

std::optional<double> weak_off_faults(const State& state, std::span<const Fault> faults,
                                      double distance) {
    const ConstDiscColumns d = disc_columns(state);
    double all = 0.0, off = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] == 0)
            continue;
        const double area = d.radius[i] * d.radius[i];
        all += area;
        if (d.material[i] == weak && std::ranges::none_of(faults, [&](const Fault& f) {
                return std::abs(place_on(f.trace.points, {d.x[i], d.y[i]}).distance) <= distance;
            }))
            off += area;
    }
    return all > 0.0 ? std::optional(off / all) : std::nullopt;
}

double deposited_fraction(const Ledger& ledger) { return ledger.deposited / ledger.initial; }
double eroded_fraction(const Ledger& ledger) { return ledger.removed / ledger.initial; }

NamedNumbers measure_layering(const State& state, const TargetLine& surface) {
    const ConstDiscColumns d = disc_columns(state);
    NamedNumbers numbers;
    add(numbers, "superposition_fraction", superposition(state));
    double above = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        above += surface.above({d.x[i], d.y[i]}) > d.radius[i];
    add(numbers, "discs_above_target", above);
    return numbers;
}

NamedNumbers measure_porosity(const State& state, const TargetLine& surface,
                              double surface_porosity, double porosity_decay) {
    const ConstDiscColumns d = disc_columns(state);
    const auto porosity = state.discs.get<double>("porosity");
    double all = 0.0, error = 0.0, beyond = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] == 0)
            continue;
        const double depth = std::max(0.0, surface.height(d.x[i]) - d.y[i]);
        const double expected = surface_porosity * std::exp(-porosity_decay * depth);
        const double off = std::abs(porosity[i] / expected - 1.0);
        all += d.mass[i];
        error += d.mass[i] * off;
        beyond += off > porosity_tolerance ? d.mass[i] : 0.0;
    }
    NamedNumbers numbers; // not finite without sediment
    add(numbers, "porosity_error", error / all);
    add(numbers, "porosity_off_fraction", beyond / all);
    return numbers;
}

std::optional<EnergyBalance> energy_balance(const State& state, const RigidBase& base,
                                            std::span<const std::unique_ptr<Event>> events) {
    const auto* account = find<EnergyAccount>(events);
    return account ? std::optional(account->balance(state, base)) : std::nullopt;
}

NamedNumbers energy_numbers(const EnergyBalance& e) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const double work = e.boundary_work + e.gravity_work;
    return {{"energy_boundary_work_j_per_m", e.boundary_work},
            {"energy_gravity_work_j_per_m", e.gravity_work},
            {"energy_events_j_per_m", e.events},
            {"energy_kinetic_j_per_m", e.stored.kinetic},
            {"energy_strain_normal_j_per_m", e.stored.normal_strain},
            {"energy_strain_shear_j_per_m", e.stored.shear_strain},
            {"energy_stored_change_j_per_m", e.stored_change},
            {"energy_friction_j_per_m", e.friction},
            {"energy_damping_j_per_m", e.damping},
            {"energy_bond_breaking_j_per_m", e.bond_breaking},
            {"energy_stepping_j_per_m", e.stepping},
            {"energy_base_work_j_per_m", e.base_work.value_or(nan)},
            {"energy_residual", work != 0.0 ? e.residual() / work : nan}};
}

NamedNumbers measure_effects(const Setting& setting, const State& state) {
    NamedNumbers numbers;
    if (setting.detection_circle)
        append(numbers, weak_shares(state));
    if (!setting.sediment)
        return numbers;
    const Sediment& sediment = *setting.sediment;
    const TargetLine surface = sediment.target.at(state.clock.extension / setting.extension_rate);
    if (sediment.porosity_decay)
        append(numbers, measure_porosity(state, surface, sediment.surface_porosity,
                                         *sediment.porosity_decay));
    append(numbers, measure_layering(state, surface));
    return numbers;
}

} // namespace listric::measures
