// Plane waves along the close-packed rows of a bonded hexagonal lattice with spacing d travel at
//   c_p = sqrt(C11 / rho_b),  c_s = sqrt(G / rho_b),  rho_b = pi / (2 sqrt 3) rho,
//   C11 = sqrt(3)/4 (3 K + K_s),  G = sqrt(3)/4 (K + K_s),
// if they are long; a lattice falls short of that by a share of second order in k d. Extrapolated
// from two wave lengths the error is of fourth order, (k d)^4 / 1000 or 5e-6 here. Leapfrog turns
// omega into sin(theta / 2) = omega dt / 2 per step, exactly, and strains of
// 1e-5 are small. Together 1e-5.

#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

namespace listric::lattice_wave_test {

using namespace dem;
namespace {

using namespace support;

class LatticeWave : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, LatticeWave, every_cycle(), cycle_name);

constexpr double r = 93.1;
const double root = std::sqrt(3.0);
const Material material;
const double K = 0.5 * material.normal_stiffness, Ks = 0.5 * material.shear_stiffness;

enum class Wave { pressure, shear };

/// Two rows of a periodic lattice. The discs around them move like those that they are images of.
class PeriodicLattice {
public:
    PeriodicLattice(std::size_t period, const Execution& execution)
        : columns_(period + 2), execution_(execution),
          state_(make_state(hexagonal(columns_, 4, r), material)) {
        bond_all(state_, {});
        const DiscColumns d = disc_columns(state_);
        state_.clock.time_step = 0.1 * std::sqrt(d.mass[0] / K);
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t column = 0; column < columns_; ++column) {
                const std::size_t real_row = row % 2 ? 1 : 2;
                const std::size_t real_column = (column + period - 1) % period + 1;
                image_of_.push_back(columns_ * real_row + real_column);
            }
    }
    State& state() { return state_; }
    bool real(std::size_t i) const { return image_of_[i] == i; }
    void cycle() {
        advance(state_, {}, {0.0, 0.0}, 1, execution_);
        const DiscColumns d = disc_columns(state_);
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const std::size_t j = image_of_[i];
            d.x[i] = d.start_x[i] + (d.x[j] - d.start_x[j]);
            d.y[i] = d.start_y[i] + (d.y[j] - d.start_y[j]);
            d.vx[i] = d.vx[j];
            d.vy[i] = d.vy[j];
            d.spin[i] = d.spin[j];
        }
    }

private:
    std::size_t columns_;
    Execution execution_;
    State state_;
    std::vector<std::size_t> image_of_;
};

/// Spin of the discs in a shear wave per velocity, 1/m: about k / 2, half the velocity gradient.
/// Exactly, what balances the moments of the contacts and of inertia, 1/2 m r^2 spin; otherwise
/// discs would also swing about it at their own, high frequency.
double spin_amplitude(double k) {
    const double kd = 2.0 * r * k;
    const double omega_squared = 0.375 * (K + Ks) * kd * kd; // times m
    const double driving = 2.0 * Ks * (std::sin(kd) + std::sin(0.5 * kd));
    const double restoring =
        4.0 * Ks * (std::pow(std::cos(0.5 * kd), 2) + 2.0 * std::pow(std::cos(0.25 * kd), 2));
    return driving / (restoring - 0.5 * omega_squared) / r;
}

/// Frequency over wave number, m/s, of a standing wave `period` spacings long.
double speed(Wave wave, std::size_t period, const Execution& execution) {
    constexpr double amplitude = 0.1; // m/s
    PeriodicLattice lattice(period, execution);
    const DiscColumns d = disc_columns(lattice.state());
    const double dt = lattice.state().clock.time_step;
    const double k = 2.0 * pi / (2.0 * r * static_cast<double>(period));
    // Moving, one step after its straight state: shear forces know velocities only.
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double v = amplitude * std::cos(k * d.start_x[i]);
        (wave == Wave::pressure ? d.vx : d.vy)[i] = v;
        (wave == Wave::pressure ? d.x : d.y)[i] += v * dt;
        if (wave == Wave::shear)
            d.spin[i] = -spin_amplitude(k) * amplitude * std::sin(k * d.start_x[i]);
    }
    const auto displacement = [&] {
        double sum = 0.0, norm = 0.0;
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (lattice.real(i)) {
                const double shape = std::cos(k * d.start_x[i]);
                sum += shape *
                       (wave == Wave::pressure ? d.x[i] - d.start_x[i] : d.y[i] - d.start_y[i]);
                norm += shape * shape;
            }
        return sum / norm;
    };
    // u_{s+1} + u_{s-1} = 2 cos(theta) u_s for a mode; fitted over the run.
    double before = displacement(), numerator = 0.0, denominator = 0.0;
    lattice.cycle();
    double now = displacement();
    for (int s = 1; s < 1500; ++s) {
        lattice.cycle();
        const double next = displacement();
        numerator += (next - 2.0 * now + before) * now;
        denominator += now * now;
        before = now;
        now = next;
    }
    // 2 cos(theta) - 2 = -4 sin^2(theta / 2) = -(omega dt)^2
    return std::sqrt(-numerator / denominator) / dt / k;
}

TEST_P(LatticeWave, SpeedOfLongWaves) {
    const double bulk_density = pi / (2.0 * root) * density;
    const double cp = std::sqrt(0.25 * root * (3.0 * K + Ks) / bulk_density);
    const double cs = std::sqrt(0.25 * root * (K + Ks) / bulk_density);
    for (Wave wave : {Wave::pressure, Wave::shear}) {
        const double exact = wave == Wave::pressure ? cp : cs;
        const double long_one = speed(wave, 48, GetParam()), half = speed(wave, 24, GetParam());
        EXPECT_NEAR((4.0 * long_one - half) / 3.0, exact, 1e-5 * exact);
        EXPECT_NEAR((exact - half) / (exact - long_one), 4.0, 0.02);
    }
}

TEST_P(LatticeWave, DispersionOfPressureWaves) {
    // m omega^2 = 2 K (1 - cos kd) + (K + 3 K_s) (1 - cos kd/2), down to three spacings. Here
    // single precision of the stiffnesses is what counts, 6e-8 and some round-off: 1e-6.
    const double mass = density * pi * r * r;
    for (std::size_t period : {3, 4, 7, 24}) {
        const double kd = 2.0 * pi / static_cast<double>(period);
        const double omega = std::sqrt(
            (2.0 * K * (1.0 - std::cos(kd)) + (K + 3.0 * Ks) * (1.0 - std::cos(0.5 * kd))) / mass);
        const double exact = 2.0 * r * omega / kd;
        EXPECT_NEAR(speed(Wave::pressure, period, GetParam()), exact, 1e-6 * exact) << period;
    }
}

} // namespace
} // namespace listric::lattice_wave_test
