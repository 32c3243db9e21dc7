#include "apps/studies/study.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/output_folder.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/python.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>

namespace listric {

using namespace dem;

namespace {

namespace fs = std::filesystem;

/// Name of this machine's processor, for people.
std::string processor() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(':') + 2);
    return "unknown processor";
}

std::string to_csv(const StudyResult& result) {
    std::string text = "method,parameter,quantity,error,wall_s,disc_steps\n";
    for (const StudyPoint& p : result.points)
        text +=
            fmt::format("{},{},{},{:.6g},{:.4g},{:.6g}\n", csv_cell(p.method),
                        csv_cell(p.parameter), csv_cell(p.quantity), p.error, p.wall, p.disc_steps);
    return text;
}

void print(const StudyResult& result) {
    std::cout << fmt::format("{:<34} {:<26} {:<28} {:>9} {:>9} {:>10}\n", "method", "parameter",
                             "quantity", "error", "wall, s", "disc-steps");
    for (const StudyPoint& p : result.points)
        std::cout << fmt::format("{:<34} {:<26} {:<28} {:>9.2g} {:>9.3g} {:>10.2g}\n", p.method,
                                 p.parameter, p.quantity, p.error, p.wall, p.disc_steps);
    for (const auto& [quantity, floor] : result.floors)
        std::cout << fmt::format("spread between seeds: {} {:.2g}\n", quantity, floor);
}

/// Why a study has no use for an option of the call; empty if it has.
std::string objection_to_options(const Study& study, const StudyRequest& request) {
    if (!study.has_values && !request.values.empty())
        return "--values: its values are fixed; leave them out";
    if (!study.has_scene && !(request.scene.empty() && request.set.empty()))
        return "--scene, --set: it has no scene; leave them out";
    return "";
}

} // namespace

std::span<const Study> studies() {
    static constexpr std::array<Study, 8> all{{
        {"resolution", "lis1 with 3,000 to 67,000 discs", study_resolution, true},
        {"speed", "boundary speed: how slow is quasi-static", study_speed, true},
        {"softness", "softer discs and a faster wall: fewer cycles", study_softness, true},
        {"time-step", "time step and density scaling: wave, lattice, lis1", study_time_step},
        {"footwall", "elements, refinement and solvers of the elastic base", study_footwall, true,
         false, 1},
        {"coupling", "update interval and modes of lis1-elastic", study_coupling},
        {"isostasy", "lis1-elastic by elastic thickness and fill", study_isostasy, true},
        // Forces do not depend on the lists: one packing shows it.
        {"precision", "single precision and neighbour lists", study_precision, false, true, 1},
    }};
    return all;
}

void run_study(StudyRequest request) {
    const auto study = std::ranges::find(studies(), request.name, &Study::name);
    if (study == studies().end()) {
        std::vector<std::string_view> names;
        std::ranges::transform(studies(), std::back_inserter(names), &Study::name);
        const auto meant = nearest(request.name, names);
        throw UsageError(fmt::format("study: no study {}; {}there are {}", request.name,
                                     meant ? fmt::format("did you mean {}? ", *meant) : "",
                                     fmt::join(names, ", ")));
    }
    const std::string lack = objection_to_options(*study, request);
    if (!lack.empty())
        throw UsageError(fmt::format("study {}: {}", request.name, lack));
    if (request.seeds < 1 || request.seeds > 1000)
        throw UsageError(fmt::format("--seeds {}: allowed: 1 to 1000", request.seeds));
    for (double value : request.values)
        if (!(value > 0.0) || !std::isfinite(value))
            throw UsageError(fmt::format("--values {}: allowed: numbers above 0", value));
    request.seeds = std::min(request.seeds, study->most_seeds);
    if (request.output.empty())
        request.output = "out/study-" + request.name;
    const archive::OwnFile written[]{{request.output / "study.csv", "method,parameter,quantity"},
                                     {request.output / "study.json", "\"study\""},
                                     {request.output / "study.png", "Listric"},
                                     {request.output / "runs.csv", "record,"},
                                     {request.output / "isostasy.csv", "fill,elastic_thickness_m"},
                                     {request.output / "isostasy.png", "Listric"}};
    archive::require_own(written, {});
    make_folder(request.output);
    const archive::FolderLock lock(request.output);

    const StudyResult result = study->make(request);
    const nlohmann::ordered_json json = {
        {"study", request.name},      {"title", result.title},      {"floors", result.floors},
        {"version", version},         {"processor", processor()},   {"compiler", compiler},
        {"build_flags", build_flags}, {"threads", request.threads}, {"seeds", request.seeds},
    };
    write_text(request.output / "study.csv", to_csv(result));
    write_object(request.output / "study.json", json);
    if (!result.runs.empty())
        archive::write_run_records(request.output / "runs.csv", result.runs);
    print(result);
    draw_or_warn("study.py", {std::filesystem::absolute(request.output).string()});
}

} // namespace listric
