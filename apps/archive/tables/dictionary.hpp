#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "apps/support/measure.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace listric::archive {

/// A quantity of a run's files, and who has it.
struct DictionaryEntry {
    Quantity quantity;
    std::string_view table;           ///< of docs/reference/measures.md
    const Effect* effect;             ///< whose it is; none: every run's
    bool at_end = true;               ///< in summary.json
    bool at_moments = true;           ///< measured at any snapshot, too
    std::vector<Quantity> parts = {}; ///< of an object or of each object of a list
};

/// All that is declared: what every run has, and what effects add.
std::vector<DictionaryEntry> dictionary(EffectList effects);

/// Declaration of a quantity of the program's; null: nobody declares it.
const Quantity* declared(std::string_view name);

/// Its label, for people; of what nobody declares its name.
std::string_view label_of(std::string_view name);

/// As JSON: {name: {table, unit, label, doc, over, effect, parts}}, a list by table.
nlohmann::ordered_json dictionary_json(EffectList effects);

/// Unit of a column of history.csv; none: nobody declares it.
std::string_view unit_of(std::string_view name, const Scene& scene);

/// Why a plan cannot ask for a number at the end, or at a snapshot, of runs with these effects;
/// empty: it can.
/// @param all  effects that there are
std::string objection_to_measure(const std::string& name, bool at_moment,
                                 const std::vector<std::string>& on, EffectList all);

} // namespace listric::archive
