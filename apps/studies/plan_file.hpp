#pragma once

#include "apps/scene/toml/toml.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

// How plans of many runs are read: tables of declared parameters, and arrays of such tables.

namespace listric {

/// More runs than anybody makes.
inline constexpr int most_runs = 100'000;

/// The plan of that name that the program ships. Throws SceneError.
toml::table study_plan(const std::string& name);

/// The words of a text, which blanks separate that stand in no quotes or brackets: a change such as
/// output.figures_at_m=[500, 1000] is one.
std::vector<std::string> words(const std::string& text);

/// Seeds of "51-56,60", each once and in their order; none: the text is no such list, or one of
/// more than a thousand.
std::optional<std::vector<int>> seed_list(std::string_view text);

/// Refuses a table whose key is not `present`. Throws SceneError.
void need(const Entry& entry, const char* key, bool present);

/// Refuses a text that is no name of a folder, and makes columns of a table. Throws SceneError.
void need_name(const Entry& entry, const char* key, const std::string& name);

/// The tables of the array `key`, if it is there, and their paths. Throws SceneError.
std::vector<Entry> tables(const Entry& parent, const char* key);

/// Schema of a measure's name, as the dictionary has it: of any snapshot, or of a run's end and, as
/// NAME@METRES, of any snapshot.
enum class MeasuredAt { any_snapshot, end_or_snapshot };
nlohmann::ordered_json measure_schema(MeasuredAt place);

} // namespace listric
