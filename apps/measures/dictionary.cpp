#include "apps/measures/dictionary.hpp"

#include <cassert>

namespace listric::measures {

using dem::Point;

namespace {

using M = Measures;

constexpr Measure<M> of_structure[] = {
    {"basin_area_m2", "m2", "basin area",
     "area of the basin: between the pre-rift top at the start and now (a packing's top is some "
     "tens of metres from the original surface)",
     taken<&M::basin_area>},
    {"area_balance", "1", "basin area over extension × thickness",
     "basin area over extension × thickness: 1 less `rock_dilation_fraction`; ends where rock is "
     "eroded",
     taken<&M::area_balance>, OverTime::last, "0.95 to 1.03 from 5 km of extension on"},
    {"cutoff_x_m", "m", "cutoff, x",
     "x of the cutoff, where the pre-rift top meets the detachment: the shallowest pre-rift disc "
     "on it",
     taken<&M::cutoff, &Point::x>},
    {"cutoff_z_m", "m", "cutoff, depth", "depth of the cutoff", taken<&M::cutoff, &Point::y>},
    {"rollover_tilt_deg", "deg", "tilt of the head block",
     "rotation of the least-squares rigid motion of the discs that started within 5 km of the "
     "detachment, in the upper half of the piece that turns them (down to where it first dips "
     "least) and where that dips by a third of its dip at the breakaway or more, and are still on "
     "it",
     taken<&M::rollover_tilt>},
    {"breakaway_rotation_deg", "deg", "rotation at the breakaway",
     "ramp-flat-ramp only: rotation of the discs that started within 1.5 km of the breakaway, as "
     "one rigid body",
     taken<&M::breakaway_rotation>},
    {"toe_rotation_deg", "deg", "rotation of the upper block's toe",
     "ramp-flat-ramp only: rotation, as one rigid body, of the upper block's toe, the discs that "
     "started within 1.5 km of the last 15 degrees of the upper ramp; it turns back once over the "
     "kink",
     taken<&M::toe_rotation>},
    {"lower_block_rotation_deg", "deg", "rotation of the lower block",
     "ramp-flat-ramp only: mean rotation of patches of 1.5 km of the discs that started below the "
     "flat's level, on the lower ramp and within half its height",
     taken<&M::lower_block_rotation>},
    {"intervening_high_x_m", "m", "intervening high, x",
     "x of the intervening high: the basin (smoothed over 1 km) is shallowest there between the "
     "depocentre nearest the breakaway and the most prominent one beyond",
     taken<&M::intervening_high, &Point::x>},
    {"intervening_high_z_m", "m", "intervening high, depth",
     "depth of the basin at the intervening high", taken<&M::intervening_high, &Point::y>},
    {"halfgraben_area_share", "1", "halfgraben's share of the basin",
     "share of the basin's area on the breakaway's side of the intervening high; the rest is the "
     "collapse graben",
     taken<&M::halfgraben_area_share>},
};

constexpr Measure<M> of_kinematics[] = {
    {"dilation_area_m2", "m2", "area missing in the balance",
     "extension × thickness less basin area: the area that is missing in the balance of areas",
     taken<&M::dilation_area>},
    {"depth_to_detachment_m", "m", "depth to the flat by the balance of areas",
     "basin area over extension: where an area balance would look for the flat",
     taken<&M::depth_to_detachment>},
    {"inclined_shear_angle_deg", "deg", "inclined shear: best angle",
     "hanging wall sheared on parallel planes, `z(u) = F(u) - F(u - e)` with `F` the detachment's "
     "depth where the plane `u = x + z tan(angle)` meets it: best-fitting angle from the vertical, "
     "positive antithetic",
     taken<&M::inclined_shear_angle>},
    {"inclined_shear_misfit_m", "m", "inclined shear: misfit",
     "root mean square of the height differences at the best-fitting angle of inclined shear",
     taken<&M::inclined_shear_misfit>},
    {"normals_misfit_m", "m", "normals that stay normal: misfit",
     "root mean square of the height differences for lines that stay normal to the detachment, up "
     "to half way between the cutoff and the end of the detachment's first piece: the head block",
     taken<&M::normals_misfit>},
    {"predicted_tilt_deg", "deg", "normals that stay normal: tilt",
     "normals stay normal: the detachment's dip at the breakaway less that one extension further "
     "down (extension / radius on an arc); to compare with `rollover_tilt_deg`",
     taken<&M::predicted_tilt>},
    {"predicted_cutoff_x_m", "m", "predicted cutoff, x",
     "x of the point of the detachment one extension down from the breakaway",
     taken<&M::predicted_cutoff, &Point::x>},
    {"predicted_cutoff_z_m", "m", "predicted cutoff, depth",
     "depth of the point of the detachment one extension down from the breakaway",
     taken<&M::predicted_cutoff, &Point::y>},
    {"predicted_halfgraben_area_share", "1", "normals that stay normal: halfgraben's share",
     "normals stay normal: area left of the rollover's crest over extension × depth; (1 + cos dip) "
     "/ 2 for small slip on an arc",
     taken<&M::predicted_halfgraben_area_share>},
};

constexpr Measure<M> of_strain[] = {
    {"strain_top10", "1", "strain in the most strained tenth",
     "share of the strain in the most strained tenth of the area", taken<&M::strain_top10>},
    {"strain_top10_cumulative", "1", "strain since the start in the most strained tenth",
     "share of the strain since the start in the most strained tenth of the area",
     taken<&M::strain_top10_cumulative>},
    {"strain_gini", "1", "unevenness of strain (Gini)", "Gini coefficient of the strain",
     taken<&M::strain_gini>},
};

constexpr Measure<M> of_material[] = {
    {"basement_unbonded_fraction", "1", "unbonded share of the basement",
     "share of touching pre-rift pairs without bond", taken<&M::basement_unbonded_fraction>},
    {"broken_width_diameters", "diameters", "distance of broken from sound basement",
     "mean distance of broken from sound basement, a quarter of the width of a strip: 2 to 3 where "
     "faults form, 6 to 9 where rock is broken areally. Broken: of the touching pre-rift pairs "
     "within 1.6 diameters of a disc 35 % or more have no bond",
     taken<&M::broken, &BrokenRock::width>},
    {"broken_areal_share", "1", "share of the basement broken areally",
     "share of the basement, by area, that is broken and more than 4 diameters from sound rock",
     taken<&M::broken, &BrokenRock::areal_share>},
    {"old_sediment_bonded_fraction", "1", "old sediment: bonded share",
     "bonded share of the touching pairs of sediment discs deeper than 1.5 km and older than "
     "2 km of travel (200,000 a at 1 cm/a)",
     taken<&M::old_sediment_bonded_fraction>},
};

constexpr Measure<M> of_base[] = {
    {"ramp_mobilised_friction", "1", "mobilised friction of the ramp",
     "shear over normal force, sums over the contacts of the detachment down to its sole-out "
     "point, "
     "at the moment: above 0 the base pulls the discs along, below 0 it holds them back. At most "
     "the detachment's friction",
     taken<&M::base, &BaseForces::ramp, &BasePart::mobilised_friction>},
    {"flat_mobilised_friction", "1", "mobilised friction of the flat",
     "`ramp_mobilised_friction` of the detachment beyond its sole-out point, or of a base that "
     "stretches",
     taken<&M::base, &BaseForces::flat, &BasePart::mobilised_friction>},
    {"ramp_slip_ratio", "1", "slip on the ramp over the wall's",
     "speed at which discs slip along the detachment down to its sole-out point, mean over its "
     "length, over that of the wall: 0 where they go with the base, above 0 down the dip",
     taken<&M::base, &BaseForces::ramp, &BasePart::slip_ratio>},
    {"flat_slip_ratio", "1", "slip on the flat over the wall's",
     "`ramp_slip_ratio` of the detachment beyond its sole-out point, or of a base that stretches: "
     "above 0 toward the right wall",
     taken<&M::base, &BaseForces::flat, &BasePart::slip_ratio>},
    {"ramp_sliding_share", "1", "sliding share of the ramp",
     "share of the length of the detachment, down to its sole-out point, whose contacts have 99 % "
     "of the shear force that their friction allows",
     taken<&M::base, &BaseForces::ramp, &BasePart::sliding_share>},
    {"flat_sliding_share", "1", "sliding share of the flat",
     "`ramp_sliding_share` of the detachment beyond its sole-out point, or of a base that "
     "stretches",
     taken<&M::base, &BaseForces::flat, &BasePart::sliding_share>},
    {"wall_force_n_per_m", "N/m", "force on the right wall",
     "horizontal force of the discs on the right wall at the moment, per metre of the third "
     "dimension",
     taken<&M::base, &BaseForces::right_wall>},
    {"left_wall_force_n_per_m", "N/m", "force on the left wall",
     "horizontal force of the discs on the left wall of a box that stretches",
     taken<&M::base, &BaseForces::left_wall>},
    {"moved_border_dip_deg", "deg", "dip of the border of what the wall moved",
     "on a base at rest: dip of the best straight line, through eight layers, between rock that "
     "has gone at least half of the wall's way along x and rock that has not",
     taken<&M::wall_wedge, &WallWedge::border_dip>},
    {"wedge_slope_deg", "deg", "slope of the wedge at a wall that pushes",
     "on a base at rest, shortened: slope of the ground that falls from its highest place to the "
     "left, best straight line between five sixths and a sixth of its height",
     taken<&M::wall_wedge, &WallWedge::slope>},
};

constexpr Measure<M> of_quality[] = {
    {"still_ground_m", "m", "rise of ground that nothing moves",
     "mean rise since the start of pre-rift discs that lay in the highest tenth of the hanging "
     "wall "
     "and in the tenth of its length at the moving wall, where a rigid detachment is flat: soft "
     "rock "
     "that had not come to rest leaves its level. None in a box that stretches, and once a stage "
     "has "
     "shortened",
     taken<&M::still_ground>, OverTime::last, "within half a disc's radius"},
    {"mass_error_fraction", "1", "error of mass",
     "(mass − (initial + deposited − removed)) / initial, without sign; zero up to round-off",
     taken<&M::mass_error_fraction>, OverTime::last, "below 1e-12"},
    {"unbalanced_ratio_mean", "1", "unbalanced force, mean",
     "unbalanced force on a disc over the mean contact force, sampled every 25 m of travel: mean "
     "over "
     "discs and samples",
     taken<&M::unbalanced_ratio_mean>, OverTime::last, "at most 0.01"},
    {"unbalanced_ratio_max", "1", "unbalanced force, largest",
     "unbalanced force on a disc over the mean contact force, sampled every 25 m of travel: "
     "largest",
     taken<&M::unbalanced_ratio_max>},
    {"inertial_number", "1", "inertial number",
     "strain rate × diameter × sqrt(density / pressure), mean over the tenth of the pre-rift area "
     "that holds most of it, last window",
     taken<&M::inertial_number>, OverTime::last, "at most 0.002"},
};

} // namespace

std::span<const MeasureTable> measure_tables() {
    static constexpr MeasureTable tables[] = {
        {"structure", of_structure}, {"kinematics", of_kinematics},
        {"strain", of_strain},       {"material", of_material},
        {"base", of_base},           {"quality", of_quality}};
    return tables;
}

std::string_view name_of(std::optional<double> (*value)(const Measures&)) {
    for (const MeasureTable& table : measure_tables())
        for (const Measure<M>& measure : table.measures)
            if (measure.value == value)
                return measure.name;
    assert(false && "no measure is taken so");
    return {};
}

constinit const Quantity quasi_static{
    "quasi_static",
    "",
    "quasi-static",
    "whether `unbalanced_ratio_mean` is at most 1e-2 and `inertial_number` at most 2e-3, twice the "
    "values of `lis1` at draft; if not, the run warns, and `extension.speed_m_per_s` should be "
    "smaller. Absent without gravity, and in runs shorter than a sampling interval",
    OverTime::last,
    "true"};

constinit const Quantity depocentres{
    "depocentres", "", "depocentres",
    "maxima of the sediment thickness (smoothed over 1 km) with a prominence of 250 m or more, "
    "thickest first; one that is thinner than a mean disc diameter may be a few discs in a dent"};

std::span<const Measure<Depocentre>> depocentre_measures() {
    using D = Depocentre;
    static constexpr Measure<D> all[] = {
        {"x_m", "m", "x", "x of the depocentre", taken<&D::x>},
        {"thickness_m", "m", "thickness", "thickness of the sediment at the depocentre",
         taken<&D::thickness>},
        {"prominence_m", "m", "prominence", "thickness above the saddle to a thicker depocentre",
         taken<&D::prominence>}};
    return all;
}

constinit const Quantity old_sediment_bonded_profile{
    "old_sediment_bonded_profile", "", "old sediment: bonded share by depth",
    "bonded share of the touching pairs of sediment discs older than 2 km of travel "
    "(200,000 a at 1 cm/a), by depth"};

std::span<const Measure<BondedLayer>> bonded_layer_measures() {
    using B = BondedLayer;
    static constexpr Measure<B> all[] = {{"depth_m", "m", "depth",
                                          "depth below the level: middle of a layer 1 km high",
                                          taken<&B::depth>},
                                         {"bonded_fraction", "1", "bonded share",
                                          "bonded share of the layer's pairs", taken<&B::share>}};
    return all;
}

} // namespace listric::measures
