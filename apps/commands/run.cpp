#include "apps/run/run.hpp"
#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/commands/start_ranks.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/join_ranks.hpp"
#include "apps/run/oversize.hpp"
#include "apps/run/ranked_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

namespace listric {

namespace fs = std::filesystem;

namespace {

struct RunCall {
    SceneRequest scene;
    RunOptions options;
    std::optional<std::string> until;
    std::string output;
    CLI::Option* threads = nullptr;
    std::string ranks = "1";
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

/// A number of processes; 0 for "all": as many as were started together.
int parse_ranks(const std::string& text) {
    int count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (text == "all")
        return 0;
    if (error != std::errc() || end != text.data() + text.size() || count < 1)
        throw UsageError(fmt::format("--ranks={}: a number of processes, such as 2", text));
    return count;
}

fs::path output_of(const RunCall& call, const Scene& scene) {
    return call.output.empty() ? "out/" + scene.name : call.output;
}

/// What there is for a run that may end early. Nobody knows what of the disk a run that goes on, or
/// takes the place of another, will find.
Room room_of(const RunCall& call, const Scene& scene) {
    Room room = room_for(output_of(call, scene));
    if (call.options.resume || call.options.force)
        room.disk = std::numeric_limits<double>::infinity();
    room.disk *=
        scene.extension.distance /
        std::min(scene.extension.distance, std::max(1.0, call.options.until.value_or(1e300)));
    return room;
}

/// Refuses what nobody waits for, or what several processes cannot make.
void check_scene(const RunCall& call, const Scene& scene, bool on_ranks) {
    if (!call.force_size)
        if (const auto oversize = oversize_of(scene, program_effects(), room_of(call, scene)))
            refuse_scene(call.scene, oversize->parameter, oversize->message);
    if (!on_ranks)
        return;
    if (const auto objection = objection_to_ranks(scene))
        refuse_scene(call.scene, objection->path, objection->message);
}

/// What was asked for; on ranks a process has one thread unless it is told otherwise.
RunOptions options_of(const RunCall& call, const Scene& scene, bool on_ranks) {
    RunOptions options = call.options;
    if (on_ranks && call.threads->count() == 0)
        options.threads = 1;
    options.output = output_of(call, scene);
    options.report = !call.no_report;
    return options;
}

ExitCode exit_code_of(RunOutcome outcome) {
    return outcome == RunOutcome::finished ? ExitCode::done : ExitCode::interrupted;
}

/// This process's part of a run that several make.
ExitCode run_part(const RunCall& call, dem::Ranks& ranks) {
    if (ranks.mine() != 0)
        ignore_signals(); // the root stops for all
    return exit_code_of(run_on_ranks(ranks, {[&] { return load_scene(call.scene); },
                                             [&](const Scene& scene, bool is_root) {
                                                 if (is_root)
                                                     check_scene(call, scene, true);
                                                 return options_of(call, scene, true);
                                             }}));
}

ExitCode run(RunCall& call) {
    if (call.until)
        call.options.until = parse_length(*call.until);
    call.options.stop = stop_on_signals();
    const Launch launch = read_launch();
    const int ranks_asked = parse_ranks(call.ranks);
    if (ranks_asked > 1 && launch.count == 1)
        return start_ranks(ranks_asked);
    if (ranks_asked > 1 && ranks_asked != launch.count)
        throw UsageError(fmt::format("--ranks={}: {} processes were started together; without "
                                     "mpirun or srun the program starts them itself",
                                     ranks_asked, launch.count));
    if (launch.count > 1 || ranks_asked == 0) {
        const auto ranks = join_ranks(launch);
        if (ranks->count() > 1)
            return run_part(call, *ranks);
    }
    const Scene scene = load_scene(call.scene);
    check_scene(call, scene, false);
    return exit_code_of(run_scene(scene, options_of(call, scene, false)));
}

/// All processes of a run would say the same.
ExitCode run_and_tell_once(RunCall& call) {
    try {
        return run(call);
    } catch (...) {
        if (read_launch().mine == 0)
            throw;
        return ending_of(std::current_exception()).code;
    }
}

} // namespace

Command add_run(CLI::App& program) {
    const auto call = std::make_shared<RunCall>();
    call->options.threads = all_threads();
    CLI::App* command = program.add_subcommand("run", "Run a scene");
    add_scene(*command, call->scene);
    call->threads = add_threads(*command, call->options.threads);
    command
        ->add_flag("--ranks{all}", call->ranks,
                   "--ranks=N: made by N processes, which mpirun starts; without a number: by "
                   "those that were started, though the environment does not say so")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
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
    return {command, [call] { return run_and_tell_once(*call); }};
}

} // namespace listric
