// Tables of effects, and Student's distribution beside its closed forms for one and two degrees of
// freedom and the table of Abramowitz and Stegun (26.10), which has three digits after the point.

#include "apps/studies/sweep/student.hpp"
#include "apps/studies/sweep/sweep_effects.hpp"
#include "dem/numbers/units.hpp"

#include <gmock/gmock.h>

#include <cmath>
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

TEST(Student, HasItsClosedForms) {
    for (const double t : {0.0, 0.3, 1.0, 2.72, 12.7, 1e4}) {
        EXPECT_NEAR(student_p(t, 1.0), 1.0 - 2.0 / dem::pi * std::atan(t), 1e-12);
        EXPECT_NEAR(student_p(t, 2.0), 1.0 - t / std::sqrt(2.0 + t * t), 1e-12);
        EXPECT_EQ(student_p(-t, 5.0), student_p(t, 5.0));
    }
    EXPECT_EQ(student_p(INFINITY, 3.0), 0.0);
}

TEST(Student, HoldsTheTruthInNineteenOfTwenty) {
    const struct {
        double freedom, quantile;
    } table[] = {{1.0, 12.706}, {2.0, 4.303},  {3.0, 3.182},   {4.0, 2.776},
                 {9.0, 2.262},  {30.0, 2.042}, {120.0, 1.980}, {1e6, 1.960}};
    for (const auto& row : table) {
        EXPECT_NEAR(student_quantile(0.95, row.freedom), row.quantile, 5e-4);
        EXPECT_NEAR(student_p(student_quantile(0.95, row.freedom), row.freedom), 0.05, 1e-10);
    }
}

} // namespace
} // namespace listric::effects_table_test
