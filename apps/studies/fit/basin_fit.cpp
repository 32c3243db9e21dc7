#include "apps/studies/fit/basin_fit.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/output_folder.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/run/batch.hpp"
#include "apps/run/exit_code.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/picks/picked_pieces.hpp"
#include "apps/scene/picks/picks_check.hpp"
#include "apps/scene/toml/toml.hpp"
#include "apps/studies/fit/draft_fit.hpp"
#include "apps/studies/fit/kinematic_fit.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/statistics.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <set>

namespace listric {

namespace {

namespace fs = std::filesystem;

/// Share by which a misfit of kinematics may exceed the least and be as good: a choice, within
/// which the truth lies of the two sections that docs/guides/fit.md shows.
constexpr double as_good = 0.1;

/// A shape's number, the range of values that are as good, and whether that is narrow.
struct FoundNumber {
    double value = 0.0;
    FitRange range;
    bool decided = false;
};

struct Answer {
    ListricShape shape;
    double misfit = 0.0;
    std::array<FoundNumber, 3> numbers;
};

/// Whether an end of a range is one that no shape can pass: a vertical breakaway, no line at all.
bool is_last(std::size_t number, double value) {
    return number == 0 ? value >= 90.0 - 1e-6 : number == 2 && value <= 1e-6;
}

Answer answer_of(const ListricShape& shape, double misfit,
                 const std::array<FitProfile, 3>& profiles, double most) {
    Answer answer{shape, misfit, {}};
    for (std::size_t k = 0; k < 3; ++k) {
        const ShapeNumber& number = shape_numbers()[k];
        FoundNumber& found = answer.numbers[k];
        found.value = shape.*number.value;
        found.range = profiles[k].range(most);
        const double enough = number.is_relative ? number.enough * found.value : number.enough;
        const auto within = [&](double end, bool is_end) {
            return std::abs(end - found.value) <= enough && (!is_end || is_last(k, end));
        };
        found.decided = within(found.range.low, found.range.low_is_end) &&
                        within(found.range.high, found.range.high_is_end);
    }
    return answer;
}

/// "90", "15.9", "0.08": digits as a number deserves.
std::string digits(const ShapeNumber& number, double value) {
    const double shown_value = number.per_unit * value;
    return number.value == &ListricShape::dip     ? fmt::format("{:.0f}", shown_value)
           : number.value == &ListricShape::depth ? fmt::format("{:.1f}", shown_value)
                                                  : fmt::format("{:.2f}", shown_value);
}

std::string text_of(const Answer& answer) {
    std::string text;
    std::vector<std::string_view> open;
    for (std::size_t k = 0; k < 3; ++k) {
        const ShapeNumber& number = shape_numbers()[k];
        const FoundNumber& found = answer.numbers[k];
        const std::string low = digits(number, found.range.low),
                          high = digits(number, found.range.high);
        text += fmt::format(
            "  {:<22} {:>5} {:<8} {}{} to {}{}\n", number.label, digits(number, found.value),
            number.unit, found.range.low_is_end && !is_last(k, found.range.low) ? "<" : "", low,
            found.range.high_is_end && !is_last(k, found.range.high) ? ">" : "", high);
        if (!found.decided)
            open.push_back(number.label);
    }
    text +=
        fmt::format("  {:<22} {:>5.1f} km\n", "radius of the arc", 1e-3 * answer.shape.radius());
    if (answer.shape.line_length() > 0.0)
        text += fmt::format("  {:<22} {:>5.1f} km\n", "line above the arc",
                            1e-3 * answer.shape.line_length());
    text += open.empty() ? "  the picks decide all three numbers\n"
                         : fmt::format("  not decided by the picks: {}\n", fmt::join(open, ", "));
    return text;
}

JsonObject json_of(const Answer& answer) {
    JsonObject json;
    for (std::size_t k = 0; k < 3; ++k) {
        const FoundNumber& found = answer.numbers[k];
        json[std::string(shape_numbers()[k].name)] = {{"value", found.value},
                                                      {"low", found.range.low},
                                                      {"high", found.range.high},
                                                      {"low_is_end", found.range.low_is_end},
                                                      {"high_is_end", found.range.high_is_end},
                                                      {"decided", found.decided}};
    }
    json["radius_m"] = answer.shape.radius();
    json["line_length_m"] = answer.shape.line_length();
    json["misfit_m"] = answer.misfit;
    return json;
}

std::string profile_rows(std::string_view stage, const std::array<FitProfile, 3>& profiles) {
    std::string rows;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < profiles[k].values.size(); ++i)
            rows += fmt::format("{},{},{},{:.2f}\n", stage, shape_numbers()[k].name,
                                profiles[k].values[i], profiles[k].misfit[i]);
    return rows;
}

/// A run of the fit.
struct FitRun {
    int round = 0;
    ListricShape shape;
    int seed = 0;
    std::string outcome = {};
    std::optional<double> misfit = {};
    fs::path folder = {};
};

class BasinFit {
public:
    explicit BasinFit(const BasinFitRequest& request)
        : request_(request), name_(name_of(request)),
          output_(request.output.empty() ? fs::path("out/fit-" + name_) : request.output),
          log_(request.quiet), picked_(read_picked_lines(request.picks, 0.0)),
          common_(common_plan(request)), base_(scene_at(common_, {}, request.first_seed)),
          task_(task_of(request, picked_, base_)) {
        require_own_files();
        make_folder(output_);
        lock_.emplace(output_);
        for (const FitHorizon& horizon : task_.horizons)
            for (const double depth : horizon.depth)
                least_depth_ = std::max(least_depth_, 1.02 * depth);
    }

    bool carry_out() {
        log_.progress("fitting kinematics");
        const KinematicFit kinematics = fit_kinematics(task_);
        const Answer predicted = answer_of(kinematics.shape, kinematics.misfit, kinematics.profiles,
                                           (1.0 + as_good) * kinematics.misfit);
        profiles_ += profile_rows("kinematics", kinematics.profiles);
        json_["picks"] = fs::absolute(request_.picks).string();
        json_["extension_m"] = task_.extension;
        json_["kinematics"] = json_of(predicted);
        json_["kinematics"]["shear_angle_deg"] = kinematics.angle;
        std::cout << fmt::format("kinematics: misfit {:.0f} m, shear {:.0f} degrees from the "
                                 "vertical\n",
                                 kinematics.misfit, std::round(kinematics.angle) + 0.0) // no -0
                  << text_of(predicted) << std::flush;
        const auto best = request_.predict_only ? std::optional(kinematics.shape)
                                                : fit_by_drafts(kinematics.shape);
        if (!best) // an earlier answer stays
            return false;
        write_text(output_ / "profile.csv", "stage,number,value,misfit_m\n" + profiles_);
        write_object(output_ / "fit.json", json_);
        write_scene(*best);
        return true;
    }

private:
    /// Refuses to write over what is read, what no fit has made, and the answer to other picks.
    void require_own_files() const {
        const fs::path answer = output_ / "fit.json";
        const archive::OwnFile written[]{
            {answer, "\"kinematics\""},
            {output_ / "fit.csv", "round,seed,breakaway_dip_deg"},
            {output_ / "profile.csv", "stage,number,value"},
            {output_ / (name_ + ".toml"), "# All parameters in force."}};
        archive::require_own(written, base_.files);
        const std::string picks = text_at(object_in(answer), "picks");
        if (!picks.empty() && fs::path(picks) != fs::absolute(request_.picks))
            throw UsageError(fmt::format("{}: is the answer to other picks, {}; --output writes "
                                         "elsewhere",
                                         answer.string(), shown(picks)));
    }

    static std::string name_of(const BasinFitRequest& request) {
        const std::string name = request.picks.stem().string();
        if (const std::string why = objection_to_name(name); !why.empty())
            throw UsageError(fmt::format("{}: the file's name {}; rename it",
                                         shown(request.picks.string()), why));
        return name;
    }

    static SweepPlan common_plan(const BasinFitRequest& request) {
        SweepPlan plan;
        plan.name = "fit";
        plan.scene = request.scene;
        plan.set = request.set;
        plan.set.push_back("observed.horizons=" + quoted(fs::absolute(request.picks).string()));
        return plan;
    }

    /// Refuses picks and scenes that cannot be fitted.
    static FitTask task_of(const BasinFitRequest& request, const PickedFile& picked,
                           const Scene& scene) {
        if (!scene.detachment || scene.picked_fault)
            throw UsageError(fmt::format("--scene {}: {}; take a scene whose [detachment] has "
                                         "segments, such as lis1",
                                         request.scene,
                                         scene.detachment ? "its fault is picked, not to be fitted"
                                                          : "has no [detachment]"));
        if (scene.find<Stages>())
            throw UsageError(fmt::format("--scene {}: has stages, whose travel is not extension; "
                                         "take a scene that is only extended, such as lis1",
                                         request.scene));
        FitTask task;
        task.extension = scene.extension.distance;
        const double duration = task.extension / scene.extension.rate;
        std::set<double> ages;
        // The scene has them shifted as its section is.
        for (const PickedLine& line : by_name(scene.observed->horizons)) {
            const auto refuse = [&](const std::string& what) {
                const auto piece = std::ranges::find(picked.lines, line.name, &PickedLine::name);
                const auto& rows =
                    picked.rows[static_cast<std::size_t>(piece - picked.lines.begin())];
                throw SceneError(fmt::format("{}: {} {}", csv_place(picked.file, rows.front()),
                                             shown_start(line.name), what));
            };
            if (!line.age)
                refuse("has no age_a; give the years before the end of extension");
            if (*line.age > duration * (1.0 + 1e-9))
                refuse(fmt::format("has age_a = {:g}, but extension lasts {:g} a; allowed: 0 to "
                                   "that, or change --set extension.distance_m or "
                                   "extension.rate_m_per_a",
                                   *line.age, duration));
            ages.insert(*line.age);
            task.horizons.push_back(
                {std::min(task.extension, *line.age * scene.extension.rate), line.x, line.depth});
        }
        if (const std::string why = objection_to_ages(picked, duration); !why.empty())
            throw SceneError(why);
        if (ages.size() < 2)
            throw SceneError(fmt::format("{}:1: has horizons of {} age{}; a fit needs two ages or "
                                         "more",
                                         picked.file, ages.size(), ages.size() == 1 ? "" : "s"));
        const auto sediment = make_parts(scene).sediment;
        if (!sediment && !request.predict_only)
            throw UsageError(
                fmt::format("--scene {}: has no sediment, so that its runs have no top "
                            "but the oldest; take a scene with sediment, such as lis1, or "
                            "give --predict-only",
                            request.scene));
        if (sediment)
            task.porosity = {sediment->surface_porosity, sediment->porosity_decay.value_or(0.0)};
        return task;
    }

    std::optional<ListricShape> fit_by_drafts(const ListricShape& start) {
        ListricShape about = start;
        std::optional<DraftFit> fit;
        for (int round = 1; round <= request_.rounds; ++round) {
            const DraftDesign design(about, least_depth_);
            std::vector<FitRun> runs;
            for (const ListricShape& shape : design.shapes())
                runs.push_back({round, shape, request_.first_seed});
            make(runs);
            std::vector<DraftMisfit> drafts;
            for (const FitRun& run : runs)
                drafts.push_back({run.shape, run.misfit});
            fit = fit_drafts(design, drafts, least_depth_);
            if (!fit) {
                log_.say(
                    "too many drafts have failed, or lack a picked horizon, to tell which shape "
                    "is best: see outcome in fit.csv");
                return std::nullopt;
            }
            about = fit->shape;
            if (!fit->at_end)
                break;
        }
        std::vector<FitRun> runs;
        for (int k = 0; k < request_.seeds; ++k)
            runs.push_back({0, fit->shape, request_.first_seed + k});
        make(runs);
        std::vector<double> misfits;
        for (const FitRun& run : runs)
            if (run.misfit)
                misfits.push_back(*run.misfit);
        if (misfits.empty()) {
            log_.say(
                "all runs of the best shape have failed, or lack a picked horizon: see outcome "
                "in fit.csv");
            return std::nullopt;
        }
        const Spread over_seeds = spread(misfits);
        const Answer answer =
            answer_of(fit->shape, over_seeds.mean, fit->profiles,
                      fit->misfit + 2.0 * std::max(over_seeds.deviation, fit->residual));
        profiles_ += profile_rows("drafts", fit->profiles);
        json_["drafts"] = json_of(answer);
        json_["drafts"].update({{"spread_m", over_seeds.deviation},
                                {"seeds", misfits.size()},
                                {"residual_m", fit->residual},
                                {"at_end", fit->at_end}});
        const std::string scatter =
            misfits.size() > 1
                ? fmt::format("spread over {} seeds {:.0f} m", misfits.size(), over_seeds.deviation)
                : "one seed";
        std::cout << fmt::format("drafts: misfit {:.0f} m, {}, {} runs\n", over_seeds.mean, scatter,
                                 runs_.size())
                  << text_of(answer);
        if (fit->at_end)
            std::cout << "  the best shape is at an end of what was tried: give more --rounds\n";
        return fit->shape;
    }

    /// Makes runs, and the table of all that have been made.
    void make(std::vector<FitRun>& runs) {
        SweepPlan plan = common_;
        plan.accuracy = request_.accuracy;
        std::vector<ListricShape> shapes;
        for (const FitRun& run : runs)
            shapes.push_back(run.shape);
        plan = plan_of_shapes(plan, shapes);
        const std::vector<SweepPoint> points = sweep_points(plan);
        std::vector<BatchRun> batch;
        for (std::size_t k = 0; k < runs.size(); ++k) {
            FitRun& run = runs[k];
            run.folder =
                output_ / "runs" /
                (run.round > 0 ? fmt::format("{}-{:02}-seed={}", run.round, k + 1, run.seed)
                               : fmt::format("best-seed={}", run.seed));
            batch.push_back(
                {fmt::format("dip {:.0f} degrees, depth {:.1f} km, straight share "
                             "{:.2f}, seed {}",
                             run.shape.dip, 1e-3 * run.shape.depth, run.shape.straight, run.seed),
                 scene_at(plan, points[k], run.seed), request_.options_of_run(run.folder)});
        }
        const std::vector<BatchEnding> endings = make_runs(batch, request_, log_);
        for (std::size_t k = 0; k < runs.size(); ++k) {
            if (endings[k].exit_code == static_cast<int>(ExitCode::bad_call))
                require_finished(batch[k], endings[k]); // of other picks or parameters, say
            runs[k].outcome = endings[k].reason.empty() ? "finished" : endings[k].reason;
            if (endings[k].exit_code == 0) {
                const JsonObject summary = read_object(runs[k].folder / "summary.json");
                if (std::string lack = uncompared_horizon(summary); !lack.empty())
                    runs[k].outcome = std::move(lack);
                else
                    runs[k].misfit = observed_misfit(summary);
            }
            runs_.push_back(runs[k]);
        }
        std::string text =
            "round,seed,breakaway_dip_deg,depth_m,straight,line_length_m,radius_m,outcome,"
            "misfit_m,folder\n";
        for (const FitRun& run : runs_)
            text += fmt::format("{},{},{:.3f},{:.1f},{:.4f},{:.1f},{:.1f},{},{},{}\n",
                                run.round > 0 ? std::to_string(run.round) : "best", run.seed,
                                run.shape.dip, run.shape.depth, run.shape.straight,
                                run.shape.line_length(), run.shape.radius(), csv_cell(run.outcome),
                                run.misfit ? fmt::format("{:.2f}", *run.misfit) : "",
                                csv_cell(run.folder.filename().string()));
        write_text(output_ / "fit.csv", text);
    }

    void write_scene(const ListricShape& shape) {
        const SweepPlan plan = plan_of_shapes(common_, std::span(&shape, 1));
        Scene scene = scene_at(plan, sweep_points(plan).front(), request_.first_seed);
        scene.description =
            fmt::format("detachment fitted to {}", request_.picks.filename().string());
        const fs::path file = output_ / (name_ + ".toml");
        write_text(file, to_toml(scene));
        std::cout << "scene: " << file.string() << '\n';
    }

    BasinFitRequest request_;
    std::string name_;
    fs::path output_;
    std::optional<archive::FolderLock> lock_;
    Log log_;
    PickedFile picked_;
    SweepPlan common_; ///< scene and changes of every run
    Scene base_;
    FitTask task_;
    double least_depth_ = 100.0; ///< of a flat below all picks, m
    std::vector<FitRun> runs_;
    std::string profiles_; ///< rows of profile.csv
    JsonObject json_;
};

} // namespace

bool run_basin_fit(const BasinFitRequest& request) { return BasinFit(request).carry_out(); }

} // namespace listric
