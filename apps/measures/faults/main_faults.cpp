#include "apps/measures/faults/main_faults.hpp"

#include "apps/measures/basin/kinematics.hpp"
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
    const double turned = *rollover_tilt - normals_tilt(run.detachment, f.born_at.m);
    return turned > least ? std::optional(f.footwall_turn / turned) : std::nullopt;
}

/// A main fault, and what its measures look at.
struct MainFault {
    const RunSoFar& run;
    const Fault& fault;
    std::optional<double> rollover_tilt; ///< of the head block, degrees
    Polyline basement = in_basement(fault.trace.points, run.profile);

    bool crosses_basement() const {
        constexpr std::size_t fewest = 8; // points
        return basement.size() >= fewest;
    }
};

using Value = std::optional<double>;
using F = const MainFault&;

// Names begin with the fault's attitude.
constexpr Measure<MainFault> of_main_fault[] = {
    {"_born_at_m", "m", " fault: born at", "`born_at_m` of the main fault of that attitude",
     [](F f) -> Value { return f.fault.born_at.m; }},
    {"_dip_at_birth_deg", "deg", " fault: dip at birth",
     "`dip_at_birth_deg` of the main fault of that attitude",
     [](F f) -> Value { return f.fault.dip_at_birth; }},
    {"_turn_deg", "deg", " fault: turn since birth",
     "`footwall_turn_deg` of the main fault of that attitude",
     [](F f) -> Value { return f.fault.footwall_turn; }},
    {"_first_traced_travel_m", "m", " fault: travel when first traced",
     "travel at which the main fault of that attitude was traced for the first time, the first "
     "part of its `id`: where it changes from one moment to the next, another fault is the main "
     "one",
     [](F f) -> Value { return f.fault.name.travel.m; }},
    {"_throw_m", "m", " fault: throw",
     "`greatest_throw_m` of the fault that is the main one of its attitude at that moment; from "
     "moment to moment it may be another (`..._first_traced_travel_m`), with less throw",
     [](F f) { return pre_rift_throw_of(f.fault.cutoffs); }},
    {"_rate_mm_per_a", "mm/a", " fault: slip rate",
     "`rate_mm_per_a` of the main fault of that attitude",
     [](F f) -> Value { return f.fault.rate; }},
    {"_x_at_half_depth_m", "m", " fault: x at half depth",
     "x of the trace at half the depth of the flat; its change over the change of extension is 1 "
     "for a fault that moves with the right wall",
     [](F f) { return x_at(f.fault.trace.points, 0.5 * f.run.detachment.back().end.y); }},
    {"_bow", "1", " fault: bow",
     "greatest distance of the best parabola from its chord, over the chord, positive convex "
     "upward: of the fault with its scarp (the pre-rift top from the trace's upper end up to 250 m "
     "of depth)",
     [](F f) -> Value { return bow(with_scarp(f.fault.trace.points, f.run.profile)); }},
    {"_dip_deg", "deg", " fault: dip below the pre-rift top",
     "`dip_deg` of the part below the pre-rift top",
     [](F f) { return f.crosses_basement() ? Value(dip_of(f.basement)) : std::nullopt; }},
    {"_bow_in_basement", "1", " fault: bow below the pre-rift top",
     "`antithetic_bow` or `synthetic_bow` of the trace's part below the pre-rift top",
     [](F f) { return f.crosses_basement() ? Value(bow(f.basement)) : std::nullopt; }},
    {"_turn_over_head_block", "1", " fault: turn over the head block's",
     "`footwall_turn_deg` over the rotation of the head block since the fault's birth: 0 "
     "translated, 1 rotated with it",
     [](F f) { return turn_over_head_block(f.run, f.fault, f.rollover_tilt); }},
};

constexpr const char* attitudes[] = {"antithetic", "synthetic"};

NamedNumbers measure_main_fault(const MainFault& fault) {
    NamedNumbers numbers;
    for (const Measure<MainFault>& measure : of_main_fault)
        add(numbers, std::string(attitudes[fault.fault.synthetic]).append(measure.name),
            measure.value(fault));
    return numbers;
}

constexpr Quantity fault_count{"faults", "1", "traced faults", "number of traces"};
constexpr Quantity foot_beyond_sole{
    "antithetic_foot_beyond_sole_m", "m", "foot of the antithetic fault beyond the sole-out",
    "`antithetic_foot_x_m` less the x at which the detachment soles out"};
constexpr Quantity throw_over_throw{"antithetic_over_synthetic_throw", "1",
                                    "antithetic over synthetic throw",
                                    "`antithetic_throw_m` over `synthetic_throw_m`"};
constexpr Quantity inner_step{
    "inner_fault_step_m", "m", "step of new faults toward the breakaway",
    "largest step of a new fault toward the breakaway: horizontal distance, at the height of its "
    "middle, between a new normal fault steeper than 45 degrees and the nearest one that is at "
    "least 2 km of extension older. 0 if no new fault lies nearer to the breakaway than all older "
    "ones"};
constexpr Quantity throw_age{
    "throw_age_correlation", "1", "correlation of throw with stratum",
    "rank correlation (Spearman) of `faults.throw_m` with stratum, of the strata younger than the "
    "fault and the surface that it broke first, -1 where each younger stratum has less: median "
    "over the normal faults of 30 degrees or more that have five throws or more"};
constexpr Quantity throw_age_count{"throw_age_faults", "1", "faults with five throws or more",
                                   "number of the faults of `throw_age_correlation`"};

/// Ratio of the two main faults' greatest throws. None unless both are there.
std::optional<double> throw_ratio(const FaultReport& report) {
    if (!report.main_antithetic || !report.main_synthetic)
        return std::nullopt;
    const auto antithetic = pre_rift_throw_of(report.faults[*report.main_antithetic].cutoffs);
    const auto synthetic = pre_rift_throw_of(report.faults[*report.main_synthetic].cutoffs);
    if (!antithetic || !synthetic || *synthetic <= 0.0)
        return std::nullopt;
    return *antithetic / *synthetic;
}

NamedNumbers measure_throws_by_age(const std::vector<Fault>& faults) {
    std::vector<double> correlations;
    for (const Fault& f : faults)
        if (f.normal && f.dip >= least_main_dip)
            if (const auto r = throw_age_correlation(growth_throws_of(f.cutoffs)))
                correlations.push_back(*r);
    NamedNumbers numbers;
    add(numbers, throw_age_count, static_cast<double>(correlations.size()));
    if (!correlations.empty())
        add(numbers, throw_age, median(correlations));
    return numbers;
}

} // namespace

NamedNumbers measure_main_faults(const RunSoFar& run, const FaultReport& report,
                                 std::optional<double> rollover_tilt) {
    NamedNumbers numbers;
    add(numbers, fault_count, static_cast<double>(report.faults.size()));
    for (const Measure<FaultReport>& measure : fault_report_measures())
        if (measure.unit != index_unit)
            add(numbers, measure.quantity(), measure.value(report));
    if (report.antithetic_foot)
        add(numbers, foot_beyond_sole, *report.antithetic_foot - run.detachment.back().start.x);
    for (const auto& main : {report.main_antithetic, report.main_synthetic})
        if (main)
            append(numbers, measure_main_fault({run, report.faults[*main], rollover_tilt}));
    add(numbers, throw_over_throw, throw_ratio(report));
    add(numbers, inner_step, inner_fault_step(report.faults, run.cycle));
    append(numbers, measure_throws_by_age(report.faults));
    return numbers;
}

std::span<const Measure<FaultReport>> fault_report_measures() {
    using R = FaultReport;
    static constexpr Measure<R> all[] = {
        {"fault_width_diameters", "diameters", "width of faults",
         "median width of all traces, weighted by length", taken<&R::width>, OverTime::last,
         "2.5 to 3.5"},
        {antithetic_foot, "m", "foot of the antithetic fault, x",
         "place where the main antithetic fault nucleated: `foot_x_m` of the line whose dip is "
         "`dip_at_birth_deg`, less the extension from `born_at_m` to `traced_since_m`",
         taken<&R::antithetic_foot>},
        {"main_antithetic_fault", index_unit, "number of the main antithetic fault",
         "index in `faults` of the main antithetic fault: normal, steeper than 30 degrees, with "
         "the largest product of slip rate and length; one that reaches the lower half of the "
         "hanging wall goes before one that does not",
         taken<&R::main_antithetic>},
        {"main_synthetic_fault", index_unit, "number of the main synthetic fault",
         "index in `faults` of the main synthetic fault, chosen as `main_antithetic_fault` is",
         taken<&R::main_synthetic>},
        {"sediment_weak_off_fault_fraction", "1", "sediment weakened beside faults",
         "share of the sediment, by area, that is weakened and further than 5 diameters from every "
         "trace",
         taken<&R::sediment_weak_off_fault_fraction>},
        {"weak_off_fault_fraction", "1", "share of what is weakened that is of no fault",
         "share of the weakened discs, by area, that is of no fault: further than 5 diameters from "
         "every trace, and in no band of touching weakened discs that is 12 diameters long or "
         "longer, as the shortest trace; pictures paint it in a colour of its own",
         taken<&R::weak_off_fault_fraction>},
    };
    return all;
}

std::vector<Quantity> main_fault_quantities() {
    static const std::vector<std::pair<std::string, std::string>> texts = [] {
        std::vector<std::pair<std::string, std::string>> composed;
        for (const char* attitude : attitudes)
            for (const Measure<MainFault>& measure : of_main_fault)
                composed.emplace_back(std::string(attitude).append(measure.name),
                                      std::string(attitude).append(measure.label));
        return composed;
    }();
    std::vector<Quantity> all{fault_count, foot_beyond_sole, throw_over_throw,
                              inner_step,  throw_age,        throw_age_count};
    for (std::size_t k = 0; k < texts.size(); ++k) {
        const Measure<MainFault>& measure = of_main_fault[k % std::size(of_main_fault)];
        all.push_back({texts[k].first, measure.unit, texts[k].second, measure.doc});
    }
    return all;
}

double inner_fault_step(const std::vector<Fault>& faults, Extension tolerance) {
    constexpr double steep = 45.0;
    constexpr Extension younger(2e3);
    double step = 0.0;
    for (const Fault& inner : faults) {
        if (!inner.normal || inner.dip < steep)
            continue;
        const Point middle = inner.trace.points[inner.trace.points.size() / 2];
        std::optional<double> nearest;
        for (const Fault& older : faults) {
            if (!older.normal || older.dip < steep ||
                !has_come_to(inner.born_at, older.born_at + younger, tolerance))
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

} // namespace listric::measures
