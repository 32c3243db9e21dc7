#include "apps/scene/tables.hpp"

#include "apps/scene/pieces.hpp"
#include "apps/support/csv.hpp"

#include <algorithm>
#include <iterator>

namespace listric {

using namespace dem;

namespace {

std::vector<Parameter> hanging_wall_parameters() {
    using P = HangingWallParameters;
    return {
        {"length_m", at<&P::length>, "m", ranges::length, "",
         "from the breakaway to the moving wall"},
        {"thickness_m",
         at<&P::thickness>,
         "m",
         {.from = 1e-3, .to = 1e5},
         "",
         "greatest thickness: depth to the flat detachment"},
        {"mean_radius_m",
         at<&P::mean_radius>,
         "m",
         {.from = 1e-3, .to = 1e4},
         "r_d",
         "mean disc radius; its default depends on the accuracy"},
        {"radius_ratio",
         at<&P::radius_ratio>,
         "",
         {.from = 1, .to = 10},
         "r_d^max/r_d^min",
         "largest over smallest disc radius"},
        {"porosity",
         at<&P::porosity>,
         "",
         {.from = 0.1, .to = 0.4},
         "Phi_d",
         "of the closed packing, before gravity is applied"},
        {"rock_density_kg_per_m3", at<&P::rock_density>, "kg/m3", ranges::density, "rho_tot",
         "bulk density of the packing"},
    };
}

std::vector<Parameter> detachment_parameters() {
    using P = DetachmentParameters;
    return {
        {"start_dip_deg", at<&P::start_dip>, "deg", ranges::dip, "", "dip at the breakaway"},
        {"friction", at<&P::friction>, "", ranges::friction, "",
         "between discs and the moving base"},
        {"friction_rule",
         one_of<&P::friction_rule>({"wall", "smaller"}),
         "",
         {},
         "",
         "the detachment's own friction, or the smaller of its and the disc's, as PFC has it"},
        {"segments", at<&P::segments>, "", {}, "", "arcs and lines, from the breakaway down"},
    };
}

std::vector<Parameter> fault_source_parameters() {
    using S = FaultSource;
    constexpr Range far{.from = -1e7, .to = 1e7};
    return {
        {"csv",
         at<&S::csv>,
         "",
         {},
         "",
         "in place of start_dip_deg and segments: a picked fault, columns x_m and depth_m"},
        {"csv_delimiter",
         one_of<&S::csv_delimiter>(csv_delimiters()),
         "",
         {},
         "",
         "between the columns; auto: as the header has it"},
        {"svg", at<&S::svg>, "", {}, "", "in place of csv: a drawing with the fault as a path"},
        {"svg_path", at<&S::svg_path>, "", {}, "", "id or label of the path, line or polyline"},
        {"svg_points", at<&S::svg_points>, "", far, "",
         "two points or more of the drawing and where they are in the section"},
        {"shift_x_m", at<&S::shift_x>, "m", far, "",
         "added to every x, so that the breakaway is at 0"},
        {"tolerance_m",
         at<&S::tolerance>,
         "m",
         {.from = 0.1, .to = 1e4},
         "",
         "how far points may be from the arcs and lines fitted to them"},
    };
}

std::vector<Parameter> picked_fault_parameters() {
    using P = PickedFault;
    return {
        {"misfit_m",
         at<&P::misfit>,
         "m",
         {.from = 0, .to = 1e6},
         "",
         "largest distance of a point from the detachment"},
        {"x_m", at<&P::x>, "m", {.from = -1e7, .to = 1e7}, "", "of the points"},
        {"depth_m", at<&P::depth>, "m", {.from = -1e6, .to = 1e6}, "", "of the points"},
    };
}

std::vector<Parameter> observed_source_parameters() {
    using S = ObservedSource;
    return {
        {"horizons",
         at<&S::horizons>,
         "",
         {},
         "",
         "file with picked horizons: columns name, x_m, depth_m and, if known, age_a"},
        {"faults",
         at<&S::faults>,
         "",
         {},
         "",
         "file with picked faults, which are drawn: columns name, x_m, depth_m"},
        {"shift_x_m",
         at<&S::shift_x>,
         "m",
         {.from = -1e7, .to = 1e7},
         "",
         "added to every x of the picks; default: as detachment.shift_x_m"},
    };
}

std::vector<Parameter> observed_parameters() {
    return {
        {"horizon_lines", at<&Observed::horizons>, "", {}, "", "what the files say"},
        {"fault_lines", at<&Observed::faults>, "", {}, "", "what the files say"},
    };
}

std::vector<Parameter> stretching_parameters() {
    return {
        {"friction", at<&StretchingParameters::friction>, "", ranges::friction, "",
         "between discs and the stretching base"},
    };
}

std::vector<Parameter> extension_parameters() {
    using P = ExtensionParameters;
    return {
        {"distance_m", at<&P::distance>, "m", {.from = 0, .to = 1e6}, "", "total extension"},
        {"rate_m_per_a",
         at<&P::rate>,
         "m/a",
         {.from = 1e-9, .to = 1},
         "",
         "geological extension rate"},
        {"speed_m_per_s",
         at<&P::speed>,
         "m/s",
         {.from = 1e-6, .to = 1e3},
         "",
         "speed in the model, metres per model second; its default depends on the accuracy"},
        {"ramp_s",
         at<&P::ramp>,
         "s",
         {.from = 0, .to = 1e6},
         "",
         "model time over which the speed grows from rest"},
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
         "local non-viscous damping coefficient"},
        {"averaging_time_s",
         at<&P::averaging_time>,
         "s",
         {.from = 0, .to = 1e9},
         "",
         "model time over which a disc's mean motion is taken, which is not damped; 0: PFC's "
         "damping, which holds sinking rock up"},
        {"time_step_safety",
         at<&P::time_step_safety>,
         "",
         {.from = 1e-6, .to = 10},
         "",
         "time step over the stability limit; above 1 is unstable"},
        {"inertial_mass_floor",
         at<&P::inertial_mass_floor>,
         "",
         {.from = 0, .to = 100},
         "",
         "least inertial mass, in mean basement disc masses"},
        {"skin",
         at<&P::skin>,
         "",
         {.from = 1e-3, .to = 10},
         "",
         "margin of the neighbour list, in mean radii"},
    };
}

std::vector<Parameter> output_parameters() {
    using P = OutputParameters;
    return {
        {"interval_m",
         at<&P::interval>,
         "m",
         {.from = 1e-6, .to = 1e6},
         "",
         "extension between snapshots"},
        {"figures_at_m",
         at<&P::figures>,
         "m",
         {.from = 0, .to = 1e6},
         "",
         "extensions at which figures are drawn"},
        {"series",
         one_of<&P::series>({"paraview", "none"}),
         "",
         {},
         "",
         "files beside each snapshot that ParaView opens"},
        {"report", at<&P::report>, "", {}, "", "one file for a browser, report.html, at the end"},
    };
}

std::vector<Parameter> flexure_parameters() {
    using P = FlexureParameters;
    return {
        {"load",
         one_of<&P::load>({"line", "broken", "strip", "sinusoid"}),
         "",
         {},
         "",
         "line load on a continuous plate or on a broken one's end, strip load, sinusoidal load"},
        {"line_load_n_per_m",
         at<&P::line_load>,
         "N/m",
         {.from = 1, .to = 1e15},
         "V",
         "downward; the end of a broken plate carries half of it"},
        {"pressure_pa",
         at<&P::pressure>,
         "Pa",
         {.from = 1, .to = 1e10},
         "",
         "of the strip, downward; amplitude of the sinusoid"},
        {"half_width_m", at<&P::half_width>, "m", {.from = 1, .to = 1e6}, "", "of the strip"},
        {"wavelength_m",
         at<&P::wavelength>,
         "m",
         {.from = 100, .to = 1e7},
         "lambda",
         "of the sinusoid"},
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

SceneTable table_of_effect(const Effect& effect) {
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

template <class Source>
void add_source(std::vector<SceneTable>& tables, std::string_view name,
                std::vector<Parameter> parameters, Source) {
    static const Source defaults;
    const auto table = std::ranges::find(tables, name, &SceneTable::name);
    table->source = std::move(parameters);
    table->source_defaults = &defaults;
}

} // namespace

const std::vector<Parameter>& top_level() {
    static const std::vector<Parameter> parameters = [] {
        std::vector<std::string_view> levels;
        std::ranges::transform(accuracy_levels(), std::back_inserter(levels), &AccuracyLevel::name);
        return std::vector<Parameter>{
            {"name", at<&Scene::name>, "", {}, "", "of results' folder; default: the file's name"},
            {"description", at<&Scene::description>, "", {}, "", "what the scene shows, in a line"},
            {"accuracy",
             one_of<&Scene::accuracy>(levels),
             "",
             {},
             "",
             "sets the defaults that trade time for detail"},
            {"seed",
             at<&Scene::seed>,
             "",
             {.from = 0, .to = 0x1p63},
             "", // TOML has no larger
             "of all random numbers; each seed is another packing"},
        };
    }();
    return parameters;
}

std::vector<SceneTable> scene_tables(EffectList effects) {
    std::vector<SceneTable> tables{
        optional<&Scene::hanging_wall>("hanging_wall",
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
        always<&Scene::output>("output", "what is written when", output_parameters()),
    };
    add_source(tables, "detachment", fault_source_parameters(), FaultSource{});
    add_source(tables, "observed", observed_source_parameters(), ObservedSource{});
    std::ranges::transform(effects, std::back_inserter(tables),
                           [](const Effect* effect) { return table_of_effect(*effect); });
    tables.push_back(optional<&Scene::flexure>(
        "flexure", "a load on the elastic base alone, without discs", flexure_parameters()));
    return tables;
}

} // namespace listric
