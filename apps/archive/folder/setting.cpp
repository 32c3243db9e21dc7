#include "apps/archive/folder/setting.hpp"

#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace listric::archive {

namespace {

/// Tops and bottoms of the layers from the highest down; where one ends on another there is one.
std::vector<measures::LayerBoundary> boundaries_of(const ModelParts& parts) {
    constexpr double apart = 1.0; // m
    std::vector<measures::LayerBoundary> all;
    for (const LayerFacts& layer : parts.layers)
        all.push_back({"layer " + layer.name, layer.rock.top});
    const auto is_there = [&](const dem::TargetLine& line) {
        return std::ranges::any_of(all, [&](const measures::LayerBoundary& other) {
            return std::ranges::all_of(line.points(), [&](dem::Point p) {
                return std::abs(other.line.height(p.x) - p.y) < apart;
            });
        });
    };
    std::vector<measures::LayerBoundary> bottoms;
    for (const LayerFacts& layer : parts.layers)
        if (!is_there(layer.rock.bottom))
            bottoms.push_back({"base of layer " + layer.name, layer.rock.bottom});
    all.insert(all.end(), bottoms.begin(), bottoms.end());
    std::ranges::stable_sort(all, std::ranges::greater{}, [](const auto& boundary) {
        double sum = 0.0;
        for (const dem::Point& p : boundary.line.points())
            sum += p.y;
        return sum / static_cast<double>(boundary.line.points().size());
    });
    return all;
}

} // namespace

measures::Setting make_setting(const Scene& scene, const ModelParts& parts) {
    measures::Setting setting;
    setting.length = scene.hanging_wall.length;
    setting.thickness = scene.hanging_wall.thickness;
    setting.has_detachment = scene.detachment.has_value();
    setting.has_bonds = parts.bonds.has_value();
    setting.gravity = parts.physics.gravity;
    setting.calendar = make_calendar(scene);
    setting.extension_speed = scene.extension.speed;
    setting.motion = parts.base.motion;
    setting.output_interval = scene.output.interval;
    setting.youngest_sediment = dem::Travel(parts.youngest_sediment);
    setting.detection_circle = parts.detection_circle;
    if (const auto& s = parts.sediment)
        setting.sediment = {s->surface, s->surface_porosity, s->disc_density, s->porosity_decay,
                            s->beds};
    setting.boundaries = boundaries_of(parts);
    return setting;
}

std::vector<measures::DetectedSegment>
fault_segments(std::span<const std::unique_ptr<dem::Event>> events) {
    std::vector<measures::DetectedSegment> segments;
    for (const auto& event : events) {
        const dem::Table& found = event->memory;
        if (!found.has("found_at_m"))
            continue;
        const auto x = found.get<double>("x_m"), y = found.get<double>("y_m");
        const auto angle = found.get<double>("angle_rad"), slip = found.get<double>("slip_m"),
                   at = found.get<double>("found_at_m");
        for (std::size_t k = 0; k < at.size(); ++k)
            segments.push_back(
                {{x[k], y[k]}, angle[k] * 180.0 / dem::pi, slip[k], dem::Travel(at[k])});
    }
    return segments;
}

} // namespace listric::archive
