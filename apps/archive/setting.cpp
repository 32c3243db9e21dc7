#include "apps/archive/setting.hpp"

#include "dem/units.hpp"

namespace listric::archive {

measures::Setting make_setting(const Scene& scene, const ModelParts& parts) {
    measures::Setting setting;
    setting.length = scene.hanging_wall.length;
    setting.thickness = scene.hanging_wall.thickness;
    setting.has_detachment = scene.detachment.has_value();
    setting.has_bonds = parts.bonds.has_value();
    setting.gravity = parts.physics.gravity;
    setting.extension_rate = scene.extension.rate;
    setting.extension_speed = scene.extension.speed;
    setting.output_interval = scene.output.interval;
    setting.youngest_sediment = parts.youngest_sediment * scene.extension.rate;
    setting.detection_circle = parts.detection_circle;
    if (const auto& s = parts.sediment)
        setting.sediment = {s->level, s->surface, s->surface_porosity, s->disc_density,
                            s->porosity_decay};
    return setting;
}

std::vector<measures::FaultSegment>
fault_segments(std::span<const std::unique_ptr<dem::Event>> events) {
    std::vector<measures::FaultSegment> segments;
    for (const auto& event : events) {
        const dem::Table& found = event->memory;
        if (!found.has("found_at_m"))
            continue;
        const auto x = found.get<double>("x_m"), y = found.get<double>("y_m");
        const auto angle = found.get<double>("angle_rad"), slip = found.get<double>("slip_m"),
                   at = found.get<double>("found_at_m");
        for (std::size_t k = 0; k < at.size(); ++k)
            segments.push_back({{x[k], y[k]}, angle[k] * 180.0 / dem::pi, slip[k], at[k]});
    }
    return segments;
}

} // namespace listric::archive
