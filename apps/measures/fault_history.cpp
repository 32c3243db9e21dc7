#include "apps/measures/fault_history.hpp"

#include "apps/measures/fault_throw.hpp"
#include "apps/measures/rigid_motion.hpp"
#include "apps/model/effects.hpp"
#include "apps/support/statistics.hpp"
#include "dem/base_place.hpp"
#include "dem/cells.hpp"
#include "dem/events/strain.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace listric {

using namespace dem;

namespace {

/// Sediment that a trace may rest on must be older than this, m of extension: looser sediment
/// creeps all over.
double least_age(const Scene& scene) {
    return scene.fault_weakening
               ? scene.fault_weakening->youngest_sediment * scene.extension.rate
               : FaultWeakeningParameters{}.youngest_sediment * scene.extension.rate;
}

/// The footwall discs next to one point of a trace.
struct Companions {
    Point place;                  ///< of the trace's point, m
    std::vector<std::int64_t> id; ///< of discs in its footwall
    std::vector<Point> at;        ///< where they are now, m
};

/// Where a trace was, and how far its footwall has turned since.
struct FormerTrace {
    std::vector<Point> points;
    double turn = 0.0; ///< of the footwall as one block, rad, counter-clockwise, then to now
};

std::vector<Companions> footwall_of(const FaultTrace& trace, const State& state,
                                    const Cells& cells) {
    const ConstDiscColumns d = disc_columns(state);
    const double diameter = 2.0 * state.mean_radius;
    const bool falls_right = trace.points.back().x > trace.points.front().x;
    std::vector<Companions> footwall;
    for (std::size_t k = 0; k < trace.points.size(); ++k) {
        const Point a = trace.points[k > 3 ? k - 3 : 0];
        const Point b = trace.points[std::min(k + 3, trace.points.size() - 1)];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        // The footwall is on the right of the downward direction where the fault falls right.
        const double side = falls_right ? 1.0 : -1.0;
        const Point n{side * (b.y - a.y) / length, -side * (b.x - a.x) / length};
        const Point p = trace.points[k];
        const Point centre{p.x + 6.0 * diameter * n.x, p.y + 6.0 * diameter * n.y};
        Companions c{p, {}, {}};
        cells.for_each_near(centre.x, centre.y, [&](std::int32_t row) {
            const auto i = static_cast<std::size_t>(row);
            if (std::hypot(d.x[i] - centre.x, d.y[i] - centre.y) < 3.0 * diameter) {
                c.id.push_back(d.id[i]);
                c.at.push_back({d.x[i], d.y[i]});
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

/// Share of a former trace's points near which the discs slid along it in the given sense.
double active_share(const FormerTrace& former, const ShearField& field, const Cells& cells,
                    double sense, double least_strain) {
    const double diameter = field.diameter;
    std::size_t active = 0;
    for (std::size_t k = 0; k < former.points.size(); ++k) {
        const Point a = former.points[k > 3 ? k - 3 : 0];
        const Point b = former.points[std::min(k + 3, former.points.size() - 1)];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        if (!(length > 0.0))
            continue;
        const Point t{(b.x - a.x) / length, (b.y - a.y) / length};
        double largest = 0.0;
        for (double offset = -2.0; offset <= 2.0; offset += 1.0) {
            const Point p{former.points[k].x - offset * diameter * t.y,
                          former.points[k].y + offset * diameter * t.x};
            double stretch = 0.0, turn = 0.0;
            int count = 0;
            cells.for_each_near(p.x, p.y, [&](std::int32_t row) {
                const auto i = static_cast<std::size_t>(row);
                if (std::hypot(field.x[i] - p.x, field.y[i] - p.y) < 1.5 * diameter) {
                    stretch += field.xx[i] - field.yy[i];
                    turn += field.xy[i] + field.yx[i];
                    ++count;
                }
            });
            const double shear =
                sense * (turn * (t.x * t.x - t.y * t.y) - 2.0 * t.x * t.y * stretch);
            // Within 20 degrees of the plane of largest shear.
            if (count > 2 && shear > 0.75 * std::hypot(stretch, turn))
                largest = std::max(largest, shear / count);
        }
        active += largest >= least_strain;
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
    const auto near = [&](const std::vector<Point>& points, const std::vector<Point>& line) {
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
    const auto is_flat = [&](std::size_t k) {
        const Point a = trace.points[k - piece], b = trace.points[k];
        return a.y - b.y < 0.5 * std::hypot(b.x - a.x, b.y - a.y);
    };
    while (end > piece && is_flat(end))
        --end;
    const Point from = trace.points[end / 2];
    const Point to = trace.points[end];
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const Point step{0.25 * diameter * (to.x - from.x) / length,
                     0.25 * diameter * (to.y - from.y) / length};
    Point p = to;
    for (int k = 0; k < 4 * 20; ++k) {
        const auto foot = foot_point(detachment, p);
        if (!foot || foot->distance <= 0.0)
            return p;
        p = {p.x + step.x, p.y + step.y};
    }
    return to;
}

} // namespace

std::optional<double> weak_off_faults(const State& state, std::span<const Fault> faults,
                                      double distance) {
    const ConstDiscColumns d = disc_columns(state);
    double all = 0.0, off = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] == 0)
            continue;
        const double area = d.radius[i] * d.radius[i];
        all += area;
        if (d.material[i] == weak && std::ranges::none_of(faults, [&](const Fault& f) {
                return std::abs(place_on(f.trace.points, {d.x[i], d.y[i]}).distance) <= distance;
            }))
            off += area;
    }
    return all > 0.0 ? std::optional(off / all) : std::nullopt;
}

FaultReport report_faults(const Scene& scene, const RigidBase& base, const State& now,
                          std::span<const DiscPlaces> older) {
    FaultReport report;
    if (older.empty())
        return report;
    const Chain detachment = standing_base(base, now).surfaces.front().chain;
    const double diameter = 2.0 * now.mean_radius;
    const ShearField field = shear_field(older.back(), DiscPlaces(now), least_age(scene));
    const FaultTraceOptions options;
    const std::vector<FaultTrace> traces = trace_faults(field, detachment, options);

    // Window k ends at older[k + 1].
    std::vector<ShearField> windows;
    std::vector<Cells> cells;
    for (std::size_t k = 0; k + 1 < older.size() && !traces.empty(); ++k) {
        windows.push_back(shear_field(older[k], older[k + 1], least_age(scene)));
        cells.emplace_back(windows.back().x, windows.back().y, 1.5 * diameter);
    }

    std::vector<std::optional<std::vector<FaultTrace>>> traced(windows.size());

    const ConstDiscColumns d = disc_columns(now);
    const Cells cells_now(d.x, d.y, 3.0 * diameter);
    const bool detachment_falls_right = detachment.back().end.x > detachment.front().start.x;
    for (const FaultTrace& trace : traces) {
        Fault f;
        f.trace = trace;
        const Point top = trace.points.front(), bottom = trace.points.back();
        f.dip = dip_of(trace.points);
        const bool falls_right = bottom.x > top.x;
        const double slip = median(trace.slip);
        f.normal = (slip > 0.0) == falls_right;
        f.synthetic = falls_right == detachment_falls_right;
        f.rate = std::abs(slip) / (field.window / scene.extension.rate) * 1e3;
        f.width = median(trace.width) / diameter;
        f.curvature = curvature_of(trace.points);
        f.foot = foot_of(trace, detachment, diameter);
        f.throws = fault_throws(now, trace.points);
        f.pre_rift_throw = pre_rift_throw(now, trace.points);

        // Back in time with the footwall.
        const std::vector<Companions> footwall = footwall_of(trace, now, cells_now);
        f.born_at = now.clock.extension;
        f.footwall_turn = 0.0;
        std::vector<std::pair<std::size_t, FormerTrace>> lived; // windows since birth, newest first
        std::size_t since_birth = 0;
        double active = 1.0, all = 1.0;
        for (std::size_t k = windows.size(); k-- > 0;) {
            const FormerTrace former = move_back(footwall, older[k + 1]);
            if (former.points.size() < 8)
                break;
            const double least = options.least_strain * windows[k].window / strain_window;
            const bool slid =
                active_share(former, windows[k], cells[k], slip < 0.0 ? -1.0 : 1.0, least) >= 0.5;
            active += slid;
            all += 1.0;
            lived.emplace_back(k, former);
            if (slid && 3.0 * active >= 2.0 * all) {
                f.born_at = older[k + 1].extension;
                f.footwall_turn = former.turn * 180.0 / pi;
                since_birth = lived.size();
            }
        }
        f.dip_at_birth = f.dip;
        f.traced_since = now.clock.extension;
        f.foot_at_birth = f.foot;
        for (std::size_t n = since_birth; n-- > 0;) {
            const auto& [k, former] = lived[n];
            if (!traced[k])
                traced[k] = trace_faults(windows[k], detachment, options);
            if (const FaultTrace* t = traced_on(former, *traced[k], slip, diameter)) {
                f.dip_at_birth = dip_of(t->points);
                f.foot_at_birth = foot_of(*t, detachment, diameter);
                f.traced_since = older[k + 1].extension;
                break;
            }
        }
        report.faults.push_back(std::move(f));
    }

    // A fault that reaches the lower half is the whole one; one that does not may be its upper
    // part.
    const double half_depth = 0.5 * detachment.back().end.y;
    const auto strongest = [&](bool synthetic) {
        std::optional<std::size_t> best;
        std::pair<bool, double> most{false, 0.0};
        for (std::size_t k = 0; k < report.faults.size(); ++k) {
            const Fault& f = report.faults[k];
            const std::pair rank{f.trace.points.back().y < half_depth, f.rate * f.trace.length()};
            if (f.synthetic == synthetic && f.normal && f.dip >= 30.0 && rank > most) {
                most = rank;
                best = k;
            }
        }
        return best;
    };
    report.main_antithetic = strongest(false);
    report.main_synthetic = strongest(true);
    if (report.main_antithetic) {
        const Fault& f = report.faults[*report.main_antithetic];
        report.antithetic_foot = f.foot_at_birth.x - (f.traced_since - f.born_at);
    }
    std::vector<double> widths;
    for (const Fault& f : report.faults)
        widths.insert(widths.end(), f.trace.width.begin(), f.trace.width.end());
    if (!widths.empty())
        report.width = median(widths) / diameter;
    if (scene.fault_weakening)
        report.sediment_weak_off_fault_fraction =
            weak_off_faults(now, report.faults, 5.0 * diameter);
    return report;
}

} // namespace listric
