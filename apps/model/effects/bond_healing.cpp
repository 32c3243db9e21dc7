#include "dem/events/bond_healing.hpp"

#include "apps/model/effect_list.hpp"

namespace listric::effects {

Works bond_healing_works() { return {}; }

const Effect& bond_healing() {
    using P = dem::BondHealingParameters;
    static const Effect effect{
        .name = "bond_healing",
        .doc = "intelligent crack management (ICM)",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters =
            {
                {"interval_a", at<&P::interval>, "a", ranges::years, "Delta t_h",
                 "time between healings"},
                {"strain_rate_per_s", at<&P::strain_rate>, "1/s", ranges::strain_rate, "eps_ch",
                 "largest shear strain rate that heals"},
                {"measure",
                 one_of<&P::measure>({"slip", "slip_and_opening"}),
                 "",
                 {},
                 "d_h",
                 "relative displacement of two discs that forbids healing"},
            },
        .needs = {"bonds"},
        .make_events =
            [](const Scene& scene, const ModelParts& parts, std::span<const StagedEvent>) {
                std::vector<StagedEvent> events;
                events.push_back({EventStage::heal,
                                  std::make_unique<dem::BondHealing>(*scene.find<P>(), *parts.bonds,
                                                                     scene.extension.rate)});
                return events;
            },
        .price =
            [](const Scene& scene, const Workload& work) {
                return work.years / scene.find<P>()->interval * 15.0 * work.discs;
            },
    };
    return effect;
}

} // namespace listric::effects
