#include "apps/studies/bench.hpp"
#include "apps/commands/command.hpp"

#include <iostream>
#include <memory>

namespace listric {

Command add_bench(CLI::App& program) {
    const auto request = std::make_shared<BenchRequest>();
    CLI::App* command =
        add_call(program, {"Shell",
                           "bench",
                           "measure the speed of the cycle on this machine",
                           "docs/guides/scaling.md",
                           {{{"bench", "on one core"},
                             {"bench --discs 100000 --threads 2", "a larger packing on two cores"},
                             {"bench --plain", "the scalar cycle, for comparison"}}}});
    command->add_option("--packing", request->packing, "packing to measure")
        ->type_name("FILE")
        ->default_str("a lattice of --discs");
    add_count<std::int64_t>(*command, "--discs", request->discs, "discs of the lattice", 1,
                            100'000'000);
    add_count<std::int64_t>(*command, "--steps", request->steps, "cycles to time", 1,
                            1'000'000'000);
    add_threads(*command, request->threads)->default_str("1");
    command->add_flag("--plain", request->plain, "use the scalar cycle");
    command->add_flag("!--unbonded", request->bonded, "leave out bonds between discs");
    return {command, [request] {
                std::cout << bench(*request) << '\n';
                return ExitCode::done;
            }};
}

} // namespace listric
