// Studies that are made of whole runs.

#include "apps/studies/study.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/known_errors.hpp"
#include "apps/measures/dictionary.hpp"
#include "apps/measures/faults/main_faults.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/run/batch.hpp"
#include "apps/run/exit_code.hpp"
#include "apps/studies/plan_file.hpp"
#include "apps/support/words/log.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/numbers/elementary.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

namespace listric {

using namespace dem;

namespace {

using Json = JsonObject;
using Values = std::vector<double>; ///< one number, or the coordinates of a place

constexpr double graben_from = 12e3; ///< x beyond which a depocentre is the collapse graben's, m

/// A quantity of a finished run; nothing where it has no meaning.
std::optional<Values> value_in(const Json& summary, const std::string& quantity) {
    if (quantity == "cutoff") {
        const auto x =
            number_at(summary, measures::name_of<&measures::Measures::cutoff, &Point::x>().c_str());
        const auto y =
            number_at(summary, measures::name_of<&measures::Measures::cutoff, &Point::y>().c_str());
        return x && y ? std::optional(Values{*x, *y}) : std::nullopt;
    }
    if (quantity == "depocentre") {
        const auto found = summary.find(std::string(measures::depocentres.name));
        if (found == summary.end())
            return std::nullopt;
        std::optional<Values> best;
        double most = 0.0;
        for (const Json& place : *found) {
            const double x = need_number(place, "x_m"),
                         prominence = need_number(place, "prominence_m");
            if (x > graben_from && (!best || prominence > most)) {
                best = Values{x, need_number(place, "thickness_m")};
                most = prominence;
            }
        }
        return best;
    }
    const auto number = number_at(summary, quantity.c_str());
    return number ? std::optional(Values{*number}) : std::nullopt;
}

double distance(const Values& a, const Values& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum);
}

Values mean(const std::vector<Values>& of) {
    Values sum(of[0].size(), 0.0);
    for (const Values& v : of)
        for (std::size_t k = 0; k < v.size(); ++k)
            sum[k] += v[k] / static_cast<double>(of.size());
    return sum;
}

std::vector<Values> values_of(const std::vector<std::optional<Json>>& seeds,
                              const std::string& quantity) {
    std::vector<Values> values;
    for (const auto& summary : seeds)
        if (const auto value = summary ? value_in(*summary, quantity) : std::nullopt)
            values.push_back(*value);
    return values;
}

/// Time of a run without its figures: mean over seeds.
void add_costs(const std::vector<std::optional<Json>>& seeds, StudyPoint& point) {
    double counted = 0.0;
    for (const auto& summary : seeds)
        if (summary) {
            const double wall = need_number(*summary, "wall_s");
            point.wall +=
                wall - number_at(object_at(*summary, "time_by_part_s"), "figures").value_or(0.0);
            point.disc_steps += wall * need_number(*summary, "disc_steps_per_s");
            counted += 1.0;
        }
    point.wall /= std::max(1.0, counted);
    point.disc_steps /= std::max(1.0, counted);
}

double root_mean_square(const std::vector<Values>& values, const Values& reference, double scale) {
    double sum = 0.0;
    for (const Values& v : values) {
        const double off = distance(v, reference) / scale;
        sum += off * off;
    }
    return std::sqrt(sum / static_cast<double>(values.size()));
}

} // namespace

StudyRequest with_scene(StudyRequest request, const char* scene) {
    if (request.scene.empty())
        request.scene = scene;
    return request;
}

Scene scene_of(const StudyRequest& request) {
    return load_scene({.scene = request.scene, .set = request.set});
}

std::vector<StudyRun> runs_along(std::string_view name, std::string_view parameter,
                                 const std::vector<double>& values,
                                 const std::vector<std::string>& set,
                                 const std::optional<std::string>& accuracy) {
    std::vector<StudyRun> runs;
    for (const double value : values) {
        runs.push_back({fmt::format("{}={:g}", name, value), set, accuracy});
        runs.back().set.push_back(fmt::format("{}={}", parameter, value));
    }
    return runs;
}

namespace {

Scene scene_of_run(const StudyRequest& request, const StudyRun& run, std::int64_t seed) {
    SceneRequest scene{request.scene, run.set, run.without, run.accuracy, seed};
    scene.set.insert(scene.set.end(), request.set.begin(), request.set.end());
    return load_scene(scene);
}

/// Row of a run in the record; none of a scene that is not a shipped one.
std::optional<archive::RecordedRun> recorded(const StudyRequest& request, const SeededRun& made,
                                             const Json& summary) {
    const Scene scene = scene_of_run(request, made.run, made.seed);
    if (!archive::departs_from_record(scene).empty())
        return std::nullopt;
    const Json provenance = object_at(summary, "provenance");
    archive::RecordedRun run{
        .record = fmt::format("listric study {} --scene {}", request.name, scene.name),
        .scene = scene.name,
        .made_by =
            fmt::format("{}+{}", text_at(provenance, "version"), text_at(provenance, "commit")),
        .mean_radius = scene.hanging_wall.mean_radius,
        .pace = archive::pace_of(scene),
        .extension = scene.extension.distance,
        .seed = static_cast<int>(made.seed),
        .measures = {}};
    for (const archive::HeadlineMeasure& measure : archive::headline_measures())
        if (const auto value = number_at(summary, measure.key.c_str()))
            run.measures[measure.key] = *value;
    return run;
}

} // namespace

std::filesystem::path folder_of_run(const StudyRequest& request, const StudyRun& run,
                                    std::int64_t seed) {
    return request.output / "runs" / fmt::format("{}-seed={}", run.parameter, seed);
}

std::vector<std::optional<Json>> summaries_of_runs(const StudyRequest& request,
                                                   std::span<const SeededRun> wanted) {
    std::vector<BatchRun> runs;
    for (const auto& [run, seed] : wanted)
        runs.push_back({fmt::format("{}, seed {}", run.parameter, seed),
                        scene_of_run(request, run, seed),
                        request.options_of_run(folder_of_run(request, run, seed), true)});
    Log log(request.quiet);
    // One at a time: what a run takes is what is studied.
    const std::vector<BatchEnding> endings = make_runs(runs, request, log);
    std::vector<std::optional<Json>> summaries;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        if (endings[k].exit_code == static_cast<int>(ExitCode::numerics_failed)) {
            warn(fmt::format("{}: {}", runs[k].name, endings[k].reason));
            summaries.emplace_back();
            continue;
        }
        require_finished(runs[k], endings[k]);
        summaries.emplace_back(read_object(runs[k].options.output / "summary.json"));
    }
    return summaries;
}

void sweep_runs(const StudyRequest& request, const std::string& method,
                const std::vector<StudyRun>& runs, const std::vector<StudyQuantity>& quantities,
                StudyResult& result) {
    std::vector<SeededRun> seeded;
    for (const StudyRun& run : runs)
        for (int k = 0; k < std::min(request.seeds, run.most_seeds); ++k)
            seeded.push_back({run, request.seed + k});
    const auto all = summaries_of_runs(request, seeded);
    for (std::size_t k = 0; k < all.size(); ++k)
        if (auto run = all[k] ? recorded(request, seeded[k], *all[k]) : std::nullopt)
            result.runs.push_back(std::move(*run));
    std::vector<std::vector<std::optional<Json>>> summaries;
    auto next = all.begin();
    for (const StudyRun& run : runs) {
        const auto end = next + std::min(request.seeds, run.most_seeds);
        summaries.emplace_back(next, end);
        next = end;
    }
    for (const StudyQuantity& quantity : quantities) {
        const std::vector<Values> best = values_of(summaries.back(), quantity.name);
        if (best.empty())
            continue;
        const Values wanted = quantity.is_error ? Values(best[0].size(), 0.0) : mean(best);
        const double scale = quantity.is_error      ? 1.0
                             : quantity.scale > 0.0 ? quantity.scale
                                                    : distance(wanted, Values(wanted.size(), 0.0));
        // The spread of the reference, or of the next finest that has one.
        for (std::size_t r = runs.size(); r-- > 0 && !quantity.is_error;)
            if (const auto seeds = values_of(summaries[r], quantity.name); seeds.size() > 1) {
                result.floors[quantity.name] = root_mean_square(seeds, mean(seeds), scale);
                break;
            }
        for (std::size_t r = 0; r < runs.size(); ++r) {
            if (r + 1 == runs.size() && !quantity.is_error)
                continue;
            const std::vector<Values> values = values_of(summaries[r], quantity.name);
            StudyPoint point{method,        runs[r].parameter,
                             quantity.name, std::numeric_limits<double>::infinity(),
                             0.0,           0.0};
            if (!values.empty())
                point.error = root_mean_square(values, wanted, scale);
            add_costs(summaries[r], point);
            result.points.push_back(point);
        }
    }
}

namespace {

/// Geometry, and what faults are judged by. Lengths over the thickness of the hanging wall.
std::vector<StudyQuantity> basin_quantities(const Scene& scene) {
    const double thickness = scene.hanging_wall.thickness;
    return {{measures::name_of<&measures::Measures::rollover_tilt>(), 0.0},
            {"cutoff", thickness},
            {measures::name_of<&measures::Measures::area_balance>(), 0.0},
            {"depocentre", thickness},
            {std::string(measures::antithetic_foot), thickness},
            {measures::name_of<&measures::Measures::strain_top10>(), 0.0},
            {measures::name_of<&measures::Measures::basement_unbonded_fraction>(), 1.0},
            {measures::name_of<&measures::Measures::unbalanced_ratio_mean>(), 0.0, true},
            {measures::name_of<&measures::Measures::inertial_number>(), 0.0, true}};
}

/// The values of a call, or else these, the greatest first.
Values falling(const StudyRequest& request, const Values& otherwise) {
    Values values = request.values.empty() ? otherwise : request.values;
    std::ranges::sort(values, std::greater{});
    return values;
}

} // namespace

StudyResult study_resolution(const StudyRequest& asked) {
    const StudyRequest request = with_scene(asked, "lis1");
    const Scene scene = scene_of(request);
    // 3,000, 4,200, 8,300, 16,700, 33,000 and 67,000 discs of lis1 before sediment.
    const Values radii = falling(request, {220.0, 186.2, 132.0, 93.1, 66.0, 46.55});
    std::vector<StudyRun> runs = runs_along("mean_radius_m", "hanging_wall.mean_radius_m", radii,
                                            {"extension.speed_m_per_s=1.0"}, {});
    runs.back().most_seeds = 1; // as dear as all others together
    StudyResult result;
    result.title =
        fmt::format("Resolution: {} against mean radius {:g} m", request.scene, radii.back());
    sweep_runs(request, request.scene, runs, basin_quantities(scene), result);
    return result;
}

namespace {

/// Changes of a scene, "table.key=value", in one text.
struct CouplingPlan {
    std::string set, reference;
};

struct Curve {
    std::string method, name, vary;
    Values values; ///< of the parameter that is varied
    std::string set;
};

PlanTable<Curve> curve_table() {
    return {"",
            {plan_key("method", at<&Curve::method>, "of the study's points"),
             plan_key("name", at<&Curve::name>, "of runs, before the value"),
             plan_key("vary", at<&Curve::vary>, "table.key"),
             plan_key("values", at<&Curve::values>, "that it takes"),
             plan_key("set", at<&Curve::set>, "changes for all of them")}};
}

} // namespace

StudyResult study_coupling(const StudyRequest& asked) {
    const StudyRequest request = with_scene(asked, "lis1-elastic");
    StudyResult result;
    result.title = fmt::format("Coupling: {} at draft to 2 km against all modes at every cycle",
                               request.scene);
    // Quantities of the base: how far it is from where the last window's mean loads want it.
    const std::vector<StudyQuantity> quantities{{effects::footwall_uplift},
                                                {effects::base_deflection},
                                                {effects::base_resolved_difference, 0.0, true},
                                                {effects::base_reaction_error, 0.0, true}};
    const toml::table document = study_plan("coupling");
    const auto plan = PlanTable<CouplingPlan>{
        "",
        {plan_key("set", at<&CouplingPlan::set>, "changes for every run"),
         plan_key("reference", at<&CouplingPlan::reference>, "changes for the best")},
        {},
        {"curve"}}.read({document, ""});
    for (const Entry& entry : tables({document, ""}, "curve")) {
        const Curve curve = curve_table().read(entry);
        std::vector<StudyRun> runs =
            runs_along(curve.name, curve.vary, curve.values, words(plan.set + ' ' + curve.set));
        runs.push_back({"converged=1", words(plan.set + ' ' + plan.reference), "draft"});
        sweep_runs(request, curve.method, runs, quantities, result);
    }
    return result;
}

StudyResult study_speed(const StudyRequest& asked) {
    const StudyRequest request = with_scene(asked, "lis1");
    const Scene scene = scene_of(request);
    const Values speeds = falling(request, {8.0, 4.0, 2.0, 1.0, 0.5, 0.25});
    StudyResult result;
    result.title =
        fmt::format("Boundary speed: {} at draft against {:g} m/s", request.scene, speeds.back());
    sweep_runs(request, request.scene,
               runs_along("speed_m_per_s", "extension.speed_m_per_s", speeds),
               basin_quantities(scene), result);
    return result;
}

StudyResult study_softness(const StudyRequest& asked) {
    const StudyRequest request = with_scene(asked, "lis1");
    const Scene scene = scene_of(request);
    const Values softnesses = falling(request, {16.0, 8.0, 4.0, 2.0, 1.0});
    std::vector<StudyQuantity> quantities = basin_quantities(scene);
    quantities.push_back(
        {measures::name_of<&measures::Measures::broken, &measures::BrokenRock::width>(), 0.0});
    const std::vector<StudyRun> reference =
        runs_along("softness", "cycle.softness", {softnesses.back()});
    StudyResult result;
    result.title = fmt::format("Softness and speed: {} at draft against softness {:g}",
                               request.scene, softnesses.back());
    // The faster the wall, the slower its start.
    for (const auto& [method, prefix, set] :
         {std::tuple{"the speed of draft", "softness", ""},
          std::tuple{"2 m/s after a slow start", "2-m-per-s-softness",
                     "extension.speed_m_per_s=2 extension.ramp_s=600"},
          std::tuple{"3 m/s after a slow start", "3-m-per-s-softness",
                     "extension.speed_m_per_s=3 extension.ramp_s=800"}}) {
        std::vector<StudyRun> runs = runs_along(prefix, "cycle.softness", softnesses, words(set));
        if (runs.back().parameter != reference[0].parameter)
            runs.push_back(reference[0]);
        sweep_runs(request, fmt::format("{} at {}: runs", request.scene, method), runs, quantities,
                   result);
    }
    return result;
}

} // namespace listric
