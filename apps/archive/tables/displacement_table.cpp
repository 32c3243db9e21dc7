#include "apps/archive/tables/displacement_table.hpp"

#include "apps/model/model.hpp"
#include "dem/state.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace listric::archive {

using namespace dem;
using measures::DiscPlaces;

LineTable displacement_table(const ExportedMoment& at, const DiscPlaces& before) {
    LineTable table{"displacement", "to_a", {"name", "from_a", "to_a"}, {"u_m", "w_m"}, {}};
    const DiscPlaces now(at.now.state);
    const double column = 2.0 * before.diameter;
    std::map<long, double> top; // height of the uppermost disc by column
    const auto column_of = [&](std::size_t k) { return std::lround(before.x[k] / column); };
    for (std::size_t k = 0; k < before.id.size(); ++k) {
        const auto [place, is_new] = top.emplace(column_of(k), before.y[k]);
        if (!is_new)
            place->second = std::max(place->second, before.y[k]);
    }
    struct Sum {
        double x = 0.0, y = 0.0, u = 0.0, w = 0.0;
        int discs = 0;
    };
    std::map<long, Sum> sums; // rows of `before` have one order, whatever the threads
    for (std::size_t k = 0; k < before.id.size(); ++k) {
        const auto id = static_cast<std::size_t>(before.id[k]);
        const std::int32_t row = id < now.row_of.size() ? now.row_of[id] : -1;
        if (row < 0 || before.y[k] < top[column_of(k)] - before.diameter)
            continue;
        const auto r = static_cast<std::size_t>(row);
        Sum& sum = sums[column_of(k)];
        sum.x += before.x[k];
        sum.y += before.y[k];
        sum.u += now.x[r] - before.x[k];
        sum.w += now.y[r] - before.y[k];
        ++sum.discs;
    }
    const Calendar calendar = make_calendar(at.now.scene);
    Line line{{"ground", calendar.age(before.travel), calendar.age(now.travel)}};
    const auto rounded = [](double metres) { return std::round(1e3 * metres) / 1e3; };
    for (const auto& [place, sum] : sums) {
        const double n = sum.discs;
        line.points.push_back({rounded(sum.x / n), rounded(sum.y / n)});
        line.at_points.insert(line.at_points.end(), {rounded(sum.u / n), rounded(sum.w / n)});
    }
    if (!line.points.empty())
        table.lines.push_back(std::move(line));
    return table;
}

} // namespace listric::archive
