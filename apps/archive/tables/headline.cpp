#include "apps/archive/tables/headline.hpp"

#include "apps/archive/tables/dictionary.hpp"
#include "apps/measures/dictionary.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string_view>

namespace listric::archive {

std::vector<Headline> headline_of(const JsonObject& summary) {
    using M = measures::Measures;
    using measures::name_of;
    const std::string numbers[] = {"extension_m",
                                   name_of<&M::basin_area>(),
                                   name_of<&M::area_balance>(),
                                   name_of<&M::rollover_tilt>(),
                                   name_of<&M::breakaway_rotation>(),
                                   name_of<&M::halfgraben_area_share>(),
                                   name_of<&M::strain_top10>()};
    std::vector<Headline> all;
    for (const std::string& key : numbers) {
        const std::string_view unit = declared(key)->unit;
        all.push_back({key, std::string(label_of(key)), std::string(unit == "1" ? "" : unit),
                       number_at(summary, key.c_str())});
    }
    for (const std::string& key :
         {std::string(measures::depocentres.name), std::string("faults")}) {
        const auto found = summary.find(key);
        const bool is_there = found != summary.end() && found->is_array();
        all.push_back(
            {"number of " + key, std::string(label_of(key)), "",
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
