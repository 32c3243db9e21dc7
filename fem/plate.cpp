#include "fem/plate.hpp"

#include <cassert>
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
    assert(x >= 0.0);
    const double a = alpha(), t = x / a;
    return load / (a * restoring) * std::exp(-t) * std::cos(t);
}

double Plate::deflection(double x, const LineLoads& loads, PlateKind kind) const {
    assert(loads.x.size() == loads.load.size());
    const double a = alpha();
    double sum = 0.0, kink = 0.0;
    for (std::size_t k = 0; k < loads.x.size(); ++k) {
        sum += line(x - loads.x[k], loads.load[k]);
        const double t = std::abs(loads.x[k]) / a;
        kink += loads.load[k] / (2.0 * a * restoring) * std::exp(-t) * (std::cos(t) - std::sin(t));
    }
    const double t = std::abs(x) / a;
    return kind == PlateKind::continuous ? sum
                                         : sum + kink * std::exp(-t) * (std::cos(t) - std::sin(t));
}

PlateFit fit_thickness(Plate plate, const LineLoads& loads, PlateKind kind,
                       std::span<const double> x, std::span<const double> deflection) {
    assert(!x.empty() && x.size() == deflection.size());
    const auto misfit = [&](double logarithm) {
        plate.thickness = std::exp(logarithm);
        double square = 0.0, size = 0.0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            square += std::pow(plate.deflection(x[k], loads, kind) - deflection[k], 2);
            size += deflection[k] * deflection[k];
        }
        return std::sqrt(square / size);
    };
    // The least of a row of thicknesses, then the golden section around it.
    constexpr int steps = 60;
    const double from = std::log(300.0), step = std::log(1e5 / 300.0) / steps;
    int best = 0;
    for (int k = 1; k <= steps; ++k)
        if (misfit(from + k * step) < misfit(from + best * step))
            best = k;
    double low = from + (best - 1) * step, high = from + (best + 1) * step;
    const double golden = std::numbers::phi - 1.0;
    while (high - low > 1e-9) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (misfit(a) < misfit(b))
            high = b;
        else
            low = a;
    }
    const double found = 0.5 * (low + high);
    return {std::exp(found), misfit(found)};
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
