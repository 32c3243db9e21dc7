#include "dem/events/fault_weakening.hpp"

#include "apps/model/measure_names.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/support/words/spelling.hpp"
#include "dem/contacts/soft_discs.hpp"
#include "dem/events/property_update.hpp"
#include "dem/numbers/round_off.hpp"

#include "apps/model/effect_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace listric::effects::fault_weakening {

namespace {

using P = dem::FaultWeakeningParameters;

std::vector<Parameter> detection_parameters() {
    return {
        by_travel({"interval_a", at<&P::interval>, "a", ranges::interval, "Delta t_w",
                   "time between scans for faults",
                   "Raising it finds faults later, and slower ones, which have longer to slip."}),
        {"least_slip_m", at<&P::least_slip>, "m", ranges::length, "d_cw",
         "least slip of a fault between scans",
         "Raising it leaves slow zones unweakened: less rock is weakened, sediment away from "
         "faults most of all, and strain is more localised.",
         between(43.4, 62)},
        {"strain_rate_per_s", at<&P::strain_rate>, "1/s", between(0, ranges::strain_rate.to),
         "eps_cw",
         "least shear strain rate in the measure circle, in place of the least slip if not 0",
         "Makes the least slip proportional to the disc size: large discs then have no faults.",
         between(0, 1e-13)},
        {"circle_diameters", at<&P::circle_diameters>, "", between(2, 100), "",
         "diameter of the measure circle, in mean disc diameters",
         "Raising it averages over more discs and finds fewer, longer segments."},
        {"spacing_diameters", at<&P::spacing_diameters>, "", between(0, 1e3), "l_csp",
         "least distance to a more active fault, in mean disc diameters",
         "Lowering it lets bands lie side by side, so that wide zones are weakened as a whole.",
         between(2.5, 5)},
        {"band_diameters", at<&P::band_diameters>, "", between(0.01, 100), "",
         "width of the weakened band, in mean disc diameters",
         "Raising it widens faults; with the contacts to both sides a zone is one diameter wider."},
        {"sound_share", at<&P::sound_share>, "", between(0, 1), "",
         "least share of sound discs in a band that is weakened",
         "Lowering it weakens again beside and along faults that are known, and widens them."},
        {"angles", at<&P::angles>, "", between(2, 360), "",
         "number of fault angles tried at each sampling point",
         "Raising it resolves dips better than 15 degrees and makes scans longer."},
        by_travel(
            {"youngest_sediment_a", at<&P::youngest_sediment>, "a", between(0, ranges::interval.to),
             "", "age below which sediment is not scanned, since it is loose",
             "Lowering it weakens loose sediment all over, where it deforms without faults."}),
        {"whole_domain", at<&P::whole_domain>, "", ranges::any, "",
         "whether young and loose sediment is scanned, too",
         "true is the paper's way; it finds the base of loose sediment as a fault."},
        {"heal_after_a", at<&P::heal_after>, "a", between(0, 1e9), "",
         "time at rest after which weakened rock is sound again; 0: never",
         "Makes faults at rest strong again, so that new ones can replace them.", between(0, 5e5)},
        by_travel(
            {"resting_rate_per_s", at<&P::resting_rate>, "1/s", ranges::strain_rate, "",
             "shear strain rate below which weakened rock rests",
             "Raising it heals weakened rock that still creeps: the bulk of it strains faster than "
             "1e-14/s.",
             between(1e-15, 1e-14)}),
    };
}

std::vector<Parameter> weakened_parameters() {
    using dem::Material;
    return {
        {"normal_stiffness_pa", at<&P::material, &Material::normal_stiffness>, "Pa",
         ranges::stiffness, "k_n", "normal stiffness of one weakened disc",
         "Raising it keeps discs from overlapping, and makes fault zones wider.",
         between(8.5e8, 1.7e10)},
        {"shear_stiffness_pa", at<&P::material, &Material::shear_stiffness>, "Pa",
         ranges::stiffness, "k_s", "shear stiffness of one weakened disc",
         "Belongs to the normal stiffness: the shipped rocks keep the ratio 2.66.",
         between(3.19e8, 6.4e9)},
        {"friction", at<&P::material, &Material::friction>, "", ranges::friction, "mu_d",
         "friction of weakened discs",
         "Raising it from 0 to 0.2 lets deformation leave an old graben for a new one; 0.06 less "
         "of the strain stays in the most strained tenth.",
         between(0, 0.5)},
        {"rolling_friction", at<&P::material, &Material::rolling_friction>, "", ranges::friction,
         "mu_r", "resistance of weakened discs to rolling",
         "Has an effect with friction, which it cannot exceed."},
        by_travel({"update_interval_a", at<&P::update_interval>, "a", ranges::interval, "",
                   "time between property updates",
                   "Lowering it keeps the volume of weak zones better (volume_error_fraction)."}),
        {"mean_stress_ratio", at<&P::mean_stress_ratio>, "", between(0.01, 2), "",
         "mean stress in a fault over the weight above it",
         "Raising it makes weakened discs larger at once; the property update corrects the rest."},
        {"shortening_mean_stress_ratio", at<&P::shortening_mean_stress_ratio>, "", between(0.01, 4),
         "",
         "mean stress in a fault over the weight above it, while a [[stage]] "
         "shortens",
         "Raising it makes weakened discs larger in the first steps of the way back; the property "
         "update corrects the rest."},
        {"largest_change", at<&P::largest_change>, "", between(1e-4, 0.5), "",
         "largest relative change of a radius per property update",
         "Lowering it slows the correction of the volume of weak zones."},
    };
}

std::vector<Parameter> parameters() {
    std::vector<Parameter> all = detection_parameters();
    std::ranges::move(weakened_parameters(), std::back_inserter(all));
    return all;
}

void add_events(const Scene& scene, const ModelParts& parts, dem::Events& events) {
    const P& p = *scene.find<P>();
    const dem::Calendar calendar = make_calendar(scene);
    const double gravity = parts.physics.gravity;
    dem::add(events, std::make_unique<dem::PropertyUpdate>(p, calendar, gravity));
    dem::add(events, std::make_unique<dem::FaultWeakening>(p, calendar, gravity));
}

/// The slowest motion of a scene's wall.
struct SlowestMotion {
    double rate; ///< m/a
    std::string words;
};

SlowestMotion slowest_motion(const Scene& scene) {
    SlowestMotion slowest{scene.extension.rate, text(scene.extension.rate) + " m/a"};
    const std::vector<dem::MotionStage> stages = make_motion(scene).stages;
    for (std::size_t k = 0; k < stages.size(); ++k) {
        const double rate =
            dem::without_round_off(scene.extension.rate * std::abs(stages[k].slope));
        if (rate > 0.0 && rate < slowest.rate)
            slowest = {rate, fmt::format("{} m/a of stage[{}]", text(rate), k)};
    }
    return slowest;
}

/// A fault takes a share of the wall's way between two scans: where that must be more than a
/// quarter, few are found (docs/guides/choosing.md).
std::string warning(const Scene& scene) {
    constexpr double least_ways = 4.0;
    const P& p = *scene.find<P>();
    const double slip = dem::critical_slip(p, 2.0 * scene.hanging_wall.mean_radius);
    const SlowestMotion slowest = slowest_motion(scene);
    const double way = dem::Schedule(p.interval, slowest.rate).spacing();
    if (way >= least_ways * slip)
        return "";
    const std::string default_helps =
        slowest.rate < scene.extension.rate || p.strain_rate > 0.0
            ? ""
            : fmt::format("; left out, it is {}",
                          text(at_rate(detection_parameters().front(), P{}.interval,
                                       scene.extension.rate)));
    return fmt::format(
        "fault_weakening.interval_a = {}: at {} the wall moves by {:.3g} m between scans, in which "
        "a fault must slip by {:.3g} m: few faults are found, or none; from {:.0f} a on the wall "
        "moves by {:g} times that slip{}",
        text(p.interval), slowest.words, way, slip,
        std::ceil(dem::without_round_off(least_ways * slip / slowest.rate)), least_ways,
        default_helps);
}

/// Definition of a fault, in metres and as a rate.
std::string explain(const Scene& scene, EffectList) {
    const P& p = *scene.find<P>();
    const double diameter = 2.0 * scene.hanging_wall.mean_radius;
    return fmt::format(
        "fault detection\n"
        "  a fault slips by at least {:.3g} m in {:g} a, {:.4g} m of travel: a shear "
        "strain rate of {:.2g}/s in its circle of {:.0f} m\n",
        dem::critical_slip(p, diameter), p.interval,
        dem::Schedule(p.interval, scene.extension.rate).spacing(), dem::critical_rate(p, diameter),
        p.circle_diameters * diameter);
}

/// Over the hanging wall's area at the start; nothing is told once there is more sediment.
std::optional<double> volume_error_of(const Observation& now) {
    const dem::Ledger& ledger = now.state.ledger;
    if (ledger.deposited - ledger.removed > ledger.initial)
        return std::nullopt;
    return std::abs(dem::weakened_volume_change(now.state, now.parts.base)) /
           dem::hanging_wall_area(now.scene.hanging_wall, base_line(now.parts.base, 0.0));
}

std::vector<Measure<Observation>> measures() {
    return {{weak_fraction, "1", "weakened share of discs",
             "share of discs weakened by fault detection",
             [](const Observation& now) -> std::optional<double> {
                 const auto material = dem::disc_columns(now.state).material;
                 const auto weak = std::ranges::count_if(material, [&](std::uint8_t m) {
                     return dem::is_weak(now.state.materials, m);
                 });
                 return static_cast<double>(weak) / static_cast<double>(material.size());
             }},
            {volume_error_fraction, "1", "error of volume",
             "power-cell area of the weakened discs less their area before weakening, over the "
             "hanging wall's area; ends where there is more sediment than rock",
             volume_error_of, OverTime::last, "below 0.001"}};
}

std::vector<double> weak_discs(const Observation& now) {
    std::vector<double> weak;
    for (const std::uint8_t material : dem::disc_columns(now.state).material)
        weak.push_back(dem::is_weak(now.state.materials, material) ? 1.0 : 0.0);
    return weak;
}

} // namespace

Works works() { return {}; }

const Effect& effect() {
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
                .file = "mat18-w-frictional",
                .doc = "material, by name or path, with the defaults of weakened discs in "
                       "[fault_weakening]; [bonds] of it are not used, weakened rock has none",
                .changes = "Sets how strong faults are: friction between their discs decides "
                           "whether a graben keeps all of the extension.",
                .take =
                    [](Scene& scene, const RockMaterial& rock) {
                        take_microproperties(scene.find<P>()->material, rock);
                    },
                .former = "mat18-w",
                .plural = "faults",
                .remark =
                    [](const Scene& scene) {
                        return fmt::format("friction {:g}", scene.find<P>()->material.friction);
                    },
            },
        .warning = warning,
        .contribute =
            [](const Scene& scene, ModelParts& parts) {
                const P& p = *scene.find<P>();
                parts.materials[dem::weak] = p.material;
                parts.youngest_sediment =
                    dem::Schedule(p.youngest_sediment, scene.extension.rate).spacing();
                parts.detection_circle = p.circle_diameters;
            },
        .add_events = add_events,
        .explain = explain,
        .price =
            [](const Scene& scene, const Workload& work) {
                const P& p = *scene.find<P>();
                return work.applications(p.interval) * 330.0 * work.discs +
                       work.applications(p.update_interval) * 18.0 * work.discs;
            },
        .measures = measures(),
        .layers = {{"weak", LayerKind::discs, "weakened", "#e9a59a", weak_discs}},
    };
    return effect;
}

} // namespace listric::effects::fault_weakening
