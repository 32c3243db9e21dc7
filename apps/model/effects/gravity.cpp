#include "apps/model/effect_list.hpp"

namespace listric::effects::gravity {

namespace {

struct GravityParameters {
    double acceleration = dem::standard_gravity; ///< m/s^2
};

} // namespace

Works works() { return {}; }

const Effect& effect() {
    using P = GravityParameters;
    static const Effect effect{
        .name = "gravity",
        .doc = "weight of the discs",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters = {{"acceleration_m_per_s2", at<&P::acceleration>, "m/s2", between(1e-6, 100),
                        "g", "gravitational acceleration",
                        "Raising it raises all stresses in proportion, and with them the strength "
                        "that friction gives."}},
        .in_genesis = true,
        .contribute =
            [](const Scene& scene, ModelParts& parts) {
                parts.gravity = parts.physics.gravity = scene.find<P>()->acceleration;
            },
    };
    return effect;
}

} // namespace listric::effects::gravity
