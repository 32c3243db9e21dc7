// Student's distribution beside its closed forms for one and two degrees of freedom and the table
// of Abramowitz and Stegun (26.10), which has three digits after the point.

#include "apps/studies/sweep/student.hpp"

#include "dem/numbers/units.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace listric::student_test {
namespace {

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
} // namespace listric::student_test
