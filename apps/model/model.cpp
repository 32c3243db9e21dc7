#include "apps/model/model.hpp"

#include "apps/model/base_driver.hpp"
#include "coupling/footwall_loads.hpp"
#include "dem/events/equilibrium.hpp"
#include "dem/events/strain.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace listric {

using namespace dem;

ModelParts make_parts(const Scene& scene) {
    ModelParts parts;
    if (scene.hanging_wall)
        parts.base = make_rigid_base(scene);
    parts.physics.damping = scene.cycle.damping;
    // A base that stretches says itself how what rests on it moves.
    if (dem::stretching(parts.base, 0.0).rate == 0.0)
        parts.physics.averaging_time = scene.cycle.averaging_time;
    parts.materials.assign(3, scene.basement); // of every MaterialIndex
    for (const EffectPart& part : scene.effects)
        if (part.effect->contribute)
            part.effect->contribute(scene, parts);
    return parts;
}

double gravity_of(const Scene& scene) {
    return has_effect(scene, "gravity") ? make_parts(scene).physics.gravity : standard_gravity;
}

std::vector<std::unique_ptr<Event>> make_events(const Scene& scene, const ModelParts& parts) {
    constexpr double sampling = 2500.0; // a, the paper's interval of bond healing
    const double rate = scene.extension.rate;
    std::vector<StagedEvent> staged;
    const auto add = [&](StagedEvent event) {
        const auto place = std::ranges::upper_bound(staged, event.stage, {}, &StagedEvent::stage);
        staged.insert(place, std::move(event));
    };
    add({EventStage::sample, std::make_unique<Equilibrium>(sampling, rate, parts.physics.gravity)});
    for (const EffectPart& part : scene.effects)
        if (part.effect->make_events)
            for (StagedEvent& event : part.effect->make_events(scene, parts, staged))
                add(std::move(event));
    add({EventStage::strain, std::make_unique<Strain>(strain_window, rate)});
    std::vector<std::unique_ptr<Event>> events;
    std::ranges::transform(staged, std::back_inserter(events),
                           [](StagedEvent& event) { return std::move(event.event); });
    return events;
}

std::vector<coupling::FootwallLoad> make_footwall_loads(const Scene& scene,
                                                        const ModelParts& parts) {
    std::vector<coupling::FootwallLoad> loads;
    for (const EffectPart& part : scene.effects)
        if (part.effect->load_footwall)
            loads.push_back(part.effect->load_footwall(scene, parts));
    return loads;
}

std::unique_ptr<BaseDriver> make_base_driver(const Scene& scene, const ModelParts& parts,
                                             std::vector<std::unique_ptr<Event>>& events) {
    for (const EffectPart& part : scene.effects)
        if (part.effect->drive_base)
            return part.effect->drive_base(scene, parts, events);
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
    start.extension.distance = scene.extension.distance; // decides how far the base reaches
    std::erase_if(start.effects, [](const EffectPart& part) { return !part.effect->in_genesis; });
    return start;
}

} // namespace listric
