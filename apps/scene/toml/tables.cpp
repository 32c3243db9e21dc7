#include "apps/scene/toml/tables.hpp"

#include "apps/scene/toml/pieces.hpp"
#include "apps/support/files/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace listric {

using namespace dem;

namespace {

std::vector<Parameter> hanging_wall_parameters() {
    using P = HangingWallParameters;
    return {
        {"length_m", at<&P::length>, "m", ranges::length, "",
         "length from the breakaway to the moving wall",
         "Raising it keeps the moving wall away from the basin and adds discs in proportion.",
         between(20e3, 80e3)},
        {"thickness_m", at<&P::thickness>, "m", between(1e-3, 1e5), "",
         "greatest thickness: depth to the flat detachment",
         "Raising it widens the basin and the grabens, whose faults reach down to the detachment.",
         between(7500, 15e3)},
        {"mean_radius_m", at<&P::mean_radius>, "m", between(1e-3, 1e4), "r_d",
         "mean disc radius; its default depends on the accuracy",
         "Halving it halves the width of faults and takes six to eight times as long.",
         between(18.62, 186.2)},
        {"radius_ratio", at<&P::radius_ratio>, "", between(1, 10), "r_d^max/r_d^min",
         "largest over smallest disc radius",
         "Lowering it toward 1 lets discs arrange in regular rows, along which rock prefers to "
         "break."},
        {"porosity", at<&P::porosity>, "", between(0.1, 0.4), "Phi_d",
         "porosity of the closed packing, before gravity is applied",
         "Raising it makes the packing looser, with fewer contacts and bonds per disc.",
         between(0.17, 0.175)},
        {"rock_density_kg_per_m3", at<&P::rock_density>, "kg/m3", ranges::density, "rho_tot",
         "bulk density of the packing",
         "Raising it raises all stresses in proportion, and with them the strength that friction "
         "gives."},
        {"ground", at<&P::ground>, "", between(0, 1e5), "",
         "ground before extension as points of x and depth, level beyond the first and the last; "
         "default: level at depth 0",
         "Trims the packing to a slope, a wedge or a pile; rock without bonds keeps no slope "
         "steeper than its friction holds."},
        {"ground_slope_deg", at<&P::ground_slope>, "deg", between(-60, 60), "",
         "slope of the ground from ground_slope_from_m on, in place of ground: above 0 it falls to "
         "the right, below 0 to the left",
         "Trims the packing to a wedge.", between(-30, 30)},
        {"ground_slope_from_m", at<&P::ground_slope_from>, "m", between(0, 1e6), "",
         "x of the point from which the ground slopes; it is level on the other side",
         "Moves the wedge along the section."},
    };
}

std::vector<Parameter> detachment_parameters() {
    using P = DetachmentParameters;
    return {
        {"start_dip_deg", at<&P::start_dip>, "deg", ranges::dip, "", "dip at the breakaway",
         "Lowering it moves area from the collapse graben to the halfgraben at the breakaway.",
         between(60, 90)},
        {"base", base_kinds<&P::base>(), "", ranges::any, "",
         "part of the base that moves with the right wall and pulls the discs: \"sheet\", the "
         "whole "
         "detachment; \"rests\", nothing; \"ramp\", the flat from the sole-out point on. What "
         "rests "
         "resists",
         "With \"rests\" the hanging wall breaks at the right wall; with \"ramp\" it slides down "
         "the ramp or yields inside, as friction decides."},
        {"friction", at<&P::friction>, "", ranges::friction, "",
         "friction between discs and the detachment",
         "Raising it from 0.1 to 0.5 turns the head block of lis1 by 0.3 degrees less at 1 km of "
         "extension.",
         between(0.1, 0.85)},
        {"friction_rule", one_of<&P::friction_rule>({"wall", "smaller"}), "", ranges::any, "",
         "the detachment's own friction, or the smaller of its and the disc's, as in PFC",
         "With \"smaller\" weakened rock loses its hold on the detachment, and head blocks turn by "
         "4 to 5 % more or less."},
        {"footwall_top_m", at<&P::footwall_top>, "m", between(1, 1e6), "",
         "length of level ground behind the breakaway, at rest whatever the base does; none: a "
         "backstop stands above the breakaway",
         "Lets rock that is pushed up run over the footwall; needed where a [[stage]] shortens.",
         between(2e4, 5e4)},
        {"footwall_friction", at<&P::footwall_friction>, "", ranges::friction, "",
         "friction between discs and the ground behind the breakaway",
         "Raising it keeps what runs over the footwall nearer to the breakaway."},
        {"segments", at<&P::segments>, "", ranges::any, "",
         "arcs and lines, from the breakaway down",
         "Their shape determines the shape of the basin more than any other parameter does."},
    };
}

std::vector<Parameter> fault_source_parameters() {
    using S = FaultSource;
    constexpr Range far = between(-1e7, 1e7);
    return {
        {"csv", at<&S::csv>, "", ranges::any, "",
         "picked fault in place of start_dip_deg and segments: columns x_m and depth_m",
         "Makes arcs and lines within tolerance_m of the points the detachment."},
        {"csv_delimiter", one_of<&S::csv_delimiter>(csv_delimiters()), "", ranges::any, "",
         "delimiter of the columns; auto: the header's",
         "Decides how the lines of csv are split; nothing else depends on it."},
        {"svg", at<&S::svg>, "", ranges::any, "",
         "drawing with the fault as a path, in place of csv",
         "Makes arcs and lines within tolerance_m of the path the detachment."},
        {"svg_path", at<&S::svg_path>, "", ranges::any, "",
         "id or label of the path, line or polyline",
         "Selects the fault among the paths of the drawing."},
        {"svg_points", at<&S::svg_points>, "", far, "",
         "two points or more of the drawing and their places in the section",
         "Set the scale of the drawing and its place in the section; from three points on the log "
         "lists how well they agree."},
        {"shift_x_m", at<&S::shift_x>, "m", far, "",
         "shift that is added to every x, so that the breakaway is at 0",
         "Moves the picked fault along the section without changing its shape."},
        {"tolerance_m", at<&S::tolerance>, "m", between(0.1, 1e4), "",
         "largest distance of points from the arcs and lines fitted to them",
         "Raising it makes the detachment simpler, of fewer pieces."},
    };
}

std::vector<Parameter> picked_fault_parameters() {
    using P = PickedFault;
    return {
        {"misfit_m", at<&P::misfit>, "m", between(0, 1e6), "",
         "largest distance of a point from the detachment",
         "Is a result of the fit: it changes nothing in a run."},
        {"x_m", at<&P::x>, "m", between(-1e7, 1e7), "", "x of the points",
         "Is drawn beside the detachment; the detachment itself is in [detachment]."},
        {"depth_m", at<&P::depth>, "m", between(-1e6, 1e6), "", "depth of the points",
         "Is drawn beside the detachment; the detachment itself is in [detachment]."},
    };
}

std::vector<Parameter> observed_source_parameters() {
    using S = ObservedSource;
    return {
        {"horizons", at<&S::horizons>, "", ranges::any, "",
         "file with picked horizons: columns name, x_m, depth_m and, if known, age_a and line",
         "Adds the distance between picks and model to summary.json; the model does not change."},
        {"faults", at<&S::faults>, "", ranges::any, "",
         "file with picked faults, which are drawn: columns name, x_m, depth_m, perhaps line",
         "Draws them over the sections; the model does not change."},
        {"shift_x_m", at<&S::shift_x>, "m", between(-1e7, 1e7), "",
         "shift that is added to every x of the picks; default: detachment.shift_x_m",
         "Moves the picks along the section."},
    };
}

std::vector<Parameter> observed_parameters() {
    constexpr std::string_view changes = "Is drawn and compared; the model does not change.";
    return {
        {"horizon_lines", at<&Observed::horizons>, "", ranges::any, "",
         "content of the file of horizons, written by the program", changes},
        {"fault_lines", at<&Observed::faults>, "", ranges::any, "",
         "content of the file of faults, written by the program", changes},
        {"picture", at<&Observed::picture>, "", ranges::any, "",
         "PNG or JPEG of the section, which --underlay of figures and report draws under the model",
         "Needs corners_m. Is drawn in the drawing page; the model does not change."},
        {"corners_m", at<&Observed::corners>, "m", between(-1e8, 1e8), "",
         "upper left and lower right corner of the picture in the section: x, depth, x, depth",
         "Place the picture; the model does not change."},
    };
}

std::vector<Parameter> stretching_parameters() {
    return {
        {"friction", at<&StretchingParameters::friction>, "", ranges::friction, "",
         "friction between discs and the stretching base",
         "Raising it makes the slab follow the base more uniformly."},
    };
}

std::vector<Parameter> extension_parameters() {
    using P = ExtensionParameters;
    return {
        {"distance_m", at<&P::distance>, "m", between(0, 1e6), "", "total extension",
         "Raising it makes the basin larger and the run longer, both in proportion.",
         between(2000, 12e3)},
        {"rate_m_per_a", at<&P::rate>, "m/a", between(1e-9, 1), "", "geological extension rate",
         "Lowering it lets pore water drain for longer. Intervals that the scene does not state "
         "follow it, so that without pore water only the years change; stated ones hold less of "
         "the wall's way."},
        {"speed_m_per_s", at<&P::speed>, "m/s", between(1e-6, 1e3), "",
         "speed in the model, metres per model second; its default depends on the accuracy",
         "Raising it shortens a run in proportion; above 2 m/s strain is less localised and forces "
         "balance worse.",
         between(0.5, 2)},
        {"ramp_s", at<&P::ramp>, "s", between(0, 1e6), "",
         "model time over which the speed grows from rest; its default depends on the accuracy",
         "Lowering it starts the motion with a jolt."},
        {"wall_friction", at<&P::wall_friction>, "", ranges::friction, "",
         "friction between discs and the right wall, and the left wall of a flat base",
         "Raising it hangs the rock beside the wall on it, and turns the planes that begin there.",
         between(0, 0.6)},
    };
}

std::vector<Parameter> cycle_parameters() {
    using P = CycleParameters;
    return {
        {"damping",
         at<&P::damping>,
         "",
         {.from = 0, .below = 1},
         "",
         "local non-viscous damping coefficient",
         "Lowering it lets discs oscillate for longer before they come to rest."},
        {"averaging_time_s", at<&P::averaging_time>, "s", between(0, 1e9), "",
         "model time over which a disc's mean motion is taken, which is not damped",
         "At 0 all motion is damped, as in PFC: damping then carries 5 to 8 % of the weight of "
         "sinking sediment."},
        {"time_step_safety", at<&P::time_step_safety>, "", between(1e-6, 10), "",
         "time step over the stability limit; above 1 is unstable",
         "Lowering it to a quarter makes a run four times as long and its results no better.",
         between(0.25, 0.95)},
        {"inertial_mass_floor", at<&P::inertial_mass_floor>, "", between(0, 100), "",
         "least inertial mass, in mean basement disc masses",
         "Raising it to 3 halves the cycles of a run, and forces balance to 0.18 instead of 0.11 "
         "%; at 48 the basin lacks 3 % of its area.",
         between(0.75, 3)},
        {"skin", at<&P::skin>, "", between(0.15, 10), "",
         "margin of the neighbour list, in mean radii",
         "Changes the time of a run only, which is least near the default.", between(0.15, 1)},
        {"softness", at<&P::softness>, "", between(1, 64), "",
         "divides the stiffness of rock, sediment and layers; weakened and soft rock, up to "
         "that of rock, and the base keep theirs; its default depends on the accuracy",
         "Raising it to 4 halves the cycles of a run; rock is then four times as compressible.",
         between(1, 16)},
    };
}

std::vector<Parameter> output_parameters() {
    using P = OutputParameters;
    return {
        {"interval_m", at<&P::interval>, "m", between(1e-6, 1e6), "",
         "extension between snapshots, with [[stage]] the travel",
         "Lowering it gives finer histories and births of faults, and more files in proportion.",
         between(500, 1000)},
        {"figures_at_m", at<&P::figures>, "m", between(0, 1e6), "",
         "extensions at which figures are drawn, with [[stage]] travels",
         "Adds pictures; the listric figures call draws others later, at any snapshot."},
        {"series", one_of<&P::series>({"paraview", "none"}), "", ranges::any, "",
         "files beside each snapshot that ParaView opens",
         "\"none\" saves disk space; snapshots themselves are written in any case."},
        {"report", at<&P::report>, "", ranges::any, "",
         "whether one file for a browser, report.html, is made at the end",
         "false saves some seconds at the end; the listric report call makes it later."},
    };
}

/// A part that every scene has.
template <auto Part>
SceneTable always(std::string_view name, std::string_view doc, std::vector<Parameter> parameters) {
    return {name,
            doc,
            std::move(parameters),
            [](const SceneTable&, const Scene& scene) -> const void* { return &(scene.*Part); },
            [](const SceneTable&, Scene& scene) -> void* { return &(scene.*Part); },
            nullptr};
}

template <auto Part>
SceneTable optional(std::string_view name, std::string_view doc,
                    std::vector<Parameter> parameters) {
    return {name,
            doc,
            std::move(parameters),
            [](const SceneTable&, const Scene& scene) -> const void* {
                return scene.*Part ? &*(scene.*Part) : nullptr;
            },
            [](const SceneTable&, Scene& scene) -> void* {
                return scene.*Part ? &*(scene.*Part) : &(scene.*Part).emplace();
            },
            [](const SceneTable&, Scene& scene) { (scene.*Part).reset(); }};
}

auto part_of(const Effect* effect, auto& scene) {
    return std::ranges::find(scene.effects, effect, &EffectPart::effect);
}

/// The first of several tables, as SceneTable::find and add have it.
const void* first_item(const SceneTable& table, const Scene& scene) {
    return table.items.count(table, scene) == 0 ? nullptr : table.items.get(table, scene, 0);
}
void* first_item_or_new(const SceneTable& table, Scene& scene) {
    if (table.items.count(table, scene) == 0)
        table.items.append(table, scene);
    return table.items.reach(table, scene, 0);
}

/// Tables of an effect that has several.
TableItems items_of_effect() {
    return {[](const SceneTable& table, const Scene& scene) -> std::size_t {
                const auto part = part_of(table.effect, scene);
                return part == scene.effects.end() ? 0
                                                   : table.effect->items->count(part->parameters);
            },
            [](const SceneTable& table, const Scene& scene, std::size_t item) {
                return table.effect->items->get(part_of(table.effect, scene)->parameters, item);
            },
            [](const SceneTable& table, Scene& scene, std::size_t item) {
                return table.effect->items->reach(part_of(table.effect, scene)->parameters, item);
            },
            [](const SceneTable& table, Scene& scene) {
                auto part = part_of(table.effect, scene);
                if (part == scene.effects.end())
                    part = scene.effects.insert(part, {table.effect, table.effect->defaults()});
                table.effect->items->append(part->parameters);
            }};
}

SceneTable single_table_of(const Effect& effect) {
    return {effect.name,
            effect.doc,
            effect.parameters,
            [](const SceneTable& table, const Scene& scene) -> const void* {
                const auto part = part_of(table.effect, scene);
                return part == scene.effects.end() ? nullptr
                                                   : table.effect->address.get(part->parameters);
            },
            [](const SceneTable& table, Scene& scene) -> void* {
                auto part = part_of(table.effect, scene);
                if (part == scene.effects.end())
                    part = scene.effects.insert(part, {table.effect, table.effect->defaults()});
                return table.effect->address.reach(part->parameters);
            },
            [](const SceneTable& table, Scene& scene) {
                std::erase_if(scene.effects,
                              [&](const EffectPart& part) { return part.effect == table.effect; });
            },
            &effect};
}

SceneTable table_of_effect(const Effect& effect) {
    SceneTable table = single_table_of(effect);
    if (effect.items) {
        table.find = first_item;
        table.add = first_item_or_new;
        table.items = items_of_effect();
    }
    return table;
}

template <class Source>
void add_source(std::vector<SceneTable>& tables, std::string_view name,
                std::vector<Parameter> parameters, Source) {
    static const Source defaults;
    const auto table = std::ranges::find(tables, name, &SceneTable::name);
    table->source = std::move(parameters);
    table->source_defaults = &defaults;
}

} // namespace

std::string SceneTable::path(std::size_t number) const {
    return is_array() ? fmt::format("{}[{}]", name, number) : std::string(name);
}

std::string SceneTable::heading() const {
    return is_array() ? fmt::format("[[{}]]", name) : fmt::format("[{}]", name);
}

const std::vector<Parameter>& top_level() {
    static const std::vector<Parameter> parameters = [] {
        std::vector<std::string_view> levels;
        std::ranges::transform(accuracy_levels(), std::back_inserter(levels), &AccuracyLevel::name);
        return std::vector<Parameter>{
            {"name", at<&Heading::name>, "", ranges::any, "",
             "name of the folder of results; default: the file's name",
             "Names the folder below out and the title of figures."},
            {"description", at<&Heading::description>, "", ranges::any, "",
             "subject of the scene, in a line", "Stands in lists of scenes and in the report."},
            {"accuracy", one_of<&Heading::accuracy>(levels), "", ranges::any, "",
             "level that sets the defaults that trade time for detail",
             "Each finer level has smaller discs: narrower faults, and six to eight times the run "
             "time (sandbox: fifteen times that of fine)."},
            {"seed", at<&Heading::seed>, "", between(0, 0x1p63), "", // TOML has no larger
             "seed of all random numbers; each seed is another packing",
             "Another seed moves faults by some 1.5 km: compare five before you trust a place."},
        };
    }();
    return parameters;
}

std::vector<SceneTable> scene_tables(EffectList effects) {
    std::vector<SceneTable> tables{
        always<&Scene::hanging_wall>("hanging_wall",
                                     "the block that slides and breaks, before extension",
                                     hanging_wall_parameters()),
        optional<&Scene::detachment>("detachment", "the surface on which it slides",
                                     detachment_parameters()),
        optional<&Scene::picked_fault>(
            "picked_fault", "written by the program: the points that the detachment was fitted to",
            picked_fault_parameters()),
        optional<&Scene::observed>("observed",
                                   "horizons and faults that the model is compared with",
                                   observed_parameters()),
        optional<&Scene::stretching>(
            "stretching", "in place of a detachment: a flat base that stretches uniformly",
            stretching_parameters()),
        always<&Scene::extension>("extension", "motion of base and right wall",
                                  extension_parameters()),
        always<&Scene::basement>("material", "microproperties of the hanging wall's discs",
                                 material_parameters<>()),
        always<&Scene::cycle>("cycle", "how the equations of motion are solved",
                              cycle_parameters()),
        always<&Scene::output>("output", "snapshots, figures and other files", output_parameters()),
    };
    add_source(tables, "detachment", fault_source_parameters(), FaultSource{});
    add_source(tables, "observed", observed_source_parameters(), ObservedSource{});
    std::ranges::transform(effects, std::back_inserter(tables),
                           [](const Effect* effect) { return table_of_effect(*effect); });
    return tables;
}

} // namespace listric
