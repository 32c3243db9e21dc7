#include "fem/plate.hpp"

#include <cmath>
#include <numbers>

namespace listric::fem {

double Plate::rigidity() const {
    return young_modulus * std::pow(thickness, 3) / (12.0 * (1.0 - poisson_ratio * poisson_ratio));
}

double Plate::alpha() const { return std::pow(4.0 * rigidity() / restoring, 0.25); }

double Plate::line(double x, double load) const {
    const double a = alpha(), t = std::abs(x) / a;
    return load / (2.0 * a * restoring) * std::exp(-t) * (std::cos(t) + std::sin(t));
}

double Plate::broken(double x, double load) const {
    const double a = alpha(), t = x / a;
    return load / (a * restoring) * std::exp(-t) * std::cos(t);
}

double Plate::strip(double x, double pressure, double half_width) const {
    const double a = alpha(), far = std::abs(std::abs(x) - half_width) / a;
    const double other = (std::abs(x) + half_width) / a;
    const double near_edge = std::exp(-far) * std::cos(far);
    const double far_edge = std::exp(-other) * std::cos(other);
    const double half = pressure / (2.0 * restoring);
    return std::abs(x) < half_width ? half * (2.0 - near_edge - far_edge)
                                    : half * (near_edge - far_edge);
}

double Plate::sinusoid(double x, double pressure, double wavelength) const {
    const double q = 2.0 * std::numbers::pi / wavelength;
    return pressure / (restoring + rigidity() * std::pow(q, 4)) * std::cos(q * x);
}

} // namespace listric::fem
