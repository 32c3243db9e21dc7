#include "thermal/heat.hpp"

#include "coupling/thermal_load.hpp"
#include "thermal/rift_column.hpp"

#include "apps/model/bending_base.hpp"
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
        {"regional_extension_m", at<&P::regional_extension>, "m", between(0, 1e6), "",
         "extension of lower crust and mantle beyond that of the hanging wall, by faults outside "
         "of the section; in proportion to the wall's way",
         "Raising it thins and heats what is below the detachment more: one fault of 10 km alone "
         "makes little thermal subsidence."},
        {"thermal_expansion_per_k", at<&P::expansion>, "1/K", between(0, 1e-3), "",
         "thermal expansion of rock and grains, by which temperature loads a base that bends",
         "Raising it lifts hot rock more, and lets it sink more as it cools; 0: no load.",
         between(3e-5, 3.5e-5)},
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
    s.beside.left = ground.height(0.0);
    s.beside.right = ground.height(scene.hanging_wall.length);
    s.beside.wall_x = scene.hanging_wall.length;
    s.ground = ground;
    s.greatest_extension = greatest_extension(scene);
    if (const auto& crust = parts.stretched_crust)
        s.shear = {crust->left, crust->width, p.mantle_width.value_or(crust->width),
                   parts.stretch_share};
    s.rock_densities.push_back(scene.hanging_wall.rock_density);
    for (const LayerFacts& layer : parts.layers)
        s.rock_densities.push_back(layer.rock.density);
    if (parts.sediment) {
        s.grain_density = parts.sediment->grain_density;
        s.pores = {parts.sediment->surface_porosity, parts.sediment->porosity_decay.value_or(0.0)};
    }
    s.beside.film = parts.film;
    if (const BendingBase* base = bending_base(scene)) {
        s.crust_density = base->crust_density;
        s.mantle_density = base->mantle_density;
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

/// Rock below the detachment stretches by more than the hanging wall is pulled out, in proportion.
void contribute(const Scene& scene, ModelParts& parts) {
    const double own = greatest_extension(scene), more = scene.find<P>()->regional_extension;
    if (own > 0.0 && more > 0.0)
        parts.stretch_share = 1.0 + more / own;
    parts.depth_of_temperature = [geotherm = thermal::Geotherm(*scene.find<P>())](double t) {
        return geotherm.depth_of(t);
    };
    if (parts.sediment)
        parts.film = dem::SedimentFilm{.target = parts.sediment->surface,
                                       .deposition = {parts.sediment->deposition_interval,
                                                      make_calendar(scene), dem::InSteps::once},
                                       .surface_porosity = parts.sediment->surface_porosity,
                                       .beds = parts.sediment->beds,
                                       .wall_x = scene.hanging_wall.length};
}

/// Ends of what temperatures change in, m.
std::pair<double, double> loaded(const Scene& scene, const ModelParts& parts) {
    const thermal::HeatSetting s = setting(scene, parts);
    double left = 0.0, right = scene.hanging_wall.length + greatest_extension(scene);
    if (s.shear) {
        left = std::min(left, s.shear->left);
        right =
            std::max(right, s.shear->left + std::max(s.shear->crust_width, s.shear->mantle_width) +
                                s.shear->share * greatest_extension(scene));
    }
    return {left, right};
}

/// What the film of sediment weighs: water in its pores is counted with that of the basin.
coupling::FootwallLoad load_of_film(const Scene& scene, const ModelParts& parts) {
    coupling::FilmLoadParameters film{
        .film = *parts.film,
        .grain_density = parts.sediment->grain_density,
        .gravity = parts.gravity,
        .column_width = coupling::water_column_width(scene.hanging_wall.mean_radius)};
    if (parts.water) {
        film.level = parts.water->level;
        film.water_density = parts.water->density;
    }
    return coupling::film_load(film);
}

std::vector<coupling::FootwallLoad>
load_bending_base(const Scene& scene, const ModelParts& parts,
                  std::span<const std::unique_ptr<dem::Event>> events) {
    const BendingBase& base = *bending_base(scene);
    const auto [left, right] = loaded(scene, parts);
    const std::vector<double> knots = coupling::thermal_knots(left, right, base.left, base.right);
    coupling::ThermalPressure pressure;
    if (auto* const heat = dem::find<thermal::Heat>(events)) {
        heat->weigh_at(knots);
        pressure = [heat, gravity = parts.gravity] {
            std::vector<double> weight = heat->mass_lost();
            for (double& p : weight)
                p *= -gravity;
            return weight;
        };
    }
    std::vector<coupling::FootwallLoad> loads{
        coupling::thermal_load(knots, pressure, schedule(scene))};
    if (parts.film)
        loads.push_back(load_of_film(scene, parts));
    return loads;
}

void check_stretching(const Scene& scene, const Refuse& refuse) {
    const P& p = *scene.find<P>();
    const bool stretches = make_parts(scene).stretched_crust.has_value();
    if (p.mantle_width && !stretches)
        refuse("heat.mantle_width_m",
               "is there, but no lower crust stretches; add the table that stretches it, or leave "
               "the width out");
    if (p.regional_extension > 0.0 && !stretches)
        refuse("heat.regional_extension_m",
               fmt::format("is {}, but no lower crust stretches; add the table that stretches it, "
                           "or leave the extension out",
                           text(p.regional_extension)));
    if (p.regional_extension > 0.0 && !(greatest_extension(scene) > 0.0))
        refuse("heat.regional_extension_m",
               fmt::format("is {} and goes with the wall's way out, but the wall is not pulled "
                           "out; allowed: 0",
                           text(p.regional_extension)));
    const double shortening = -make_parts(scene).stretch_share * least_extension(scene);
    if (p.mantle_width && shortening >= *p.mantle_width)
        refuse("heat.mantle_width_m",
               fmt::format("is {}, but [[stage]] shortens it by {}; widen it",
                           text(*p.mantle_width), text(shortening)));
}

std::string warning_of_width(const Scene& scene) {
    const BendingBase* const base = bending_base(scene);
    const auto shear = setting(scene, make_parts(scene)).shear;
    if (!base || !shear || !scene.find<P>()->mantle_width)
        return "";
    const double right =
        shear->left + shear->mantle_width + shear->share * greatest_extension(scene);
    if (shear->left >= base->left && right <= base->right)
        return "";
    return fmt::format("heat.mantle_width_m: mantle stretches from x = {} to {}, but the footwall "
                       "ends at {} and {}: what rises and cools beyond does not move the base; "
                       "widen the footwall, or narrow the mantle",
                       text(shear->left), text(right), text(base->left), text(base->right));
}

std::string warning_of_steps(const Scene& scene) {
    constexpr double longest = 5e6; // a
    const auto pauses = make_calendar(scene).pauses();
    if (std::ranges::none_of(pauses, [](const auto& pause) { return pause.years > longest; }))
        return "";
    const Stages& all = *scene.find<Stages>();
    const auto found =
        std::ranges::find_if(all, [](const auto& one) { return one.step.value_or(0.0) > longest; });
    return fmt::format("stage[{}].step_a: is {}; in a step rock does not move and temperatures of "
                       "sediment go evenly from one to the next, so that their maturity is coarse; "
                       "up to {} is usual",
                       found - all.begin(), text(*found->step), text(longest));
}

std::string warning(const Scene& scene) {
    const std::string steps = warning_of_steps(scene), width = warning_of_width(scene);
    return steps + (steps.empty() || width.empty() ? "" : "; ") + width;
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
    check_stretching(scene, refuse);
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

/// Subsidence of a wide section since its wall last moved, m.
double subsidence_after_rift(const Scene& scene, const ModelParts& parts, double fill) {
    const thermal::HeatSetting s = setting(scene, parts);
    const dem::Calendar calendar = make_calendar(scene);
    const dem::Motion motion = make_motion(scene);
    thermal::RiftColumn column(*scene.find<P>(),
                               {scene.hanging_wall.thickness, s.crust_density, s.mantle_density});
    constexpr int steps = 500;
    double before = 0.0, at_rest = 0.0;
    for (int k = 1; k <= steps; ++k) {
        const dem::Travel from(scene.extension.distance * (k - 1) / steps),
            to(scene.extension.distance * k / steps);
        const double now = s.shear->share * motion.position(to).m;
        const auto factor = [&](double width) { return (width + now) / (width + before); };
        column.stretch(factor(s.shear->crust_width), factor(s.shear->mantle_width));
        column.rest(calendar.years(from, to) * dem::seconds_per_year);
        if (now != before)
            at_rest = column.mass_lost();
        before = now;
    }
    return (at_rest - column.mass_lost()) / (bending_base(scene)->floats_on() - fill);
}

/// What temperatures do to the base.
std::string explain_load(const Scene& scene) {
    const ModelParts parts = make_parts(scene);
    const thermal::HeatSetting s = setting(scene, parts);
    if (!bending_base(scene))
        return "on this base nothing subsides by cooling";
    if (!s.shear)
        return "rock below the detachment rests: no heat rises with it; cooling by what comes and "
               "goes above loads the base";
    constexpr double water = 1030.0, sediment = 2300.0;
    const double extension =
        s.shear->share * make_motion(scene).position(dem::Travel(scene.extension.distance)).m;
    const double filled = subsidence_after_rift(scene, parts, sediment);
    return fmt::format(
        "crust and mantle below the detachment have stretched by {:.2f} and {:.2f} at the end; "
        "cooling since\n  the wall last moved then has lowered a wide basin by {:.0f} m under "
        "water ({:g} kg/m3), {:.0f} m under sediment\n  ({:g} kg/m3): {:.1f} layers of discs",
        1.0 + extension / s.shear->crust_width, 1.0 + extension / s.shear->mantle_width,
        subsidence_after_rift(scene, parts, water), water, filled, sediment,
        filled / (2.0 * scene.hanging_wall.mean_radius));
}

/// Sediment that no disc stands for.
std::string explain_film(const Scene& scene) {
    const ModelParts parts = make_parts(scene);
    if (!parts.film)
        return "";
    return fmt::format("  between strata sediment fills what a disc has no room in, up to {:.0f} m "
                       "below the target: it {} a blanket of {:.2f} W/m/K\n",
                       2.0 * scene.hanging_wall.mean_radius,
                       bending_base(scene) ? "weighs on the base and is" : "is",
                       thermal::sediment_conductivity(scene.find<P>()->grain_conductivity,
                                                      parts.film->surface_porosity));
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
        "{}"
        "  {}\n",
        1e3 * geotherm.surface_heat_flow(), geotherm.at(depth), depth / 1e3, geotherm.at(p.crust),
        depth_of(300.0), interval, points(scene), memory(scene) / 1e6, explain_film(scene),
        explain_load(scene));
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
        .contribute = contribute,
        .add_events = add_events,
        .load_bending_base = load_bending_base,
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
