#include "dem/events/compaction.hpp"

#include "apps/model/effect_list.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/toml/pieces.hpp"

namespace listric::effects::compaction {

Works works() { return {&works::baldwin_butler}; }

const Effect& effect() {
    using P = dem::CompactionParameters;
    static const Effect effect{
        .name = "compaction",
        .doc = "sediment loses pore space with burial",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters =
            {
                by_travel(
                    {"interval_a", at<&P::interval>, "a", ranges::interval, "Delta t_d",
                     "time between updates of the depth of burial; discs shrink in every cycle",
                     "Raising it lets porosity lag behind burial."}),
                porosity_decay_parameter<&P::coefficient>(),
            },
        .rock = rock_of_sediment([](Scene& scene, const RockMaterial& rock) {
            if (rock.pores)
                scene.find<P>()->coefficient = rock.pores->coefficient;
        }),
        .needs = {"sedimentation"},
        .settling = "compaction",
        .contribute =
            [](const Scene& scene, ModelParts& parts) {
                parts.sediment->porosity_decay = scene.find<P>()->coefficient;
                parts.sediment->porosity_interval = scene.find<P>()->interval;
            },
        .add_events =
            [](const Scene& scene, const ModelParts& parts, dem::Events& events) {
                dem::add(events, std::make_unique<dem::Compaction>(
                                     *scene.find<P>(), parts.sediment->surface_porosity,
                                     make_calendar(scene), parts.sediment->beds));
            },
        .absence = {"compaction of sediment", "-18 % at Te 10 km"},
        .price =
            [](const Scene& scene, const Workload& work) {
                return work.applications(scene.find<P>()->interval) * 4.0 * work.discs;
            },
        // With burial sediment shrinks: lis1 takes 1.85 times the discs of a packing of the area
        // that it fills; 1.1 times have been counted.
        .new_area =
            [](const Scene& scene) {
                return 0.75 * greatest_extension(scene) * scene.hanging_wall.thickness;
            },
    };
    return effect;
}

} // namespace listric::effects::compaction
