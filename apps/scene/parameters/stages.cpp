#include "apps/scene/parameters/stages.hpp"

#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace listric {

using namespace dem;

namespace {

/// Room that the wall keeps from the end of the last arc, over the hanging wall's thickness: 5 of
/// 15 km.
constexpr double least_room = 1.0 / 3.0;

/// x of the end of the detachment's last arc, m; 0 without one.
double end_of_arcs(const Scene& scene) {
    const RigidBase base = make_rigid_base(scene);
    double x = 0.0;
    for (const Segment& piece : base.surfaces.front().chain)
        if (piece.curvature != 0.0)
            x = piece.end.x;
    return x;
}

std::string path_of(std::size_t stage, const char* key) {
    return fmt::format("stage[{}].{}", stage, key);
}

void check_each(const Stages& stages, const Refuse& refuse) {
    for (std::size_t k = 0; k < stages.size(); ++k) {
        const StageParameters& one = stages[k];
        if (one.distance && one.pause)
            refuse(path_of(k, "pause_a"),
                   fmt::format("is {} beside distance_m = {}; a stage moves or rests, give one",
                               text(*one.pause), text(*one.distance)));
        if (!one.distance && !one.pause)
            refuse(path_of(k, "distance_m"),
                   "is missing; a stage needs distance_m, below 0 for shortening, or pause_a");
        if (one.distance == 0.0)
            refuse(path_of(k, "distance_m"), "is 0, a stage that does nothing; leave it out, or "
                                             "give pause_a");
        if (one.step && !one.pause)
            refuse(path_of(k, "step_a"),
                   fmt::format("is {}, but the stage is no pause; leave it out, or give pause_a",
                               text(*one.step)));
        if (one.settle && !one.step)
            refuse(path_of(k, "settle_m"),
                   fmt::format("is {}, travel of a step, but the stage has no step_a; give "
                               "pause_a and step_a, or leave it out",
                               text(*one.settle)));
        if (one.pause && one.rate)
            refuse(path_of(k, "rate_m_per_a"),
                   fmt::format("is {}, but the wall rests; leave it out", text(*one.rate)));
    }
    if (stages.front().rate)
        refuse(path_of(0, "rate_m_per_a"),
               fmt::format("is {}, but the first stage's rate is the run's clock; set "
                           "extension.rate_m_per_a to it",
                           text(*stages.front().rate)));
}

void check_ways(const Scene& scene, const Stages& stages, const Refuse& refuse) {
    if (scene.stretching)
        for (std::size_t k = 0; k < stages.size(); ++k)
            if (stages[k].base.value_or(BaseKind::sheet) != BaseKind::sheet)
                refuse(path_of(k, "base"), "is of a detachment, but [stretching] moves what lies "
                                           "on it; leave it out");
    const double arcs = scene.detachment ? end_of_arcs(scene) : 0.0;
    const double room = least_room * scene.hanging_wall.thickness;
    double position = 0.0;
    for (std::size_t k = 0; k < stages.size(); ++k) {
        const double distance = stages[k].distance.value_or(0.0);
        position += distance;
        if (distance >= 0.0)
            continue;
        if (scene.detachment && !scene.detachment->footwall_top)
            refuse(
                path_of(k, "distance_m"),
                fmt::format("is {}, shortening, which needs ground behind the breakaway for what "
                            "is pushed over it; add detachment.footwall_top_m, such as 30000.0",
                            text(distance)));
        if (const double wall = scene.hanging_wall.length + position; wall < arcs + room)
            refuse(
                path_of(k, "distance_m"),
                fmt::format("is {}: the wall comes to x = {}, allowed: at least {}, {} m from the "
                            "end of the last arc",
                            text(distance), text(wall), text(arcs + room), text(room)));
        if (scene.detachment && -position > *scene.detachment->footwall_top)
            refuse(path_of(k, "distance_m"),
                   fmt::format("is {}: net shortening of {} m pushes rock beyond "
                               "detachment.footwall_top_m = {}; lengthen that",
                               text(distance), text(-position),
                               text(*scene.detachment->footwall_top)));
    }
}

} // namespace

const std::vector<Parameter>& stage_parameters() {
    using P = StageParameters;
    static const std::vector<Parameter> parameters = {
        {"distance_m", at<&P::distance>, "m", between(-1e6, 1e6), "",
         "way of the wall; above 0 extension, below 0 shortening",
         "Turns the motion where its sign changes: normal faults slip back."},
        {"pause_a", at<&P::pause>, "a", ranges::duration, "",
         "time in which base and wall rest, in place of distance_m",
         "Lets sediment fill, compact and heal while nothing moves. Without step_a it takes as "
         "much travel as extension in that time."},
        {"step_a", at<&P::step>, "a", ranges::duration, "",
         "greatest step of a pause: strata, loads and all that goes by years then do so by equal "
         "steps, settle_m of travel each; default: none, time goes by travel",
         "Raising it makes a pause cheaper and its strata fewer and thicker.", between(1e5, 5e6)},
        {"settle_m", at<&P::settle>, "m", between(50, 1e5), "",
         "travel of a step of a pause, in which discs and base come to rest; default: 200",
         "Raising it makes steps cost more and end nearer to rest; unsettled_steps tells whether "
         "they do.",
         between(100, 500)},
        {"rate_m_per_a", at<&P::rate>, "m/a", between(1e-9, 1), "",
         "geological rate, without sign; default: extension.rate_m_per_a",
         "Lowering it gives water, deposition, closing pores and healing more time per metre: "
         "intervals keep their years in all stages."},
        {"speed_m_per_s", at<&P::speed>, "m/s", between(1e-6, 1e3), "",
         "speed in the model; default: extension.speed_m_per_s",
         "Raising it shortens the stage in proportion, and forces balance worse.", between(0.5, 2)},
        {"base", base_kinds<&P::base>(), "", ranges::any, "",
         "part of the base that moves with the wall in this stage; default: detachment.base",
         "With \"rests\" the wall alone pushes, and friction decides how much of it the "
         "detachment takes."},
        {"detachment_friction", at<&P::detachment_friction>, "", ranges::friction, "",
         "friction of the detachment in this stage; default: detachment.friction",
         "Lowering it lets more of the shortening go down the detachment where the base rests."},
        {"sediment_friction", at<&P::sediment_friction>, "", ranges::friction, "",
         "friction of sediment discs from this stage on; default: no change",
         "Raising it keeps young strata from running over the footwall."},
        {"sedimentation", one_of<&P::surface_work>({"both", "fill", "erode", "none"}), "",
         ranges::any, "",
         "work at the surface in this stage: it is filled up to its line, eroded down to it, both "
         "or "
         "none",
         "With \"none\" what rises is kept, which shows harpoons and null points."},
        {"water_level_m", at<&P::water_level>, "m", ranges::height, "",
         "height of the water above the original surface that is reached at the end of the stage, "
         "evenly; default: it stays",
         "Lowering it dries the ground above it, which then weighs in full."},
    };
    return parameters;
}

SteppedPause stepped(const StageParameters& pause, Travel start) {
    constexpr double round_off = 1e-9;
    const double steps = std::max(1.0, std::ceil(*pause.pause / *pause.step - round_off));
    return {start, Travel(pause.settle.value_or(usual_settling)), std::llround(steps),
            *pause.pause / steps};
}

Calendar make_calendar(const Scene& scene) {
    std::vector<SteppedPause> pauses;
    const std::vector<MotionStage> stages = make_motion(scene).stages;
    for (std::size_t k = 0; k < stages.size(); ++k)
        if (const StageParameters& one = (*scene.find<Stages>())[k]; one.pause && one.step)
            pauses.push_back(stepped(one, stages[k].start));
    return {scene.extension.rate, std::move(pauses)};
}

double end_age(const Scene& scene) {
    return make_calendar(scene).age(Travel(scene.extension.distance));
}

void complete_stages(Scene& scene, const IsGiven& is_given, const Refuse& refuse) {
    Stages& stages = *scene.find<Stages>();
    if (scene.detachment)
        for (StageParameters& one : stages)
            one.base = one.base.value_or(scene.detachment->base);
    check_each(stages, refuse);
    const double travel = make_motion(scene).stages.back().end.m;
    // A run's own record has it.
    if (is_given("extension.distance_m") &&
        std::abs(scene.extension.distance - travel) > 1e-9 * travel)
        refuse("extension.distance_m",
               fmt::format("is {} beside [[stage]], whose ways it follows from ({}); leave it out",
                           text(scene.extension.distance), text(travel)));
    scene.extension.distance = travel;
    check_ways(scene, stages, refuse);
}

} // namespace listric
