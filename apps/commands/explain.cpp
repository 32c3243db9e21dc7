#include "apps/commands/explain.hpp"

#include "apps/archive/tables/rock_record.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/base_words.hpp"
#include "apps/scene/parameters/flat_base.hpp"
#include "apps/scene/parameters/stage.hpp"

#include "dem/cycle_physics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace listric {

using namespace dem;

std::string duration(double seconds) {
    if (seconds < 90.0)
        return fmt::format("{:.0f} s", seconds);
    if (seconds < 5400.0)
        return fmt::format("{:.1f} min", seconds / 60.0);
    if (seconds < 2 * 86400.0)
        return fmt::format("{:.1f} h", seconds / 3600.0);
    return fmt::format("{:.1f} d", seconds / 86400.0);
}

std::string size_text(double bytes) {
    return bytes < 1e9 ? fmt::format("{:.0f} MB", std::ceil(bytes / 1e6))
                       : fmt::format("{:.3g} GB", bytes / 1e9);
}

std::string output_text(const Prediction& prediction) {
    return fmt::format("{:.0f} snapshots, {} of disk", prediction.snapshots,
                       size_text(prediction.disk));
}

namespace {

std::string explain_effects(const Scene& scene, EffectList effects) {
    std::string text = "effects\n";
    for (const Effect* effect : effects)
        text += fmt::format("  {:<4} {:<20} {}\n", has_effect(scene, effect->name) ? "on" : "off",
                            effect->name, effect->doc);
    return text + "\n";
}

/// Materials whose stiffness sets the time step: "rock and sediment".
std::string stiffest(const Scene& scene) {
    const ModelParts parts = make_parts(scene);
    std::vector<std::pair<std::string, double>> found{
        {"rock", stable_time_step(1.0, parts.materials[basement], 0.0, 1.0)}};
    if (parts.sediment)
        found.emplace_back("sediment", stable_time_step(1.0, parts.materials[sediment], 0.0, 1.0));
    for (const LayerFacts& layer : parts.layers)
        found.emplace_back("layer " + layer.name,
                           stable_time_step(1.0, parts.materials[layer.material], 0.0, 1.0));
    const double least =
        std::ranges::min(found, {}, &std::pair<std::string, double>::second).second;
    std::vector<std::string> names;
    for (const auto& [name, step] : found)
        if (step == least)
            names.push_back(name);
    return fmt::format("{}", fmt::join(names, " and "));
}

/// What another softness would make of the cycles.
std::string explain_softness(const Scene& scene, const Prediction& p) {
    const double softness = scene.cycle.softness;
    return softness == 1.0
               ? fmt::format("  with cycle.softness = 4 {:.3g} million cycles\n", p.cycles / 2e6)
               : fmt::format("  with cycle.softness = 1 {:.3g} million cycles\n",
                             p.cycles * std::sqrt(softness) / 1e6);
}

std::string explain_size(const Scene& scene, const Prediction& p) {
    const ExtensionParameters& extension = scene.extension;
    const double extends = greatest_extension(scene); // less than the way where there are stages
    const bool counts_slip = !scene.detachment && !scene.stretching && basement_fault(scene);
    const char* const what = counts_slip ? "slip" : "extension";
    const std::string way = extends == extension.distance
                                ? fmt::format("{:g} km of {}", extends / 1e3, what)
                                : fmt::format("{:g} km of {}, {:g} km of travel", extends / 1e3,
                                              what, extension.distance / 1e3);
    const std::string fitted =
        scene.picked_fault ? fmt::format("  {}\n", describe(*scene.picked_fault, *scene.detachment))
                           : "";
    return fmt::format("size\n{}"
                       "  {} discs at the start, about {} at the end, mean radius {} m\n"
                       "  {} at {} m/a: {:g} Myr\n"
                       "  time step {:.3g} s, set by {}, {:.3g} million cycles at {} m/s\n"
                       "{}"
                       "  {:.2g} disc-steps, about {:.0f} MB of memory\n"
                       "  {}, one every {} m\n\n",
                       fitted, p.discs_at_start, p.discs_at_end, scene.hanging_wall.mean_radius,
                       way, extension.rate, end_age(scene) / 1e6, p.time_step, stiffest(scene),
                       p.cycles / 1e6, extension.speed, explain_softness(scene, p), p.disc_steps,
                       p.memory / 1e6, output_text(p), scene.output.interval);
}

/// What moves with the right wall, and what resists it.
std::string explain_base(const Scene& scene) {
    const double friction = scene.detachment ? scene.detachment->friction : base_friction(scene);
    return fmt::format("base\n  {}\n  friction {:g}, of which ramp_mobilised_friction and "
                       "flat_mobilised_friction tell what is used\n\n",
                       base_words(scene), friction);
}

/// Intervals that are other ways of the wall than their defaults.
std::string explain_intervals(const Scene& scene) {
    std::string text;
    for (const EffectPart& part : scene.effects) {
        std::any defaults = defaults_of(*part.effect);
        for (const Parameter& parameter : part.effect->parameters) {
            if (!parameter.follows_rate || parameter.unit != "a")
                continue;
            const auto& place = std::get<Place<double>>(parameter.value);
            const double years = place.get(part.effect->address.get(part.parameters));
            const double metres = Schedule(years, scene.extension.rate).spacing();
            const double usual =
                Schedule(place.get(object_of(*part.effect, defaults)), usual_rate).spacing();
            if (metres != usual)
                text += fmt::format("  {}.{}: {:g} a are {:g} m of travel, by default {:g} m\n",
                                    part.effect->name, parameter.key, years, metres, usual);
        }
    }
    return text.empty() ? "" : fmt::format("intervals that are stated\n{}\n", text);
}

/// Lines of the effects on themselves; an effect speaks for those that need it.
std::string explain_parts(const Scene& scene, EffectList effects) {
    std::string text;
    for (const EffectPart& part : scene.effects)
        if (part.effect->explain && !part.effect->load_footwall)
            text += part.effect->explain(scene, effects) + "\n";
    return text;
}

/// Discs, cycles and time at every accuracy, and of this call.
std::string explain_cost(const Scene& scene, const Prediction& p, const CycleSpeed& speed,
                         int threads) {
    std::string text = fmt::format(
        "on this machine when nothing else runs, {} {} ({:.0f} million disc-steps per second)\n"
        "  {:<10} {:>10} {:>9} {:>12} {:>9}\n",
        threads, threads == 1 ? "thread" : "threads", speed.team / 1e6, "accuracy", "radius, m",
        "discs", "cycles", "time");
    for (const AccuracyLevel& level : accuracy_levels()) {
        const Prediction q = predict(at_level(scene, level), speed);
        text += fmt::format("  {:<10} {:>10.4g} {:>9} {:>12.0f} {:>9}{}\n", level.name,
                            level.mean_radius, q.discs_at_start, q.cycles, duration(q.seconds),
                            level.mean_radius == scene.hanging_wall.mean_radius ? "   <- this call"
                                                                                : "");
    }
    const std::string busy = speed.busy > 1.15 ? fmt::format("; {} while other programs run as now",
                                                             duration(speed.busy * p.seconds))
                                               : "";
    return text + fmt::format("  this call: {}{}\n\n", duration(p.seconds), busy);
}

} // namespace

std::string explain(const Scene& scene, int threads, EffectList effects) {
    const CycleSpeed speed =
        measure_speed(estimated_discs(scene), threads, 0.5, make_parts(scene).accounts_energy);
    return explain(scene, speed, threads, effects);
}

std::string explain(const Scene& scene, const CycleSpeed& speed, int threads, EffectList effects) {
    const Prediction p = predict(scene, speed);
    return fmt::format("{}: {}\n\n{}\n\n", scene.name, scene.description,
                       rock_line(scene, archive::known_rocks(scene))) +
           explain_effects(scene, effects) + explain_size(scene, p) + explain_base(scene) +
           explain_intervals(scene) + explain_parts(scene, effects) +
           explain_cost(scene, p, speed, threads) +
           "accuracy, from runs of lis1: rotation, cutoff and basin area are right at draft (1 "
           "%);\n"
           "faults are as narrow as three discs, so their number and place want standard or "
           "finer.\n";
}

} // namespace listric
