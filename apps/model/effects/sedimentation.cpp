#include "dem/events/sedimentation.hpp"
#include "dem/events/sediment_stress.hpp"

#include "apps/model/effect_list.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/picks/target_csv.hpp"
#include "apps/scene/toml/pieces.hpp"
#include "apps/support/words/spelling.hpp"
#include "dem/genesis/genesis.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric::effects::sedimentation {

namespace {

using P = dem::SedimentationParameters;

std::vector<Parameter> parameters() {
    using dem::Material;
    return {
        by_travel({"interval_a", at<&P::interval>, "a", ranges::interval, "Delta t_s",
                   "time between sedimentations", "Lowering it lays more and thinner strata.",
                   between(25e3, 50e3)}),
        {"level_m", at<&P::level>, "m", ranges::height, "",
         "height of the target above the original surface, where no target line is given",
         "Lowering it starves the basin; below 0 the hanging wall is eroded down to it."},
        {"target", at<&P::target>, "", ranges::height, "",
         "target line: points [x, y] in m, or stages {time_a, points}; fills below, erodes above",
         "Sets where sediment is laid down and where rock is eroded, also over time."},
        surface_porosity_parameter<&P::surface_porosity>(),
        {"grain_density_kg_per_m3", at<&P::grain_density>, "kg/m3", ranges::density, "",
         "density of sediment at zero porosity",
         "Raising it makes sediment heavier in proportion; an elastic base sinks more."},
        {"normal_stiffness_pa", at<&P::material, &Material::normal_stiffness>, "Pa",
         ranges::stiffness, "k_n", "normal stiffness of one sediment disc",
         "Raising it stiffens the sediment; above that of the rock it shortens the time step."},
        {"shear_stiffness_pa", at<&P::material, &Material::shear_stiffness>, "Pa",
         ranges::stiffness, "k_s", "shear stiffness of one sediment disc",
         "Raising it toward the normal stiffness lowers Poisson's ratio of the sediment."},
        {"friction", at<&P::material, &Material::friction>, "", ranges::friction, "mu_d",
         "friction of sediment discs",
         "Raising it steepens slopes that loose sediment holds, and strengthens it under load."},
        {"rolling_friction", at<&P::material, &Material::rolling_friction>, "", ranges::friction,
         "mu_r", "resistance of sediment discs to rolling",
         "Raising it steepens slopes beyond what friction alone holds."},
    };
}

/// The event that deposits and, where sediment weighs, the one that looks at what carries it.
void add_events(const Scene& scene, const ModelParts& parts, dem::Events& events) {
    const double rate = scene.extension.rate;
    dem::add(events,
             std::make_unique<dem::Sedimentation>(*scene.find<P>(), scene.hanging_wall.radius_ratio,
                                                  make_calendar(scene), parts.sediment->beds));
    if (parts.physics.gravity <= 0.0)
        return;
    std::optional<double> between_changes; // of porosity, m of travel
    if (parts.sediment->porosity_decay)
        between_changes = dem::Schedule(parts.sediment->porosity_interval, rate).spacing();
    dem::add(events, std::make_unique<dem::SedimentStress>(scene.output.interval, between_changes,
                                                           rate, parts.physics));
}

/// The lines that the surface is adapted to, one after the other.
std::vector<dem::TargetLine> lines_of(const P& p) {
    std::vector<dem::TargetLine> lines;
    for (const dem::TargetStage& stage : p.target)
        lines.emplace_back(stage.points);
    if (lines.empty())
        lines.emplace_back(std::vector<dem::Point>{{0.0, p.level}});
    return lines;
}

/// Area between the original surface and the target where that is highest, m^2.
double area_above_surface(const Scene& scene) {
    constexpr int columns = 1000;
    const double width = scene.hanging_wall.length + greatest_extension(scene);
    double greatest = 0.0;
    for (const dem::TargetLine& line : lines_of(*scene.find<P>())) {
        double area = 0.0;
        for (int k = 0; k < columns; ++k)
            area += std::max(0.0, line.height((k + 0.5) * width / columns)) * width / columns;
        greatest = std::max(greatest, area);
    }
    return greatest;
}

/// Fills distance times thickness, small discs up to the target, and what lies between surface and
/// target.
double new_area(const Scene& scene) {
    return 1.1 * greatest_extension(scene) * scene.hanging_wall.thickness +
           area_above_surface(scene);
}

/// Tries that find no room at the end of every sedimentation, and laying down a heap whose columns
/// are looked through for every disc. The tries of one sedimentation were measured to take 5 to 7,
/// 7 to 10, 17 to 19, 19 to 29 and 72 to 98 ms at ratios of radii of 1.2, 1.66, 3, 5 and 10, where
/// the cycle makes 80 million disc-steps a second.
double price(const Scene& scene, const Workload& work) {
    constexpr double of_a_heaped_disc = 2e5;
    const double tries = 4e5 + 6.5e4 * work.area_ratio;
    return work.applications(scene.find<P>()->interval, dem::InSteps::once) *
               (tries + 40.0 * work.discs) +
           of_a_heaped_disc *
               static_cast<double>(dem::disc_count(scene.hanging_wall, area_above_surface(scene)));
}

/// Refuses a target that leaves nothing of the hanging wall, and one above the ground behind the
/// breakaway, where sediment would be laid only near the hanging wall and fall off at the end.
void check(const Scene& scene, const Refuse& refuse) {
    const P& p = *scene.find<P>();
    const double thickness = scene.hanging_wall.thickness;
    double lowest = 1e300; // of the highest points of all lines
    for (const dem::TargetLine& line : lines_of(p))
        lowest = std::min(lowest, std::ranges::max(line.points(), {}, &dem::Point::y).y);
    if (lowest <= -thickness)
        refuse(
            p.target.empty() ? "sedimentation.level_m" : "sedimentation.target",
            fmt::format("is {} at its highest, below the whole hanging wall, which erosion would "
                        "take away; allowed: above {}, its base",
                        text(lowest), text(-thickness)));
    if (!scene.detachment || !scene.detachment->footwall_top)
        return;
    const double fill = dem::highest_fill_behind_breakaway(
        p, make_motion(scene), make_calendar(scene), scene.extension.distance);
    if (fill > 0.0)
        refuse(p.target.empty() ? "sedimentation.level_m" : "sedimentation.target",
               fmt::format("is {} at x <= 0 beside detachment.footwall_top_m = {}: sediment cannot "
                           "be laid on that level ground; give a sedimentation.target that is 0 or "
                           "less there, such as [[0.0, 0.0], [1000.0, {}]], or leave out "
                           "footwall_top_m",
                           text(fill), text(*scene.detachment->footwall_top), text(fill)));
}

const dem::SedimentStress* stress_in(const Observation& now) {
    return dem::find<const dem::SedimentStress>(now.events);
}

/// Mean over the layers; not a number without layers.
template <double dem::LayerStress::*part>
std::optional<double> mean_of_layers(const Observation& now) {
    const auto* stress = stress_in(now);
    if (!stress)
        return std::nullopt;
    double sum = 0.0, layers = 0.0;
    for (const dem::LayerStress& layer : stress->profile()) {
        sum += layer.*part;
        layers += 1.0;
    }
    return sum / layers;
}

constexpr Measure<dem::LayerStress> of_layer[] = {
    {"depth_m", "m", "depth", "depth of the layer's middle below the surface",
     taken<&dem::LayerStress::depth>},
    {"ratio", "1", "stress over weight", "vertical contact stress over the weight above",
     taken<&dem::LayerStress::ratio>},
    {"after_event_ratio", "1", "stress over weight just after an event",
     "the ratio in the first 0.5 m of extension after sediment has compacted",
     taken<&dem::LayerStress::after_event_ratio>},
    {"damping_share", "1", "weight held by damping",
     "vertical force of local damping on the discs above, over their weight",
     taken<&dem::LayerStress::damping_share>},
};

std::optional<std::vector<NamedNumbers>> stress_profile(const Observation& now) {
    const auto* stress = stress_in(now);
    if (!stress)
        return std::nullopt;
    std::vector<NamedNumbers> layers;
    for (const dem::LayerStress& layer : stress->profile()) {
        NamedNumbers& numbers = layers.emplace_back();
        for (const auto& measure : of_layer)
            if (const auto value = measure.value(layer))
                numbers.emplace_back(measure.name, *value);
    }
    return layers;
}

std::vector<Measure<Observation>> measures() {
    return {{"deposited_fraction", "1", "sediment laid down over rock at the start",
             "mass that sedimentation deposited, over the initial mass",
             [](const Observation& now) -> std::optional<double> {
                 return now.state.ledger.deposited / now.state.ledger.initial;
             }},
            {"eroded_fraction", "1", "rock and sediment eroded over rock at the start",
             "mass that sedimentation eroded, over the initial mass",
             [](const Observation& now) -> std::optional<double> {
                 return now.state.ledger.removed / now.state.ledger.initial;
             }},
            {sediment_stress_ratio, "1", "stress in the sediment over the weight above",
             "vertical contact stress in the sediment over the weight above, time mean of the last "
             "window: mean over the layers of `sediment_stress_profile`. 1: sediment carries its "
             "weight",
             mean_of_layers<&dem::LayerStress::ratio>, OverTime::last,
             "0.96 to 1.12 in lis1 at standard"},
            {"sediment_damping_share", "1", "sediment's weight held by damping",
             "vertical force of local damping on the sediment over its weight, time mean of the "
             "last window: mean over the layers of `sediment_stress_profile`. Above 0: damping "
             "holds it up",
             mean_of_layers<&dem::LayerStress::damping_share>, OverTime::last}};
}

std::vector<MeasuredObjects> objects() {
    MeasuredObjects profile{
        "sediment_stress_profile",
        "",
        "stress in the sediment over the weight above, by depth",
        "vertical contact stress over the weight above, in layers 1 to 7 km below the surface",
        {},
        stress_profile};
    for (const auto& measure : of_layer)
        profile.parts.push_back(measure.quantity());
    return {profile};
}

} // namespace

Works works() { return {}; }

const Effect& effect() {
    static const Effect effect{
        .name = "sedimentation",
        .doc = "adapts the surface to a target: deposits below, erodes above",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters = parameters(),
        .files = {{"target_csv",
                   "file with the target line: columns time_a, x_m, y_m; linear between times",
                   "Stands in place of target.",
                   [](Scene& scene, const std::string& file, const Refuse& refuse) {
                       P& p = *scene.find<P>();
                       if (!p.target.empty())
                           refuse("sedimentation.target_csv",
                                  "beside sedimentation.target; give one of them");
                       p.target = read_target_csv(scene, file);
                   }}},
        .rock =
            RockSource{
                .key = "sediment",
                .file = "sediment",
                .doc =
                    "material, by name or path, with the defaults of sediment discs in "
                    "[sedimentation]; if it has [pores], also of how pores close and water flows",
                .changes = "Sets stiffness and friction of sediment at once; mud, silt and sand "
                           "also how their pores close and water flows.",
                .take =
                    [](Scene& scene, const RockMaterial& rock) {
                        take_microproperties(scene.find<P>()->material, rock);
                        if (rock.pores)
                            scene.find<P>()->surface_porosity = rock.pores->surface_porosity;
                    },
            },
        .check = check,
        .contribute =
            [](const Scene& scene, ModelParts& parts) {
                const P& p = *scene.find<P>();
                parts.materials[dem::sediment] = p.material;
                parts.sediment = {p.level,
                                  dem::Target(p.level, p.target),
                                  p.surface_porosity,
                                  p.grain_density,
                                  disc_density(p),
                                  {},
                                  0.0,
                                  p.interval,
                                  {},
                                  {},
                                  {}};
            },
        .add_events = add_events,
        .absence = {"sediment in the basin", "-61 % where a saturated fill comes, at Te 10 km"},
        .lacks = {{"limits to the supply of sediment, and ways of what is eroded",
                   "+156 % where none comes, at Te 10 km"}},
        .price = price,
        .new_area = new_area,
        .measures = measures(),
        .objects = objects(),
    };
    return effect;
}

} // namespace listric::effects::sedimentation
