#include "dem/motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace listric::dem {

namespace {

/// Distance from a change of stages at which the speed falls no further, m: some cycles long. The
/// speed there is a hundredth.
constexpr double crawl = 1e-4 * Motion::change;

/// Distance behind one at full speed, m, this far from a change of stages: the time to get there is
/// 2 sqrt(distance change) / speed.
double lost_to_change(double distance) {
    return distance < Motion::change ? 2.0 * std::sqrt(distance * Motion::change) - distance
                                     : Motion::change;
}

} // namespace

std::size_t Motion::stage(Travel travel) const {
    std::size_t k = 0;
    while (k + 1 < stages.size() && travel >= stages[k].end)
        ++k;
    return k;
}

MotionInstant Motion::staged_at(double time, Travel travel) const {
    const std::size_t k = stage(travel);
    const MotionStage& now = stages[k];
    double distance = std::numeric_limits<double>::infinity(); // from the next change
    if (k > 0)
        distance = (travel - now.start).m;
    if (k + 1 < stages.size())
        distance = std::min(distance, (now.end - travel).m);
    double share = time < ramp ? time / ramp : 1.0;
    if (distance < change) // s = a t^2 / 2
        share *= std::sqrt(std::max(distance, crawl) / change);
    const double travel_speed = now.speed * share;
    return {travel_speed, now.slope * travel_speed, now.runs_from, now.detachment_friction};
}

Extension Motion::staged_position(Travel travel) const {
    const MotionStage& now = stages[stage(travel)];
    return now.start_position + Extension(now.slope * (travel - now.start).m);
}

Extension Motion::way(Travel from, Travel to) const {
    if (stages.empty())
        return position(to) - position(from);
    Extension way;
    for (std::size_t k = stage(from); k <= stage(to); ++k) {
        const MotionStage& one = stages[k];
        const Travel start = k == stage(from) ? from : one.start;
        const Travel end = k == stage(to) ? to : one.end;
        way = way + Extension(std::abs(one.slope) * (end - start).m);
    }
    return way;
}

bool Motion::shortens(Travel travel) const {
    if (stages.empty())
        return false;
    for (std::size_t k = stage(travel) + 1; k-- > 0;)
        if (stages[k].slope != 0.0)
            return stages[k].slope < 0.0;
    return false;
}

SurfaceWork Motion::surface_work(Travel from, Travel to) const {
    return stages.empty() ? SurfaceWork::both : stages[stage(0.5 * (from + to))].surface;
}

double Motion::greatest_speed() const {
    double greatest = stages.empty() ? speed : 0.0;
    for (const MotionStage& one : stages)
        greatest = std::max(greatest, one.speed);
    return greatest;
}

double Motion::greatest_wall_speed() const {
    double greatest = stages.empty() ? speed : 0.0;
    for (const MotionStage& one : stages)
        greatest = std::max(greatest, std::abs(one.slope) * one.speed);
    return greatest;
}

Extension Motion::greatest_position(Travel travel) const {
    Extension greatest = position(travel);
    for (const MotionStage& one : stages)
        if (one.end < travel)
            greatest = std::max(greatest, position(one.end));
    return greatest;
}

double Motion::time_at(Travel travel) const {
    assert(speed > 0.0 && travel.m >= 0.0);
    if (stages.empty()) {
        const double in_ramp = 0.5 * speed * ramp;
        return travel.m < in_ramp ? std::sqrt(2.0 * travel.m * ramp / speed)
                                  : ramp + (travel.m - in_ramp) / speed;
    }
    double time = std::min(0.5 * ramp, travel.m / stages.front().speed);
    for (std::size_t k = 0; k < stages.size(); ++k) {
        const MotionStage& one = stages[k];
        const bool is_last = k + 1 == stages.size();
        if (travel <= one.start && k > 0)
            break;
        const double past = ((is_last ? travel : std::min(travel, one.end)) - one.start).m;
        time += (past + (k > 0 ? lost_to_change(past) : 0.0)) / one.speed;
        if (!is_last)
            time += (change - lost_to_change(std::max(0.0, (one.end - travel).m))) / one.speed;
    }
    return time;
}

} // namespace listric::dem
