#include "dem/events/sedimentation.hpp"
#include "dem/events/sediment_stress.hpp"

#include "apps/scene/effect.hpp"
#include "apps/scene/target_csv.hpp"

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
        .price =
            [](const Scene& scene, const Workload& work) {
                return work.years / scene.find<P>()->interval * (6e6 + 480.0 * work.discs);
            },
        // Fills distance times thickness, and small discs fill up to the target.
        .new_area =
            [](const Scene& scene) {
                return 1.1 * scene.extension.distance * scene.hanging_wall->thickness;
            },
        .measure = measure,
    };
    return effect;
}

} // namespace listric::effects
