#include "apps/studies/ensemble/ensemble.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/scene_lines.hpp"
#include "apps/archive/folder/setting.hpp"
#include "apps/archive/tables/exports.hpp"
#include "apps/archive/tables/fault_fields.hpp"
#include "apps/measures/paper/block_edges.hpp"
#include "apps/measures/strata/horizons.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

namespace listric {

using namespace archive;
using measures::Polyline;

namespace {

namespace fs = std::filesystem;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Folders below that hold a finished run, in their order.
std::vector<fs::path> run_folders(const fs::path& folder) {
    std::set<fs::path> found;
    std::error_code error;
    fs::recursive_directory_iterator entries(folder, error);
    for (; !error && entries != fs::recursive_directory_iterator(); entries.increment(error)) {
        if (entries.depth() >= 2)
            entries.disable_recursion_pending();
        if (entries->path().filename() == "summary.json" && entries.depth() > 0 &&
            fs::exists(entries->path().parent_path() / "scene.toml"))
            found.insert(entries->path().parent_path());
    }
    return {found.begin(), found.end()};
}

/// Heights of polylines that go from left to right, at columns.
std::vector<double> heights(const std::vector<Polyline>& pieces, std::size_t columns) {
    std::vector<double> y(columns, none);
    for (const Polyline& piece : pieces)
        for (std::size_t k = 1; k < piece.size(); ++k) {
            const dem::Point a = piece[k - 1], b = piece[k];
            if (!(b.x > a.x))
                continue;
            const auto first =
                static_cast<std::size_t>(std::max(0.0, std::ceil(a.x / ensemble_column)));
            for (std::size_t c = first; c < columns; ++c) {
                const double x = static_cast<double>(c) * ensemble_column;
                if (x > b.x)
                    break;
                y[c] = a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
            }
        }
    return y;
}

/// Names ensembles by their scenes; where scenes of one name differ, by the parameters in which
/// they do.
void name_ensembles(std::vector<Ensemble>& ensembles) {
    std::set<std::string> names;
    for (const Ensemble& e : ensembles)
        names.insert(e.title);
    if (names.size() == ensembles.size())
        return;
    std::map<std::string, std::set<std::string>> values;
    for (const Ensemble& e : ensembles)
        for (const auto& [key, value] : e.scene)
            values[key].insert(value);
    const auto all = static_cast<std::size_t>(ensembles.size());
    for (Ensemble& e : ensembles) {
        std::string title;
        for (const auto& entry : e.scene) {
            const std::string& key = entry.first;
            const auto has = static_cast<std::size_t>(std::ranges::count_if(
                ensembles, [&](const Ensemble& other) { return other.scene.contains(key); }));
            if (!key.starts_with("[") && key != "description" &&
                (values[key].size() > 1 || has < all))
                title += fmt::format("{}{} = {}", title.empty() ? "" : ", ", key, entry.second);
        }
        if (!title.empty())
            e.title = title;
    }
}

/// Takes faults, the greatest throw, the thickest depocentre and all single numbers of a summary.
void add_results(EnsembleRun& end, const JsonObject& summary) {
    for (const auto& [name, value] : summary.items())
        if (value.is_number())
            end.measures[name] = value.get<double>();
    std::optional<double> largest;
    for (const auto& fault : summary.value("faults", nlohmann::ordered_json::array())) {
        EnsembleFault line{{}, fault.value("attitude", "") == "synthetic"};
        for (const auto& point : fault.value(field_points, nlohmann::ordered_json::array()))
            line.points.push_back({point.at(0).get<double>(), -point.at(1).get<double>()});
        if (!line.points.empty())
            end.faults.push_back(std::move(line));
        if (const auto thrown = fault.find(field_greatest_throw);
            thrown != fault.end() && thrown->is_number())
            largest = std::max(largest.value_or(0.0), thrown->get<double>());
    }
    if (largest)
        end.measures[std::string(field_greatest_throw)] = *largest;
    const auto depocentres = summary.value("depocentres", nlohmann::ordered_json::array());
    if (!depocentres.empty()) // the thickest first
        for (const char* key : {"x_m", "thickness_m"})
            if (const auto value = depocentres[0].find(key);
                value != depocentres[0].end() && value->is_number())
                end.measures[fmt::format("depocentre_{}", key)] = value->get<double>();
}

/// Reads the end of a run into its ensemble, which is new for the first of a scene.
void read_run(const fs::path& folder, std::vector<Ensemble>& ensembles) {
    const RunFolder run(folder);
    auto scene = scene_values(read_text(folder / "scene.toml"));
    scene.erase("seed");
    const Moment moment = run.read(run.snapshots.back());
    const measures::Setting setting = make_setting(run.scene, run.parts);
    auto found = std::ranges::find(ensembles, scene, &Ensemble::scene);
    if (found == ensembles.end()) {
        Ensemble ensemble{.title = run.scene.name,
                          .length = run.scene.hanging_wall.length + run.scene.extension.distance,
                          .depth = run.scene.hanging_wall.thickness,
                          .scene = scene};
        const LineTable surfaces =
            reference_surfaces_table({{run.scene, run.parts, moment.state, moment.events}, {}, {}});
        if (!surfaces.lines.empty())
            ensemble.base = surfaces.lines.front().points;
        ensembles.push_back(std::move(ensemble));
        found = ensembles.end() - 1;
    }
    EnsembleRun end{.folder = folder,
                    .seed = static_cast<int>(run.scene.seed),
                    .extension = moment.state.clock.extension.m};
    const auto columns = static_cast<std::size_t>(found->length / ensemble_column) + 1;
    for (const measures::Horizon& horizon :
         measures::trace_horizons(setting, run.parts.base, moment.state, {}, {0.0}))
        if (horizon.stratum >= 0)
            end.tops[horizon.stratum] = heights(horizon.top, columns);
    add_results(end, read_object(folder / "summary.json"));
    end.edges = measures::trace_block_edges({setting, run.parts.base, moment.state, {}});
    found->runs.push_back(std::move(end));
}

} // namespace

bool holds_runs(const fs::path& folder) {
    return !fs::exists(folder / "scene.toml") && !run_folders(folder).empty();
}

std::vector<Ensemble> read_ensembles(const fs::path& folder) {
    std::vector<Ensemble> ensembles;
    for (const fs::path& run : run_folders(folder))
        read_run(run, ensembles);
    if (ensembles.empty())
        throw UsageError(folder.string() + ": holds no finished run in a folder of its own");
    name_ensembles(ensembles);
    return ensembles;
}

std::vector<FaultChance> fault_chances(const Ensemble& ensemble) {
    std::vector<FaultChance> chances;
    for (double x = 0.5 * fault_piece; x < ensemble.length; x += fault_piece) {
        const int met =
            static_cast<int>(std::ranges::count_if(ensemble.runs, [&](const EnsembleRun& run) {
                return std::ranges::any_of(run.faults, [&](const EnsembleFault& fault) {
                    return std::abs(fault.points.front().x - x) <= 0.5 * fault_piece;
                });
            }));
        const int of = static_cast<int>(ensemble.runs.size());
        chances.push_back({x, met, of, probability_limits(met, of)});
    }
    return chances;
}

std::vector<TopSpread> top_spreads(const Ensemble& ensemble) {
    std::set<int> strata;
    for (const EnsembleRun& run : ensemble.runs)
        for (const auto& [stratum, top] : run.tops)
            strata.insert(stratum);
    std::vector<TopSpread> spreads;
    for (const int stratum : strata) {
        TopSpread along{stratum, {}, {}, {}};
        const auto columns = static_cast<std::size_t>(ensemble.length / ensemble_column) + 1;
        for (std::size_t c = 0; c < columns; ++c) {
            std::vector<double> y;
            for (const EnsembleRun& run : ensemble.runs)
                if (const auto top = run.tops.find(stratum);
                    top != run.tops.end() && std::isfinite(top->second[c]))
                    y.push_back(top->second[c]);
            if (y.size() < 2 || 2 * y.size() < ensemble.runs.size())
                continue;
            const Spread s = spread(y);
            along.x.push_back(static_cast<double>(c) * ensemble_column);
            along.mean.push_back(s.mean);
            along.deviation.push_back(s.deviation);
        }
        if (!along.x.empty())
            spreads.push_back(std::move(along));
    }
    return spreads;
}

} // namespace listric
