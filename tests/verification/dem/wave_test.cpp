// A chain of n discs with free ends swings in modes cos(k (j + 1/2)), k = pi p / n, at
//   omega = 2 sqrt(K / m) |sin(k / 2)|,
// and leapfrog turns omega into sin(theta / 2) = omega dt / 2 per step, exactly. So a mode is known
// to round-off: positions of 2e4 m hold displacements of 1 mm to 1e-8 of it, over some thousand
// steps 1e-6. Long waves travel with c = d sqrt(K / m), short of it by (k d)^2 / 24.

#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

namespace listric::wave_test {

using namespace dem;
namespace {

using namespace support;

class Wave : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, Wave, every_cycle(), cycle_name);

constexpr double r = 93.1, amplitude = 1e-3;
constexpr std::size_t n = 60;
constexpr std::int64_t steps = 2000;

struct Mode {
    double k, frequency, measured; ///< frequencies of the steps, rad
    double residue;                ///< greatest share of other modes in the displacement
};

Mode swing(int p, const Execution& execution) {
    const Material material;
    State state = make_state(row(n, r), material);
    bond_all(state, {});
    const DiscColumns d = disc_columns(state);
    const double unit = std::sqrt(d.mass[0] / contact_stiffness(material));
    state.clock.time_step = 0.1 * unit;

    Mode mode{pi * p / static_cast<double>(n), 0.0, 0.0, 0.0};
    const double omega_dt = 0.1 * 2.0 * std::sin(0.5 * mode.k);
    mode.frequency = 2.0 * std::asin(0.5 * omega_dt);
    std::vector<double> shape(n), rest(d.x.begin(), d.x.end());
    for (std::size_t j = 0; j < n; ++j) {
        shape[j] = std::cos(mode.k * (static_cast<double>(j) + 0.5));
        d.x[j] += amplitude * shape[j];
    }
    const auto projection = [&] {
        double sum = 0.0, norm = 0.0;
        for (std::size_t j = 0; j < n; ++j) {
            sum += (d.x[j] - rest[j]) * shape[j];
            norm += shape[j] * shape[j];
        }
        return sum / norm;
    };
    // u_{s+1} + u_{s-1} = 2 cos(theta) u_s for a mode; fitted over the run.
    double before = projection(), numerator = 0.0, denominator = 0.0;
    advance(state, {}, {0.0, 0.0}, 1, execution);
    double now = projection();
    for (std::int64_t s = 1; s < steps; ++s) {
        advance(state, {}, {0.0, 0.0}, 1, execution);
        const double next = projection();
        numerator += (next + before) * now;
        denominator += 2.0 * now * now;
        before = now;
        now = next;
    }
    mode.measured = std::acos(numerator / denominator);
    for (std::size_t j = 0; j < n; ++j)
        mode.residue =
            std::max(mode.residue, std::abs(d.x[j] - rest[j] - now * shape[j]) / amplitude);
    // Started at rest half a step early: u_s = A cos((s + 1/2) theta) / cos(theta / 2).
    EXPECT_NEAR(now,
                amplitude * std::cos((static_cast<double>(steps) + 0.5) * mode.frequency) /
                    std::cos(0.5 * mode.frequency),
                1e-5 * amplitude);
    return mode;
}

TEST_P(Wave, DispersionOfTheChain) {
    for (int p : {1, 2, 10, 30, 59}) {
        const Mode mode = swing(p, GetParam());
        EXPECT_NEAR(mode.measured, mode.frequency, 1e-6 * mode.frequency) << p;
        EXPECT_LT(mode.residue, 1e-5) << p;
    }
}

TEST_P(Wave, SpeedOfLongWavesIsOfSecondOrder) {
    // c / (d sqrt(K / m)) = omega / (k sqrt(K / m)) from the measured frequency.
    const auto shortfall = [&](int p) {
        const Mode mode = swing(p, GetParam());
        return 1.0 - 2.0 * std::sin(0.5 * mode.measured) / (0.1 * mode.k);
    };
    for (int p : {4, 8}) {
        const double k = pi * p / static_cast<double>(n);
        EXPECT_NEAR(shortfall(p), k * k / 24.0, 0.01 * k * k / 24.0);
    }
    EXPECT_NEAR(shortfall(8) / shortfall(4), 4.0, 0.04);
}

} // namespace
} // namespace listric::wave_test
