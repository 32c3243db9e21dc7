#include "apps/archive/folder/summary.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/known_errors.hpp"
#include "apps/archive/tables/fault_fields.hpp"
#include "apps/measures/dictionary.hpp"
#include "apps/measures/faults/main_faults.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/support/fineness.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace listric::archive {

using namespace dem;
using namespace measures;

namespace {

/// Every measure that is a number; NaN: no meaning in this run.
NamedNumbers numbers_of(const Measures& m) {
    NamedNumbers numbers;
    for (const MeasureTable& table : measure_tables())
        for (const Measure<Measures>& measure : table.measures)
            numbers.emplace_back(measure.name, measure.value(m).value_or(std::nan("")));
    return numbers;
}

using Json = nlohmann::ordered_json;

void put(Json& json, const std::string& name, std::optional<double> value) {
    if (value && std::isfinite(*value))
        json[name] = *value;
}

Json object(const NamedNumbers& numbers) {
    Json json = Json::object();
    for (const auto& [name, value] : numbers)
        json[name] = value;
    return json;
}

Json list(const std::vector<NamedNumbers>& objects) {
    Json json = Json::array();
    for (const NamedNumbers& numbers : objects)
        json.push_back(object(numbers));
    return json;
}

Json summary_head(const SummaryContent& content) {
    Json json;
    for (const HeadField& field : head_fields())
        if (field.value)
            json[std::string(field.name)] = field.value(content);
    return json;
}

void add_numbers(Json& json, const SummaryContent& content) {
    const Measures& m = content.measures;
    for (const auto& [name, value] : numbers_of(m))
        put(json, name, value);
    for (const auto& [name, value] : content.numbers)
        put(json, name, value);
    if (m.quasi_static)
        json[std::string(quasi_static.name)] = *m.quasi_static;
    for (const auto& [name, numbers] : content.objects)
        json[name] = object(numbers);
}

/// Wall time by part, s; what no part has counted is `other`.
Json seconds_by_part(const std::map<std::string, double>& parts, double wall_seconds) {
    Json json = Json::object();
    double named = 0.0;
    for (const auto& [part, seconds] : parts) {
        json[part] = seconds;
        named += seconds;
    }
    json["other"] = std::max(0.0, wall_seconds - named);
    return json;
}

/// A list of objects, which have the measures that have a meaning.
template <class Subject>
Json objects_of(const std::vector<Subject>& subjects, std::span<const Measure<Subject>> measures) {
    Json all = Json::array();
    for (const Subject& subject : subjects) {
        Json& json = all.emplace_back(Json::object());
        for (const Measure<Subject>& measure : measures)
            put(json, std::string(measure.name), measure.value(subject));
    }
    return all;
}

/// The faults, and what they have in common.
void add_faults(Json& json, const FaultReport& report, double steps) {
    for (const Measure<FaultReport>& measure : fault_report_measures())
        if (const auto value = measure.value(report); value && measure.unit == index_unit)
            json[std::string(measure.name)] = static_cast<std::size_t>(*value);
        else
            put(json, std::string(measure.name), value);
    Json& faults = json["faults"] = Json::array();
    for (std::size_t k = 0; k < report.faults.size(); ++k)
        faults.push_back(fault_object({report, k, steps}, fault_fields()));
}

/// Picked horizons; those that are compared with nothing say why.
Json observed_list(const std::vector<ObservedHorizon>& rows) {
    Json all = Json::array();
    for (const ObservedHorizon& row : rows) {
        Json& json = all.emplace_back(Json::object());
        for (const ObservedField& field : observed_fields())
            if (Json value = field.value(row); !value.is_null())
                json[std::string(field.name)] = std::move(value);
    }
    return all;
}

} // namespace

std::span<const HeadField> head_fields() {
    using C = const SummaryContent&;
    static constexpr HeadField fields[] = {
        {"scene", "", "scene", "name of the scene", [](C c) -> Json { return c.scene; }},
        {"accuracy", "", "accuracy", "level of accuracy", [](C c) -> Json { return c.accuracy; }},
        {"seed", "1", "seed", "seed of the packing and of all random numbers",
         [](C c) -> Json { return c.seed; }},
        {"threads", "1", "threads", "threads of each of the `ranks`",
         [](C c) -> Json { return c.threads; }},
        {"ranks", "1", "processes", "processes that shared the discs",
         [](C c) -> Json { return c.ranks; }},
        {"cycle_level", "", "level of the processor",
         "level of the processor: `v4`, `v3`, or `plain`", [](C c) -> Json { return c.cycle; }},
        {"discs", "1", "discs", "number of discs at the end",
         [](C c) -> Json { return c.state.discs.rows(); }},
        {"cycles", "1", "cycles", "number of cycles at the end",
         [](C c) -> Json { return c.state.clock.cycle; }},
        {"wall_s", "s", "time taken",
         "the program's time: genesis, events, output, figures; summed over resumed sessions",
         [](C c) -> Json { return c.wall_seconds; }},
        {"predicted_wall_s", "s", "time predicted",
         "prediction before the run, with other programs running as they were then",
         [](C c) -> Json { return c.record.predicted_seconds; }},
        {"disc_steps_per_s", "1/s", "disc-steps per second",
         "discs times cycles after genesis, over `wall_s`",
         [](C c) -> Json { return c.record.disc_steps / c.wall_seconds; }},
        {"finished", "", "finished", "whether the run reached its end",
         [](C) -> Json { return true; }},
        {"state_hash", "", "hash of the state",
         "hash of every number of the state and of every column but notes for people "
         "(`window_tectonic_strain`); equal for equal runs, whatever the threads",
         [](C c) -> Json { return fmt::format("{:016x}", c.state_hash); }},
        {"extension_m", "m", "extension", "displacement of base and right wall",
         [](C c) -> Json { return c.state.clock.extension.m; }},
        {"cycle", "1", "cycles so far", "cycles so far (`history.csv`)"},
        {"rocks", "", "rocks",
         "rocks as the scene named them when the run began: a list of `of` (key in [materials], or "
         "the layer), `name` of the material and `changed`, the parameters that are not the "
         "material's. Not there if an older program began the run"},
        {"provenance", "", "origin",
         "`version`, `commit`, `compiler` and `instruction_set` (see also `cycle_level`) of the "
         "program that finished the run, `scene_hash` of every parameter in scene.toml, and "
         "`seed`; equal for equal programs and scenes. `earlier_versions`: others that have "
         "made a part of the run, where it was resumed by another version. Figures have it in "
         "their metadata, too"},
        {"effects", "", "effects", "names of the effects that were on"},
        {"warnings", "", "warnings",
         "the program's warnings of the scene, as the log has them; mostly none"},
        {"time_by_part_s", "s", "time",
         "`wall_s` split: `genesis` `rebuild` `cycle`, each event, `output` `figures` `report` "
         "`measures` `other`"},
    };
    return fields;
}

NamedNumbers history_row(const State& state, const Measures& m) {
    NamedNumbers row = {
        {"extension_m", state.clock.extension.m},
        {"cycle", static_cast<double>(state.clock.cycle)},
        {"discs", static_cast<double>(state.discs.rows())},
    };
    append(row, numbers_of(m));
    return row;
}

std::string to_csv(const Table& table) {
    std::string text;
    for (const Column& column : table.columns())
        text.append(text.empty() ? "" : ",").append(column.name);
    text += '\n';
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const char* separator = "";
        for (const Column& column : table.columns()) {
            const double value = std::get<std::vector<double>>(column.values)[row];
            text += separator;
            text += std::isnan(value) ? std::string() : fmt::format("{}", value);
            separator = ",";
        }
        text += '\n';
    }
    return text;
}

std::string summary_json(const SummaryContent& content) {
    Json json = summary_head(content);
    add_numbers(json, content);
    if (content.rocks)
        json["rocks"] = *content.rocks;
    json["provenance"] = content.provenance ? *content.provenance : nlohmann::ordered_json();
    json["effects"] = content.effects;
    json["warnings"] = content.warnings;
    json["time_by_part_s"] = seconds_by_part(content.record.seconds_by_part, content.wall_seconds);
    if (content.measures.depocentres)
        json[std::string(depocentres.name)] =
            objects_of(*content.measures.depocentres, depocentre_measures());
    if (content.measures.old_sediment_bonded_profile)
        json[std::string(old_sediment_bonded_profile.name)] =
            objects_of(*content.measures.old_sediment_bonded_profile, bonded_layer_measures());
    for (const auto& [name, objects] : content.lists)
        json[name] = list(objects);
    if (!content.observed.empty())
        json[std::string(observed_horizons.name)] = observed_list(content.observed);
    add_faults(json, content.faults, fineness(content.state.mean_radius));
    if (content.known_errors)
        json[std::string(known_errors_quantity.name)] = *content.known_errors;
    return to_text(json, 2) + "\n";
}

double cycle_of(const JsonObject& summary) {
    const auto travel = number_at(summary, travel_column); // with stages
    const double way = travel.value_or(number_at(summary, "extension_m").value_or(0.0));
    const double cycles = number_at(summary, "cycles").value_or(0.0);
    return cycles > 0.0 ? way / cycles : 0.0;
}

std::optional<double> summary_travel(const std::filesystem::path& summary) {
    const JsonObject json = object_in(summary);
    if (!is_true_at(json, "finished"))
        return std::nullopt;
    const auto travel = number_at(json, travel_column); // with stages
    return travel ? travel : number_at(json, "extension_m");
}

} // namespace listric::archive
