#include "coupling/basin_water.hpp"

#include "apps/model/bending_base.hpp"
#include "apps/model/effect_list.hpp"

#include <fmt/format.h>

namespace listric::effects::basin_water {

namespace {

using P = coupling::BasinWaterParameters;

coupling::FootwallLoad load_footwall(const Scene& scene, const ModelParts& parts) {
    std::optional<coupling::PoreSpace> pores;
    if (parts.sediment)
        pores = {parts.sediment->grain_density, parts.sediment->surface_porosity};
    // Where the base's own springs fill what sinks, water has no room.
    const auto& base = *bending_base(scene);
    return coupling::basin_water_load(
        *scene.find<P>(), parts.gravity,
        coupling::water_column_width(scene.hanging_wall.mean_radius), make_calendar(scene), pores,
        base.infill_density > 0.0 ? std::nullopt : std::optional(base.left));
}

void check(const Scene& scene, const Refuse& refuse) {
    if (const std::string why = objection_to_fill(scene.find<P>()->density, *bending_base(scene));
        !why.empty())
        refuse("basin_water.density_kg_per_m3", why);
}

/// Floor and level of the water from the shore at the breakaway on.
std::vector<double> water_band(const Observation& now) {
    const double width = coupling::water_column_width(now.scene.hanging_wall.mean_radius);
    const double level = now.scene.find<P>()->level;
    std::vector<double> rows{0.0, level, level};
    double x = 0.5 * width;
    for (const double water : coupling::water_depths(now.state, level, width)) {
        rows.insert(rows.end(), {x, level - water, level});
        x += width;
    }
    return rows;
}

} // namespace

Works works() { return {}; }

const Effect& effect() {
    static const Effect effect{
        .name = "basin_water",
        .doc = "water fills the basin and the pores of its sediment and weighs on the footwall",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters =
            {
                {"level_m", at<&P::level>, "m", ranges::height, "",
                 "height of its surface above the original surface",
                 "Lowering it takes load off the base: the flank rises more."},
                {"density_kg_per_m3", at<&P::density>, "kg/m3", ranges::density, "",
                 "density of the water",
                 "Raising it adds load in proportion: the basin sinks, and the flank rises less."},
                by_travel({"interval_a", at<&P::interval>, "a", ranges::interval, "",
                           "time between adaptations of its depth",
                           "Raising it lets the load lag behind the basin."}),
            },
        .check = check,
        .load_footwall = load_footwall,
        .explain =
            [](const Scene& scene, EffectList) {
                const P& water = *scene.find<P>();
                return fmt::format("    basin: water of {} kg/m3 up to {:g} m\n", water.density,
                                   water.level);
            },
        .absence = {"water in the basin and in the pores of its sediment", "-30 to -39 %"},
        .lacks = {{"sideways thrust of the water on scarp and head block",
                   "not measured; 0.4e12 N/m on a bare scarp of 9 km"}},
        .measures =
            {{coupling::basin_water_name, "N/m", "weight of the basin's water",
              "weight of the water on the detachment per metre of strike beyond that at the "
              "start, with that in the sediment's pores; negative where flooded ground has "
              "risen"},
             {coupling::pore_water_name, "N/m", "weight of the water in pores",
              "weight of the water in the sediment's pores"},
             {coupling::flank_water_name, "N/m", "weight of the water on the flank",
              "weight of the water where the footwall left of the breakaway has sunk below "
              "its level; negative where flooded ground has risen"}},
        .layers = {{"water", LayerKind::band, "water", "#c6dcef", water_band}},
    };
    return effect;
}

} // namespace listric::effects::basin_water
