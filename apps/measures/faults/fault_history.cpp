#include "apps/measures/faults/fault_history.hpp"

#include "apps/measures/faults/fault_throw.hpp"
#include "apps/measures/faults/weakened_rock.hpp"
#include "apps/measures/rigid_motion.hpp"
#include "apps/measures/strata/rock.hpp"
#include "apps/support/statistics.hpp"
#include "dem/base/place.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/numbers/units.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

constexpr std::size_t fewest_points = 8; ///< of a trace that is followed back

/// Without std::hypot, which half of the time went into.
bool are_within(Point a, Point b, double reach) { return dot(a - b, a - b) < reach * reach; }

/// The footwall discs next to one point of a trace.
struct Companions {
    Point place;                  ///< of the trace's point, m
    std::vector<std::int64_t> id; ///< of discs in its footwall
    std::vector<Point> at;        ///< where they are now, m
};

/// Where a trace was, and how far its footwall has turned since.
struct FormerTrace {
    Polyline points;
    double turn = 0.0; ///< of the footwall as one block, rad, counter-clockwise, then to now
};

std::vector<Companions> footwall_of(const FaultTrace& trace, const DiscPlaces& discs,
                                    const Cells& cells, double diameter) {
    std::vector<Companions> footwall;
    for (std::size_t k = 0; k < trace.points.size(); ++k) {
        const Point p = trace.points[k];
        const Point centre = p + 6.0 * diameter * footwall_normal(trace.points, k);
        Companions c{p, {}, {}};
        cells.for_each_near(centre.x, centre.y, [&](std::int32_t row) {
            const auto i = static_cast<std::size_t>(row);
            if (const Point at{discs.x[i], discs.y[i]}; are_within(at, centre, 3.0 * diameter)) {
                c.id.push_back(discs.id[i]);
                c.at.push_back(at);
            }
        });
        footwall.push_back(std::move(c));
    }
    return footwall;
}

/// Moves every point back with the rigid motion of its companions.
FormerTrace move_back(const std::vector<Companions>& footwall, const DiscPlaces& then) {
    FormerTrace former;
    RigidMotion block;
    for (const Companions& c : footwall) {
        RigidMotion motion;
        for (std::size_t k = 0; k < c.id.size(); ++k) {
            const auto id = static_cast<std::size_t>(c.id[k]);
            if (id >= then.row_of.size() || then.row_of[id] < 0)
                continue;
            const auto i = static_cast<std::size_t>(then.row_of[id]);
            motion.add(c.at[k], {then.x[i], then.y[i]});
            block.add(c.at[k], {then.x[i], then.y[i]});
        }
        if (motion.size() < 4)
            continue;
        motion.fit();
        former.points.push_back(motion.move(c.place));
    }
    if (block.size() > 0)
        block.fit();
    former.turn = -block.angle();
    return former;
}

/// Largest shear along t, in the given sense, in circles side by side across a point; 0 unless the
/// plane of largest shear is within 20 degrees of t.
double largest_shear(const ShearField& field, const Cells& cells, Point at, Point t, double sense) {
    const double diameter = field.diameter;
    double largest = 0.0;
    for (double offset = -2.0; offset <= 2.0; offset += 1.0) {
        const Point p{at.x - offset * diameter * t.y, at.y + offset * diameter * t.x};
        PlaneShear sum;
        int count = 0;
        cells.for_each_near(p.x, p.y, [&](std::int32_t row) {
            const auto i = static_cast<std::size_t>(row);
            if (are_within({field.x[i], field.y[i]}, p, 1.5 * diameter)) {
                const PlaneShear shear = field.components(i);
                sum.stretch += shear.stretch;
                sum.turn += shear.turn;
                ++count;
            }
        });
        const double shear = sense * sum.along(t);
        if (count > 2 && shear > 0.75 * sum.size())
            largest = std::max(largest, shear / count);
    }
    return largest;
}

/// Share of a former trace's points near which the discs slid along it in the given sense.
double active_share(const FormerTrace& former, const ShearField& field, const Cells& cells,
                    double sense, double least_strain) {
    std::size_t active = 0;
    for (std::size_t k = 0; k < former.points.size(); ++k) {
        const Point chord = chord_at(former.points, k);
        const double length = norm(chord);
        if (!(length > 0.0))
            continue;
        const Point t{chord.x / length, chord.y / length};
        active += largest_shear(field, cells, former.points[k], t, sense) >= least_strain;
    }
    return former.points.empty()
               ? 0.0
               : static_cast<double>(active) / static_cast<double>(former.points.size());
}

/// The traced line of a window that a former trace lies on: the one within four diameters of
/// most of its points, at least a third of them and half of the line's own. None if there is no
/// such line.
const FaultTrace* traced_on(const FormerTrace& former, const std::vector<FaultTrace>& traces,
                            double slip, double diameter) {
    const FaultTrace* best = nullptr;
    std::size_t most = 0;
    const auto near = [&](const Polyline& points, const Polyline& line) {
        return static_cast<std::size_t>(std::ranges::count_if(points, [&](Point p) {
            return std::abs(place_on(line, p).distance) < 4.0 * diameter;
        }));
    };
    for (const FaultTrace& t : traces) {
        const std::size_t on = near(former.points, t.points);
        if (median(t.slip) * slip > 0.0 && on > most && 3 * on >= former.points.size() &&
            2 * near(t.points, former.points) >= t.points.size()) {
            best = &t;
            most = on;
        }
    }
    return best;
}

/// Where the fault, straight on, meets the detachment, if that is within 20 diameters of its
/// lower end; else its lower end. A trace that falls by less than 30 degrees has left the fault
/// for the zone of shear along the detachment, and does not count.
Point foot_of(const FaultTrace& trace, const Chain& detachment, double diameter) {
    constexpr std::size_t piece = 4; // points
    std::size_t end = trace.points.size() - 1;
    while (end > piece && is_low_angle(trace.points[end - piece], trace.points[end]))
        --end;
    const Point from = trace.points[end / 2];
    const Point to = trace.points[end];
    const double length = norm(to - from);
    const Point step{0.25 * diameter * (to.x - from.x) / length,
                     0.25 * diameter * (to.y - from.y) / length};
    Point p = to;
    for (int k = 0; k < 4 * 20; ++k) {
        const auto foot = foot_point(detachment, p);
        if (!foot || foot->distance <= 0.0)
            return p;
        p = p + step;
    }
    return to;
}

/// When the wall came to where it is at some travel: where that is in a pause, or at its end, at
/// its beginning. What slipped before the pause was there by then.
Travel arrival(const Motion& motion, Travel travel) {
    constexpr Travel tolerance(1.0); // a window and a pause may end in the same cycle
    for (std::size_t k = motion.stages.size(); k-- > 0;)
        if (const MotionStage& one = motion.stages[k];
            one.slope == 0.0 && travel > one.start && travel < one.end + tolerance)
            travel = one.start;
    return travel;
}

/// The run up to the present state, as faults are followed back through it.
class Windows {
public:
    /// @param older  earlier states, oldest first; window k ends at older[k + 1]
    /// @param unit   of lengths, m
    Windows(std::span<const DiscPlaces> older, const Chain& detachment, double unit,
            const Setting& setting)
        : older_(older), detachment_(detachment), motion_(setting.motion) {
        for (std::size_t k = 0; k + 1 < older.size(); ++k) {
            fields_.push_back(shear_field(older[k], older[k + 1],
                                          setting.way_of_loose_sediment(older[k + 1].travel),
                                          setting.motion));
            coarsen(fields_.back(), unit);
            cells_.emplace_back(fields_.back().x, fields_.back().y, 1.5 * unit);
        }
        traces_.resize(fields_.size());
    }

    std::size_t size() const { return fields_.size(); }
    const DiscPlaces& end(std::size_t k) const { return older_[k + 1]; }

    /// When the wall came to where it is at the end of window k.
    Travel arrival(std::size_t k) const { return measures::arrival(motion_, older_[k + 1].travel); }

    /// Whether half of a former trace slid in the given sense.
    bool was_active(const FormerTrace& former, std::size_t k, double sense) const {
        const double least = FaultTraceOptions{}.least_strain_in(fields_[k].window);
        return active_share(former, fields_[k], cells_[k], sense, least) >= 0.5;
    }

    /// The lines of a window, traced when they are first asked for.
    const std::vector<FaultTrace>& traces(std::size_t k) {
        if (!traces_[k])
            traces_[k] = trace_faults(fields_[k], detachment_);
        return *traces_[k];
    }

private:
    std::span<const DiscPlaces> older_;
    const Chain& detachment_;
    const Motion& motion_;
    std::vector<ShearField> fields_;
    std::vector<Cells> cells_;
    std::vector<std::optional<std::vector<FaultTrace>>> traces_;
};

/// Properties of a trace in the last window and the present state.
/// @param unit  of lengths, m
Fault describe(const FaultTrace& trace, const State& now, const Chain& detachment, double unit,
               double years) {
    const double diameter = 2.0 * now.mean_radius, slip = median(trace.slip);
    Fault f;
    f.trace = trace;
    f.dip = dip_of(trace.points);
    f.normal = (slip > 0.0) == falls_right(trace.points);
    f.synthetic =
        falls_right(trace.points) == (detachment.back().end.x > detachment.front().start.x);
    f.rate = std::abs(slip) / years * 1e3;
    f.width = median(trace.width) / diameter;
    f.curvature = curvature_of(trace.points);
    f.foot = foot_of(trace, detachment, unit);
    f.born_at = f.traced_since = now.clock.extension;
    f.born_travel = now.clock.travel;
    f.dip_at_birth = f.dip;
    f.foot_at_birth = f.foot;
    return f;
}

/// Follows a fault back in time with its footwall, to its birth and to the first line traced since.
void trace_back(Fault& f, const std::vector<Companions>& footwall, Windows& windows,
                const Chain& detachment, double diameter) {
    const double slip = median(f.trace.slip);
    std::vector<std::pair<std::size_t, FormerTrace>> lived; // windows since birth, newest first
    std::size_t since_birth = 0;
    double active = 1.0, all = 1.0;
    for (std::size_t k = windows.size(); k-- > 0;) {
        FormerTrace former = move_back(footwall, windows.end(k));
        if (former.points.size() < fewest_points)
            break;
        const bool slid = windows.was_active(former, k, slip < 0.0 ? -1.0 : 1.0);
        active += slid;
        all += 1.0;
        lived.emplace_back(k, std::move(former));
        if (slid && 3.0 * active >= 2.0 * all) {
            f.born_at = windows.end(k).extension;
            f.born_travel = windows.arrival(k);
            f.footwall_turn = lived.back().second.turn * 180.0 / pi;
            since_birth = lived.size();
        }
    }
    for (std::size_t n = since_birth; n-- > 0;) {
        const auto& [k, former] = lived[n];
        if (const FaultTrace* t = traced_on(former, windows.traces(k), slip, diameter)) {
            f.dip_at_birth = dip_of(t->points);
            f.foot_at_birth = foot_of(*t, detachment, diameter);
            f.traced_since = windows.end(k).extension;
            return;
        }
    }
}

/// Which line a fault was traced as at first. From each line the way goes back to the one that it
/// was a window before, as its footwall carries it, or two or three, where it was not traced.
class FirstTraces {
public:
    FirstTraces(Windows& windows, double unit) : windows_(windows), unit_(unit) {}

    /// Name of a line that is traced in the present state of the discs, by its index there.
    /// @param end  windows before
    TraceName name_of(const std::vector<FaultTrace>& lines, std::size_t index,
                      const DiscPlaces& discs, const Cells& cells, std::size_t end) {
        constexpr std::size_t most_missed = 2; // windows
        const FaultTrace& line = lines[index];
        const std::vector<Companions> footwall = footwall_of(line, discs, cells, unit_);
        for (std::size_t k = end; k-- > 0 && k + most_missed + 1 >= end;) {
            const FormerTrace former = move_back(footwall, windows_.end(k));
            if (former.points.size() < fewest_points)
                break;
            const std::vector<FaultTrace>& older = windows_.traces(k);
            if (const FaultTrace* t = traced_on(former, older, median(line.slip), unit_))
                return name_of(k, static_cast<std::size_t>(t - older.data()));
        }
        return {discs.travel, static_cast<int>(index)};
    }

private:
    /// Name of a line that is traced in window k.
    TraceName name_of(std::size_t k, std::size_t index) {
        const auto known = names_.find({k, index});
        if (known != names_.end())
            return known->second;
        const DiscPlaces& discs = windows_.end(k);
        const Cells cells(discs.x, discs.y, 3.0 * unit_);
        return names_[{k, index}] = name_of(windows_.traces(k), index, discs, cells, k);
    }

    Windows& windows_;
    double unit_;
    std::map<std::pair<std::size_t, std::size_t>, TraceName> names_;
};

/// Index of the strongest normal fault of an attitude. One that reaches the lower half is the whole
/// fault; one that does not may be its upper part.
std::optional<std::size_t> strongest(const std::vector<Fault>& faults, bool synthetic,
                                     double half_depth) {
    std::optional<std::size_t> best;
    std::pair<bool, double> most{false, 0.0};
    for (std::size_t k = 0; k < faults.size(); ++k) {
        const Fault& f = faults[k];
        const std::pair rank{f.trace.points.back().y < half_depth, f.rate * f.trace.length()};
        if (f.synthetic == synthetic && f.normal && f.dip >= least_main_dip && rank > most) {
            most = rank;
            best = k;
        }
    }
    return best;
}

/// The main faults, and what all of them have in common.
void summarise(FaultReport& report, const Chain& detachment, double diameter) {
    const double half_depth = 0.5 * detachment.back().end.y;
    report.main_antithetic = strongest(report.faults, false, half_depth);
    report.main_synthetic = strongest(report.faults, true, half_depth);
    if (report.main_antithetic) {
        const Fault& f = report.faults[*report.main_antithetic];
        report.antithetic_foot = f.foot_at_birth.x - (f.traced_since - f.born_at).m;
    }
    std::vector<double> widths;
    for (const Fault& f : report.faults)
        widths.insert(widths.end(), f.trace.width.begin(), f.trace.width.end());
    if (!widths.empty())
        report.width = median(std::move(widths)) / diameter;
}

} // namespace

FaultReport report_faults(const Setting& setting, const RigidBase& base, const State& now,
                          std::span<const DiscPlaces> older) {
    FaultReport report;
    if (older.empty())
        return report;
    const Chain detachment = standing_base(base, now).surfaces.front().chain;
    const double diameter = 2.0 * now.mean_radius;
    const double unit = unit_of_faults(diameter, setting.thickness);
    const DiscPlaces discs(now);
    ShearField field = shear_field(older.back(), discs,
                                   setting.way_of_loose_sediment(now.clock.travel), setting.motion);
    const double years = setting.calendar.years(older.back().travel, now.clock.travel);
    coarsen(field, unit);
    const std::vector<FaultTrace> traces = trace_faults(field, detachment);
    if (!traces.empty()) {
        Windows windows(older, detachment, unit, setting);
        const Cells cells(discs.x, discs.y, 3.0 * unit);
        report.faults.resize(traces.size());
        for_each_shared(traces.size(), [&](std::size_t k) {
            report.faults[k] = describe(traces[k], now, detachment, unit, years);
        });
        FirstTraces first(windows, unit);
        for (std::size_t k = 0; k < traces.size(); ++k) {
            Fault& fault = report.faults[k];
            trace_back(fault, footwall_of(fault.trace, discs, cells, unit), windows, detachment,
                       unit);
            fault.name = first.name_of(traces, k, discs, cells, windows.size());
        }
        for_each_shared(traces.size(), [&](std::size_t k) {
            std::vector<Polyline> others;
            for (std::size_t m = 0; m < traces.size(); ++m)
                if (m != k)
                    others.push_back(traces[m].points);
            Fault& fault = report.faults[k];
            fault.cutoffs = fault_cutoffs(now, {.trace = fault.trace.points,
                                                .born_at = fault.born_travel,
                                                .others = others,
                                                .layers = setting.boundaries,
                                                .unit = unit});
        });
    }
    summarise(report, detachment, diameter);
    if (setting.detection_circle) {
        report.sediment_weak_off_fault_fraction =
            weak_off_faults(now, report.faults, of_fault * diameter);
        report.weak_off_fault_fraction = weak_off_fault(now, report.faults);
    }
    return report;
}

} // namespace listric::measures
