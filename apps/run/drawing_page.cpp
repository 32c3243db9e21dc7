#include "apps/run/drawing_page.hpp"

#include "apps/archive/tables/dictionary.hpp"
#include "apps/archive/tables/headline.hpp"
#include "apps/figures/page_parts.hpp"
#include "apps/figures/vocabulary.hpp"
#include "apps/run/drawing.hpp"
#include "apps/run/forecast/prediction.hpp"
#include "apps/scene/toml/file_names.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/scene/toml/schema.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/encoding.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/files/picture.hpp"
#include "apps/support/machine/resources.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>

namespace listric {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

// --------------------------------------------------------------------------- the scene's document

/// A file's name as it reads from everywhere: the page's TOML may be saved in any folder.
void make_absolute(Json& table, std::string_view key, const fs::path& folder) {
    if (!table.is_object() || !table.contains(key) || !table[key].is_string())
        return;
    const std::string name = table[key];
    std::error_code error;
    if (is_path(name) || fs::is_regular_file(folder / name, error))
        table[key] = fs::absolute(folder / name).lexically_normal().string();
}

void make_names_absolute(Json& document, const fs::path& folder, EffectList effects) {
    if (document.contains("materials"))
        for (const RockSource& rock : rock_sources(effects))
            if (is_path(document["materials"].value(rock.key, "")))
                make_absolute(document["materials"], rock.key, folder);
    for (const Effect* effect : effects)
        for (const FileParameter& file : effect->files) {
            if (!document.contains(effect->name))
                continue;
            Json& table = document[effect->name];
            if (!table.is_array())
                make_absolute(table, file.key, folder);
            else
                for (Json& item : table)
                    make_absolute(item, file.key, folder);
        }
}

/// The scene's document with pieces in place of a picked fault, and without picks, which the page
/// has as lines; its picture stays named.
Json drawn_document(const Scene& scene, const SceneRequest& request, const fs::path& folder,
                    EffectList effects) {
    Json document = scene_document(request, effects);
    make_names_absolute(document, folder, effects);
    document.erase("picked_fault");
    if (document.contains("observed")) {
        Json& observed = document["observed"];
        for (const char* key : {"horizons", "faults", "shift_x_m", "horizon_lines", "fault_lines"})
            observed.erase(key);
        make_absolute(observed, "picture", folder);
        if (observed.empty())
            document.erase("observed");
    }
    if (document.contains("detachment")) {
        Json& given = document["detachment"];
        if (scene.picked_fault) {
            given.update(pieces_json(*scene.detachment));
            document["hanging_wall"]["thickness_m"] = scene.hanging_wall.thickness;
        }
        for (const SceneTable& table : scene_tables(effects))
            if (table.name == "detachment")
                for (const Parameter& parameter : table.source)
                    given.erase(parameter.key);
    }
    return document;
}

// ------------------------------------------------------------------------- what the program knows

/// The schema without texts that are put together from the declarations, which it holds too, and
/// without what only those need who check a scene by it.
void keep_for_forms(Json& schema) {
    if (schema.is_object() && schema.contains("x-listric"))
        for (const char* key : {"description", "minimum", "maximum", "exclusiveMinimum",
                                "exclusiveMaximum", "additionalProperties", "required"})
            schema.erase(key);
    if (schema.is_structured())
        for (Json& part : schema)
            keep_for_forms(part);
}

Json schema_of(EffectList effects) {
    Json schema = Json::parse(scene_schema(effects));
    keep_for_forms(schema);
    return schema;
}

Json speed_json(const CycleSpeed& speed) {
    return {{"team", speed.team}, {"one_thread", speed.one_thread}};
}

/// Speeds of the bare cycle on this machine by the size of the packing, ascending.
Json speeds_json(int threads) {
    Json sizes = Json::array();
    for (const int power : {12, 14, 16, 17}) {
        const std::size_t discs = std::size_t{1} << power;
        sizes.push_back(speed_json(measure_speed(discs, threads, 0.05, false)));
        sizes.back()["discs"] = discs;
    }
    const CycleSpeed accounted = measure_speed(std::size_t{1} << 13, 1, 0.05, true);
    return {{"by_size", sizes}, {"accounted", speed_json(accounted)}, {"threads", threads}};
}

Json picture_json(const UnderPicture& picture) {
    const std::string name = shown(picture.file.string());
    std::error_code error;
    if (!fs::is_regular_file(picture.file, error))
        throw UsageError(fmt::format("--over {}: {}", name,
                                     fs::is_directory(picture.file, error)
                                         ? "is a directory, needs a PNG or JPEG"
                                         : "no such file"));
    Picture read;
    try {
        read = read_picture(picture.file);
    } catch (const UsageError& problem) {
        throw UsageError(fmt::format("--over {}", problem.what()));
    }
    const auto* const data = reinterpret_cast<const unsigned char*>(read.bytes.data());
    Json json{{"name", picture.file.filename().string()},
              {"file", fs::absolute(picture.file).lexically_normal().string()},
              {"image", fmt::format("data:image/{};base64,{}", read.type,
                                    base64({data, read.bytes.size()}))}};
    if (picture.corners)
        json["corners_m"] = *picture.corners;
    return json;
}

/// The picture of the call, in the place that the call or the scene has for it, or else the
/// scene's, if it is there.
std::optional<UnderPicture> picture_of(const std::optional<UnderPicture>& asked,
                                       const Scene& scene) {
    if (!scene.observed || scene.observed->picture.empty())
        return asked;
    UnderPicture own{scene.observed->picture, std::array<double, 4>()};
    std::ranges::copy(scene.observed->corners, own.corners->begin());
    std::error_code error;
    if (!asked)
        return fs::is_regular_file(own.file, error) ? std::optional(own) : std::nullopt;
    return asked->corners || asked->file.filename() != own.file.filename()
               ? asked
               : std::optional<UnderPicture>({asked->file, own.corners});
}

// --------------------------------------------------------------------------- the model in the page

/// Five characters for four bytes, of which none begins a tag: shorter than base64 by a sixteenth.
/// Of n bytes at the end n + 1 are written; model.js reads them.
std::string base85(std::string bytes) {
    const std::size_t size = bytes.size();
    bytes.resize((size + 3) / 4 * 4);
    std::string text;
    for (std::size_t k = 0; k < bytes.size(); k += 4) {
        std::uint32_t word = 0;
        for (std::size_t n = k; n < k + 4; ++n)
            word = 256 * word + static_cast<unsigned char>(bytes[n]);
        text.resize(text.size() + 5);
        for (auto digit = text.rbegin(); digit != text.rbegin() + 5; ++digit, word /= 85)
            *digit = static_cast<char>('(' + word % 85);
    }
    text.resize(text.size() - (bytes.size() - size));
    std::ranges::replace(text, '<', '~');
    return text;
}

/// The module as apps/page makes it, compressed, as text; empty: this program has none.
std::string module_text() {
    return base85(read_text_if_there(resource_folder() / "page/listric.wasm.gz"));
}

/// What the licences of the works in the module ask for.
std::string notices_of(const std::string& module) {
    return module.empty() ? "Listric: Apache License 2.0"
                          : as_script(read_text(resource_folder() / "page/notices.txt"));
}

std::string worker_script() {
    const fs::path folder = resource_folder() / "page";
    return as_script(read_text(folder / "module.js") + read_text(folder / "worker.js"));
}

/// Texts of rocks, shipped scenes and records of runs by the paths at which the module looks for
/// them: of a shipped scene the errors are known.
Json files_json(const Scene& scene) {
    Json files = Json::object();
    for (const std::string& name : scenes.names())
        files["/listric/scenes/" + name + ".toml"] = read_text(scenes.find(name));
    std::error_code error;
    for (const fs::path& file : list_folder(record_folder(), error))
        if (file.extension() == ".csv")
            files["/listric/records/" + file.filename().string()] = read_text(file);
    for (const std::string& name : materials.names())
        files["/listric/materials/" + name + ".toml"] = read_text(materials.find(name));
    for (const auto& [key, file] : scene.rocks)
        files[fs::absolute(file).lexically_normal().string()] = read_text(file);
    return files;
}

/// Label and unit of each measure that a run's files may have.
Json measures_json(EffectList effects) {
    Json measures = Json::object();
    for (const archive::DictionaryEntry& entry : archive::dictionary(effects))
        measures[std::string(entry.quantity.name)] = {entry.quantity.label, entry.quantity.unit};
    return measures;
}

} // namespace

std::string drawing_html(const std::string& name, const std::optional<UnderPicture>& picture,
                         int threads, EffectList effects) {
    const SceneRequest request{.scene = name};
    const Scene scene = load_scene(request, effects);
    const fs::path folder = scenes.find(name).parent_path();
    Json data{{"program", "listric " + std::string(version)},
              {"scene", scene.name},
              {"on_shelf", !is_path(name)},
              {"shelf", scenes.names()},
              {"document", drawn_document(scene, request, folder, effects)},
              {"now", scene_facts(scene)}};
    if (scene.observed)
        data["observed"] = {{"horizons", lines_json(scene.observed->horizons)},
                            {"faults", lines_json(scene.observed->faults)}};
    if (scene.picked_fault)
        data["fault_points"] = {{"x_m", scene.picked_fault->x},
                                {"depth_m", scene.picked_fault->depth}};
    if (const auto shown = picture_of(picture, scene))
        data["picture"] = picture_json(*shown);
    data["speeds"] = speeds_json(threads);
    const std::string module = module_text();
    if (!module.empty()) {
        data["files"] = files_json(scene);
        data["measures"] = measures_json(effects);
        for (const archive::Headline& one : archive::headline_of({}))
            data["headline"].push_back(one.key);
        data["sources"] = fmt::format("{} {}", source_hash, measures_hash);
    }
    const fs::path draw = resource_folder() / "figures/draw";
    std::string scripts = read_text(resource_folder() / "page/module.js");
    for (const char* script : {"section.js", "geometry.js", "state.js", "model.js", "forms.js",
                               "tables.js", "gestures.js", "files.js", "../report/values.js",
                               "charts.js", "zip.js", "run.js", "page.js"})
        scripts += read_text(draw / script);
    return filled_page(read_text(draw / "draw.html"),
                       {{"style", read_text(draw / "draw.css")},
                        {"vocabulary", as_data(to_text(vocabulary()))},
                        {"schema", as_data(to_text(schema_of(effects)))},
                        {"data", as_data(to_text(data))},
                        {"module", module},
                        {"worker", module.empty() ? "" : worker_script()},
                        {"page", as_script(scripts)}});
}

} // namespace listric
