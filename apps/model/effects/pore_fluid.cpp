#include "fluid/pore_fluid.hpp"

#include "apps/model/effects/pore_fluid_measures.hpp"
#include "apps/model/effects/pore_fluid_well.hpp"
#include "apps/model/model.hpp"
#include "apps/support/words/spelling.hpp"
#include "coupling/water_load.hpp"
#include "dem/numbers/round_off.hpp"
#include "fluid/dry_ground.hpp"
#include "fluid/pore_column.hpp"

#include "apps/model/bending_base.hpp"
#include "apps/model/effect_list.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/toml/pieces.hpp"

#include <fmt/format.h>

#include <cmath>

namespace listric::effects::pore_fluid {

namespace {

using P = fluid::PoreFluidParameters;
using fluid::FaultFactors;
using fluid::SedimentFlow;

std::vector<Parameter> parameters() {
    std::vector<Parameter> all{
        by_travel(
            {"interval_a", at<&P::interval>, "a", ranges::interval, "",
             "time between solutions for the pressure; a multiple of the time between updates of "
             "porosity. The stratum that is to come is part of every solution",
             "Raising it above the default makes pressures less accurate: 0.3 % at 2,500 a.",
             between(500, 2500)}),
        {"fluid_density_kg_per_m3", at<&P::density>, "kg/m3", ranges::density, "",
         "density of the water",
         "Raising it lets all discs below the level weigh less: rock is as full of water as "
         "sediment."},
        {"viscosity_pa_s", at<&P::viscosity>, "Pa s", between(1e-5, 1.0), "",
         "viscosity of the water", "Raising it acts as a permeability that is lower by as much."},
        {"compressibility_per_pa", at<&P::compressibility>, "1/Pa", between(1e-12, 1e-6), "",
         "compressibility of the water",
         "Changes little: pores give way a hundred times as much as water."},
        {"rebound", at<&P::rebound>, "", between(0, 1), "",
         "share of the porosity lost to stress that comes back with its release, in the water's "
         "balance alone",
         "Lowering it lets pressure fall more where sediment is unloaded."},
        {"fracture_ratio", at<&P::fracture_ratio>, "", between(0.5, 1), "",
         "excess pressure over the weight of grains in water, both above water at rest, at which "
         "fractures open and vent; 0.9 is a pore pressure of some 0.95 of the weight of grains and "
         "water",
         "Lowering it vents more: in extension, 0.7 to 0.8 may be nearer to horizontal stress.",
         between(0.7, 0.9)},
        {"permeability_ratio", at<&P::flow, &SedimentFlow::ratio>, "", between(0.1, 1000), "",
         "permeability along bedding over that across it, which is `permeability_m2`",
         "Raising it drains a section to its sides. Beds are turned where they lie.",
         between(1, 10)},
        {"fault_along", at<&P::flow, &SedimentFlow::faults, &FaultFactors::along>, "",
         between(1e-6, 1e6), "", "permeability between weakened discs over that of sound sediment",
         "Raising it makes faults in sediment conduits."},
        {"fault_across", at<&P::flow, &SedimentFlow::faults, &FaultFactors::across>, "",
         between(1e-6, 1e6), "",
         "permeability between a weakened and a sound disc over that of sound sediment",
         "Lowering it makes faults in sediment seals."},
        {"level_m", at<&P::level>, "m", ranges::height, "",
         "height of the water above the original surface; default: the level that the basin is "
         "filled to, 0 where that is a line. Given, or beside a base that bends, ground above it "
         "is dry",
         "Lowering it dries the ground above it, which then weighs in full."},
        {"hydrostatic", at<&P::hydrostatic>, "", ranges::any, "",
         "water at rest: buoyancy of sediment and rock, and nothing else",
         "true is the limit of high permeability, at no cost."},
        {"pushes", at<&P::pushes>, "", ranges::any, "",
         "whether excess pressure exerts forces on discs",
         "false keeps pores open by the same pressures, but lets contacts carry all weight: a "
         "control."},
    };
    const auto permeability = permeability_parameters<&P::flow, &SedimentFlow::permeability>();
    all.insert(all.begin() + 1, permeability.begin(), permeability.end());
    return all;
}

fluid::WetSediment wet_sediment(const ModelParts& parts, const dem::Calendar& calendar) {
    fluid::WetSediment wet{parts.sediment->surface_porosity,
                           *parts.sediment->porosity_decay,
                           parts.sediment->grain_density,
                           parts.sediment->surface,
                           {parts.sediment->deposition_interval, calendar, dem::InSteps::once},
                           parts.sediment->beds,
                           parts.sediment->flows};
    for (const LayerFacts& layer : parts.layers) {
        wet.rocks.push_back(layer.pores);
        if (layer.pores) // faults cut rock and sediment alike
            wet.rocks.back()->flow.faults = parts.sediment->flow.faults;
    }
    return wet;
}

fluid::MudColumn mud_column(const P& p, const fluid::WetSediment& sediment, double gravity) {
    fluid::MudColumn column{fluid::pore_law(p, sediment, gravity), p.flow.permeability, p.viscosity,
                            p.fracture_ratio};
    const dem::Calendar& calendar = sediment.deposition.calendar();
    for (std::size_t k = 0; k < sediment.beds.list.size(); ++k) {
        const dem::Bed& bed = sediment.beds.list[k];
        column.beds.push_back({dem::Schedule(bed.until, calendar.rate()).seconds(1), column.law,
                               sediment.flows[k].permeability});
        column.beds.back().law.surface_porosity = bed.pores.surface_porosity;
        column.beds.back().law.decay = bed.pores.coefficient;
    }
    return column;
}

/// The water's level through the run: a stage's is reached evenly, at its end.
WaterFacts water_facts(const Scene& scene, double start) {
    WaterFacts water{.level = {}, .density = scene.find<P>()->density};
    const dem::Calendar calendar = make_calendar(scene);
    std::vector<dem::TargetStage> heights{{0.0, {{0.0, start}}}};
    if (const Stages* stages = scene.find<Stages>()) {
        const dem::Motion motion = make_motion(scene);
        for (std::size_t k = 0; k < stages->size(); ++k) {
            const std::optional<double> level = (*stages)[k].water_level;
            if (!level)
                continue;
            water.moves = true;
            if (const double begins = calendar.age(motion.stages[k].start);
                begins > heights.back().time)
                heights.push_back({begins, heights.back().points});
            heights.push_back({calendar.age(motion.stages[k].end), {{0.0, *level}}});
        }
    }
    water.level = {dem::Target(start, std::move(heights)), calendar};
    return water;
}

void contribute(const Scene& scene, ModelParts& parts) {
    parts.sediment->flow = scene.find<P>()->flow;
    parts.water = water_facts(scene, scene.find<P>()->level.value_or(parts.sediment->level));
    parts.physics.gravity *=
        fluid::buoyant_share(scene.find<P>()->density, parts.sediment->grain_density);
}

void add_events(const Scene& scene, const ModelParts& parts, dem::Events& events) {
    const P& p = *scene.find<P>();
    const dem::Calendar calendar = make_calendar(scene);
    const bool bends = bending_base(scene) != nullptr;
    const bool ends = bends || p.level || parts.water->moves;
    if (!p.hydrostatic)
        dem::add(events, std::make_unique<fluid::PoreFluid>(
                             p, wet_sediment(parts, calendar), parts.gravity, calendar,
                             fluid::WaterSurface{parts.water->level, ends, bends && p.pushes}));
    if (ends)
        dem::add(events, std::make_unique<fluid::DryGround>(
                             parts.water->level, parts.gravity - parts.physics.gravity,
                             dem::Schedule{p.interval, calendar}, !p.hydrostatic && p.pushes));
}

std::vector<coupling::FootwallLoad>
load_bending_base(const Scene& scene, const ModelParts& parts,
                  std::span<const std::unique_ptr<dem::Event>>) {
    const P& p = *scene.find<P>();
    return {coupling::water_load({.level = parts.water->level,
                                  .density = p.density,
                                  .grain_density = parts.sediment->grain_density,
                                  .gravity = parts.gravity,
                                  .interval = p.interval,
                                  .wall_x = scene.hanging_wall.length},
                                 make_calendar(scene))};
}

/// Water weighs on every scene's start, its permeability on none.
void as_in_genesis(std::any& parameters) {
    P start;
    start.density = std::any_cast<const P&>(parameters).density;
    parameters = start;
}

void check(const Scene& scene, const Refuse& refuse) {
    const P& p = *scene.find<P>();
    const ModelParts parts = make_parts(scene);
    const double grains = parts.sediment->grain_density, rock = scene.hanging_wall.rock_density;
    if (p.density >= grains)
        refuse("pore_fluid.fluid_density_kg_per_m3",
               fmt::format("is {}, allowed: below {}, the density of grains; else sediment floats",
                           text(p.density), text(grains)));
    if (rock != grains)
        refuse("pore_fluid",
               fmt::format("weighs rock and grains by one buoyancy, which needs equal densities; "
                           "hanging_wall.rock_density_kg_per_m3 is {}, grains have {}",
                           text(rock), text(grains)));
    for (std::size_t k = 0; k < parts.layers.size(); ++k)
        if (const double density = parts.layers[k].rock.density; density != grains)
            refuse(fmt::format("layer[{}].density_kg_per_m3", k),
                   fmt::format("is {} beside [pore_fluid], which weighs rock and grains by one "
                               "buoyancy, allowed: {}, the density of grains",
                               text(density), text(grains)));
    if (!(*parts.sediment->porosity_decay > 0.0) || !(parts.sediment->surface_porosity > 0.0))
        refuse("pore_fluid", "needs sediment that compacts: a decay of porosity with depth and a "
                             "surface porosity above 0");
    const double times = p.interval / parts.sediment->porosity_interval;
    if (std::abs(times - std::round(times)) > 1e-9 || times < 0.5)
        refuse("pore_fluid.interval_a",
               fmt::format("is {}, allowed: a multiple of the interval of the sediment's loss of "
                           "porosity, {} a, which follows it",
                           text(p.interval), text(parts.sediment->porosity_interval)));
    if (const BendingBase* base = bending_base(scene))
        if (const std::string why = objection_to_fill(p.density, *base); !why.empty())
            refuse("pore_fluid.fluid_density_kg_per_m3", why);
}

/// Pressure is that of its depth below thick strata only, whose own water is fresh: beside a column
/// laid down continuously it is .005 off with strata of 100 m of travel, .02 with 200, at 0.5 km,
/// and .06 at 1 km with 500.
std::string warning(const Scene& scene) {
    constexpr double most = 100.0; // m of travel
    const double interval = make_parts(scene).sediment->deposition_interval;
    const double rate = scene.extension.rate;
    if (scene.find<P>()->hydrostatic || interval * rate <= most * (1.0 + 1e-9))
        return "";
    return fmt::format("pore_fluid: strata every {:g} a are up to {:.0f} m thick; the pressure of "
                       "the water is good to .01 with strata every {:g} a or less at this rate",
                       interval, interval * rate, dem::without_round_off(most / rate));
}

/// Time that the wall takes to pull the base away, s: no floor sinks in pauses and on the way back.
double seconds_of_extension(const Scene& scene) {
    double travel = 0.0;
    for (const dem::MotionStage& one : make_motion(scene).stages)
        if (one.slope > 0.0)
            travel += (one.end - one.start).m;
    if (!scene.find<Stages>())
        travel = scene.extension.distance;
    return dem::Schedule{travel / scene.extension.rate, scene.extension.rate}.seconds(1);
}

/// What water does to a base that bends, at the start, and what is dry; empty: it does nothing.
std::string explain_water_on_base(const Scene& scene, const ModelParts& parts) {
    if (!bending_base(scene))
        return "";
    const dem::Chain base = dem::base_line(make_rigid_base(scene), 0.0);
    const auto level_after = [&](double metres) {
        const dem::WaterLevel& level = parts.water->level;
        return level.heights.at(level.calendar.age(dem::Travel(metres))).height(0.0);
    };
    const double level = level_after(0.0), last = level_after(greatest_extension(scene));
    constexpr int columns = 1000;
    const double width = scene.hanging_wall.length / columns;
    double area = 0.0;
    for (int k = 0; k < columns; ++k)
        area += width * std::max(0.0, level - dem::height_at(base, (k + 0.5) * width));
    const double lowest = std::min(level, last);
    return fmt::format(
        "  water presses on the base with {:.3g} N/m at the start, which is rest; the base bears "
        "what that changes. Level {:g} m{}; {}\n",
        area * scene.find<P>()->density * parts.gravity, level,
        parts.water->moves ? fmt::format(", {:g} m in the end", last) : "",
        lowest < 0.0
            ? fmt::format("the uppermost {:g} m of rock get dry and weigh in full", -lowest)
            : "dry is what lies above it");
}

/// How long pressure takes to even out in layers of rock that water flows through.
std::string explain_rock(const P& p, const ModelParts& parts) {
    std::string lines;
    for (const LayerFacts& layer : parts.layers) {
        if (!layer.pores)
            continue;
        const fluid::PorousRock& rock = *layer.pores;
        const double storage = rock.porosity * p.compressibility + rock.compressibility; // 1/Pa
        const double across = rock.flow.permeability.at_fifth / (p.viscosity * storage); // m2/s
        constexpr double far = 10e3;                                                     // m
        double thick = 0.0;
        for (const dem::Point point : layer.rock.top.points())
            thick = std::max(thick, point.y - layer.rock.bottom.height(point.x));
        const auto years = [](double length, double diffusivity) {
            return length * length / diffusivity / dem::seconds_per_year;
        };
        lines += fmt::format(
            "  rock {} drains: {:.2g} m2, {:.3g} times as much along bedding; pressure evens out "
            "across its {:.0f} m in {:.2g} a, along {:.0f} km in {:.2g} a\n",
            layer.name, rock.flow.permeability.at_fifth, rock.flow.ratio, thick,
            years(thick, across), far / 1e3, years(far, rock.flow.ratio * across));
    }
    return lines;
}

/// Pressure and porosity of a column of this mud at the depocentre.
std::string explain(const Scene& scene, EffectList) {
    const P& p = *scene.find<P>();
    const ModelParts parts = make_parts(scene);
    if (p.hydrostatic)
        return fmt::format(
            "pore fluid\n  water at rest: discs weigh {:.3f} of their weight in air\n{}",
            parts.physics.gravity / parts.gravity, explain_water_on_base(scene, parts));
    const fluid::MudColumn column =
        mud_column(p, wet_sediment(parts, make_calendar(scene)), parts.gravity);
    // A floor below a steep detachment sinks by nine tenths of the extension.
    const double depth = std::min(0.9 * greatest_extension(scene), scene.hanging_wall.thickness);
    if (depth <= 0.0)
        return fmt::format(
            "pore fluid\n  discs weigh {:.3f} of their weight in air; nothing sinks\n",
            parts.physics.gravity / parts.gravity);
    const double seconds = seconds_of_extension(scene);
    const fluid::SteadyColumn sunk = fluid::sink_steadily(column, depth, seconds);
    const double gibson = fluid::gibson_number(column, depth / seconds, seconds);
    constexpr double shallow = 1000.0; // m
    const double half = 0.5 * depth;
    std::string ratios;
    for (const double at : {shallow, half})
        if (at <= half)
            ratios += fmt::format("{}{:.2f} at {:.{}f} km", ratios.empty() ? "" : ", ",
                                  sunk.at(at).overpressure_ratio, at / 1e3, at == shallow ? 0 : 1);
    const double weight = column.law.grain_weight * sunk.at(half).grains_above;
    const double at_rest = p.density * parts.gravity * half;
    const std::string beside =
        column.beds.empty()
            ? fmt::format(", {:.3f} where water is at rest", fluid::porosity_at(column.law, half))
            : "";
    return fmt::format(
        "pore fluid\n"
        "  discs weigh {:.3f} of their weight in air, rock as sediment; pressure every {:g} a\n"
        "  fractures open at an excess pressure of {:g} of the weight of grains in water; at "
        "{:.1f} "
        "km that is a pore pressure of {:.3f} of the weight of grains and water\n"
        "  a floor that sinks by {:.1f} km has Gibson's number {:.2g}: {}\n"
        "  overpressure ratio of a column of {}: {}; "
        "porosity {:.3f} there{}\n{}{}",
        parts.physics.gravity / parts.gravity, p.interval, p.fracture_ratio, half / 1e3,
        (at_rest + p.fracture_ratio * weight) / (at_rest + weight), depth / 1e3, gibson,
        gibson < fluid::gibson_at_rest
            ? "water is nearly at rest; hydrostatic = true has it at rest at no cost"
        : gibson > fluid::gibson_undrained ? "hardly any water leaves but through fractures"
                                           : "water leaves while mud is buried",
        column.beds.empty() ? "this mud" : "these beds", ratios, sunk.at(half).porosity, beside,
        explain_rock(p, parts), explain_water_on_base(scene, parts));
}

} // namespace

Works works() {
    return {&works::gibson,     &works::audet_fowler,   &works::wangen,
            &works::yang_aplin, &works::baldwin_butler, &works::catalano};
}

const Effect& effect() {
    static const Effect effect{
        .name = "pore_fluid",
        .doc = "water in the pores: buoyancy of all discs, rock too; overpressure and "
               "undercompaction of sediment",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters = parameters(),
        .rock = rock_of_sediment([](Scene& scene, const RockMaterial& rock) {
            if (rock.pores)
                scene.find<P>()->flow.permeability = rock.pores->permeability;
        }),
        .needs = {"gravity", "sedimentation", "compaction"},
        .fills_pores = true,
        .in_genesis = true,
        .as_in_genesis = as_in_genesis,
        .check = check,
        .warning = warning,
        .contribute = contribute,
        .add_events = add_events,
        .load_bending_base = load_bending_base,
        .explain = explain,
        .absence = {"pressure and buoyancy of pore water on the discs",
                    "docs/explain/pore-fluid.md#on-a-base-that-bends"},
        .price =
            [](const Scene& scene, const Workload& work) {
                const P& p = *scene.find<P>();
                return p.hydrostatic ? 0.0 : work.applications(p.interval) * 450.0 * work.discs;
            },
        .measures = pore_fluid_measures(),
        .objects = pore_fluid_objects(),
        .layers = pore_fluid_layers(),
        .well = pore_well(),
    };
    return effect;
}

} // namespace listric::effects::pore_fluid
