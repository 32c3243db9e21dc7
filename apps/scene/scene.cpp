#include "apps/scene/scene.hpp"

#include "apps/scene/document.hpp"
#include "apps/scene/footwall_request.hpp"
#include "apps/scene/material_file.hpp"
#include "apps/scene/target_csv.hpp"
#include "dem/genesis.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>

namespace listric {

using namespace dem;

namespace fs = std::filesystem;

namespace {

constexpr Shelf scenes{"scene",
                       "a scene has at least [hanging_wall] and [detachment] or [stretching], "
                       "or [flexure] and [elastic_base]",
                       "LISTRIC_SCENES", "apps/scenes"};

[[noreturn]] void fail_unknown(const Entry& entry, const std::vector<Parameter>& top,
                               const std::vector<SceneTable>& all) {
    std::vector<std::string_view> allowed = keys(top);
    allowed.push_back("materials");
    std::ranges::transform(all, std::back_inserter(allowed), &SceneTable::name);
    // A parameter that lacks its table is worth recognising; --set damping=0.5 is easily typed.
    std::vector<std::string> meant;
    if (!nearest(entry.path, allowed)) {
        for (const SceneTable& table : all) {
            if (const auto key = nearest(entry.path, keys(table.parameters)))
                meant.push_back(fmt::format("{}.{}", table.name, *key));
        }
    }
    fail(entry,
         fmt::format("unknown {}, {}", entry.node.is_table() ? "table" : "key",
                     meant.empty() ? advice(entry.path, allowed)
                                   : fmt::format("did you mean {}?", fmt::join(meant, " or "))));
}

void drop_effects(const std::vector<std::string>& without, std::vector<SceneTable>& all) {
    std::vector<std::string_view> names, effects;
    for (const SceneTable& table : all) {
        names.push_back(table.name);
        if (table.is_effect && table.in_scene)
            effects.push_back(table.name);
    }
    const std::string in_scene =
        effects.empty() ? "the scene has no effects"
                        : fmt::format("effects in the scene: {}", fmt::join(effects, ", "));
    for (const std::string& name : without) {
        const auto refuse = [&](std::string_view what) {
            fail(fmt::format("--without {}: {} ({})", name, what, in_scene));
        };
        const auto table = std::ranges::find(all, name, &SceneTable::name);
        if (table == all.end()) {
            const auto meant = nearest(name, names);
            refuse(meant ? fmt::format("unknown table, did you mean {}?", *meant)
                         : "unknown table");
        }
        if (!table->is_effect)
            refuse("is not an effect and cannot be left out");
        if (std::ranges::find(effects, name) == effects.end())
            refuse("is not in the scene");
        table->in_scene = false;
    }
}

/// A path is relative to where it is written: to the scene's file, or to where the call is made.
std::string located(const std::string& path, const toml::node* node, const fs::path& folder) {
    const bool in_file = node && !node->source().path->starts_with("--");
    return in_file ? (folder / path).string() : path;
}

// ------------------------------------------------------------------------------------- materials

/// Files of the materials of a scene, by name or path: table [materials].
struct MaterialNames {
    std::string basement = "mat18-b", weakened = "mat18-w", sediment = "sediment";
};

std::vector<Parameter> parameters(MaterialNames& names) {
    return {
        {"basement",
         &names.basement,
         "",
         {},
         "",
         "material file with the defaults of [material] and [bonds]"},
        {"weakened",
         &names.weakened,
         "",
         {},
         "",
         "material file with the defaults of weakened discs in [fault_weakening]"},
        {"sediment",
         &names.sediment,
         "",
         {},
         "",
         "material file with the defaults of sediment discs in [sedimentation]"},
    };
}

/// Puts what the material files say where the scene file's tables will then be read. Returns
/// whether the basement's has bonds.
bool read_materials(Scene& scene, const toml::table& document, const fs::path& folder) {
    MaterialNames names;
    const std::vector<Parameter> declared = parameters(names);
    const toml::node* table = document.get("materials");
    if (table)
        read_table({*table, "materials"}, declared);
    const auto load = [&](const char* key, const std::string& name) {
        const toml::node* node = table ? table->as_table()->get(key) : nullptr;
        fs::path file;
        try {
            file = materials.find(is_path(name) ? located(name, node, folder) : name);
        } catch (const SceneError& error) {
            if (node)
                fail({*node, fmt::format("materials.{}", key)}, error.what());
            throw;
        }
        return read_material(file);
    };
    const auto replace = [&](Material& old, const RockMaterial& rock) {
        const bool bondable = old.bondable; // whether bonds heal is a matter of the effects
        old = rock.material;
        old.bondable = bondable;
    };
    const RockMaterial basement = load("basement", names.basement);
    replace(scene.basement, basement);
    if (basement.bonds)
        *scene.bonds = *basement.bonds;
    replace(scene.fault_weakening->material, load("weakened", names.weakened));
    replace(scene.sedimentation->material, load("sediment", names.sediment));
    return basement.bonds.has_value();
}

// ----------------------------------------------------------------------------------- other files

/// The value at `path`, or else its table, or else the document.
Entry entry_at(const toml::table& document, const std::string& path);

/// Reads the files that parameters name into what they stand for.
void read_files(Scene& scene, const toml::table& document, const fs::path& folder) {
    const auto find = [&](const std::string& name, const std::string& key) {
        const Entry entry = entry_at(document, key);
        const std::string file = located(name, &entry.node, folder);
        std::error_code error;
        if (!fs::is_regular_file(file, error))
            fail(entry, fmt::format("{}: no such file", file));
        return file;
    };
    const auto read_line = [&](std::string& name, const std::string& table,
                               std::vector<TargetStage>& target) {
        if (name.empty())
            return;
        const std::string key = table + ".target_csv";
        if (!target.empty())
            fail(entry_at(document, key), fmt::format("beside {}.target; give one of them", table));
        target = read_target_csv(find(name, key));
        name.clear();
    };
    read_line(scene.target_csv, "sedimentation", scene.sedimentation->target);
    read_line(scene.footwall_target_csv, "footwall_erosion", scene.footwall_erosion->target);
    if (!scene.base_motion_csv.empty()) {
        BaseMotionParameters& motion = *scene.base_motion;
        if (!motion.uplift.empty() || !motion.shift.empty())
            fail(entry_at(document, "base_motion.csv"),
                 "beside base_motion.uplift or shift; give one of them");
        const std::string file = find(scene.base_motion_csv, "base_motion.csv");
        if (csv_has_column(file, "dx_m") || csv_has_column(file, "dy_m")) {
            motion.shift = read_target_csv(file, "dx_m");
            motion.uplift = read_target_csv(file, "dy_m");
        } else {
            motion.uplift = read_target_csv(file, "uplift_m");
        }
        scene.base_motion_csv.clear();
    }
    if (!scene.elastic_base->mesh_file.empty())
        scene.elastic_base->mesh_file =
            fs::absolute(find(scene.elastic_base->mesh_file, "elastic_base.mesh_file")).string();
}

// ------------------------------------------------------------------------- checks between tables

/// The value at `path`, or else its table, or else the document.
Entry entry_at(const toml::table& document, const std::string& path) {
    const std::string table = path.substr(0, path.find('.'));
    const toml::node* node = document.at_path(path).node();
    if (!node)
        node = document.get(table);
    return {node ? *node : document, path};
}

void check_detachment(const Scene& scene, const toml::table& document) {
    constexpr double tolerance = 1.0; // m
    const DetachmentParameters& detachment = *scene.detachment;
    const double thickness = scene.hanging_wall->thickness;
    const Entry entry = entry_at(document, "detachment.segments");
    if (detachment.segments.empty())
        fail(entry, "has no arc and no line, needs at least one, for example "
                    "segments = [{arc = {radius_m = 15000.0, end_dip_deg = 0.0}}]");
    double dip = detachment.start_dip;
    if (const auto first = detachment.segments.front().start_dip; first && *first != dip)
        fail(
            entry_at(document, "detachment.segments"),
            fmt::format("does not join: the first piece has start_dip_deg = {}, but the detachment "
                        "start_dip_deg = {}; both are the dip at the breakaway, give one",
                        text(*first), text(dip)));
    for (const DetachmentSegment& segment : detachment.segments) {
        const double start = segment.start_dip.value_or(dip);
        const bool is_arc = segment.kind == DetachmentSegment::Kind::arc;
        dip = is_arc ? segment.end_dip : start;
        if (is_arc && start == dip)
            fail(entry, fmt::format("has an arc that starts and ends with a dip of {} degrees, "
                                    "needs an end_dip_deg that differs, or a line",
                                    text(dip)));
    }
    if (dip != 0.0)
        fail(entry, fmt::format("ends with a dip of {} degrees, allowed: 0; let the last arc have "
                                "end_dip_deg = 0.0",
                                text(dip)));
    const double depth = -make_base(scene).surfaces.front().chain.back().end.y; // it never rises
    if (std::abs(depth - thickness) > tolerance)
        fail(entry, fmt::format("reaches a depth of {:.1f} m, allowed: hanging_wall.thickness_m = "
                                "{} within {} m; change the thickness, or radii and lengths; an "
                                "arc of radius R from dip a to dip b descends R |cos b - cos a|",
                                depth, text(thickness), tolerance));
    if (!(hanging_wall_area(scene) > 0.0))
        fail(entry, "stays at the surface up to the moving wall, needs to descend before "
                    "hanging_wall.length_m");
}

void check_resolution(const Scene& scene, const toml::table& document) {
    constexpr double fewest = 100, most = 5e6;
    const double radius = scene.hanging_wall->mean_radius;
    const double area = hanging_wall_area(scene);
    // Counted with so many discs that the count's being whole does not matter.
    HangingWallParameters fine = *scene.hanging_wall;
    fine.mean_radius = 1e-4 * std::sqrt(area);
    const double fine_discs = static_cast<double>(disc_count(fine, area));
    const auto radius_for = [&](double discs) {
        return fine.mean_radius * std::sqrt(fine_discs / discs);
    };
    const auto refuse = [&](const char* what, const char* bound, double allowed, double discs) {
        fail(entry_at(document, "hanging_wall.mean_radius_m"),
             fmt::format("too {} ({}), gives {} discs, allowed: at {} {:.4g} ({} discs)", what,
                         text(radius), estimated_discs(scene), bound, allowed, text(discs)));
    };
    // What is advised keeps away from the bound, because it is rounded.
    if (radius > radius_for(fewest))
        refuse("large", "most", 0.999 * radius_for(fewest), fewest);
    if (radius < radius_for(most))
        refuse("small", "least", 1.001 * radius_for(most), most);
}

/// A scene without discs has no effects on discs.
void check_flexure(const Scene& scene, const toml::table& document) {
    Scene copy = scene; // scene_tables() binds variables
    for (const SceneTable& table : scene_tables(copy)) {
        const bool allowed = !table.drop || table.name == "flexure" ||
                             table.name == "elastic_base" || table.name == "gravity";
        if (table.in_scene && !allowed)
            fail(entry_at(document, std::string(table.name)),
                 "needs discs, which a scene with [flexure] does not have; leave out one of the "
                 "two");
    }
    if (document.contains("materials"))
        fail(entry_at(document, "materials"),
             "needs discs, which a scene with [flexure] does not have; leave out one of the two");
    const auto& base = scene.elastic_base;
    if (!base)
        fail(entry_at(document, "flexure"), "needs [elastic_base], the plate that bends; add it");
    if (!(base->mantle_density > base->infill_density))
        fail(entry_at(document, "elastic_base.mantle_density_kg_per_m3"),
             fmt::format("is {}, allowed: above infill_density_kg_per_m3 = {}",
                         text(base->mantle_density), text(base->infill_density)));
    if (!(base->mantle_density >= base->crust_density) ||
        !(base->crust_density >= base->infill_density))
        fail(entry_at(document, "elastic_base.crust_density_kg_per_m3"),
             fmt::format("is {}, allowed: between those of infill ({}) and mantle ({}), for the "
                         "base to float upright",
                         text(base->crust_density), text(base->infill_density),
                         text(base->mantle_density)));
    // Waves shorter than the base is thick do not bend it, and cells would be flat.
    const auto refuse_short = [&](const char* key, double length, double least) {
        if (length < least)
            fail(entry_at(document, std::string("flexure.") + key),
                 fmt::format("too short ({}), allowed: at least {}, {}", text(length), text(least),
                             "a tenth of the elastic thickness"));
    };
    if (scene.flexure->load == FlexureLoad::sinusoid)
        refuse_short("wavelength_m", scene.flexure->wavelength, 0.1 * base->elastic_thickness);
    if (scene.flexure->load == FlexureLoad::strip)
        refuse_short("half_width_m", scene.flexure->half_width, 0.1 * base->elastic_thickness);
}

/// What the footwall itself refuses, before a run prepares anything.
void check_elastic_base(const Scene& scene, const toml::table& document) {
    const ElasticBaseParameters& base = *scene.elastic_base;
    if (!(base.mantle_density >= base.crust_density) ||
        !(base.crust_density >= base.infill_density))
        fail(entry_at(document, "elastic_base.crust_density_kg_per_m3"),
             fmt::format("is {}, allowed: between those of infill ({}) and mantle ({}), for the "
                         "base to float upright",
                         text(base.crust_density), text(base.infill_density),
                         text(base.mantle_density)));
    const double reach =
        scene.hanging_wall->length + 1.5 * scene.extension.distance + scene.hanging_wall->thickness;
    if (!(base.right > reach))
        fail(entry_at(document, "elastic_base.right_m"),
             fmt::format("is {}, allowed: above {}, beyond the right wall's last position",
                         text(base.right), text(reach)));
    if (base.solver != fem::Solver::mumps)
        fail(entry_at(document, "elastic_base.solver"),
             "makes no factors, which a base under discs is condensed with; allowed: mumps");
    if (scene.footwall_erosion && base.infill_density > 0.0)
        fail(entry_at(document, "footwall_erosion"),
             "fills hollows itself; elastic_base.infill_density_kg_per_m3 must be 0 beside it");
    try {
        fem::check(make_footwall_request(scene));
    } catch (const fem::FootwallError& error) {
        fail(entry_at(document, "elastic_base"), error.what());
    }
}

void check_base_motion(const Scene& scene, const toml::table& document) {
    // Discs follow a base that moves as fast as the right wall; much faster is an impact.
    constexpr double fastest = 5.0;
    if (scene.elastic_base)
        fail(entry_at(document, "base_motion"),
             "beside [elastic_base]; the detachment is either prescribed or responds, give one");
    if (scene.base_motion->uplift.empty() && scene.base_motion->shift.empty())
        fail(entry_at(document, "base_motion"), "needs csv, or uplift or shift");
    const double speed = greatest_base_speed(*scene.base_motion, scene.extension.rate);
    if (speed > fastest)
        fail(entry_at(document, "base_motion"),
             fmt::format("moves {:.3g} times as fast as extension, allowed: at most {}; spread it "
                         "over more time, or raise extension.rate_m_per_a",
                         speed, fastest));
}

void check(const Scene& scene, const toml::table& document) {
    const auto needs = [&](const char* table, bool present, const char* needed, bool given) {
        if (present && !given)
            fail(entry_at(document, table),
                 fmt::format("needs [{1}], which the scene does not have; add [{1}] or leave out "
                             "[{0}]",
                             table, needed));
    };
    if (scene.flexure) {
        check_flexure(scene, document);
        return;
    }
    if (!scene.hanging_wall)
        fail(entry_at(document, "hanging_wall"),
             "is missing, every scene needs [hanging_wall] or [flexure]");
    if (scene.detachment && scene.stretching)
        fail(entry_at(document, "stretching"),
             "stands in place of [detachment]; leave out one of the two");
    if (!scene.detachment && !scene.stretching)
        fail(entry_at(document, "hanging_wall"),
             "needs [detachment], the surface on which it slides, or [stretching]; add one");
    if (scene.detachment)
        check_detachment(scene, document);
    needs("elastic_base", scene.elastic_base.has_value(), "detachment",
          scene.detachment.has_value());
    check_resolution(scene, document);
    needs("elastic_base", scene.elastic_base.has_value(), "gravity", scene.gravity.has_value());
    if (scene.elastic_base)
        check_elastic_base(scene, document);
    needs("lower_crust_thinning", scene.lower_crust_thinning.has_value(), "elastic_base",
          scene.elastic_base.has_value());
    needs("basin_water", scene.basin_water.has_value(), "elastic_base",
          scene.elastic_base.has_value());
    needs("footwall_erosion", scene.footwall_erosion.has_value(), "elastic_base",
          scene.elastic_base.has_value());
    if (scene.base_motion)
        check_base_motion(scene, document);
    needs("bond_healing", scene.bond_healing.has_value(), "bonds", scene.bonds.has_value());
    needs("compaction", scene.compaction.has_value(), "sedimentation",
          scene.sedimentation.has_value());
}

} // namespace

// ------------------------------------------------------------------------------------- interface

Scene load_scene(const SceneRequest& request) {
    const fs::path path = scenes.find(request.scene);
    toml::table document = scenes.read(path);
    for (const std::string& assignment : request.set)
        set(document, assignment, "--set " + assignment);
    if (request.accuracy)
        set(document, "accuracy=" + quoted(*request.accuracy), "--accuracy " + *request.accuracy);
    if (request.seed) {
        const std::string seed = std::to_string(*request.seed);
        set(document, "seed=" + seed, "--seed " + seed);
    }

    Scene scene;
    scene.name = path.stem().string();
    const std::vector<Parameter> top = top_level(scene);
    std::vector<SceneTable> all = scene_tables(scene);
    for (const auto& [key, node] : document) {
        const Entry entry{node, std::string(key.str())};
        if (const auto parameter = std::ranges::find(top, key.str(), &Parameter::key);
            parameter != top.end()) {
            read(entry, *parameter);
        } else if (key != "materials" &&
                   std::ranges::find(all, key.str(), &SceneTable::name) == all.end()) {
            fail_unknown(entry, top, all);
        }
    }
    const AccuracyLevel& level =
        *std::ranges::find(accuracy_levels(), scene.accuracy, &AccuracyLevel::name);
    scene.hanging_wall->mean_radius = level.mean_radius;
    scene.elastic_base->cell_size = level.cell_size;
    scene.extension.speed = level.speed;
    const bool can_be_bonded = read_materials(scene, document, path.parent_path());
    for (SceneTable& table : all) {
        if (const toml::node* node = document.get(table.name)) {
            read_table({*node, std::string(table.name)}, table.parameters);
            table.in_scene = true;
        }
    }
    read_files(scene, document, path.parent_path());
    drop_effects(request.without, all);
    for (const SceneTable& table : all) {
        if (!table.in_scene)
            table.drop();
    }
    check(scene, document);
    if (scene.bonds && !can_be_bonded)
        fail(entry_at(document, "materials.basement"),
             "has no [bonds], but the scene does; add [bonds] to the material's file or take it "
             "out of the scene");
    return scene;
}

std::string to_toml(const Scene& scene) {
    Scene copy = scene; // scene_tables() binds variables
    std::string lines = fmt::format("# All parameters in force.\n\n{}", write(top_level(copy)));
    for (const SceneTable& table : scene_tables(copy)) {
        if (table.in_scene)
            lines +=
                fmt::format("\n[{}]  # {}\n{}", table.name, table.doc, write(table.parameters));
    }
    return lines;
}

std::string parameter_reference() {
    Scene scene;
    std::string lines = "At the top of the file\n";
    for (const Parameter& parameter : top_level(scene))
        lines += explain(parameter);
    lines += "\n[materials]: files of apps/materials by name, others by path\n";
    MaterialNames names;
    for (const Parameter& parameter : parameters(names))
        lines += explain(parameter);
    for (const SceneTable& table : scene_tables(scene)) {
        lines += fmt::format("\n[{}]{}: {}\n", table.name, table.is_effect ? " (effect)" : "",
                             table.doc);
        for (const Parameter& parameter : table.parameters)
            lines += explain(parameter);
    }
    for (const auto kind : {DetachmentSegment::Kind::arc, DetachmentSegment::Kind::line}) {
        DetachmentSegment segment;
        segment.kind = kind;
        lines += fmt::format("\nSegment {{{} = {{...}}}} of [detachment]\n",
                             kind == DetachmentSegment::Kind::arc ? "arc" : "line");
        for (const Parameter& parameter : parameters(segment))
            lines += explain(parameter);
    }
    return lines;
}

std::vector<Material> make_materials(const Scene& s) {
    std::vector<Material> materials(3, s.basement);
    if (s.sedimentation)
        materials[sediment] = s.sedimentation->material;
    if (s.fault_weakening)
        materials[weak] = s.fault_weakening->material;
    return materials;
}

RigidBase make_base(const Scene& s) {
    const Extent extent{s.hanging_wall->length, s.hanging_wall->thickness, s.extension.distance};
    const Motion motion{s.extension.speed, s.extension.ramp};
    if (s.stretching)
        return make_stretching_box(*s.stretching, extent, s.basement, motion);
    RigidBase base = make_halfgraben(*s.detachment, extent, s.basement, motion);
    if (s.elastic_base || s.base_motion)
        follow_nodes(base, s.elastic_base ? s.elastic_base->degree : 2);
    return base;
}

double hanging_wall_area(const Scene& scene) {
    const bool has_base =
        scene.stretching || (scene.detachment && !scene.detachment->segments.empty());
    return scene.hanging_wall && has_base
               ? hanging_wall_area(*scene.hanging_wall, make_base(scene).surfaces.front().chain)
               : 0.0;
}

std::size_t estimated_discs(const Scene& scene) {
    return scene.hanging_wall ? disc_count(*scene.hanging_wall, hanging_wall_area(scene)) : 0;
}

std::vector<std::pair<std::string, std::string>> list_scenes() {
    std::vector<std::pair<std::string, std::string>> list;
    for (const std::string& name : scenes.names()) {
        std::string description;
        try {
            const toml::table document = scenes.read(scenes.path() / (name + ".toml"));
            description = document["description"].value_or(std::string());
        } catch (const SceneError& error) {
            description = error.what(); // one bad file must not hide the others
        }
        list.emplace_back(name, description);
    }
    return list;
}

} // namespace listric