#pragma once

#include "apps/measures/basin/depocentres.hpp"
#include "apps/measures/measures.hpp"
#include "apps/measures/strata/cohesion.hpp"
#include "apps/support/measure.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace listric::measures {

/// Measures of a moment that docs/reference/measures.md shows in one table.
struct MeasureTable {
    std::string_view name;
    std::span<const Measure<Measures>> measures;
};

/// All that are numbers, in the order of history.csv.
std::span<const MeasureTable> measure_tables();

/// The name of a measure: name_of<&Measures::area_balance>().
std::string_view name_of(std::optional<double> (*value)(const Measures&));

template <auto... Member> std::string name_of() { return std::string(name_of(taken<Member...>)); }

// Those that are no numbers, and what the objects of lists have.
extern const Quantity quasi_static, depocentres, old_sediment_bonded_profile;
std::span<const Measure<Depocentre>> depocentre_measures();
std::span<const Measure<BondedLayer>> bonded_layer_measures();

} // namespace listric::measures
