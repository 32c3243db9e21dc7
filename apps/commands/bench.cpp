#include "apps/studies/bench.hpp"
#include "apps/commands/command.hpp"

#include <iostream>
#include <memory>

namespace listric {

Command add_bench(CLI::App& program) {
    const auto request = std::make_shared<BenchRequest>();
    CLI::App* command = program.add_subcommand("bench", "Speed of the cycle on this machine");
    command->add_option("--packing", request->packing, "Packing file");
    command->add_option("--discs", request->discs, "Discs of a lattice, without a file")
        ->check(CLI::Range(1, 100'000'000));
    command->add_option("--steps", request->steps, "Cycles to time")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1000000000}));
    add_threads(*command, request->threads);
    command->add_flag("--plain", request->plain, "The scalar cycle");
    command->add_flag("!--unbonded", request->bonded, "No contact bonds");
    return {command, [request] {
                std::cout << bench(*request) << '\n';
                return ExitCode::done;
            }};
}

} // namespace listric
