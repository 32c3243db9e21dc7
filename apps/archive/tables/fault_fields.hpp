#pragma once

#include "apps/measures/faults/fault.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <span>
#include <string_view>

namespace listric::archive {

/// A fault of a report.
struct FaultPlace {
    const measures::FaultReport& report;
    std::size_t index;  ///< in the report
    double steps = 1e3; ///< in a metre, of the trace's points

    const measures::Fault& fault() const { return report.faults[index]; }
};

/// Fields of every fault: summary.json, exports, the report's table and `listric trace` have
/// it from here.
struct FaultField {
    std::string_view name, unit, doc;
    nlohmann::ordered_json (*value)(const FaultPlace& place); ///< null: there is none
    int exported = 0;            ///< its place among the columns of exports; 0: it is not there
    std::string_view label = {}; ///< of the report's column; none: it is not there
    bool in_summary = true;
    bool of_past = false; ///< known of a fault only that has been followed back
};

/// All, in the order of summary.json.
std::span<const FaultField> fault_fields();

/// Fields of exports, in the order of their columns.
std::span<const FaultField* const> exported_fault_fields();

/// Where a fault is and how it dips: the first fields, which need a trace, its dip and sense only.
std::span<const FaultField> trace_fields();

/// The fault's object in summary.json.
nlohmann::ordered_json fault_object(const FaultPlace& place, std::span<const FaultField> fields);

/// Names of fields that other files have, too.
inline constexpr std::string_view field_width = "width_diameters", field_throw = "throw_m",
                                  field_greatest_throw = "greatest_throw_m",
                                  field_points = "points_m", field_slip = "slip_m",
                                  field_dip_at_birth = "dip_at_birth_deg",
                                  field_rate = "rate_mm_per_a";

} // namespace listric::archive
