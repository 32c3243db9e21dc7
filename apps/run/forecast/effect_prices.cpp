#include "apps/run/forecast/effect_prices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <variant>

namespace listric {

namespace {

constexpr std::array members{&PriceTerms::fixed,         &PriceTerms::per_start_disc,
                             &PriceTerms::per_cycle,     &PriceTerms::per_year,
                             &PriceTerms::per_disc_year, &PriceTerms::per_area_ratio_year};

/// A scene of nothing but the effect, with defaults.
Scene alone(const Effect& effect) {
    Scene scene;
    scene.effects.push_back({&effect, defaults_of(effect)});
    return scene;
}

PriceTerms terms_of(const Effect& effect, const Scene& scene) {
    if (!effect.price)
        return {};
    const auto price = [&](const Workload& work) { return effect.price(scene, work); };
    PriceTerms terms{.fixed = price({})};
    terms.per_start_disc = price({.at_start = 1.0}) - terms.fixed;
    terms.per_cycle = price({.cycles = 1.0}) - terms.fixed;
    terms.per_year = price({.years = 1.0}) - terms.fixed;
    terms.per_disc_year = price({.discs = 1.0, .years = 1.0}) - terms.fixed - terms.per_year;
    terms.per_area_ratio_year =
        price({.years = 1.0, .area_ratio = 1.0}) - terms.fixed - terms.per_year;
    return terms;
}

bool differ(const PriceTerms& a, const PriceTerms& b) {
    return std::ranges::any_of(members, [&](auto member) {
        return std::abs(a.*member - b.*member) > 1e-9 * std::abs(a.*member + b.*member);
    });
}

/// The scene with a number doubled or a switch turned; none of another parameter.
std::optional<Scene> changed(const Effect& effect, const Parameter& parameter) {
    Scene scene = alone(effect);
    void* const object = object_of(effect, scene.effects.front().parameters);
    if (const auto* place = std::get_if<Place<double>>(&parameter.value))
        place->reach(object) *= 2.0;
    else if (const auto* count = std::get_if<Place<int>>(&parameter.value))
        count->reach(object) *= 2;
    else if (const auto* flag = std::get_if<Place<bool>>(&parameter.value))
        flag->reach(object) = !flag->get(object);
    else
        return std::nullopt;
    return scene;
}

} // namespace

double price_of(const PriceTerms& terms, const Workload& work) {
    return terms.fixed + terms.per_start_disc * work.at_start + terms.per_cycle * work.cycles +
           work.years * (terms.per_year + terms.per_disc_year * work.discs +
                         terms.per_area_ratio_year * work.area_ratio);
}

EffectPrice effect_price(const Effect& effect) {
    const Scene scene = alone(effect);
    EffectPrice price{.terms = terms_of(effect, scene), .parameters = {}};
    if (effect.new_area)
        price.new_area =
            effect.new_area(scene) / (scene.extension.distance * scene.hanging_wall.thickness);
    for (const Parameter& parameter : effect.parameters) {
        const auto other = changed(effect, parameter);
        if (!other)
            continue;
        PriceTerms terms = terms_of(effect, *other);
        if (!differ(terms, price.terms))
            continue;
        const bool is_switch = std::holds_alternative<Place<bool>>(parameter.value);
        for (auto member : members)
            if (!is_switch)
                terms.*member = 2.0 * (price.terms.*member - terms.*member);
        price.parameters.push_back({parameter.key, is_switch, terms});
    }
    return price;
}

} // namespace listric
