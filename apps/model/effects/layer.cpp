#include "apps/scene/parameters/scene_layer.hpp"

#include "apps/model/effect_list.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/scene.hpp"
#include "apps/scene/toml/toml.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/csv.hpp"
#include "apps/support/files/csv_records.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"
#include "dem/base/target_line.hpp"
#include "dem/events/property_update.hpp"
#include "dem/genesis/genesis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace listric::effects::layer {

namespace {

using L = SceneLayer;

/// Layers at most this stiff, over the hanging wall, are soft.
constexpr double soft_from = 0.5;
constexpr std::size_t most_materials = 200;

/// A member of the array of strengths, as a parameter's value.
template <std::size_t k>
constexpr Place<std::optional<double>> strength{
    [](const void* object) -> const std::optional<double>& {
        return static_cast<const L*>(object)->strength[k];
    },
    [](void* object) -> std::optional<double>& { return static_cast<L*>(object)->strength[k]; }};

std::vector<Parameter> parameters() {
    constexpr Range depth = between(0, 1e5);
    constexpr std::string_view of_file = "Stands in place of what the material's file has.";
    constexpr std::string_view of_weak = "Stands in place of what the file of weakens_to has.";
    return {
        {"name", at<&L::name>, "", ranges::any, "", "name in figures, exports and measures",
         "Changes no run."},
        {"top_m", at<&L::top>, "m", depth, "", "depth of its top, if that is level",
         "Raising it buries the layer deeper."},
        {"bottom_m", at<&L::bottom>, "m", depth, "", "depth of its bottom, if that is level",
         "Raising it thickens the layer."},
        {"thickness_m", at<&L::thickness>, "m", ranges::length, "",
         "thickness, in place of a bottom",
         "Below two mean disc diameters rough rock above and below interlocks across the layer.",
         between(300, 1500)},
        {"top", at<&L::top_line>, "", depth, "",
         "points [x, depth] of its top, straight between them",
         "Lets the layer rise, dip and pinch out."},
        {"bottom", at<&L::bottom_line>, "", depth, "", "points [x, depth] of its bottom",
         "Lets the layer's thickness change along the section."},
        {"density_kg_per_m3", at<&L::density>, "kg/m3", ranges::density, "",
         "bulk density of its packing; default: the hanging wall's",
         "Raising it raises the stress below the layer.", between(2200, 2600)},
        {"welded", at<&L::is_welded>, "", ranges::any, "",
         "whether bonds may join it to the rock above and below",
         "false leaves its top and bottom without bonds at all times: planes on which it may "
         "slip."},
        {"permeability_m2", at<&L::permeability>, "m2", between(1e-22, 1e-12), "",
         "permeability across bedding, which was level; needs a table of pore fluid. None: no "
         "water "
         "flows through the layer, and its pressure is that of water at rest",
         "Raising it lets the layer drain the mud on it, and hand pressure sideways.",
         between(1e-18, 1e-13)},
        {"permeability_ratio", at<&L::permeability_ratio>, "", between(0.1, 1000), "",
         "permeability along bedding over that across; default: 1",
         "Raising it lets the layer hand pressure further.", between(1, 10)},
        {"porosity", at<&L::porosity>, "", between(0.01, 0.5), "",
         "pores before extension over volume, where water flows; default: 0.1",
         "Raising it lets the layer take up more water.", between(0.05, 0.25)},
        {"compressibility_per_pa", at<&L::compressibility>, "1/Pa", between(1e-12, 1e-9), "",
         "decrease of its pores over volume by effective stress, where water flows; default: 1e-10",
         "Raising it lets the layer take up more water, and lose more under load.",
         between(1e-11, 3e-10)},
        {"normal_stiffness_pa", at<&L::normal_stiffness>, "Pa", ranges::stiffness, "k_n",
         "normal stiffness of one disc, if not its material's", of_file},
        {"shear_stiffness_pa", at<&L::shear_stiffness>, "Pa", ranges::stiffness, "k_s",
         "shear stiffness of one disc, if not its material's", of_file},
        {"friction", at<&L::friction>, "", ranges::friction, "mu_d",
         "friction of a disc, if not its material's", of_file},
        {"rolling_friction", at<&L::rolling_friction>, "", ranges::friction, "mu_r",
         "resistance to rolling of unbonded contacts, if not its material's", of_file},
        {"tensile_strength_pa", strength<0>, "Pa", ranges::strength, "F_c^n",
         "mean tensile strength of its bonds, if not its material's; none of the four: no bonds",
         of_file},
        {"tensile_strength_sd_pa", strength<1>, "Pa", ranges::strength, "",
         "standard deviation of the tensile strength", of_file},
        {"shear_strength_pa", strength<2>, "Pa", ranges::strength, "F_c^s",
         "mean shear strength of its bonds", of_file},
        {"shear_strength_sd_pa", strength<3>, "Pa", ranges::strength, "",
         "standard deviation of the shear strength", of_file},
        {"strength_is", one_of<&L::strength_is>({"stress", "force"}), "", ranges::any, "",
         "strengths are stresses on the mean disc section, or forces in N", of_file},
        {"weakens", at<&L::weakens>, "", ranges::any, "", "whether fault weakening can weaken it",
         "false is what weakens_to = \"none\" becomes."},
        {"weakened_normal_stiffness_pa", at<&L::weakened_normal_stiffness>, "Pa", ranges::stiffness,
         "", "normal stiffness when weakened; none: as of weakened rock of the hanging wall",
         of_weak},
        {"weakened_shear_stiffness_pa", at<&L::weakened_shear_stiffness>, "Pa", ranges::stiffness,
         "", "shear stiffness when weakened; none: as of weakened rock of the hanging wall",
         of_weak},
        {"weakened_friction", at<&L::weakened_friction>, "", ranges::friction, "",
         "friction when weakened; none: as of weakened rock of the hanging wall", of_weak},
        {"weakened_rolling_friction", at<&L::weakened_rolling_friction>, "", ranges::friction, "",
         "resistance to rolling when weakened; none: as of weakened rock of the hanging wall",
         of_weak},
    };
}

L& item_of(Scene& scene, std::size_t item) { return (*scene.find<SceneLayers>())[item]; }

template <class T> void take(std::optional<T>& into, T value) {
    if (!into)
        into = value;
}

std::string path_of(std::size_t item, std::string_view key) {
    return fmt::format("layer[{}].{}", item, key);
}

/// Refuses what the table itself says about bonds and weakened rock in a scene without them. What
/// the file of its material says of bonds is for scenes that have some.
void refuse_idle(const Scene& scene, const L& layer, std::size_t item, const Refuse& refuse) {
    constexpr std::array<std::string_view, 4> of_bonds{"tensile_strength_pa",
                                                       "tensile_strength_sd_pa",
                                                       "shear_strength_pa", "shear_strength_sd_pa"};
    for (std::size_t k = 0; k < of_bonds.size(); ++k)
        if (layer.strength[k] && !has_effect(scene, "bonds"))
            refuse(path_of(item, of_bonds[k]),
                   "is about bonds, and the scene has none; add [bonds] or leave it out");
    const std::pair<std::string_view, bool> of_weak[] = {
        {"weakened_normal_stiffness_pa", layer.weakened_normal_stiffness.has_value()},
        {"weakened_shear_stiffness_pa", layer.weakened_shear_stiffness.has_value()},
        {"weakened_friction", layer.weakened_friction.has_value()},
        {"weakened_rolling_friction", layer.weakened_rolling_friction.has_value()}};
    const bool is_weakened = std::ranges::any_of(scene.effects, [](const EffectPart& part) {
        return part.effect->rock && part.effect->rock->key == "weakened";
    });
    for (const auto& [key, is_given] : of_weak)
        if (is_given && !is_weakened)
            refuse(path_of(item, key), "is about weakened rock, and the scene has no fault "
                                       "weakening; add its table or leave it out");
}

void take_material(Scene& scene, std::size_t item, const std::string& file, const Refuse& refuse) {
    const RockMaterial rock = read_material(file);
    L& layer = item_of(scene, item);
    refuse_idle(scene, layer, item, refuse);
    take(layer.normal_stiffness, rock.material.normal_stiffness);
    take(layer.shear_stiffness, rock.material.shear_stiffness);
    take(layer.friction, rock.material.friction);
    if (rock.material.rolling_friction > 0.0)
        take(layer.rolling_friction, rock.material.rolling_friction);
    if (!rock.bonds)
        return;
    take(layer.strength[0], rock.bonds->tensile_mean);
    take(layer.strength[1], rock.bonds->tensile_deviation);
    take(layer.strength[2], rock.bonds->shear_mean);
    take(layer.strength[3], rock.bonds->shear_deviation);
    layer.strength_is = rock.bonds->reading;
}

void take_weakened(Scene& scene, std::size_t item, const std::string& file, const Refuse& refuse) {
    L& layer = item_of(scene, item);
    if (file == "none") {
        layer.weakens = false;
        return;
    }
    const RockMaterial rock = read_material(file);
    if (rock.bonds)
        refuse(path_of(item, "weakens_to"),
               fmt::format("{} has bonds, which weakened rock cannot have; give a material without "
                           "[bonds], or \"none\"",
                           rock.name));
    take(layer.weakened_normal_stiffness, rock.material.normal_stiffness);
    take(layer.weakened_shear_stiffness, rock.material.shear_stiffness);
    take(layer.weakened_friction, rock.material.friction);
    if (rock.material.rolling_friction > 0.0)
        take(layer.weakened_rolling_friction, rock.material.rolling_friction);
}

/// Why a point can be in no line of a layer; empty if it can.
std::string objection_to_point(const Scene& scene, dem::Point p) {
    const double length = scene.hanging_wall.length;
    if (p.x < 0.0 || p.x > length)
        return fmt::format("x = {} is outside of the hanging wall, allowed: 0 to {}; beyond its "
                           "points a line is level",
                           text(p.x), text(length));
    if (p.y < 0.0 || p.y > 1e5)
        return fmt::format("depth {} is out of range, allowed: 0 (the original surface) to 1e5{}",
                           text(p.y), p.y < 0.0 ? "; depth is positive down" : "");
    return "";
}

std::vector<dem::Point> read_line(const Scene& scene, const std::string& file) {
    const CsvRows rows =
        read_csv(file, {.numbers = {"x_m", "depth_m"}, .labels = {"name", "line", "segment"}});
    require_one_line(rows, file, "a layer's top or bottom");
    std::vector<dem::Point> points;
    for (std::size_t k = 0; k < rows.size(); ++k)
        points.push_back({rows.columns[0][k], rows.columns[1][k]});
    for (std::size_t k = 0; k < points.size(); ++k)
        if (const std::string why = objection_to_point(scene, points[k]); !why.empty())
            throw SceneError(fmt::format("{}: {}", csv_place(file, rows.line[k]), why));
    for (std::size_t k = 1; k < points.size(); ++k)
        if (points[k].x <= points[k - 1].x)
            throw SceneError(fmt::format("{}: x_m: {} comes after {}; sort the rows by x, each x "
                                         "once",
                                         csv_place(file, rows.line[k]), text(points[k].x),
                                         text(points[k - 1].x)));
    if (points.empty())
        throw SceneError(fmt::format("{}: has no points, needs at least one", file));
    return points;
}

void take_top(Scene& scene, std::size_t item, const std::string& file, const Refuse& refuse) {
    if (!item_of(scene, item).top_line.empty())
        refuse(path_of(item, "top_csv"), "beside top; give one of them");
    item_of(scene, item).top_line = read_line(scene, file);
}

void take_bottom(Scene& scene, std::size_t item, const std::string& file, const Refuse& refuse) {
    if (!item_of(scene, item).bottom_line.empty())
        refuse(path_of(item, "bottom_csv"), "beside bottom; give one of them");
    item_of(scene, item).bottom_line = read_line(scene, file);
}

// ------------------------------------------------------------------------------------- checks

/// Places along the section at which layers are looked at, m.
std::vector<double> places(const Scene& scene, const L& a, const L& b) {
    constexpr int steps = 400;
    const double length = scene.hanging_wall.length;
    std::vector<double> x = a.bends(), more = b.bends();
    x.insert(x.end(), more.begin(), more.end());
    std::erase_if(x, [&](double place) { return place < 0.0 || place > length; });
    for (int k = 0; k <= steps; ++k)
        x.push_back(length * k / steps);
    std::ranges::sort(x);
    return x;
}

void check_line(const Scene& scene, std::size_t item, std::string_view key,
                const std::vector<dem::Point>& line, const Refuse& refuse) {
    for (std::size_t k = 0; k < line.size(); ++k) {
        const auto refuse_point = [&](const std::string& what) {
            refuse(path_of(item, fmt::format("{}[{}]", key, k)), what);
        };
        if (const std::string why = objection_to_point(scene, line[k]); !why.empty())
            refuse_point(why);
        if (k > 0 && line[k].x <= line[k - 1].x)
            refuse_point(fmt::format("is not sorted: x = {} comes after {}; sort the points by x, "
                                     "each x once",
                                     text(line[k].x), text(line[k - 1].x)));
    }
}

void check_bounds(const L& layer, std::size_t item, const Refuse& refuse) {
    const std::string table = fmt::format("layer[{}]", item);
    if (layer.top.has_value() + !layer.top_line.empty() != 1)
        refuse(table, fmt::format("{} has {}, needs one of top_m, top and top_csv", layer.name,
                                  layer.top ? "two tops" : "no top"));
    const int bottoms =
        layer.bottom.has_value() + layer.thickness.has_value() + !layer.bottom_line.empty();
    if (bottoms != 1)
        refuse(table, fmt::format("{} has {}, needs one of thickness_m, bottom_m, bottom and "
                                  "bottom_csv",
                                  layer.name, bottoms == 0 ? "no bottom" : "several bottoms"));
}

/// Advice that makes a layer at least that thick of `discs` discs.
std::string cure(double thickness, double discs) {
    const double radius = 0.5 * thickness / discs;
    for (const AccuracyLevel& level : accuracy_levels())
        if (level.mean_radius <= radius)
            return fmt::format("accuracy = \"{}\" or hanging_wall.mean_radius_m = {:.4g} would do",
                               level.name, std::floor(10.0 * radius) / 10.0);
    return fmt::format("hanging_wall.mean_radius_m = {:.4g} would do", radius);
}

double thickest(const Scene& scene, const L& layer) {
    double greatest = 0.0;
    for (const double x : places(scene, layer, layer))
        greatest = std::max(greatest, layer.bottom_at(x) - layer.top_at(x));
    return greatest;
}

void check_geometry(const Scene& scene, const L& layer, std::size_t item, const Refuse& refuse) {
    const std::string table = fmt::format("layer[{}]", item);
    check_line(scene, item, "top", layer.top_line, refuse);
    check_line(scene, item, "bottom", layer.bottom_line, refuse);
    const dem::Chain base = base_line(make_rigid_base(scene), 0.0);
    bool is_inside = false;
    for (const double x : places(scene, layer, layer)) {
        const double top = layer.top_at(x), bottom = layer.bottom_at(x);
        if (bottom < top)
            refuse(table, fmt::format("{} is upside down at x = {}: its top is {} deep, its bottom "
                                      "{}; exchange them, or end both where it pinches out",
                                      layer.name, text(x), text(top), text(bottom)));
        is_inside |= top < -dem::height_at(base, x);
    }
    if (!is_inside)
        refuse(table, fmt::format("{} is below the detachment everywhere; it is there down to {} m",
                                  layer.name, text(scene.hanging_wall.thickness)));
    const double diameter = 2.0 * scene.hanging_wall.mean_radius;
    if (const double greatest = thickest(scene, layer); greatest < diameter)
        refuse(table, fmt::format("{} is {} m thick, less than a mean disc diameter ({} m); {}",
                                  layer.name, text(greatest), text(diameter), cure(greatest, 1.0)));
}

void check_overlap(const Scene& scene, const SceneLayers& layers, const Refuse& refuse) {
    constexpr double tolerance = 1e-3; // m
    for (std::size_t b = 0; b < layers.size(); ++b)
        for (std::size_t a = 0; a < b; ++a)
            for (const double x : places(scene, layers[a], layers[b])) {
                const double from = std::max(layers[a].top_at(x), layers[b].top_at(x));
                const double to = std::min(layers[a].bottom_at(x), layers[b].bottom_at(x));
                if (to > from + tolerance)
                    refuse(
                        fmt::format("layer[{}]", b),
                        fmt::format("{} overlaps {} at x = {}, from {:.4g} to {:.4g} m of depth; "
                                    "let one end where the other begins",
                                    layers[b].name, layers[a].name, text(x), from, to));
            }
}

void check_water(const Scene& scene, const L& layer, std::size_t item, const Refuse& refuse) {
    const std::pair<std::string_view, bool> of_water[] = {
        {"permeability_ratio", layer.permeability_ratio.has_value()},
        {"porosity", layer.porosity.has_value()},
        {"compressibility_per_pa", layer.compressibility.has_value()}};
    for (const auto& [key, is_given] : of_water)
        if (is_given && !layer.permeability)
            refuse(path_of(item, key),
                   fmt::format("is about water that flows through {}, and none does; give "
                               "permeability_m2, for example 1e-15, or leave it out",
                               layer.name));
    if (layer.permeability && !make_parts(scene).water)
        refuse(path_of(item, "permeability_m2"),
               fmt::format("is {}, and the scene has no water in its pores; add [{}], or leave it "
                           "out",
                           text(*layer.permeability), pore_filler(program_effects()).name));
}

void check_rock(const Scene& scene, const L& layer, std::size_t item, const Refuse& refuse) {
    const std::string table = fmt::format("layer[{}]", item);
    if (!layer.normal_stiffness || !layer.shear_stiffness || !layer.friction)
        refuse(table, fmt::format("{} needs material, a material by name or path, for example "
                                  "\"shale\"",
                                  layer.name));
    const auto given = std::ranges::count_if(layer.strength, [](const auto& s) { return !!s; });
    if (given != 0 && given != std::ssize(layer.strength))
        refuse(table,
               fmt::format(
                   "{} has {} of the four strengths of bonds; give all of tensile_strength_pa, "
                   "tensile_strength_sd_pa, shear_strength_pa and shear_strength_sd_pa, or a "
                   "material with [bonds]",
                   layer.name, given));
    if (!layer.is_welded && !has_effect(scene, "bonds"))
        refuse(path_of(item, "welded"),
               "is about bonds, and the scene has none; add [bonds] or leave it out");
}

void check(const Scene& scene, const Refuse& refuse) {
    const SceneLayers& layers = *scene.find<SceneLayers>();
    if (3 + 2 * layers.size() > most_materials)
        refuse("layer",
               fmt::format("there are {}, which makes {} materials, allowed: {} materials, "
                           "two a layer and three of the hanging wall",
                           layers.size(), 3 + 2 * layers.size(), most_materials));
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const std::string table = fmt::format("layer[{}]", k);
        if (layers[k].name.empty())
            refuse(table, "needs name (name in figures, exports and measures)");
        for (std::size_t other = 0; other < k; ++other)
            if (layers[other].name == layers[k].name)
                refuse(path_of(k, "name"), fmt::format("\"{}\" is the name of two layers; each has "
                                                       "a name of its own",
                                                       layers[k].name));
        check_bounds(layers[k], k, refuse);
        check_rock(scene, layers[k], k, refuse);
        check_water(scene, layers[k], k, refuse);
        check_geometry(scene, layers[k], k, refuse);
    }
    check_overlap(scene, layers, refuse);
}

bool is_soft(const Scene& scene, const L& layer) {
    return *layer.normal_stiffness <= soft_from * scene.basement.normal_stiffness;
}

std::string warning(const Scene& scene) {
    const double diameter = 2.0 * scene.hanging_wall.mean_radius;
    std::string thin;
    double least = std::numeric_limits<double>::infinity();
    for (const L& layer : *scene.find<SceneLayers>())
        if (const double greatest = thickest(scene, layer); greatest < 2.0 * diameter) {
            thin += fmt::format("{}{}", thin.empty() ? "" : ", ", layer.name);
            least = std::min(least, greatest);
        }
    if (thin.empty())
        return "";
    return fmt::format("layers thinner than two mean disc diameters ({} m) hardly slip, since rock "
                       "interlocks across them: {}; {}",
                       text(2.0 * diameter), thin, cure(least, 2.0));
}

// -------------------------------------------------------------------------------------- model

dem::TargetLine line_of(const Scene& scene, const L& layer, double (L::*depth)(double) const) {
    std::vector<double> x = layer.bends();
    if (x.empty())
        x = {0.0, scene.hanging_wall.length};
    std::vector<dem::Point> points;
    for (const double place : x)
        points.push_back({place, -(layer.*depth)(place)});
    return dem::TargetLine(points);
}

std::optional<fluid::PorousRock> pores_of(const L& layer) {
    if (!layer.permeability)
        return {};
    fluid::PorousRock rock;
    rock.porosity = layer.porosity.value_or(rock.porosity);
    rock.compressibility = layer.compressibility.value_or(rock.compressibility);
    rock.flow.permeability.at_fifth = *layer.permeability;
    rock.flow.ratio = layer.permeability_ratio.value_or(1.0);
    return rock;
}

/// How water flows through a layer is nothing to its start.
void as_in_genesis(std::any& parameters) {
    for (L& layer : std::any_cast<SceneLayers&>(parameters)) {
        layer.permeability.reset();
        layer.permeability_ratio.reset();
        layer.porosity.reset();
        layer.compressibility.reset();
    }
}

void contribute(const Scene& scene, ModelParts& parts) {
    const bool is_weakened = parts.detection_circle.has_value();
    for (const L& layer : *scene.find<SceneLayers>()) {
        const auto index = static_cast<std::uint8_t>(parts.materials.size());
        dem::Material rock{*layer.normal_stiffness, *layer.shear_stiffness, *layer.friction};
        rock.rolling_friction = layer.rolling_friction.value_or(0.0);
        rock.is_welded = layer.is_welded;
        rock.is_soft = is_soft(scene, layer);
        rock.bondable = layer.strength[0].has_value();
        if (rock.bondable)
            rock.bonds =
                dem::BondStrength{*layer.strength[0], *layer.strength[1], *layer.strength[2],
                                  *layer.strength[3], layer.strength_is};
        parts.materials.push_back(rock);
        parts.layers.push_back(
            {layer.name,
             index,
             {line_of(scene, layer, &L::top_at), line_of(scene, layer, &L::bottom_at), index,
              layer.density.value_or(scene.hanging_wall.rock_density)},
             pores_of(layer)});
        if (!is_weakened || !layer.weakens)
            continue;
        dem::Material weak = parts.materials[dem::weak];
        weak.normal_stiffness = layer.weakened_normal_stiffness.value_or(weak.normal_stiffness);
        weak.shear_stiffness = layer.weakened_shear_stiffness.value_or(weak.shear_stiffness);
        weak.friction = layer.weakened_friction.value_or(weak.friction);
        weak.rolling_friction = layer.weakened_rolling_friction.value_or(weak.rolling_friction);
        weak.weak_of = index;
        parts.materials.push_back(weak);
    }
}

/// Soft layers keep their volume, also where no fault is weakened.
void add_events(const Scene& scene, const ModelParts& parts, dem::Events& events) {
    const SceneLayers& layers = *scene.find<SceneLayers>();
    const bool any_soft =
        std::ranges::any_of(layers, [&](const L& layer) { return is_soft(scene, layer); });
    if (any_soft && !parts.detection_circle)
        dem::add(events, std::make_unique<dem::PropertyUpdate>(scene.extension.rate,
                                                               parts.physics.gravity));
}

std::string explain(const Scene& scene, EffectList) {
    std::string lines = "layers\n";
    const double diameter = 2.0 * scene.hanging_wall.mean_radius;
    for (const L& layer : *scene.find<SceneLayers>())
        lines += fmt::format(
            "  {}: {:.1f} mean disc diameters thick, {}, {}, friction {:g}\n", layer.name,
            thickest(scene, layer) / diameter, is_soft(scene, layer) ? "soft" : "stiff",
            layer.strength[0] && has_effect(scene, "bonds") ? "bonded" : "unbonded",
            *layer.friction);
    return lines;
}

} // namespace

Works works() { return {}; }

const Effect& effect() {
    static const Effect effect{
        .name = "layer",
        .doc = "a layer of rock of its own before extension",
        .defaults = make_defaults<SceneLayers>,
        .address = address_of<SceneLayers>,
        .parameters = parameters(),
        .items = items_of<L>,
        .files = {{"material",
                   "material, by name or path: microproperties of its discs and strengths of bonds",
                   "Sets stiffness, friction and strength of the layer at once.", nullptr,
                   take_material, FileParameter::material},
                  {"weakens_to",
                   "material that fault weakening makes of it, or \"none\"; default: "
                   "materials.weakened",
                   "\"none\" keeps a layer that is to slip from becoming rougher.", nullptr,
                   take_weakened, FileParameter::material_or_none},
                  {"top_csv", "file with points of its top, in place of top: columns x_m, depth_m",
                   "Stands in place of top.", nullptr, take_top},
                  {"bottom_csv",
                   "file with points of its bottom, in place of bottom: columns x_m, depth_m",
                   "Stands in place of bottom.", nullptr, take_bottom}},
        .in_genesis = true,
        .as_in_genesis = as_in_genesis,
        .check = check,
        .warning = warning,
        .contribute = contribute,
        .add_events = add_events,
        .explain = explain,
    };
    return effect;
}

} // namespace listric::effects::layer
