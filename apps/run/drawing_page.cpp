#include "apps/run/drawing_page.hpp"

#include "apps/archive/tables/dictionary.hpp"
#include "apps/archive/tables/headline.hpp"
#include "apps/figures/page_parts.hpp"
#include "apps/figures/vocabulary.hpp"
#include "apps/model/model.hpp"
#include "apps/run/forecast/effect_prices.hpp"
#include "apps/run/forecast/prediction.hpp"
#include "apps/scene/scene_checks.hpp"
#include "apps/scene/toml/document.hpp"
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
#include <sstream>

namespace listric {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

// ------------------------------------------------------------------------------- the scene's text

/// A file's name as it reads from everywhere: the page's TOML may be saved in any folder.
void make_absolute(toml::node* node, const fs::path& folder) {
    if (!node || !node->is_string())
        return;
    auto& name = *node->as_string();
    std::error_code error;
    if (is_path(name.get()) || fs::is_regular_file(folder / name.get(), error))
        name = fs::absolute(folder / name.get()).lexically_normal().string();
}

void make_names_absolute(toml::table& document, const fs::path& folder, EffectList effects) {
    const auto at = [&](std::string_view table, std::string_view key) {
        return document.at_path(fmt::format("{}.{}", table, key)).node();
    };
    for (const RockSource& rock : rock_sources(effects))
        if (toml::node* node = at("materials", rock.key))
            if (is_path(node->value_or(std::string())))
                make_absolute(node, folder);
    for (const Effect* effect : effects)
        for (const FileParameter& file : effect->files)
            if (const toml::array* items = document[effect->name].as_array())
                for (std::size_t item = 0; item < items->size(); ++item)
                    make_absolute(at(fmt::format("{}[{}]", effect->name, item), file.key), folder);
            else
                make_absolute(at(effect->name, file.key), folder);
}

toml::array pieces_of(const dem::DetachmentParameters& detachment) {
    toml::array pieces;
    for (const dem::DetachmentSegment& segment : detachment.segments) {
        toml::table piece;
        const bool is_arc = segment.kind == dem::DetachmentSegment::Kind::arc;
        if (is_arc) {
            piece.insert("radius_m", segment.radius);
            piece.insert("end_dip_deg", segment.end_dip);
        } else {
            piece.insert("length_m", segment.length);
        }
        if (segment.start_dip)
            piece.insert("start_dip_deg", *segment.start_dip);
        pieces.push_back(toml::table{{is_arc ? "arc" : "line", piece}});
    }
    return pieces;
}

/// The scene's document with pieces in place of a picked fault, and without picks, which the page
/// has as lines; its picture stays named.
std::string scene_text(const Scene& scene, const fs::path& path, EffectList effects) {
    toml::table document = read_document(scenes, path);
    take_out_former_keys(document, effects);
    make_names_absolute(document, path.parent_path(), effects);
    document.erase("picked_fault");
    if (toml::table* observed = document["observed"].as_table()) {
        for (const char* key : {"horizons", "faults", "shift_x_m", "horizon_lines", "fault_lines"})
            observed->erase(key);
        make_absolute(observed->get("picture"), path.parent_path());
        if (observed->empty())
            document.erase("observed");
    }
    if (toml::table* given = document["detachment"].as_table()) {
        if (scene.picked_fault) {
            given->insert_or_assign("start_dip_deg", scene.detachment->start_dip);
            given->insert_or_assign("segments", pieces_of(*scene.detachment));
            document["hanging_wall"].as_table()->insert_or_assign("thickness_m",
                                                                  scene.hanging_wall.thickness);
        }
        for (const SceneTable& table : scene_tables(effects))
            if (table.name == "detachment")
                for (const Parameter& parameter : table.source)
                    given->erase(parameter.key);
    }
    std::ostringstream text;
    text << document;
    return text.str();
}

Json lines_of(const std::vector<PickedLine>& lines) {
    Json list = Json::array();
    for (const PickedLine& line : lines) {
        list.push_back({{"name", line.name}, {"x_m", line.x}, {"depth_m", line.depth}});
        if (line.age)
            list.back()["age_a"] = *line.age;
    }
    return list;
}

// ------------------------------------------------------------------------- what the program knows

/// The schema without texts that are put together from the declarations, which it holds too.
void drop_descriptions(Json& schema) {
    if (schema.is_object() && schema.contains("x-listric"))
        schema.erase("description");
    if (schema.is_structured())
        for (Json& part : schema)
            drop_descriptions(part);
}

Json schema_of(EffectList effects) {
    Json schema = Json::parse(scene_schema(effects));
    drop_descriptions(schema);
    return schema;
}

Json rock_json(const RockMaterial& rock) {
    return {{"description", rock.description},
            {"normal_stiffness_pa", rock.material.normal_stiffness},
            {"shear_stiffness_pa", rock.material.shear_stiffness},
            {"friction", rock.material.friction}};
}

/// Rocks of the shelf by name, and those of the scene that are on no shelf by the path that its
/// text has.
Json rocks_json(const Scene& scene) {
    Json rocks = Json::object();
    for (const std::string& name : materials.names())
        rocks[name] = rock_json(load_material(name));
    for (const auto& [key, file] : scene.rocks)
        rocks[fs::absolute(file).lexically_normal().string()] = rock_json(read_material(file));
    return rocks;
}

Json terms_json(const PriceTerms& terms) {
    return {{"fixed", terms.fixed},
            {"per_start_disc", terms.per_start_disc},
            {"per_cycle", terms.per_cycle},
            {"per_year", terms.per_year},
            {"per_disc_year", terms.per_disc_year},
            {"per_area_ratio_year", terms.per_area_ratio_year}};
}

/// Defaults of an effect at the levels of accuracy, as far as these change them.
Json scaled_defaults(const Effect& effect) {
    Json levels = Json::object();
    if (!effect.scale)
        return levels;
    for (const AccuracyLevel& level : accuracy_levels()) {
        Scene scene;
        scene.effects.push_back({&effect, defaults_of(effect)});
        std::any before = scene.effects.front().parameters;
        effect.scale(scene, level);
        for (const Parameter& parameter : effect.parameters)
            if (const auto* number = std::get_if<Place<double>>(&parameter.value)) {
                const double now = number->get(object_of(effect, scene.effects.front().parameters));
                if (now != number->get(object_of(effect, before)))
                    levels[std::string(level.name)][std::string(parameter.key)] =
                        in_key_units(now, parameter.per_si);
            }
    }
    return levels;
}

/// Whether the cycle accounts for energy where the effect and what it needs are on.
bool accounts_energy(const Effect& effect, EffectList effects) {
    Scene scene;
    scene.detachment.emplace().segments = {dem::arc_to_dip(0.0, scene.hanging_wall.thickness)};
    const auto add = [&](const Effect* one) {
        if (!has_effect(scene, one->name))
            scene.effects.push_back({one, one->defaults()});
    };
    for (const std::string_view needed : needed_tables(effect, effects))
        for (const Effect* other : effects)
            if (other->name == needed)
                add(other);
    add(&effect);
    return make_parts(scene).accounts_energy;
}

Json effects_json(EffectList effects) {
    Json list = Json::object();
    for (const Effect* effect : effects) {
        const EffectPrice price = effect_price(*effect);
        Json& entry = list[std::string(effect->name)];
        entry = {{"terms", terms_json(price.terms)},
                 {"new_area", price.new_area},
                 {"moves_base", effect->drive_base != nullptr},
                 {"accounts_energy", accounts_energy(*effect, effects)}};
        for (const ParameterPrice& parameter : price.parameters)
            entry["parameters"].push_back({{"key", parameter.key},
                                           {"is_switch", parameter.is_switch},
                                           {"terms", terms_json(parameter.terms)}});
        if (effect->rock)
            entry["rock"] = effect->rock->key;
        if (const Json levels = scaled_defaults(*effect); !levels.empty())
            entry["levels"] = levels;
    }
    return list;
}

Json prices_json() {
    const RunPrices& p = run_prices;
    return {{"cycle", p.cycle},
            {"lists_shared_from", p.lists_shared_from},
            {"list_alone", p.list_alone},
            {"list_shared", p.list_shared},
            {"lists_far_from", p.lists_far_from},
            {"list_far", p.list_far},
            {"genesis", p.genesis},
            {"genesis_crossing", p.genesis_crossing},
            {"window", p.window},
            {"window_disc", p.window_disc},
            {"sample_spacing", p.sample_spacing},
            {"sample_disc", p.sample_disc},
            {"early_figure_disc", p.early_figure_disc},
            {"figures", p.figures},
            {"figures_disc", p.figures_disc},
            {"figures_of_moving_base", p.figures_of_moving_base}};
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

Json levels_json() {
    Json levels = Json::array();
    for (const AccuracyLevel& level : accuracy_levels())
        levels.push_back({{"name", level.name},
                          {"defaults",
                           {{"hanging_wall.mean_radius_m", level.mean_radius},
                            {"extension.speed_m_per_s", level.speed},
                            {"extension.ramp_s", level.ramp},
                            {"cycle.softness", level.softness}}}});
    return levels;
}

/// The scene's prediction in disc-steps, which the page's own is compared with.
Json predicted_json(const Scene& scene) {
    const Prediction p = predict(scene);
    return {{"discs_at_start", p.discs_at_start},
            {"discs_at_end", p.discs_at_end},
            {"time_step_s", p.time_step},
            {"cycles", p.cycles},
            {"work", p.work}};
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

/// The module as apps/page makes it, compressed, in base64; empty: this program has none.
std::string module_text() {
    const std::string bytes = read_text_if_there(resource_folder() / "page/listric.wasm.gz");
    return base64({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
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
    const fs::path path = scenes.find(name);
    const Scene scene = load_scene({.scene = name}, effects);
    Json data{{"program", "listric " + std::string(version)},
              {"scene", scene.name},
              {"on_shelf", !is_path(name)},
              {"shelf", scenes.names()},
              {"toml", scene_text(scene, path, effects)},
              {"basement", basement_source.key},
              {"rocks", rocks_json(scene)},
              {"levels", levels_json()},
              {"effects", effects_json(effects)},
              {"prices", prices_json()},
              {"predicted", predicted_json(scene)}};
    if (scene.observed)
        data["observed"] = {{"horizons", lines_of(scene.observed->horizons)},
                            {"faults", lines_of(scene.observed->faults)}};
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
    const fs::path folder = resource_folder() / "figures/draw";
    const auto joined = [&](std::initializer_list<const char*> names) {
        std::string scripts;
        for (const char* script : names)
            scripts += read_text(folder / script);
        return as_script(scripts);
    };
    return filled_page(
        read_text(folder / "draw.html"),
        {{"style", read_text(folder / "draw.css")},
         {"vocabulary", as_data(to_text(vocabulary()))},
         {"schema", as_data(to_text(schema_of(effects)))},
         {"data", as_data(to_text(data))},
         {"module", module},
         {"worker", module.empty() ? "" : worker_script()},
         {"notices", notices_of(module)},
         {"model", joined({"toml.js", "schema.js", "geometry.js", "kinematics.js", "cost.js"})},
         {"page",
          joined({"section.js", "forms.js", "state.js", "tables.js", "gestures.js", "files.js",
                  "../report/values.js", "charts.js", "zip.js", "run.js", "page.js"})}});
}

} // namespace listric
