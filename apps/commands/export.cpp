#include "apps/commands/command.hpp"
#include "apps/figures/export_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <memory>

namespace listric {

Command add_export(CLI::App& program) {
    const auto request = std::make_shared<ExportRequest>();
    CLI::App* command = program.add_subcommand(
        "export", "Horizons, faults, surfaces or discs of a run for other programs");
    command->add_option("KIND", request->kind, fmt::format("{}", fmt::join(export_kinds(), ", ")))
        ->required();
    command->add_option("DIR", request->output, "The run's output folder")->required();
    command
        ->add_option("--format", request->formats,
                     "csv, geojson, gmt; discs: csv, gsd. Several with commas")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->capture_default_str();
    add_numbers(*command, "--at", request->extensions,
                "Extension of a snapshot, m, or several with commas; default: all snapshots");
    return {command, [request] {
                for (const std::filesystem::path& file : export_run(*request))
                    std::cout << file.string() << '\n';
                return ExitCode::done;
            }};
}

} // namespace listric
