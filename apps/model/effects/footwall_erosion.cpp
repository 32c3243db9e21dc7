#include "coupling/footwall_erosion.hpp"

#include "apps/model/effect_list.hpp"
#include "apps/model/effects/elastic_base_parameters.hpp"
#include "apps/scene/target_csv.hpp"

#include <fmt/format.h>

namespace listric::effects {

namespace {

using P = coupling::FootwallErosionParameters;

std::vector<Parameter> parameters() {
    return {
        {"interval_a", at<&P::interval>, "a", ranges::years, "",
         "time between adaptations of the surface"},
        {"level_m", at<&P::level>, "m", ranges::height, "",
         "of the target, above the original surface, where no target line is given"},
        {"target", at<&P::target>, "", ranges::height, "",
         "target line: points [x, y] in m, or stages {time_a, points}"},
        {"width_m",
         at<&P::width>,
         "m",
         {.from = 4e3, .to = 1e7},
         "",
         "of the footwall, left of the breakaway, that is worked on"},
        {"sediment_density_kg_per_m3", at<&P::sediment_density>, "kg/m3", ranges::density, "",
         "of what is laid down where the footwall sinks"},
    };
}

void read_target(Scene& scene, const std::string& file, const Refuse& refuse) {
    P& p = *scene.find<P>();
    if (!p.target.empty())
        refuse("footwall_erosion.target_csv", "beside footwall_erosion.target; give one of them");
    p.target = read_target_csv(scene, file);
}

void check(const Scene& scene, const Refuse& refuse) {
    if (listric::elastic_base(scene)->infill_density > 0.0)
        refuse("footwall_erosion",
               "fills hollows itself; elastic_base.infill_density_kg_per_m3 must be 0 beside it");
}

coupling::FootwallLoad load_footwall(const Scene& scene, const ModelParts& parts) {
    const auto& base = *listric::elastic_base(scene);
    P erosion = *scene.find<P>();
    erosion.rock_density = base.crust_density;
    return coupling::footwall_erosion_load(erosion, parts.physics.gravity, base.left,
                                           scene.extension.rate);
}

std::string explain(const Scene& scene, EffectList) {
    const P& erosion = *scene.find<P>();
    return fmt::format("    footwall: over {:g} km to its target every {:g} a; {} kg/m3 go, "
                       "{} kg/m3 come\n",
                       erosion.width / 1e3, erosion.interval,
                       listric::elastic_base(scene)->crust_density, erosion.sediment_density);
}

} // namespace

Works footwall_erosion_works() { return {}; }

const Effect& footwall_erosion() {
    static const Effect effect{
        .name = "footwall_erosion",
        .doc = "the footwall's surface adapts to a target: what rises is eroded, what sinks filled",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters = parameters(),
        .files = {{"target_csv",
                   "file with the target line: columns time_a, x_m, y_m; linear between times",
                   read_target}},
        .needs = {"elastic_base"},
        .check = check,
        .load_footwall = load_footwall,
        .explain = explain,
        .absence = "erosion of the footwall",
        .measures = {{coupling::footwall_eroded_name, "m2",
                      "rock that is gone from the footwall left of the breakaway"},
                     {coupling::footwall_deposited_name, "m2", "sediment that lies there"}},
    };
    return effect;
}

} // namespace listric::effects
