#include "apps/scene/toml/schema.hpp"

#include "apps/scene/toml/file_names.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/scene/toml/pieces.hpp"
#include "apps/scene/toml/schema_parts.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/scene/toml/toml.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace listric {

namespace {

using Json = nlohmann::ordered_json;

Json number_schema(const Range& range, const char* type = "number") {
    Json schema{{"type", type}};
    if (const double least = std::max(range.from, range.above); std::isfinite(least)) {
        schema["minimum"] = least;
        if (range.above == least)
            schema["exclusiveMinimum"] = true;
    }
    if (const double most = std::min(range.to, range.below); std::isfinite(most)) {
        schema["maximum"] = most;
        if (range.below == most)
            schema["exclusiveMaximum"] = true;
    }
    return schema;
}

Json array_of(Json item, int least = 0) {
    Json schema{{"type", "array"}, {"items", std::move(item)}};
    if (least > 0)
        schema["minItems"] = least;
    return schema;
}

} // namespace

Json closed_table(std::string_view doc, Json properties, const std::vector<std::string>& required) {
    Json schema{{"type", "object"}, {"additionalProperties", false}};
    if (!doc.empty())
        schema["description"] = doc;
    if (!required.empty())
        schema["required"] = required;
    schema["properties"] = std::move(properties);
    return schema;
}

namespace {

/// Schema of a value, one function for each type.
struct Allowed {
    const Parameter& parameter;

    Json operator()(const Place<double>&) const { return number_schema(parameter.range); }
    Json operator()(const Place<std::optional<double>>&) const {
        return number_schema(parameter.range);
    }
    Json operator()(const Place<int>&) const { return number_schema(parameter.range, "integer"); }
    Json operator()(const Place<std::uint64_t>&) const {
        return number_schema(parameter.range, "integer");
    }
    Json operator()(const Place<bool>&) const { return {{"type", "boolean"}}; }
    Json operator()(const Place<std::string>&) const { return {{"type", "string"}}; }
    Json operator()(const Choice& choice) const {
        return {{"type", "string"}, {"enum", choice.names}};
    }
    Json operator()(const Place<std::vector<double>>&) const {
        return array_of(number_schema(parameter.range));
    }
    Json operator()(const Place<std::vector<dem::DetachmentSegment>>&) const {
        const dem::DetachmentSegment segment;
        Json kinds;
        for (const auto kind :
             {dem::DetachmentSegment::Kind::arc, dem::DetachmentSegment::Kind::line})
            kinds[kind == dem::DetachmentSegment::Kind::arc ? "arc" : "line"] =
                table_schema("", segment_parameters(kind), &segment);
        Json item = closed_table("one of arc and line", kinds);
        item["minProperties"] = item["maxProperties"] = 1;
        return array_of(item, 1);
    }
    Json operator()(const Place<std::vector<dem::TargetStage>>&) const {
        const Json points = points_schema();
        const Json stage =
            closed_table("", {{"time_a", number_schema(ranges::target_time)}, {"points", points}},
                         {"time_a", "points"});
        return {{"type", "array"}, {"anyOf", Json::array({points, array_of(stage, 1)})}};
    }
    Json operator()(const Place<std::vector<std::array<double, 4>>>&) const {
        Json four = array_of(number_schema(parameter.range), 4);
        four["maxItems"] = 4;
        return array_of(four, 2);
    }
    Json operator()(const Place<std::vector<PickedLine>>&) const {
        const PickedLine line;
        return array_of(table_schema("", picked_line_parameters(), &line));
    }
    Json operator()(const Place<std::vector<fem::Layer>>&) const {
        const fem::Layer layer;
        return array_of(table_schema("", layer_parameters(), &layer));
    }
    Json operator()(const Place<std::vector<dem::Point>>&) const { return points_schema(); }

private:
    /// Points of an x and of a number that the parameter's range holds for.
    Json points_schema() const {
        Json point = array_of(
            Json::array({number_schema(ranges::target_x), number_schema(parameter.range)}), 2);
        point["maxItems"] = 2;
        return array_of(point, 1);
    }
};

/// The value in an object, one function for each type; null if it is none that can be typed.
struct Default {
    const void* object;
    double per_si;

    Json operator()(const Place<double>& x) const { return in_key_units(x.get(object), per_si); }
    Json operator()(const Place<std::optional<double>>&) const { return nullptr; }
    Json operator()(const Place<int>& x) const { return x.get(object); }
    Json operator()(const Place<std::uint64_t>& x) const { return x.get(object); }
    Json operator()(const Place<bool>& x) const { return x.get(object); }
    Json operator()(const Place<std::string>& x) const {
        return x.get(object).empty() ? Json() : Json(x.get(object));
    }
    Json operator()(const Choice& choice) const {
        const std::string_view name = choice.get(object, choice.names);
        return name.empty() ? Json() : Json(name);
    }
    Json operator()(const Place<std::vector<double>>& x) const { return x.get(object); }
    template <class T> Json operator()(const Place<std::vector<T>>&) const { return nullptr; }
};

/// Nothing can slide on a chain of no pieces: its table's check refuses it.
bool is_required(const Parameter& parameter, const void* object) {
    const auto* chain = std::get_if<Place<std::vector<dem::DetachmentSegment>>>(&parameter.value);
    return must_be_given(parameter, object) || (chain && chain->get(object).empty());
}

/// The declaration itself, of which docs/parameters.py makes the reference.
Json declaration(const Parameter& parameter, const void* object) {
    Json all{{"doc", parameter.doc},
             {"changes", parameter.changes},
             {"type", type_of(parameter)},
             {"default", default_text(parameter, object)}};
    for (const auto& [name, fact] :
         {std::pair{"unit", parameter.unit}, std::pair{"symbol", parameter.symbol}})
        if (!fact.empty())
            all[name] = fact;
    if (const std::string allowed = text(parameter.range); !allowed.empty())
        all["allowed"] = allowed;
    if (parameter.usual.is_given())
        all["usual"] = {parameter.usual.from, parameter.usual.to};
    if (parameter.follows_rate)
        all["usual_rate_m_per_a"] = usual_rate;
    return all;
}

Json parameter_schema(const Parameter& parameter, const void* object) {
    Json schema = std::visit(Allowed{parameter}, parameter.value);
    const std::string changes =
        parameter.changes.empty() ? "" : fmt::format(". {}", parameter.changes);
    schema["description"] = fmt::format("{}{} ({})", parameter.doc, changes, facts(parameter));
    schema["x-listric"] = declaration(parameter, object);
    if (!is_required(parameter, object))
        if (Json value = std::visit(Default{object, parameter.per_si}, parameter.value);
            !value.is_null())
            schema["default"] = std::move(value);
    return schema;
}

} // namespace

Json table_schema(std::string_view doc, const std::vector<Parameter>& parameters,
                  const void* object) {
    Json properties = Json::object();
    std::vector<std::string> required;
    for (const Parameter& parameter : parameters) {
        properties[std::string(parameter.key)] = parameter_schema(parameter, object);
        if (is_required(parameter, object))
            required.emplace_back(parameter.key);
    }
    return closed_table(doc, std::move(properties), required);
}

std::string finished_schema(const char* title, const Json& schema) {
    Json document{{"$schema", "http://json-schema.org/draft-04/schema#"}, {"title", title}};
    document.update(schema);
    return to_text(document, 1) + "\n";
}

namespace {

Json needs(const std::vector<std::string_view>& tables) { return {{"required", tables}}; }

/// [materials]: names on the shelf, or paths as is_path() tells them.
Json materials_schema(EffectList effects) {
    Json properties;
    for (const RockSource& rock : rock_sources(effects)) {
        const FileName name{std::string(rock.file)};
        Json& schema = properties[std::string(rock.key)];
        schema = parameter_schema(file_name(rock.key, rock.doc, rock.changes), &name);
        schema["anyOf"] = Json::array({{{"enum", materials.names()}}, {{"pattern", "/|\\.toml$"}}});
    }
    return closed_table("rocks, by name or by path beside this file", properties);
}

/// Which tables need or exclude others, as scene_checks.cpp has it.
Json dependencies(EffectList effects) {
    Json rules;
    for (const Effect* effect : effects)
        if (const auto needed = needed_tables(*effect, effects); !needed.empty())
            rules[std::string(effect->name)] = needed;
    const Json bases = Json::array({needs({"detachment"}), needs({"stretching"})});
    Json ways = bases;
    for (const Effect* effect : effects)
        if (effect->brings_base)
            ways.push_back({{"allOf", {needs({effect->name}), {{"not", {{"anyOf", bases}}}}}}});
    rules["hanging_wall"] = {{"oneOf", ways}};
    return rules;
}

/// A detachment is its pieces, or what they are fitted to.
void allow_sources(Json& detachment) {
    detachment.erase("required");
    detachment["oneOf"] = Json::array({needs({"segments"}), needs({"csv"}), needs({"svg"})});
    const Json fitted{{"not", needs({"start_dip_deg"})}};
    detachment["dependencies"] = {{"csv", fitted}, {"svg", fitted}};
    detachment["dependencies"]["svg"]["required"] = {"svg_path", "svg_points"};
    for (const char* key : {"svg_path", "svg_points"})
        detachment["dependencies"][key] = {"svg"};
    detachment["dependencies"]["csv_delimiter"] = {"csv"};
}

} // namespace

std::string scene_schema(EffectList effects) {
    Scene scene;
    const Heading heading;
    Json schema = table_schema("", top_level(), &heading);
    Json& properties = schema["properties"];
    // As objection_to_name() has it.
    properties["name"].update({{"pattern", "^[^/\\x00-\\x1f\\x7f-\\x9f]+$"},
                               {"maxLength", 200},
                               {"not", {{"enum", {".", ".."}}}}});
    properties["materials"] = materials_schema(effects);
    for (const SceneTable& table : scene_tables(effects)) {
        const void* part = table.add(table, scene);
        Json& property = properties[std::string(table.name)];
        if (table.is_array())
            property = array_of({}, 1);
        Json& entry = table.is_array() ? property["items"] : property;
        entry = table_schema(fmt::format("{}{}", table.effect ? "effect: " : "", table.doc),
                             table.parameters, part);
        const FileName none;
        for (const Parameter& parameter : file_names(table))
            entry["properties"][std::string(parameter.key)] = parameter_schema(parameter, &none);
        for (const Parameter& parameter : table.source)
            entry["properties"][std::string(parameter.key)] =
                parameter_schema(parameter, table.source_defaults);
    }
    allow_sources(properties["detachment"]);
    properties["observed"]["dependencies"] = {{"picture", Json::array({"corners_m"})}};
    schema["required"].push_back("hanging_wall");
    schema["dependencies"] = dependencies(effects);
    return finished_schema("A scene of Listric", schema);
}

std::string material_schema() {
    const auto whole = [](const char* doc, const std::vector<Parameter>& parameters,
                          const void* object) {
        Json schema = table_schema(doc, parameters, object);
        schema["required"] = Json::array();
        for (const Parameter& parameter : parameters) {
            if (!must_be_said(parameter))
                continue;
            schema["required"].push_back(parameter.key);
            schema["properties"][std::string(parameter.key)].erase("default");
        }
        return schema;
    };
    const dem::Material material;
    const dem::BondStrength bonds;
    const SedimentPores pores;
    const Json properties{
        {"description", {{"type", "string"}, {"description", "what the material stands for"}}},
        {"material", whole("microproperties of its discs", material_parameters<>(), &material)},
        {"bonds",
         whole("strengths of contact bonds, of rock that is bonded", bond_parameters<>(), &bonds)},
        {"pores",
         whole("how sediment compacts and lets water through", pore_parameters(), &pores)}};
    return finished_schema("A material of Listric", closed_table("", properties, {"material"}));
}

} // namespace listric
