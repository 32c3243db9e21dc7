// A bonded lattice that vibrates without losses keeps its energy over a million cycles.
// Round-off of 1e-13 m is 3e-9 of the displacements and adds up at random to 3e-6; the shear force,
// which is summed up while contacts turn, adds as much at these strains (it grows with the square
// of the strain): 2e-5, or 2e-11 per step.
// The remedy is the limit of the time step, and the energy that leapfrog keeps; 30 % beyond the
// limit the lattice is lost in a thousand cycles.

#include "tests/stability/hard_case.hpp"
#include "tests/verification/every_cycle.hpp"
#include "tests/verification/shaken_lattice.hpp"

namespace listric::energy_drift_test {

using namespace dem;
namespace {

using namespace support;

class EnergyDrift : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, EnergyDrift, every_cycle(), cycle_name);

double energy(const State& state) { return stored_energy(state, {}, 0.0).motion_and_strain(); }

TEST_P(EnergyDrift, IsNoneInAMillionCycles) {
    State state = shaken(0.8);
    advance(state, {}, {0.0, 0.0}, 1, GetParam());
    const double start = energy(state);
    advance(state, {}, {0.0, 0.0}, 500000, GetParam());
    state = restarted(state);
    advance(state, {}, {0.0, 0.0}, 500000, GetParam());
    EXPECT_NEAR(energy(state), start, 2e-5 * start);
}

TEST_P(EnergyDrift, IsUnboundedBeyondTheLimit) {
    State state = shaken(1.3);
    advance(state, {}, {0.0, 0.0}, 1, GetParam());
    const double start = energy(state);
    try {
        advance(state, {}, {0.0, 0.0}, 1000, GetParam());
        EXPECT_GT(energy(state), 10.0 * start);
    } catch (const NumericalFailure&) {
    }
}

} // namespace
} // namespace listric::energy_drift_test
