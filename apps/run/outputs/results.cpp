#include "apps/run/results.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/measures/basin/profile.hpp"
#include "apps/run/forecast/prediction.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/scene/parameters/accuracy.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace listric {

using namespace measures;

namespace {

/// Results of a run, a line each.
std::vector<std::string> results_of(RunView& run) {
    const Profile profile = measure_profile(run.setting, run.state(), run.parts.base);
    const std::vector<double> depth = smoothed_depth(profile);
    Results results{.measures = run.measured(),
                    .faults = run.faults(),
                    .quality = archive::quality_checks(
                        parse_json(run.summary), {.base_moves = run.parts.base_moves,
                                                  .mean_radius = run.state().mean_radius,
                                                  .base_friction = base_friction(run.scene)})};
    if (!depth.empty())
        results.basin_depth = std::ranges::max(depth);
    return result_lines(results);
}

/// The call to make next where draft, which traces few faults, has traced none; empty: another.
std::string advice_on_faults(RunView& run) {
    const Scene& scene = run.scene;
    if (scene.accuracy != "draft" || !run.parts.detection_circle || !run.faults().faults.empty() ||
        scene.hanging_wall.mean_radius != accuracy_level("draft").mean_radius)
        return {};
    const Scene finer = at_level(scene, accuracy_level("standard"));
    return fmt::format(
        "draft traces few faults: run it with --accuracy standard, about {}",
        rough_duration(predict(finer).work / predict(scene).work * run.wall_seconds()));
}

/// The best view of them that there is.
std::string place_to_look(const RunView& run) {
    std::error_code error;
    for (const char* name : {"report.html", "figures"})
        if (const auto path = run.options.output / name; std::filesystem::exists(path, error))
            return path.string();
    return run.options.output.string();
}

void say(RunView& run) {
    run.log.say(
        fmt::format("done: {} in {}", run.place_text(), rough_duration(run.wall_seconds())));
    for (const std::string& line : results_of(run))
        run.log.say("  " + line);
    run.log.repeat_warnings();
    run.log.say("look: " + place_to_look(run));
    if (const std::string advice = advice_on_faults(run); !advice.empty())
        run.log.say(advice);
}

} // namespace

std::optional<Output> outputs::results(const RunView&) { return Output{.close = say}; }

} // namespace listric
