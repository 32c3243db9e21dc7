#include "apps/archive/tables/fault_fields.hpp"
#include "apps/commands/command.hpp"
#include "apps/measures/faults/moved_points.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/csv.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>

namespace listric {

namespace {

/// Faults as objects of JSON, with those keys of summary.json's `faults` that are known without a
/// run, and slip_m and throw_m of the displacement.
std::string to_json(std::span<const measures::TracedFault> faults) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const measures::TracedFault& f : faults) {
        measures::FaultReport alone;
        measures::Fault& only = alone.faults.emplace_back();
        only.trace = f.trace;
        only.dip = f.dip;
        only.normal = f.normal;
        nlohmann::ordered_json points = nlohmann::ordered_json::array();
        for (const dem::Point p : f.trace.points)
            points.push_back({p.x, -p.y});
        nlohmann::ordered_json fault = archive::fault_object({alone, 0}, archive::trace_fields());
        fault[archive::field_slip] = f.slip;
        fault[archive::field_throw] = f.throw_down;
        fault[archive::field_width] = f.width;
        fault[archive::field_points] = std::move(points);
        list.push_back(std::move(fault));
    }
    return to_text(list, 2) + "\n";
}

/// Depth positive down in the file, y up in the program.
measures::MovedPoints read_moved_points(const std::string& file) {
    constexpr std::size_t fewest = 30;
    CsvRows rows = read_csv(file, {.numbers = {"x_m", "depth_m", "dx_m", "ddepth_m"}});
    if (rows.size() < fewest)
        throw SceneError(
            fmt::format("{}: has {} points, needs at least {}", shown(file), rows.size(), fewest));
    for (const std::size_t column : {1, 3})
        for (double& value : rows.columns[column])
            value = -value;
    measures::MovedPoints points{std::move(rows.columns[0]), std::move(rows.columns[1]),
                                 std::move(rows.columns[2]), std::move(rows.columns[3])};
    if (const std::string why = measures::objection_to(points); !why.empty())
        throw SceneError(fmt::format("{}: {}", file, why));
    return points;
}

} // namespace

Command add_trace(CLI::App& program) {
    struct Request {
        std::string file;
        measures::FaultTraceOptions options;
    };
    const auto request = std::make_shared<Request>();
    CLI::App* command =
        add_call(program, {"Look",
                           "trace",
                           "find faults in displacements of any code or image",
                           "docs/start/install.md",
                           {{{"trace points.csv", "faults as JSON"},
                             {"trace points.csv --least-strain 0.02", "longer faults"},
                             {"trace points.csv --certain-strain 0.1", "more faults"}}}});
    command
        ->add_option("POINTS", request->file,
                     "CSV with the columns x_m, depth_m (before), dx_m, ddepth_m (displacement)")
        ->type_name("FILE")
        ->required();
    add_number(*command, "--least-strain", request->options.least_strain,
               "least shear strain everywhere along a fault")
        ->check(CLI::Range(1e-6, 1e3).description(""));
    add_number(*command, "--certain-strain", request->options.certain_strain,
               "shear strain that a fault has somewhere")
        ->check(CLI::Range(1e-6, 1e3).description(""));
    return {command, [request] {
                std::cout << to_json(
                    measures::trace_faults(read_moved_points(request->file), request->options));
                return ExitCode::done;
            }};
}

} // namespace listric
