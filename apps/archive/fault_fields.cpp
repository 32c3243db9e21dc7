#include "apps/archive/fault_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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
    for (const auto& [stratum, value] : p.fault().throws)
        throws[fmt::format("{}", stratum)] = value;
    return throws;
}

Json points_of(P p) {
    Json points = Json::array();
    for (const dem::Point q : p.fault().trace.points)
        points.push_back(
            {std::round(p.steps * q.x) / p.steps, std::round(-p.steps * q.y) / p.steps});
    return points;
}

Json pre_rift_throw_of(P p) {
    return p.fault().pre_rift_throw ? Json(*p.fault().pre_rift_throw) : Json();
}

constexpr std::size_t of_trace = 7;

constexpr FaultField fields[] = {
    {"x_top_m", "m", "upper end of the line",
     [](P p) -> Json { return p.fault().trace.points.front().x; }},
    {"z_top_m", "m", "its depth", [](P p) -> Json { return -p.fault().trace.points.front().y; }},
    {"x_bottom_m", "m", "lower end of the line",
     [](P p) -> Json { return p.fault().trace.points.back().x; }},
    {"z_bottom_m", "m", "its depth", [](P p) -> Json { return -p.fault().trace.points.back().y; }},
    {"length_m", "m", "of the line", [](P p) -> Json { return p.fault().trace.length(); }, 6,
     "length"},
    {"dip_deg", "deg", "of the best straight line", of<&Fault::dip>, 7, "dip"},
    {"sense", "", "`normal` or `reverse`, from the slip of the window",
     [](P p) -> Json { return p.fault().normal ? "normal" : "reverse"; }, 5, "sense"},
    {"attitude", "", "`synthetic`: dips the way the detachment does; `antithetic`: against it",
     [](P p) -> Json { return attitude_of(p.fault().synthetic); }, 4, "attitude"},
    {field_rate, "mm/a",
     "slip, the integral of the shear across the trace, over time; median along it",
     of<&Fault::rate>, 8, "rate"},
    {field_width, "diameters",
     "full width at half maximum of the shear across the trace, median along it, mean diameters; a "
     "knife cut reads 2.4",
     of<&Fault::width>, 13, "width"},
    {"curvature_per_m", "1/m", "of the best parabola over the chord; positive: convex upward",
     of<&Fault::curvature>, 14},
    {"born_at_m", "m",
     "extension at the end of the window since which it has been active: half of its length slid "
     "in "
     "today's sense, in two thirds of the windows since",
     of<&Fault::born_at>, 9, "born at", true, true},
    {field_dip_at_birth, "deg",
     "of the line that was traced where the fault was then, in the window of its birth or the "
     "first "
     "one after it that has such a line; the footwall discs (6 diameters below the trace) say "
     "where "
     "it was",
     of<&Fault::dip_at_birth>, 10, "dip at birth", true, true},
    {"traced_since_m", "m", "end of that window", of<&Fault::traced_since>, 11, "", true, true},
    {"footwall_turn_deg", "deg",
     "rotation of these discs as one block since then, positive toward the detachment",
     of<&Fault::footwall_turn>, 12, "turn", true, true},
    {"foot_x_m", "m",
     "where it, straight on, meets the detachment, if within 20 diameters of its lower end; else "
     "its "
     "lower end. Where a trace falls by less than 30 degrees it follows the detachment's shear "
     "zone "
     "and does not count",
     [](P p) -> Json { return p.fault().foot.x; }, 15},
    {"foot_z_m", "m", "depth of that place", [](P p) -> Json { return -p.fault().foot.y; }, 16},
    {field_throw, "m",
     "by stratum, 0 the pre-rift top: height of the stratum 3 to 12 diameters beside the fault, as "
     "two parallel lines; positive: the side above the fault lies deeper",
     throws_of},
    {field_points, "m", "the line, one point per diameter", points_of},
    {"pre_rift_throw_m", "m",
     "median throw of the pre-rift layers: where the discs 6 diameters beside the trace say that a "
     "layer meets it. It is there also where the two sides of the pre-rift top have parted by "
     "kilometres",
     pre_rift_throw_of, 17, "pre-rift throw"},
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
