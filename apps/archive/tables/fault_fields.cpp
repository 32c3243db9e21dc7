#include "apps/archive/tables/fault_fields.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace listric::archive {

using namespace measures;

namespace {

using Json = nlohmann::ordered_json;
using P = const FaultPlace&;

/// A member of the fault.
template <auto Member> Json of(P p) { return p.fault().*Member; }

constexpr const char* attitude_of(bool synthetic) { return synthetic ? "synthetic" : "antithetic"; }

Json main_of(P p) {
    return p.index == p.report.main_antithetic  ? attitude_of(false)
           : p.index == p.report.main_synthetic ? attitude_of(true)
                                                : "";
}

Json throws_of(P p) {
    Json throws = Json::object();
    for (const auto& [horizon, value] : measures::throws_of(p.fault().cutoffs))
        throws[fmt::format("{}", horizon)] = value;
    return throws;
}

Json throw_errors_of(P p) {
    Json errors = Json::object();
    for (const auto& [horizon, at] : p.fault().cutoffs)
        if (at.is_resolved)
            errors[fmt::format("{}", horizon)] = at.error;
    return errors;
}

Json points_of(P p) {
    Json points = Json::array();
    for (const dem::Point q : p.fault().trace.points)
        points.push_back(
            {std::round(p.steps * q.x) / p.steps, std::round(-p.steps * q.y) / p.steps});
    return points;
}

Json greatest_throw_of(P p) {
    const auto thrown = pre_rift_throw_of(p.fault().cutoffs);
    return thrown ? Json(*thrown) : Json();
}

std::string id_of(const TraceName& name) {
    return fmt::format("{:.5g}-{}", name.travel.m, name.index);
}

constexpr std::size_t of_trace = 7;

constexpr FaultField fields[] = {
    {"x_top_m", "m", "x of the upper end of the line",
     [](P p) -> Json { return p.fault().trace.points.front().x; }},
    {"z_top_m", "m", "depth of the upper end of the line",
     [](P p) -> Json { return -p.fault().trace.points.front().y; }},
    {"x_bottom_m", "m", "x of the lower end of the line",
     [](P p) -> Json { return p.fault().trace.points.back().x; }},
    {"z_bottom_m", "m", "depth of the lower end of the line",
     [](P p) -> Json { return -p.fault().trace.points.back().y; }},
    {"length_m", "m", "length of the line", [](P p) -> Json { return p.fault().trace.length(); }, 6,
     "length"},
    {"dip_deg", "deg", "dip of the best straight line", of<&Fault::dip>, 7, "dip"},
    {"sense", "", "sense of slip in the window: `normal` or `reverse`",
     [](P p) -> Json { return p.fault().normal ? "normal" : "reverse"; }, 5, "sense"},
    {"attitude", "",
     "attitude of the fault: `synthetic` dips as the detachment does, `antithetic` against it",
     [](P p) -> Json { return attitude_of(p.fault().synthetic); }, 4, "attitude"},
    {field_rate, "mm/a",
     "slip rate: the integral of the shear across the trace, over time; median along the trace",
     of<&Fault::rate>, 8, "rate"},
    {field_width, "diameters",
     "full width at half maximum of the shear across the trace, median along the trace, in mean "
     "diameters; a cut without width reads 2.4",
     of<&Fault::width>, 13, "width"},
    {"curvature_per_m", "1/m",
     "curvature of the best parabola over the chord; positive: convex upward",
     of<&Fault::curvature>, 14},
    {"born_at_m", "m",
     "extension at which the fault formed. A fault counts as active in a window if at least half "
     "of its length slips in its present sense; it must be active in two thirds of all windows "
     "after birth",
     [](P p) -> Json { return p.fault().born_at.m; }, 9, "born at", true, true},
    {"born_travel_m", "m",
     "travel at which that was, the run's clock: with stages that pause or shorten an extension "
     "may be that of several moments",
     [](P p) -> Json { return p.fault().born_travel.m; }, 0, "", true, true},
    {field_dip_at_birth, "deg",
     "dip of the fault when it formed: dip of the line traced at its place in the window of its "
     "birth, or in the first window after it that has such a line. Discs of its footwall (6 "
     "diameters below the trace) mark its place",
     of<&Fault::dip_at_birth>, 10, "dip at birth", true, true},
    {"traced_since_m", "m", "extension at the end of the window of `dip_at_birth_deg`",
     [](P p) -> Json { return p.fault().traced_since.m; }, 11, "", true, true},
    {"footwall_turn_deg", "deg",
     "rotation of the footwall discs as one block since `traced_since_m`, positive toward the "
     "detachment",
     of<&Fault::footwall_turn>, 12, "turn", true, true},
    {"foot_x_m", "m",
     "x of the fault's foot: the trace, continued straight, meets the detachment there, if within "
     "20 diameters of its lower end; otherwise x of its lower end. Parts of a trace that fall by "
     "less than 30 degrees follow the detachment's shear zone and do not count",
     [](P p) -> Json { return p.fault().foot.x; }, 15},
    {"foot_z_m", "m", "depth of the foot", [](P p) -> Json { return -p.fault().foot.y; }, 16},
    {field_throw, "m",
     "throw by horizon, numbered as `stratum` of the exported horizons: 0 the pre-rift top, 1 and "
     "more the tops of strata, -1 and less the layers below the pre-rift top. Height of the "
     "footwall's cutoff over that of the hanging wall; a cutoff is where the horizon, straight on "
     "from 3 diameters and more beside the fault, meets the trace. Positive: the side above the "
     "fault lies deeper. None where `throw_error_m` would exceed two diameters, and of a stratum "
     "thinner than three",
     throws_of},
    {field_points, "m", "points of the line, one per diameter", points_of},
    {field_greatest_throw, "m",
     "greatest of `throw_m` over the horizons of rock before extension, the pre-rift top and the "
     "layers below it; of negative ones the one furthest from 0",
     greatest_throw_of, 17, "greatest throw"},
    {"throw_error_m", "m",
     "error of each of `throw_m`: scatter of the discs about the horizons, and what another way to "
     "extend these to the fault changes",
     throw_errors_of},
    {"id", "",
     "name of the fault that stays the same as it slips on: the travel (m) at which it was traced "
     "for the first time, and its place by length among the lines of that moment, from 0. From "
     "moment to moment discs of its footwall mark its place, as for `dip_at_birth_deg`; it may be "
     "without a line for two windows. Lines of one `id` are parts of one fault",
     [](P p) -> Json { return id_of(p.fault().name); }, 18, "id", true, true},
    {"name", "", "`fault N`", [](P p) -> Json { return fmt::format("fault {}", p.index); }, 1, "",
     false},
    {"fault", "1", "index in `faults`", [](P p) -> Json { return static_cast<double>(p.index); }, 2,
     "fault", false},
    {"main", "", "attitude of the main fault that it is, if it is one", main_of, 3, "main", false},
};

} // namespace

std::span<const FaultField> fault_fields() { return fields; }

std::span<const FaultField* const> exported_fault_fields() {
    static const std::vector<const FaultField*> exported = [] {
        std::vector<const FaultField*> all;
        for (const FaultField& field : fields)
            if (field.exported > 0)
                all.push_back(&field);
        std::ranges::sort(all, {}, &FaultField::exported);
        return all;
    }();
    return exported;
}

std::span<const FaultField> trace_fields() { return fault_fields().first(of_trace); }

Json fault_object(const FaultPlace& place, std::span<const FaultField> wanted) {
    Json object = Json::object();
    for (const FaultField& field : wanted)
        if (field.in_summary)
            if (Json value = field.value(place); !value.is_null())
                object[std::string(field.name)] = std::move(value);
    return object;
}

} // namespace listric::archive
