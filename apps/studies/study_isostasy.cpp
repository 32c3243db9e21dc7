// How the flank rises with the elastic thickness of the footwall.

#include "apps/studies/study.hpp"

#include "apps/archive/run_folder.hpp"
#include "apps/archive/snapshot.hpp"
#include "apps/figures/figures.hpp"
#include "apps/run/run.hpp"
#include "apps/support/python.hpp"
#include "coupling/base_memory.hpp"
#include "fem/plate.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace listric {

using namespace archive;
using namespace dem;

namespace {

/// Means of a run's last window, upward: the net loads on the detachment and how it has moved.
struct LastWindow {
    fem::LineLoads loads;
    std::vector<double> uplift; ///< at the loads' x, m
};

LastWindow last_window(const std::filesystem::path& run) {
    const State state = read_snapshot(list_snapshots(run).back()).state;
    const coupling::ConstInterfaceMeans means = coupling::last_window_means(state).value();
    LastWindow result;
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        result.loads.x.push_back(nodes.x[k]);
        result.loads.load.push_back(means.force[2 * k + 1] +
                                    (means.effects.empty() ? 0.0 : means.effects[2 * k + 1]));
        result.uplift.push_back(means.displacement[2 * k + 1]);
    }
    return result;
}

/// Airy's limit: the largest deflection of a plate too thin to spread the loads.
double local_compensation(fem::Plate plate, const fem::LineLoads& loads) {
    plate.thickness = 300.0; // flexural parameter 2 km, some nodes' distance
    double most = 0.0;
    for (const double x : loads.x)
        most = std::max(most, plate.deflection(x, loads, fem::PlateKind::continuous));
    return most;
}

} // namespace

StudyResult study_isostasy(const StudyRequest& asked) {
    StudyRequest request = asked;
    if (request.scene.empty())
        request.scene = "lis1-elastic";
    SceneRequest scene_request;
    scene_request.scene = request.scene;
    scene_request.set = request.set;
    const Scene scene = load_scene(scene_request);
    if (!scene.elastic_base || !scene.hanging_wall)
        throw UsageError(fmt::format("study isostasy: {} has no discs on an [elastic_base]; "
                                     "allowed: scenes such as lis1-elastic",
                                     request.scene));
    std::vector<double> thicknesses =
        request.values.empty() ? std::vector{2e3, 5e3, 10e3, 15e3, 30e3} : request.values;
    std::ranges::sort(thicknesses);
    struct Fill {
        const char* name;
        std::vector<std::string> without, set;
    };
    const std::vector<Fill> fills{{"sediment", {}, {}},
                                  {"water", {"sedimentation", "compaction"}, {"basin_water={}"}},
                                  {"empty", {"sedimentation", "compaction"}, {}}};

    StudyResult result;
    result.title =
        fmt::format("Isostasy: flank uplift of {} against the thin plate", request.scene);
    std::string table = "fill,elastic_thickness_m,seed,uplift_m,deflection_max_m,"
                        "net_load_n_per_m,net_load_error,water_n_per_m,continuous_plate_m,"
                        "broken_plate_m,local_m,"
                        "fitted_thickness_m,fit_misfit,fitted_continuous_thickness_m,"
                        "continuous_fit_misfit,strong_rock_strain,relaxed_rock_strain\n";
    for (const Fill& fill : fills)
        for (double thickness : thicknesses)
            for (int k = 0; k < request.seeds; ++k) {
                StudyRun run{fmt::format("{}-elastic_thickness_m={:g}", fill.name, thickness),
                             {fmt::format("elastic_base.elastic_thickness_m={}", thickness)},
                             "draft",
                             fill.without};
                run.set.insert(run.set.end(), fill.set.begin(), fill.set.end());
                const std::string parameter = fmt::format("elastic_thickness_m={:g}", thickness);
                const auto summary = summary_of_run(request, run, request.seed + k);
                if (!summary) { // the guard of linear elasticity
                    result.points.push_back({fmt::format("{} fill: runs", fill.name), parameter,
                                             "uplift", std::numeric_limits<double>::infinity(), 0.0,
                                             0.0});
                    continue;
                }
                const auto value = [&](const char* name) {
                    return summary->at(name).get<double>();
                };
                const ElasticBaseParameters& base = *scene.elastic_base;
                const double gravity = scene.gravity->acceleration;
                const fem::Plate plate{base.young_modulus, base.poisson_ratio, thickness,
                                       (base.mantle_density - base.infill_density) * gravity};
                const double load = value("net_wall_load_n_per_m"),
                             uplift = value("footwall_uplift_m"),
                             water = summary->value("basin_water_n_per_m", 0.0);
                // Under the loads as they are spread, where the breakaway is.
                const LastWindow last = last_window(folder_of_run(request, run, request.seed + k));
                using enum fem::PlateKind;
                const double at_breakaway = plate.deflection(0.0, last.loads, continuous),
                             when_broken = plate.deflection(0.0, last.loads, broken);
                const fem::PlateFit fit = fem::fit_thickness(plate, last.loads, broken,
                                                             last.loads.x, last.uplift),
                                    whole = fem::fit_thickness(plate, last.loads, continuous,
                                                               last.loads.x, last.uplift);
                table += fmt::format(
                    "{},{:g},{},{:.1f},{:.1f},{:.4g},{:.3g},{:.4g},{:.1f},{:.1f},{:.0f},{:.0f},"
                    "{:.3f},{:.0f},{:.3f},{:.3g},{:.3g}\n",
                    fill.name, thickness, request.seed + k, uplift, value("base_deflection_max_m"),
                    load, value("net_wall_load_error"), water, at_breakaway, when_broken,
                    local_compensation(plate, last.loads), fit.thickness, fit.misfit,
                    whole.thickness, whole.misfit, value("strong_rock_strain_max"),
                    value("relaxed_rock_strain_max"));
                const double wall = value("wall_s");
                result.points.push_back(
                    {fmt::format("{} fill: from the continuous plate", fill.name), parameter,
                     "uplift", std::abs(uplift / at_breakaway - 1.0), wall,
                     wall * value("disc_steps_per_s")});
            }
    write_text(request.output / "isostasy.csv", table);
    if (const std::string problem = run_drawing_script("isostasy.py", {request.output.string()});
        !problem.empty())
        std::fputs(fmt::format("listric: warning: no figure: {}\n", problem).c_str(), stderr);
    return result;
}

} // namespace listric
