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
                "stresses on the sides or on the shear zone, MPa")
        ->default_str("10,25,50,100, biaxial also 200; shear-box 10,50,100,200");
    command
        .add_option("--vice", request.vice,
                    "rock around the shear zone: a material, elastic or none")
        ->type_name("MATERIAL")
        ->default_str("mat18-b; none if the zone has bonds");
    command.add_option("--weakened", request.weakened, "pure shear: material of faults")
        ->type_name("MATERIAL")
        ->default_str("mat18-w, or its calibrated variant");
    command
        .add_option("--accuracy", request.accuracy,
                    fmt::format("pure shear: {}", fmt::join(accuracy_names(), ", ")))
        ->type_name("LEVEL")
        ->default_str(request.accuracy)
        ->check(CLI::IsMember(accuracy_names()));
    add_numbers(command, "--weakening-rates", request.weakening_rates,
                "pure shear: critical strain rates of fault weakening (AFD), per second")
        ->default_str("1e-14,3e-14,1e-13,3e-13,1e-12");
    add_numbers(command, "--healing-rates", request.healing_rates,
                "pure shear: critical strain rates of bond healing (ICM), per second")
        ->default_str("1e-17,1e-16,1e-15,1e-14,1e-13");
}

} // namespace

Command add_laboratory(CLI::App& program) {
    const auto request = std::make_shared<LaboratoryRequest>();
    request->threads = all_threads();
    CLI::App* command =
        add_call(program, {"Rock",
                           "laboratory",
                           "test samples of a rock",
                           "docs/guides/laboratory.md",
                           {{{"laboratory uniaxial mat18-b", "Young's modulus, Poisson's ratio"},
                             {"laboratory biaxial mat18-b --seeds 3", "the strength envelope"},
                             {"laboratory shear-box mat18-w", "friction of a weakened zone"}}}});
    command->add_option("TEST", request->test, "uniaxial, biaxial, shear-box or pure-shear")
        ->type_name("TEST")
        ->required();
    command->add_option("MATERIAL", request->material, "name of a material, or a file")
        ->type_name("MATERIAL")
        ->required();
    add_words(*command, "--set", "KEY=VALUE", request->set,
              "change the material, such as bonds.shear_strength_pa=2e9; repeatable");
    add_count(*command, "--discs", request->discs, "discs per sample; the paper's sample has 239");
    add_count(*command, "--seed", request->seed, "seed of the first sample");
    add_count(*command, "--seeds", request->seeds, "number of samples");
    add_threads(*command, request->threads);
    add_output(*command, request->output, "out/TEST-MATERIAL");
    command
        ->add_option("--strength-is", request->reading, "meaning of bond strengths: stress, force")
        ->type_name("READING")
        ->default_str("the material's")
        ->check(CLI::IsMember({"stress", "force"}));
    command
        ->add_option("--floaters", request->floaters,
                     "treatment of discs with fewer than three contacts: grown, left")
        ->type_name("WHAT")
        ->default_str(request->floaters)
        ->check(CLI::IsMember({"grown", "left"}));
    add_options_of_tests(*command, *request);
    add_number(*command, "--speed", request->speed,
               "speed of the walls, in multiples of the usual one");
    add_quiet(*command, request->quiet);
    return {command,
            [request] {
                request->stop = stop_on_signals();
                run_laboratory(*request);
                return ExitCode::done;
            },
            "nothing is kept but finished slabs of pure-shear"};
}

} // namespace listric
