#include "apps/figures/report_page.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/quality.hpp"
#include "apps/archive/tables/dictionary.hpp"
#include "apps/archive/tables/fault_fields.hpp"
#include "apps/archive/tables/headline.hpp"
#include "apps/figures/page_parts.hpp"
#include "apps/figures/vocabulary.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/toml/differences.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/support/files/encoding.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/files/picture.hpp"
#include "apps/support/machine/resources.hpp"
#include "apps/support/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace listric {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Where dygraphs is: among our own files, for systems that have no package of it, or where
/// Debian's libjs-dygraphs puts it.
fs::path charts_folder() {
    const fs::path own = resource_folder() / "figures/report/dygraphs";
    std::error_code error;
    return fs::is_directory(own, error) ? own : fs::path("/usr/share/javascript/dygraphs");
}

json picks_of(const std::vector<PickedLine>& lines) {
    json list = json::array();
    for (const PickedLine& line : lines) {
        json points = json::array();
        for (std::size_t k = 0; k < line.x.size(); ++k)
            points.push_back({line.x[k], line.depth[k]});
        list.push_back({{"name", line.name}, {"points", std::move(points)}});
    }
    return list;
}

/// Null of what is no JSON object: a page with it could not be read at all.
json object_or_null(const std::string& text) {
    const JsonObject object = parse_json(text);
    return object.is_object() ? json(object) : json();
}

/// Answers to "Is this run good?" by the summary; none before the run has ended.
json quality_of(const ReportPage::Run& run) {
    json list = json::array();
    for (const archive::QualityCheck& check : archive::quality_checks(
             parse_json(run.summary), {.base_moves = run.base_moves,
                                      .mean_radius = run.mean_radius,
                                      .base_friction = base_friction(run.scene)}))
        list.push_back({{"key", check.key},
                        {"label", check.label},
                        {"value", check.value},
                        {"bound", check.bound},
                        {"verdict", archive::name_of(check.verdict)},
                        {"words", check.words}});
    return list;
}

/// Parameters in which two runs differ, as `listric diff` has them.
json differences_of(const Scene& first, const Scene& second, EffectList effects) {
    json list = json::array();
    for (const SceneDifference& one : scene_differences(first, second, effects))
        list.push_back({one.path, one.first, one.second, one.unit});
    return list;
}

/// All of a run but its moments.
/// Corners of age over travel, m and a, up to the end.
json ages_of(const Scene& scene) {
    const dem::Calendar calendar = make_calendar(scene);
    json ages{{0.0, 0.0}};
    const auto add = [&](dem::Travel travel) { ages.push_back({travel.m, calendar.age(travel)}); };
    for (const dem::SteppedPause& pause : calendar.pauses())
        for (const dem::Travel travel : {pause.start, pause.end()})
            if (travel.m > 0.0)
                add(travel);
    const dem::Travel last(ages.back()[0].get<double>());
    add(std::max(dem::Travel(scene.extension.distance), last + dem::Travel(1.0)));
    return ages;
}

json head_of(const ReportPage::Run& run) {
    const Scene& scene = run.scene;
    json head{{"scene", scene.name},
              {"description", scene.description},
              {"rock", rock_line(scene, run.rocks)},
              {"accuracy", scene.accuracy},
              {"seed", scene.seed},
              {"has_detachment", scene.detachment.has_value()},
              {"layers", declared_layers(scene)},
              {"settling", settling_of(scene)},
              {"length_m", scene.hanging_wall.length},
              {"thickness_m", scene.hanging_wall.thickness},
              {"extension_m", greatest_extension(scene)},
              {"ages", ages_of(scene)},
              {"mean_radius_m", run.mean_radius},
              {"scales", json::parse(report_scales(run.mean_radius))},
              {"history", run.history},
              {"summary", object_or_null(run.summary)},
              {"quality", quality_of(run)}};
    if (has_effect(scene, "layer"))
        for (const LayerFacts& layer : make_parts(scene).layers)
            head["rock_layers"].push_back(layer.name);
    if (scene.observed)
        head["picks"] = {{"horizons", picks_of(scene.observed->horizons)},
                         {"faults", picks_of(scene.observed->faults)}};
    return head;
}

json underlay_of(const Underlay& underlay) {
    const Picture picture = read_picture(underlay.image);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(picture.bytes.data());
    return {{"image", fmt::format("data:image/{};base64,{}", picture.type,
                                  base64({bytes, picture.bytes.size()}))},
            {"corners_m", {underlay.left, underlay.top, underlay.right, underlay.bottom}}};
}

/// The program's effects and the runs' own.
std::vector<const Effect*> effects_of(const ReportPage& page) {
    std::vector<const Effect*> all(program_effects().begin(), program_effects().end());
    for (const ReportPage::Run& run : page.runs)
        for (const EffectPart& part : run.scene.effects)
            if (std::ranges::find(all, part.effect) == all.end())
                all.push_back(part.effect);
    return all;
}

/// "dip at birth (°)"
std::string label_of(const archive::FaultField& field) {
    if (field.unit.empty() || field.unit == "1")
        return std::string(field.label);
    return fmt::format("{} ({})", field.label, field.unit == "deg" ? "°" : field.unit);
}

std::string data_of(const ReportPage& page) {
    json head{{"program", "listric " + std::string(version)},
              {"left_out", page.left_out},
              {"lacks", lacks_of(page)},
              {"live", page.live}};
    const std::vector<const Effect*> effects = effects_of(page);
    for (const archive::DictionaryEntry& entry : archive::dictionary(effects)) {
        const Quantity& quantity = entry.quantity;
        head["definitions"].emplace(quantity.name, quantity.doc);
        head["measures"].emplace(quantity.name, json{entry.table, quantity.unit, quantity.label});
    }
    for (const archive::Headline& one : archive::headline_of({}))
        head["headline"].push_back(one.key);
    if (page.runs.size() == 2)
        head["differences"] = differences_of(page.runs[0].scene, page.runs[1].scene, effects);
    for (const archive::FaultField* field : archive::exported_fault_fields())
        if (!field->label.empty())
            head["fault_columns"].push_back(
                {{"name", field->name}, {"label", label_of(*field)}, {"doc", field->doc}});
    if (page.underlay)
        head["underlay"] = underlay_of(*page.underlay);
    std::string runs;
    for (const ReportPage::Run& run : page.runs) {
        std::string text = to_text(head_of(run));
        text.pop_back(); // the moments are text already
        runs += fmt::format("{}{},\"moments\":{}}}", runs.empty() ? "" : ",\n", text,
                            run.moments.json());
    }
    std::string text = to_text(head);
    text.pop_back();
    return as_data(fmt::format("{},\"runs\":[{}]}}", text, runs));
}

} // namespace

std::vector<std::string> lacks_of(const ReportPage& page) {
    std::vector<std::string> lacks;
    for (const ReportPage::Run& run : page.runs) {
        const bool ended = !run.summary.empty() || run.has_summary;
        if (ended && object_or_null(run.summary).is_null())
            lacks.push_back(run.folder +
                            "summary.json is damaged, so that measures at the end are missing");
    }
    return lacks;
}

std::string report_html(const ReportPage& page) {
    const fs::path folder = resource_folder() / "figures/report";
    std::string scripts;
    for (const char* name :
         {"data.js", "colours.js", "painter.js", "section.js", "charts.js", "strata.js",
          "gestures.js", "tables.js", "files.js", "values.js", "words.js", "address.js", "page.js"})
        scripts += read_text(folder / name);
    const std::map<std::string, std::string> parts{
        {"style", read_text(folder / "report.css")},
        {"charts_style", read_text_if_there(charts_folder() / "dygraph.min.css")},
        {"charts", as_script(read_text_if_there(charts_folder() / "dygraph.min.js"))},
        {"vocabulary", as_data(to_text(vocabulary()))},
        {"data", data_of(page)},
        {"frames", page.live ? "; frame-src file: 'self'" : ""},
        {"scripts", as_script(scripts)}};
    return filled_page(read_text(folder / "report.html"), parts);
}

} // namespace listric
