#include "apps/scene/declaration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

namespace listric {

using namespace dem;
using namespace coupling;

namespace {

using listric::parameters;

// Ranges that several parameters share.
constexpr Range years{.from = 1, .to = 1e7};
constexpr Range length{.above = 0, .to = 1e6};
constexpr Range dip{.from = 0, .to = 90, .reason = "else the detachment rises or folds back"};
constexpr Range friction{.from = 0, .to = 10};
constexpr Range stiffness{.from = 1e3, .to = 1e15};
constexpr Range strength{.from = 0, .to = 1e12};
constexpr Range density{.from = 100, .to = 20e3};
constexpr Range strain_rate{.above = 0, .to = 1e-3};

Choice one_of(std::vector<std::string_view> names, std::string& value) {
    return {std::move(names), [&value] { return std::string_view(value); },
            [&value](std::string_view name) { value = name; }};
}

/// The first name means true.
Choice one_of(std::vector<std::string_view> names, bool& value) {
    return {names, [names, &value] { return names[value ? 0 : 1]; },
            [names, &value](std::string_view name) { value = name == names[0]; }};
}

/// `names` in the order of the enumeration.
template <class Enum> Choice one_of(std::vector<std::string_view> names, Enum& value) {
    return {names, [names, &value] { return names[static_cast<std::size_t>(value)]; },
            [names, &value](std::string_view name) {
                value = static_cast<Enum>(std::ranges::find(names, name) - names.begin());
            }};
}

// A parameter keeps to its two lines.
// clang-format off
std::vector<Parameter> parameters(HangingWallParameters& p) {
    return {
        {"length_m", &p.length, "m", length, "", "from the breakaway to the moving wall"},
        {"thickness_m", &p.thickness, "m", {.above = 0, .to = 1e5}, "",
         "greatest thickness: depth to the flat detachment"},
        {"mean_radius_m", &p.mean_radius, "m", {.from = 1e-3, .to = 1e4}, "r_d",
         "mean disc radius; its default depends on the accuracy"},
        {"radius_ratio", &p.radius_ratio, "", {.from = 1, .to = 10}, "r_d^max/r_d^min",
         "largest over smallest disc radius"},
        {"porosity", &p.porosity, "", {.from = 0.1, .to = 0.4}, "Phi_d",
         "of the closed packing, before gravity is applied"},
        {"rock_density_kg_per_m3", &p.rock_density, "kg/m3", density, "rho_tot",
         "bulk density of the packing"},
    };
}

std::vector<Parameter> parameters(DetachmentParameters& p) {
    return {
        {"start_dip_deg", &p.start_dip, "deg", dip, "", "dip at the breakaway"},
        {"friction", &p.friction, "", friction, "", "between discs and the moving base"},
        {"segments", &p.segments, "", {}, "", "arcs and lines, from the breakaway down"},
    };
}

std::vector<Parameter> parameters(StretchingParameters& p) {
    return {
        {"friction", &p.friction, "", friction, "", "between discs and the stretching base"},
    };
}

std::vector<Parameter> parameters(ExtensionParameters& p) {
    return {
        {"distance_m", &p.distance, "m", {.from = 0, .to = 1e6}, "", "total extension"},
        {"rate_m_per_a", &p.rate, "m/a", {.above = 0, .to = 1}, "", "geological extension rate"},
        {"speed_m_per_s", &p.speed, "m/s", {.above = 0, .to = 1e3}, "",
         "speed in the model, metres per model second; its default depends on the accuracy"},
        {"ramp_s", &p.ramp, "s", {.from = 0, .to = 1e6}, "",
         "model time over which the speed grows from rest"},
    };
}

std::vector<Parameter> parameters(CycleParameters& p) {
    return {
        {"damping", &p.damping, "", {.from = 0, .below = 1}, "",
         "local non-viscous damping coefficient"},
        {"time_step_safety", &p.time_step_safety, "", {.above = 0, .to = 10}, "",
         "time step over the stability limit; above 1 is unstable"},
        {"inertial_mass_floor", &p.inertial_mass_floor, "", {.from = 0, .to = 100}, "",
         "least inertial mass, in mean basement disc masses"},
        {"skin", &p.skin, "", {.above = 0, .to = 10}, "",
         "margin of the neighbour list, in mean radii"},
    };
}

std::vector<Parameter> parameters(OutputParameters& p) {
    return {
        {"interval_m", &p.interval, "m", {.from = 1e-6, .to = 1e6}, "", "extension between snapshots"},
        {"figures_at_m", &p.figures, "m", {.from = 0, .to = 1e6}, "",
         "extensions at which figures are drawn"},
        {"series", one_of({"paraview", "none"}, p.series), "", {}, "",
         "files beside each snapshot that ParaView opens"},
    };
}

std::vector<Parameter> parameters(GravityParameters& p) {
    return {
        {"acceleration_m_per_s2", &p.acceleration, "m/s2", {.above = 0, .to = 100}, "g",
         "gravitational acceleration"},
    };
}

std::vector<Parameter> parameters(FaultWeakeningParameters& p) {
    return {
        {"interval_a", &p.interval, "a", years, "Delta t_w", "time between scans for faults"},
        {"strain_rate_per_s", &p.strain_rate, "1/s", strain_rate, "eps_cw",
         "least shear strain rate of a fault"},
        {"circle_diameters", &p.circle_diameters, "", {.from = 2, .to = 100}, "",
         "diameter of the measure circle, in mean disc diameters"},
        {"strained_width", &p.strained_width, "", {.above = 0, .to = 1}, "",
         "width that the strain rate refers to, in circle diameters"},
        {"spacing_diameters", &p.spacing_diameters, "", {.from = 0, .to = 1e3}, "l_csp",
         "least distance to a more active fault, in mean disc diameters"},
        {"band_diameters", &p.band_diameters, "", {.above = 0, .to = 100}, "",
         "width of the weakened band, in mean disc diameters"},
        {"sound_share", &p.sound_share, "", {.from = 0, .to = 1}, "",
         "least share of sound discs in a band that is weakened"},
        {"angles", &p.angles, "", {.from = 2, .to = 360}, "",
         "fault angles tried at each sampling point"},
        {"youngest_sediment_a", &p.youngest_sediment, "a", {.from = 0, .to = 1e9}, "",
         "sediment younger than this is left alone, as loose sediment is"},
        {"normal_stiffness_pa", &p.material.normal_stiffness, "Pa", stiffness, "k_n",
         "normal stiffness of one weakened disc"},
        {"shear_stiffness_pa", &p.material.shear_stiffness, "Pa", stiffness, "k_s",
         "shear stiffness of one weakened disc"},
        {"friction", &p.material.friction, "", friction, "mu_d", "of weakened discs"},
        {"update_interval_a", &p.update_interval, "a", years, "", "time between property updates"},
        {"mean_stress_ratio", &p.mean_stress_ratio, "", {.above = 0, .to = 2}, "",
         "mean stress in a fault over lithostatic stress"},
        {"largest_change", &p.largest_change, "", {.above = 0, .to = 0.5}, "",
         "largest relative change of a radius per property update"},
    };
}

std::vector<Parameter> parameters(BondHealingParameters& p) {
    return {
        {"interval_a", &p.interval, "a", years, "Delta t_h", "time between healings"},
        {"strain_rate_per_s", &p.strain_rate, "1/s", strain_rate, "eps_ch",
         "largest shear strain rate that heals"},
        {"measure", one_of({"slip", "slip_and_opening"}, p.measure), "", {}, "d_h",
         "relative displacement of two discs that forbids healing"},
    };
}

std::vector<Parameter> parameters(SedimentationParameters& p) {
    return {
        {"interval_a", &p.interval, "a", years, "Delta t_s", "time between sedimentations"},
        {"level_m", &p.level, "m", {.from = -1e5, .to = 1e5}, "",
         "of the target, above the original surface, where no target line is given"},
        {"target", &p.target, "", {.from = -1e5, .to = 1e5}, "",
         "target line: points [x, y] in m, or stages {time_a, points}; fills below, erodes above"},
        {"surface_porosity", &p.surface_porosity, "", {.from = 0, .to = 0.9}, "Phi_ini",
         "porosity of fresh sediment"},
        {"grain_density_kg_per_m3", &p.grain_density, "kg/m3", density, "",
         "density of sediment at zero porosity"},
        {"normal_stiffness_pa", &p.material.normal_stiffness, "Pa", stiffness, "k_n",
         "normal stiffness of one sediment disc"},
        {"shear_stiffness_pa", &p.material.shear_stiffness, "Pa", stiffness, "k_s",
         "shear stiffness of one sediment disc"},
        {"friction", &p.material.friction, "", friction, "mu_d", "of sediment discs"},
    };
}

std::vector<Parameter> parameters(CompactionParameters& p) {
    return {
        {"interval_a", &p.interval, "a", years, "Delta t_d", "time between compactions"},
        {"coefficient_per_km", &p.coefficient, "1/km", {.from = 0, .to = 10}, "c",
         "decay of porosity with depth", 1e3},
    };
}

std::vector<Parameter> parameters(EnergyParameters&) { return {}; }

std::vector<Parameter> parameters(ElasticBaseParameters& p) {
    return {
        {"elastic_thickness_m", &p.elastic_thickness, "m", {.from = 100, .to = 2e5}, "",
         "effective elastic thickness Te: rock below it does not carry bending"},
        {"young_modulus_pa", &p.young_modulus, "Pa", {.from = 1e6, .to = 1e13}, "E",
         "Young's modulus of the base"},
        {"poisson_ratio", &p.poisson_ratio, "", {.from = 0, .below = 0.5}, "nu",
         "Poisson's ratio of the base"},
        {"crust_density_kg_per_m3", &p.crust_density, "kg/m3", density, "rho_c",
         "of the base, above the mantle"},
        {"mantle_density_kg_per_m3", &p.mantle_density, "kg/m3", density, "rho_m",
         "of the mantle, on which the base floats"},
        {"infill_density_kg_per_m3", &p.infill_density, "kg/m3", {.from = 0, .to = 20e3}, "",
         "of what fills the deflection: 0 air, 1030 water, 2400 sediment"},
        {"cells", &p.cells, "", {.from = 1, .to = 64}, "",
         "elements through the elastic thickness, in a scene without discs"},
        {"degree", &p.degree, "", {.from = 1, .to = 2}, "",
         "of the elements: 2, or 1 to compare"},
        {"left_m", &p.left, "m", {.from = -1e7, .below = 0}, "", "x of the footwall's far side"},
        {"right_m", &p.right, "m", {.above = 0, .to = 1e7}, "",
         "x of the far side of what lies below the hanging wall"},
        {"depth_m", &p.depth, "m", length, "", "to the mantle, on which the base floats"},
        {"relaxation", &p.relaxation, "", {.from = 1, .to = 1e6}, "",
         "shear modulus over that of rock below the elastic thickness; bulk moduli are the same"},
        {"skin_thickness_m", &p.skin_thickness, "m", {.from = 0, .to = 1e5}, "",
         "rock along the detachment that keeps its shear modulus below the elastic thickness"},
        {"cell_size_m", &p.cell_size, "m", {.above = 0, .to = 1e5}, "",
         "elements at the detachment; its default depends on the accuracy"},
        {"refinements", &p.refinements, "", {.from = 0, .to = 6}, "",
         "times that all elements are halved on top"},
        {"layers", &p.layers, "", {}, "",
         "rock by depth, the first from 0: {top_depth_m, young_modulus_pa, poisson_ratio, density_kg_per_m3}; none: one of the values above"},
        {"mesh_file", &p.mesh_file, "", {}, "",
         "Gmsh mesh (.msh, format 2.2) of the footwall, instead of elements made from the detachment"},
        {"left_side", one_of({"free", "roller", "elastic"}, p.left_side), "", {}, "",
         "nothing holds it, rollers do, or springs like as much rock again"},
        {"right_side", one_of({"free", "roller", "elastic"}, p.right_side), "", {}, "",
         "the same of the other far side"},
        {"solver", one_of({"mumps", "boomeramg", "gamg"}, p.solver), "", {}, "",
         "factors, which a base under discs needs, or multigrid for large ones without discs"},
        {"scheme", one_of({"modal", "lumped", "staggered", "strong"}, p.scheme), "", {}, "",
         "how base and discs advance together"},
        {"update_interval_cycles", &p.update_interval, "", {.from = 1, .to = 1e6}, "",
         "cycles between updates of the base"},
        {"modes", &p.modes, "", {.from = 0, .to = 1e5}, "",
         "softest modes of the base that move in scheme modal; 0: all"},
        {"mass_factor", &p.mass_factor, "", {.from = 0.6, .to = 1e6, .reason = "below, contacts and base are unstable"}, "",
         "modal mass over (stiffness + contact stiffness) times the squared update interval"},
        {"swing_damping", &p.swing_damping, "", {.from = 0, .to = 10}, "",
         "of the modes of scheme modal with the discs they carry, over critical damping"},
        {"disc_damping", one_of({"relative", "absolute"}, p.relative_damping), "", {}, "",
         "against the discs' mean motion, or as PFC does, which holds sinking rock up"},
        {"averaging_time_s", &p.averaging_time, "s", {.above = 0, .to = 1e9}, "",
         "model time over which the mean motion of a disc is taken, for relative damping"},
    };
}

std::vector<Parameter> parameters(LowerCrustThinningParameters& p) {
    return {
        {"thickness_m", &p.thickness, "m", {.above = 0, .to = 1e5}, "",
         "of the lower crust before extension"},
        {"width_m", &p.width, "m", {.from = 1e3, .to = 1e7}, "",
         "over which it stretches by as much as the hanging wall is pulled out"},
        {"centre_m", &p.centre, "m", {.from = -1e7, .to = 1e7}, "",
         "x of its middle before extension"},
    };
}

std::vector<Parameter> parameters(BasinWaterParameters& p) {
    return {
        {"level_m", &p.level, "m", {.from = -1e5, .to = 1e5}, "",
         "of its surface, above the original surface"},
        {"density_kg_per_m3", &p.density, "kg/m3", density, "", "of the water"},
        {"interval_a", &p.interval, "a", years, "", "time between adaptations of its depth"},
    };
}

std::vector<Parameter> parameters(FootwallErosionParameters& p) {
    return {
        {"interval_a", &p.interval, "a", years, "", "time between adaptations of the surface"},
        {"level_m", &p.level, "m", {.from = -1e5, .to = 1e5}, "",
         "of the target, above the original surface, where no target line is given"},
        {"target", &p.target, "", {.from = -1e5, .to = 1e5}, "",
         "target line: points [x, y] in m, or stages {time_a, points}"},
        {"width_m", &p.width, "m", {.from = 4e3, .to = 1e7}, "",
         "of the footwall, left of the breakaway, that is worked on"},
        {"sediment_density_kg_per_m3", &p.sediment_density, "kg/m3", density, "",
         "of what is laid down where the footwall sinks"},
    };
}

std::vector<Parameter> parameters(BaseMotionParameters& p) {
    return {
        {"uplift", &p.uplift, "", {.from = -1e5, .to = 1e5}, "",
         "upward displacement of the detachment: points [x, uplift] in m, or stages {time_a, points}; what counts is the change since time 0"},
        {"shift", &p.shift, "", {.from = -1e5, .to = 1e5}, "", "the same to the right"},
    };
}

std::vector<Parameter> parameters(FlexureParameters& p) {
    return {
        {"load", one_of({"line", "broken", "strip", "sinusoid"}, p.load), "", {}, "",
         "line load on a continuous plate or on a broken one's end, strip load, sinusoidal load"},
        {"line_load_n_per_m", &p.line_load, "N/m", {.above = 0, .to = 1e15}, "V",
         "downward; the end of a broken plate carries half of it"},
        {"pressure_pa", &p.pressure, "Pa", {.above = 0, .to = 1e10}, "",
         "of the strip, downward; amplitude of the sinusoid"},
        {"half_width_m", &p.half_width, "m", {.above = 0, .to = 1e6}, "", "of the strip"},
        {"wavelength_m", &p.wavelength, "m", {.from = 100, .to = 1e7}, "lambda",
         "of the sinusoid"},
    };
}

template <class Part> SceneTable table(std::string_view name, std::string_view doc, Part& part) {
    return {name, doc, false, true, parameters(part), {}};
}

template <class Part>
SceneTable table(std::string_view name, std::string_view doc, std::optional<Part>& part) {
    const bool in_scene = part.has_value();
    if (!in_scene)
        part.emplace();
    return {name, doc, false, in_scene, parameters(*part), [&part] { part.reset(); }};
}

template <class Part>
SceneTable effect(std::string_view name, std::string_view doc, std::optional<Part>& part) {
    SceneTable effect = table(name, doc, part);
    effect.is_effect = true;
    return effect;
}

} // namespace

std::span<const AccuracyLevel> accuracy_levels() {
    static constexpr std::array<AccuracyLevel, 4> levels{
        {{"draft", 186.2, 2000.0, 1.25},
         {"standard", 93.1, 1000.0, 1.0},
         {"fine", 46.55, 500.0, 1.0},
         {"sandbox", 18.62, 500.0, 1.0}}};
    return levels;
}

std::vector<Parameter> top_level(Scene& scene) {
    std::vector<std::string_view> levels;
    std::ranges::transform(accuracy_levels(), std::back_inserter(levels), &AccuracyLevel::name);
    return {
        {"name", &scene.name, "", {}, "", "of results; default: the file's name"},
        {"description", &scene.description, "", {}, "", "what the scene shows, in a line"},
        {"accuracy", one_of(levels, scene.accuracy), "", {}, "",
         "sets the defaults that trade time for detail"},
        {"seed", &scene.seed, "", {.from = 0, .to = 0x1p63}, "", // TOML has no larger integers
         "of all random numbers; each seed is another packing"},
    };
}

std::vector<SceneTable> scene_tables(Scene& scene) {
    SceneTable sedimentation =
        effect("sedimentation", "adapts the surface to a target: deposits below, erodes above",
               scene.sedimentation);
    const Parameter target_csv{"target_csv", &scene.target_csv, "", {}, "",
                               "file with the target line: columns time_a, x_m, y_m; linear between times"};
    sedimentation.parameters.push_back(target_csv);
    SceneTable erosion = effect("footwall_erosion",
                                "the footwall's surface adapts to a target: what rises is eroded, what sinks filled",
                                scene.footwall_erosion);
    erosion.parameters.push_back({"target_csv", &scene.footwall_target_csv, "", {}, "",
                                  "file with the target line: columns time_a, x_m, y_m; linear between times"});
    SceneTable motion = effect("base_motion", "the detachment moves as prescribed; needs no finite elements",
                               scene.base_motion);
    motion.parameters.push_back({"csv", &scene.base_motion_csv, "", {}, "",
                                 "file with the motion: columns time_a, x_m and uplift_m, or dx_m and dy_m"});
    return {
        table("hanging_wall", "the block that slides and breaks, before extension",
              scene.hanging_wall),
        table("detachment", "the surface on which it slides", scene.detachment),
        table("stretching", "in place of a detachment: a flat base that stretches uniformly",
              scene.stretching),
        table("extension", "motion of base and right wall", scene.extension),
        table("material", "microproperties of the hanging wall's discs", scene.basement),
        table("cycle", "how the equations of motion are solved", scene.cycle),
        table("output", "what is written when", scene.output),
        effect("gravity", "weight of the discs", scene.gravity),
        effect("bonds", "contact bonds that make rock of grains", scene.bonds),
        effect("fault_weakening", "automatic fault detection (AFD) with its property update",
               scene.fault_weakening),
        effect("bond_healing", "intelligent crack management (ICM)", scene.bond_healing),
        sedimentation,
        effect("compaction", "sediment loses pore space with burial", scene.compaction),
        effect("energy", "account of where the work goes; then the cycle takes one thread and five times as long",
               scene.energy),
        effect("elastic_base", "footwall and basement bend and float", scene.elastic_base),
        effect("lower_crust_thinning", "the lower crust stretches, mantle rises: isostasy lowers the base",
               scene.lower_crust_thinning),
        effect("basin_water", "water fills the basin and weighs on the footwall",
               scene.basin_water),
        erosion,
        motion,
        table("flexure", "a load on the elastic base alone, without discs", scene.flexure),
    };
}

std::vector<Parameter> parameters(Material& p) {
    return {
        {"normal_stiffness_pa", &p.normal_stiffness, "Pa", stiffness, "k_n",
         "normal stiffness of one disc"},
        {"shear_stiffness_pa", &p.shear_stiffness, "Pa", stiffness, "k_s",
         "shear stiffness of one disc"},
        {"friction", &p.friction, "", friction, "mu_d",
         "of a disc; a contact has the smaller of its two discs'"},
    };
}

std::vector<Parameter> parameters(fem::Layer& p) {
    return {
        {"top_depth_m", &p.top_depth, "m", {.from = 0, .to = 1e6}, "", "where it begins"},
        {"young_modulus_pa", &p.young_modulus, "Pa", {.from = 1e6, .to = 1e13}, "E",
         "Young's modulus"},
        {"poisson_ratio", &p.poisson_ratio, "", {.from = 0, .below = 0.5}, "nu",
         "Poisson's ratio"},
        {"density_kg_per_m3", &p.density, "kg/m3", density, "",
         "for pictures; what carries is crust_density_kg_per_m3"},
    };
}

std::vector<Parameter> parameters(BondStrength& p) {
    return {
        {"tensile_strength_pa", &p.tensile_mean, "Pa", strength, "F_c^n", "mean tensile strength"},
        {"tensile_strength_sd_pa", &p.tensile_deviation, "Pa", strength, "",
         "standard deviation of the tensile strength"},
        {"shear_strength_pa", &p.shear_mean, "Pa", strength, "F_c^s", "mean shear strength"},
        {"shear_strength_sd_pa", &p.shear_deviation, "Pa", strength, "",
         "standard deviation of the shear strength"},
        {"strength_is", one_of({"stress", "force"}, p.reading), "", {}, "",
         "strengths are stresses on the mean disc section, or forces in N"},
    };
}

std::vector<Parameter> parameters(DetachmentSegment& p) {
    const Parameter start_dip{"start_dip_deg", &p.start_dip, "deg", dip, "",
                              "dip at the near end, where the chain has a kink; 0 is flat, 90 straight down"};
    if (p.kind == DetachmentSegment::Kind::line)
        return {{"length_m", &p.length, "m", length, "", "length of the line"}, start_dip};
    return {{"radius_m", &p.radius, "m", length, "", "radius of the arc"},
            {"end_dip_deg", &p.end_dip, "deg", dip, "", "dip at the far end; 0 is flat, 90 straight down"},
            start_dip};
}

// clang-format on

std::string text(const Range& range) {
    std::vector<std::string> bounds;
    const auto add = [&](const char* word, double bound) {
        if (std::isfinite(bound))
            bounds.push_back(fmt::format("{} {}", word, text(bound)));
    };
    add("at least", range.from);
    add("above", range.above);
    add("at most", range.to);
    add("below", range.below);
    return fmt::format("{}", fmt::join(bounds, ", "));
}

std::string text(double number) {
    // fmt turns to powers of ten only from 1e16 on, and 170000000000 is hard to read.
    if (std::abs(number) < 1e6 || !std::isfinite(number))
        return fmt::format("{}", number);
    std::array<char, 32> buffer;
    const auto end =
        std::to_chars(buffer.begin(), buffer.end(), number, std::chars_format::scientific).ptr;
    std::string text(buffer.begin(), end);
    const auto sign = text.find("e+") + 1;
    text.erase(sign, text[sign + 1] == '0' ? 2 : 1); // 1.7e+11: 1.7e11, 2e+06: 2e6
    return text;
}

std::string type_of(const Parameter& parameter) {
    struct {
        std::string operator()(const double*) const { return "number"; }
        std::string operator()(const std::optional<double>*) const { return "number"; }
        std::string operator()(const int*) const { return "integer"; }
        std::string operator()(const std::uint64_t*) const { return "integer"; }
        std::string operator()(const std::string*) const { return "string"; }
        std::string operator()(const Choice& choice) const {
            return fmt::format("one of \"{}\"", fmt::join(choice.names, "\", \""));
        }
        std::string operator()(const std::vector<double>*) const { return "array of numbers"; }
        std::string operator()(const std::vector<DetachmentSegment>*) const {
            return "array of {arc = {...}} and {line = {...}}";
        }
        std::string operator()(const std::vector<TargetStage>*) const {
            return "array of points [x, y], or of {time_a = ..., points = [[x, y], ...]}";
        }
        std::string operator()(const std::vector<fem::Layer>*) const {
            return "array of {top_depth_m = ..., young_modulus_pa = ..., ...}";
        }
    } name;
    return std::visit(name, parameter.variable);
}

namespace {

std::string lower(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return lower;
}

/// Damerau-Levenshtein distance in which no letter moves twice (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before.swap(above);
        above.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row[b.size()];
}

} // namespace

std::optional<std::string_view> nearest(std::string_view name,
                                        std::span<const std::string_view> candidates) {
    constexpr std::size_t longest = 64; // no name of ours is longer
    const std::string typed = lower(name.substr(0, longest));
    std::optional<std::string_view> best;
    std::size_t least = std::max<std::size_t>(1, typed.size() / 3) + 1;
    for (const std::string_view candidate : candidates) {
        // What people forget is the unit.
        const bool lacks_unit = typed.size() > 2 && candidate.starts_with(typed + "_");
        const std::size_t distance = lacks_unit ? 0 : edit_distance(typed, candidate);
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

} // namespace listric
