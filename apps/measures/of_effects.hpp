#pragma once

#include "apps/measures/fault.hpp"
#include "apps/measures/setting.hpp"
#include "apps/support/named_numbers.hpp"
#include "dem/base.hpp"
#include "dem/event.hpp"
#include "dem/events/energy_account.hpp"
#include "dem/state.hpp"

#include <memory>
#include <optional>
#include <span>

namespace listric::measures {

// Measures of what one effect does, each a function of the state: fault detection and weakening,
// sediment, its loss of porosity, the account of energy.

double weak_fraction(const dem::State& state); ///< share of discs that faults weakened

/// Volume of the weakened discs less what it was before, without sign, over the hanging wall's.
double volume_error_fraction(const dem::State& state, const dem::RigidBase& base,
                             const Setting& setting);

/// Weak share, by area, of the pre-rift rock and of the sediment: basement_weak_fraction,
/// sediment_weak_fraction.
NamedNumbers weak_shares(const dem::State& state);

/// Share of the sediment's discs, by area, that are weak and further than `distance` m from every
/// trace. None without sediment.
std::optional<double> weak_off_faults(const dem::State& state, std::span<const Fault> faults,
                                      double distance);

double deposited_fraction(const dem::Ledger& ledger); ///< of mass, over the initial
double eroded_fraction(const dem::Ledger& ledger);    ///< of mass, over the initial

/// Whether sediment lies as it should, the younger on top and none above the surface that it is
/// adapted to: superposition_fraction, discs_above_target.
NamedNumbers measure_layering(const dem::State& state, const dem::TargetLine& surface);

/// Porosity of sediment beside that expected in its depth: porosity_error, porosity_off_fraction.
/// Discs that have risen since keep what they had.
NamedNumbers measure_porosity(const dem::State& state, const dem::TargetLine& surface,
                              double surface_porosity, double porosity_decay);

/// None if no account is kept.
std::optional<dem::EnergyBalance>
energy_balance(const dem::State& state, const dem::RigidBase& base,
               std::span<const std::unique_ptr<dem::Event>> events);

/// Names as in docs/measures.md; NaN: no meaning in this run.
NamedNumbers energy_numbers(const dem::EnergyBalance& balance);

/// All that this moment says of effects but what measure() has.
NamedNumbers measure_effects(const Setting& setting, const dem::State& state);

} // namespace listric::measures
