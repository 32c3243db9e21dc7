#include "apps/archive/headline.hpp"

#include "apps/archive/summary.hpp"
#include "apps/measures/dictionary.hpp"

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
    std::vector<Headline> all{{"extension_m", "m", number_at(summary, "extension_m")}};
    for (const std::string& name :
         {name_of<&M::basin_area>(), name_of<&M::area_balance>(), name_of<&M::rollover_tilt>(),
          name_of<&M::breakaway_rotation>(), name_of<&M::halfgraben_area_share>(),
          name_of<&M::strain_top10>()})
        all.push_back({name, std::string(unit_of_measure(name)), number_at(summary, name.c_str())});
    for (const std::string& list :
         {std::string(measures::depocentres.name), std::string("faults")}) {
        const auto found = summary.find(list);
        const bool is_there = found != summary.end() && found->is_array();
        all.push_back(
            {"number of " + list, "",
             is_there ? std::optional(static_cast<double>(found->size())) : std::nullopt});
    }
    return all;
}

} // namespace listric::archive
