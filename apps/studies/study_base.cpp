// Studies of the elastic base: elements, refinement and solvers against the exact elastic layer,
// and how the flank rises with the elastic thickness of the footwall.

#include "apps/studies/study.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/model/bending_base.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/model/model.hpp"
#include "apps/studies/plan_file.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/python.hpp"
#include "apps/support/stopwatch.hpp"
#include "coupling/base_memory.hpp"
#include "dem/numbers/elementary.hpp"
#include "fem/elastic_layer.hpp"
#include "fem/footwall.hpp"
#include "fem/plate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace listric {

using namespace archive;
using namespace dem;

namespace {

/// A strip load on a layer that floats: its edges are where elements of uniform size do worst.
struct Strip {
    static constexpr double thickness = 10e3, half_width = 20e3; // m
    static constexpr double pressure = 5e7;                      // Pa
    static constexpr double far = 300e3;                         // m, ten flexural parameters
    static constexpr double compared_to = 120e3;                 // m
    static constexpr double coarsest = 10e3;                     // m
    fem::ElasticLayer layer{70e9, 0.25, thickness, 2700.0 * 9.81, 600.0 * 9.81};

    fem::FootwallRequest request(int degree, fem::Solver solver, int refinements) const {
        fem::FootwallRequest r;
        r.layers = {{0.0, layer.young_modulus, layer.poisson_ratio, 2700.0}};
        r.left = -far;
        r.right = far;
        // A layer that is held on both sides would feel that it cannot grow longer.
        r.right_side = fem::Side::free;
        r.depth = thickness;
        r.surface_spring = layer.top_spring;
        r.base_spring = layer.base_spring;
        r.degree = degree;
        r.solver = solver;
        // The nodes of the layer's middle exist from two rows of cells on.
        r.cell_size = 0.5 * coarsest;
        r.refinements = refinements;
        r.surface_breaks = {-half_width, 0.0, half_width};
        return r;
    }

    fem::Load load() const {
        fem::Load load;
        load.traction = [](fem::Vector p, fem::Vector, fem::Boundary boundary) {
            const bool on = boundary == fem::Boundary::surface && std::abs(p.x) < half_width;
            return on ? fem::Vector{0.0, -pressure} : fem::Vector{};
        };
        return load;
    }

    /// Largest difference from the exact layer along its middle, over the deflection at the centre.
    double error(const fem::Footwall& footwall) const {
        const fem::Field field = footwall.field();
        std::vector<double> x, w;
        for (std::size_t k = 0; k < field.place.size(); ++k)
            if (std::abs(field.place[k].y + 0.5 * thickness) < 1.0 &&
                std::abs(field.place[k].x) <= compared_to) {
                x.push_back(field.place[k].x);
                w.push_back(-field.displacement[k].y);
            }
        const std::vector<double> exact = layer.deflection(x, 0.5 * thickness, [](double q) {
            return 2.0 * pressure * dem::sine(q * half_width) / q;
        });
        double worst = 0.0, greatest = 0.0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            worst = std::max(worst, std::abs(w[k] - exact[k]));
            greatest = std::max(greatest, std::abs(exact[k]));
        }
        return worst / greatest;
    }
};

StudyPoint strip_point(const std::string& method, const Strip& strip, const fem::Footwall& footwall,
                       double seconds) {
    return {method,       fmt::format("unknowns={}", footwall.mesh().unknowns),
            "deflection", strip.error(footwall),
            seconds,      0.0};
}

/// Means of a run's last window, upward: the net loads on the detachment and how it has moved.
struct LastWindow {
    fem::LineLoads loads;
    std::vector<double> uplift; ///< at the loads' x, m
};

/// Throws UsageError where the run is shorter than a window.
LastWindow last_window(const std::filesystem::path& run) {
    const State state = read_snapshot(list_snapshots(run).back()).state;
    const auto means_of_window = coupling::last_window_means(state);
    if (!means_of_window)
        throw UsageError(run.string() + ": ends within its first window, of which no mean load is "
                                        "known: raise extension.distance_m to output.interval_m");
    const coupling::ConstInterfaceMeans& means = *means_of_window;
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

/// Fills of the basin, as changes of the scene.
struct Fill {
    std::string name, without, set;
};

struct IsostasyPlan {
    std::string vary;       ///< the parameter that is the elastic thickness
    std::string water_load; ///< measure of a run; missing where there is no water
    std::vector<Fill> fills;
};

IsostasyPlan read_isostasy_plan() {
    using P = IsostasyPlan;
    const toml::table document = study_plan("isostasy");
    const PlanTable<P> table{"",
                             {plan_key("vary", at<&P::vary>, "the elastic thickness, table.key"),
                              plan_key("water_load", at<&P::water_load>, "measure")},
                             {},
                             {"fill"}};
    const PlanTable<Fill> fill{"",
                               {plan_key("name", at<&Fill::name>, "of the runs"),
                                plan_key("without", at<&Fill::without>, "tables taken out"),
                                plan_key("set", at<&Fill::set>, "changes, table.key=value")}};
    P plan = table.read({document, ""});
    for (const Entry& entry : tables({document, ""}, "fill"))
        plan.fills.push_back(fill.read(entry));
    return plan;
}

/// Tables that the scene has not need not be taken out.
StudyRun run_of(const IsostasyPlan& plan, const Scene& scene, const Fill& fill, double thickness) {
    std::vector<std::string> without = words(fill.without);
    std::erase_if(without, [&](const std::string& table) { return !has_effect(scene, table); });
    return {fmt::format("{}-elastic_thickness_m={:g}", fill.name, thickness),
            words(fmt::format("{}={} {}", plan.vary, thickness, fill.set)), "draft",
            std::move(without)};
}

fem::Plate plate_of(const Scene& scene, double thickness) {
    const BendingBase& base = *bending_base(scene);
    return {base.young_modulus, base.poisson_ratio, thickness,
            (base.floats_on() - base.infill_density) * make_parts(scene).gravity};
}

/// A finished run: its summary and its last window beside the plate under the same loads.
struct IsostasyRun {
    const Fill& fill;
    std::int64_t seed;
    JsonObject summary;
    fem::Plate plate;
    LastWindow last;

    double value(const char* name) const { return need_number(summary, name); }

    /// The plate's deflection under the loads as they are spread, where the breakaway is, m.
    double at_breakaway(fem::PlateKind kind) const {
        return plate.deflection(0.0, last.loads, kind);
    }

    /// A line of isostasy.csv.
    std::string row(const std::string& water_load) const {
        using enum fem::PlateKind;
        const auto fit = [&](fem::PlateKind kind) {
            return fem::fit_thickness(plate, last.loads, kind, last.loads.x, last.uplift);
        };
        const fem::PlateFit end = fit(broken), whole = fit(continuous);
        return fmt::format(
            "{},{:g},{},{:.1f},{:.1f},{:.4g},{:.3g},{:.4g},{:.1f},{:.1f},{:.0f},{:.0f},"
            "{:.3f},{:.0f},{:.3f},{:.3g},{:.3g}\n",
            fill.name, plate.thickness, seed, value(effects::footwall_uplift),
            value(effects::base_deflection), value(effects::net_wall_load),
            value(effects::net_wall_load_error),
            number_at(summary, water_load.c_str()).value_or(0.0), at_breakaway(continuous),
            at_breakaway(broken), local_compensation(plate, last.loads), end.thickness, end.misfit,
            whole.thickness, whole.misfit, value(effects::strong_rock_strain),
            value(effects::relaxed_rock_strain));
    }

    StudyPoint point() const {
        const double plates = at_breakaway(fem::PlateKind::continuous), wall = value("wall_s");
        return {fmt::format("{} fill: from the continuous plate", fill.name),
                fmt::format("elastic_thickness_m={:g}", plate.thickness),
                "uplift",
                std::abs(value(effects::footwall_uplift) / plates - 1.0),
                wall,
                wall * value("disc_steps_per_s")};
    }
};

/// The run by one seed; none if the guard of linear elasticity ended it.
std::optional<IsostasyRun> make_run(const StudyRequest& request, const Scene& scene,
                                    const IsostasyPlan& plan, const Fill& fill, double thickness,
                                    std::int64_t seed) {
    const SeededRun alone[]{{run_of(plan, scene, fill, thickness), seed}};
    auto summary = summaries_of_runs(request, alone)[0];
    if (!summary)
        return std::nullopt;
    return IsostasyRun{fill, seed, std::move(*summary), plate_of(scene, thickness),
                       last_window(folder_of_run(request, alone[0].run, seed))};
}

constexpr const char* csv_head = "fill,elastic_thickness_m,seed,uplift_m,deflection_max_m,"
                                 "net_load_n_per_m,net_load_error,water_n_per_m,continuous_plate_m,"
                                 "broken_plate_m,local_m,"
                                 "fitted_thickness_m,fit_misfit,fitted_continuous_thickness_m,"
                                 "continuous_fit_misfit,strong_rock_strain,relaxed_rock_strain\n";

} // namespace

StudyResult study_footwall(const StudyRequest& request) {
    StudyResult result;
    result.title = "Elastic base: strip load against the exact layer";
    const Strip strip;
    // The plug-in is loaded before any clock runs.
    fem::make_footwall(strip.request(1, fem::Solver::mumps, 0));
    struct Method {
        const char* name;
        int degree;
        fem::Solver solver;
        int levels;
    };
    constexpr int usual = 3, largest = 5; // refinements, each of four times the elements
    const double asked = request.values.empty() ? usual : request.values[0];
    if (request.values.size() > 1 || asked > largest || asked != std::floor(asked))
        throw UsageError(fmt::format("study footwall: --values {}: allowed: one number of "
                                     "refinements, 1 to {}",
                                     fmt::join(request.values, ","), largest));
    const int most = static_cast<int>(asked);
    for (const Method& m : {Method{"Q1 uniform MUMPS", 1, fem::Solver::mumps, most + 1},
                            Method{"Q2 uniform MUMPS", 2, fem::Solver::mumps, most},
                            Method{"Q2 uniform BoomerAMG", 2, fem::Solver::boomeramg, most},
                            Method{"Q2 uniform GAMG", 2, fem::Solver::gamg, most}})
        for (int level = 0; level <= m.levels; ++level) {
            request.stop.check();
            const auto start = SteadyClock::now();
            const auto footwall = fem::make_footwall(strip.request(m.degree, m.solver, level));
            footwall->solve(strip.load());
            result.points.push_back(strip_point(m.name, strip, *footwall, seconds_since(start)));
        }
    for (int degree : {1, 2}) {
        const auto start = SteadyClock::now();
        const auto footwall = fem::make_footwall(strip.request(degree, fem::Solver::mumps, 0));
        for (int step = 0; step <= 2 * most + 2; ++step) {
            request.stop.check();
            if (step > 0)
                footwall->refine(0.2);
            footwall->solve(strip.load());
            result.points.push_back(strip_point(fmt::format("Q{} adaptive MUMPS", degree), strip,
                                                *footwall, seconds_since(start)));
        }
    }
    return result;
}

StudyResult study_isostasy(const StudyRequest& asked) {
    const StudyRequest request = with_scene(asked, "lis1-elastic");
    const Scene scene = scene_of(request);
    if (!bending_base(scene))
        throw UsageError(fmt::format("study isostasy: {} has no base that bends; allowed: scenes "
                                     "such as lis1-elastic",
                                     request.scene));
    std::vector<double> thicknesses =
        request.values.empty() ? std::vector{2e3, 5e3, 10e3, 15e3, 30e3} : request.values;
    std::ranges::sort(thicknesses);
    const IsostasyPlan plan = read_isostasy_plan();
    StudyResult result;
    result.title =
        fmt::format("Isostasy: flank uplift of {} against the thin plate", request.scene);
    std::string table = csv_head;
    for (const Fill& fill : plan.fills)
        for (double thickness : thicknesses)
            for (int k = 0; k < request.seeds; ++k)
                if (const auto run =
                        make_run(request, scene, plan, fill, thickness, request.seed + k)) {
                    table += run->row(plan.water_load);
                    result.points.push_back(run->point());
                } else {
                    result.points.push_back({fmt::format("{} fill: runs", fill.name),
                                             fmt::format("elastic_thickness_m={:g}", thickness),
                                             "uplift", std::numeric_limits<double>::infinity(), 0.0,
                                             0.0});
                }
    write_text(request.output / "isostasy.csv", table);
    draw_or_warn("isostasy.py", {std::filesystem::absolute(request.output).string()});
    return result;
}

} // namespace listric
