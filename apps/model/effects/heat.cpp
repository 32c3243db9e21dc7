#include "thermal/heat.hpp"

#include "apps/model/effect_list.hpp"
#include "apps/model/effects/heat/heat_measures.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric::effects::heat {

namespace {

using P = thermal::HeatParameters;

std::vector<Parameter> parameters() {
    return {
        {"surface_temperature_c", at<&P::surface_temperature>, "degC", between(-50, 100), "",
         "temperature of the ground or the sea floor",
         "Raising it warms everything by as much, less with depth.", between(0, 25)},
        {"lithosphere_m", at<&P::lithosphere>, "m", between(1e3, 4e5), "",
         "depth of the lithosphere's base, where the temperature is kept",
         "Raising it lowers the heat flow.", between(80e3, 150e3)},
        {"base_temperature_c", at<&P::base_temperature>, "degC", between(100, 2000), "",
         "temperature of the lithosphere's base", "Raising it raises the heat flow.",
         between(1280, 1350)},
        {"crust_m", at<&P::crust>, "m", between(1e3, 1e5), "",
         "thickness of the crust, which makes heat",
         "Raising it makes more heat, and raises the heat flow.", between(25e3, 45e3)},
        {"conductivity_w_per_m_k", at<&P::conductivity>, "W/m/K", between(0.1, 20), "",
         "thermal conductivity of the crust and of rock discs",
         "Lowering it makes the crust warmer with depth: in rock it falls by 10 to 40 % as that "
         "gets hot, which the model leaves out.",
         between(2, 3)},
        {"mantle_conductivity_w_per_m_k", at<&P::mantle_conductivity>, "W/m/K", between(0.1, 20),
         "", "thermal conductivity of the mantle", "Raising it raises the heat flow.",
         between(3, 4)},
        {"grain_conductivity_w_per_m_k", at<&P::grain_conductivity>, "W/m/K", between(0.1, 20), "",
         "thermal conductivity of sediment's grains; with water, of 0.64, by the geometric mean",
         "Lowering it makes sediment a thicker blanket: wells are hotter.", between(1.5, 4)},
        {"heat_production_w_per_m3", at<&P::heat_production>, "W/m3", between(0, 1e-4), "",
         "radiogenic heat of crust and of sediment's grains", "Raising it raises the heat flow.",
         between(0.5e-6, 2.5e-6)},
        {"interval_a", at<&P::interval>, "a", ranges::interval, "",
         "time between solutions; at most 100 m of extension, and a step in pauses that go by "
         "steps",
         "Raising it lags: an implicit solution is first order in time.", between(1e3, 5e4)},
        {"mantle_width_m", at<&P::mantle_width>, "m", between(1e3, 1e7), "",
         "width of the mantle that stretches below the lower crust; default: the lower crust's, "
         "and none without a lower crust that stretches",
         "Raising it spreads the heat that rises: a steer's head."},
    };
}

/// At most 100 m of extension: what moves then, moves by less than its neighbours are apart.
dem::Schedule schedule(const Scene& scene) {
    constexpr double furthest = 100.0; // m
    return {std::min(scene.find<P>()->interval, furthest / scene.extension.rate),
            make_calendar(scene), dem::InSteps::once};
}

thermal::HeatSetting setting(const Scene& scene, const ModelParts& parts) {
    const P& p = *scene.find<P>();
    const dem::TargetLine ground = dem::ground_of(scene.hanging_wall);
    thermal::HeatSetting s;
    s.beside = {ground.height(0.0), ground.height(scene.hanging_wall.length),
                scene.hanging_wall.length};
    s.greatest_extension = greatest_extension(scene);
    if (const auto& crust = parts.stretched_crust)
        s.shear = {crust->left, crust->width, p.mantle_width.value_or(crust->width)};
    s.rock_densities.push_back(scene.hanging_wall.rock_density);
    for (const LayerFacts& layer : parts.layers)
        s.rock_densities.push_back(layer.rock.density);
    if (parts.sediment) {
        s.grain_density = parts.sediment->grain_density;
        s.surface_porosity = parts.sediment->surface_porosity;
    }
    return s;
}

void add_events(const Scene& scene, const ModelParts& parts, dem::Events& events) {
    const auto facts = setting(scene, parts);
    auto points = std::make_unique<thermal::HeatPoints>(*scene.find<P>(), facts, schedule(scene));
    thermal::HeatPoints& rock = *points;
    dem::add(events, std::move(points));
    dem::add(events,
             std::make_unique<thermal::Heat>(*scene.find<P>(), facts, rock, schedule(scene)));
}

void check(const Scene& scene, const Refuse& refuse) {
    const P& p = *scene.find<P>();
    if (p.lithosphere <= p.crust)
        refuse("heat.lithosphere_m", fmt::format("is {}, allowed: above crust_m, {}",
                                                 text(p.lithosphere), text(p.crust)));
    if (scene.hanging_wall.thickness > p.crust)
        refuse("heat.crust_m",
               fmt::format("is {}, allowed: at least hanging_wall.thickness_m, {}; the hanging "
                           "wall is crust",
                           text(p.crust), text(scene.hanging_wall.thickness)));
    if (p.base_temperature <= p.surface_temperature)
        refuse("heat.base_temperature_c",
               fmt::format("is {}, allowed: above surface_temperature_c, {}",
                           text(p.base_temperature), text(p.surface_temperature)));
    if (thermal::Geotherm(p).mantle_heat_flow() <= 0.0)
        refuse("heat.base_temperature_c",
               fmt::format("is {}, but the crust's heat_production_w_per_m3 = {} makes more than "
                           "leaves through the ground, so that its own base is hotter; raise it, "
                           "or lower that or crust_m",
                           text(p.base_temperature), text(p.heat_production)));
    const auto crust = make_parts(scene).stretched_crust;
    if (p.mantle_width && !crust)
        refuse("heat.mantle_width_m",
               "is there, but no lower crust stretches; add the table that stretches it, or leave "
               "the width out");
    if (const double shortening = -least_extension(scene);
        p.mantle_width && shortening >= *p.mantle_width)
        refuse("heat.mantle_width_m",
               fmt::format("is {}, but [[stage]] shortens it by {}; widen it",
                           text(*p.mantle_width), text(shortening)));
}

std::string warning(const Scene& scene) {
    constexpr double longest = 5e6; // a
    const auto pauses = make_calendar(scene).pauses();
    if (std::ranges::none_of(pauses, [](const auto& pause) { return pause.years > longest; }))
        return "";
    const auto stage = std::ranges::find_if(*scene.find<Stages>(), [](const StageParameters& one) {
        return one.step.value_or(0.0) > longest;
    });
    return fmt::format("stage[{}].step_a: is {}; in a step rock does not move and temperatures of "
                       "sediment go evenly from one to the next, so that their maturity is coarse; "
                       "up to {} is usual",
                       stage - scene.find<Stages>()->begin(), text(*stage->step), text(longest));
}

/// Points in the rock: those of lis1 at both accuracies, and in between by the spacing.
double points(const Scene& scene) {
    const auto ends = thermal::section_ends(*scene.find<P>(), setting(scene, make_parts(scene)));
    return thermal::estimated_points(ends, scene.hanging_wall.length + scene.hanging_wall.thickness,
                                     scene.hanging_wall.mean_radius);
}

double memory(const Scene& scene) {
    constexpr double of_point = 5e3; // bytes: cells, factors of the matrix
    return of_point * (points(scene) + static_cast<double>(estimated_discs(scene)));
}

/// Temperature of the steady column where the detachment is deepest.
std::string explain(const Scene& scene, EffectList) {
    const P& p = *scene.find<P>();
    const thermal::Geotherm geotherm(p);
    const double depth = scene.hanging_wall.thickness;
    const auto depth_of = [&](double temperature) {
        const auto found = geotherm.depth_of(temperature);
        return found ? fmt::format("{:.1f} km", *found / 1e3) : std::string("not reached");
    };
    const double interval = schedule(scene).interval;
    return fmt::format(
        "heat\n"
        "  before extension {:.1f} mW/m2 leave the ground; {:.0f} degC at {:g} km, {:.0f} degC at "
        "the Moho; 300 degC: {}\n"
        "  every {:g} a; about {:.0f} points in rock without discs, {:.0f} MB\n"
        "  {}\n",
        1e3 * geotherm.surface_heat_flow(), geotherm.at(depth), depth / 1e3, geotherm.at(p.crust),
        depth_of(300.0), interval, points(scene), memory(scene) / 1e6,
        make_parts(scene).stretched_crust
            ? "crust and mantle below the detachment stretch in pure shear"
            : "rock below the detachment rests: no heat rises with it");
}

} // namespace

Works works() { return {&works::mckenzie, &works::sweeney_burnham}; }

const Effect& effect() {
    static const Effect effect{
        .name = "heat",
        .doc = "temperature of discs and of the rock around them, heat flow, and maturity of "
               "sediment",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters = parameters(),
        .check = check,
        .warning = warning,
        .add_events = add_events,
        .explain = explain,
        .price =
            [](const Scene& scene, const Workload& work) {
                return work.applications(schedule(scene).interval, dem::InSteps::once) * 300.0 *
                       (work.discs + points(scene));
            },
        .memory = memory,
        .measures = heat_measures(),
        .objects = heat_objects(),
        .layers = heat_layers(),
        .well = heat_well(),
    };
    return effect;
}

} // namespace listric::effects::heat
