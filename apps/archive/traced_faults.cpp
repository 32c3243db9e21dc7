#include "apps/archive/traced_faults.hpp"

#include "apps/support/json_text.hpp"

#include <cmath>

namespace listric::archive {

using namespace measures;

nlohmann::ordered_json trace_object(const FaultTrace& trace, double dip, bool normal) {
    const dem::Point top = trace.points.front(), bottom = trace.points.back();
    return {{"x_top_m", top.x},
            {"z_top_m", -top.y},
            {"x_bottom_m", bottom.x},
            {"z_bottom_m", -bottom.y},
            {"length_m", trace.length()},
            {"dip_deg", dip},
            {"sense", normal ? "normal" : "reverse"}};
}

std::string to_json(std::span<const TracedFault> faults) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const TracedFault& f : faults) {
        nlohmann::ordered_json points = nlohmann::ordered_json::array();
        for (const dem::Point p : f.trace.points)
            points.push_back({p.x, -p.y});
        nlohmann::ordered_json fault = trace_object(f.trace, f.dip, f.normal);
        fault["slip_m"] = f.slip;
        fault["throw_m"] = f.throw_down;
        fault["width_diameters"] = f.width;
        fault["points_m"] = std::move(points);
        list.push_back(std::move(fault));
    }
    return to_text(list, 2) + "\n";
}

} // namespace listric::archive
