#include "apps/scene/toml/json_document.hpp"

#include "apps/scene/toml/json_text.hpp"
#include "apps/scene/toml/tables.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <utility>
#include <vector>

namespace listric {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::int64_t most_exact = std::int64_t{1} << 53;

Json as_text(const toml::node& node) {
    std::ostringstream text;
    text << toml::toml_formatter(node);
    return {{"toml", text.str()}};
}

/// toml++ keeps keys by name.
std::vector<std::pair<std::string, const toml::node*>> as_written(const toml::table& table) {
    std::vector<std::pair<std::string, const toml::node*>> entries;
    for (const auto& [key, node] : table)
        entries.emplace_back(key.str(), &node);
    std::ranges::stable_sort(entries, {}, [](const auto& entry) {
        const toml::source_position& at = entry.second->source().begin;
        return std::pair(at.line, at.column);
    });
    return entries;
}

bool is_own_text(const Json& value) {
    return value.is_object() && value.size() == 1 && value.contains("toml") &&
           value["toml"].is_string();
}

bool is_table(const Json& value) { return value.is_object() && !is_own_text(value); }

bool are_tables(const Json& value) {
    return value.is_array() && !value.empty() && std::ranges::all_of(value, is_table);
}

bool is_integer(const Parameter& parameter) {
    return std::holds_alternative<Place<int>>(parameter.value) ||
           std::holds_alternative<Place<std::uint64_t>>(parameter.value);
}

std::string key_text(const std::string& key) {
    const auto is_bare = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
    return !key.empty() && std::ranges::all_of(key, is_bare) ? key : quoted(key);
}

/// A value in a line. A page tells no 1 from 1.0: what is declared as an integer is one.
std::string inline_text(const Json& value, bool as_integer) {
    if (is_own_text(value))
        return value["toml"];
    if (value.is_string())
        return quoted(value);
    if (value.is_number_integer() && as_integer)
        return to_text(value);
    if (value.is_number())
        return toml_float(value.get<double>());
    if (!value.is_structured())
        return value.is_boolean() && value.get<bool>() ? "true" : "false";
    std::string text;
    for (const auto& [key, item] : value.items())
        text += fmt::format("{}{}{}", text.empty() ? "" : ", ",
                            value.is_array() ? "" : key_text(key) + " = ",
                            inline_text(item, as_integer));
    return value.is_array() ? "[" + text + "]" : "{" + text + "}";
}

/// A key with its value; pieces and other lists of tables have a line each.
std::string entry_text(const std::string& key, const Json& value,
                       const std::vector<Parameter>& parameters) {
    const auto own = std::ranges::find(parameters, key, &Parameter::key);
    const bool as_integer = own != parameters.end() && is_integer(*own);
    if (!are_tables(value))
        return fmt::format("{} = {}\n", key_text(key), inline_text(value, as_integer));
    std::string lines = key_text(key) + " = [\n";
    for (const Json& item : value)
        lines += "    " + inline_text(item, false) + ",\n";
    return lines + "]\n";
}

} // namespace

Json json_of(const toml::node& node) {
    if (const toml::table* table = node.as_table()) {
        Json object = Json::object();
        for (const auto& [key, value] : as_written(*table))
            object[key] = json_of(*value);
        return object;
    }
    if (const toml::array* array = node.as_array()) {
        Json list = Json::array();
        for (const toml::node& item : *array)
            list.push_back(json_of(item));
        return list;
    }
    if (const auto* string = node.as_string())
        return string->get();
    if (const auto* boolean = node.as_boolean())
        return boolean->get();
    if (const auto* integer = node.as_integer(); integer && std::abs(integer->get()) <= most_exact)
        return integer->get();
    if (const auto* number = node.as_floating_point(); number && std::isfinite(number->get()))
        return number->get();
    return as_text(node);
}

std::string toml_text(const Json& document, EffectList effects) {
    const std::vector<SceneTable> all = scene_tables(effects);
    std::string top, tables;
    for (const auto& [name, value] : document.items()) {
        if (!is_table(value) && !are_tables(value)) {
            top += entry_text(name, value, top_level());
            continue;
        }
        const auto own = std::ranges::find(all, name, &SceneTable::name);
        const bool is_known = own != all.end();
        tables += is_known ? fmt::format("\n# {}", own->doc) : "";
        const std::string key = key_text(name);
        const std::string heading = value.is_object() ? "\n[" + key + "]\n" : "\n[[" + key + "]]\n";
        const auto add = [&](const Json& table) {
            tables += heading;
            for (const auto& [inner, item] : table.items())
                tables +=
                    entry_text(inner, item, is_known ? own->parameters : std::vector<Parameter>());
        };
        if (value.is_object())
            add(value);
        else
            std::ranges::for_each(value, add);
    }
    return top + tables;
}

} // namespace listric
