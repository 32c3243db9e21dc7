#include "fem/elastic_layer.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace listric::fem {

namespace {

using Real = long double; // four nearly parallel conditions where waves are long

/// A function of depth and its first three derivatives, in units of 1/q.
using Jet = std::array<Real, 4>;

/// s^power e^s with s = q (y - origin), power 0 or 1, or the same of -s.
Jet growing(Real s, int power) {
    const Real e = std::exp(s);
    if (power == 0)
        return {e, e, e, e};
    return {s * e, (s + 1) * e, (s + 2) * e, (s + 3) * e};
}

Jet decaying(Real s, int power) {
    const Real e = std::exp(-s);
    if (power == 0)
        return {e, -e, e, -e};
    return {s * e, (1 - s) * e, (s - 2) * e, (3 - s) * e};
}

} // namespace

double ElasticLayer::response(double wave_number, double depth) const {
    assert(wave_number > 0.0);
    const Real q = wave_number, nu = poisson_ratio;
    const Real mu = static_cast<Real>(young_modulus) / (2 * (1 + nu));
    const auto basis = [&](Real y) {
        const Real s = q * y, t = q * (y + thickness);
        return std::array{growing(s, 0), growing(s, 1), decaying(t, 0), decaying(t, 1)};
    };
    // In units that leave out q^2 (stress) and q / 2 mu (displacement):
    const auto normal = [](const Jet& f) { return -f[0]; };
    const auto shear = [](const Jet& f) { return f[1]; };
    const auto rise = [&](const Jet& f) { return (1 - nu) * f[3] - (2 - nu) * f[1]; };
    const Real softness = 1 / (2 * mu * q);

    std::array<std::array<Real, 5>, 4> rows{};
    const auto top = basis(0), base = basis(-static_cast<Real>(thickness));
    for (std::size_t k = 0; k < 4; ++k) {
        rows[0][k] = normal(top[k]) + top_spring * softness * rise(top[k]);
        rows[1][k] = shear(top[k]);
        rows[2][k] = normal(base[k]) - base_spring * softness * rise(base[k]);
        rows[3][k] = shear(base[k]);
    }
    rows[0][4] = -1;                      // pressure 1
    for (std::size_t c = 0; c < 4; ++c) { // Gauss with pivots
        std::size_t pivot = c;
        for (std::size_t r = c; r < 4; ++r)
            if (std::abs(rows[r][c]) > std::abs(rows[pivot][c]))
                pivot = r;
        std::swap(rows[c], rows[pivot]);
        for (std::size_t r = 0; r < 4; ++r) {
            if (r == c)
                continue;
            const Real factor = rows[r][c] / rows[c][c];
            for (std::size_t k = c; k < 5; ++k)
                rows[r][k] -= factor * rows[c][k];
        }
    }
    const auto here = basis(-static_cast<Real>(depth));
    Real w = 0;
    for (std::size_t k = 0; k < 4; ++k)
        w += rows[k][4] / rows[k][k] * rise(here[k]);
    return static_cast<double>(-w * softness);
}

std::vector<double> ElasticLayer::deflection(std::span<const double> places, double depth,
                                             const std::function<double(double)>& spectrum) const {
    assert(depth > 0.0 && top_spring + base_spring > 0.0);
    // Gauss-Legendre, five points a panel; the response decays as e^(-q depth) and its bend is at
    // 1 / alpha.
    constexpr std::array<double, 5> at = {-0.9061798459386640, -0.5384693101056831, 0.0,
                                          0.5384693101056831, 0.9061798459386640};
    constexpr std::array<double, 5> weight = {0.2369268850561891, 0.4786286704993665,
                                              0.5688888888888889, 0.4786286704993665,
                                              0.2369268850561891};
    double farthest = thickness;
    for (double x : places)
        farthest = std::max(farthest, std::abs(x));
    const double rigidity =
        young_modulus * std::pow(thickness, 3) / (12.0 * (1.0 - poisson_ratio * poisson_ratio));
    const double alpha = std::pow(4.0 * rigidity / (top_spring + base_spring), 0.25);
    const double panel = std::min(0.2 / alpha, 0.5 / farthest);
    const double end = 45.0 / depth;
    std::vector<double> result(places.size(), 0.0);
    for (double start = 0.0; start < end; start += panel)
        for (std::size_t k = 0; k < 5; ++k) {
            const double q = start + 0.5 * panel * (1.0 + at[k]);
            const double amplitude =
                0.5 * panel * weight[k] / std::numbers::pi * response(q, depth) * spectrum(q);
            for (std::size_t i = 0; i < places.size(); ++i)
                result[i] += amplitude * std::cos(q * places[i]);
        }
    return result;
}

} // namespace listric::fem
