#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/studies/fit/basin_fit.hpp"

#include <memory>

namespace listric {

Command add_fit(CLI::App& program) {
    const auto request = std::make_shared<BasinFitRequest>();
    CLI::App* command = add_call(
        program,
        {"Many runs",
         "fit",
         "find the listric detachment below picked horizons",
         "docs/guides/fit.md",
         {{{"fit picks.csv --predict-only", "kinematics alone, without a run"},
           {"fit picks.csv --jobs 2", "then drafts, two at a time"},
           {"fit picks.csv --scene my.toml", "rock, sediment and rate of your own scene"}}}});
    command
        ->add_option("PICKS", request->picks,
                     "picked horizons, a CSV file with name, x_m, depth_m and age_a")
        ->type_name("FILE")
        ->required();
    command
        ->add_option("--scene", request->scene,
                     "scene that gives all but the detachment, by name or file")
        ->type_name("SCENE")
        ->default_str(request->scene);
    add_words(*command, "--set", "KEY=VALUE", request->set,
              "change a parameter of the scene, such as extension.distance_m=5000; repeatable");
    command->add_flag("--predict-only", request->predict_only, "make no run: kinematics alone");
    command->add_option("--accuracy", request->accuracy, "level of the runs")
        ->type_name("LEVEL")
        ->default_str(request->accuracy)
        ->check(CLI::IsMember(accuracy_names()).description(""));
    add_count(*command, "--seeds", request->seeds, "runs of the best shape", 1, 100);
    add_count(*command, "--seed", request->first_seed,
              "seed of the drafts and first seed of the best shape", 0);
    add_count(*command, "--rounds", request->rounds,
              "rounds of 15 drafts, at most: another where the best is at an end of those tried", 1,
              10);
    add_many_runs(*command, *request, "out/fit-PICKS");
    add_quiet(*command, request->quiet);
    return {command,
            [request] {
                request->stop = stop_on_signals();
                return run_basin_fit(*request) ? ExitCode::done : ExitCode::numerics_failed;
            },
            "the same call goes on from here"};
}

} // namespace listric
