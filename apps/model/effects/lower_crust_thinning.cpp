#include "coupling/lower_crust_thinning.hpp"

#include "apps/model/bending_base.hpp"
#include "apps/model/effect_list.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

#include <utility>

namespace listric::effects::lower_crust_thinning {

namespace {

using P = coupling::LowerCrustThinningParameters;

P stretched(const Scene& scene, const ModelParts& parts) {
    P p = *scene.find<P>();
    p.share = parts.stretch_share;
    return p;
}

coupling::FootwallLoad load_footwall(const Scene& scene, const ModelParts& parts) {
    const auto& base = *bending_base(scene);
    const double contrast = (base.mantle_density - base.crust_density) * parts.gravity; // Pa/m
    return coupling::lower_crust_thinning_load(stretched(scene, parts), contrast,
                                               greatest_extension(scene), least_extension(scene),
                                               scene.extension.rate);
}

/// Its ends at the greatest extension, x in m.
std::pair<double, double> reach(const Scene& scene) {
    const P p = stretched(scene, make_parts(scene));
    const double left = p.centre - 0.5 * p.width;
    return {left, left + p.width + p.share * greatest_extension(scene)};
}

void check(const Scene& scene, const Refuse& refuse) {
    const P p = stretched(scene, make_parts(scene));
    if (const double shortening = -p.share * least_extension(scene); shortening >= p.width)
        refuse("lower_crust_thinning.width_m",
               fmt::format("is {}, but [[stage]] shortens it by {}; widen it", text(p.width),
                           text(shortening)));
    const auto& base = *bending_base(scene);
    const auto [left, right] = reach(scene);
    if (right <= base.left || left >= base.right)
        refuse("lower_crust_thinning.centre_m",
               fmt::format("is {}: the crust reaches from x = {} to {}, outside of the footwall, "
                           "which goes from its left_m = {} to right_m = {}; move it in",
                           text(p.centre), text(left), text(right), text(base.left),
                           text(base.right)));
}

std::string warning(const Scene& scene) {
    const auto& base = *bending_base(scene);
    const auto [left, right] = reach(scene);
    return left < base.left || right > base.right
               ? fmt::format(
                     "lower_crust_thinning: the crust reaches from x = {} to {}, beyond the "
                     "footwall from its left_m = {} to right_m = {}: what lies "
                     "outside loads nothing",
                     text(left), text(right), text(base.left), text(base.right))
               : std::string();
}

std::string explain(const Scene& scene, EffectList) {
    const P p = stretched(scene, make_parts(scene));
    const auto& base = *bending_base(scene);
    const double thinner = coupling::lower_crust_thinning(p, greatest_extension(scene));
    const double contrast = base.mantle_density - base.crust_density; // at most the springs'
    const double springs = base.floats_on() - base.infill_density;
    return fmt::format(
        "    lower crust: {:g} km over {:g} km thins by {:.0f} m at most; the mantle in its "
        "place\n    lowers a wide area by {:.0f} m\n",
        p.thickness / 1e3, p.width / 1e3, thinner,
        contrast > 0.0 ? thinner * contrast / springs : 0.0);
}

} // namespace

Works works() { return {&works::kusznir}; }

const Effect& effect() {
    static const Effect effect{
        .name = "lower_crust_thinning",
        .doc = "the lower crust stretches, mantle rises: isostasy lowers the base",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters =
            {
                {"thickness_m", at<&P::thickness>, "m", between(1, 1e5), "",
                 "thickness of the lower crust before extension",
                 "Raising it sinks the base more: thinning is proportional to it."},
                {"width_m", at<&P::width>, "m", between(1e3, 1e7), "",
                 "width over which it stretches by as much as the hanging wall is pulled out",
                 "Raising it spreads the thinning, which is less everywhere."},
                {"centre_m", at<&P::centre>, "m", between(-1e7, 1e7), "",
                 "x of its middle before extension",
                 "Moves the place that sinks most: nearer to the breakaway the flank rises less."},
            },
        .check = check,
        .warning = warning,
        .contribute =
            [](const Scene& scene, ModelParts& parts) {
                const P& p = *scene.find<P>();
                parts.stretched_crust = {p.centre - 0.5 * p.width, p.width};
            },
        .load_footwall = load_footwall,
        .explain = explain,
        .absence = {"thinning of the lower crust",
                    "-37 % at Te 5 km, -47 % at 10 km, -102 % at 20 km (20 km of crust)"},
        .measures =
            {{coupling::lower_crust_thinning_name, "m", "thinning of the lower crust",
              "h e / (b + e) of the lower crust's thickness h and width b, and the extension e at "
              "the load's last step"}},
    };
    return effect;
}

} // namespace listric::effects::lower_crust_thinning
