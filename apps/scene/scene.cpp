#include "apps/scene/scene.hpp"

#include "apps/scene/parameters/accuracy.hpp"
#include "apps/scene/parameters/flat_base.hpp"
#include "apps/scene/parameters/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace listric {

using namespace dem;

bool is_drawn_at(const Scene& scene, double extension) {
    return std::ranges::any_of(scene.output.figures, [&](double mark) {
        return std::abs(mark - extension) <= 0.5 * scene.output.interval;
    });
}

void set_level(Scene& scene, const AccuracyLevel& level) {
    scene.hanging_wall.mean_radius = level.mean_radius;
    scene.extension.speed = level.speed;
    scene.extension.ramp = level.ramp;
    scene.cycle.softness = level.softness;
}

Scene at_level(const Scene& scene, const AccuracyLevel& level) {
    const AccuracyLevel& own = accuracy_level(scene.accuracy);
    AccuracyLevel kept = level;
    if (scene.extension.speed != own.speed)
        kept.speed = scene.extension.speed;
    if (scene.extension.ramp != own.ramp)
        kept.ramp = scene.extension.ramp;
    if (scene.cycle.softness != own.softness)
        kept.softness = scene.cycle.softness;
    Scene other = scene;
    set_level(other, kept);
    return other;
}

Motion make_motion(const Scene& scene) {
    Motion motion{scene.extension.speed, scene.extension.ramp};
    const Stages* stages = scene.find<Stages>();
    if (!stages)
        return motion;
    Travel travel;
    Extension position;
    for (const auto& one : *stages) {
        const double speed = one.speed.value_or(scene.extension.speed);
        const double distance = one.distance.value_or(0.0);
        const double ratio = one.rate.value_or(scene.extension.rate) / scene.extension.rate;
        MotionStage made;
        made.start = travel;
        if (one.pause && one.step)
            travel = stepped(one, travel).end();
        else
            travel = travel + Travel(one.pause ? *one.pause * scene.extension.rate
                                               : std::abs(distance) / ratio);
        made.end = travel;
        made.start_position = position;
        position = position + Extension(distance);
        made.slope = distance == 0.0 ? 0.0 : std::copysign(ratio, distance);
        made.speed = distance == 0.0 ? speed : speed / ratio;
        if (one.base && scene.detachment)
            made.runs_from = runs_from(*one.base, *scene.detachment);
        made.detachment_friction = one.detachment_friction;
        made.sediment_friction = one.sediment_friction;
        made.surface = one.surface_work;
        motion.stages.push_back(made);
    }
    return motion;
}

double greatest_extension(const Scene& scene) {
    if (!scene.find<Stages>())
        return scene.extension.distance;
    double position = 0.0, greatest = 0.0;
    for (const auto& one : *scene.find<Stages>())
        greatest = std::max(greatest, position += one.distance.value_or(0.0));
    return greatest;
}

double least_extension(const Scene& scene) {
    if (!scene.find<Stages>())
        return 0.0;
    double position = 0.0, least = 0.0;
    for (const auto& one : *scene.find<Stages>())
        least = std::min(least, position += one.distance.value_or(0.0));
    return least;
}

std::optional<FlatBase> flat_base(const Scene& scene) {
    const auto* moves = scene.find<PrescribedMotion>();
    if (scene.detachment || (!scene.stretching && !moves))
        return std::nullopt;
    FlatBase base{.stretches = scene.stretching.has_value()};
    if (scene.stretching)
        base.friction = scene.stretching->friction;
    else if (moves->friction)
        base.friction = *moves->friction;
    if (!moves || !moves->fault_x)
        return base;
    const double down = moves->fault_sense == FaultSense::normal ? 1.0 : -1.0;
    // Where the base stretches it slips in proportion to the wall's way; else its slip is what the
    // run counts.
    const double share =
        base.stretches ? moves->fault_slip.value_or(0.0) / scene.extension.distance : 1.0;
    base.fault = BasementFault{*moves->fault_x, moves->fault_dip, down * share};
    return base;
}

std::optional<BasementFault> basement_fault(const Scene& scene) {
    const auto base = flat_base(scene);
    return base ? base->fault : std::nullopt;
}

RigidBase make_rigid_base(const Scene& scene) {
    const Extent extent{scene.hanging_wall.length, scene.hanging_wall.thickness,
                        greatest_extension(scene)};
    const Motion motion = make_motion(scene);
    RigidBase base = scene.detachment
                         ? make_halfgraben(*scene.detachment, extent, scene.basement, motion)
                         : make_box(*flat_base(scene), extent, scene.basement, motion);
    for (Surface& surface : base.surfaces)
        if (surface.name == "right wall" || surface.name == "left wall")
            surface.friction = scene.extension.wall_friction;
    return base;
}

double base_friction(const Scene& scene) {
    if (!scene.detachment) {
        const auto base = flat_base(scene);
        return base ? base->friction : 0.0;
    }
    const Stages* stages = scene.find<Stages>();
    return (stages ? stages->back().detachment_friction : std::nullopt)
        .value_or(scene.detachment->friction);
}

double hanging_wall_area(const Scene& scene) {
    const bool has_base =
        scene.detachment ? !scene.detachment->segments.empty() : flat_base(scene).has_value();
    return has_base ? hanging_wall_area(scene.hanging_wall, base_line(make_rigid_base(scene), 0.0))
                    : 0.0;
}

std::size_t estimated_discs(const Scene& scene) {
    return disc_count(scene.hanging_wall, hanging_wall_area(scene));
}

} // namespace listric
