#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <string_view>
#include <vector>

namespace listric {

/// Price of an effect by the factors of a Workload, disc-steps of the bare cycle: fixed +
/// per_start_disc * at_start + per_cycle * cycles + years * (per_year + per_disc_year * discs +
/// per_area_ratio_year * area_ratio).
struct PriceTerms {
    double fixed = 0.0, per_start_disc = 0.0, per_cycle = 0.0;
    double per_year = 0.0, per_disc_year = 0.0, per_area_ratio_year = 0.0;
};

/// Sum of the terms for a workload.
double price_of(const PriceTerms& terms, const Workload& work);

/// How the price of an effect depends on one of its parameters.
struct ParameterPrice {
    std::string_view key;
    bool is_switch = false;
    PriceTerms terms; ///< part that is inversely proportional to a number; of a switch: all terms
                      ///< where it is not at its default
};

/// Price of an effect as numbers, for those who predict without the program: found by asking the
/// effect's own function, so that it is declared once.
struct EffectPrice {
    PriceTerms terms; ///< with all parameters at their defaults
    std::vector<ParameterPrice> parameters;
    double new_area = 0.0; ///< over extension times thickness of the hanging wall
};

EffectPrice effect_price(const Effect& effect);

} // namespace listric
