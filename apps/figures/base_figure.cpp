#include "apps/figures/base_figure.hpp"

#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/figures/figures.hpp"
#include "apps/figures/vocabulary.hpp"
#include "apps/model/base_driver.hpp"
#include "apps/model/model.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/files/npy.hpp"
#include "apps/support/machine/python.hpp"
#include "apps/support/words/moment_names.hpp"
#include "dem/contacts/power_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace listric {

using namespace archive;
using namespace dem;

namespace fs = std::filesystem;

namespace {

constexpr const char* base_header = "extension_m,x_m,y_m,ux_m,uy_m\n";
constexpr const char* uplift_header = "extension_m,x_m,uplift_m\n";

/// Writes a table of the run into a folder, but not over a file of somebody's that has its name. In
/// a scene with stages moments are told apart by the travel, which stands before the extension.
void write_table(const RunFolder& run, const fs::path& file, const std::string& header,
                 const std::string& rows) {
    const std::string there = read_text_if_there(file);
    if (!there.empty() && there.substr(0, there.find('\n') + 1).find(header) == there.npos)
        throw UsageError(file.string() + ": is no table of a run, which would be written there; "
                                         "move it or give it another name");
    const std::string_view travel = run.parts.base.motion.stages.empty() ? "" : "travel_m,";
    write_text(file, fmt::format("{}{}{}", travel, header, rows));
}

/// First columns of a row.
std::string moment_columns(const RunFolder& run, const State& state) {
    const int decimals = decimals_for(run.scene.output.interval);
    const std::string extension = fmt::format("{:.{}f},", state.clock.extension.m, decimals);
    return run.parts.base.motion.stages.empty()
               ? extension
               : fmt::format("{:.{}f},{}", state.clock.travel.m, decimals, extension);
}

/// Beyond this x the picture ends, m, left of the breakaway and right of the wall.
constexpr double margin = 100e3;

/// The snapshots nearest to a fifth, half and the whole of the newest one's extension.
std::vector<fs::path> shown(const std::vector<fs::path>& snapshots) {
    const double end = snapshot_extension(snapshots.back());
    std::vector<fs::path> paths;
    for (const double share : {0.2, 0.5, 1.0})
        paths.push_back(*std::ranges::min_element(snapshots, {}, [&](const fs::path& path) {
            return std::abs(snapshot_extension(path) - share * end);
        }));
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
    return paths;
}

/// Uplift of the footwall's surface, then of the detachment.
std::string uplift_rows(const State& state, const fem::Field& field, const std::string& moment,
                        int decimals) {
    std::string rows;
    const auto add = [&](double x, double uplift) {
        rows += fmt::format("{}{:.{}f},{:.{}f}\n", moment, x, decimals, uplift, decimals + 2);
    };
    for (const std::size_t k : field.surface)
        if (field.place[k].x < 0.0 && field.place[k].x > -margin)
            add(field.place[k].x, field.displacement[k].y);
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    for (std::size_t k = 0; k < nodes.x.size(); ++k)
        add(nodes.x[k], nodes.uy[k]);
    return rows;
}

/// Plain arrays for the drawing script: corners x, y and displacements of the patches, stress xx,
/// yy, xy, and 1 where the rock is relaxed; the end of the scale of their largest shear stress,
/// MPa; discs x, y, radius, stratum, y at the start.
void export_section(const Observation& now, const std::vector<fem::StressPatch>& patches,
                    const fs::path& folder) {
    const ConstDiscColumns d = disc_columns(now.state);
    const double right = now.right_end() + margin;
    std::vector<double> rows;
    for (const fem::StressPatch& p : patches) {
        if (p.corner[0].x < -margin || p.corner[0].x > right)
            continue;
        for (std::size_t k = 0; k < 4; ++k)
            rows.insert(rows.end(),
                        {p.corner[k].x, p.corner[k].y, p.displacement[k].x, p.displacement[k].y});
        rows.insert(rows.end(), {p.xx, p.yy, p.xy, p.is_relaxed ? 1.0 : 0.0});
    }
    write_npy<double>(folder / "patches.npy", rows, 20);
    write_npy<double>(folder / "end.npy", std::vector{shear_end(patches, now.right_end())});
    rows.clear();
    const std::vector<double> radius = rock_radii(now.state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        rows.insert(rows.end(),
                    {d.x[i], d.y[i], radius[i], static_cast<double>(d.stratum[i]), d.start_y[i]});
    write_npy<double>(folder / "discs.npy", rows, 5);
}

/// Recovers the footwall's field at the moments that are shown, and leaves the arrays of the last.
/// False if there is no such field.
/// @param tables  folder of footwall.csv
bool export_footwall(const RunFolder& run, const fs::path& folder, const fs::path& tables) {
    std::vector<std::unique_ptr<Event>> events;
    const std::unique_ptr<BaseDriver> driver = make_base_driver(run.scene, run.parts, {}, events);
    const int decimals = decimals_for(run.scene.output.interval);
    std::string rows;
    const std::vector<fs::path> moments = shown(run.snapshots);
    for (const fs::path& path : moments) {
        Snapshot snapshot = read_snapshot(path);
        hand_over(snapshot, events, path);
        const fem::Footwall* footwall = driver ? driver->recover(snapshot.state) : nullptr;
        if (!footwall)
            return false;
        rows += uplift_rows(snapshot.state, footwall->field(), moment_columns(run, snapshot.state),
                            decimals);
        if (path == moments.back())
            export_section({run.scene, run.parts, snapshot.state, events}, footwall->stress(),
                           folder);
    }
    write_table(run, tables / "footwall.csv", uplift_header, rows);
    return true;
}

} // namespace

void draw_base(const RunFolder& run, const fs::path& tables, const fs::path& pictures,
               const PictureOrder& order) {
    const int decimals = decimals_for(run.scene.output.interval);
    std::string rows;
    for (const fs::path& path : run.snapshots) {
        const State state = read_snapshot(path).state;
        const ConstBaseNodeColumns nodes = base_node_columns(state);
        const std::string moment = moment_columns(run, state);
        for (std::size_t k = 0; k < nodes.x.size(); ++k)
            rows += fmt::format("{1}{2:.{0}f},{3:.{0}f},{5:.{4}f},{6:.{4}f}\n", decimals, moment,
                                nodes.x[k], nodes.y[k], decimals + 2, nodes.ux[k], nodes.uy[k]);
    }
    write_table(run, tables / "base.csv", base_header, rows);
    const fs::path folder = fs::absolute(tables), figures = fs::absolute(pictures);
    run_drawing_script("base.py", {folder.string(), figures.string(), order.text()});
    const TemporaryFolder data(figures);
    if (export_footwall(run, data.path, folder))
        run_drawing_script("footwall.py",
                           {folder.string(), data.path.string(), figures.string(), order.text()});
}

void draw_flexure(const fs::path& output, const fs::path& pictures, const PictureOrder& order) {
    std::error_code error;
    fs::create_directories(pictures, error);
    run_drawing_script("flexure.py", {fs::absolute(output).string(),
                                      fs::absolute(pictures).string(), order.text()});
}

} // namespace listric
