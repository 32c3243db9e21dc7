#include "apps/archive/tables/traced_faults.hpp"

#include "apps/archive/tables/fault_fields.hpp"
#include "apps/scene/toml/json_text.hpp"

#include <nlohmann/json.hpp>

namespace listric::archive {

using namespace measures;

std::string to_json(std::span<const TracedFault> faults) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const TracedFault& f : faults) {
        FaultReport alone;
        Fault& only = alone.faults.emplace_back();
        only.trace = f.trace;
        only.dip = f.dip;
        only.normal = f.normal;
        nlohmann::ordered_json points = nlohmann::ordered_json::array();
        for (const dem::Point p : f.trace.points)
            points.push_back({p.x, -p.y});
        nlohmann::ordered_json fault = fault_object({alone, 0}, trace_fields());
        fault[field_slip] = f.slip;
        fault[field_throw] = f.throw_down;
        fault[field_width] = f.width;
        fault[field_points] = std::move(points);
        list.push_back(std::move(fault));
    }
    return to_text(list, 2) + "\n";
}

} // namespace listric::archive
