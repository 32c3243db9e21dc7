#include "apps/run/drawing.hpp"

#include "apps/measures/basin/kinematics.hpp"
#include "apps/model/model.hpp"
#include "apps/run/forecast/prediction.hpp"
#include "apps/scene/parameters/accuracy.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/picks/picked_fault.hpp"
#include "apps/scene/scene_checks.hpp"
#include "apps/scene/toml/document.hpp"
#include "apps/scene/toml/json_document.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/support/error.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace listric {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char* drawn_file = "/drawn.toml"; ///< as which messages know what is no file

Json prediction_json(const Scene& scene) {
    const Prediction p = predict(scene);
    return {{"discs_at_start", p.discs_at_start},
            {"discs_at_end", p.discs_at_end},
            {"time_step_s", p.time_step},
            {"cycles", p.cycles},
            {"work", p.work},
            {"shared_work", p.shared_work},
            {"memory_bytes", p.memory}};
}

/// At its own accuracy a scene is as it is.
Json levels_json(const Scene& scene) {
    Json levels = Json::array();
    for (const AccuracyLevel& level : accuracy_levels()) {
        const Scene other = level.name == scene.accuracy ? scene : at_level(scene, level);
        levels.push_back({{"name", level.name},
                          {"radius_m", other.hanging_wall.mean_radius},
                          {"prediction", prediction_json(other)}});
    }
    return levels;
}

/// Those keys of a page's [detachment] that parameters declare, put into their object.
void read_detachment(const Json& given, const std::vector<Parameter>& parameters, void* object,
                     EffectList effects) {
    const toml::table document = parse(toml_text({{"detachment", given}}, effects), drawn_file);
    for (const auto& [key, node] : *document["detachment"].as_table())
        if (const auto p = std::ranges::find(parameters, key.str(), &Parameter::key);
            p != parameters.end())
            read({node, "detachment." + std::string(key.str())}, *p, object);
}

SceneTable detachment_table(EffectList effects) {
    const std::vector<SceneTable> all = scene_tables(effects);
    return *std::ranges::find(all, "detachment", &SceneTable::name);
}

dem::DetachmentParameters detachment_of(const Json& given, EffectList effects) {
    dem::DetachmentParameters detachment;
    read_detachment(given, detachment_table(effects).parameters, &detachment, effects);
    if (const std::string why = objection_to_pieces(detachment); !why.empty())
        throw SceneError("detachment.segments: " + why);
    return detachment;
}

/// x, y, x, y, ... in units.
Json curves_json(const std::vector<std::vector<dem::Point>>& curves, double unit) {
    Json list = Json::array();
    for (const std::vector<dem::Point>& curve : curves) {
        Json numbers = Json::array();
        for (const dem::Point p : curve) {
            numbers.push_back(std::llround(p.x / unit));
            numbers.push_back(std::llround(p.y / unit));
        }
        list.push_back(std::move(numbers));
    }
    return list;
}

Json place_json(dem::Point p) { return {{"x", p.x}, {"depth", -p.y}}; }

} // namespace

Json scene_facts(const Scene& scene) {
    const std::string text = to_toml(scene);
    Json in_force = json_of(parse(text, drawn_file));
    for (const char* picks : {"observed", "picked_fault"}) // which the page has as lines
        in_force.erase(picks);
    return {{"name", scene.name},
            {"accuracy", scene.accuracy},
            {"seed", scene.seed},
            {"distance_m", scene.extension.distance},
            {"greatest_extension_m", greatest_extension(scene)},
            {"accounts_energy", make_parts(scene).accounts_energy},
            {"warnings", scene.warnings},
            {"toml", text},
            {"in_force", in_force},
            {"levels", levels_json(scene)}};
}

Json scene_document(const SceneRequest& request, EffectList effects) {
    toml::table document = merged_document(request, scenes.find(request.scene));
    take_out_former_keys(document, effects);
    return json_of(document);
}

Json value_facts(const SceneRequest& request, const std::string& path, EffectList effects) {
    const toml::table document = merged_document(request, scenes.find(request.scene));
    const toml::node* node = document.at_path(path).node();
    Json facts{{"value", node ? json_of(*node) : Json()}, {"fault", ""}};
    try {
        check_values(request, effects);
    } catch (const SceneError& error) {
        facts["fault"] = error.what();
    }
    return facts;
}

Json pieces_json(const dem::DetachmentParameters& detachment) {
    Json pieces = Json::array();
    for (const dem::DetachmentSegment& segment : detachment.segments) {
        const bool is_arc = segment.kind == dem::DetachmentSegment::Kind::arc;
        Json piece = is_arc ? Json{{"radius_m", segment.radius}, {"end_dip_deg", segment.end_dip}}
                            : Json{{"length_m", segment.length}};
        if (segment.start_dip)
            piece["start_dip_deg"] = *segment.start_dip;
        pieces.push_back({{is_arc ? "arc" : "line", piece}});
    }
    return {{"start_dip_deg", detachment.start_dip}, {"segments", pieces}};
}

Json lines_json(const std::vector<PickedLine>& lines) {
    Json list = Json::array();
    for (const PickedLine& line : lines) {
        list.push_back({{"name", line.name}, {"x_m", line.x}, {"depth_m", line.depth}});
        if (line.age)
            list.back()["age_a"] = *line.age;
    }
    return list;
}

Json fitted_fault(const Json& given, EffectList effects) {
    FaultSource source;
    read_detachment(given, detachment_table(effects).source, &source, effects);
    const FaultPoints fault =
        read_fault(source, "/" + (source.svg.empty() ? source.csv : source.svg));
    Json facts{{"x_m", Json::array()}, {"depth_m", Json::array()}};
    for (const dem::Point p : fault.points) {
        facts["x_m"].push_back(p.x);
        facts["depth_m"].push_back(-p.y);
    }
    try {
        dem::DetachmentParameters detachment;
        facts["misfit_m"] = fit_detachment(detachment, fault, source.tolerance).misfit;
        facts.update(pieces_json(detachment));
    } catch (const SceneError& error) {
        facts["fault"] = error.what();
    }
    return facts;
}

void check_pieces(const Json& detachment, EffectList effects) {
    detachment_of(detachment, effects);
}

Json kinematics_json(const Json& asked, EffectList effects) {
    constexpr int strata = 8, layers = 4;
    const double extension = asked.at("extension_m"), step = asked.at("step_m");
    const double unit = step / 16.0;
    const dem::Chain chain =
        dem::detachment_chain(detachment_of(asked.at("detachment"), effects), asked.at("reach_m"));
    const double end = dem::length_of(chain);
    const measures::ShearedSection section = measures::sheared_section(
        chain, extension, asked.at("angle_deg"), asked.at("right_m"), step, strata, layers);
    Json facts{{"unit_m", unit},
               {"tops", curves_json(section.tops, unit)},
               {"layers", curves_json(section.layers, unit)},
               {"deepest", place_json(section.deepest)},
               {"area", extension * -dem::point_at(chain, end).y}};
    if (measures::head_block_turns(chain, extension))
        facts["tilt"] = measures::normals_tilt(chain, extension);
    if (extension <= end)
        facts["cutoff"] = place_json(dem::point_at(chain, extension));
    return facts;
}

} // namespace listric
