#include "dem/base/motion.hpp"

#include "apps/model/base_driver.hpp"
#include "apps/model/effect_list.hpp"
#include "apps/scene/picks/target_csv.hpp"
#include "apps/support/files/csv.hpp"
#include "apps/support/words/text.hpp"

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

void check(const Scene& scene, const Refuse& refuse) {
    // Discs follow a base that moves as fast as the right wall; much faster is an impact.
    constexpr double fastest = 5.0;
    const P& motion = *scene.find<P>();
    if (motion.uplift.empty() && motion.shift.empty())
        refuse("base_motion", "needs csv, or uplift or shift");
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
    if (changes(motion.uplift, end) || changes(motion.shift, end))
        return "";
    return fmt::format("base_motion moves nothing up to the end of the run at {:g} a: what counts "
                       "is the change since time 0; give two stages {{time_a, points}} or more "
                       "that differ before the end",
                       end);
}

class BaseMotionDriver final : public BaseDriver {
public:
    BaseMotionDriver(const Scene& scene, const ModelParts& parts)
        : motion_(*scene.find<P>(), parts.base.motion, make_calendar(scene)) {}

    dem::BaseResponse& response() override { return motion_; }

    void settle(dem::State& state, const dem::RigidBase& base, const dem::CyclePhysics&,
                const dem::Execution&, const Progress&) const override {
        constexpr double face = 1000.0; // m: arcs are followed to millimetres
        std::vector<double> x, y;
        for (const dem::Point& node : dem::detachment_nodes(base.surfaces.front().chain, face)) {
            x.push_back(node.x);
            y.push_back(node.y);
        }
        dem::add_base_nodes(state, x, y);
    }

private:
    dem::BaseMotion motion_;
};

} // namespace

Works works() { return {}; }

const Effect& effect() {
    static const Effect effect{
        .name = "base_motion",
        .doc = "the detachment moves as prescribed; needs no finite elements",
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
            },
        .files = {{"csv",
                   "file with the motion: columns time_a, x_m and uplift_m, or dx_m and dy_m",
                   "Stands in place of uplift and shift.", read_motion}},
        .needs = {"detachment"},
        .check = check,
        .warning = warning,
        .contribute =
            [](const Scene&, ModelParts& parts) {
                dem::follow_nodes(parts.base, 2);
                parts.base_moves = true;
            },
        .drive_base = [](const Scene& scene, const ModelParts& parts,
                         std::vector<std::unique_ptr<dem::Event>>&) -> std::unique_ptr<BaseDriver> {
            return std::make_unique<BaseMotionDriver>(scene, parts);
        },
        .explain =
            [](const Scene& scene, EffectList) {
                return fmt::format(
                    "the detachment moves as prescribed, at up to {:.2g} of the "
                    "speed of extension\n",
                    dem::greatest_base_speed(*scene.find<P>(), make_calendar(scene)));
            },
    };
    return effect;
}

} // namespace listric::effects::base_motion
