#include "apps/model/effects/pore_fluid_measures.hpp"

#include "apps/model/effects/pore_fluid_well.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/model/model.hpp"
#include "coupling/water_load.hpp"
#include "dem/events/energy_account.hpp"
#include "fluid/columns.hpp"
#include "fluid/pore_fluid.hpp"

#include <algorithm>
#include <cmath>

namespace listric::effects {

namespace {

using fluid::PoreFluid;
using Sums = PoreFluid::Sums;
using V = std::optional<double>;

/// Mean of a number of wet discs, by their mud; none without any.
template <class Number> V mean(const std::vector<WetDisc>& wet, Number&& number) {
    double sum = 0.0, volume = 0.0;
    for (const WetDisc& disc : wet) {
        sum += disc.volume * number(disc);
        volume += disc.volume;
    }
    return volume > 0.0 ? V(sum / volume) : V(std::nan(""));
}

/// Ratio of sums: a mean of ratios would be one of the shallowest discs.
double overpressure(const std::vector<WetDisc>& wet) {
    double pressure = 0.0, weight = 0.0;
    for (const WetDisc& disc : wet) {
        pressure += disc.volume * disc.excess_pressure;
        weight += disc.volume * disc.weight;
    }
    return weight > 0.0 ? pressure / weight : std::nan("");
}

std::optional<std::vector<NamedNumbers>> profile(const Observation& now) {
    if (!fluid_in(now))
        return std::nullopt;
    return pore_well().numbers(now, depocentre(wet_discs(now)));
}

/// Pressure over total stress in the lowest part of the depocentre's well.
V lambda_floor(const Observation& now) {
    if (!fluid_in(now))
        return std::nullopt;
    const auto points = well_at(now, depocentre(wet_discs(now)));
    return points.empty() ? std::nan("") : points.back().pressure / points.back().total;
}

/// Depth in the depocentre's well from which on the ratio is at least one half.
V top_of_overpressure(const Observation& now) {
    if (!fluid_in(now))
        return std::nullopt;
    for (const WellPoint& point : well_at(now, depocentre(wet_discs(now))))
        if (point.ratio >= 0.5)
            return point.depth;
    return std::nan("");
}

template <const char* const& name> V remembered(const Observation& now) {
    const PoreFluid* const fluid = fluid_in(now);
    return fluid ? V(fluid->remembered(name)) : std::nullopt;
}

V balance_error(const Observation& now) {
    const PoreFluid* const fluid = fluid_in(now);
    if (!fluid)
        return std::nullopt;
    const double came = fluid->remembered(Sums::came);
    const double known = fluid->remembered(Sums::surface) + fluid->remembered(Sums::vented) +
                         fluid->remembered(Sums::eroded) + fluid->remembered(Sums::left);
    return came > 0.0 ? (came - known) / came : 0.0;
}

V closure(const Observation& now) {
    const PoreFluid* const fluid = fluid_in(now);
    return fluid && fluid->loads_base() ? V(fluid->remembered(Sums::closure)) : std::nullopt;
}

V push_work(const Observation& now) {
    const auto* account = dem::find<const dem::EnergyAccount>(now.events);
    if (!account || !fluid_in(now))
        return std::nullopt;
    return account->balance(now.state, now.parts.base).push_work;
}

/// A number of the wet discs.
template <auto take> V of_discs(const Observation& now) {
    return fluid_in(now) ? take(wet_discs(now)) : std::nullopt;
}

V greatest_ratio(const std::vector<WetDisc>& wet) {
    double greatest = 0.0;
    for (const WetDisc& disc : wet)
        greatest = std::max(greatest, disc.ratio());
    return greatest;
}

V mean_ratio(const std::vector<WetDisc>& wet) { return overpressure(wet); }

V undercompaction(const std::vector<WetDisc>& wet) {
    return mean(wet, [](const WetDisc& d) { return d.porosity - d.normal_porosity; });
}

V overpressured(const std::vector<WetDisc>& wet) {
    return mean(wet, [](const WetDisc& d) { return d.ratio() >= 0.5 ? 1.0 : 0.0; });
}

/// Of porous rock; none where there is none.
V rock_overpressure(const Observation& now) {
    const std::vector<WetDisc> rock = wet_rock(now);
    return rock.empty() ? std::nullopt : V(overpressure(rock));
}

V water_in_rock(const Observation& now) {
    const std::vector<WetDisc> rock = wet_rock(now);
    double sum = 0.0;
    for (const WetDisc& disc : rock)
        sum += disc.water;
    return rock.empty() ? std::nullopt : V(sum);
}

/// Ink of every disc of the hanging wall, none on rock that no water flows through.
template <class Number> std::vector<double> inks(const Observation& now, Number&& number) {
    std::vector<double> rows(now.state.discs.rows(), 0.0);
    for (const std::vector<WetDisc>& discs : {wet_discs(now), wet_rock(now)})
        for (const WetDisc& disc : discs)
            rows[disc.row] = std::clamp(number(disc), 0.0, 1.0);
    return rows;
}

/// Velocity of water through every disc, x and y, m/s.
std::vector<double> darcy_velocities(const Observation& now) {
    std::vector<double> rows;
    if (now.state.discs.has(fluid::columns::darcy_x)) {
        const auto x = now.state.discs.get(fluid::columns::darcy_x);
        const auto y = now.state.discs.get(fluid::columns::darcy_y);
        for (std::size_t i = 0; i < x.size(); ++i)
            rows.insert(rows.end(), {x[i], y[i]});
    }
    return rows;
}

} // namespace

std::vector<Measure<Observation>> pore_fluid_measures() {
    using enum OverTime;
    return {
        {"overpressure_ratio_mean", "1", "overpressure ratio, mean",
         "excess pore pressure over the weight of grains in water: ratio of their sums over the "
         "sediment, with the stratum that is to come. 0: water at rest, 1: water carries all",
         of_discs<mean_ratio>},
        {"overpressure_ratio_max", "1", "overpressure ratio, largest",
         "excess pore pressure over the weight of grains in water, where that ratio is greatest",
         of_discs<greatest_ratio>},
        {"lambda_floor", "1", "pore pressure over weight at the basin's floor",
         "pore pressure over the weight of grains and water, on the floor of the depocentre",
         lambda_floor},
        {"top_of_overpressure_m", "m", "top of overpressure, depth",
         "depth from which on excess pressure is at least half of the grains' weight in water, at "
         "the depocentre",
         top_of_overpressure},
        {"undercompaction", "1", "undercompaction",
         "mean porosity of sediment less what its depth, with the stratum that is to come, has "
         "where water is at rest",
         of_discs<undercompaction>},
        {"overpressured_share", "1", "overpressured share of sediment",
         "share of sediment whose excess pressure is at least half of the grains' weight in water",
         of_discs<overpressured>},
        {"rock_overpressure_ratio", "1", "overpressure ratio of rock",
         "excess pore pressure over the weight of grains in water: ratio of their sums over the "
         "rock of layers that water flows through, where there are some",
         rock_overpressure},
        {"water_rock_m2", "m2", "pore water in rock",
         "pore water in rock of layers that water flows through, where there are some",
         water_in_rock},
        {"water_came_m2", "m2", "pore water that came",
         "pore water that came with sediment, or was in rock of layers that it flows through",
         remembered<Sums::came>},
        {"water_surface_m2", "m2", "pore water that left through the ground",
         "pore water that left through the ground", remembered<Sums::surface>},
        {"water_vented_m2", "m2", "pore water vented through fractures",
         "pore water that left where its pressure opens fractures", remembered<Sums::vented>},
        {"water_eroded_m2", "m2", "pore water that went with eroded sediment",
         "pore water that went with eroded sediment and rock", remembered<Sums::eroded>},
        {"water_left_m2", "m2", "pore water that is left",
         "pore water in sediment and in rock of layers that it flows through",
         remembered<Sums::left>},
        {water_error, "1", "error of the water's balance",
         "water that came less where it went, over it. Round-off", balance_error, largest,
         "below 1e-11"},
        {"lift_capped_share", "1", "sediment as good as afloat",
         "share of discs of sediment, and of rock that water flows through, whose lift was cut to "
         "0.99 of their weight",
         remembered<Sums::capped>, mean},
        {"enclosed_share", "1", "sediment without a way for its water",
         "share of discs of sediment, and of rock that water flows through, that no way of the "
         "water joins to the ground",
         remembered<Sums::enclosed>},
        {"fill", "1", "mud over the cells that hold it",
         "the volume of mud, and of rock that water flows through, over that of the cells of its "
         "discs",
         remembered<Sums::fill>},
        {fluid_closure, "1", "missing pressure on the base",
         "rest that forces of excess pressure on sediment, rock and base lack to a sum of zero, "
         "over the pressure times length on rock and base, which are given it. Where the base "
         "bends",
         closure, OverTime::last, "below 0.02 from 1 km of extension on"},
        {coupling::water_load_name, "N/m", "water's weight on the base",
         "vertical force of the water's pressure, excess pressure too, on the base beyond that at "
         "the start, downward. Where the base bends"},
        {coupling::water_force_error_name, "1", "error of the vertical forces of weights and water",
         "load that the base bears, by the discs' weights less lift and by the water's pressure, "
         "less the weight of all that is above it, over that weight. Round-off. Where the base "
         "bends",
         nullptr, largest, "below 1e-9"},
        {"newton_worst", "1", "most iterations of the pressure in a step",
         "greatest number of Newton's steps of a solution so far", remembered<Sums::newton>},
        {"pore_fluid_work_j_per_m", "J/m", "work of pore pressure",
         "work of excess pore pressure and of the stratum that is to come on the discs, over the "
         "cycles, where energy is accounted",
         push_work},
    };
}

std::vector<MeasuredObjects> pore_fluid_objects() {
    MeasuredObjects list{
        "pressure_profile",
        "",
        "pore pressure at the depocentre",
        "pore pressure and porosity at the depocentre, down from the ground: means "
        "over 1 km to either side",
        {},
        profile};
    list.parts = pore_well().parts;
    return {list};
}

std::vector<FigureLayer> pore_fluid_layers() {
    static constexpr double most = 0.3; // of undercompaction
    return {{"overpressure", LayerKind::discs, "overpressure ratio", "#b71c1c",
             [](const Observation& now) {
                 return inks(now, [](const WetDisc& d) { return d.ratio(); });
             },
             1.0, LayerArrows{"flow of water", darcy_velocities}},
            {"undercompaction", LayerKind::discs, "undercompaction", "#4a148c",
             [](const Observation& now) {
                 return inks(
                     now, [](const WetDisc& d) { return (d.porosity - d.normal_porosity) / most; });
             },
             most}};
}

} // namespace listric::effects
