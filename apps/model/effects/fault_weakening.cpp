#include "dem/events/fault_weakening.hpp"

#include "apps/model/measure_names.hpp"
#include "dem/events/property_update.hpp"

#include "apps/model/effect_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace listric::effects {

namespace {

using P = dem::FaultWeakeningParameters;

std::vector<Parameter> parameters() {
    using dem::Material;
    return {
        {"interval_a", at<&P::interval>, "a", ranges::years, "Delta t_w",
         "time between scans for faults"},
        {"least_slip_m", at<&P::least_slip>, "m", ranges::length, "d_cw",
         "least slip of a fault between scans"},
        {"strain_rate_per_s",
         at<&P::strain_rate>,
         "1/s",
         {.from = 0, .to = ranges::strain_rate.to},
         "eps_cw",
         "if not 0, in place of the least slip: least shear strain rate in the measure circle"},
        {"circle_diameters",
         at<&P::circle_diameters>,
         "",
         {.from = 2, .to = 100},
         "",
         "diameter of the measure circle, in mean disc diameters"},
        {"spacing_diameters",
         at<&P::spacing_diameters>,
         "",
         {.from = 0, .to = 1e3},
         "l_csp",
         "least distance to a more active fault, in mean disc diameters"},
        {"band_diameters",
         at<&P::band_diameters>,
         "",
         {.from = 0.01, .to = 100},
         "",
         "width of the weakened band, in mean disc diameters"},
        {"sound_share",
         at<&P::sound_share>,
         "",
         {.from = 0, .to = 1},
         "",
         "least share of sound discs in a band that is weakened"},
        {"angles",
         at<&P::angles>,
         "",
         {.from = 2, .to = 360},
         "",
         "fault angles tried at each sampling point"},
        {"youngest_sediment_a",
         at<&P::youngest_sediment>,
         "a",
         {.from = 0, .to = 1e9},
         "",
         "sediment younger than this is left alone, as loose sediment is"},
        {"whole_domain", at<&P::whole_domain>, "", {}, "", "look at young and loose sediment, too"},
        {"normal_stiffness_pa", at<&P::material, &Material::normal_stiffness>, "Pa",
         ranges::stiffness, "k_n", "normal stiffness of one weakened disc"},
        {"shear_stiffness_pa", at<&P::material, &Material::shear_stiffness>, "Pa",
         ranges::stiffness, "k_s", "shear stiffness of one weakened disc"},
        {"friction", at<&P::material, &Material::friction>, "", ranges::friction, "mu_d",
         "of weakened discs"},
        {"update_interval_a", at<&P::update_interval>, "a", ranges::years, "",
         "time between property updates"},
        {"mean_stress_ratio",
         at<&P::mean_stress_ratio>,
         "",
         {.from = 0.01, .to = 2},
         "",
         "mean stress in a fault over the weight above it"},
        {"largest_change",
         at<&P::largest_change>,
         "",
         {.from = 1e-4, .to = 0.5},
         "",
         "largest relative change of a radius per property update"},
    };
}

std::vector<StagedEvent> make_events(const Scene& scene, const ModelParts& parts,
                                     std::span<const StagedEvent>) {
    const P& p = *scene.find<P>();
    const double rate = scene.extension.rate, gravity = parts.physics.gravity;
    std::vector<StagedEvent> events;
    events.push_back({EventStage::adjust, std::make_unique<dem::PropertyUpdate>(p, rate, gravity)});
    events.push_back({EventStage::weaken, std::make_unique<dem::FaultWeakening>(p, rate, gravity)});
    return events;
}

/// What is a fault, in metres and as a rate.
std::string explain(const Scene& scene, EffectList) {
    const P& p = *scene.find<P>();
    const double diameter = 2.0 * scene.hanging_wall->mean_radius;
    return fmt::format("fault detection\n"
                       "  a fault slips by at least {:.3g} m in {:g} a: a shear strain rate of "
                       "{:.2g}/s in its circle of {:.0f} m\n",
                       dem::critical_slip(p, diameter), p.interval, dem::critical_rate(p, diameter),
                       p.circle_diameters * diameter);
}

/// Over the hanging wall's area at the start, of which nothing is told once there is more sediment.
std::optional<double> volume_error(const Observation& now) {
    const dem::Ledger& ledger = now.state.ledger;
    if (ledger.deposited - ledger.removed > ledger.initial)
        return std::nullopt;
    return std::abs(dem::weakened_volume_change(now.state, now.parts.base)) /
           dem::hanging_wall_area(*now.scene.hanging_wall, now.parts.base.surfaces.front().chain);
}

std::vector<Measure<Observation>> measures() {
    return {{weak_fraction, "1", "share of discs weakened by fault detection",
             [](const Observation& now) -> std::optional<double> {
                 const auto material = dem::disc_columns(now.state).material;
                 return static_cast<double>(std::ranges::count(material, dem::weak)) /
                        static_cast<double>(material.size());
             }},
            {"volume_error_fraction", "1",
             "power-cell area of the weakened discs less what it was before weakening, over the "
             "hanging wall's area; ends where there is more sediment than rock",
             volume_error}};
}

std::vector<double> weak_discs(const Observation& now) {
    std::vector<double> weak;
    for (const std::uint8_t material : dem::disc_columns(now.state).material)
        weak.push_back(material == dem::weak ? 1.0 : 0.0);
    return weak;
}

} // namespace

Works fault_weakening_works() { return {}; }

const Effect& fault_weakening() {
    static const Effect effect{
        .name = "fault_weakening",
        .doc = "automatic fault detection (AFD) with its property update",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters = parameters(),
        .former = {{"strained_width", "least_slip_m, the slip of a fault itself"}},
        .rock =
            RockSource{
                .key = "weakened",
                .file = "mat18-w",
                .doc = "material file with the defaults of weakened discs in [fault_weakening]",
                .take =
                    [](Scene& scene, const RockMaterial& rock) {
                        take_microproperties(scene.find<P>()->material, rock);
                    },
            },
        .contribute =
            [](const Scene& scene, ModelParts& parts) {
                const P& p = *scene.find<P>();
                parts.materials[dem::weak] = p.material;
                parts.youngest_sediment = p.youngest_sediment;
                parts.detection_circle = p.circle_diameters;
            },
        .make_events = make_events,
        .explain = explain,
        .price =
            [](const Scene& scene, const Workload& work) {
                const P& p = *scene.find<P>();
                return work.years / p.interval * 330.0 * work.discs +
                       work.years / p.update_interval * 18.0 * work.discs;
            },
        .measures = measures(),
        .layers = {{"weak", LayerKind::discs, "weakened", "#e9a59a", weak_discs}},
    };
    return effect;
}

} // namespace listric::effects
