#include "apps/laboratory/laboratory.hpp"

#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

namespace listric {

namespace {

/// Options that only the shear box or only pure shear has.
void add_options_of_tests(CLI::App& command, LaboratoryRequest& request) {
    add_numbers(command, "--confining,--normal", request.stresses,
                "Stresses on the sides or on the shear zone, MPa");
    command.add_option("--vice", request.vice,
                       "Rock around the shear zone: a material, elastic or none");
    command.add_option("--weakened", request.weakened,
                       "Pure shear: material of faults (mat18-w, or its calibrated variant)");
    command
        .add_option("--accuracy", request.accuracy,
                    fmt::format("Pure shear: {}", fmt::join(accuracy_names(), ", ")))
        ->check(CLI::IsMember(accuracy_names()));
    add_numbers(command, "--weakening-rates", request.weakening_rates,
                "Pure shear: critical strain rates of fault weakening (AFD), per second");
    add_numbers(command, "--healing-rates", request.healing_rates,
                "Pure shear: critical strain rates of bond healing (ICM), per second");
}

} // namespace

Command add_laboratory(CLI::App& program) {
    const auto request = std::make_shared<LaboratoryRequest>();
    request->threads = all_threads();
    CLI::App* command =
        program.add_subcommand("laboratory", "Measure the rock that microproperties make");
    command->add_option("TEST", request->test, "uniaxial, biaxial, shear-box or pure-shear")
        ->required();
    command->add_option("MATERIAL", request->material, "Name of a material or a path")->required();
    add_words(*command, "--set", request->set, "table.key=value of the material; repeatable");
    command->add_option("--discs", request->discs, "Discs per sample; the paper's has 239");
    command->add_option("--seed", request->seed, "Seed of the first sample");
    command->add_option("--seeds", request->seeds, "Number of samples");
    add_threads(*command, request->threads);
    command->add_option("--output", request->output, "Folder of results (out/TEST-MATERIAL)");
    command->add_option("--strength-is", request->reading, "Reading of bond strengths")
        ->check(CLI::IsMember({"stress", "force"}));
    command->add_option("--floaters", request->floaters, "Discs with fewer than three contacts")
        ->check(CLI::IsMember({"grown", "left"}));
    add_options_of_tests(*command, *request);
    command->add_option("--speed", request->speed, "Speed of the walls, over the default");
    command->add_flag("--quiet", request->quiet, "No progress");
    return {command,
            [request] {
                request->stop = stop_on_signals();
                run_laboratory(*request);
                return ExitCode::done;
            },
            "nothing is kept but finished slabs of pure-shear"};
}

} // namespace listric
