#include "apps/scene/target_csv.hpp"

#include "apps/support/csv.hpp"
#include "apps/support/error.hpp"
#include "apps/support/spelling.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace listric {

using namespace dem;

std::vector<TargetStage> read_target_csv(const std::filesystem::path& path,
                                         std::string_view value_name) {
    const CsvRows rows =
        read_csv(path, std::array<std::string_view, 3>{"time_a", "x_m", value_name});
    std::vector<TargetStage> stages;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto refuse = [&](std::string_view what) {
            throw SceneError(fmt::format("{}:{}: {}", path.string(), rows.line[k], what));
        };
        const double time = rows.columns[0][k], x = rows.columns[1][k], y = rows.columns[2][k];
        if (time < 0.0)
            refuse(fmt::format("time_a: {} is before the start of extension, allowed: at least 0",
                               text(time)));
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

} // namespace listric
