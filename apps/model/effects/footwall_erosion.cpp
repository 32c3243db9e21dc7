#include "coupling/footwall_erosion.hpp"

#include "apps/model/bending_base.hpp"
#include "apps/model/effect_list.hpp"
#include "apps/scene/picks/target_csv.hpp"
#include "dem/columns.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric::effects::footwall_erosion {

namespace {

using P = coupling::FootwallErosionParameters;

std::vector<Parameter> parameters() {
    return {
        by_travel({"interval_a", at<&P::interval>, "a", ranges::interval, "",
                   "time between adaptations of the surface",
                   "Raising it lets the load lag behind uplift and erosion."}),
        {"level_m", at<&P::level>, "m", ranges::height, "",
         "height of the target above the original surface, where no target line is given",
         "Lowering it erodes more of the flank, which then rises further."},
        {"target", at<&P::target>, "", ranges::height, "",
         "target line: points [x, y] in m, or stages {time_a, points}",
         "Sets where the footwall is eroded and where it is filled, also over time."},
        {"width_m", at<&P::width>, "m", between(4e3, 1e7), "",
         "width of the footwall, left of the breakaway, that is eroded and filled",
         "Raising it beyond the flank changes little: the footwall hardly moves there."},
        {"sediment_density_kg_per_m3", at<&P::sediment_density>, "kg/m3", ranges::density, "",
         "density of sediment that fills the footwall where it sinks",
         "Raising it adds load where the footwall sinks."},
    };
}

void read_target(Scene& scene, const std::string& file, const Refuse& refuse) {
    P& p = *scene.find<P>();
    if (!p.target.empty())
        refuse("footwall_erosion.target_csv", "beside footwall_erosion.target; give one of them");
    p.target = read_target_csv(scene, file);
}

void check(const Scene& scene, const Refuse& refuse) {
    if (bending_base(scene)->infill_density > 0.0)
        refuse("footwall_erosion",
               "fills hollows itself; infill_density_kg_per_m3 of the base must be 0 beside it");
    if (const std::string why =
            objection_to_fill(scene.find<P>()->sediment_density, *bending_base(scene));
        !why.empty())
        refuse("footwall_erosion.sediment_density_kg_per_m3", why);
}

coupling::FootwallLoad load_footwall(const Scene& scene, const ModelParts& parts) {
    const auto& base = *bending_base(scene);
    P erosion = *scene.find<P>();
    erosion.rock_density = base.crust_density;
    return coupling::footwall_erosion_load(erosion, parts.gravity, base.left, make_calendar(scene));
}

std::string explain(const Scene& scene, EffectList) {
    const P& erosion = *scene.find<P>();
    return fmt::format("    footwall: over {:g} km to its target every {:g} a; {} kg/m3 go, "
                       "{} kg/m3 come\n",
                       erosion.width / 1e3, erosion.interval, bending_base(scene)->crust_density,
                       erosion.sediment_density);
}

/// From the footwall's surface, which sections draw level and as if nothing were eroded, up to the
/// target.
std::vector<double> cover_band(const Observation& now) {
    constexpr double shown = 4e3; // m beside the breakaway
    const dem::ConstBaseNodeColumns nodes = dem::base_node_columns(now.state);
    if (nodes.x.empty())
        return {};
    const P& p = *now.scene.find<P>();
    const dem::TargetLine target =
        dem::Target(p.level, p.target).at(make_calendar(now.scene).age(now.state.clock.travel));
    const double rock = nodes.y[0] + nodes.uy[0], end = nodes.x[0] + nodes.ux[0];
    std::vector<double> rows;
    for (const double x : {end - shown, end})
        rows.insert(rows.end(), {x, rock, std::max(rock, target.height(x))});
    return rows;
}

} // namespace

Works works() { return {}; }

const Effect& effect() {
    static const Effect effect{
        .name = "footwall_erosion",
        .doc = "the footwall's surface adapts to a target: what rises is eroded, what sinks filled",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters = parameters(),
        .files = {{"target_csv",
                   "file with the target line: columns time_a, x_m, y_m; linear between times",
                   "Stands in place of target.", read_target}},
        .check = check,
        .load_footwall = load_footwall,
        .explain = explain,
        .absence = {"erosion of the footwall", "+68 to +85 %"},
        .measures = {{coupling::footwall_eroded_name, "m2", "rock eroded from the footwall",
                      "area of rock eroded from the footwall left of the breakaway"},
                     {coupling::footwall_deposited_name, "m2", "sediment on the footwall",
                      "area of sediment on the footwall left of the breakaway"}},
        .layers = {{"flank", LayerKind::band, "sediment on the footwall", "#e5d6a8", cover_band}},
    };
    return effect;
}

} // namespace listric::effects::footwall_erosion
