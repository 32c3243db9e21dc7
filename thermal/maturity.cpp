#include "thermal/maturity.hpp"

#include "dem/numbers/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace listric::thermal {

namespace {

constexpr double frequency = 1e13;                       // 1/s
constexpr double calorie = 4.184, gas = 8.31446;         // J; J/mol/K
constexpr double least_energy = 34e3, step_energy = 2e3; // cal/mol
constexpr double celsius = 273.15;
constexpr std::array<double, reactions> shares{.03, .03, .04, .04, .05, .05, .06, .04, .04, .07,
                                               .06, .06, .06, .05, .05, .04, .03, .02, .02, .01};

/// Adds the rates at a temperature, each times a time. Energies are equally far apart, so that two
/// exponentials make all rates.
void add_rates(Maturity& sum, double temperature, double seconds) {
    const double thermal = gas * std::max(1.0, temperature + celsius);
    const double ratio = dem::exponential(-step_energy * calorie / thermal);
    double rate = frequency * dem::exponential(-least_energy * calorie / thermal);
    for (double& integral : sum) {
        integral += rate * seconds;
        rate *= ratio;
    }
}

} // namespace

void mature(Maturity& maturity, double from, double to, double seconds) {
    constexpr double most = 10.0; // K in a part
    const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(to - from) / most)));
    const double time = seconds / parts, change = (to - from) / parts;
    for (int k = 0; k < parts; ++k) {
        const double start = from + k * change;
        add_rates(maturity, start, time / 6.0);
        add_rates(maturity, start + 0.5 * change, time * (4.0 / 6.0));
        add_rates(maturity, start + change, time / 6.0);
    }
}

double vitrinite_reflectance(const Maturity& maturity) {
    double reacted = 0.0;
    for (std::size_t i = 0; i < reactions; ++i)
        reacted -= shares[i] * dem::exponential_less_one(-maturity[i]);
    return dem::exponential(-1.6 + 3.7 * reacted);
}

} // namespace listric::thermal
