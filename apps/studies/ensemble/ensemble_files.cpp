#include "apps/archive/folder/output_folder.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/studies/ensemble/ensemble.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/python.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace listric {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string chances_csv(const std::vector<Ensemble>& ensembles) {
    std::string text = "scene,x_m,runs,with_fault,low_95,high_95\n";
    for (const Ensemble& e : ensembles)
        for (const FaultChance& c : fault_chances(e))
            text += fmt::format("{},{},{},{},{:.4f},{:.4f}\n", csv_cell(e.title), c.x, c.of, c.met,
                                c.limits.lower, c.limits.upper);
    return text;
}

std::string tops_csv(const std::vector<Ensemble>& ensembles) {
    std::string text = "scene,stratum,x_m,depth_m,deviation_m\n";
    for (const Ensemble& e : ensembles)
        for (const TopSpread& top : top_spreads(e))
            for (std::size_t k = 0; k < top.x.size(); ++k)
                text += fmt::format("{},{},{},{:.1f},{:.1f}\n", csv_cell(e.title), top.stratum,
                                    top.x[k], -top.mean[k], top.deviation[k]);
    return text;
}

/// Numbers that every run of an ensemble has, and that are not its own settings.
std::string measures_csv(const std::vector<Ensemble>& ensembles) {
    std::string text = "scene,measure,runs,mean,deviation,least,greatest\n";
    const std::set<std::string> settings{
        "seed", "threads", "ranks", "wall_s", "predicted_wall_s", "disc_steps_per_s", "cycles"};
    for (const Ensemble& e : ensembles)
        for (const auto& [name, first] : e.runs.front().measures) {
            std::vector<double> values;
            for (const EnsembleRun& run : e.runs)
                if (const auto value = run.measures.find(name); value != run.measures.end())
                    values.push_back(value->second);
            if (settings.contains(name))
                continue;
            const Spread s = spread(values);
            text +=
                fmt::format("{},{},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", csv_cell(e.title), name,
                            values.size(), s.mean, s.deviation, *std::ranges::min_element(values),
                            *std::ranges::max_element(values));
        }
    return text;
}

Json points_json(const measures::Polyline& points) {
    Json list = Json::array();
    for (const dem::Point p : points)
        list.push_back({p.x, p.y});
    return list;
}

/// Heights without what is none.
Json top_json(int stratum, const std::vector<double>& heights) {
    Json x = Json::array(), y = Json::array();
    for (std::size_t c = 0; c < heights.size(); ++c)
        if (std::isfinite(heights[c])) {
            x.push_back(static_cast<double>(c) * ensemble_column);
            y.push_back(heights[c]);
        }
    return {{"stratum", stratum}, {"x", x}, {"y", y}};
}

Json run_json(const EnsembleRun& run, const fs::path& folder) {
    Json faults = Json::array(), edges = Json::array(), tops = Json::array();
    for (const EnsembleFault& fault : run.faults)
        faults.push_back({{"synthetic", fault.synthetic}, {"points", points_json(fault.points)}});
    for (const measures::Polyline& edge : run.edges)
        edges.push_back(points_json(edge));
    for (const auto& [stratum, heights] : run.tops)
        tops.push_back(top_json(stratum, heights));
    return {{"folder", fs::relative(run.folder, folder).string()},
            {"seed", run.seed},
            {"extension_m", run.extension},
            {"has_report", fs::exists(run.folder / "report.html")},
            {"faults", faults},
            {"edges", edges},
            {"tops", tops},
            {"measures", run.measures}};
}

Json ensemble_json(const Ensemble& e, const fs::path& folder) {
    Json json{{"title", e.title},
              {"length_m", e.length},
              {"depth_m", e.depth},
              {"base", points_json(e.base)}};
    for (const EnsembleRun& run : e.runs)
        json["runs"].push_back(run_json(run, folder));
    for (const FaultChance& c : fault_chances(e))
        json["chances"].push_back({c.x, c.met, c.of, c.limits.lower, c.limits.upper});
    for (const TopSpread& top : top_spreads(e))
        json["tops"].push_back({{"stratum", top.stratum},
                                {"x", top.x},
                                {"mean", top.mean},
                                {"deviation", top.deviation}});
    return json;
}

} // namespace

std::vector<fs::path> draw_ensembles(const fs::path& folder, bool page) {
    std::vector<archive::OwnFile> written{{folder / "seeds.csv", "scene,x_m,runs,"},
                                          {folder / "seed-tops.csv", "scene,stratum,x_m,"},
                                          {folder / "seed-measures.csv", "scene,measure,runs,"},
                                          {folder / "seeds.png", "Listric"},
                                          {folder / "seeds-apart.png", "Listric"}};
    if (page)
        written.push_back({folder / "report.html", "<title>Listric"});
    archive::require_own(written, {});
    const std::vector<Ensemble> ensembles = read_ensembles(folder);
    write_text(folder / "seeds.csv", chances_csv(ensembles));
    write_text(folder / "seed-tops.csv", tops_csv(ensembles));
    write_text(folder / "seed-measures.csv", measures_csv(ensembles));
    Json data = Json::array();
    for (const Ensemble& ensemble : ensembles)
        data.push_back(ensemble_json(ensemble, folder));
    const TemporaryFolder place(folder);
    write_text(place.path / "seeds.json", to_text(Json{{"ensembles", data}}));
    run_drawing_script("seeds.py", {(place.path / "seeds.json").string(),
                                    fs::absolute(folder).string(), page ? "page" : "picture"});
    std::vector<fs::path> files{folder / "seeds.png", folder / "seeds-apart.png"};
    if (page)
        files.push_back(folder / "report.html");
    return files;
}

} // namespace listric
