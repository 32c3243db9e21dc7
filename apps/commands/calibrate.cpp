#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/laboratory/calibration.hpp"

#include <memory>

namespace listric {

namespace {

void add_targets(CLI::App& command, CalibrationTargets& t) {
    command.add_option("--young", t.young, "Young's modulus in plane strain, Pa (5e10)");
    command.add_option("--poisson", t.poisson, "Poisson's ratio in plane strain (0.25)");
    CLI::Option* friction =
        command.add_option("--friction", t.friction, "Slope of the strength envelope (0.6)");
    CLI::Option* cohesion =
        command.add_option("--cohesion", t.cohesion, "Cohesion of the strength envelope, Pa (1e7)");
    command.add_flag("--byerlee", t.byerlee, "Byerlee's law instead of friction and cohesion")
        ->excludes(friction)
        ->excludes(cohesion);
    command.add_option(
        "--bulk-friction", t.bulk_friction,
        "Bulk friction of the weakened rock in the shear box; default: no weakened rock");
}

} // namespace

Command add_calibrate(CLI::App& program) {
    const auto request = std::make_shared<CalibrationRequest>();
    request->threads = all_threads();
    CLI::App* command =
        program.add_subcommand("calibrate", "Find microproperties of a wanted rock");
    add_targets(*command, request->targets);
    command->add_option("--name", request->name, "Name of the material files");
    command->add_option("--discs", request->discs, "Discs per sample");
    command->add_option("--seed", request->seed, "Seed of the first sample");
    command->add_option("--seeds", request->seeds, "Samples for the fit, as many for validation");
    add_threads(*command, request->threads);
    command->add_option("--output", request->output, "Folder of results (out/calibrate-NAME)");
    command->add_flag("--resume", request->resume, "Go on with the measurements made so far");
    return {command,
            [request] {
                request->stop = stop_on_signals();
                run_calibration(*request);
                return ExitCode::done;
            },
            "--resume goes on with the measurements made so far"};
}

} // namespace listric
