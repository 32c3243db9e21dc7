#include "dem/events/sedimentation.hpp"

#include "dem/base/ground.hpp"
#include "dem/columns.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/numbers/random.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace listric::dem {

namespace {

struct Placed {
    Point centre;
    double radius;
};

/// Removes the discs that lie wholly above the line. Returns their mass, kg per metre.
double erode(State& state, const TargetLine& line) {
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    std::vector<std::int32_t> kept;
    double removed = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (line.above({d.x[i], d.y[i]}) > d.radius[i])
            removed += d.mass[i];
        else
            kept.push_back(static_cast<std::int32_t>(i));
    }
    if (kept.empty())
        throw NothingLeft("erosion: the target line lies below the whole hanging wall; raise "
                          "sedimentation.level_m or the line");
    if (kept.size() < d.x.size())
        reorder_discs(state, kept);
    return removed;
}

/// Where there may be room for a disc below the target line. A try elsewhere must fail: a disc that
/// falls on ground of discs stops where two of them hold it, after a few radii, since only slopes
/// of more than some 20 degrees lead over a disc, and it has started near the line.
class Room {
public:
    Room(const Ground& ground, const TargetLine& line, double smallest, double largest)
        : ground_(ground), line_(line), smallest_(smallest), largest_(largest),
          width_(0.5 * smallest) {
        const auto count = static_cast<std::size_t>((ground.right() - ground.left()) / width_) + 1;
        reach_ =
            is_gentle() ? static_cast<std::size_t>(longest_roll * largest / width_) + 1 : count;
        open_.resize(count);
        open_near_.resize(count);
        look(0, count);
    }

    bool is_near(double x) const { return open_near_[interval(x)] > 0; }

    /// Looks again where a disc has been added.
    void look_about(double x) {
        const double far = 2.0 * largest_ + width_;
        look(interval(x - far), interval(x + far) + 1);
    }

private:
    static constexpr double longest_roll = 8.0; ///< largest radii
    static constexpr double gentle = 0.2;       ///< slope of a line that no disc rolls down along

    bool is_gentle() const {
        const std::vector<Point>& p = line_.points();
        for (std::size_t k = 1; k < p.size(); ++k)
            if (std::abs(p[k].y - p[k - 1].y) > gentle * (p[k].x - p[k - 1].x))
                return false;
        return true;
    }

    std::size_t interval(double x) const {
        return static_cast<std::size_t>(
            std::clamp((x - ground_.left()) / width_, 0.0, static_cast<double>(open_.size() - 1)));
    }

    void look(std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const bool open = is_open(k);
            if (open == open_[k])
                continue;
            open_[k] = open;
            for (std::size_t j = k - std::min(k, reach_);
                 j <= std::min(k + reach_, open_.size() - 1); ++j)
                open_near_[j] += open ? 1 : -1;
        }
    }

    bool is_open(std::size_t k) const {
        const double from = ground_.left() + width_ * static_cast<double>(k), to = from + width_;
        double height = std::max(line_.height(from), line_.height(to));
        for (const Point p : line_.points())
            if (p.x > from && p.x < to)
                height = std::max(height, p.y);
        return !ground_.keeps_above(height - 0.5 * smallest_, from, to, smallest_);
    }

    const Ground& ground_;
    const TargetLine& line_;
    double smallest_, largest_, width_;
    std::size_t reach_ = 0;      ///< intervals
    std::vector<bool> open_;     ///< by interval
    std::vector<int> open_near_; ///< number of open intervals within reach
};

/// Fills the ground up to the line until a long row of tries finds no more room.
std::vector<Placed> fill(Ground& ground, const TargetLine& line, double smallest, double largest,
                         std::uint64_t seed, std::uint64_t stratum, const StepReport& report) {
    constexpr std::uint64_t between_reports = 64; // tries, some ms
    std::vector<Placed> placed;
    const double width = ground.right() - ground.left();
    const auto patience = static_cast<std::uint64_t>(20.0 * width / smallest);
    std::uint64_t failures = 0;
    Room room(ground, line, smallest, largest);
    for (std::uint64_t tries = 0; failures < patience; ++tries) {
        if (report && tries % between_reports == 0)
            report("sedimentation: " + std::to_string(placed.size()) + " discs laid down");
        const double x =
            ground.left() + width * uniform(seed, Purpose::deposition_place, stratum, tries);
        ++failures;
        if (!room.is_near(x))
            continue;
        double radius = smallest + (largest - smallest) *
                                       uniform(seed, Purpose::deposition_radius, stratum, tries);
        if (ground.height(x, smallest) + smallest > line.height(x) + 2.0 * largest)
            continue;
        auto centre = ground.rest(x, radius);
        // Near the target a smaller disc may still fit.
        if (!centre || line.above(*centre) + radius > 0.0) {
            radius = smallest;
            centre = ground.rest(x, radius);
        }
        if (!centre || line.above(*centre) + radius > 0.5 * smallest)
            continue;
        ground.add(*centre, radius);
        room.look_about(centre->x);
        placed.push_back({*centre, radius});
        failures = 0;
    }
    return placed;
}

/// How the ground moves that new discs are laid on: the mean motion of the discs close below the
/// surface, by column.
class GroundMotion {
public:
    explicit GroundMotion(const State& state) : width_(4.0 * state.mean_radius) {
        const ConstDiscColumns d = disc_columns(state);
        const bool averages = state.discs.has(columns::mean_vx);
        const auto [left, right] = std::ranges::minmax(d.x);
        left_ = left;
        std::vector<double> top(static_cast<std::size_t>((right - left) / width_) + 1,
                                -std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < d.x.size(); ++i)
            top[column(d.x[i])] = std::max(top[column(d.x[i])], d.y[i]);
        velocities_.resize(top.size());
        std::vector<double> counts(top.size());
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const std::size_t k = column(d.x[i]);
            if (d.y[i] < top[k] - 6.0 * state.mean_radius)
                continue;
            velocities_[k].x += averages ? state.discs.get(columns::mean_vx)[i] : d.vx[i];
            velocities_[k].y += averages ? state.discs.get(columns::mean_vy)[i] : d.vy[i];
            counts[k] += 1.0;
        }
        for (std::size_t k = 0; k < counts.size(); ++k)
            if (counts[k] > 0.0)
                velocities_[k] = {velocities_[k].x / counts[k], velocities_[k].y / counts[k]};
    }

    Point at(double x) const { // m/s; at rest where there is no disc
        return x < left_ || column(x) >= velocities_.size() ? Point{} : velocities_[column(x)];
    }

private:
    std::size_t column(double x) const { return static_cast<std::size_t>((x - left_) / width_); }

    double left_ = 0.0, width_;
    std::vector<Point> velocities_;
};

/// Lets the new discs, from row `first` on, move as what they rest on: damping would else hold them
/// up until their mean motion is known.
void set_in_motion(State& state, std::size_t first, const GroundMotion& ground) {
    const DiscColumns d = disc_columns(state);
    const bool averages = state.discs.has(columns::mean_vx);
    for (std::size_t i = first; i < d.x.size(); ++i) {
        const Point v = ground.at(d.x[i]);
        d.vx[i] = v.x;
        d.vy[i] = v.y;
        if (averages) {
            state.discs.get(columns::mean_vx)[i] = static_cast<float>(v.x);
            state.discs.get(columns::mean_vy)[i] = static_cast<float>(v.y);
        }
    }
}

} // namespace

double disc_density(const SedimentationParameters& parameters) {
    return parameters.grain_density * (1.0 - parameters.surface_porosity) /
           (1.0 - packing_porosity);
}

namespace {

/// Gives new discs, from row `first` on, the pores of a bed, where pores are told.
void set_pores(State& state, std::size_t first, double surface_porosity) {
    for (const auto& column : {columns::porosity, columns::wanted_porosity})
        if (state.discs.has(column))
            std::ranges::fill(state.discs.get(column).subspan(first), surface_porosity);
}

} // namespace

double highest_fill_behind_breakaway(const SedimentationParameters& parameters,
                                     const Motion& motion, const Calendar& calendar, double end) {
    const Target target(parameters.level, parameters.target);
    double highest = -std::numeric_limits<double>::infinity();
    const auto look_at = [&](double time) {
        const TargetLine line = target.at(time);
        highest = std::max(highest, line.height(0.0));
        for (const Point p : line.points())
            if (p.x < 0.0)
                highest = std::max(highest, p.y);
    };
    // A line that changes linearly is highest at an end.
    const auto look_from = [&](double begin, double last) {
        const double from = calendar.age(Travel(begin)), to = calendar.age(Travel(last));
        look_at(from);
        look_at(to);
        for (const TargetStage& stage : parameters.target)
            if (stage.time > from && stage.time < to)
                look_at(stage.time);
    };
    if (motion.stages.empty())
        look_from(0.0, end);
    for (const MotionStage& one : motion.stages)
        if (one.surface == SurfaceWork::both || one.surface == SurfaceWork::fill)
            look_from(one.start.m, one.end.m);
    return highest;
}

Sedimentation::Sedimentation(const SedimentationParameters& parameters, double radius_ratio,
                             const Calendar& calendar, Beds beds)
    : Event("sedimentation", {parameters.interval, calendar, InSteps::once}, Stage::deposit),
      parameters_(parameters), target_(parameters.level, parameters.target),
      radius_ratio_(radius_ratio), beds_(std::move(beds)) {}

bool Sedimentation::apply(State& state, const RigidBase& base) {
    const double smallest = 2.0 * state.mean_radius / (1.0 + radius_ratio_);
    const double largest = radius_ratio_ * smallest;
    const Travel travel = state.clock.travel;
    const auto stratum = static_cast<std::int32_t>(schedule().nearest(travel));
    const TargetLine line = target_.at(schedule().calendar().age(travel));
    const SurfaceWork work = base.motion.surface_work(travel - schedule().gap(stratum), travel);
    const bool erodes = work == SurfaceWork::both || work == SurfaceWork::erode;
    const bool fills = work == SurfaceWork::both || work == SurfaceWork::fill;
    const double removed = erodes ? erode(state, line) : 0.0;
    state.ledger.removed += removed;
    if (!fills)
        return removed > 0.0;
    Ground ground(state, base, largest);
    const std::vector<Placed> placed = fill(ground, line, smallest, largest, state.seed,
                                            static_cast<std::uint64_t>(stratum), step_report);
    if (placed.empty())
        return removed > 0.0;

    SedimentationParameters laid_down = parameters_;
    if (!beds_.empty())
        laid_down.surface_porosity = beds_.law(stratum, {}).surface_porosity;
    const double density = disc_density(laid_down);
    const GroundMotion ground_motion(state);
    const std::size_t first = add_discs(state, placed.size());
    const DiscColumns d = disc_columns(state);
    for (std::size_t k = 0; k < placed.size(); ++k) {
        const std::size_t i = first + k;
        d.x[i] = d.start_x[i] = placed[k].centre.x;
        d.y[i] = d.start_y[i] = placed[k].centre.y;
        d.start_travel[i] = travel.m;
        d.radius[i] = placed[k].radius;
        d.mass[i] = density * pi * placed[k].radius * placed[k].radius;
        d.material[i] = sediment;
        d.stratum[i] = stratum;
        state.ledger.deposited += d.mass[i];
    }
    set_in_motion(state, first, ground_motion);
    state.discs.begin_rows(first);
    if (!beds_.empty())
        set_pores(state, first, laid_down.surface_porosity);
    sort_discs(state);
    return true;
}

} // namespace listric::dem
