#include "apps/archive/setting.hpp"

#include "dem/events/fault_weakening.hpp"
#include "dem/units.hpp"

#include <cassert>

namespace listric {

measures::Setting make_setting(const Scene& scene) {
    assert(scene.hanging_wall);
    measures::Setting setting;
    setting.length = scene.hanging_wall->length;
    setting.thickness = scene.hanging_wall->thickness;
    setting.has_detachment = scene.detachment.has_value();
    setting.has_bonds = scene.bonds.has_value();
    setting.gravity = scene.gravity ? scene.gravity->acceleration : 0.0;
    setting.extension_rate = scene.extension.rate;
    setting.extension_speed = scene.extension.speed;
    setting.output_interval = scene.output.interval;
    const auto weakening = scene.fault_weakening.value_or(dem::FaultWeakeningParameters{});
    setting.youngest_sediment = weakening.youngest_sediment * scene.extension.rate;
    if (scene.fault_weakening)
        setting.detection_circle = weakening.circle_diameters;
    if (const auto& deposited = scene.sedimentation) {
        setting.sediment = {deposited->level,
                            dem::Target(deposited->level, deposited->target),
                            deposited->surface_porosity,
                            {}};
        if (scene.compaction)
            setting.sediment->porosity_decay = scene.compaction->coefficient;
    }
    return setting;
}

std::vector<measures::FaultSegment>
fault_segments(std::span<const std::unique_ptr<dem::Event>> events) {
    const auto* detection = dem::find<dem::FaultWeakening>(events);
    if (!detection)
        return {};
    const dem::Table& found = detection->memory;
    const auto x = found.get<double>("x_m"), y = found.get<double>("y_m");
    const auto angle = found.get<double>("angle_rad"), slip = found.get<double>("slip_m"),
               at = found.get<double>("found_at_m");
    std::vector<measures::FaultSegment> segments;
    for (std::size_t k = 0; k < at.size(); ++k)
        segments.push_back({{x[k], y[k]}, angle[k] * 180.0 / dem::pi, slip[k], at[k]});
    return segments;
}

} // namespace listric
