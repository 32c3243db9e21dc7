#include "coupling/basin_water.hpp"

#include "apps/model/bending_base.hpp"
#include "apps/model/effect_list.hpp"
#include "apps/model/model.hpp"
#include "apps/support/words/spelling.hpp"

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
    P water = *scene.find<P>();
    water.flank_alone = parts.water.has_value(); // whose pressure the base bears
    water.film = parts.film;
    return coupling::basin_water_load(
        water, parts.gravity, coupling::water_column_width(scene.hanging_wall.mean_radius),
        make_calendar(scene), pores,
        base.infill_density > 0.0 ? std::nullopt : std::optional(base.left));
}

void check(const Scene& scene, const Refuse& refuse) {
    const P& water = *scene.find<P>();
    if (const auto pores = make_parts(scene).water) {
        const double level = pores->level.heights.at(0.0).height(0.0);
        if (pores->moves)
            refuse(
                "basin_water",
                "counts the flank's water up to one level, and a [[stage]] has a water_level_m of "
                "its own; leave out one of the two");
        if (water.level != level)
            refuse("basin_water.level_m",
                   fmt::format("is {}, but the water in the pores stands at {}; it is one water: "
                               "give both the same",
                               text(water.level), text(level)));
        if (water.density != pores->density)
            refuse(
                "basin_water.density_kg_per_m3",
                fmt::format("is {}, but the water in the pores has {}; it is one water: give both "
                            "the same",
                            text(water.density), text(pores->density)));
    }
    if (const std::string why = objection_to_fill(scene.find<P>()->density, *bending_base(scene));
        !why.empty())
        refuse("basin_water.density_kg_per_m3", why);
}

bool pores_have_water(const ModelParts& parts) { return parts.water.has_value(); }

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
                return fmt::format("    {}: water of {} kg/m3 up to {:g} m\n",
                                   make_parts(scene).water ? "flank" : "basin", water.density,
                                   water.level);
            },
        .absence = {"water in the basin and in the pores of its sediment", "-30 to -39 %",
                    pores_have_water},
        .lacks = {{"sideways thrust of the water on scarp and head block",
                   "not measured; 0.4e12 N/m on a bare scarp of 9 km", pores_have_water},
                  {"water in gaps that open between discs", "0 to -4 % of the net load",
                   pores_have_water}},
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
