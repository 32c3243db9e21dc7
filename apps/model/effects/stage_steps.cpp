#include "apps/model/effects/stage_steps.hpp"

#include "dem/base/target_line.hpp"
#include "dem/columns.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace listric::effects::stage {

using namespace dem;

namespace {

/// Displacement of the base by x; none where it has no nodes.
std::optional<TargetLine> displacement_of_base(const State& state, bool sideways) {
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    std::vector<Point> line;
    for (std::size_t k = 0; k < nodes.x.size(); ++k)
        if (line.empty() || nodes.x[k] > line.back().x)
            line.push_back({nodes.x[k], sideways ? nodes.ux[k] : nodes.uy[k]});
    return line.empty() ? std::nullopt : std::optional(TargetLine(std::move(line)));
}

/// Places of discs, those that the base has brought them to taken off.
struct OwnPlaces {
    std::vector<double> x, y;
};

OwnPlaces own_places(const State& state, bool base_is_prescribed) {
    const ConstDiscColumns d = disc_columns(state);
    OwnPlaces own{{d.x.begin(), d.x.end()}, {d.y.begin(), d.y.end()}};
    if (!base_is_prescribed)
        return own;
    const auto aside = displacement_of_base(state, true), up = displacement_of_base(state, false);
    for (std::size_t i = 0; i < own.x.size() && aside && up; ++i) {
        own.x[i] -= aside->height(d.x[i]);
        own.y[i] -= up->height(d.x[i]);
    }
    return own;
}

} // namespace

StepRecord::StepRecord(const Calendar& calendar, bool base_is_prescribed)
    : Observer("steps", never), base_is_prescribed_(base_is_prescribed) {
    for (const SteppedPause& pause : calendar.pauses())
        for (std::int64_t k = 0; k < pause.steps; ++k)
            for (const double share : {0.75, 1.0})
                due_.push_back(pause.start + (static_cast<double>(k) + share) * pause.step);
}

Travel StepRecord::next_due() const {
    const auto next = static_cast<std::size_t>(applied);
    return next < due_.size() ? due_[next] : Travel(std::numeric_limits<double>::infinity());
}

void StepRecord::begin(State& state) {
    state.discs.add<double>("step_x", "m", 0.0);
    state.discs.add<double>("step_y", "m", 0.0);
    for (const char* name : {"steps", "unsettled"})
        memory.add<double>(name, "1", 0.0);
    memory.add<double>("last_m", "m", 0.0);
    memory.resize(1);
}

bool StepRecord::apply(State& state, const RigidBase&) {
    const OwnPlaces own = own_places(state, base_is_prescribed_);
    const auto x = state.discs.get<double>("step_x"), y = state.discs.get<double>("step_y");
    if (applied % 2 == 0) { // the last quarter begins
        std::ranges::copy(own.x, x.begin());
        std::ranges::copy(own.y, y.begin());
        return false;
    }
    const auto stratum = disc_columns(state).stratum;
    double way = 0.0, count = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (stratum[i] == 0) {
            way += hypotenuse(own.x[i] - x[i], own.y[i] - y[i]);
            count += 1.0;
        }
    way /= std::max(1.0, count);
    memory.get<double>("last_m")[0] = way;
    memory.get<double>("steps")[0] += 1.0;
    memory.get<double>("unsettled")[0] += way > rest * state.mean_radius ? 1.0 : 0.0;
    return false;
}

} // namespace listric::effects::stage
