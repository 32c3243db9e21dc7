#include "apps/model/model.hpp"

#include "apps/model/base_driver.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "coupling/footwall_loads.hpp"
#include "dem/events/equilibrium.hpp"
#include "dem/events/strain.hpp"

#include <algorithm>
#include <cmath>

namespace listric {

using namespace dem;

namespace {

/// Divides the stiffness of materials. What is weak or soft keeps its own, up to that of rock:
/// where nothing weakens rock, the weak material is rock itself.
void soften(std::span<Material> materials, double softness) {
    if (softness == 1.0)
        return;
    for (std::size_t m = 0; m < materials.size(); ++m) {
        Material& material = materials[m];
        if (is_soft(materials, static_cast<std::uint8_t>(m))) {
            const Material& rock = materials[basement];
            material.normal_stiffness = std::min(material.normal_stiffness, rock.normal_stiffness);
            material.shear_stiffness = std::min(material.shear_stiffness, rock.shear_stiffness);
        } else {
            material.normal_stiffness /= softness;
            material.shear_stiffness /= softness;
        }
    }
}

} // namespace

ModelParts make_parts(const Scene& scene) {
    ModelParts parts;
    parts.base = make_rigid_base(scene);
    parts.physics.damping = scene.cycle.damping;
    // A base that stretches says itself how what rests on it moves.
    if (dem::stretching(parts.base, 0.0, 1.0).rate == 0.0)
        parts.physics.averaging_time = scene.cycle.averaging_time;
    parts.materials.assign(3, scene.basement); // of every MaterialIndex
    for (const EffectPart& part : scene.effects)
        if (part.effect->contribute)
            part.effect->contribute(scene, parts);
    soften(parts.materials, scene.cycle.softness);
    return parts;
}

Events make_events(const Scene& scene, const ModelParts& parts) {
    const double rate = scene.extension.rate;
    Events events;
    dem::add(events, std::make_unique<Equilibrium>(rate, parts.physics.gravity));
    for (const EffectPart& part : scene.effects)
        if (part.effect->add_events)
            part.effect->add_events(scene, parts, events);
    dem::add(events, std::make_unique<Strain>(strain_window, rate));
    return events;
}

std::vector<coupling::FootwallLoad>
make_footwall_loads(const Scene& scene, const ModelParts& parts,
                    std::span<const std::unique_ptr<Event>> events) {
    std::vector<coupling::FootwallLoad> loads;
    for (const EffectPart& part : scene.effects) {
        if (part.effect->load_footwall)
            loads.push_back(part.effect->load_footwall(scene, parts));
        if (part.effect->load_bending_base)
            std::ranges::move(part.effect->load_bending_base(scene, parts, events),
                              std::back_inserter(loads));
    }
    return loads;
}

std::unique_ptr<BaseDriver> make_base_driver(const Scene& scene, const ModelParts& parts,
                                             std::span<const std::unique_ptr<Event>> events,
                                             std::vector<std::unique_ptr<Event>>& loads) {
    for (const EffectPart& part : scene.effects)
        if (part.effect->drive_base)
            return part.effect->drive_base(scene, parts, events, loads);
    return nullptr;
}

EffectMeasures measure_effects(const Observation& now) {
    EffectMeasures all;
    for (const EffectPart& part : now.scene.effects) {
        for (const Measure<Observation>& measure : part.effect->measures)
            if (const auto value = measure.value ? measure.value(now) : std::nullopt)
                all.numbers.emplace_back(measure.name, *value);
        for (const MeasuredObjects& objects : part.effect->objects) {
            auto value = objects.value(now);
            if (value && objects.is_list)
                all.lists.emplace_back(objects.name, std::move(*value));
            else if (value)
                all.groups.emplace_back(objects.name, std::move(value->front()));
        }
    }
    return all;
}

namespace {

/// Values that are not there do not count.
double over_time(OverTime over, std::span<const double> values) {
    double sum = 0.0, largest = 0.0, count = 0.0;
    for (const double value : values)
        if (!std::isnan(value)) {
            sum += value;
            largest = std::max(largest, std::abs(value));
            count += 1.0;
        }
    return over == OverTime::last      ? values.back()
           : over == OverTime::largest ? largest
                                       : sum / std::max(1.0, count);
}

} // namespace

NamedNumbers summarise_effects(const Scene& scene, const Table& history) {
    NamedNumbers numbers;
    for (const EffectPart& part : scene.effects)
        for (const Measure<Observation>& measure : part.effect->measures) {
            const OverTime over = measure.over;
            const bool is_known = measure.value && over == OverTime::last; // as at the end
            if (!is_known && over != OverTime::none && history.has(measure.name))
                numbers.emplace_back(measure.name,
                                     over_time(over, history.get<double>(measure.name)));
        }
    return numbers;
}

Scene genesis_of(const Scene& scene) {
    Scene start = scene;
    start.accuracy = start.description = start.name = "";
    start.extension = {};
    start.output = {};
    start.extension.distance = greatest_extension(scene); // decides how far the base reaches
    if (!start.detachment && !start.stretching) // it comes to rest on the whole of a flat base
        start.stretching = StretchingParameters{base_friction(scene)};
    if (start.detachment) { // the backstop stands in genesis
        start.detachment->footwall_top.reset();
        start.detachment->base = DetachmentParameters{}.base;
        start.detachment->footwall_friction = DetachmentParameters{}.footwall_friction;
    }
    std::erase_if(start.effects, [](const EffectPart& part) { return !part.effect->in_genesis; });
    for (EffectPart& part : start.effects)
        if (part.effect->as_in_genesis)
            part.effect->as_in_genesis(part.parameters);
    return start;
}

} // namespace listric
