#include "apps/studies/sweep/effects_table.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace listric::effects_table_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// One degree of freedom: 12.7 standard errors are needed.
const std::vector<SweepEffect> effects{{"tilt", "a.x", -0.38, 0.025, 1, 0.0418, 0.318},
                                       {"tilt", "a.y", -0.068, 0.025, 1, 0.224, 0.318},
                                       {"tilt", "a.x:a.y", 0.01, 0.025, 1, 0.75, 0.318},
                                       {"area", "a.x", 2.0}};

TEST(EffectsTable, ACellIsEmptyWhereNothingIsKnownOfChance) {
    EXPECT_EQ(effects_csv(effects),
              "measure,term,effect,standard_error,degrees_of_freedom,p,low_95,high_95\n"
              "tilt,a.x,-0.38,0.025,1,0.0418,-0.698,-0.062\n"
              "tilt,a.y,-0.068,0.025,1,0.224,-0.386,0.25\n"
              "tilt,a.x:a.y,0.01,0.025,1,0.75,-0.308,0.328\n"
              "area,a.x,2,,,,,\n");
}

TEST(EffectsTable, TwoStandardErrorsOfOneDegreeOfFreedomAreNoFinding) {
    const std::string text = effects_text(effects);
    EXPECT_THAT(text, HasSubstr("-0.38       0.32     1     0.042  clear\n"));
    EXPECT_THAT(text, HasSubstr("-0.068       0.32     1      0.22  may be chance\n"));
    EXPECT_THAT(text, Not(HasSubstr("a.x:a.y")));
    EXPECT_THAT(text, HasSubstr("effects.csv has 1 more, of two parameters together"));
    EXPECT_EQ(effects_text({}), "");
}

TEST(EffectsTable, FewSeedsAreWarnedOf) {
    EXPECT_THAT(warning_of_few(1), HasSubstr("one seed shows nothing of chance"));
    EXPECT_THAT(warning_of_few(2), HasSubstr("12.7 standard errors"));
    EXPECT_EQ(warning_of_few(3), "");
}

} // namespace
} // namespace listric::effects_table_test
