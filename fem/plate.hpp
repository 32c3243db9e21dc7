#pragma once

#include <span>
#include <vector>

namespace listric::fem {

/// Line loads, N/m, at their x, m.
struct LineLoads {
    std::vector<double> x, load;
};

/// Without a cut, or cut at x = 0 by a fault that keeps both sides together but bends freely.
enum class PlateKind { continuous, broken };

/// Thin elastic plate on a fluid: D w'''' + k w = p (Hetenyi 1946; Turcotte & Schubert, ch. 3).
/// Deflections and loads are positive downward.
struct Plate {
    double young_modulus = 70e9; ///< Pa
    double poisson_ratio = 0.25;
    double thickness = 10e3;        ///< the effective elastic thickness, m
    double restoring = 3300 * 9.81; ///< k, density contrast times gravity, Pa/m

    double rigidity() const; ///< D = E Te^3 / 12 (1 - nu^2), N m
    double alpha() const;    ///< flexural parameter (4 D / k)^(1/4), m

    /// Under a line load V, N/m: w0 e^(-x/a) (cos x/a + sin x/a), w0 = V / (2 a k). Zero at
    /// 3 pi a / 4, bulge -0.0432 w0 at pi a.
    double line(double x, double load) const;

    /// Half plate x >= 0 with V/2 at its free end: w0 e^(-x/a) cos x/a, w0 = V / (a k). Zero at
    /// pi a / 2, bulge -0.0670 w0 at 3 pi a / 4.
    double broken(double x, double load) const;

    /// Under line loads anywhere. Broken: the continuous plate's, and a kink at 0 that takes the
    /// moment there away, e^(-x/a) (cos x/a - sin x/a).
    double deflection(double x, const LineLoads& loads, PlateKind kind) const;

    /// Under a pressure, Pa, for |x| < half_width.
    double strip(double x, double pressure, double half_width) const;

    /// Under pressure * cos(2 pi x / wavelength): (p / k) / (1 + D q^4 / k) cos q x.
    double sinusoid(double x, double pressure, double wavelength) const;
};

/// The effective elastic thickness of what has bent.
struct PlateFit {
    double thickness = 0.0; ///< m
    double misfit = 0.0;    ///< root mean square of the difference over that of the deflection
};

/// The thickness, between 0.3 and 100 km, whose plate is closest to the deflection at the places,
/// by least squares.
PlateFit fit_thickness(Plate plate, const LineLoads& loads, PlateKind kind,
                       std::span<const double> x, std::span<const double> deflection);

} // namespace listric::fem
