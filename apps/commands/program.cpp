#include "apps/commands/program.hpp"

#include "apps/commands/explain.hpp"
#include "apps/laboratory/calibration.hpp"
#include "apps/laboratory/laboratory.hpp"
#include "apps/run/run.hpp"
#include "apps/scene/declaration.hpp"
#include "apps/studies/bench.hpp"
#include "apps/studies/study.hpp"
#include "apps/studies/validation.hpp"
#include "apps/support/version.hpp"
#include "dem/cycle.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <optional>
#include <thread>
#include <unistd.h>

namespace listric {

using namespace dem;

namespace {

enum ExitCode { done = 0, bad_call = 2, numerics_failed = 3, storage_failed = 4, stopped = 130 };

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

/// An option that may be given several times, with one word each time.
void add_words(CLI::App& command, const char* option, std::vector<std::string>& words,
               const char* what) {
    command.add_option(option, words, what)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_threads(CLI::App& command, int& threads) {
    command.add_option("--threads", threads, "Processor cores to use")->check(CLI::Range(1, 1024));
}

void add_scene_options(CLI::App& command, SceneRequest& request) {
    command.add_option("SCENE", request.scene, "Name of a scene (listric scenes) or a path")
        ->required();
    add_words(command, "--set", request.set, "table.key=value; repeatable");
    add_words(command, "--without", request.without, "Switch off the effect TABLE; repeatable");
    command.add_option("--accuracy", request.accuracy, "draft, standard, fine or sandbox");
    command.add_option("--seed", request.seed, "Of the packing and everything random");
}

void add_laboratory_options(CLI::App& command, LaboratoryRequest& request) {
    command.add_option("TEST", request.test, "uniaxial, biaxial, shear-box or pure-shear")
        ->required();
    command.add_option("MATERIAL", request.material, "Name of a material or a path")->required();
    add_words(command, "--set", request.set, "table.key=value of the material; repeatable");
    command.add_option("--discs", request.discs, "Discs per sample; the paper's has 239");
    command.add_option("--seed", request.seed, "Of the first sample");
    command.add_option("--seeds", request.seeds, "Number of samples");
    add_threads(command, request.threads);
    command.add_option("--output", request.output, "Folder of results (out/TEST-MATERIAL)");
    command.add_option("--strength-is", request.reading, "Reading of bond strengths")
        ->check(CLI::IsMember({"stress", "force"}));
    command.add_option("--floaters", request.floaters, "Discs with fewer than three contacts")
        ->check(CLI::IsMember({"grown", "left"}));
    command
        .add_option("--confining,--normal", request.stresses,
                    "Stresses on the sides or on the shear zone, MPa")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--vice", request.vice,
                       "Rock around the shear zone: a material, elastic or none");
    command.add_option("--weakened", request.weakened,
                       "Pure shear: material of faults (mat18-w, or its calibrated variant)");
    command
        .add_option("--accuracy", request.accuracy, "Pure shear: draft, standard, fine, sandbox")
        ->check(CLI::IsMember({"draft", "standard", "fine", "sandbox"}));
    for (const auto& [option, rates, what] :
         {std::tuple("--weakening-rates", &request.weakening_rates, "fault weakening (AFD)"),
          std::tuple("--healing-rates", &request.healing_rates, "bond healing (ICM)")})
        command
            .add_option(option, *rates,
                        fmt::format("Pure shear: critical strain rates of {}, per second", what))
            ->delimiter(',')
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--speed", request.speed, "Of the walls, over the default");
    command.add_flag("--quiet", request.quiet, "No progress");
}

void add_calibration_options(CLI::App& command, CalibrationRequest& request) {
    CalibrationTargets& t = request.targets;
    command.add_option("--young", t.young, "Young's modulus in plane strain, Pa (5e10)");
    command.add_option("--poisson", t.poisson, "Poisson's ratio in plane strain (0.25)");
    CLI::Option* friction =
        command.add_option("--friction", t.friction, "Slope of the strength envelope (0.6)");
    CLI::Option* cohesion = command.add_option("--cohesion", t.cohesion, "Pa (1e7)");
    command.add_flag("--byerlee", t.byerlee, "Byerlee's law instead of friction and cohesion")
        ->excludes(friction)
        ->excludes(cohesion);
    command.add_option("--bulk-friction", t.bulk_friction,
                       "Of the weakened rock in the shear box; default: no weakened rock");
    command.add_option("--name", request.name, "Of the material files");
    command.add_option("--discs", request.discs, "Discs per sample");
    command.add_option("--seed", request.seed, "Of the first sample");
    command.add_option("--seeds", request.seeds, "Samples for the fit, as many for validation");
    add_threads(command, request.threads);
    command.add_option("--output", request.output, "Folder of results (out/calibrate-NAME)");
    command.add_flag("--resume", request.resume, "Go on with the measurements made so far");
}

void add_study_options(CLI::App& command, StudyRequest& request) {
    std::string names;
    for (const Study& study : studies())
        names += fmt::format("\n{:<12} {}", study.name, study.doc);
    command.add_option("NAME", request.name, "One of:" + names)->required();
    command.add_option("--scene", request.scene, "Of studies made of runs (lis1)");
    add_words(command, "--set", request.set, "table.key=value, for every run; repeatable");
    command.add_option("--values", request.values, "Of the parameter that is varied")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--seed", request.seed, "Of the first run");
    command.add_option("--seeds", request.seeds, "Runs for each value");
    add_threads(command, request.threads);
    command.add_option("--output", request.output, "Folder of results (out/study-NAME)");
    command.add_flag("--quiet", request.quiet, "No progress");
}

void add_validation_options(CLI::App& command, ValidationRequest& request) {
    command.add_option("--accuracy", request.accuracy, "Of the runs: draft, standard, ...");
    command.add_option("--seeds", request.seeds, "Runs per experiment")->check(CLI::Range(1, 1000));
    command.add_option("--runs", request.runs, "Folder of the runs (out/validation-ACCURACY)");
    command.add_option(
        "--output", request.output,
        "Document (docs/validation.md; not at standard or not all: beside the runs)");
    command.add_option("--only", request.only, "One experiment");
    command.add_option("--plan", request.plan, "Runs and expectations (apps/validation.toml)");
    add_threads(command, request.threads);
    command.add_flag("--remeasure", request.remeasure, "Measure all runs anew");
    command.add_flag("--without-runs", request.without_runs, "Take the runs that are there");
}

/// Signals end a run at its next opportunity.
void stop_on_signals() {
    std::signal(SIGINT, [](int) { stop_requested = true; });
    std::signal(SIGTERM, [](int) { stop_requested = true; });
    std::signal(SIGHUP, [](int) { stop_requested = true; });
    std::signal(SIGPIPE, SIG_IGN); // whoever read the progress may leave
}

int run(const SceneRequest& request, RunOptions options, const std::optional<std::string>& until,
        const std::string& output) {
    const Scene scene = load_scene(request);
    if (until)
        options.until = parse_length(*until);
    options.output = output.empty() ? "out/" + scene.name : output;
    options.stop = StopToken(stop_requested);
    stop_on_signals();
    return run_scene(scene, options) == RunOutcome::finished ? done : stopped;
}

void require_known(std::string_view kind, std::string_view word,
                   const std::vector<std::string>& known) {
    if (std::ranges::find(known, word) != known.end())
        return;
    const auto meant = nearest(word, std::vector<std::string_view>(known.begin(), known.end()));
    throw UsageError(fmt::format("no {} {}; {}there are {}", kind, word,
                                 meant ? fmt::format("did you mean {}? ", *meant) : "",
                                 fmt::join(known, ", ")));
}

/// Says of a call that could not be understood which word is not known, and what it may mean.
void refuse_unknown_words(const CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App* call = &app;
    if (!words.empty() && !words[0].starts_with("-")) {
        std::vector<std::string> calls;
        for (const CLI::App* command : app.get_subcommands({}))
            calls.push_back(command->get_name());
        require_known("call", words[0], calls);
        call = app.get_subcommand(words[0]);
    }
    std::vector<std::string> options;
    for (const CLI::Option* option : call->get_options())
        for (const std::string& name : option->get_lnames())
            options.push_back("--" + name);
    for (const std::string& word : words)
        if (word.starts_with("--"))
            require_known("option", word.substr(0, word.find('=')), options);
}

int dispatch(int argc, char** argv) {
    CLI::App app{"listric: a numerical sandbox for halfgrabens", "listric"};
    app.set_version_flag("--version", std::string(version));
    app.require_subcommand(1);
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);

    SceneRequest request;
    RunOptions options;
    options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    std::optional<std::string> until;
    std::string output, folder;
    BenchRequest bench_request;
    bool parameters = false, unbonded = false, animation = false;

    CLI::App* run_command = app.add_subcommand("run", "Run a scene");
    add_scene_options(*run_command, request);
    add_threads(*run_command, options.threads);
    run_command->add_flag("--plain", options.plain, "The scalar cycle: same bits, slower");
    run_command->add_option("--output", output, "Folder of results (default: out/SCENE)");
    run_command->add_option("--until", until, "End at this extension, such as 5km");
    run_command->add_flag("--resume", options.resume, "Go on from the newest snapshot");
    run_command->add_flag("--force", options.force, "Replace a run in the same folder");
    run_command->add_flag("--quiet", options.quiet, "No progress");

    CLI::App* scenes_command = app.add_subcommand("scenes", "List the scenes");

    CLI::App* explain_command =
        app.add_subcommand("explain", "Say what a scene would simulate and cost; run nothing");
    add_scene_options(*explain_command, request);
    explain_command->get_option("SCENE")->required(false);
    add_threads(*explain_command, options.threads);
    explain_command->add_flag("--parameters", parameters, "Reference of all parameters");

    CLI::App* figures_command = app.add_subcommand("figures", "Draw the figures of a run");
    figures_command->add_option("DIR", folder, "The run's output folder")->required();
    figures_command->add_flag("--animation", animation,
                              "An animation of all snapshots instead of the figures");

    CLI::App* bench_command = app.add_subcommand("bench", "Speed of the cycle on this machine");
    bench_command->add_option("--packing", bench_request.packing, "Packing file");
    bench_command->add_option("--discs", bench_request.discs, "Discs of a lattice, without a file")
        ->check(CLI::Range(1, 100'000'000));
    bench_command->add_option("--steps", bench_request.steps, "Cycles to time")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000000}));
    add_threads(*bench_command, bench_request.threads);
    bench_command->add_flag("--plain", bench_request.plain, "The scalar cycle");
    bench_command->add_flag("--unbonded", unbonded, "No contact bonds");

    LaboratoryRequest laboratory_request;
    laboratory_request.threads = options.threads;
    CLI::App* laboratory_command =
        app.add_subcommand("laboratory", "Measure the rock that microproperties make");
    add_laboratory_options(*laboratory_command, laboratory_request);

    CalibrationRequest calibration_request;
    calibration_request.threads = options.threads;
    CLI::App* calibrate_command =
        app.add_subcommand("calibrate", "Find microproperties of a wanted rock");
    add_calibration_options(*calibrate_command, calibration_request);

    StudyRequest study_request;
    study_request.threads = options.threads;
    CLI::App* study_command =
        app.add_subcommand("study", "Accuracy against time: a table and a figure");
    add_study_options(*study_command, study_request);

    ValidationRequest validation_request;
    validation_request.threads = options.threads;
    CLI::App* validate_command = app.add_subcommand(
        "validate", "Run the paper's experiments and write what is met and what is missed");
    add_validation_options(*validate_command, validation_request);

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0)
            refuse_unknown_words(app, {argv + 1, argv + argc});
        return app.exit(error) == 0 ? done : bad_call;
    }

    if (*run_command)
        return run(request, options, until, output);
    if (*scenes_command) {
        for (const auto& [name, description] : list_scenes())
            std::cout << fmt::format("{:<12} {}\n", name, description);
    } else if (*explain_command) {
        if (parameters)
            std::cout << parameter_reference();
        else if (request.scene.empty())
            throw UsageError("explain: a scene is needed, or --parameters");
        else
            std::cout << explain(load_scene(request), options.threads);
    } else if (*figures_command) {
        animation ? animate_run(folder) : draw_run(folder);
    } else if (*validate_command) {
        stop_on_signals();
        if (!run_validation(validation_request))
            return stopped;
    } else if (*calibrate_command) {
        run_calibration(calibration_request);
    } else if (*laboratory_command) {
        run_laboratory(laboratory_request);
    } else if (*study_command) {
        stop_on_signals();
        run_study(study_request);
    } else if (*bench_command) {
        bench_request.bonded = !unbonded;
        std::cout << bench(bench_request) << '\n';
    }
    if (!std::cout.flush())
        throw StorageError("standard output cannot be written");
    return done;
}

/// A file that the run opens must not become its standard error, if that was closed.
void keep_standard_files_open() {
    for (int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(descriptor, F_GETFD) < 0 && open("/dev/null", O_RDWR) < 0)
            return;
}

} // namespace

int program(int argc, char** argv) {
    keep_standard_files_open();
    const auto complain = [](const std::exception& error, ExitCode code) {
        const std::string text = fmt::format("listric: {}\n", error.what());
        std::fwrite(text.data(), 1, text.size(), stderr);
        return static_cast<int>(code);
    };
    try {
        return dispatch(argc, argv);
    } catch (const SceneError& error) {
        return complain(error, bad_call);
    } catch (const UsageError& error) {
        return complain(error, bad_call);
    } catch (const NumericalFailure& error) {
        return complain(error, numerics_failed);
    } catch (const StorageError& error) {
        return complain(error, storage_failed);
    } catch (const MemoryError& error) {
        return complain(error, storage_failed);
    } catch (const std::filesystem::filesystem_error& error) {
        return complain(error, storage_failed);
    } catch (const std::exception& error) {
        return complain(error, bad_call);
    }
}

} // namespace listric
