#include "apps/support/statistics.hpp"
#include "dem/numbers/elementary.hpp"

namespace listric {

namespace {

/// Probability of at least `met` successes in `of` tries, of a probability p within 0 and 1.
double at_least(int met, int of, double p) {
    const double odds = dem::logarithm_of_one_and(-p) - dem::logarithm(p);
    double sum = 0.0, log_of_term = of * dem::logarithm(p); // of as many as there are
    for (int k = of; k >= met; --k) {
        sum += dem::exponential(log_of_term);
        log_of_term += odds + dem::logarithm(k) - dem::logarithm(of - k + 1.0);
    }
    return sum;
}

/// The probability of a success at which at least `met` of `of` succeed in 5 % of all cases.
double lower_limit(int met, int of) {
    if (met == 0)
        return 0.0;
    double low = 0.0, high = 1.0;
    for (int step = 0; step < 50; ++step) {
        const double middle = 0.5 * (low + high);
        (at_least(met, of, middle) < 0.05 ? low : high) = middle;
    }
    return low;
}

} // namespace

ProbabilityLimits probability_limits(int met, int of) {
    assert(met >= 0 && met <= of);
    return {lower_limit(met, of), 1.0 - lower_limit(of - met, of)};
}

} // namespace listric
