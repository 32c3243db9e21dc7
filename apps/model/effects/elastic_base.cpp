#include "apps/model/base_driver.hpp"
#include "apps/model/effect_list.hpp"
#include "apps/model/effects/elastic_base_driver.hpp"
#include "apps/model/effects/elastic_base_parameters.hpp"
#include "apps/model/effects/elastic_base_request.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/model/model.hpp"
#include "apps/support/spelling.hpp"
#include "fem/blocks.hpp"
#include "fem/mesh_scan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

namespace listric::effects {

namespace {

using P = ElasticBaseParameters;

/// Of the plate, with or without discs on it.
std::vector<Parameter> plate_parameters() {
    return {
        {"elastic_thickness_m",
         at<&P::elastic_thickness>,
         "m",
         {.from = 100, .to = 2e5},
         "",
         "effective elastic thickness Te: rock below it does not carry bending"},
        {"young_modulus_pa",
         at<&P::young_modulus>,
         "Pa",
         {.from = 1e6, .to = 1e13},
         "E",
         "Young's modulus of the base"},
        {"poisson_ratio",
         at<&P::poisson_ratio>,
         "",
         {.from = 0, .below = 0.5},
         "nu",
         "Poisson's ratio of the base"},
        {"crust_density_kg_per_m3", at<&P::crust_density>, "kg/m3", ranges::density, "rho_c",
         "of the base, above the mantle"},
        {"mantle_density_kg_per_m3", at<&P::mantle_density>, "kg/m3", ranges::density, "rho_m",
         "of the mantle, on which the base floats"},
        {"infill_density_kg_per_m3",
         at<&P::infill_density>,
         "kg/m3",
         {.from = 0, .to = 20e3},
         "",
         "of what fills the deflection: 0 air, 1030 water, 2400 sediment"},
        {"cells",
         at<&P::cells>,
         "",
         {.from = 1, .to = 64},
         "",
         "elements through the elastic thickness, in a scene without discs"},
        {"degree",
         at<&P::degree>,
         "",
         {.from = 1, .to = 2},
         "",
         "of the elements: 2, or 1 to compare"},
    };
}

/// Of the footwall under discs.
std::vector<Parameter> footwall_parameters() {
    return {
        {"left_m", at<&P::left>, "m", {.from = -1e7, .to = -1}, "", "x of the footwall's far side"},
        {"right_m",
         at<&P::right>,
         "m",
         {.from = 1, .to = 1e7},
         "",
         "x of the far side of what lies below the hanging wall"},
        {"depth_m", at<&P::depth>, "m", ranges::length, "",
         "to the mantle, on which the base floats"},
        {"relaxation",
         at<&P::relaxation>,
         "",
         {.from = 1, .to = 1e6},
         "",
         "shear modulus over that of rock below the elastic thickness; bulk moduli are the same"},
        {"skin_thickness_m",
         at<&P::skin_thickness>,
         "m",
         {.from = 0, .to = 1e5},
         "",
         "rock along the detachment that keeps its shear modulus below the elastic thickness"},
        {"cell_size_m",
         at<&P::cell_size>,
         "m",
         {.from = 100, .to = 1e5},
         "",
         "elements at the detachment; its default depends on the accuracy"},
        {"refinements",
         at<&P::refinements>,
         "",
         {.from = 0, .to = 6},
         "",
         "times that all elements are halved on top"},
        {"layers",
         at<&P::layers>,
         "",
         {},
         "",
         "rock by depth, the first from 0: {top_depth_m, young_modulus_pa, poisson_ratio, "
         "density_kg_per_m3}; none: one of the values above"},
        {"mesh_file",
         at<&P::mesh_file>,
         "",
         {},
         "",
         "Gmsh mesh (.msh, format 2.2) of the footwall, instead of elements made from the "
         "detachment"},
        {"left_side",
         one_of<&P::left_side>({"free", "roller", "elastic"}),
         "",
         {},
         "",
         "nothing holds it, rollers do, or springs like as much rock again"},
        {"right_side",
         one_of<&P::right_side>({"free", "roller", "elastic"}),
         "",
         {},
         "",
         "the same of the other far side"},
        {"solver",
         one_of<&P::solver>({"mumps", "boomeramg", "gamg"}),
         "",
         {},
         "",
         "factors, which a base under discs needs, or multigrid for large ones without discs"},
    };
}

/// How it moves with the discs.
std::vector<Parameter> coupling_parameters() {
    return {
        {"scheme",
         one_of<&P::scheme>({"modal", "lumped"}),
         "",
         {},
         "",
         "how base and discs advance together"},
        {"update_interval_cycles",
         at<&P::update_interval>,
         "",
         {.from = 1, .to = 1e6},
         "",
         "cycles between updates of the base"},
        {"modes",
         at<&P::modes>,
         "",
         {.from = 0, .to = 1e5},
         "",
         "softest modes of the base that move in scheme modal; 0: all"},
        {"mass_factor",
         at<&P::mass_factor>,
         "",
         {.from = 0.6, .to = 1e6, .reason = "below, contacts and base are unstable"},
         "",
         "modal mass over (stiffness + contact stiffness) times the squared update interval"},
        {"swing_damping",
         at<&P::swing_damping>,
         "",
         {.from = 0, .to = 10},
         "",
         "of the modes of scheme modal with the discs they carry, over critical damping"},
    };
}

std::vector<Parameter> parameters() {
    std::vector<Parameter> all = plate_parameters();
    std::ranges::move(footwall_parameters(), std::back_inserter(all));
    std::ranges::move(coupling_parameters(), std::back_inserter(all));
    return all;
}

void check_densities(const P& base, const Refuse& refuse) {
    if (!(base.mantle_density >= base.crust_density) ||
        !(base.crust_density >= base.infill_density))
        refuse("elastic_base.crust_density_kg_per_m3",
               fmt::format("is {}, allowed: between those of infill ({}) and mantle ({}), for the "
                           "base to float upright",
                           text(base.crust_density), text(base.infill_density),
                           text(base.mantle_density)));
}

/// As a plate that carries a load of [flexure], without discs.
void check_plate(const Scene& scene, const P& base, const Refuse& refuse) {
    if (!(base.mantle_density > base.infill_density))
        refuse("elastic_base.mantle_density_kg_per_m3",
               fmt::format("is {}, allowed: above infill_density_kg_per_m3 = {}",
                           text(base.mantle_density), text(base.infill_density)));
    check_densities(base, refuse);
    // Waves shorter than the base is thick do not bend it, and cells would be flat.
    const auto refuse_short = [&](const char* key, double length, double least) {
        if (length < least)
            refuse(std::string("flexure.") + key,
                   fmt::format("too short ({}), allowed: at least {}, a tenth of the elastic "
                               "thickness",
                               text(length), text(least)));
    };
    if (scene.flexure->load == FlexureLoad::sinusoid)
        refuse_short("wavelength_m", scene.flexure->wavelength, 0.1 * base.elastic_thickness);
    if (scene.flexure->load == FlexureLoad::strip)
        refuse_short("half_width_m", scene.flexure->half_width, 0.1 * base.elastic_thickness);
}

/// What the footwall itself refuses, before a run prepares anything.
void check(const Scene& scene, const Refuse& refuse) {
    const P& base = *elastic_base(scene);
    if (scene.flexure) {
        check_plate(scene, base, refuse);
        return;
    }
    check_densities(base, refuse);
    const dem::Extent extent{scene.hanging_wall->length, scene.hanging_wall->thickness,
                             scene.extension.distance};
    if (!(base.right > extent.reach()))
        refuse("elastic_base.right_m",
               fmt::format("is {}, allowed: above {}, beyond the right wall's last position",
                           text(base.right), text(extent.reach())));
    if (base.solver != fem::Solver::mumps)
        refuse("elastic_base.solver",
               "makes no factors, which a base under discs is condensed with; allowed: mumps");
    try {
        const fem::FootwallRequest request = make_footwall_request(scene, make_parts(scene));
        fem::check(request);
        if (base.mesh_file.empty())
            fem::make_blocks(request);
    } catch (const fem::FootwallError& error) {
        refuse("elastic_base", error.what());
    }
    try {
        if (!base.mesh_file.empty())
            fem::scan_mesh(base.mesh_file);
    } catch (const fem::FootwallError& error) {
        refuse("elastic_base.mesh_file", error.what());
    }
}

void contribute(const Scene& scene, ModelParts& parts) {
    if (scene.flexure)
        return;
    const P& base = *elastic_base(scene);
    dem::follow_nodes(parts.base, base.degree);
    parts.base_moves = true;
}

/// What the footwall feels and what it does not.
std::string explain(const Scene& scene, EffectList list) {
    const P& base = *elastic_base(scene);
    constexpr const char* schemes[] = {"modal", "lumped"};
    std::string text = fmt::format(
        "elastic base\n"
        "  Te {:g} km, {:g} km thick, from x = {:g} to {:g} km; below Te the shear modulus is "
        "1/{:g},\n  but not within {:g} km of the detachment; scheme {}, every {} cycles\n"
        "  loaded by what changes in the discs' forces since they settled on it\n"
        "  loads that no disc carries\n"
        "    right of the right wall: the weight of the undisturbed hanging wall, up to where the\n"
        "    wall is; the wall takes this weight along\n"
        "    springs (density x gravity) where rock of other density moves in: {} kg/m3 above the\n"
        "    footwall and on the detachment, {} kg/m3 at the base\n"
        "    {}\n",
        base.elastic_thickness / 1e3, base.depth / 1e3, base.left / 1e3, base.right / 1e3,
        base.relaxation, base.skin_thickness / 1e3, schemes[static_cast<int>(base.scheme)],
        base.update_interval, base.crust_density, base.mantle_density - base.crust_density,
        base.infill_density > 0.0
            ? fmt::format("{} kg/m3 on the footwall's surface where it sinks", base.infill_density)
            : std::string("no infill of what sinks of the footwall's surface"));
    std::vector<std::string_view> absent;
    for (const Effect* effect : list) {
        if (effect->absence.empty())
            continue;
        if (!has_effect(scene, effect->name))
            absent.push_back(effect->absence);
        else if (effect->explain)
            text += effect->explain(scene, list);
    }
    std::ranges::sort(absent);
    absent.push_back("friction of the right wall");
    return text + fmt::format("  not in the model: {};\n"
                              "  what leans on the backstop above the breakaway\n",
                              fmt::join(absent, ", "));
}

/// Set-up, settling of the discs, and an answer every few cycles.
double price(const Scene& scene, const Workload& work) {
    return 5e7 + 1.2e4 * work.at_start +
           1350.0 * work.cycles / elastic_base(scene)->update_interval;
}

/// The plug-in, and factors of the base and of the finer one that it is checked with: measured 223,
/// 263 and 379 MB with 9, 20 and 50 thousand unknowns (lis1-elastic, cells of 2, 1 and 0.5 km).
double memory(const Scene& scene) {
    const P& base = *elastic_base(scene);
    constexpr double plug_in = 190e6, unknown = 3800.0;
    if (!base.mesh_file.empty())
        return plug_in;
    const fem::FootwallRequest request = make_footwall_request(scene, make_parts(scene));
    const fem::BlockMesh mesh = fem::make_blocks(request);
    const double cells =
        static_cast<double>(mesh.cells.size()) * std::pow(4.0, mesh.halvings + base.refinements);
    const double on_detachment =
        2.0 * base.degree * std::ldexp(request.interface_end / base.cell_size, base.refinements);
    return plug_in + unknown * 2.0 * base.degree * base.degree * cells +
           8.0 * on_detachment * on_detachment;
}

/// Where the base is now: the run may have been ended within a window.
std::vector<Measure<Observation>> of_nodes() {
    using V = std::optional<double>;
    return {
        {footwall_uplift, "m", "vertical displacement of the breakaway, positive up",
         [](const Observation& now) -> V { return base_node_columns(now.state).uy[0]; }},
        {breakaway_shift, "m",
         "horizontal displacement of the breakaway, positive toward the hanging wall",
         [](const Observation& now) -> V { return base_node_columns(now.state).ux[0]; }},
        {base_deflection, "m", "largest vertical displacement of the detachment, up or down",
         [](const Observation& now) -> V {
             const auto size = [](double u) { return std::abs(u); };
             return size(std::ranges::max(base_node_columns(now.state).uy, {}, size));
         }},
    };
}

/// Those without a function are taken when a window ends, or at the end of the run.
std::vector<Measure<Observation>> measures() {
    using enum OverTime;
    std::vector<Measure<Observation>> all = of_nodes();
    std::ranges::move(
        std::vector<Measure<Observation>>{
            {interface_force_error, "1",
             "forces on the nodes against those on the discs: sum, over the sum of magnitudes. "
             "Round-off; largest of the windows",
             nullptr, largest},
            {interface_moment_error, "1",
             "forces on the nodes against those on the discs: moment about the breakaway in the "
             "deformed wall, over the sum of magnitudes. Round-off; largest of the windows",
             nullptr, largest},
            {interface_work_error, "1",
             "forces on the nodes against those on the discs: power, over the sum of magnitudes. "
             "Round-off; largest of the windows",
             nullptr, largest},
            {base_reaction_error, "1",
             "base reaction over the discs' weight, less 1: mean over the run (in `history.csv`: "
             "over the window). What is missing is carried by inertia and damping",
             nullptr, mean},
            {net_wall_load, "N/m",
             "vertical load that the footwall is relieved of, mean over the last window"},
            {weight_change, "N/m",
             "removed minus added weight: rock that the right wall took along, less sediment, plus "
             "what was eroded (`history.csv`)",
             nullptr, none},
            {net_wall_load_error, "1",
             "`net_wall_load_n_per_m` over `weight_change_n_per_m`, less 1, in the last window"},
            {strong_rock_strain, "1",
             "largest principal strain, without sign, in rock that bends; above 2 % it would break",
             nullptr, largest},
            {relaxed_rock_strain, "1",
             "largest principal strain, without sign, in rock below the elastic thickness. Above "
             "10 % in either the run stops",
             nullptr, largest},
            {rock_rotation, "deg",
             "largest rotation of the footwall's rock. Linear elasticity overlooks a strain of "
             "half "
             "its square; above 11.5 degrees, 2 %, the run stops",
             nullptr, largest},
            {beyond_byerlee, "m2",
             "area of rock that bends where its stress, on lithostatic pressure, exceeds Byerlee's "
             "law: rock that is stronger here than in nature",
             nullptr, largest},
            {base_elements_difference, "1",
             "the mean forces of the last window, put as tractions on a mesh with elements half as "
             "large: displacement of the detachment from that of the run's elements under the same "
             "forces, root mean square over root mean square"},
            {base_resolved_difference, "1",
             "difference from the base's mean displacement in that window, so that it also holds "
             "how far the base lags behind its load"},
        },
        std::back_inserter(all));
    return all;
}

} // namespace

Works elastic_base_works() { return {&works::hetenyi, &works::turcotte_schubert}; }

const Effect& elastic_base() {
    static const Effect effect{
        .name = "elastic_base",
        .doc = "footwall and basement bend and float",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters = parameters(),
        .former = {{"averaging_time_s", "cycle.averaging_time_s, which all scenes have"},
                   {"disc_damping", "cycle.averaging_time_s, 0 for absolute"}},
        .files = {{"mesh_file", "",
                   [](Scene& scene, const std::string& file, const Refuse&) {
                       scene.find<P>()->mesh_file = std::filesystem::absolute(file).string();
                   }}},
        .needs = {"detachment", "gravity"},
        .without_discs = true,
        .scale = [](Scene& scene,
                    const AccuracyLevel& level) { scene.find<P>()->cell_size = level.cell_size; },
        .check = check,
        .contribute = contribute,
        .drive_base = make_elastic_base_driver,
        .explain = explain,
        .price = price,
        .memory = memory,
        .measures = measures(),
    };
    return effect;
}

} // namespace listric::effects
