#include "apps/program.hpp"

#include "apps/bench.hpp"
#include "apps/explain.hpp"
#include "apps/run.hpp"
#include "apps/version.hpp"
#include "dem/cycle.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <csignal>
#include <iostream>
#include <thread>

namespace listric {

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

void add_scene_options(CLI::App& command, SceneRequest& request) {
    command.add_option("SCENE", request.scene, "Name of a scene (listric scenes) or a path")
        ->required();
    command.add_option("--set", request.set, "table.key=value; repeatable")
        ->allow_extra_args(false);
    command.add_option("--without", request.without, "Switch off the effect TABLE; repeatable")
        ->allow_extra_args(false);
    command.add_option("--accuracy", request.accuracy, "draft, standard, fine or sandbox");
    command.add_option("--seed", request.seed, "Of the packing and everything random");
}

int run(const SceneRequest& request, RunOptions options, const std::string& until,
        const std::string& output) {
    const Scene scene = load_scene(request);
    if (!until.empty())
        options.until = parse_length(until);
    options.output = output.empty() ? "out/" + scene.name : output;
    std::signal(SIGINT, [](int) { stop_requested = true; });
    std::signal(SIGTERM, [](int) { stop_requested = true; });
    return run_scene(scene, options) == RunOutcome::finished ? done : stopped;
}

int dispatch(int argc, char** argv) {
    CLI::App app{"listric: a numerical sandbox for halfgrabens", "listric"};
    app.set_version_flag("--version", std::string(version));
    app.require_subcommand(1);
    app.failure_message(CLI::FailureMessage::help);

    SceneRequest request;
    RunOptions options;
    options.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    std::string until, output, folder;
    BenchRequest bench_request;
    bool parameters = false, unbonded = false;

    CLI::App* run_command = app.add_subcommand("run", "Run a scene");
    add_scene_options(*run_command, request);
    run_command->add_option("--threads", options.threads, "Processor cores to use")
        ->check(CLI::Range(1, 1024));
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
    explain_command->add_flag("--parameters", parameters, "Reference of all parameters");

    CLI::App* figures_command = app.add_subcommand("figures", "Draw the figures of a run");
    figures_command->add_option("DIR", folder, "The run's output folder")->required();

    CLI::App* bench_command = app.add_subcommand("bench", "Speed of the cycle on this machine");
    bench_command->add_option("--packing", bench_request.packing, "Packing file");
    bench_command->add_option("--steps", bench_request.steps, "Cycles to time")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000000}));
    bench_command->add_option("--threads", bench_request.threads, "Processor cores to use")
        ->check(CLI::Range(1, 1024));
    bench_command->add_flag("--plain", bench_request.plain, "The scalar cycle");
    bench_command->add_flag("--unbonded", unbonded, "No contact bonds");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? done : bad_call;
    }

    if (*run_command)
        return run(request, options, until, output);
    if (*scenes_command) {
        for (const auto& [name, description] : list_scenes())
            fmt::print("{:<12} {}\n", name, description);
    } else if (*explain_command) {
        if (parameters)
            std::cout << parameter_reference();
        else if (request.scene.empty())
            throw UsageError("explain: a scene is needed, or --parameters");
        else
            std::cout << explain(load_scene(request));
    } else if (*figures_command) {
        draw_run(folder);
    } else if (*bench_command) {
        bench_request.bonded = !unbonded;
        std::cout << bench(bench_request) << '\n';
    }
    return done;
}

} // namespace

int program(int argc, char** argv) {
    const auto complain = [](const std::exception& error, ExitCode code) {
        fmt::print(stderr, "listric: {}\n", error.what());
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
    } catch (const std::filesystem::filesystem_error& error) {
        return complain(error, storage_failed);
    } catch (const std::exception& error) {
        return complain(error, bad_call);
    }
}

} // namespace listric
