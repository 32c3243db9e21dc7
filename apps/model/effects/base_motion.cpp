#include "dem/base/motion.hpp"

#include "apps/model/base_driver.hpp"
#include "apps/model/effect_list.hpp"
#include "apps/model/effects/base_motion/ground.hpp"
#include "apps/model/effects/base_motion/measures.hpp"
#include "apps/scene/parameters/flat_base.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/picks/target_csv.hpp"
#include "apps/support/files/csv.hpp"
#include "apps/support/words/text.hpp"
#include "dem/numbers/elementary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace listric::effects::base_motion {

namespace {

using P = dem::BaseMotionParameters;

void read_motion(Scene& scene, const std::string& file, const Refuse& refuse) {
    P& motion = *scene.find<P>();
    if (!motion.uplift.empty() || !motion.shift.empty())
        refuse("base_motion.csv", "beside base_motion.uplift or shift; give one of them");
    const bool two = csv_has_column(file, "dx_m") || csv_has_column(file, "dy_m");
    if (two && csv_has_column(file, "uplift_m"))
        refuse("base_motion.csv", fmt::format("{}: has uplift_m beside dx_m or dy_m; give dx_m and "
                                              "dy_m, or uplift_m alone",
                                              shown(file)));
    if (two)
        motion.shift = read_target_csv(scene, file, "dx_m");
    motion.uplift = read_target_csv(scene, file, two ? "dy_m" : "uplift_m");
}

/// Where nothing stretches, the slip is what the run counts.
void complete(Scene& scene, const IsGiven& is_given, const Refuse& refuse) {
    const P& motion = *scene.find<P>();
    if (!motion.fault_x || scene.detachment || scene.stretching)
        return;
    const bool staged = scene.find<Stages>() != nullptr;
    if (staged && motion.fault_slip)
        refuse("base_motion.fault_slip_m",
               fmt::format("is {} beside [[stage]], whose distance_m are the slips, below 0 back; "
                           "leave it out",
                           text(*motion.fault_slip)));
    if (staged)
        return;
    if (!motion.fault_slip)
        refuse("base_motion.fault_slip_m", "is missing; needs the slip at the end of the run, such "
                                           "as 500.0, or [[stage]] with distance_m");
    if (is_given("extension.distance_m") && scene.extension.distance != *motion.fault_slip)
        refuse("extension.distance_m",
               fmt::format("is {} beside base_motion.fault_slip_m = {}, which is the run's way "
                           "where no base stretches; leave it out",
                           text(scene.extension.distance), text(*motion.fault_slip)));
    scene.extension.distance = *motion.fault_slip;
}

/// That what is given beside a fault, or asks for one, can be.
void check_company_of_fault(const Scene& scene, const P& motion, const Refuse& refuse) {
    if (motion.friction && (scene.detachment || scene.stretching))
        refuse("base_motion.friction",
               fmt::format("is {0} beside [{1}], which has a friction; leave it out and give "
                           "{1}.friction",
                           text(*motion.friction), scene.detachment ? "detachment" : "stretching"));
    if (!motion.fault_x && motion.fault_slip)
        refuse("base_motion.fault_slip_m",
               fmt::format("is {}, but no fault slips; add fault_x_m, where it meets the base of "
                           "the cover",
                           text(*motion.fault_slip)));
    if (!motion.fault_x)
        return;
    const std::string given = text(*motion.fault_x);
    if (scene.detachment)
        refuse("base_motion.fault_x_m",
               fmt::format("is {} beside [detachment]; a fault of the basement cuts a flat base: "
                           "leave out [detachment], or give uplift or shift in place of the fault",
                           given));
    if (!motion.uplift.empty() || !motion.shift.empty())
        refuse("base_motion.fault_x_m",
               fmt::format("is {} beside uplift, shift or csv; give one of them", given));
    if (scene.stretching && !motion.fault_slip)
        refuse("base_motion.fault_slip_m", "is missing; beside [stretching] the fault needs its "
                                           "slip at the end of the run, such as 500.0");
    if (scene.stretching && scene.find<Stages>())
        refuse("base_motion.fault_x_m",
               fmt::format("is {} beside [stretching] and [[stage]]; leave out [stretching], then "
                           "the stages are of the fault, or leave out [[stage]]",
                           given));
}

/// @param fastest  speed, over that of extension
void check_fault(const Scene& scene, const P& motion, double fastest, const Refuse& refuse) {
    const double length = scene.hanging_wall.length, x = *motion.fault_x;
    if (!(x > 0.0 && x < length))
        refuse("base_motion.fault_x_m",
               fmt::format("is {}, allowed: above 0 and below hanging_wall.length_m = {}", text(x),
                           text(length)));
    const dem::BasementFault fault = *basement_fault(scene);
    if (!(std::abs(fault.slip) <= fastest))
        refuse("base_motion.fault_slip_m",
               fmt::format("is {} while the wall moves by extension.distance_m = {}, allowed: at "
                           "most {} times as much; raise that distance",
                           text(*motion.fault_slip), text(scene.extension.distance), fastest));
    const double heave = fault.slip * dem::cosine(fault.dip * dem::pi / 180.0);
    const double reaches =
        x + std::min(heave * greatest_extension(scene), heave * least_extension(scene));
    if (const double least = 2.0 * scene.hanging_wall.mean_radius; reaches < least)
        refuse("base_motion.fault_x_m",
               fmt::format("is {}: the block on the right comes to x = {}, allowed: at least {}, a "
                           "mean diameter from the left wall; raise fault_x_m, or slip less",
                           text(x), text(reaches), text(least)));
}

void check(const Scene& scene, const Refuse& refuse) {
    // Discs follow a base that moves as fast as the right wall; much faster is an impact.
    constexpr double fastest = 5.0;
    const P& motion = *scene.find<P>();
    check_company_of_fault(scene, motion, refuse);
    if (motion.fault_x) {
        check_fault(scene, motion, fastest, refuse);
        return;
    }
    if (motion.uplift.empty() && motion.shift.empty())
        refuse("base_motion", "needs csv, or uplift or shift, or fault_x_m");
    const double speed = dem::greatest_base_speed(motion, make_calendar(scene));
    if (speed > fastest)
        refuse("base_motion",
               fmt::format("moves {:.3g} times as fast as extension, allowed: at most {}; spread "
                           "it over more time, or raise extension.rate_m_per_a",
                           speed, fastest));
}

/// Whether a displacement changes from time 0 to the end of a run, a.
bool changes(const std::vector<dem::TargetStage>& stages, double end) {
    constexpr double least = 1e-6; // m
    if (stages.empty())
        return false;
    const dem::Target target(0.0, stages);
    const dem::TargetLine before = target.at(0.0);
    return std::ranges::any_of(stages, [&](const dem::TargetStage& stage) {
        const dem::TargetLine now = target.at(std::min(stage.time, end));
        const auto differs = [&](dem::Point p) {
            return std::abs(now.height(p.x) - before.height(p.x)) > least;
        };
        return std::ranges::any_of(now.points(), differs) ||
               std::ranges::any_of(before.points(), differs);
    });
}

std::string warning(const Scene& scene) {
    const P& motion = *scene.find<P>();
    const double end = end_age(scene);
    if (motion.fault_x || changes(motion.uplift, end) || changes(motion.shift, end))
        return "";
    return fmt::format("base_motion moves nothing up to the end of the run at {:g} a: what counts "
                       "is the change since time 0; give two stages {{time_a, points}} or more "
                       "that differ before the end",
                       end);
}

class BaseMotionDriver final : public BaseDriver {
public:
    BaseMotionDriver(const Scene& scene, const ModelParts& parts)
        : motion_(*scene.find<P>(), parts.base.motion, make_calendar(scene)),
          face_(scene.detachment ? 1000.0 : 4.0 * scene.hanging_wall.mean_radius) {}

    dem::BaseResponse& response() override { return motion_; }

    void settle(dem::State& state, const dem::RigidBase& base, const dem::CyclePhysics&,
                const dem::Execution&, const Progress&) const override {
        std::vector<double> x, y;
        for (const dem::Point& node : dem::detachment_nodes(base.surfaces.front().chain, face_)) {
            x.push_back(node.x);
            y.push_back(node.y);
        }
        dem::add_base_nodes(state, x, y);
    }

private:
    dem::BaseMotion motion_;
    double face_; ///< m: arcs are followed to millimetres
};

std::string explain(const Scene& scene, EffectList) {
    if (const auto fault = basement_fault(scene))
        return fmt::format("the basement fault slips by {:.3g} m per metre of the run's way\n",
                           std::abs(fault->slip));
    return fmt::format("the {} moves as prescribed, at up to {:.2g} of the speed of extension\n",
                       scene.detachment ? "detachment" : "base",
                       dem::greatest_base_speed(*scene.find<P>(), make_calendar(scene)));
}

} // namespace

Works works() { return {}; }

const Effect& effect() {
    static const Effect effect{
        .name = "base_motion",
        .doc = "the base moves as prescribed, or a fault of the basement slips below the cover; "
               "needs no finite elements",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters =
            {
                {"uplift", at<&P::uplift>, "", ranges::height, "",
                 "upward displacement of the detachment: stages {time_a, points} with points [x, "
                 "uplift] in m; the change since time 0 counts, so that one stage moves nothing",
                 "Lifts and bends the detachment under the discs, as an elastic base would."},
                {"shift", at<&P::shift>, "", ranges::height, "",
                 "displacement of the detachment to the right, given as uplift is",
                 "Moves the detachment sideways under the discs."},
                {"fault_x_m", at<&P::fault_x>, "m", between(-1e7, 1e7), "",
                 "place where a fault of the basement, which dips to the right, meets the base of "
                 "the cover; without [detachment]. The block on its right slips, and takes the "
                 "right wall along",
                 "Moves the fault along the section; leave it several thicknesses from walls."},
                {"fault_dip_deg", at<&P::fault_dip>, "deg", between(5, 90), "",
                 "dip of that fault; 90: a step",
                 "Lowering it widens the fold in the cover, and moves more of the slip sideways.",
                 between(30, 90)},
                {"fault_sense", one_of<&P::fault_sense>({"normal", "reverse"}), "", ranges::any, "",
                 "whether the block on the right moves down or up",
                 "\"reverse\" shortens the cover: it takes more slip to break through."},
                {"fault_slip_m", at<&P::fault_slip>, "m", between(1e-6, 1e6), "",
                 "slip at the end of the run. Beside [stretching] it grows in proportion to the "
                 "wall's way; else it is the run's way itself, in place of extension.distance_m, "
                 "and with [[stage]] distance_m is",
                 "Raising it makes the run longer in proportion."},
                {"friction", at<&P::friction>, "", ranges::friction, "",
                 "friction between discs and a base that is neither [detachment] nor "
                 "[stretching]; default: 0.3",
                 "Raising it ties the cover to the blocks below it."},
            },
        .files = {{"csv",
                   "file with the motion: columns time_a, x_m and uplift_m, or dx_m and dy_m",
                   "Stands in place of uplift and shift.", read_motion}},
        .brings_base = true,
        .complete = complete,
        .check = check,
        .warning = warning,
        .contribute =
            [](const Scene& scene, ModelParts& parts) {
                if (scene.find<P>()->fault_x)
                    return; // blocks are rigid
                dem::follow_nodes(parts.base, 2);
                parts.base_moves = true;
            },
        .add_events =
            [](const Scene& scene, const ModelParts&, dem::Events& events) {
                if (const auto fault = basement_fault(scene))
                    dem::add(events, std::make_unique<GroundRecord>(fault->slip,
                                                                    scene.hanging_wall.mean_radius,
                                                                    scene.extension.rate));
            },
        .drive_base = [](const Scene& scene, const ModelParts& parts,
                         std::span<const std::unique_ptr<dem::Event>>,
                         std::vector<std::unique_ptr<dem::Event>>&) -> std::unique_ptr<BaseDriver> {
            if (scene.find<P>()->fault_x)
                return nullptr;
            return std::make_unique<BaseMotionDriver>(scene, parts);
        },
        .explain = explain,
        .measures = measures_of_fault(),
    };
    return effect;
}

} // namespace listric::effects::base_motion
