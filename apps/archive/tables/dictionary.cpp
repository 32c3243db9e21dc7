#include "apps/archive/tables/dictionary.hpp"

#include "apps/archive/folder/known_errors.hpp"
#include "apps/archive/folder/summary.hpp"
#include "apps/archive/tables/fault_fields.hpp"
#include "apps/archive/tables/observed_misfit.hpp"
#include "apps/measures/dictionary.hpp"
#include "apps/measures/evolution.hpp"
#include "apps/measures/faults/main_faults.hpp"
#include "apps/model/effects.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace listric::archive {

using namespace measures;

namespace {

/// Quantities of declarations of any kind.
std::vector<Quantity> quantities(const auto& declarations) {
    std::vector<Quantity> all;
    for (const auto& one : declarations)
        all.push_back({one.name, one.unit, one.label, one.doc});
    return all;
}

/// Whether a head field is a number at the end, at a moment.
void add_head(std::vector<DictionaryEntry>& all) {
    const NamedNumbers row = history_row(dem::empty_state(), {});
    for (const HeadField& field : head_fields())
        all.push_back({{field.name, field.unit, field.label, field.doc},
                       "run",
                       nullptr,
                       field.value && !field.unit.empty(),
                       std::ranges::count(row, field.name, [](const auto& number) {
                           return std::string_view(number.first);
                       }) > 0});
}

void add_general(std::vector<DictionaryEntry>& all) {
    for (const MeasureTable& table : measure_tables())
        for (const Measure<Measures>& measure : table.measures)
            all.push_back({measure.quantity(), table.name, nullptr});
    const auto add = [&](const Quantity& quantity, std::string_view table,
                         std::vector<Quantity> parts) {
        all.push_back({quantity, table, nullptr, false, false, std::move(parts)});
    };
    add(quasi_static, "quality", {});
    add(depocentres, "structure", quantities(depocentre_measures()));
    add(old_sediment_bonded_profile, "material", quantities(bonded_layer_measures()));
    add(observed_horizons, "structure", quantities(observed_fields()));
    add(known_errors_quantity, "quality", {error_fields().begin(), error_fields().end()});
    all.push_back({detachment_misfit, "structure", nullptr, true, false});
}

void add_faults(std::vector<DictionaryEntry>& all) {
    std::vector<Quantity> parts;
    for (const FaultField& field : fault_fields())
        if (field.in_summary)
            parts.push_back({field.name, field.unit, field.label, field.doc});
    for (const Measure<FaultReport>& measure : fault_report_measures())
        all.push_back({measure.quantity(), "faults", nullptr, true, measure.unit != index_unit});
    for (const Quantity& quantity : evolution_quantities())
        all.push_back({quantity, "snapshots", nullptr, false});
    all.push_back({{"faults", "", "traced faults", "traced faults, longest first"},
                   "faults",
                   nullptr,
                   false,
                   false,
                   std::move(parts)});
}

void add_effect(std::vector<DictionaryEntry>& all, const Effect& effect) {
    for (const Measure<Observation>& measure : effect.measures)
        all.push_back({measure.quantity(), effect.name, &effect, measure.over != OverTime::none,
                       measure.value != nullptr});
    for (const MeasuredObjects& objects : effect.objects)
        all.push_back({{objects.name, objects.unit, objects.label, objects.doc},
                       effect.name,
                       &effect,
                       false,
                       false,
                       objects.parts});
}

} // namespace

std::vector<DictionaryEntry> dictionary(EffectList effects) {
    std::vector<DictionaryEntry> all;
    add_head(all);
    add_general(all);
    add_faults(all);
    for (const Effect* effect : effects)
        add_effect(all, *effect);
    return all;
}

const Quantity* declared(std::string_view name) {
    static const std::vector<DictionaryEntry> all = dictionary(program_effects());
    const auto found = std::ranges::find(
        all, name, [](const DictionaryEntry& entry) { return entry.quantity.name; });
    return found == all.end() ? nullptr : &found->quantity;
}

std::string_view label_of(std::string_view name) {
    const Quantity* const quantity = declared(name);
    return quantity ? quantity->label : name;
}

nlohmann::ordered_json dictionary_json(EffectList effects) {
    using Json = nlohmann::ordered_json;
    constexpr const char* over[] = {"last", "largest", "mean", "none"};
    Json list = Json::array();
    for (const DictionaryEntry& entry : dictionary(effects)) {
        const Quantity& q = entry.quantity;
        Json& json = list.emplace_back(Json{{"name", q.name},
                                            {"table", entry.table},
                                            {"unit", q.unit},
                                            {"label", q.label},
                                            {"doc", q.doc}});
        if (q.over != OverTime::last)
            json["over"] = over[static_cast<int>(q.over)];
        if (!q.usual.empty())
            json["usual"] = q.usual;
        for (const Quantity& part : entry.parts)
            json["parts"].push_back({{"name", part.name}, {"unit", part.unit}, {"doc", part.doc}});
    }
    return list;
}

std::string_view unit_of(std::string_view name, const Scene& scene) {
    std::vector<const Effect*> on;
    for (const EffectPart& part : scene.effects)
        on.push_back(part.effect);
    for (const DictionaryEntry& entry : dictionary(on))
        if (entry.quantity.name == name)
            return entry.quantity.unit;
    return {};
}

std::string objection_to_measure(const std::string& name, bool at_moment,
                                 const std::vector<std::string>& on, EffectList all) {
    const std::vector<DictionaryEntry> entries = dictionary(all);
    std::vector<std::string_view> allowed;
    std::string objection;
    for (const DictionaryEntry& entry : entries) {
        const bool fits = at_moment ? entry.at_moments : entry.at_end;
        const bool is_on = !entry.effect || std::ranges::count(on, entry.effect->name) > 0;
        if (fits && is_on)
            allowed.push_back(entry.quantity.name);
        if (entry.quantity.name != name)
            continue;
        if (fits && is_on)
            return {};
        if (!is_on)
            objection = fmt::format("is a measure of [{}], which no run of the plan has",
                                    entry.effect->name);
        else if (objection.empty() && entry.at_moments)
            objection = fmt::format("is measured from snapshots; give the extension, in metres: "
                                    "{}@5000",
                                    name);
        else if (objection.empty() && entry.at_end)
            objection = "is known at the end of a run only; leave the extension out";
        else if (objection.empty())
            objection = "is no number of a run";
    }
    if (!objection.empty())
        return objection;
    if (const auto near = nearest(name, allowed))
        return fmt::format("is no measure, did you mean {}?", *near);
    return "is no measure; docs/reference/measures.md has all";
}

} // namespace listric::archive
