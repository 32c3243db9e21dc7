// The end of colour scales, and that the vocabulary of the painters is that of the measures.

#include "apps/figures/vocabulary.hpp"
#include "apps/measures/faults/rock_behaviour.hpp"
#include "apps/measures/strata/horizons.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace listric::vocabulary_test {
namespace {

TEST(Vocabulary, AScaleEndsAtAPlainNumberAboveNinetyNineOfAHundredValues) {
    EXPECT_DOUBLE_EQ(scale_end({0.011}), 0.012);
    EXPECT_DOUBLE_EQ(scale_end({0.13, NAN}), 0.15);
    EXPECT_DOUBLE_EQ(scale_end({9.0}), 10.0);
    EXPECT_DOUBLE_EQ(scale_end({2.0, 2.0}), 2.0);
    EXPECT_DOUBLE_EQ(scale_end({3.1e7}), 4e7);
    for (const std::vector<double>& nothing :
         {std::vector<double>{}, {NAN, INFINITY}, {0.0}, {-1.0}})
        EXPECT_DOUBLE_EQ(scale_end(nothing), 0.01);
    std::vector<double> values(100, 0.1); // between the two largest: 0.1 + 0.01 * 0.9
    values[17] = 1.0;
    EXPECT_DOUBLE_EQ(scale_end(values), 0.12);
    values[17] = 2.1; // 0.12 exactly
    EXPECT_DOUBLE_EQ(scale_end(values), 0.12);
    values[17] = 2.2;
    EXPECT_DOUBLE_EQ(scale_end(values), 0.15);
    EXPECT_DOUBLE_EQ(scale_end(std::vector<double>(300, 0.0)), 0.01);
    EXPECT_DOUBLE_EQ(strain_scale_end(values), 0.3); // not a fault's colours
    EXPECT_DOUBLE_EQ(strain_scale_end({0.41}), 0.5);
}

TEST(Vocabulary, IsThatOfTheMeasures) {
    using enum measures::RockBehaviour;
    const auto words = vocabulary();
    const auto& classes = words["rock_classes"];
    ASSERT_EQ(classes.size(), 5u);
    const auto name = [&](measures::RockBehaviour kind) {
        return classes[static_cast<std::size_t>(kind)]["name"].get<std::string>();
    };
    EXPECT_EQ(name(elastic), "elastic");
    EXPECT_EQ(name(plastic), "plastic");
    EXPECT_EQ(name(weakened), "weakened");
    EXPECT_EQ(name(unconsolidated), "unconsolidated");
    EXPECT_EQ(name(weak_off_fault), "weak_off_fault");
    EXPECT_EQ(words["pre_rift"]["layer_m"], measures::HorizonOptions().pre_rift_layer);
}

} // namespace
} // namespace listric::vocabulary_test
