#include "apps/model/effects.hpp"
#include "apps/run/forecast/effect_prices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace listric::effect_prices_test {
namespace {

PriceTerms scaled(const PriceTerms& terms, const PriceTerms& part, double by) {
    return {terms.fixed + by * part.fixed,
            terms.per_start_disc + by * part.per_start_disc,
            terms.per_cycle + by * part.per_cycle,
            terms.per_year + by * part.per_year,
            terms.per_disc_year + by * part.per_disc_year,
            terms.per_area_ratio_year + by * part.per_area_ratio_year};
}

/// Multiplies the numbers on which the price depends by random factors.
PriceTerms changed_terms(const Effect& effect, const EffectPrice& price, Scene& scene,
                         std::mt19937& random) {
    PriceTerms terms = price.terms;
    void* const object = effect.address.reach(scene.effects.front().parameters);
    for (const ParameterPrice& one : price.parameters) {
        const auto& parameter = *std::ranges::find(effect.parameters, one.key, &Parameter::key);
        double factor = std::uniform_real_distribution(0.2, 5.0)(random);
        if (const auto* place = std::get_if<Place<double>>(&parameter.value)) {
            place->reach(object) *= factor;
        } else if (const auto* count = std::get_if<Place<int>>(&parameter.value)) {
            const int before = count->get(object);
            count->reach(object) = static_cast<int>(factor * before) + 1;
            factor = static_cast<double>(count->get(object)) / before;
        } else {
            continue; // a switch, below
        }
        terms = scaled(terms, one.terms, 1.0 / factor - 1.0);
    }
    return terms;
}

TEST(EffectPrices, AreThoseOfTheEffectsWhateverTheParameters) {
    std::mt19937 random(43);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    int priced = 0, by_parameter = 0;
    for (const Effect* effect : program_effects()) {
        const EffectPrice price = effect_price(*effect);
        for (int k = 0; k < 20; ++k) {
            Scene scene;
            scene.effects.push_back({effect, effect->defaults()});
            const PriceTerms terms = changed_terms(*effect, price, scene, random);
            dem::HangingWallParameters& wall = scene.hanging_wall; // counts by the workload alone
            wall.length *= 1.0 + share(random);
            wall.mean_radius *= 1.0 + share(random);
            wall.radius_ratio *= 1.0 + share(random);
            const Workload work{1e5 * share(random), 1e4 * share(random), 1e6 * share(random),
                                1e6 * share(random), 1e2 * share(random)};
            const double own = effect->price ? effect->price(scene, work) : 0.0;
            EXPECT_NEAR(price_of(terms, work), own, 1e-6 * own) << effect->name;
        }
        priced += effect->price != nullptr;
        by_parameter += !price.parameters.empty();
    }
    EXPECT_GE(priced, 5);
    EXPECT_GE(by_parameter, 5);
}

TEST(EffectPrices, OfASwitchAreAllTerms) {
    int switches = 0;
    for (const Effect* effect : program_effects())
        for (const ParameterPrice& one : effect_price(*effect).parameters) {
            if (!one.is_switch)
                continue;
            ++switches;
            Scene scene;
            scene.effects.push_back({effect, effect->defaults()});
            void* const object = effect->address.reach(scene.effects.front().parameters);
            const auto& parameter =
                *std::ranges::find(effect->parameters, one.key, &Parameter::key);
            bool& flag = std::get<Place<bool>>(parameter.value).reach(object);
            flag = !flag;
            const Workload work{5e4, 2e4, 3e5, 7e5, 30.0};
            EXPECT_DOUBLE_EQ(price_of(one.terms, work), effect->price(scene, work))
                << effect->name << '.' << one.key;
        }
    EXPECT_GE(switches, 1);
}

TEST(EffectPrices, NewAreaGrowsWithExtensionAndThickness) {
    int growing = 0;
    for (const Effect* effect : program_effects()) {
        const EffectPrice price = effect_price(*effect);
        if (!effect->new_area) {
            EXPECT_EQ(price.new_area, 0.0) << effect->name;
            continue;
        }
        ++growing;
        Scene scene;
        scene.effects.push_back({effect, effect->defaults()});
        scene.extension.distance = 3456.0;
        scene.hanging_wall.thickness = 7890.0;
        EXPECT_NEAR(price.new_area * 3456.0 * 7890.0, effect->new_area(scene),
                    1e-9 * effect->new_area(scene))
            << effect->name;
    }
    EXPECT_GE(growing, 1);
}

} // namespace
} // namespace listric::effect_prices_test
