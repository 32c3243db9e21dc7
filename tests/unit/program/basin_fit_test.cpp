// Parts of `listric fit`: search, shapes, horizons of kinematics, the function through drafts. 4 s.

#include "apps/measures/basin/kinematics.hpp"
#include "apps/studies/fit/draft_fit.hpp"
#include "apps/studies/fit/kinematic_fit.hpp"
#include "apps/studies/fit/simplex_search.hpp"
#include "dem/numbers/units.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace listric::basin_fit_test {

using namespace dem;
using namespace measures;
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr PorosityByDepth open{0.5, 4e-4};

TEST(SimplexSearch, FindsALeastValueWithinBounds) {
    const auto valley = [](std::span<const double> p) { // Rosenbrock's, least at (1, 1)
        return std::pow(1.0 - p[0], 2) + 100.0 * std::pow(p[1] - p[0] * p[0], 2);
    };
    const std::array start{-1.2, 1.0}, step{0.5, 0.5}, low{-5.0, -5.0}, high{5.0, 5.0};
    EXPECT_THAT(simplex_minimum(valley, start, step, low, high, 400).at,
                ElementsAre(DoubleNear(1.0, 1e-4), DoubleNear(1.0, 1e-4)));
    const std::array near{5.0, 0.5}; // the best with p[0] up to 0.5 is (0.5, 0.25)
    const auto bounded = simplex_minimum(valley, start, step, low, std::array{0.5, 5.0}, 400);
    EXPECT_THAT(bounded.at, ElementsAre(DoubleNear(0.5, 1e-3), DoubleNear(0.25, 1e-3)));
    const auto held = simplex_minimum(valley, near, std::array{0.0, 1.0}, low, high, 200);
    EXPECT_THAT(held.at, ElementsAre(5.0, DoubleNear(5.0, 1e-3)));
}

TEST(ListricShape, LineAndArcReachItsDepth) {
    for (const ListricShape& shape :
         {ListricShape{90.0, 15e3, 0.0}, {60.0, 15e3, 0.0}, {70.0, 9e3, 0.3}}) {
        const Chain chain = detachment_chain(detachment_of(shape), 0.0);
        EXPECT_NEAR(chain.back().end.y, -shape.depth, 1e-6);
        EXPECT_EQ(chain.size(), shape.straight > 0.0 ? 3u : 2u);
    }
    EXPECT_NEAR((ListricShape{90.0, 15e3, 0.0}).radius(), 15e3, 1e-6); // lis1
    EXPECT_NEAR((ListricShape{60.0, 15e3, 0.0}).radius(), 30e3, 1e-6); // lis2
}

/// Grains from the ground to a depth, m.
double grains(double depth) {
    return depth - open.surface / open.decay * (1.0 - std::exp(-open.decay * depth));
}

TEST(PredictedHorizon, KeepsTheGrainsBelow) {
    const Chain chain = detachment_chain(detachment_of({60.0, 15e3, 0.0}), 60e3);
    constexpr double extension = 8e3, since = 3e3, right = 50e3;
    const Polyline pre_rift = predicted_horizon(chain, extension, extension, 0.0, right, open);
    EXPECT_EQ(pre_rift, inclined_shear_top(chain, extension, 0.0, right));
    const Polyline loose = inclined_shear_top(chain, since, 0.0, right);
    EXPECT_EQ(predicted_horizon(chain, extension, since, 0.0, right, {}), loose);
    const Polyline horizon = predicted_horizon(chain, extension, since, 0.0, right, open);
    ASSERT_EQ(horizon.size(), loose.size());
    const std::array x{10e3, 15e3, 20e3}; // shear is vertical: columns stay columns
    const auto floor = depths_at(pre_rift, x), deposited = depths_at(loose, x),
               now = depths_at(horizon, x);
    for (std::size_t k = 0; k < x.size(); ++k) {
        EXPECT_NEAR(grains(floor[k]) - grains(now[k]), grains(floor[k] - deposited[k]), 0.1);
        EXPECT_GT(now[k], deposited[k] + 100.0);
    }
}

/// Horizons that kinematics gives over a shape.
FitTask task_over(const ListricShape& shape, double angle, std::initializer_list<double> since) {
    FitTask task{{}, 8e3, open};
    const Chain chain = detachment_chain(detachment_of(shape), 60e3);
    for (const double s : since) {
        FitHorizon& horizon = task.horizons.emplace_back(FitHorizon{s, {}, {}});
        const Polyline line = predicted_horizon(chain, task.extension, s, angle, 36e3, open);
        for (double x = line.front().x + 100.0; x <= 36e3; x += 1e3) // from the cutoff
            horizon.x.push_back(x);
        horizon.depth = depths_at(line, horizon.x);
    }
    return task;
}

TEST(KinematicFit, FindsTheShapeOfItsOwnHorizons) {
    const ListricShape made{65.0, 12e3, 0.2};
    const KinematicFit fit = fit_kinematics(task_over(made, 20.0, {8e3, 4e3}));
    EXPECT_LT(fit.misfit, 5.0); // m, of horizons 4 km deep
    EXPECT_NEAR(fit.shape.dip, made.dip, 5.0);
    EXPECT_NEAR(fit.shape.depth, made.depth, 0.05 * made.depth);
    for (std::size_t k = 0; k < 3; ++k) {
        const FitRange range = fit.profiles[k].range(fit.misfit + 20.0);
        EXPECT_LE(range.low, fit.shape.*shape_numbers()[k].value);
        EXPECT_GE(range.high, fit.shape.*shape_numbers()[k].value);
    }
}

TEST(FitProfile, ARangeEndsWhereTheMisfitCrosses) {
    const FitProfile profile{{0.0, 1.0, 2.0, 3.0, 4.0}, {50.0, 30.0, 10.0, 20.0, 20.0}};
    const FitRange range = profile.range(20.0);
    EXPECT_DOUBLE_EQ(range.low, 1.5);
    EXPECT_FALSE(range.low_is_end);
    EXPECT_DOUBLE_EQ(range.high, 4.0);
    EXPECT_TRUE(range.high_is_end);
}

/// Misfit of a bowl whose least value, 100 m, is at a shape; the share of the line says nothing.
double bowl(const ListricShape& shape) {
    const double dip = (shape.dip - 63.0) / 12.0, depth = (shape.depth - 14e3) / 1.5e3;
    return std::sqrt(1e4 + 9e4 * (dip * dip + depth * depth + dip * depth));
}

TEST(DraftFit, FindsTheLeastOfABowl) {
    const DraftDesign design({60.0, 15e3, 0.1}, 5e3);
    const auto shapes = design.shapes();
    ASSERT_EQ(shapes.size(), 15u);
    std::vector<DraftMisfit> drafts;
    for (const ListricShape& shape : shapes) {
        EXPECT_GE(shape.straight, 0.0);
        drafts.push_back({shape, bowl(shape)});
    }
    const auto fit = fit_drafts(design, drafts, 5e3);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->shape.dip, 63.0, 12.0 / 40.0); // the search's own steps
    EXPECT_NEAR(fit->shape.depth, 14e3, 1.5e3 / 40.0);
    EXPECT_NEAR(fit->misfit, 100.0, 1.0);
    EXPECT_LT(fit->residual, 1e-3);
    EXPECT_FALSE(fit->at_end);
    const FitRange dip = fit->profiles[0].range(150.0), line = fit->profiles[2].range(150.0);
    EXPECT_LT(dip.high - dip.low, 12.0);
    EXPECT_TRUE(line.low_is_end && line.high_is_end);
    drafts[3].misfit = std::nullopt; // one that failed does not matter
    EXPECT_TRUE(fit_drafts(design, drafts, 5e3));
    for (std::size_t k = 0; k < 5; ++k)
        drafts[k].misfit = std::nullopt;
    EXPECT_FALSE(fit_drafts(design, drafts, 5e3)); // ten do not tell ten terms and an error
}

TEST(DraftFit, TellsWhereTheLeastIsBeyondTheBox) {
    const DraftDesign design({40.0, 15e3, 0.1}, 5e3);
    std::vector<DraftMisfit> drafts;
    for (const ListricShape& shape : design.shapes())
        drafts.push_back({shape, bowl(shape)});
    EXPECT_TRUE(fit_drafts(design, drafts, 5e3)->at_end);
}

TEST(DraftFit, ABoxStaysAmongShapes) {
    const DraftDesign design({89.0, 5e3, 0.0}, 4.9e3);
    for (const ListricShape& shape : design.shapes()) {
        EXPECT_LE(shape.dip, 90.0);
        EXPECT_GE(shape.depth, 4.9e3);
        EXPECT_GE(shape.straight, 0.0);
    }
}

TEST(ObservedMisfit, IsTheMeanOverPoints) {
    const auto summary = parse_json(R"({"observed": [
        {"name": "a", "mean_m": 100.0, "points_compared": 30},
        {"name": "b", "outside": "is too old"},
        {"name": "c", "mean_m": 200.0, "points_compared": 10}]})");
    EXPECT_DOUBLE_EQ(observed_misfit(summary).value(), 125.0);
    EXPECT_FALSE(observed_misfit(parse_json("{}")));
    EXPECT_EQ(uncompared_horizon(summary), "horizon b is too old");
    EXPECT_EQ(uncompared_horizon(parse_json(R"({"observed": [{"name": "a", "mean_m": 1.0}]})")),
              "");
}

} // namespace
} // namespace listric::basin_fit_test
