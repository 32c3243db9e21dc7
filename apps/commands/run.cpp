#include "apps/run/run.hpp"
#include "apps/archive/folder/scene_lines.hpp"
#include "apps/archive/reservations.hpp"
#include "apps/commands/asked_accuracy.hpp"
#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/commands/start_ranks.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/batch.hpp"
#include "apps/run/forecast/oversize.hpp"
#include "apps/run/ranks/join_ranks.hpp"
#include "apps/run/ranks/rank_reports.hpp"
#include "apps/run/ranks/ranked_run.hpp"
#include "apps/scene/picks/rock_line.hpp"
#include "apps/studies/flexure_plan.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/number.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace listric {

namespace fs = std::filesystem;

namespace {

struct RunCall {
    SceneRequest scene;
    RunOptions options;
    AskedAccuracy asked;
    std::optional<std::string> until;
    std::string output;
    CLI::Option* threads = nullptr;
    std::string ranks; ///< --ranks; empty: not given
    bool force_size = false;
    bool no_report = false, no_figures = false;
    std::string lean; ///< --lean: "last" or "all" snapshots; empty: not given
};

/// A number of processes; none for "all", as many as were started together, and where there is
/// none.
std::optional<int> parse_ranks(const std::string& text) {
    int count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (text.empty() || text == "all")
        return std::nullopt;
    if (error != std::errc() || end != text.data() + text.size() || count < 1)
        throw UsageError(fmt::format("--ranks={}: a number of processes, such as 2", text));
    return count;
}

fs::path output_of(const RunCall& call, const std::string& scene) {
    return call.output.empty() ? "out/" + scene : call.output;
}

/// Room for a run that may end early. Nobody knows what of the disk a run that goes on, or
/// takes the place of another, will find.
FreeSpace room_of(const RunCall& call, const Scene& scene) {
    FreeSpace room = room_for(output_of(call, scene.name));
    if (call.options.resume || call.options.force)
        room.disk = std::numeric_limits<double>::infinity();
    const double distance = scene.extension.distance;
    room.disk *= distance / std::min(distance, std::max(1.0, call.options.end(distance)));
    return room;
}

/// Refuses what nobody waits for, or what several processes cannot make.
void check_scene(const RunCall& call, const Scene& scene, bool on_ranks) {
    if (!call.force_size)
        if (const auto oversize = oversize_of(scene, program_effects(), room_of(call, scene))) {
            if (oversize->is_of_disk)
                throw StorageError(fmt::format("{}: {} = {}", output_of(call, scene.name).string(),
                                               oversize->parameter, oversize->message));
            refuse_scene(call.scene, oversize->parameter, oversize->message);
        }
    if (!on_ranks)
        return;
    if (const auto objection = objection_to_ranks(scene))
        refuse_scene(call.scene, objection->path, objection->message);
}

/// Options of a call; on ranks a process has one thread unless it is told otherwise.
RunOptions options_of(const RunCall& call, const Scene& scene, bool on_ranks) {
    RunOptions options = call.options;
    if (on_ranks && call.threads->count() == 0)
        options.threads = 1;
    options.output = output_of(call, scene.name);
    options.report = !call.no_report;
    options.figures = !call.no_figures;
    if (!call.lean.empty()) {
        options.lean = call.lean == "all" ? Lean::all : Lean::last;
        options.report = options.figures = false;
    }
    return options;
}

ExitCode exit_code_of(RunOutcome outcome) {
    return outcome == RunOutcome::finished ? ExitCode::done : ExitCode::interrupted;
}

/// The scene of a call. Older versions took another rock where a scene names none, and at any rate
/// the intervals of 1 cm a year where it states none: a run that one of them began goes on with
/// them.
Scene scene_of(const RunCall& call) {
    const Scene scene = load_scene(call.scene);
    const fs::path begun = output_of(call, scene.name) / "scene.toml";
    const auto before = archive::scene_values(read_text_if_there(begun));
    const auto is_before = [&](const Scene& other) {
        return !archive::scene_difference(before, archive::scene_values(to_toml(other)));
    };
    if (!call.options.resume || is_before(scene))
        return scene;
    for (const auto& [rocks, intervals] : {std::pair(false, true), {true, false}, {true, true}}) {
        SceneRequest request = call.scene;
        request.former_rocks = rocks;
        request.former_intervals = intervals;
        Scene former = load_scene(request);
        if (!is_before(former))
            continue;
        if (rocks)
            former.warnings.push_back(fmt::format("{} names no rock: the run goes on with the one "
                                                  "that it began with; a new one would have {}",
                                                  call.scene.scene, rock_line(scene)));
        if (intervals)
            former.warnings.push_back(fmt::format(
                "{} states no intervals: the run goes on with those that it began with, which are "
                "of {} m/a; in a new one they would be as many metres at {} m/a",
                call.scene.scene, text(usual_rate), text(scene.extension.rate)));
        return former;
    }
    return scene;
}

/// This process's part of a run that several make.
ExitCode run_part(const RunCall& call, dem::Ranks& ranks) {
    if (ranks.mine() != 0)
        ignore_signals(); // the root stops for all
    const ExitCode code =
        exit_code_of(run_on_ranks(ranks, {[&] { return scene_of(call); },
                                          [&](const Scene& scene, bool is_root) {
                                              if (is_root)
                                                  check_scene(call, scene, true);
                                              return options_of(call, scene, true);
                                          }}));
    report_end(ranks.mine(), static_cast<int>(code));
    return code;
}

/// The run in this process alone.
ExitCode run_alone(const RunCall& call) {
    if (is_flexure_plan(call.scene.scene)) {
        const FlexurePlan plan = load_flexure_plan(call.scene);
        RunOptions options = call.options;
        options.output = output_of(call, plan.name);
        run_flexure(plan, options);
        return ExitCode::done;
    }
    const Scene scene = scene_of(call);
    check_scene(call, scene, false);
    const RunOptions options = options_of(call, scene, false);
    const fs::path summary = options.output / "summary.json";
    const std::string before = read_text_if_there(summary);
    const ExitCode code =
        exit_code_of(options.lean == Lean::no ? run_scene(scene, options)
                                              : make_run({scene.name, scene, options}));
    if (!before.empty() && before == read_text_if_there(summary)) // nothing was left to do
        archive::warn_of(options.output, archive::reservations(options.output));
    return code;
}

/// Takes level and speed from what was recorded. Processes that share a run must not each measure
/// how fast the machine is; a run that goes on has what it began with.
void choose_accuracy(RunCall& call) {
    if (!call.ranks.empty() || read_launch().count > 1)
        throw UsageError("--within and --error are for one process; listric explain tells the "
                         "level for --accuracy");
    if (call.options.resume)
        throw UsageError("--within and --error choose how a run begins; leave them out with "
                         "--resume");
    if (is_flexure_plan(call.scene.scene))
        throw UsageError("--within and --error: flexure has no discs and no levels of accuracy");
    const std::string chosen = apply_asked(call.asked, call.scene, call.options.threads);
    Log(call.options.quiet).say(chosen);
}

ExitCode run(RunCall& call) {
    if (call.asked.is_asked())
        choose_accuracy(call);
    if (!call.lean.empty()) {
        if (call.lean != "last" && call.lean != "all")
            throw UsageError(fmt::format("--lean={}: last or all", call.lean));
        if (call.options.force || call.options.live || !call.ranks.empty())
            throw UsageError("--lean is for one of many runs, which goes on with what is there: "
                             "leave out --force, --live and --ranks");
    }
    if (call.until)
        call.options.until = parse_length("--until", *call.until);
    call.options.stop = stop_on_signals();
    const std::optional<int> asked = parse_ranks(call.ranks);
    if (asked == 1) // whatever the environment says
        return run_alone(call);
    const Launch launch = read_launch();
    if ((asked || launch.count > 1) && is_flexure_plan(call.scene.scene))
        throw UsageError("flexure has no discs to be shared; start one process");
    if (asked && launch.count == 1)
        return start_ranks(*asked, output_of(call, scene_name(call.scene)));
    if (asked && *asked != launch.count)
        throw UsageError(fmt::format("--ranks={}: {} processes were started together; without "
                                     "mpirun or srun the program starts them itself",
                                     *asked, launch.count));
    if (launch.count > 1 || call.ranks == "all") {
        report_begin(launch.mine);
        const auto ranks = join_ranks(launch);
        if (ranks->count() > 1)
            return run_part(call, *ranks);
    }
    return run_alone(call);
}

} // namespace

Command add_run(CLI::App& program) {
    const auto call = std::make_shared<RunCall>();
    call->options.threads = all_threads();
    CLI::App* command =
        add_call(program, {"Run",
                           "run",
                           "run a scene",
                           "docs/start/first-run.md",
                           {{{"run lis1 --accuracy draft", "a quick look at half the resolution"},
                             {"run lis1 --seed 2 -o out/second", "another random packing"},
                             {"run lis1 --resume", "continue a run that was stopped"}}}});
    add_scene(*command, call->scene);
    call->threads = add_threads(*command, call->options.threads);
    command
        ->add_flag("--ranks{all}", call->ranks,
                   "share the run between N processes, which mpirun starts; 1: this process "
                   "alone; without N: the processes that were started together, even where the "
                   "environment does not show them")
        ->type_name("N")
        ->default_str("the processes that mpirun or srun started, else 1")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    command->add_flag("--plain", call->options.plain, "use the scalar cycle: same bits, slower");
    add_output(*command, call->output, "out/SCENE");
    command->add_option("--until", call->until, "end at this extension, such as 5km")
        ->type_name("LENGTH")
        ->default_str("extension.distance_m of the scene");
    command->add_flag("--resume", call->options.resume, "continue from the newest snapshot");
    command->add_flag("--force", call->options.force, "replace a run in the same folder");
    command->add_flag("--force-size", call->force_size, "begin a run however large it is");
    command->add_flag("--live", call->options.live,
                      "write report.html after every window; an open page follows");
    command->add_flag("--no-report", call->no_report, "write no report.html");
    command->add_flag("--no-figures", call->no_figures, "draw no figures");
    command
        ->add_flag("--lean{last}", call->lean,
                   "one of many runs: go on with what is in its folder, and leave there scene, "
                   "history, log, summary and the last snapshot alone; all: all snapshots")
        ->type_name("SNAPSHOTS")
        ->default_str("all files stay")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    add_asked_accuracy(*command, call->asked);
    add_quiet(*command, call->options.quiet);
    return {command, [call] { return run(*call); }};
}

} // namespace listric
