#include "apps/scene/scene_file.hpp"

#include "apps/scene/picks/picks_check.hpp"
#include "apps/scene/scene_checks.hpp"
#include "apps/scene/toml/document.hpp"
#include "apps/scene/toml/file_names.hpp"
#include "apps/scene/toml/pieces.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/support/files/reading.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <ranges>
#include <utility>
#include <variant>

namespace listric {

using namespace dem;

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_unknown(const Entry& entry, const std::vector<Parameter>& top,
                               const std::vector<SceneTable>& all) {
    if (entry.path == "flexure")
        fail(entry, "is of a plan of its own, which `listric flexure` takes");
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

void drop_effects(Scene& scene, const std::vector<std::string>& without,
                  const std::vector<SceneTable>& all) {
    std::vector<std::string_view> names, effects;
    for (const SceneTable& table : all) {
        names.push_back(table.name);
        if ((table.effect || table.is_array()) && table.in(scene))
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
        if (!table->effect && !table->is_array())
            refuse("is not an effect and cannot be left out");
        if (std::ranges::find(effects, name) == effects.end())
            refuse("is not in the scene");
        table->drop(*table, scene);
    }
}

/// Refuses a change of what is left out.
void check_changes(const SceneRequest& request) {
    for (const std::string& assignment : request.set) {
        const std::string table = assignment.substr(0, assignment.find_first_of(".= "));
        if (std::ranges::find(request.without, table) != request.without.end())
            fail(
                fmt::format("--set {0}: changes [{1}], which --without {1} leaves out; give one of "
                            "the two",
                            assignment, table));
    }
}

/// A path is relative to where it is written: to the scene's file, or to where the call is made.
std::string located(const std::string& path, const toml::node* node, const fs::path& folder) {
    const bool in_file = node && !node->source().path->starts_with("--");
    return in_file ? (folder / path).string() : path;
}

// ------------------------------------------------------------------------------------- materials

/// Rocks by their key in [materials], read when asked for.
class Rocks {
public:
    Rocks(const toml::table& document, EffectList effects, fs::path folder, bool former)
        : table_(document.get("materials")), folder_(std::move(folder)), former_(former) {
        if (!table_)
            return;
        if (!table_->is_table())
            fail_type({*table_, "materials"}, "table");
        const std::vector<Parameter> names = rock_file_names(effects);
        for (const auto& [key, node] : *table_->as_table()) {
            const Entry entry{node, fmt::format("materials.{}", key.str())};
            const auto declared = std::ranges::find(names, key.str(), &Parameter::key);
            if (declared == names.end())
                fail(entry, fmt::format("unknown key, {}", advice(key.str(), keys(names))));
            read(entry, *declared, &names_[std::string(key.str())]);
        }
    }

    bool is_named(std::string_view key) const { return names_.contains(key); }

    const RockMaterial& of(const RockSource& source) {
        const auto known = rocks_.find(source.key);
        if (known != rocks_.end())
            return known->second;
        const auto named = names_.find(source.key);
        const std::string name(named != names_.end()               ? named->second.file
                               : former_ && !source.former.empty() ? source.former
                                                                   : source.file);
        const toml::node* node = table_ ? table_->as_table()->get(source.key) : nullptr;
        fs::path file;
        try {
            file = materials.find(is_path(name) ? located(name, node, folder_) : name);
        } catch (const SceneError& error) {
            if (node)
                fail({*node, fmt::format("materials.{}", source.key)}, error.what());
            throw;
        }
        files_.emplace(source.key, file);
        return rocks_.emplace(source.key, read_material(file)).first->second;
    }

    /// That have been read, by key.
    const auto& files() const { return files_; }

    /// Warnings of files beside the scene that have the names of rocks on the shelf.
    std::vector<std::string> namesakes() const {
        std::vector<std::string> warnings;
        for (const auto& [key, name] : names_)
            if (std::string warning = materials.namesake(name.file, folder_); !warning.empty())
                warnings.push_back(std::move(warning));
        return warnings;
    }

private:
    const toml::node* table_;
    fs::path folder_;
    bool former_;
    std::map<std::string, FileName, std::less<>> names_;
    std::map<std::string, RockMaterial, std::less<>> rocks_;
    std::map<std::string, fs::path, std::less<>> files_;
};

/// Puts what the material files say where the scene file's tables will then be read.
void take_rocks(Scene& scene, Rocks& rocks, EffectList effects) {
    basement_source.take(scene, rocks.of(basement_source));
    for (const Effect* effect : effects) {
        if (!effect->rock)
            continue;
        if (has_effect(scene, effect->name))
            effect->rock->take(scene, rocks.of(*effect->rock));
        else if (rocks.is_named(effect->rock->key))
            rocks.of(*effect->rock); // an error in what is named is told
    }
}

void check_rocks(const Scene& scene, Rocks& rocks, const toml::table& document) {
    for (const EffectPart& part : scene.effects)
        if (const auto& source = part.effect->rock; source && source->objection)
            if (const std::string why = source->objection(rocks.of(*source)); !why.empty())
                fail(entry_at(document, fmt::format("materials.{}", source->key)), why);
}

// --------------------------------------------------------------------------------------- tables

std::vector<std::string_view> file_keys(const SceneTable& table) {
    std::vector<std::string_view> keys;
    if (table.effect)
        std::ranges::transform(table.effect->files, std::back_inserter(keys), &FileParameter::key);
    std::ranges::transform(table.source, std::back_inserter(keys), &Parameter::key);
    return keys;
}

/// A file that exists. Throws SceneError.
std::string existing(const Entry& entry, const std::string& name, const fs::path& folder) {
    if (name.empty())
        fail(entry, "is empty, needs the path of a file; or leave it out");
    const std::string file = located(name, &entry.node, folder);
    if (is_folder(file))
        fail(entry, fmt::format("{}: is a directory, needs a file", file));
    if (!is_file(file))
        fail(entry, fmt::format("{}: no such file", file));
    return file;
}

constexpr std::string_view no_file = "none";

/// The file that a parameter means. Throws SceneError if there is none.
std::string named_file(const Entry& entry, const std::string& name, const fs::path& folder,
                       FileParameter::Naming naming) {
    if (naming == FileParameter::path || is_path(name))
        return existing(entry, name, folder);
    if (naming == FileParameter::material_or_none && name == no_file)
        return name;
    try {
        return materials.find(name).string();
    } catch (const SceneError& error) {
        fail(entry, error.what());
    }
}

/// Reads the files that a table's parameters name into what they stand for.
void read_files(Scene& scene, const SceneTable& table, const toml::table& document,
                const fs::path& folder) {
    if (!table.effect)
        return;
    const auto read_one = [&](const FileParameter& parameter, std::size_t item) {
        const std::string path = fmt::format("{}.{}", table.path(item), parameter.key);
        const toml::node* node = document.at_path(path).node();
        if (!node)
            return;
        const Entry entry{*node, path};
        FileName given;
        read(entry, file_name(parameter.key, parameter.doc), &given);
        const std::string& name = given.file;
        if (name.empty())
            return;
        const std::string file = named_file(entry, name, folder, parameter.naming);
        if (parameter.naming != FileParameter::material_or_none || file != no_file)
            scene.files.emplace_back(file);
        if (parameter.naming != FileParameter::path && file != no_file)
            scene.rocks.emplace(path, file);
        const Refuse refuse = [&](const std::string& at, const std::string& message) {
            fail(entry_at(document, at), message);
        };
        if (table.is_array())
            parameter.read_item(scene, item, file, refuse);
        else
            parameter.read(scene, file, refuse);
    };
    for (std::size_t item = 0; item < table.count(scene); ++item)
        for (const FileParameter& parameter : table.effect->files)
            read_one(parameter, item);
}

/// The tables [[name]] of a document; fails unless they are such.
const toml::array& tables_at(const SceneTable& table, const toml::node& node) {
    const Entry entry{node, std::string(table.name)};
    const toml::array* all = node.as_array();
    if (!all)
        fail(entry, fmt::format("is of several tables: needs the heading [[{0}]] for each, or "
                                "--set {0}.0.key=value, counted from 0",
                                table.name));
    if (all->empty())
        fail(entry,
             fmt::format("is empty, needs at least one [[{}]]; or leave it out", table.name));
    for (std::size_t item = 0; item < all->size(); ++item)
        if (!all->get(item)->is_table())
            fail_type({*all->get(item), table.path(item)}, "table");
    return *all;
}

/// Reads a document's tables of one name into the scene that has them, with defaults.
void read_tables(Scene& scene, const SceneTable& table, const toml::node& node) {
    if (!table.is_array()) {
        read_table({node, std::string(table.name)}, table.parameters, table.add(table, scene),
                   file_keys(table));
        return;
    }
    for (std::size_t item = 0; item < table.count(scene); ++item)
        read_table({*node.as_array()->get(item), table.path(item)}, table.parameters,
                   table.items.reach(table, scene, item), file_keys(table));
}

/// Reads those keys of a table that are of its source.
void read_source(const SceneTable& table, const toml::table& given, void* source) {
    for (const auto& [key, value] : given)
        if (const auto p = std::ranges::find(table.source, key.str(), &Parameter::key);
            p != table.source.end())
            read({value, fmt::format("{}.{}", table.name, key.str())}, *p, source);
}

/// Reads the picked lines that the document names. A section has one origin: picks are shifted as
/// its fault is, unless they have a shift of their own.
void take_observed(Scene& scene, const SceneTable& table, const toml::table& document,
                   const fs::path& folder, double fault_shift) {
    const toml::node* const node = document.get(table.name);
    if (!node || !node->is_table())
        return;
    const toml::table& given = *node->as_table();
    ObservedSource source;
    read_source(table, given, &source);
    const double shift = source.shift_x.value_or(fault_shift);
    const auto take = [&](const char* key, const std::string& name, PickKind kind,
                          std::vector<PickedLine>& lines) {
        if (!given.contains(key))
            return;
        const Entry entry = entry_at(document, fmt::format("{}.{}", table.name, key));
        const std::string file = existing(entry, name, folder);
        scene.files.emplace_back(file);
        const PickedFile picked = read_picked_lines(file, shift);
        lines = picked.lines;
        check_picks(scene, picked, kind, shift);
    };
    if (std::string& picture = scene.observed->picture; !picture.empty())
        picture = fs::absolute(located(picture, given.get("picture"), folder)).lexically_normal();
    take("horizons", source.horizons, PickKind::horizons, scene.observed->horizons);
    take("faults", source.faults, PickKind::faults, scene.observed->faults);
}

/// Fits the detachment to a picked fault, if the document names one; hanging_wall.thickness_m is
/// then its depth. Returns what is added to every x of the section.
double take_picked_fault(Scene& scene, const SceneTable& table, const toml::table& document,
                         const fs::path& folder) {
    const toml::node* const node = document.get(table.name);
    if (!node || !node->is_table())
        return 0.0;
    const toml::table& given = *node->as_table();
    FaultSource source;
    read_source(table, given, &source);
    const auto refuse_beside = [&](const std::vector<const char*>& keys, const char* why) {
        for (const char* key : keys)
            if (const toml::node* other = given.get(key))
                fail({*other, fmt::format("{}.{}", table.name, key)}, why);
    };
    if (!given.contains("csv"))
        refuse_beside({"csv_delimiter"}, "is of csv, which is not there");
    if (!given.contains("svg"))
        refuse_beside({"svg_path", "svg_points"}, "is of svg, which is not there");
    if (!given.contains("csv") && !given.contains("svg"))
        return source.shift_x;
    if (given.contains("csv"))
        refuse_beside({"svg"}, "stands in place of csv; leave out one");
    refuse_beside({"segments", "start_dip_deg"}, "follows from the picked fault; leave it out");
    const Entry entry =
        entry_at(document, given.contains("csv") ? "detachment.csv" : "detachment.svg");
    const std::string file = existing(entry, source.svg.empty() ? source.csv : source.svg, folder);
    scene.files.emplace_back(file);
    scene.picked_fault =
        fit_detachment(*scene.detachment, read_fault(source, file), source.tolerance);
    scene.hanging_wall.thickness = -detachment_chain(*scene.detachment, 0.0).back().end.y;
    return source.shift_x;
}

/// Reads what stands above the tables, and puts in the tables that are there, with defaults.
void begin_scene(Scene& scene, const toml::table& document, const std::vector<SceneTable>& all) {
    for (const auto& [key, node] : document) {
        const Entry entry{node, std::string(key.str())};
        if (const auto parameter = std::ranges::find(top_level(), key.str(), &Parameter::key);
            parameter != top_level().end())
            read(entry, *parameter, static_cast<Heading*>(&scene));
        else if (key != "materials" &&
                 std::ranges::find(all, key.str(), &SceneTable::name) == all.end())
            fail_unknown(entry, top_level(), all);
    }
    for (const SceneTable& table : all) {
        const toml::node* node = document.get(table.name);
        if (node && table.is_array())
            for (std::size_t item = 0; item < tables_at(table, *node).size(); ++item)
                table.items.append(table, scene);
        else if (node)
            table.add(table, scene);
    }
}

/// Lets defaults that stand for metres of travel follow the rate; what the document states stays.
void follow_rate(Scene& scene, const toml::table& document) {
    for (EffectPart& part : scene.effects)
        for (const Parameter& parameter : part.effect->parameters) {
            const std::string path = fmt::format("{}.{}", part.effect->name, parameter.key);
            if (!parameter.follows_rate || document.at_path(path))
                continue;
            double& value = std::get<Place<double>>(parameter.value)
                                .reach(part.effect->address.reach(part.parameters));
            value = at_rate(parameter, value, scene.extension.rate);
        }
}

void complete_effects(Scene& scene, const toml::table& document) {
    const IsGiven is_given = [&](const std::string& path) {
        return document.at_path(path).node() != nullptr;
    };
    const Refuse refuse = [&](const std::string& path, const std::string& message) {
        fail(entry_at(document, path), message);
    };
    for (const EffectPart& part : scene.effects)
        if (part.effect->complete)
            part.effect->complete(scene, is_given, refuse);
}

/// Warnings of intervals (`interval_a`, `..._interval_a`) that are longer than the scene, so that
/// what effects do every so many years never happens.
std::vector<std::string> warnings_of_never(const Scene& scene) {
    const ExtensionParameters& extension = scene.extension;
    std::vector<std::string> warnings;
    for (const EffectPart& part : scene.effects)
        for (const Parameter& parameter : part.effect->parameters) {
            const auto* place = std::get_if<Place<double>>(&parameter.value);
            if (part.effect->items || !place || !parameter.key.ends_with("interval_a"))
                continue;
            const double interval = place->get(part.effect->address.get(part.parameters));
            const double spacing = Schedule(interval, make_calendar(scene)).due(1).m;
            if (spacing <= extension.distance)
                continue;
            warnings.push_back(fmt::format(
                "{}.{} = {:g} is longer than the scene: the first time would be at {:g} m, it "
                "ends at {:g} m; below {:g} it happens",
                part.effect->name, parameter.key, interval, spacing, extension.distance,
                end_age(scene)));
        }
    return warnings;
}

void set_accuracy(Scene& scene) {
    const AccuracyLevel& level = accuracy_level(scene.accuracy);
    set_level(scene, level);
    for (const EffectPart& part : scene.effects)
        if (part.effect->scale)
            part.effect->scale(scene, level);
}

const SceneTable& table_named(const std::vector<SceneTable>& all, std::string_view name) {
    return *std::ranges::find(all, name, &SceneTable::name);
}

/// What is read of a scene before its parts are compared.
struct Values {
    toml::table document;
    std::vector<SceneTable> all;
    Rocks rocks; ///< looks into the document
    Scene scene = {};
    double shift = 0.0; ///< added to every x of the section, m
};

Values read_values(const SceneRequest& request, const fs::path& path, EffectList effects) {
    toml::table document = merged_document(request, path);
    take_out_former_keys(document, effects);
    std::vector<SceneTable> all = scene_tables(effects);
    Scene scene;
    scene.name = path.stem().string();
    begin_scene(scene, document, all);
    if (!request.is_record)
        check_name(scene, document, path);
    set_accuracy(scene);
    Rocks rocks(document, effects, path.parent_path(), request.former_rocks);
    take_rocks(scene, rocks, effects);
    const double shift =
        take_picked_fault(scene, table_named(all, "detachment"), document, path.parent_path());
    for (const SceneTable& table : all)
        if (const toml::node* node = document.get(table.name))
            read_tables(scene, table, *node);
    return {std::move(document), std::move(all), std::move(rocks), std::move(scene), shift};
}

} // namespace

// ------------------------------------------------------------------------------------- interface

void check_values(const SceneRequest& request, EffectList effects) {
    read_values(request, scenes.find(request.scene), effects);
}

Scene load_scene(const SceneRequest& request, EffectList effects) {
    const fs::path path = scenes.find(request.scene);
    Values values = read_values(request, path, effects);
    Scene& scene = values.scene;
    const toml::table& document = values.document;
    for (const SceneTable& table : values.all)
        read_files(scene, table, document, path.parent_path());
    drop_effects(scene, request.without, values.all);
    check_changes(request);
    if (!request.former_intervals)
        follow_rate(scene, document);
    complete_effects(scene, document);
    check_scene(scene, document, effects);
    std::vector<std::string> warnings = warnings_of_never(scene);
    for (const EffectPart& part : scene.effects)
        if (part.effect->warning)
            warnings.push_back(part.effect->warning(scene));
    for (std::string& warning : warnings)
        if (!warning.empty())
            scene.warnings.push_back(std::move(warning));
    check_rocks(scene, values.rocks, document);
    std::ranges::move(values.rocks.namesakes(), std::back_inserter(scene.warnings));
    take_observed(scene, table_named(values.all, "observed"), document, path.parent_path(),
                  values.shift);
    if (std::string warning = scenes.namesake(request.scene, "."); !warning.empty())
        scene.warnings.push_back(std::move(warning));
    scene.files.push_back(path);
    for (const auto& [key, file] : values.rocks.files()) {
        scene.rocks.emplace(key, file);
        scene.files.push_back(file);
    }
    return std::move(values.scene);
}

std::string scene_name(const SceneRequest& request) {
    const fs::path path = scenes.find(request.scene);
    return merged_document(request, path)["name"].value_or(path.stem().string());
}

void refuse_scene(const SceneRequest& request, const std::string& path,
                  const std::string& message) {
    const toml::table document = merged_document(request, scenes.find(request.scene));
    fail(entry_at(document, path), message);
}

std::string to_toml(const Scene& scene) {
    std::vector<const Effect*> effects;
    std::ranges::transform(scene.effects, std::back_inserter(effects), &EffectPart::effect);
    std::string lines = fmt::format("# All parameters in force.\n\n{}",
                                    write(top_level(), static_cast<const Heading*>(&scene)));
    const FileName none; // the parameters hold the content of files
    for (const SceneTable& table : scene_tables(effects))
        for (std::size_t item = 0; item < table.count(scene); ++item)
            lines += fmt::format("\n{}  # {}\n{}{}", table.heading(), table.doc,
                                 write(table.parameters, table.item(scene, item)),
                                 write(file_names(table), &none));
    return lines;
}

std::string parameter_reference(EffectList effects) {
    Scene scene;
    const Heading heading;
    std::string lines = "At the top of the file\n";
    for (const Parameter& parameter : top_level())
        lines += explain(parameter, &heading);
    lines += "\n[materials]: files of apps/materials by name, others by path\n";
    for (const RockSource& rock : rock_sources(effects)) {
        const FileName name{std::string(rock.file)};
        lines += explain(file_name(rock.key, rock.doc, rock.changes), &name);
    }
    for (const SceneTable& table : scene_tables(effects)) {
        lines += fmt::format("\n{}{}: {}\n", table.heading(), table.effect ? " (effect)" : "",
                             table.doc);
        const void* part = table.add(table, scene);
        for (const Parameter& parameter : table.parameters)
            lines += explain(parameter, part);
        for (const Parameter& parameter : table.source)
            lines += explain(parameter, table.source_defaults);
        const FileName none;
        for (const Parameter& parameter : file_names(table))
            lines += explain(parameter, &none);
    }
    for (const auto kind : {DetachmentSegment::Kind::arc, DetachmentSegment::Kind::line}) {
        const DetachmentSegment segment;
        lines += fmt::format("\nSegment {{{} = {{...}}}} of [detachment]\n",
                             kind == DetachmentSegment::Kind::arc ? "arc" : "line");
        for (const Parameter& parameter : segment_parameters(kind))
            lines += explain(parameter, &segment);
    }
    return lines;
}

std::vector<std::pair<std::string, std::string>> list_scenes() {
    std::vector<std::pair<std::string, std::string>> list;
    for (const std::string& name : scenes.names()) {
        std::string description;
        try {
            const toml::table document = read_document(scenes, scenes.path() / (name + ".toml"));
            description = document["description"].value_or(std::string());
        } catch (const SceneError& error) {
            description = error.what(); // one bad file must not hide the others
        }
        list.emplace_back(name, description);
    }
    return list;
}

} // namespace listric
