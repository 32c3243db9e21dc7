#include "apps/archive/tables/observed_misfit.hpp"

#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/picks/picked_pieces.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace listric::archive {

using namespace dem;
using namespace measures;

namespace {

/// The horizon deposited nearest to a time, a. Rock is as old as the rift; its uppermost layer is
/// last.
const Horizon* horizon_at(const std::vector<Horizon>& horizons, double time) {
    const Horizon* best = nullptr;
    double least = INFINITY;
    for (const Horizon& h : horizons) {
        const double off = std::abs(h.deposited_at.value_or(0.0) - time);
        if (off <= least) {
            least = off;
            best = &h;
        }
    }
    return best;
}

/// Age between tops in succession, a; what is further from all of them has none.
double usual_interval(const std::vector<Horizon>& horizons) {
    double last = 0.0, longest = 0.0;
    for (const Horizon& h : horizons)
        if (h.deposited_at) {
            longest = std::max(longest, *h.deposited_at - last);
            last = *h.deposited_at;
        }
    return longest;
}

/// Years by which an age may miss the ends of what the model has: a run ends within a time step of
/// its goal, and distance / rate has the round-off of a division.
double slack_of_ages(const Scene& scene, const State& state, double end) {
    const double speed = make_motion(scene).greatest_speed();
    return std::max(1e-6 * end, speed * state.clock.time_step /
                                    make_calendar(scene).metres_per_year(
                                        dem::Travel(scene.extension.distance)));
}

void compare(ObservedHorizon& row, std::span<const Point> points, const Horizon& horizon,
             double margin) {
    const auto found = misfit(points, horizon.pieces, margin);
    if (!found || (row.misfit && found->mean >= row.misfit->mean))
        return;
    row.misfit = found;
    row.stratum = horizon.stratum;
}

} // namespace

std::vector<ObservedHorizon> compare_horizons(const Scene& scene, const State& state,
                                              const std::vector<Horizon>& horizons) {
    const double end = end_age(scene);
    const double now = make_calendar(scene).age(state.clock.travel);
    const double slack = slack_of_ages(scene, state, end);
    const double diameter = 2.0 * state.mean_radius;
    std::vector<ObservedHorizon> rows;
    for (const PickedLine& line : by_name(scene.observed->horizons)) {
        ObservedHorizon row{line.name, std::nullopt, std::nullopt, line.x.size(), ""};
        std::vector<Point> points;
        for (std::size_t k = 0; k < line.x.size(); ++k)
            points.push_back({line.x[k], -line.depth[k]});
        if (!line.age) {
            for (const Horizon& h : horizons)
                compare(row, points, h, diameter);
        } else if (const double at = end - *line.age; at < -slack || at > now + slack) {
            row.objection =
                fmt::format("is {:g} a old, but the model's tops are {:g} to {:g} a old now",
                            *line.age, end - now, end);
        } else if (const Horizon* h = horizon_at(horizons, at);
                   h && std::abs(h->deposited_at.value_or(0.0) - at) <=
                            usual_interval(horizons) + slack) {
            compare(row, points, *h, diameter);
        } else {
            row.objection =
                fmt::format("is {:g} a old, of which age the model has no top", *line.age);
        }
        if (!row.misfit && row.objection.empty())
            row.objection = "lies outside of what the model has of such a horizon";
        rows.push_back(std::move(row));
    }
    return rows;
}

std::span<const ObservedField> observed_fields() {
    using Json = nlohmann::ordered_json;
    using H = const ObservedHorizon&;
    static constexpr ObservedField fields[] = {
        {"name", "", "horizon", "name of the picked horizon", [](H h) -> Json { return h.name; }},
        {"outside", "", "not compared, since",
         "reason why the horizon is compared with nothing, if it is not",
         [](H h) { return h.objection.empty() ? Json() : Json(h.objection); }},
        {"stratum", "1", "stratum", "stratum whose top is compared with the horizon",
         [](H h) { return h.misfit ? Json(*h.stratum) : Json(); }},
        {"mean_m", "m", "mean distance",
         "mean distance of the horizon's points from the top of the stratum",
         [](H h) { return h.misfit ? Json(h.misfit->mean) : Json(); }},
        {"largest_m", "m", "largest distance",
         "largest distance of a point from the top of the stratum",
         [](H h) { return h.misfit ? Json(h.misfit->largest) : Json(); }},
        {"largest_at_x_m", "m", "largest distance at x", "x of the largest distance",
         [](H h) { return h.misfit ? Json(h.misfit->worst.x) : Json(); }},
        {"points", "1", "points", "number of picked points",
         [](H h) { return h.misfit ? Json(h.points) : Json(); }},
        {"points_compared", "1", "points compared",
         "number of picked points that lie beside the top",
         [](H h) { return h.misfit ? Json(h.misfit->compared) : Json(); }},
    };
    return fields;
}

} // namespace listric::archive
