#include "apps/archive/headline.hpp"

#include "apps/archive/summary.hpp"
#include "apps/measures/dictionary.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace listric::archive {

namespace {

std::string_view unit_of_measure(std::string_view name) {
    for (const measures::MeasureTable& table : measures::measure_tables())
        for (const auto& measure : table.measures)
            if (measure.name == name)
                return measure.unit == "1" ? "" : measure.unit;
    return "";
}

} // namespace

std::vector<Headline> headline_of(const JsonObject& summary) {
    using M = measures::Measures;
    using measures::name_of;
    std::vector<Headline> all{{"extension_m", "extension", "m", number_at(summary, "extension_m")}};
    const std::pair<std::string, const char*> numbers[] = {
        {name_of<&M::basin_area>(), "basin area"},
        {name_of<&M::area_balance>(), "basin area over extension × thickness"},
        {name_of<&M::rollover_tilt>(), "tilt of the head block"},
        {name_of<&M::breakaway_rotation>(), "rotation at the breakaway"},
        {name_of<&M::halfgraben_area_share>(), "halfgraben's share of the basin"},
        {name_of<&M::strain_top10>(), "strain in the most strained tenth"}};
    for (const auto& [key, name] : numbers)
        all.push_back(
            {key, name, std::string(unit_of_measure(key)), number_at(summary, key.c_str())});
    const std::pair<std::string, const char*> lists[] = {
        {std::string(measures::depocentres.name), "depocentres"}, {"faults", "traced faults"}};
    for (const auto& [key, name] : lists) {
        const auto found = summary.find(key);
        const bool is_there = found != summary.end() && found->is_array();
        all.push_back(
            {"number of " + key, name, "",
             is_there ? std::optional(static_cast<double>(found->size())) : std::nullopt});
    }
    return all;
}

std::string value_text(const Headline& result) {
    const double value = result.value.value_or(0.0);
    if (result.unit == "m")
        return fmt::format("{:.4g} km", value / 1e3);
    if (result.unit == "m2")
        return fmt::format("{:.1f} km²", value / 1e6);
    if (result.unit == "deg")
        return fmt::format("{:.1f}°", value);
    if (result.unit.empty())
        return fmt::format("{:.3g}", value);
    return fmt::format("{:.3g} {}", value, result.unit);
}

} // namespace listric::archive
