#include "apps/model/effect_list.hpp"

#include "dem/genesis/genesis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace listric::effects::gravity {

namespace {

struct GravityParameters {
    double acceleration = dem::standard_gravity; ///< m/s^2
};

/// Mean overlap of rock discs where the hanging wall is thickest, over their radius.
double overlap_at_depth(const Scene& scene) {
    return scene.cycle.softness *
           dem::compression_at_depth(scene.basement,
                                     scene.hanging_wall.rock_density *
                                         scene.find<GravityParameters>()->acceleration *
                                         scene.hanging_wall.thickness);
}

constexpr double most_overlap = 0.02; ///< beyond it discs are deformed rather than pressed

std::string warn_of_soft_discs(const Scene& scene) {
    const double overlap = overlap_at_depth(scene);
    return scene.cycle.softness > 1.0 && overlap > most_overlap
               ? fmt::format("cycle.softness = {:g}: discs overlap by {:.1f} % of their radius at "
                             "{:g} km depth; {:g} keeps that below {:g} %",
                             scene.cycle.softness, 100.0 * overlap,
                             scene.hanging_wall.thickness / 1e3,
                             std::max(1.0, std::floor(10.0 * scene.cycle.softness * most_overlap /
                                                      overlap) /
                                               10.0),
                             100.0 * most_overlap)
               : "";
}

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
        .warning = warn_of_soft_discs,
        .contribute =
            [](const Scene& scene, ModelParts& parts) {
                parts.gravity = parts.physics.gravity = scene.find<P>()->acceleration;
            },
        .explain =
            [](const Scene& scene, EffectList) {
                return fmt::format("weight\n  discs overlap by {:.2g} % of their radius at {:g} km "
                                   "depth\n",
                                   100.0 * overlap_at_depth(scene),
                                   scene.hanging_wall.thickness / 1e3);
            },
    };
    return effect;
}

} // namespace listric::effects::gravity
