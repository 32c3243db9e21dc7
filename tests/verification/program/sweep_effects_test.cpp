// Bars of 95 % on made tables with known effects: over 2,000 draws the share that holds the truth
// has a standard deviation of 0.5 %, so 93 to 97 % are four of them.

#include "apps/studies/sweep/sweep_effects.hpp"
#include "dem/numbers/random.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace listric::sweep_effects_test {
namespace {

/// Runs of a design, and what is true of them.
struct Design {
    std::vector<std::vector<double>> places; ///< by point and factor
    std::vector<std::size_t> failed = {};    ///< runs
};

Design grid(std::size_t factors, std::size_t levels) {
    Design design;
    std::size_t points = 1;
    for (std::size_t f = 0; f < factors; ++f)
        points *= levels;
    for (std::size_t p = 0; p < points; ++p) {
        design.places.emplace_back();
        for (std::size_t f = 0, rest = p; f < factors; ++f, rest /= levels)
            design.places.back().push_back(
                2.0 * static_cast<double>(rest % levels) / static_cast<double>(levels - 1) - 1.0);
    }
    return design;
}

/// Places that are drawn, as those of a Latin hypercube nearly are.
Design scattered(std::size_t factors, std::size_t points) {
    Design design;
    for (std::size_t p = 0; p < points; ++p) {
        design.places.emplace_back();
        for (std::size_t f = 0; f < factors; ++f)
            design.places.back().push_back(2.0 * dem::uniform(7, dem::Purpose::sweep_order, p, f) -
                                           1.0);
    }
    return design;
}

double truth(const std::string& term) {
    return term == "a" ? 3.0 : term == "b" ? -1.0 : term == "a:b" ? 2.0 : 0.0;
}

/// By term: in which share of the draws the bar holds the truth.
std::map<std::string, double> shares_that_hold(const Design& design, int seeds) {
    constexpr std::uint64_t draws = 2000;
    std::vector<SweepFactor> factors;
    for (std::size_t f = 0; f < design.places[0].size(); ++f)
        factors.push_back({std::string(1, static_cast<char>('a' + f)), {}});
    std::vector<std::size_t> point;
    std::vector<int> seed;
    for (std::size_t p = 0; p < design.places.size(); ++p)
        for (int s = 1; s <= seeds; ++s) {
            point.push_back(p);
            seed.push_back(s);
            for (std::size_t f = 0; f < factors.size(); ++f)
                factors[f].place.push_back(design.places[p][f]);
        }
    std::map<std::string, double> shares;
    for (std::uint64_t draw = 1; draw <= draws; ++draw) {
        std::vector<std::optional<double>> values;
        for (std::size_t k = 0; k < point.size(); ++k) {
            const std::vector<double>& x = design.places[point[k]];
            const double b = x.size() > 1 ? x[1] : 0.0;
            values.emplace_back(7.0 + 1.5 * x[0] - 0.5 * b + 1.0 * x[0] * b + 4.0 * seed[k] +
                                0.8 * dem::normal(draw, dem::Purpose::sweep_order, point[k],
                                                  static_cast<std::uint64_t>(seed[k])));
        }
        for (const std::size_t k : design.failed)
            values[k] = std::nullopt;
        for (const SweepEffect& e : effects_on("y", factors, point, seed, values)) {
            const bool holds = std::abs(e.effect - truth(e.term)) <= e.margin_95.value();
            shares[e.term] += holds / static_cast<double>(draws);
            // A bar that does not reach 0 and p below 0.05 are the same.
            EXPECT_EQ(*e.p<0.05, std::abs(e.effect)> * e.margin_95);
        }
    }
    return shares;
}

void expect_coverage(const Design& design, const std::vector<int>& all_seeds) {
    for (const int seeds : all_seeds) {
        const auto shares = shares_that_hold(design, seeds);
        EXPECT_FALSE(shares.empty());
        for (const auto& [term, share] : shares) {
            EXPECT_GT(share, 0.93) << term << ", " << seeds << " seeds";
            EXPECT_LT(share, 0.97) << term << ", " << seeds << " seeds";
        }
    }
}

TEST(SweepEffectsCoverage, OneParameterOfTwoValues) { expect_coverage(grid(1, 2), {2, 3, 5, 10}); }

TEST(SweepEffectsCoverage, TwoParametersAndBothTogether) {
    expect_coverage(grid(2, 2), {2, 3, 5, 10});
    expect_coverage(grid(2, 3), {3});
}

TEST(SweepEffectsCoverage, AScatteredDesignAndFailedRuns) {
    expect_coverage(scattered(2, 6), {2, 5});
    Design design = grid(2, 2);
    design.failed = {1, 6};
    expect_coverage(design, {3});
}

} // namespace
} // namespace listric::sweep_effects_test
