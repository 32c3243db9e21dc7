#pragma once

#include "apps/scene/toml/schema_parts.hpp"
#include "apps/scene/toml/toml.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// How plans of many runs are read: tables of declared parameters, and arrays of such tables.

namespace listric {

/// More runs than anybody makes.
inline constexpr int most_runs = 100'000;

/// Table of a sweep's plan that makes a data set of its runs; a sweep passes over it.
inline constexpr const char* dataset_table = "dataset";

/// The plan of that name that the program ships. Throws SceneError.
toml::table study_plan(const std::string& name);

/// The words of a text, which blanks separate that stand in no quotes or brackets: a change such as
/// output.figures_at_m=[500, 1000] is one.
std::vector<std::string> words(const std::string& text);

/// Seeds of "51-56,60", each once and in their order; none: the text is no such list, or one of
/// more than a thousand.
std::optional<std::vector<int>> seed_list(std::string_view text);

/// A key of a plan, which no run has.
Parameter plan_key(std::string_view key, Value value, std::string_view doc, Range range = {},
                   std::string_view unit = {});

/// Refuses a table whose key is not `present`. Throws SceneError.
void need(const Entry& entry, const char* key, bool present);

/// Refuses a table without one of the keys, or with an empty one. Throws SceneError.
void need_keys(const Entry& entry, const std::vector<const char*>& keys);

/// Schema of an array.
nlohmann::ordered_json array_of(std::string_view doc, nlohmann::ordered_json items);

/// Tables of a plan that are alike, each of which is a T.
template <class T> struct PlanTable {
    std::string_view doc;
    std::vector<Parameter> parameters;
    std::vector<const char*> needed = {};     ///< keys that must be there, and not empty
    std::vector<std::string_view> parts = {}; ///< keys that are read elsewhere

    /// Throws SceneError.
    T read(const Entry& entry) const {
        T object{};
        read_table(entry, parameters, &object, parts);
        need_keys(entry, needed);
        return object;
    }
    nlohmann::ordered_json schema() const {
        const T object{};
        nlohmann::ordered_json one = table_schema("", parameters, &object);
        if (!needed.empty())
            one["required"] = needed;
        return one;
    }
    nlohmann::ordered_json array_schema() const { return array_of(doc, schema()); }
};

/// Refuses a text that is no name of a folder, and makes columns of a table. Throws SceneError.
void need_name(const Entry& entry, const char* key, const std::string& name);

/// The tables of the array `key`, if it is there, and their paths. Throws SceneError.
std::vector<Entry> tables(const Entry& parent, const char* key);

/// Schema of a measure's name, as the dictionary has it: of any snapshot, or of a run's end and, as
/// NAME@METRES, of any snapshot.
enum class MeasuredAt { any_snapshot, end_or_snapshot };
nlohmann::ordered_json measure_schema(MeasuredAt place);

} // namespace listric
