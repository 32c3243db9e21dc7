#pragma once

namespace listric {

// Student's distribution (Student 1908): of a mean over its standard error, which is itself known
// from so many degrees of freedom, above 0.

/// How likely chance alone gives a value as far from 0 or further, to either side.
double student_p(double t, double degrees_of_freedom);

/// How many standard errors to either side hold the truth with that probability, in (0, 1).
double student_quantile(double probability, double degrees_of_freedom);

} // namespace listric
