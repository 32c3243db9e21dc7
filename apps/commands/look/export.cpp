#include "apps/commands/command.hpp"
#include "apps/figures/sections/export_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <memory>

namespace listric {

Command add_export(CLI::App& program) {
    const auto request = std::make_shared<ExportRequest>();
    CLI::App* command = add_call(
        program,
        {"Look",
         "export",
         "write lines or discs of a run for other programs",
         "docs/guides/export.md",
         {{{"export horizons out/lis1", "tops of all strata as CSV"},
           {"export faults out/lis1 --format geojson", "faults for a GIS"},
           {"export well out/lis1 --x 3.3km", "burial history of every stratum in a well"}}}});
    command->add_option("KIND", request->kind, fmt::format("{}", fmt::join(export_kinds(), ", ")))
        ->type_name("KIND")
        ->required();
    command->add_option("DIR", request->output, "folder of a run")->type_name("DIR")->required();
    add_output(*command, request->folder, "DIR/export", "folder of the files");
    command
        ->add_option("--format", request->formats,
                     "csv, geojson, gmt, gpkg, dxf, pl (GOCAD) or gempy; for discs csv or gsd; for "
                     "seismic segy or "
                     "npy; several "
                     "with commas")
        ->type_name("FORMAT")
        ->default_str("csv, segy")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_lengths(*command, "--at", request->extensions,
                "extension of a snapshot, such as 5km, or several with commas")
        ->default_str("all snapshots");
    add_lengths(*command, "--x", request->wells,
                "of well: distance from the breakaway, such as 3.3km, or several with commas")
        ->default_str("the depocentre and its flank");
    add_number(*command, "--frequency", request->seismic.frequency,
               "seismic: frequency of the wavelet (Ricker's), Hz")
        ->check(CLI::Range(1.0, 1000.0).description(""));
    add_number(*command, "--lateral", request->seismic.lateral,
               "seismic: width of the point-spread function along x, m; 0: none")
        ->check(CLI::Range(0.0, 1e5).description(""));
    command->add_flag("--depth", request->seismic.in_depth,
                      "seismic: samples by depth instead of two-way time");
    return {command, [request] {
                for (const std::filesystem::path& file : export_run(*request))
                    std::cout << file.string() << '\n';
                return ExitCode::done;
            }};
}

} // namespace listric
