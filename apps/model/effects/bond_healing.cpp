#include "dem/events/bond_healing.hpp"

#include "apps/model/effect_list.hpp"

namespace listric::effects::bond_healing {

Works works() { return {}; }

const Effect& effect() {
    using P = dem::BondHealingParameters;
    static const Effect effect{
        .name = "bond_healing",
        .doc = "intelligent crack management (ICM)",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters =
            {
                by_travel({"interval_a", at<&P::interval>, "a", ranges::interval, "Delta t_h",
                           "time between healings",
                           "Raising it lets cracks stay open for longer, and allows more slip to "
                           "those that "
                           "heal."}),
                by_travel(
                    {"strain_rate_per_s", at<&P::strain_rate>, "1/s", ranges::strain_rate, "eps_ch",
                     "largest shear strain rate that heals",
                     "Raising it heals cracks that still slip: less of the rock stays broken."}),
                {"measure", one_of<&P::measure>({"slip", "slip_and_opening"}), "", ranges::any,
                 "d_h", "relative displacement of two discs that forbids healing",
                 "With \"slip_and_opening\" sediment hardly cements, since burial moves its "
                 "discs."},
            },
        .needs = {"bonds"},
        .add_events =
            [](const Scene& scene, const ModelParts& parts, dem::Events& events) {
                dem::add(events, std::make_unique<dem::BondHealing>(*scene.find<P>(), *parts.bonds,
                                                                    make_calendar(scene)));
            },
        .price =
            [](const Scene& scene, const Workload& work) {
                return work.applications(scene.find<P>()->interval) * 15.0 * work.discs;
            },
    };
    return effect;
}

} // namespace listric::effects::bond_healing
