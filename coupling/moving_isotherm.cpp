#include "coupling/moving_isotherm.hpp"

#include "coupling/base_memory.hpp"
#include "coupling/interface_loads.hpp"
#include "dem/base/target_line.hpp"
#include "dem/law.hpp"

#include <algorithm>
#include <cmath>

namespace listric::coupling {

using namespace dem;

namespace {

constexpr double least_way = 500.0; // m of travel: what the base takes to come to rest

} // namespace

std::vector<fem::Vector> isotherm_of(const std::vector<Point>& line) {
    std::vector<fem::Vector> result;
    for (const Point& p : line)
        result.push_back({p.x, p.y});
    return result;
}

MovingIsotherm::MovingIsotherm(fem::Footwall& footwall, ElasticBase& base, FootwallLoads& loads,
                               std::vector<Point> line, IsothermNow now, double row,
                               const Schedule& schedule)
    : Event("moving_isotherm", schedule, dem::Stage::load), footwall_(&footwall), base_(&base),
      loads_(&loads), line_(std::move(line)), now_(std::move(now)), row_(row) {}

void MovingIsotherm::begin(State& state) {
    footwall_load(state, name(), base_->interface().unknowns());
    set_isotherm(state, {line_, 0.0});
    set_creep(state, {.step = 0.0,
                      .stress = std::vector<double>(3 * footwall_->stress_points().size(), 0.0),
                      .work = std::vector<double>(loads_->unit_loads(), 0.0)});
}

void MovingIsotherm::take(const std::vector<Point>& line) {
    footwall_->take_isotherm(isotherm_of(line));
    take_stiffness(*footwall_, *base_, *loads_);
    line_ = line;
}

void MovingIsotherm::go_on_with(const State& state) {
    const auto same = [](Point a, Point b) { return a.x == b.x && a.y == b.y; };
    if (const auto known = isotherm(state); known && !std::ranges::equal(known->line, line_, same))
        take(known->line);
}

bool MovingIsotherm::has_moved(const std::vector<Point>& now) const {
    const TargetLine before(line_);
    return std::ranges::any_of(now,
                               [&](Point p) { return std::abs(p.y - before.height(p.x)) >= row_; });
}

bool MovingIsotherm::apply(State& state, const RigidBase& rigid) {
    if (state.clock.travel.m - isotherm(state)->since < least_way)
        return false;
    const std::vector<Point> now = now_(state, rigid);
    if (!has_moved(now))
        return false;
    try {
        solve_for_field(*footwall_, *base_, *loads_, state);
        fem::Load left;
        left.stress = footwall_->stress_left_below(isotherm_of(now));
        take(now);
        base_->express(state);
        begin_means_anew(state);
        loads_->put(state);
        put_stress_left(*footwall_, *base_, state, name(), std::move(left), 0.0);
        set_isotherm(state, {line_, state.clock.travel.m});
    } catch (const fem::FootwallError& error) {
        throw NumericalFailure(
            std::string("elastic_base: the footwall cannot take another isotherm: ") +
            error.what());
    }
    return false;
}

} // namespace listric::coupling
