#include "apps/scene/picks/target_csv.hpp"
#include "apps/scene/parameters/stage.hpp"

#include "apps/support/error.hpp"
#include "apps/support/files/csv.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace listric {

using namespace dem;

std::vector<TargetStage> read_target_csv(const std::filesystem::path& path,
                                         std::string_view value_name) {
    const CsvRows rows = read_csv(path, {.numbers = {"time_a", "x_m", value_name}});
    std::vector<TargetStage> stages;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto refuse = [&](std::string_view what) {
            throw SceneError(fmt::format("{}: {}", csv_place(path.string(), rows.line[k]), what));
        };
        const double time = rows.columns[0][k], x = rows.columns[1][k], y = rows.columns[2][k];
        if (time < 0.0)
            refuse(fmt::format("time_a: {} is before the start of extension, allowed: at least 0",
                               text(time)));
        if (std::abs(x) > 1e7)
            refuse(fmt::format("x_m: {} is out of range, allowed: at least -1e7, at most 1e7; is "
                               "it in metres?",
                               text(x)));
        if (std::abs(y) > 1e5)
            refuse(fmt::format("{}: {} is out of range, allowed: at least -1e5, at most 1e5",
                               value_name, text(y)));
        if (stages.empty() || time > stages.back().time) {
            stages.push_back({time, {}});
        } else if (time < stages.back().time) {
            refuse(
                fmt::format("time_a: {} comes after {}; sort the rows by time, those of one time "
                            "by x",
                            text(time), text(stages.back().time)));
        } else if (x <= stages.back().points.back().x) {
            refuse(fmt::format("x_m: {} comes after {} at the same time; sort the rows of one time "
                               "by x, each x once",
                               text(x), text(stages.back().points.back().x)));
        }
        stages.back().points.push_back({x, y});
    }
    return stages;
}

namespace {

/// A line whose points all lie on one side of the model is the constant that it begins or ends
/// with.
void check_place(Scene& scene, const std::vector<TargetStage>& stages, const std::string& file) {
    const double length = scene.hanging_wall.length;
    const double right = length + greatest_extension(scene);
    double least = stages.front().points.front().x, most = least;
    for (const TargetStage& stage : stages) {
        least = std::min(least, stage.points.front().x);
        most = std::max(most, stage.points.back().x);
    }
    if (least == most)
        return;
    const std::string reach =
        fmt::format("x_m reaches from {} to {}, the model from 0 to {}", least, most, right);
    if (least > right || most < -10.0 * right)
        throw SceneError(
            fmt::format("{}: {}; give x from the breakaway on, in metres", file, reach));
    if (std::max(std::abs(least), std::abs(most)) < 0.005 * length)
        scene.warnings.push_back(fmt::format("{}: {}; is it in metres?", file, reach));
}

void check_times(Scene& scene, const std::vector<TargetStage>& stages, const std::string& file) {
    const double end = end_age(scene);
    if (stages.size() < 2 || end == 0.0)
        return;
    const double second = stages[1].time, last = stages.back().time;
    if (last < 1e-3 * end || second > 10.0 * end)
        scene.warnings.push_back(fmt::format("{}: time_a reaches from {} over {} to {}, extension "
                                             "takes {} a; is it in years from its start?",
                                             file, text(stages[0].time), text(second), text(last),
                                             text(std::round(end))));
}

} // namespace

std::vector<TargetStage> read_target_csv(Scene& scene, const std::filesystem::path& path,
                                         std::string_view value_name) {
    std::vector<TargetStage> stages = read_target_csv(path, value_name);
    check_place(scene, stages, shown(path.string()));
    check_times(scene, stages, shown(path.string()));
    return stages;
}

} // namespace listric
