#include "coupling/lower_crust_thinning.hpp"

#include "apps/model/effect_list.hpp"
#include "apps/model/effects/elastic_base_parameters.hpp"

#include <fmt/format.h>

namespace listric::effects {

namespace {

using P = coupling::LowerCrustThinningParameters;

coupling::FootwallLoad load_footwall(const Scene& scene, const ModelParts& parts) {
    const auto& base = *listric::elastic_base(scene);
    const double contrast =
        (base.mantle_density - base.crust_density) * parts.physics.gravity; // Pa/m
    return coupling::lower_crust_thinning_load(*scene.find<P>(), contrast, scene.extension.distance,
                                               scene.extension.rate);
}

std::string explain(const Scene& scene, EffectList) {
    const P& p = *scene.find<P>();
    const auto& base = *listric::elastic_base(scene);
    const double thinner = coupling::lower_crust_thinning(p, scene.extension.distance);
    return fmt::format(
        "    lower crust: {:g} km over {:g} km thins by {:.0f} m in the end; the mantle in its "
        "place\n    lowers a wide area by {:.0f} m\n",
        p.thickness / 1e3, p.width / 1e3, thinner,
        thinner * (base.mantle_density - base.crust_density) / base.mantle_density);
}

} // namespace

Works lower_crust_thinning_works() { return {&works::kusznir}; }

const Effect& lower_crust_thinning() {
    static const Effect effect{
        .name = "lower_crust_thinning",
        .doc = "the lower crust stretches, mantle rises: isostasy lowers the base",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters =
            {
                {"thickness_m",
                 at<&P::thickness>,
                 "m",
                 {.from = 1, .to = 1e5},
                 "",
                 "of the lower crust before extension"},
                {"width_m",
                 at<&P::width>,
                 "m",
                 {.from = 1e3, .to = 1e7},
                 "",
                 "over which it stretches by as much as the hanging wall is pulled out"},
                {"centre_m",
                 at<&P::centre>,
                 "m",
                 {.from = -1e7, .to = 1e7},
                 "",
                 "x of its middle before extension"},
            },
        .needs = {"elastic_base"},
        .load_footwall = load_footwall,
        .explain = explain,
        .absence = "thinning of the lower crust",
        .measures =
            {{coupling::lower_crust_thinning_name, "m",
              "h e / (b + e) of the lower crust's thickness h and width b, and extension e"}},
    };
    return effect;
}

} // namespace listric::effects
