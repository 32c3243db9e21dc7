#include "apps/measures/strata/rock.hpp"

#include "apps/measures/polyline.hpp"
#include "apps/measures/strata/rock_layers.hpp"
#include "dem/base/ground_level.hpp"
#include "dem/base/just_before.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>

namespace listric::measures {

using namespace dem;

namespace {

constexpr Quantity basement_weak{"basement_weak_fraction", "1", "weakened share of pre-rift rock",
                                 "share of the pre-rift rock, by area, that is weakened"};
constexpr Quantity sediment_weak{"sediment_weak_fraction", "1", "weakened share of sediment",
                                 "share of the sediment, by area, that is weakened"};
constexpr Quantity porosity_error{
    "porosity_error", "1", "error of porosity",
    "mean of abs(porosity / Phi(depth) - 1) over the sediment's mass, porosity by mass and radius "
    "of a disc, depth below the surface of the discs, without discs laid down in the last 100 m, "
    "which still compact and count for no burial yet"};
constexpr Quantity porosity_off{"porosity_off_fraction", "1", "sediment with a wrong porosity",
                                "share of the sediment's mass whose porosity is more than 2 % off: "
                                "sediment that has risen keeps its porosity"};
constexpr Quantity superposition_share{
    "superposition_fraction", "1", "sediment in the order of its age",
    "share of touching pairs of sediment discs of different strata, one within 45 degrees above "
    "the other, whose upper disc is the younger"};
constexpr Quantity above_target{
    "discs_above_target", "1", "discs above the target line",
    "discs that lie wholly above the line that the surface is adapted to"};
constexpr Quantity shear_in_layers{
    "bedding_shear_in_layers", "1", "shear along the bedding in layers",
    "mean shear along the bedding since the start in layers of rock, up to 3: tangent of the angle "
    "by which a line across the bedding has turned against it, from the deformation gradient "
    "within "
    "1.5 mean diameters"};
constexpr Quantity shear_between{
    "bedding_shear_between_layers", "1", "shear along the bedding between layers",
    "`bedding_shear_in_layers` in rock of no layer between the highest and the lowest one"};

/// A layer compacts, and what is below it, in this travel after it was laid down, m: in four
/// looks of Compaction (its `approach`). Until then it is left out, as it counts for no burial yet.
constexpr double settling = 100.0;
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

std::vector<std::uint32_t> rocks(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::uint32_t> rocks;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        rocks.push_back((d.stratum[i] > 0 ? 2u : 0u) +
                        (is_weak(state.materials, d.material[i]) ? 1u : 0u));
    return rocks;
}

NamedNumbers weak_shares(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<double> rock = rock_radii(state);
    double area[2] = {}, weak_area[2] = {}; // basement, sediment
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const std::size_t kind = d.stratum[i] == 0 ? 0 : 1;
        area[kind] += rock[i] * rock[i];
        weak_area[kind] += is_weak(state.materials, d.material[i]) ? rock[i] * rock[i] : 0.0;
    }
    NamedNumbers shares;
    add(shares, basement_weak, weak_area[0] / area[0]);
    add(shares, sediment_weak, weak_area[1] / area[1]); // not finite without sediment
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
        if (is_weak(state.materials, d.material[i]) &&
            std::ranges::none_of(faults, [&](const Fault& f) {
                return std::abs(place_on(f.trace.points, {d.x[i], d.y[i]}).distance) <= distance;
            }))
            off += area;
    }
    return all > 0.0 ? std::optional(off / all) : std::nullopt;
}

NamedNumbers measure_layering(const State& state, const TargetLine& surface) {
    const ConstDiscColumns d = disc_columns(state);
    NamedNumbers numbers;
    add(numbers, superposition_share, superposition(state));
    double above = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        above += surface.above({d.x[i], d.y[i]}) > d.radius[i];
    add(numbers, above_target, above);
    return numbers;
}

NamedNumbers measure_porosity(const State& state, const Sediment& sediment, double settled) {
    const ConstDiscColumns d = disc_columns(state);
    const GroundLevel ground(state, settled);
    const bool weakens = state.discs.has(dem::columns::rock_radius);
    const auto rock_radius =
        weakens ? state.discs.get(dem::columns::rock_radius) : std::span<const double>();
    double all = 0.0, error = 0.0, beyond = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] == 0 || state.clock.travel.m - d.start_travel[i] < settled)
            continue;
        const double radius = weakens && rock_radius[i] > 0.0 ? rock_radius[i] : d.radius[i];
        const double grains = (1.0 - sediment.surface_porosity) * d.mass[i] /
                              (sediment.disc_density * pi * radius * radius);
        const double depth = std::max(0.0, ground.depth({d.x[i], d.y[i]}));
        const dem::PorosityLaw law = sediment.pores_of(d.stratum[i]);
        const double expected = law.surface_porosity * dem::exponential(-law.coefficient * depth);
        const double off = std::abs((1.0 - grains) / expected - 1.0);
        all += d.mass[i];
        error += d.mass[i] * off;
        beyond += off > porosity_tolerance ? d.mass[i] : 0.0;
    }
    NamedNumbers numbers; // not finite without sediment
    add(numbers, porosity_error, error / all);
    add(numbers, porosity_off, beyond / all);
    return numbers;
}

NamedNumbers measure_rock(const Setting& setting, const State& state) {
    NamedNumbers numbers;
    if (setting.detection_circle)
        append(numbers, weak_shares(state));
    if (const auto shear = bedding_shear(state)) {
        add(numbers, shear_in_layers, shear->in_layers);
        add(numbers, shear_between, shear->between);
    }
    if (!setting.sediment)
        return numbers;
    const Sediment& sediment = *setting.sediment;
    const TargetLine surface = sediment.target.at(setting.calendar.age(state.clock.travel));
    if (sediment.porosity_decay)
        append(numbers,
               measure_porosity(state, sediment,
                                settling - travel_of_cycle(setting.motion, state.clock).m));
    append(numbers, measure_layering(state, surface));
    return numbers;
}

std::span<const Quantity> rock_quantities() {
    static constexpr Quantity all[] = {basement_weak,   sediment_weak,       porosity_error,
                                       porosity_off,    superposition_share, above_target,
                                       shear_in_layers, shear_between};
    return all;
}

} // namespace listric::measures
