#include "apps/measures/main_faults.hpp"

#include "apps/measures/fault_throw.hpp"
#include "apps/measures/kinematics.hpp"
#include "apps/support/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace listric::measures {

using namespace dem;

namespace {

/// The trace's points below the pre-rift top.
Polyline in_basement(const Polyline& trace, const Profile& profile) {
    Polyline points;
    for (Point p : trace) {
        const auto next = std::ranges::lower_bound(profile.x, p.x);
        const auto k =
            static_cast<std::size_t>(std::min(next - profile.x.begin(), std::ssize(profile.x) - 1));
        if (p.y < profile.pre_rift_top[k])
            points.push_back(p);
    }
    return points;
}

/// Where a trace is at a height; none if it does not reach it.
std::optional<double> x_at(const Polyline& trace, double y) {
    for (std::size_t k = 0; k + 1 < trace.size(); ++k)
        if (const Point a = trace[k], b = trace[k + 1]; a.y >= y && b.y < y)
            return a.x + (b.x - a.x) * (a.y - y) / (a.y - b.y);
    return std::nullopt;
}

/// The trace with its scarp, which sediment has buried: the pre-rift top from the trace's upper
/// end up the footwall to where it is so shallow that it bounds no basin.
Polyline with_scarp(const Polyline& trace, const Profile& profile) {
    Polyline points = trace;
    const std::ptrdiff_t up_the_footwall = trace.front().x > trace.back().x ? 1 : -1;
    const auto count = std::ssize(profile.x);
    std::ptrdiff_t k = std::ranges::lower_bound(profile.x, trace.front().x) - profile.x.begin();
    for (; k >= 0 && k < count && -points.front().y > depocentre_prominence; k += up_the_footwall) {
        const auto column = static_cast<std::size_t>(k);
        // A trace ends short of the surface by some diameters.
        if (const Point p{profile.x[column], profile.pre_rift_top[column]}; p.y > points.front().y)
            points.insert(points.begin(), p);
    }
    return points;
}

/// Greatest distance of the best parabola from its chord, over the chord; > 0: convex upward.
double bow(const Polyline& line) {
    return curvature_of(line) * norm(line.back() - line.front()) / 8.0;
}

/// Rotation of a fault's footwall over that of the head block, since the fault's birth. None while
/// the head block has turned by less than a degree.
std::optional<double> turn_over_head_block(const RunSoFar& run, const Fault& f,
                                           std::optional<double> rollover_tilt) {
    constexpr double least = 1.0; // degrees
    if (!rollover_tilt || f.born_at >= run.extension)
        return std::nullopt;
    const double turned = *rollover_tilt - normals_tilt(run.detachment, f.born_at);
    return turned > least ? std::optional(f.footwall_turn / turned) : std::nullopt;
}

NamedNumbers measure_main_fault(const RunSoFar& run, const std::string& name, const Fault& f,
                                std::optional<double> rollover_tilt) {
    constexpr std::size_t fewest = 8; // points
    const Polyline& trace = f.trace.points;
    const Polyline basement = in_basement(trace, run.profile);
    NamedNumbers numbers;
    add(numbers, name + "_born_at_m", f.born_at);
    add(numbers, name + "_dip_at_birth_deg", f.dip_at_birth);
    add(numbers, name + "_turn_deg", f.footwall_turn);
    add(numbers, name + "_throw_m", f.pre_rift_throw);
    add(numbers, name + "_rate_mm_per_a", f.rate);
    add(numbers, name + "_x_at_half_depth_m", x_at(trace, 0.5 * run.detachment.back().end.y));
    add(numbers, name + "_bow", bow(with_scarp(trace, run.profile)));
    if (basement.size() >= fewest) {
        add(numbers, name + "_dip_deg", dip_of(basement));
        add(numbers, name + "_bow_in_basement", bow(basement));
    }
    add(numbers, name + "_turn_over_head_block", turn_over_head_block(run, f, rollover_tilt));
    return numbers;
}

/// Of the two main faults' pre-rift throws. None unless both are there.
std::optional<double> throw_ratio(const FaultReport& report) {
    if (!report.main_antithetic || !report.main_synthetic)
        return std::nullopt;
    const auto& antithetic = report.faults[*report.main_antithetic].pre_rift_throw;
    const auto& synthetic = report.faults[*report.main_synthetic].pre_rift_throw;
    if (!antithetic || !synthetic || *synthetic <= 0.0)
        return std::nullopt;
    return *antithetic / *synthetic;
}

/// Of all faults in all windows so far.
NamedNumbers measure_throws_by_age(const RunSoFar& run) {
    std::vector<double> correlations;
    for (const Past& p : run.past)
        correlations.insert(correlations.end(), p.throw_correlations.begin(),
                            p.throw_correlations.end());
    if (!run.past.empty()) {
        const auto last =
            throw_age_correlations(run.setting, run.base, run.now, run.past.back().places);
        correlations.insert(correlations.end(), last.begin(), last.end());
    }
    NamedNumbers numbers;
    add(numbers, "throw_age_faults", static_cast<double>(correlations.size()));
    if (!correlations.empty())
        add(numbers, "throw_age_correlation", median(correlations));
    return numbers;
}

} // namespace

NamedNumbers measure_main_faults(const RunSoFar& run, const FaultReport& report,
                                 std::optional<double> rollover_tilt) {
    NamedNumbers numbers;
    add(numbers, "faults", static_cast<double>(report.faults.size()));
    add(numbers, "fault_width_diameters", report.width);
    add(numbers, "sediment_weak_off_fault_fraction", report.sediment_weak_off_fault_fraction);
    add(numbers, "antithetic_foot_x_m", report.antithetic_foot);
    if (report.antithetic_foot)
        add(numbers, "antithetic_foot_beyond_sole_m",
            *report.antithetic_foot - run.detachment.back().start.x);
    if (report.main_antithetic)
        append(numbers, measure_main_fault(run, "antithetic",
                                           report.faults[*report.main_antithetic], rollover_tilt));
    if (report.main_synthetic)
        append(numbers, measure_main_fault(run, "synthetic", report.faults[*report.main_synthetic],
                                           rollover_tilt));
    add(numbers, "antithetic_over_synthetic_throw", throw_ratio(report));
    add(numbers, "inner_fault_step_m", inner_fault_step(report.faults));
    append(numbers, measure_throws_by_age(run));
    return numbers;
}

double inner_fault_step(const std::vector<Fault>& faults) {
    constexpr double steep = 45.0, younger = 2e3;
    double step = 0.0;
    for (const Fault& inner : faults) {
        if (!inner.normal || inner.dip < steep)
            continue;
        const Point middle = inner.trace.points[inner.trace.points.size() / 2];
        std::optional<double> nearest;
        for (const Fault& older : faults) {
            if (!older.normal || older.dip < steep || older.born_at > inner.born_at - younger)
                continue;
            const Point beside = *std::ranges::min_element(
                older.trace.points, {}, [&](Point p) { return std::abs(p.y - middle.y); });
            nearest = std::min(nearest.value_or(beside.x - middle.x), beside.x - middle.x);
        }
        step = std::max(step, nearest.value_or(0.0));
    }
    return step;
}

std::optional<double> throw_age_correlation(const std::map<int, double>& throws) {
    constexpr std::size_t fewest = 5; // strata
    const auto n = static_cast<double>(throws.size());
    if (throws.size() < fewest)
        return std::nullopt;
    std::vector<double> values;
    for (const auto& [stratum, value] : throws)
        values.push_back(value);
    // Throws do not tie; strata are in order.
    double squares = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto rank = std::ranges::count_if(values, [&](double v) { return v < values[k]; });
        const double difference = static_cast<double>(rank) - static_cast<double>(k);
        squares += difference * difference;
    }
    return 1.0 - 6.0 * squares / (n * (n * n - 1.0));
}

std::vector<double> throw_age_correlations(const Setting& setting, const RigidBase& base,
                                           const State& now, const DiscPlaces& before) {
    std::vector<double> correlations;
    const ShearField field = shear_field(before, DiscPlaces(now), setting.youngest_sediment);
    for (const FaultTrace& trace : trace_faults(field, base.surfaces.front().chain)) {
        const bool normal = (median(trace.slip) > 0.0) == falls_right(trace.points);
        if (!normal || dip_of(trace.points) < least_main_dip)
            continue;
        if (const auto r = throw_age_correlation(fault_throws(now, trace.points)))
            correlations.push_back(*r);
    }
    return correlations;
}

} // namespace listric::measures
