#include "dem/base/motion.hpp"

#include <algorithm>
#include <cmath>

namespace listric::dem {

namespace {

constexpr int cycles_between_answers = 10;

} // namespace

std::vector<Point> detachment_nodes(const Chain& chain, double face) {
    std::vector<Point> nodes{chain.front().start};
    double start = 0.0;
    for (const Segment& piece : chain) {
        const auto faces = static_cast<int>(std::ceil(piece.length / face));
        for (int k = 1; k < 2 * faces; ++k)
            nodes.push_back(point_at(chain, start + piece.length * k / (2.0 * faces)));
        nodes.push_back(piece.end);
        start += piece.length;
    }
    return nodes;
}

BaseMotion::BaseMotion(const BaseMotionParameters& parameters, const Motion& motion,
                       const Calendar& calendar)
    : uplift_(0.0, parameters.uplift), shift_(0.0, parameters.shift), motion_(motion),
      calendar_(calendar) {
    interval = cycles_between_answers;
}

Point BaseMotion::displacement(double x, double time) const {
    return {shift_.at(time).height(x) - shift_.at(0.0).height(x),
            uplift_.at(time).height(x) - uplift_.at(0.0).height(x)};
}

void BaseMotion::respond(State& state, const Clock& clock) {
    const double step = interval * clock.time_step;
    const double time = calendar_.age(
        Travel(clock.travel.m + motion_.at(clock.time(), clock.travel).travel_speed * step));
    const TargetLine shift = shift_.at(time), shift_before = shift_.at(0.0);
    const TargetLine uplift = uplift_.at(time), uplift_before = uplift_.at(0.0);
    const BaseNodeColumns nodes = base_node_columns(state);
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        const double x = nodes.x[k];
        nodes.vx[k] = (shift.height(x) - shift_before.height(x) - nodes.ux[k]) / step;
        nodes.vy[k] = (uplift.height(x) - uplift_before.height(x) - nodes.uy[k]) / step;
        nodes.load_x[k] = nodes.load_y[k] = 0;
    }
}

double greatest_base_speed(const BaseMotionParameters& parameters, const Calendar& calendar) {
    double fastest = 0.0;
    for (const auto* stages : {&parameters.uplift, &parameters.shift})
        for (std::size_t k = 1; k < stages->size(); ++k) {
            const TargetStage &a = (*stages)[k - 1], &b = (*stages)[k];
            const TargetLine before(a.points), after(b.points);
            for (const auto* points : {&a.points, &b.points})
                for (const Point& p : *points)
                    fastest = std::max(fastest, std::abs(after.height(p.x) - before.height(p.x)) /
                                                    (b.time - a.time) *
                                                    calendar.years_per_metre(a.time, b.time));
        }
    return fastest;
}

} // namespace listric::dem
