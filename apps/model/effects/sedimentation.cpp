#include "dem/events/sedimentation.hpp"
#include "dem/events/sediment_stress.hpp"

#include "apps/scene/effect.hpp"
#include "apps/scene/target_csv.hpp"
#include "apps/support/spelling.hpp"
#include "dem/genesis/genesis.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric::effects {

const Effect& sedimentation();

namespace {

using P = dem::SedimentationParameters;

std::vector<Parameter> parameters() {
    using dem::Material;
    return {
        {"interval_a", at<&P::interval>, "a", ranges::years, "Delta t_s",
         "time between sedimentations"},
        {"level_m", at<&P::level>, "m", ranges::height, "",
         "of the target, above the original surface, where no target line is given"},
        {"target", at<&P::target>, "", ranges::height, "",
         "target line: points [x, y] in m, or stages {time_a, points}; fills below, erodes above"},
        {"surface_porosity",
         at<&P::surface_porosity>,
         "",
         {.from = 0, .to = 0.9},
         "Phi_ini",
         "porosity of fresh sediment"},
        {"grain_density_kg_per_m3", at<&P::grain_density>, "kg/m3", ranges::density, "",
         "density of sediment at zero porosity"},
        {"normal_stiffness_pa", at<&P::material, &Material::normal_stiffness>, "Pa",
         ranges::stiffness, "k_n", "normal stiffness of one sediment disc"},
        {"shear_stiffness_pa", at<&P::material, &Material::shear_stiffness>, "Pa",
         ranges::stiffness, "k_s", "shear stiffness of one sediment disc"},
        {"friction", at<&P::material, &Material::friction>, "", ranges::friction, "mu_d",
         "of sediment discs"},
    };
}

/// The event that deposits and, where sediment weighs, the one that looks at what carries it.
std::vector<StagedEvent> make_events(const Scene& scene, const ModelParts& parts,
                                     std::span<const StagedEvent>) {
    const double rate = scene.extension.rate;
    std::vector<StagedEvent> events;
    events.push_back(
        {EventStage::deposit, std::make_unique<dem::Sedimentation>(
                                  *scene.find<P>(), scene.hanging_wall->radius_ratio, rate)});
    if (parts.physics.gravity <= 0.0)
        return events;
    std::optional<double> between_changes; // of porosity, m of extension
    if (parts.sediment->porosity_decay)
        between_changes = parts.sediment->porosity_interval * rate;
    events.push_back({EventStage::sample,
                      std::make_unique<dem::SedimentStress>(scene.output.interval, between_changes,
                                                            rate, parts.physics)});
    return events;
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
    const double width = scene.hanging_wall->length + scene.extension.distance;
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
    return 1.1 * scene.extension.distance * scene.hanging_wall->thickness +
           area_above_surface(scene);
}

/// Looking for room, and laying down a heap whose columns are looked through for every disc.
double price(const Scene& scene, const Workload& work) {
    constexpr double of_a_heaped_disc = 2e5;
    return work.years / scene.find<P>()->interval * (6e6 + 480.0 * work.discs) +
           of_a_heaped_disc *
               static_cast<double>(dem::disc_count(*scene.hanging_wall, area_above_surface(scene)));
}

/// Refuses a target that leaves nothing of the hanging wall.
void check(const Scene& scene, const Refuse& refuse) {
    const P& p = *scene.find<P>();
    const double thickness = scene.hanging_wall->thickness;
    double lowest = 1e300; // of the highest points of all lines
    for (const dem::TargetLine& line : lines_of(p))
        lowest = std::min(lowest, std::ranges::max(line.points(), {}, &dem::Point::y).y);
    if (lowest <= -thickness)
        refuse(
            p.target.empty() ? "sedimentation.level_m" : "sedimentation.target",
            fmt::format("is {} at its highest, below the whole hanging wall, which erosion would "
                        "take away; allowed: above {}, its base",
                        text(lowest), text(-thickness)));
}

EffectMeasures measure(const Observation& now) {
    const dem::Ledger& ledger = now.state.ledger;
    EffectMeasures measures{.numbers = {{"deposited_fraction", ledger.deposited / ledger.initial},
                                        {"eroded_fraction", ledger.removed / ledger.initial}}};
    const auto* stress = dem::find<const dem::SedimentStress>(now.events);
    if (!stress)
        return measures;
    double sum = 0.0; // not a number without layers
    std::vector<NamedNumbers> layers;
    for (const dem::LayerStress& layer : stress->profile()) {
        sum += layer.ratio;
        NamedNumbers& numbers = layers.emplace_back();
        numbers = {{"depth_m", layer.depth}, {"ratio", layer.ratio}};
        if (layer.after_event_ratio)
            numbers.emplace_back("after_event_ratio", *layer.after_event_ratio);
        numbers.emplace_back("damping_share", layer.damping_share);
    }
    measures.numbers.emplace_back("sediment_stress_ratio",
                                  sum / static_cast<double>(layers.size()));
    measures.lists.emplace_back("sediment_stress_profile", std::move(layers));
    return measures;
}

} // namespace

const Effect& sedimentation() {
    static const Effect effect{
        .name = "sedimentation",
        .doc = "adapts the surface to a target: deposits below, erodes above",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters = parameters(),
        .files = {{"target_csv",
                   "file with the target line: columns time_a, x_m, y_m; linear between times",
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
                .doc = "material file with the defaults of sediment discs in [sedimentation]",
                .take =
                    [](Scene& scene, const RockMaterial& rock) {
                        take_microproperties(scene.find<P>()->material, rock);
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
                                  {}};
            },
        .make_events = make_events,
        .price = price,
        .new_area = new_area,
        .measure = measure,
    };
    return effect;
}

} // namespace listric::effects
