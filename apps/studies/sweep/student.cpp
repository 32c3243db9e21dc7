#include "apps/studies/sweep/student.hpp"

#include <unsupported/Eigen/SpecialFunctions>

#include <cassert>
#include <cmath>

namespace listric {

double student_p(double t, double degrees_of_freedom) {
    assert(degrees_of_freedom > 0.0);
    if (std::isinf(t))
        return 0.0;
    // Abramowitz and Stegun, Handbook of Mathematical Functions, 26.7.1 and 26.5.27.
    return Eigen::numext::betainc(0.5 * degrees_of_freedom, 0.5,
                                  degrees_of_freedom / (degrees_of_freedom + t * t));
}

double student_quantile(double probability, double degrees_of_freedom) {
    assert(probability > 0.0 && probability < 1.0);
    const double beyond = 1.0 - probability;
    double low = 0.0, high = 1.0;
    while (student_p(high, degrees_of_freedom) > beyond)
        high *= 2.0;
    for (double middle = 0.5 * high; low < middle && middle < high; middle = 0.5 * (low + high))
        (student_p(middle, degrees_of_freedom) > beyond ? low : high) = middle;
    return high;
}

} // namespace listric
