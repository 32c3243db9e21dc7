#include "apps/model/effects/stage/pauses.hpp"

#include "dem/base/rest.hpp"
#include "dem/base/target_line.hpp"
#include "dem/columns.hpp"
#include "dem/events/strain.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace listric::effects::stage {

using namespace dem;

namespace {

/// Strain of every disc since the run began, the present window included.
std::vector<double> strain_so_far(const State& state) {
    std::vector<double> strain = shear_strain(state);
    const auto before = state.discs.get(dem::columns::total_strain);
    std::ranges::transform(strain, before, strain.begin(), std::plus());
    return strain;
}

/// Unrest of the pause that goes on.
Unrest unrest_now(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const auto x = state.discs.get<double>("rest_x"), y = state.discs.get<double>("rest_y");
    const auto before = state.discs.get<double>("rest_strain");
    const std::vector<double> strain = strain_so_far(state);
    Unrest all;
    double count = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (d.stratum[i] != 0)
            continue;
        const double way = hypotenuse(d.x[i] - x[i], d.y[i] - y[i]);
        all.strain += strain[i] - before[i];
        all.moved += way > Unrest::far ? 1.0 : 0.0;
        all.farthest = std::max(all.farthest, way);
        count += 1.0;
    }
    all.strain /= std::max(1.0, count);
    return all;
}

double last_window(const State& state) {
    const auto stratum = disc_columns(state).stratum;
    const auto strain = state.discs.get(dem::columns::window_strain);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < strain.size(); ++i)
        if (stratum[i] == 0) {
            sum += strain[i];
            count += 1.0;
        }
    return sum / std::max(1.0, count);
}

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

std::optional<Extension> wall_way(const Motion& motion, Travel travel) {
    for (const MotionStage& stage : motion.stages)
        if (stage.slope == 0.0 && stage.start < travel)
            return motion.way(Travel(), travel);
    return std::nullopt;
}

std::string_view name_of_way(const Motion& motion, Travel travel) {
    return wall_way(motion, travel) ? "travel" : "wall motion";
}

PauseRecord::PauseRecord(const Motion& motion) : Observer("pause", never, Stage::load) {
    for (const MotionStage& one : motion.stages) {
        if (!rests(one))
            continue;
        if (!ends_.empty() && ends_.back() == one.start) // one pause in two stages
            ends_.pop_back();
        else
            ends_.push_back(one.start);
        ends_.push_back(one.end);
    }
}

bool PauseRecord::is_needed(const Motion& motion) {
    return std::ranges::any_of(motion.stages, [](const MotionStage& one) { return rests(one); });
}

Travel PauseRecord::next_due() const {
    const auto next = static_cast<std::size_t>(applied);
    return next < ends_.size() ? ends_[next] : Travel(std::numeric_limits<double>::infinity());
}

void PauseRecord::begin(State& state) {
    state.discs.add<double>("rest_x", "m", 0.0);
    state.discs.add<double>("rest_y", "m", 0.0);
    state.discs.add<double>("rest_strain", "1", 0.0);
    for (const char* name : {"strain_before", "strain", "moved"})
        memory.add<double>(name, "1", 0.0);
    memory.add<double>("farthest_m", "m", 0.0);
}

bool PauseRecord::apply(State& state, const RigidBase&) {
    if (applied % 2 != 0) {     // the pause ends
        if (memory.rows() == 0) // an earlier version began it, which remembered nothing
            return false;
        const Unrest all = unrest_now(state);
        memory.get<double>("strain").back() = all.strain;
        memory.get<double>("moved").back() = all.moved;
        memory.get<double>("farthest_m").back() = all.farthest;
        return false;
    }
    if (!state.discs.has("rest_x"))
        begin(state);
    const DiscColumns d = disc_columns(state);
    std::ranges::copy(d.x, state.discs.get<double>("rest_x").begin());
    std::ranges::copy(d.y, state.discs.get<double>("rest_y").begin());
    std::ranges::copy(strain_so_far(state), state.discs.get<double>("rest_strain").begin());
    memory.resize(memory.rows() + 1);
    memory.get<double>("strain_before").back() = last_window(state);
    return false;
}

std::optional<Unrest> PauseRecord::unrest(const State& state) const {
    if (memory.rows() == 0)
        return std::nullopt;
    if (applied % 2 != 0)
        return unrest_now(state);
    return Unrest{memory.get<double>("strain").back(), memory.get<double>("moved").back(),
                  memory.get<double>("farthest_m").back()};
}

double PauseRecord::strain_before() const {
    return memory.rows() == 0 ? 0.0 : memory.get<double>("strain_before").back();
}

StepRecord::StepRecord(const Calendar& calendar, bool base_is_prescribed)
    : Observer("steps", never), calendar_(calendar), base_is_prescribed_(base_is_prescribed) {}

/// The last quarter of a step and its end, in turn.
Travel StepRecord::next_due() const {
    std::int64_t step = applied / 2;
    for (const SteppedPause& pause : calendar_.pauses()) {
        if (step < pause.steps)
            return pause.start +
                   (static_cast<double>(step) + (applied % 2 == 0 ? 0.75 : 1.0)) * pause.step;
        step -= pause.steps;
    }
    return Travel(std::numeric_limits<double>::infinity());
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
