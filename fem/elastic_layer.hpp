#pragma once

#include <functional>
#include <span>
#include <vector>

namespace listric::fem {

/// Elastic layer in plane strain on vertical springs: what the thin plate approximates, exactly.
struct ElasticLayer {
    double young_modulus = 70e9; ///< Pa
    double poisson_ratio = 0.25;
    double thickness = 10e3;   ///< m
    double top_spring = 0.0;   ///< Pa/m
    double base_spring = 32e3; ///< Pa/m

    /// Downward displacement over pressure, m/Pa, where the pressure cos(q x) acts on the top and
    /// its shear traction is zero. Airy's function (A + B y) e^(q y) + (C + D y) e^(-q y), from the
    /// four conditions on top and base.
    double response(double wave_number, double depth) const;

    /// Downward displacement at `places` (m from the centre of an even load) and a depth above 0,
    /// m: the integral of response * spectrum * cos(q x) / pi over all q > 0. The spectrum of a
    /// line load V is V, of a strip of half-width b under a pressure p it is 2 p sin(q b) / q.
    std::vector<double> deflection(std::span<const double> places, double depth,
                                   const std::function<double(double)>& spectrum) const;
};

} // namespace listric::fem
