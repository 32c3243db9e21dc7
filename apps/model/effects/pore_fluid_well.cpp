#include "apps/model/effects/pore_fluid_well.hpp"

#include "apps/model/measured_well.hpp"
#include "apps/model/model.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/grain_columns.hpp"
#include "fluid/columns.hpp"

#include <algorithm>
#include <cmath>

namespace listric::effects {

using fluid::PoreFluid;

const PoreFluid* fluid_in(const Observation& now) { return dem::find<const PoreFluid>(now.events); }

namespace {

enum class Wet { sediment, rock };

/// What is between grains of a disc, and what would be if water were at rest.
void add_pores(const PoreFluid& fluid, const dem::State& state, double porosity, WetDisc& disc) {
    const dem::ConstDiscColumns d = dem::disc_columns(state);
    const std::size_t i = disc.row;
    const double solid = d.mass[i] / fluid.sediment().grain_density;
    if (d.stratum[i] == 0) {
        const fluid::PorousRock& rock =
            *fluid.sediment().rock_of(state.discs.get(dem::columns::layer)[i]);
        const double load =
            disc.weight - fluid.grain_weight() * state.discs.get(fluid::columns::start_grains)[i];
        disc.volume = solid;
        disc.porosity = fluid::rock_pores(rock, load, disc.excess_pressure).value;
        disc.normal_porosity = fluid::rock_pores(rock, load, 0.0).value;
        disc.permeability = fluid::permeability(rock.flow.permeability, disc.porosity);
        return;
    }
    disc.volume = solid / (1.0 - porosity);
    disc.porosity = porosity;
    const fluid::PoreLaw& law = fluid.law(d.stratum[i]);
    disc.normal_porosity =
        fluid::porosity_at(law, fluid.sediment().beds.empty()
                                    ? disc.depth
                                    : fluid::equivalent_depth(law, disc.weight / law.grain_weight));
    disc.permeability = fluid::permeability(fluid.flow_of(d.stratum[i]).permeability, porosity);
}

std::vector<WetDisc> discs_of(const Observation& now, Wet which) {
    std::vector<WetDisc> wet;
    const PoreFluid* const fluid = fluid_in(now);
    if (!fluid)
        return wet;
    const dem::State& state = now.state;
    const dem::ConstDiscColumns d = dem::disc_columns(state);
    const auto porosity = state.discs.get(dem::columns::porosity);
    const auto pressure = state.discs.get(dem::columns::excess_pressure);
    const auto ratio = state.discs.get(fluid::columns::overpressure_ratio);
    const auto water = state.discs.get(fluid::columns::pore_water);
    const std::vector<double> grains = dem::grains_above(state, porosity);
    const fluid::WetGround ground(state, now.parts.base.motion, fluid->sediment());
    const dem::Calendar calendar = make_calendar(now.scene);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        // Rock that nothing flows through, and sediment that came after the last solution.
        if (water[i] < 0.0 || (d.stratum[i] > 0) != (which == Wet::sediment))
            continue;
        WetDisc& disc = wet.emplace_back();
        disc.row = i;
        disc.x = d.x[i];
        disc.y = d.y[i];
        disc.depth = std::max(0.0, ground.depth({d.x[i], d.y[i]}));
        disc.age = calendar.years(dem::Travel(d.start_travel[i]), state.clock.travel);
        disc.water = water[i];
        disc.excess_pressure = pressure[i];
        disc.weight = ratio[i] != 0.0
                          ? pressure[i] / ratio[i]
                          : ground.grains({d.x[i], d.y[i]}, grains[i]) * fluid->grain_weight();
        add_pores(*fluid, state, porosity[i], disc);
    }
    return wet;
}

} // namespace

std::vector<WetDisc> wet_discs(const Observation& now) { return discs_of(now, Wet::sediment); }

std::vector<WetDisc> wet_rock(const Observation& now) {
    const PoreFluid* const fluid = fluid_in(now);
    return fluid && fluid->sediment().has_rock() ? discs_of(now, Wet::rock)
                                                 : std::vector<WetDisc>{};
}

double depocentre(const std::vector<WetDisc>& wet) {
    const WetDisc* const deepest = deepest_of(wet);
    return deepest ? deepest->x : 0.0;
}

namespace {

constexpr double half_well = 1000.0; ///< m to either side

using Bin = std::vector<WetDisc>;

/// Mean of a number of the discs, by their mud.
template <auto number> double mean_of(const Bin& bin) {
    double sum = 0.0, volume = 0.0;
    for (const WetDisc& disc : bin) {
        sum += disc.volume * disc.*number;
        volume += disc.volume;
    }
    return sum / volume;
}

/// Across the beds of a bin, m^2.
double harmonic_permeability(const Bin& bin) {
    double resistance = 0.0, volume = 0.0;
    for (const WetDisc& disc : bin) {
        resistance += disc.volume / disc.permeability;
        volume += disc.volume;
    }
    return volume / resistance;
}

std::vector<Bin> bins_by_depth(const std::vector<WetDisc>& discs, double x, double step) {
    std::vector<Bin> bins;
    for (const WetDisc& disc : discs) {
        if (std::abs(disc.x - x) > half_well)
            continue;
        const auto bin = static_cast<std::size_t>(disc.depth / step);
        if (bin >= bins.size())
            bins.resize(bin + 1);
        bins[bin].push_back(disc);
    }
    return bins;
}

std::vector<WellPoint> well_through(const Observation& now, const std::vector<WetDisc>& discs,
                                    double x, bool of_one_kind) {
    const PoreFluid* const fluid = fluid_in(now);
    std::vector<WellPoint> points;
    const double step = std::max(250.0, 4.0 * now.state.mean_radius);
    for (const Bin& bin : bins_by_depth(discs, x, step)) {
        if (bin.empty())
            continue;
        WellPoint& p = points.emplace_back();
        p.x = x;
        p.y = mean_of<&WetDisc::y>(bin);
        p.depth = mean_of<&WetDisc::depth>(bin);
        p.age = mean_of<&WetDisc::age>(bin);
        p.excess = mean_of<&WetDisc::excess_pressure>(bin);
        const double weight = mean_of<&WetDisc::weight>(bin);
        p.at_rest = fluid->fluid_weight() * p.depth;
        p.pressure = p.at_rest + p.excess;
        p.fracture = p.at_rest + fluid->parameters().fracture_ratio * weight;
        p.total = p.at_rest + weight;
        p.effective = weight - p.excess;
        p.ratio = p.excess / weight;
        p.porosity = mean_of<&WetDisc::porosity>(bin);
        p.normal_porosity = mean_of<&WetDisc::normal_porosity>(bin);
        p.permeability = of_one_kind
                             ? fluid::permeability(fluid->flow_of(0).permeability, p.porosity)
                             : harmonic_permeability(bin);
        p.mud_weight = p.pressure / (now.parts.gravity * p.depth);
    }
    return points;
}

} // namespace

std::vector<WellPoint> well_at(const Observation& now, double x) {
    const PoreFluid* const fluid = fluid_in(now);
    return fluid ? well_through(now, wet_discs(now), x, fluid->sediment().beds.empty())
                 : std::vector<WellPoint>{};
}

std::vector<WellPoint> deep_well_at(const Observation& now, double x) {
    std::vector<WellPoint> points = well_at(now, x);
    const std::vector<WellPoint> rock = well_through(now, wet_rock(now), x, false);
    points.insert(points.end(), rock.begin(), rock.end());
    std::ranges::stable_sort(points, {}, &WellPoint::depth);
    return points;
}

namespace {

constexpr Measure<WellPoint> of_point[] = {
    {"depth_m", "m", "depth", "mean depth below the ground", taken<&WellPoint::depth>},
    {"pressure_pa", "Pa", "pore pressure", "pressure of the pore water",
     taken<&WellPoint::pressure>},
    {"excess_pressure_pa", "Pa", "excess pressure", "pressure over that of water at rest",
     taken<&WellPoint::excess>},
    {"overpressure_ratio", "1", "overpressure ratio",
     "excess pressure over the weight of grains in water", taken<&WellPoint::ratio>},
    {"effective_stress_pa", "Pa", "effective stress", "vertical stress that the grains carry",
     taken<&WellPoint::effective>},
    {"total_stress_pa", "Pa", "lithostat", "weight of grains and water above: the lithostat",
     taken<&WellPoint::total>},
    {"rest_pressure_pa", "Pa", "hydrostat", "pressure of water at rest: the hydrostat",
     taken<&WellPoint::at_rest>},
    {"fracture_pressure_pa", "Pa", "fracture pressure", "pressure at which fractures open and vent",
     taken<&WellPoint::fracture>},
    {"porosity", "1", "porosity", "porosity", taken<&WellPoint::porosity>},
    {"normal_porosity", "1", "porosity at hydrostatic pressure",
     "porosity that the depth has where water is at rest", taken<&WellPoint::normal_porosity>},
    {"permeability_m2", "m2", "permeability", "permeability", taken<&WellPoint::permeability>},
    {"mud_weight_kg_per_m3", "kg/m3", "mud weight",
     "density of a drilling mud whose weight is the pressure", taken<&WellPoint::mud_weight>},
    {"age_a", "a", "age", "time since the sediment was laid down; of rock since the start",
     taken<&WellPoint::age>},
};

std::vector<WellPlace> places(const Observation& now) {
    return places_of_wells(wet_discs(now), now.right_end());
}

} // namespace

MeasuredWell pore_well() { return measured_well<WellPoint, of_point, deep_well_at>(places); }

} // namespace listric::effects
