#include "apps/figures/sections/export_run.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/folder/run_files.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/run_history.hpp"
#include "apps/archive/folder/setting.hpp"
#include "apps/archive/reservations.hpp"
#include "apps/archive/tables/burial_history.hpp"
#include "apps/archive/tables/displacement_table.hpp"
#include "apps/archive/tables/exports.hpp"
#include "apps/figures/sections/export_seismic.hpp"
#include "apps/measures/strata/rock.hpp"
#include "apps/model/effects.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/files/npy.hpp"
#include "apps/support/machine/python.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/option_names.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>

namespace listric {

using namespace archive;
using namespace dem;

namespace fs = std::filesystem;

namespace {

struct Kind {
    std::string_view name;
    LineTable (*table)(const ExportedMoment& at);
    bool needs_faults;
    std::vector<std::string_view> formats;
};

const std::vector<Kind>& kinds() {
    static const std::vector<std::string_view> of_lines{"csv", "geojson", "gmt",  "gpkg",
                                                        "dxf", "pl",      "gempy"};
    static const std::vector<Kind> all{
        {"horizons", horizons_table, true, of_lines},  {"faults", faults_table, true, of_lines},
        {"surfaces", surfaces_table, false, of_lines}, {"base", base_table, false, of_lines},
        {"discs", discs_table, false, {"csv", "gsd"}}, {"well", wells_table, false, of_lines},
        {"layers", layers_table, false, of_lines},     {"seismic", nullptr, true, {"segy", "npy"}},
        {"displacement", nullptr, false, of_lines},
    };
    return all;
}

/// Throws UsageError.
const Kind& kind_named(const std::string& name) {
    const auto found = std::ranges::find(kinds(), name, &Kind::name);
    if (found == kinds().end())
        throw UsageError(fmt::format("export: no kind {}; {}", name, advice(name, export_kinds())));
    return *found;
}

void require_formats(const Kind& kind, const std::vector<std::string>& formats) {
    for (const std::string& format : formats)
        if (std::ranges::find(kind.formats, format) == kind.formats.end())
            throw UsageError(fmt::format("export {}: no format {}; {}", kind.name, format,
                                         advice(format, kind.formats)));
}

/// Discs and bonds of several moments as one GSD file, which OVITO opens: the arrays that the
/// script reads, in a folder that vanishes with this object.
class Trajectory {
public:
    explicit Trajectory(const fs::path& folder) : data_(folder) {}
    void add(const ExportedMoment& at);
    void write(const fs::path& file) const;

private:
    TemporaryFolder data_;
    int frames_ = 0;
};

void Trajectory::add(const ExportedMoment& at) {
    const fs::path folder = data_.path / fmt::format("{:06d}", frames_++);
    make_folder(folder);
    const State& state = at.now.state;
    const ConstDiscColumns d = disc_columns(state);
    write_npy<double>(folder / "x_m.npy", d.x);
    write_npy<double>(folder / "y_m.npy", d.y);
    write_npy<std::uint32_t>(folder / "rock.npy", measures::rocks(state));
    for (const DiscColumn& column : exported_columns(at))
        write_npy<double>(folder / ("of-" + column.name + ".npy"), column.values);
    const ConstContactColumns c = contact_columns(state);
    std::vector<std::int32_t> bonded;
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (c.bonded[k])
            bonded.insert(bonded.end(), {c.first[k], c.second[k]});
    write_npy<std::int32_t>(folder / "bonded.npy", bonded, 2);
    write_npy<double>(folder / "moment.npy",
                      std::vector{static_cast<double>(state.clock.cycle), state.clock.extension.m});
}

void Trajectory::write(const fs::path& file) const {
    std::vector<std::string> words{fs::absolute(data_.path).string(), fs::absolute(file).string()};
    words.insert(words.end(), std::begin(measures::rock_names), std::end(measures::rock_names));
    run_script_with("gsd", "python3-gsd", "trajectory.py", words);
}

/// Name of the file of discs: discs.gsd of all moments, else with those that were asked for.
std::string trajectory_name(const ExportRequest& request, const std::vector<fs::path>& moments) {
    if (request.extensions.empty())
        return "discs.gsd";
    std::vector<std::string> metres;
    for (const fs::path& path : moments)
        metres.push_back(*moment_of_snapshot(path.filename().string()));
    return fmt::format("discs-extension-{}m.gsd", listed(metres));
}

/// Why there is no well.
std::string no_well(const ExportRequest& request, const Observation& now) {
    const std::vector<WellPlace> places = well_places(now, {});
    if (places.empty())
        return fmt::format(
            "{}: no sediment to drill; wells need a scene with sediment and a moment at "
            "which there is some",
            request.output.string());
    return fmt::format("--x {}: no sediment there; the {} is at {:.0f} m",
                       fmt::join(request.wells, ","), places.front().name, places.front().x);
}

/// Tells of each well that was asked for and meets no sediment.
void warn_of_dry_wells(const ExportRequest& request, const LineTable& burial,
                       const fs::path& snapshot) {
    for (const double x : request.wells) {
        const LineValue name = well_place(x).name;
        if (std::ranges::none_of(burial.lines,
                                 [&](const Line& line) { return line.values.front() == name; }))
            warn(fmt::format("--x {}: no sediment there at {}", text(x), snapshot.stem().string()));
    }
}

std::string written(const LineTable& table, const std::string& format) {
    return format == "csv"       ? to_csv(table)
           : format == "geojson" ? to_geojson(table)
           : format == "pl"      ? to_gocad(table)
           : format == "gempy"   ? to_gempy(table)
                                 : to_gmt(table);
}

/// Writes lines in a format that GDAL knows, by what a reader of GeoJSON gets.
void write_by_gdal(const LineTable& table, const fs::path& file) {
    const TemporaryFolder place(file.parent_path());
    const fs::path lines = place.path / "lines.geojson";
    write_text(lines, to_geojson(table));
    run_script_with("osgeo", "python3-gdal", "gis.py",
                    {fs::absolute(lines).string(), fs::absolute(file).string()});
}

/// Writes KIND-SNAPSHOT.FORMAT in every format of lines, with the places of wells that were asked
/// for behind the snapshot, and adds the files to those there are.
void write_lines(LineTable table, std::string_view kind, const fs::path& snapshot,
                 const ExportRequest& request, std::vector<fs::path>& files) {
    table.name = fmt::format("{}-{}", kind, snapshot.stem().string());
    if (!request.wells.empty())
        table.name += fmt::format("-x-{}m", listed(request.wells));
    for (const std::string& format : request.formats) {
        if (format == "gsd")
            continue;
        files.push_back(request.folder / (table.name + "." + format));
        if (format == "gpkg" || format == "dxf")
            write_by_gdal(table, files.back());
        else
            write_text(files.back(), written(table, format));
    }
}

/// Says why a run can have no lines of a kind. Throws UsageError.
void require_lines(const LineTable& table, const Kind& kind, const fs::path& output) {
    if (!table.lines.empty())
        return;
    if (kind.name == "base")
        throw UsageError(output.string() +
                         ": the base of this run is rigid; there is no deflection to export");
    if (kind.name == "layers")
        throw UsageError(output.string() +
                         ": this run's hanging wall is of one rock; layers need [[layer]]");
}

} // namespace

std::vector<std::string_view> export_kinds() {
    std::vector<std::string_view> names;
    for (const Kind& kind : kinds())
        names.push_back(kind.name);
    return names;
}

std::vector<fs::path> export_run(const ExportRequest& wanted) {
    ExportRequest request = wanted;
    const Kind& kind = kind_named(request.kind);
    if (request.formats.empty())
        request.formats = {std::string(kind.formats.front())};
    require_formats(kind, request.formats);
    if (!request.wells.empty() && kind.name != "well")
        throw UsageError(fmt::format("--x: is of export well; export {} has no places", kind.name));
    if (list_snapshots(request.output).empty())
        throw UsageError(request.output.string() +
                         ": no snapshots to export; is this a run's folder?");
    const RunFolder run = shown_run(request.output);
    if (!kind.table && !has_seismics(run.scene))
        throw UsageError(request.output.string() +
                         ": seismics need a hanging wall of 1 km or more");
    const std::vector<fs::path> moments = run.snapshots_at(request.extensions);
    const RunHistory history = kind.needs_faults ? RunHistory(run) : RunHistory();
    if (request.folder.empty())
        request.folder = request.output / "export";
    const fs::path& folder = request.folder;
    make_result_folder(folder);
    std::vector<fs::path> files;
    std::unique_ptr<Trajectory> trajectory;
    if (std::ranges::find(request.formats, "gsd") != request.formats.end())
        trajectory = std::make_unique<Trajectory>(folder);
    std::optional<measures::DiscPlaces> before; // of the snapshot before
    for (const fs::path& path : moments) {
        const Moment moment = run.read(path);
        const Observation now{run.scene, run.parts, moment.state, moment.events};
        const ExportedMoment at{now,
                                kind.needs_faults
                                    ? report_faults(make_setting(run.scene, run.parts),
                                                    run.parts.base, moment.state, history)
                                    : measures::FaultReport(),
                                request.wells};
        if (kind.name == "displacement") {
            LineTable table;
            if (before)
                table = displacement_table(at, *before);
            before.emplace(moment.state);
            if (!table.lines.empty())
                write_lines(std::move(table), kind.name, path, request, files);
            continue;
        }
        if (!kind.table) {
            const auto more =
                export_seismic(at, path.stem().string(), folder, request.formats, request.seismic);
            files.insert(files.end(), more.begin(), more.end());
            continue;
        }
        if (trajectory)
            trajectory->add(at);
        if (trajectory && request.formats.size() == 1)
            continue;
        LineTable table = kind.table(at);
        require_lines(table, kind, request.output);
        const bool is_drilled =
            kind.name == "well" && (!request.extensions.empty() || path == moments.back());
        if (is_drilled) {
            const LineTable burial = burial_table(run, path, request.wells);
            if (burial.lines.empty())
                throw UsageError(no_well(request, now));
            warn_of_dry_wells(request, burial, path);
            write_lines(burial, "burial", path, request, files);
        }
        if (!table.lines.empty() || kind.name != "well") // at the start there is no sediment
            write_lines(std::move(table), kind.name, path, request, files);
    }
    if (kind.name == "displacement" && files.empty())
        throw UsageError(request.output.string() + ": displacement is from one snapshot to the "
                                                   "next: name two moments or more with --at");
    if (trajectory) {
        files.push_back(folder / trajectory_name(request, moments));
        trajectory->write(files.back());
    }
    return files;
}

} // namespace listric
