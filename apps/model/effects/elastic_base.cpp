#include "apps/model/base_driver.hpp"
#include "apps/model/effect_list.hpp"
#include "apps/model/effects/elastic_base_driver.hpp"
#include "apps/model/effects/elastic_base_parameters.hpp"
#include "apps/model/effects/elastic_base_request.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/support/words/spelling.hpp"
#include "coupling/creep.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"
#include "fem/blocks.hpp"
#include "fem/mesh_scan.hpp"
#include "fem/relaxation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

namespace listric::effects::elastic_base {

namespace {

using P = ElasticBaseParameters;
using B = BendingBase;

/// Parameters of the plate, with or without discs on it.
std::vector<Parameter> plate_parameters() {
    return {
        {"elastic_thickness_m", at<&P::bending, &B::elastic_thickness>, "m", between(100, 2e5), "",
         "effective elastic thickness Te: rock below it does not carry bending; its default beside "
         "a viscosity of layers or an isotherm is depth_m, so that these alone say what flows",
         "Raising it lowers the flank and widens its uplift; below 10 km the number is nominal, "
         "since a skin along the detachment bends, too.",
         between(4600, 77e3)},
        {"elastic_isotherm_c", at<&P::isotherm>, "degC", between(50, 1200), "",
         "temperature at which the strength of rock ends, in place of elastic_thickness_m; with "
         "temperatures of rock. What cools then begins without stress, what heats sheds its own",
         "Lowering it thins the plate; it is thinnest where and when a rift is hottest.",
         between(250, 450)},
        {"young_modulus_pa", at<&P::bending, &B::young_modulus>, "Pa", between(1e6, 1e13), "E",
         "Young's modulus of the base",
         "Raising it stiffens the plate in proportion; thickness counts with its cube."},
        {"poisson_ratio", at<&P::bending, &B::poisson_ratio>, "", ranges::poisson_ratio, "nu",
         "Poisson's ratio of the base",
         "Raising it stiffens the plate slightly, by 1 / (1 - nu^2)."},
        {"crust_density_kg_per_m3", at<&P::bending, &B::crust_density>, "kg/m3", ranges::density,
         "rho_c", "density of the base, above the mantle",
         "Raising it moves restoring force from the base's lower side to the surface."},
        {"mantle_density_kg_per_m3", at<&P::bending, &B::mantle_density>, "kg/m3", ranges::density,
         "rho_m", "density of the mantle, on which the base floats",
         "Raising it makes the base float more firmly: it moves less under a load."},
        {"asthenosphere_density_kg_per_m3", at<&P::bending, &B::asthenosphere_density>, "kg/m3",
         ranges::density, "",
         "density of what flows in below the mantle where the base rises, and away where it sinks; "
         "default: the mantle's. Hot mantle is lighter: 3184 beside 3330 is McKenzie's",
         "Lowering it lets the base sink more under every load.", between(3150, 3300)},
        {"infill_density_kg_per_m3", at<&P::bending, &B::infill_density>, "kg/m3", between(0, 20e3),
         "",
         "density of the fill of the deflection: 0 air, 1030 water, 2400 sediment; it acts where "
         "the surface sinks and where it rises",
         "Raising it deepens the deflection of the footwall, and lets its flank rise higher.",
         between(0, 2400)},
        {"cells", at<&P::bending, &B::cells>, "", between(1, 64), "",
         "number of elements through the elastic thickness, in a scene without discs",
         "Raising it makes the solution more accurate and slower."},
        {"degree", at<&P::bending, &B::degree>, "", between(1, 2), "",
         "degree of the elements: 2, or 1 to compare",
         "At 1 the error is ten times as large with ten times as many unknowns."},
    };
}

/// Parameters of the footwall under discs.
std::vector<Parameter> footwall_parameters() {
    return {
        {"left_m", at<&P::bending, &B::left>, "m", between(-1e7, -1), "",
         "x of the footwall's far side",
         "Raising it toward the breakaway lets the side hold the flank."},
        {"right_m", at<&P::bending, &B::right>, "m", between(1, 1e7), "",
         "x of the far side of the rock below the hanging wall",
         "Lowering it toward the moving wall lets the side hold the base below the basin."},
        {"depth_m", at<&P::depth>, "m", ranges::length, "",
         "depth of the mantle, on which the base floats",
         "Raising it thickens the soft rock below Te, which carries little bending."},
        {"relaxation", at<&P::relaxation>, "", between(1, 1e6), "",
         "shear modulus over that of rock below the elastic thickness; bulk moduli are equal",
         "Lowering it lets rock below Te bend, too: the plate acts thicker."},
        {"skin_thickness_m", at<&P::skin_thickness>, "m", between(0, 1e5), "",
         "thickness of rock along the detachment that keeps its shear modulus below Te",
         "Lowering it lets thin plates bend as their Te predicts; without it discs squeeze soft "
         "rock.",
         between(1000, 3000)},
        {"cell_size_m", at<&P::cell_size>, "m", between(100, 1e5), "",
         "size of elements at the detachment; its default depends on the accuracy",
         "Lowering it resolves loads better; results of lis1-elastic change by 0.1 %.",
         between(500, 2000)},
        {"refinements", at<&P::refinements>, "", between(0, 6), "",
         "number of times that all elements are halved besides",
         "Each one makes four times as many elements."},
        {"layers", at<&P::layers>, "", ranges::any, "",
         "rock by depth, the first from 0: {top_depth_m, young_modulus_pa, poisson_ratio, "
         "density_kg_per_m3, viscosity_pa_s}; none: one layer of the values above",
         "Make the plate stiffer where its rock is stiffer, or let it relax; Te cuts through them: "
         "rock below it is soft from the start, whatever its viscosity."},
        {"mesh_file", at<&P::mesh_file>, "", ranges::any, "",
         "Gmsh mesh (.msh, format 2.2) of the footwall, instead of elements made from the "
         "detachment",
         "Takes elements of any shape and size in place of those that the program makes."},
        {"left_side", one_of<&P::left_side>({"free", "roller", "elastic"}), "", ranges::any, "",
         "support of the left side: none, rollers, or springs like as much rock again",
         "Matters where the side is so near that the flank reaches it."},
        {"right_side", one_of<&P::right_side>({"free", "roller", "elastic"}), "", ranges::any, "",
         "support of the right side: none, rollers, or springs like as much rock again",
         "Matters where the side is so near that the bent base reaches it."},
        {"solver", one_of<&P::bending, &B::solver>({"mumps", "boomeramg", "gamg"}), "", ranges::any,
         "", "mumps: factors, which a base under discs needs; the others: multigrid, without discs",
         "Changes time and memory only; mumps is the fastest at every size of a section."},
    };
}

/// How it moves with the discs.
std::vector<Parameter> coupling_parameters() {
    return {
        {"update_interval_cycles", at<&P::update_interval>, "", between(1, 1e6), "",
         "number of cycles between updates of the base",
         "Raising it lets the base lag behind its load in proportion: 2 % of its displacement at "
         "5, 7 % at 20, of 2 km of extension.",
         between(1, 20)},
        {"modes", at<&P::modes>, "", between(0, 1e5), "",
         "number of the base's softest modes that move; 0: all, as beside a viscosity of layers or "
         "an "
         "isotherm",
         "Lowering it below 20 holds the base stiffer at short wavelengths.", between(20, 100)},
        {"mass_factor",
         at<&P::mass_factor>,
         "",
         {.from = 0.6, .to = 1e6, .reason = "below, contacts and base are unstable"},
         "",
         "modal mass over (stiffness + contact stiffness) times the squared update interval",
         "Raising it makes the base more inert, so that it lags behind its load."},
        {"swing_damping", at<&P::swing_damping>, "", between(0, 10), "",
         "damping of the modes with the discs they carry, over critical damping",
         "Lowering it lets base and discs oscillate together on soft springs."},
    };
}

std::vector<Parameter> parameters() {
    std::vector<Parameter> all = plate_parameters();
    std::ranges::move(footwall_parameters(), std::back_inserter(all));
    std::ranges::move(coupling_parameters(), std::back_inserter(all));
    return all;
}

/// A base that relaxes, or whose strength ends at an isotherm, bends as these say, and moves in all
/// its modes: those of one stiffness are not those of another.
void complete(Scene& scene, const IsGiven& is_given, const Refuse& refuse) {
    P& base = *scene.find<P>();
    if (!changes(base))
        return;
    if (!is_given("elastic_base.elastic_thickness_m"))
        base.bending.elastic_thickness = base.depth;
    else if (base.isotherm && base.bending.elastic_thickness != base.depth)
        refuse("elastic_base.elastic_isotherm_c",
               fmt::format("is {} beside elastic_thickness_m = {}; strength ends at one of them: "
                           "leave one out",
                           text(*base.isotherm), text(base.bending.elastic_thickness)));
    if (!is_given("elastic_base.modes"))
        base.modes = 0;
    else if (base.modes != 0)
        refuse("elastic_base.modes",
               fmt::format("is {} beside {}; a base whose stiffness changes moves in all its "
                           "modes: give 0 or leave it out",
                           base.modes,
                           base.isotherm ? "elastic_isotherm_c" : "a layer with viscosity_pa_s"));
}

/// Rock below the elastic thickness is soft from the start: nothing is left to relax.
void check_viscosity(const P& base, const Refuse& refuse) {
    for (std::size_t k = 0; k < base.layers.size(); ++k) {
        const fem::Layer& layer = base.layers[k];
        if (layer.viscosity && layer.top_depth >= base.bending.elastic_thickness)
            refuse(fmt::format("elastic_base.layers[{}].viscosity_pa_s", k),
                   fmt::format("is {} in a layer from {} m on, below elastic_thickness_m = {}, "
                               "where rock is soft from the start and has no stress to relax; "
                               "raise elastic_thickness_m ({}, the base's depth, leaves all to "
                               "viscosity), or leave out the viscosity",
                               text(*layer.viscosity), text(layer.top_depth),
                               text(base.bending.elastic_thickness), text(base.depth)));
    }
}

/// An isotherm lies in the base, and is what its rock changes by.
void check_isotherm(const P& base, const ModelParts& parts, const Refuse& refuse) {
    if (!base.isotherm)
        return;
    const std::string value = text(*base.isotherm);
    if (!parts.depth_of_temperature)
        refuse("elastic_base.elastic_isotherm_c",
               fmt::format("is {}, but rock has no temperatures; add the table that gives it some, "
                           "or give elastic_thickness_m",
                           value));
    if (relaxes(base))
        refuse("elastic_base.elastic_isotherm_c",
               fmt::format("is {} beside a layer with viscosity_pa_s; leave one out", value));
    const auto depth = parts.depth_of_temperature(*base.isotherm);
    if (!depth || *depth <= 0.0 || *depth >= base.depth)
        refuse(
            "elastic_base.elastic_isotherm_c",
            fmt::format("is {}, which rock has {}, allowed: between the ground and depth_m = {}; "
                        "lower it, or raise depth_m",
                        value, depth ? fmt::format("at {:.0f} m", *depth) : std::string("nowhere"),
                        text(base.depth)));
}

/// The run's own elements, and those half as large with which it is checked at its end.
void check_cell_size(const P& base, const fem::FootwallRequest& request, const Refuse& refuse) {
    if (!base.mesh_file.empty())
        return; // its elements are halved, whatever their size
    const double least = 2.0 * fem::least_cell_share *
                         std::max(request.right - request.left, request.depth); // halved at the end
    if (base.cell_size < least)
        refuse(
            "elastic_base.cell_size_m",
            fmt::format("is {}, allowed: at least {}, since the check at the end of a run halves "
                        "elements, which must be at least 1e-5 of the footwall's width and "
                        "depth; raise it, or move left_m and right_m in",
                        text(base.cell_size), text(least)));
}

/// The rock right of the wall, which the wall takes along, weighs as the discs do on the flat: see
/// coupling::ElasticBase. A wall that stands on a dip has no flat to weigh them on.
void check_flat(const Scene& scene, const fem::FootwallRequest& request, const dem::Chain& chain,
                const Refuse& refuse) {
    constexpr double level = 1.0; // m
    const double wall = scene.hanging_wall.length;
    const double end = std::min(request.interface_end, request.right);
    if (dem::height_at(chain, wall) < dem::height_at(chain, end) + level)
        return;
    const auto flat = std::ranges::find_if(chain, [&](const dem::Segment& segment) {
        return segment.end.y < chain.back().end.y + level;
    });
    refuse("hanging_wall.length_m",
           fmt::format("is {}, where the detachment below the right wall still dips; beside "
                       "[elastic_base] allowed: at least {:.0f}, where it is flat, since the rock "
                       "that the wall takes along is weighed there",
                       text(wall), std::ceil(flat->end.x)));
}

/// Refusals of the footwall itself, before a run prepares anything.
void check(const Scene& scene, const Refuse& refuse) {
    const P& base = *listric::elastic_base(scene);
    const std::string why = objection_to_densities(base.bending);
    if (!why.empty())
        refuse("elastic_base.crust_density_kg_per_m3", why);
    if (base.mesh_file.empty() && base.bending.elastic_thickness > base.depth)
        refuse(
            "elastic_base.elastic_thickness_m",
            fmt::format("is {}, allowed: at most depth_m = {}, where the base ends; raise depth_m",
                        text(base.bending.elastic_thickness), text(base.depth)));
    check_viscosity(base, refuse);
    const dem::Extent extent{scene.hanging_wall.length, scene.hanging_wall.thickness,
                             greatest_extension(scene)};
    if (!(base.bending.right > extent.reach()))
        refuse("elastic_base.right_m",
               fmt::format("is {}, allowed: above {}, beyond the right wall's last position",
                           text(base.bending.right), text(extent.reach())));
    if (base.bending.solver != fem::Solver::mumps)
        refuse("elastic_base.solver",
               "makes no factors, which a base under discs is condensed with; allowed: mumps");
    const ModelParts parts = make_parts(scene);
    check_isotherm(base, parts, refuse);
    const fem::FootwallRequest request = make_footwall_request(scene, parts);
    check_cell_size(base, request, refuse);
    try {
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
    check_flat(scene, request, parts.base.surfaces.front().chain, refuse);
}

void contribute(const Scene& scene, ModelParts& parts) {
    const P& base = *listric::elastic_base(scene);
    dem::follow_nodes(parts.base, base.bending.degree);
    parts.base_moves = true;
}

/// List of what is not in the model, with its size.
std::string explain_lacks(const Scene& scene, EffectList list) {
    std::vector<Lack> lacks;
    const ModelParts parts = make_parts(scene);
    const auto add = [&](const Lack& lack) {
        if (!lack.what.empty() && !(lack.is_there && lack.is_there(parts)))
            lacks.push_back(lack);
    };
    for (const Effect* effect : list)
        if (has_effect(scene, effect->name))
            std::ranges::for_each(effect->lacks, add);
        else
            add(effect->absence);
    lacks.push_back(
        scene.detachment && scene.detachment->footwall_top
            ? Lack{"the weight of what lies on the level ground behind the breakaway, "
                   "which stays where it is",
                   "no uplift is measured; 5.8e10 N/m in inversion-lis1 after 4 km back"}
            : Lack{"what leans on the backstop above the breakaway",
                   "none where the ground does not stand above the breakaway"});
    std::string text =
        "  not in the model, with what each by itself does to the uplift of the breakaway\n"
        "  (lis1-elastic, 5 km of extension, Te 5 to 20 km; "
        "docs/explain/elastic-base.md#what-it-depends-on)\n";
    for (const Lack& lack : lacks)
        text += fmt::format("    {}: {}\n", lack.what, lack.size);
    return text;
}

/// "2.5 kyr"
std::string years_text(double years) {
    return years < 1e6 ? fmt::format("{:.3g} kyr", years / 1e3)
                       : fmt::format("{:.3g} Myr", years / 1e6);
}

/// Number of the base's elements; 0 where they come from a file.
double elements(const Scene& scene) {
    const P& base = *listric::elastic_base(scene);
    if (!base.mesh_file.empty())
        return 0.0;
    const fem::BlockMesh mesh = fem::make_blocks(make_footwall_request(scene, make_parts(scene)));
    return static_cast<double>(mesh.cells.size()) *
           dem::power(4.0, mesh.halvings + base.refinements);
}

/// Of a step of relaxation, measured with 1,088 elements; disc-steps likewise.
constexpr double creep_seconds_of_an_element = 1.7e-5, creep_price_of_an_element = 640.0;

/// How rock relaxes: its times over the steps of the run, memory and time.
std::string explain_creep(const Scene& scene, const P& base) {
    const dem::Calendar calendar = make_calendar(scene);
    const dem::Schedule schedule = coupling::creep_schedule(calendar);
    std::vector<double> steps = {schedule.years(1)};
    for (const dem::SteppedPause& pause : calendar.pauses())
        steps.push_back(schedule.years(schedule.nearest(pause.end())));
    std::string text;
    for (const fem::Layer& layer : base.layers) {
        if (!layer.viscosity)
            continue;
        const double modulus = layer.young_modulus / (2.0 * (1.0 + layer.poisson_ratio));
        const double time = *layer.viscosity / modulus;
        text += fmt::format("  relaxes from {:g} km down ({:g} Pa s): by 63 % in {}",
                            layer.top_depth / 1e3, *layer.viscosity,
                            years_text(time / dem::seconds_per_year));
        for (const double step : steps) {
            const fem::Maxwell over = fem::maxwell(step * dem::seconds_per_year, time);
            text += fmt::format(
                "\n    a step of {}: {:.3g} of these times, {:.3g} of the shear modulus is left{}",
                years_text(step), step * dem::seconds_per_year / time, over.share,
                over.share > fem::least_share ? "" : ", the least that is kept");
        }
        text += '\n';
    }
    const auto times = schedule.nearest(dem::Travel(scene.extension.distance));
    text += fmt::format("    {} steps", times);
    if (const double count = elements(scene); count > 0.0)
        text +=
            fmt::format(" of about {:.0f} ms each, up to {:.1f} MB in a snapshot",
                        count * creep_seconds_of_an_element * 1e3,
                        count * (base.bending.degree + 1) * (base.bending.degree + 1) * 24.0 / 1e6);
    return text + '\n';
}

/// Loads that the footwall feels, and those that it does not.
std::string explain(const Scene& scene, EffectList list) {
    const P& base = *listric::elastic_base(scene);
    std::string text = fmt::format(
        "elastic base\n"
        "  Te {:.3g} km, {:g} km thick, from x = {:g} to {:g} km; below Te the shear modulus is "
        "1/{:g},\n  but not within {:g} km of the detachment; updated every {} cycles\n"
        "  loaded by what changes in the discs' forces since they settled on it\n"
        "  loads that no disc carries\n"
        "    right of the right wall: the weight of the undisturbed hanging wall, up to where the\n"
        "    wall is; the wall takes this weight along\n"
        "    springs (density x gravity) where rock of other density moves in: {} kg/m3 above the\n"
        "    footwall and on the detachment, {} kg/m3 at the base\n"
        "    {}\n",
        make_footwall_request(scene, make_parts(scene)).elastic_thickness / 1e3, base.depth / 1e3,
        base.bending.left / 1e3, base.bending.right / 1e3, base.relaxation,
        base.skin_thickness / 1e3, base.update_interval, base.bending.crust_density,
        base.bending.floats_on() - base.bending.crust_density,
        base.bending.infill_density > 0.0
            ? fmt::format("infill of {} kg/m3 on the footwall's surface: {} kg/m3 there, where it "
                          "sinks and\n    where it rises",
                          base.bending.infill_density,
                          base.bending.crust_density - base.bending.infill_density)
            : std::string("no infill on the footwall's surface"));
    if (relaxes(base))
        text += explain_creep(scene, base);
    if (base.isotherm)
        text += fmt::format("  Te is the depth of {:g} degC at the start, and follows it\n",
                            *base.isotherm);
    for (const EffectPart& part : scene.effects)
        if (part.effect->load_footwall && part.effect->explain)
            text += part.effect->explain(scene, list);
    return text + explain_lacks(scene, list);
}

/// Set-up, settling of the discs, an answer every few cycles, and steps of relaxation.
double price(const Scene& scene, const Workload& work) {
    const P& base = *listric::elastic_base(scene);
    double price = 5e7 + 1.2e4 * work.at_start + 1350.0 * work.cycles / base.update_interval;
    if (relaxes(base))
        price += creep_price_of_an_element * elements(scene) *
                 work.applications(coupling::creep_schedule(work.calendar).interval);
    return price;
}

/// The plug-in, and factors of the base and of the finer one that it is checked with: measured 223,
/// 263 and 379 MB with 9, 20 and 50 thousand unknowns (lis1-elastic, cells of 2, 1 and 0.5 km).
double memory(const Scene& scene) {
    const P& base = *listric::elastic_base(scene);
    constexpr double plug_in = 190e6, unknown = 3800.0;
    if (!base.mesh_file.empty())
        return plug_in;
    const fem::FootwallRequest request = make_footwall_request(scene, make_parts(scene));
    const double cells = elements(scene);
    const double on_detachment =
        2.0 * base.bending.degree *
        std::ldexp(request.interface_end / base.cell_size, base.refinements);
    return plug_in + unknown * 2.0 * base.bending.degree * base.bending.degree * cells +
           8.0 * on_detachment * on_detachment;
}

/// Where the base is now: the run may have been ended within a window.
std::vector<Measure<Observation>> of_nodes() {
    using V = std::optional<double>;
    return {
        {footwall_uplift, "m", "uplift of the flank",
         "vertical displacement of the breakaway, positive up",
         [](const Observation& now) -> V { return base_node_columns(now.state).uy[0]; }},
        {breakaway_shift, "m", "shift of the breakaway",
         "horizontal displacement of the breakaway, positive toward the hanging wall",
         [](const Observation& now) -> V { return base_node_columns(now.state).ux[0]; }},
        {base_deflection, "m", "largest deflection of the detachment",
         "largest vertical displacement of the detachment, up or down",
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
            {interface_force_error, "1", "error of forces on the base",
             "forces on the nodes against those on the discs: sum, over the sum of magnitudes. "
             "Round-off; largest of the windows",
             nullptr, largest},
            {interface_moment_error, "1", "error of moments on the base",
             "forces on the nodes against those on the discs: moment about the breakaway in the "
             "deformed wall, over the sum of magnitudes. Round-off; largest of the windows",
             nullptr, largest},
            {interface_work_error, "1", "error of work on the base",
             "forces on the nodes against those on the discs: power, over the sum of magnitudes. "
             "Round-off; largest of the windows",
             nullptr, largest},
            {base_reaction_error, "1", "base's reaction over the discs' weight, less 1",
             "base reaction over the discs' weight, less 1: mean over the run (in `history.csv`: "
             "over the window). Inertia and damping carry the rest",
             nullptr, mean},
            {net_wall_load, "N/m", "load taken off the footwall",
             "vertical load taken off the footwall, mean over the last window"},
            {weight_change, "N/m", "weight removed less weight added",
             "removed minus added weight: rock that the right wall took along, less sediment, plus "
             "what was eroded (`history.csv`)",
             nullptr, none},
            {net_wall_load_error, "1", "load taken off over weight removed, less 1",
             "`net_wall_load_n_per_m` over `weight_change_n_per_m`, less 1, in the last window",
             nullptr, OverTime::last, "below 0.02 from 5 km of extension on"},
            {strong_rock_strain, "1", "largest strain of rock that bends",
             "largest principal strain, without sign, in rock that bends; above 2 % it would break",
             nullptr, largest, "below 0.02"},
            {relaxed_rock_strain, "1", "largest strain of relaxed rock",
             "largest principal strain, without sign, in rock below the elastic thickness. Above "
             "10 % in either the run stops",
             nullptr, largest},
            {rock_rotation, "deg", "largest rotation of footwall rock",
             "largest rotation of the footwall's rock. Linear elasticity overlooks a strain of "
             "half its square; above 11.5 degrees, 2 %, the run stops",
             nullptr, largest},
            {beyond_byerlee, "m2", "area beyond Byerlee's law",
             "area of bending rock whose stress, on lithostatic pressure, exceeds Byerlee's law: "
             "rock that is stronger in the model than in nature",
             nullptr, largest},
            {base_elements_difference, "1", "difference to larger elements",
             "difference between the detachment's displacements on a mesh with elements half as "
             "large and on the run's mesh, both under the mean forces of the last window, root "
             "mean square over root mean square",
             nullptr, OverTime::last, "0.001 to 0.007"},
            {base_resolved_difference, "1", "difference to a finer mesh",
             "difference of the displacement on the finer mesh from the base's mean displacement "
             "in the last window, so that it includes the lag of the base behind its load",
             nullptr, OverTime::last, "below 0.01"},
        },
        std::back_inserter(all));
    return all;
}

} // namespace

Works works() { return {&works::hetenyi, &works::turcotte_schubert}; }

const Effect& effect() {
    static const Effect effect{
        .name = "elastic_base",
        .doc = "footwall and basement bend and float",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters = parameters(),
        .former = {{"averaging_time_s", "cycle.averaging_time_s, which all scenes have"},
                   {"disc_damping", "cycle.averaging_time_s, 0 for absolute"},
                   {.key = "scheme", .stays = "modal"}},
        .files = {{"mesh_file", "", "",
                   [](Scene& scene, const std::string& file, const Refuse&) {
                       scene.find<P>()->mesh_file = std::filesystem::absolute(file).string();
                   }}},
        .needs = {"detachment", "gravity"},
        .scale = [](Scene& scene,
                    const AccuracyLevel& level) { scene.find<P>()->cell_size = level.cell_size; },
        .complete = complete,
        .check = check,
        .contribute = contribute,
        .bending_base = [](const std::any& parameters) -> const BendingBase& {
            return std::any_cast<const P&>(parameters).bending;
        },
        .drive_base = make_elastic_base_driver,
        .explain = explain,
        .lacks = {{"rock that goes on right of the wall, and friction there",
                   "below 1 %, by a hanging wall of 60 km"},
                  {"time that the mantle takes", "not measured: isostasy answers at once"}},
        .price = price,
        .memory = memory,
        .measures = measures(),
    };
    return effect;
}

} // namespace listric::effects::elastic_base
