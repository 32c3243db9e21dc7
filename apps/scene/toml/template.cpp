#include "apps/scene/toml/template.hpp"

#include "apps/scene/scene_file.hpp"
#include "apps/scene/toml/document.hpp"
#include "apps/scene/toml/file_names.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/support/files/reading.hpp"
#include "apps/support/machine/resources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// A document and the folder that its paths are relative to.
struct Given {
    toml::table document;
    fs::path folder;

    const toml::node* at(std::string_view table, std::string_view key) const {
        return document.at_path(fmt::format("{}.{}", table, key)).node();
    }
    /// A file's name as it reads from everywhere; a name on a shelf stays.
    std::string located(const std::string& file) const {
        return is_path(file) ? fs::absolute(folder / file).lexically_normal().string() : file;
    }
};

std::string commented(const std::string& lines) {
    std::string text;
    std::istringstream all(lines);
    for (std::string line; std::getline(all, line);)
        text += fmt::format("# {}\n", line);
    return text;
}

/// A parameter with its unit and meaning; a comment unless it is given.
std::string line_of(const Parameter& parameter, const void* object, bool is_given) {
    const std::string doc =
        fmt::format("{}{}{}", parameter.unit, parameter.unit.empty() ? "" : ": ", parameter.doc);
    Parameter with_unit = parameter;
    with_unit.doc = doc;
    const std::string lines = write({with_unit}, object);
    return is_given ? lines : commented(lines);
}

/// A parameter that is read and not kept, as it was given; else a comment with its default.
std::string source_line(const Given& given, std::string_view table, const Parameter& parameter,
                        const void* defaults) {
    const toml::node* node = given.at(table, parameter.key);
    if (!node)
        return line_of(parameter, defaults, false);
    std::ostringstream value;
    const auto text = node->value<std::string>();
    const bool names_file = text && std::holds_alternative<Place<std::string>>(parameter.value) &&
                            is_file(given.folder / *text);
    if (names_file)
        value << quoted(fs::absolute(given.folder / *text).lexically_normal().string());
    else
        node->visit([&](const auto& one) { value << one; });
    return fmt::format("{} = {}  # {}\n", parameter.key, value.str(), parameter.doc);
}

std::string materials_of(const Given& given, EffectList effects) {
    std::string lines = "\n# Rock: names of files in apps/materials, or paths.\n[materials]\n";
    for (const RockSource& rock : rock_sources(effects)) {
        const toml::node* node = given.at("materials", rock.key);
        const FileName name{node ? given.located(node->value_or(std::string()))
                                 : std::string(rock.file)};
        lines += line_of(file_name(rock.key, rock.doc), &name, true);
    }
    return lines;
}

std::string table_of(const SceneTable& table, const Scene& scene, const Given& given) {
    std::string lines;
    for (std::size_t item = 0; item < table.count(scene); ++item) {
        const std::string path = table.path(item);
        lines += fmt::format("\n# {}\n{}\n", table.doc, table.heading());
        for (const Parameter& parameter : table.parameters)
            lines += line_of(parameter, table.item(scene, item),
                             given.at(path, parameter.key) != nullptr);
        const FileName none;
        for (const Parameter& parameter : table.source)
            lines += source_line(given, path, parameter, table.source_defaults);
        if (table.effect)
            for (const Parameter& parameter : file_names(table))
                lines += source_line(given, path, parameter, &none);
    }
    return lines;
}

} // namespace

std::string scene_template(const std::string& from, EffectList effects) {
    const fs::path path = scenes.find(from);
    const Scene scene = load_scene({.scene = from}, effects);
    const Given given{read_document(scenes, path), path.parent_path()};
    std::string lines = fmt::format("#:schema file://{}\n"
                                    "# Made from {}. A line that begins with # is a comment: "
                                    "remove the # to set another value\n"
                                    "# than the default, which the line shows. A process is on "
                                    "when its table is here, even if the\n"
                                    "# table is empty.\n\n",
                                    (resource_folder() / "scene.schema.json").string(), scene.name);
    Scene made = scene;
    made.description = "made from " + scene.name;
    for (const Parameter& parameter : top_level())
        if (parameter.key == "description")
            lines += line_of(parameter, &made, true);
        else if (parameter.key != "name") // which is the file's own
            lines += line_of(parameter, &scene, given.document.contains(parameter.key));
    lines += materials_of(given, effects);
    std::string missing;
    for (const SceneTable& table : scene_tables(effects))
        if (given.document.contains(table.name) || table.in(scene))
            lines += table_of(table, scene, given);
        else
            missing += fmt::format("# {:<24}  # {}\n", table.heading(), table.doc);
    return lines +
           "\n# Tables that are not here; `listric explain --parameters` lists their keys.\n" +
           missing;
}

} // namespace listric
