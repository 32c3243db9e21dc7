#include "apps/run/run.hpp"
#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/oversize.hpp"

#include <memory>
#include <optional>

namespace listric {

namespace {

struct RunCall {
    SceneRequest scene;
    RunOptions options;
    std::optional<std::string> until;
    std::string output;
    bool force_size = false;
    bool no_report = false;
};

/// "5km", "5000m" or "5000" in metres.
double parse_length(const std::string& text) {
    std::size_t used = 0;
    double value = 0.0;
    try {
        value = std::stod(text, &used);
    } catch (const std::exception&) {
        used = 0;
    }
    const std::string unit = text.substr(used);
    if (used == 0 || !(unit.empty() || unit == "m" || unit == "km") || !(value >= 0.0) ||
        value > 1e7)
        throw UsageError("--until " + text + ": a length of at least 0, such as 5km or 500m");
    return unit == "km" ? 1e3 * value : value;
}

ExitCode run(RunCall& call) {
    const Scene scene = load_scene(call.scene);
    if (!call.force_size)
        if (const auto oversize = oversize_of(scene, program_effects(), machine_memory()))
            refuse_scene(call.scene, oversize->parameter, oversize->message);
    if (call.until)
        call.options.until = parse_length(*call.until);
    call.options.output = call.output.empty() ? "out/" + scene.name : call.output;
    call.options.report = !call.no_report;
    call.options.stop = stop_on_signals();
    return run_scene(scene, call.options) == RunOutcome::finished ? ExitCode::done
                                                                  : ExitCode::interrupted;
}

} // namespace

Command add_run(CLI::App& program) {
    const auto call = std::make_shared<RunCall>();
    call->options.threads = all_threads();
    CLI::App* command = program.add_subcommand("run", "Run a scene");
    add_scene(*command, call->scene);
    add_threads(*command, call->options.threads);
    command->add_flag("--plain", call->options.plain, "The scalar cycle: same bits, slower");
    command->add_option("--output", call->output, "Folder of results (default: out/SCENE)");
    command->add_option("--until", call->until, "End at this extension, such as 5km");
    command->add_flag("--resume", call->options.resume, "Go on from the newest snapshot");
    command->add_flag("--force", call->options.force, "Replace a run in the same folder");
    command->add_flag("--force-size", call->force_size, "Begin a run however large it is");
    command->add_flag("--live", call->options.live,
                      "Write report.html after every window; an open page follows");
    command->add_flag("--no-report", call->no_report, "Write no report.html");
    command->add_flag("--quiet", call->options.quiet, "No progress");
    return {command, [call] { return run(*call); }};
}

} // namespace listric
