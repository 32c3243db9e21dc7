#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/laboratory/laboratory.hpp"

#include <memory>

namespace listric {

namespace {

void add_targets(CLI::App& command, CalibrationTargets& t) {
    add_number(command, "--young", t.young, "Young's modulus in plane strain, Pa");
    add_number(command, "--poisson", t.poisson, "Poisson's ratio in plane strain");
    CLI::Option* friction =
        add_number(command, "--friction", t.friction, "slope of the strength envelope");
    CLI::Option* cohesion =
        add_number(command, "--cohesion", t.cohesion, "cohesion of the strength envelope, Pa");
    command.add_flag("--byerlee", t.byerlee, "fit Byerlee's law instead of friction and cohesion")
        ->excludes(friction)
        ->excludes(cohesion);
    add_number(command, "--bulk-friction", t.bulk_friction,
               "bulk friction of the weakened rock in the shear box")
        ->default_str("no weakened rock");
}

} // namespace

Command add_calibrate(CLI::App& program) {
    const auto request = std::make_shared<CalibrationRequest>();
    request->threads = all_threads();
    CLI::App* command =
        add_call(program, {"Rock",
                           "calibrate",
                           "find the microproperties of a wanted rock",
                           "docs/guides/laboratory.md",
                           {{{"calibrate --young 20e9 --name sandstone", "a softer rock"},
                             {"calibrate --byerlee --seeds 5", "strength after Byerlee's law"},
                             {"calibrate --name sandstone --resume", "continue after a stop"}}}});
    add_targets(*command, request->targets);
    command->add_option("--name", request->name, "name of the material files")
        ->type_name("NAME")
        ->default_str(request->name);
    add_count(*command, "--discs", request->discs, "discs per sample");
    add_count(*command, "--seed", request->seed, "seed of the first sample");
    add_count(*command, "--seeds", request->seeds,
              "samples for the fit, and as many for validation");
    add_threads(*command, request->threads);
    add_output(*command, request->output, "out/calibrate-NAME");
    command->add_flag("--resume", request->resume, "continue with the measurements made so far");
    add_quiet(*command, request->quiet);
    return {command,
            [request] {
                request->stop = stop_on_signals();
                run_calibration(*request);
                return ExitCode::done;
            },
            "--resume goes on with the measurements made so far"};
}

} // namespace listric
