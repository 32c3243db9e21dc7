// A fault is found under 14 km of rock: discs along it lose their bonds and 199/200 of their
// stiffness at once, and by property updates get back the volume that the load takes from them.
//
// The remedies, each with a parameter that turns it off:
// - Weakened discs are enlarged at once, so that they carry what the stiff ones carried
//   (fault_weakening.mean_stress_ratio; 0 leaves radii alone).
// - A radius changes by no more than 5 % per update (fault_weakening.largest_change).

#include "dem/contacts/soft_discs.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/property_update.hpp"
#include "tests/stability/hard_case.hpp"
#include "tests/verification/settled_packing.hpp"

namespace listric::weakening_test {

using namespace dem;
namespace {

using namespace support;

constexpr double rate = 0.01, width = 3e3, depth = 15e3;

GenesisRequest request() {
    GenesisRequest r = packing_request(width, depth, 125.0);
    r.bonds = BondStrength{};
    r.materials[weak] = FaultWeakeningParameters{}.material;
    return r;
}

/// A column of rock, made once.
const State& column() {
    static const State state = settled(request());
    return state;
}

double top(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    double highest = -1e300;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        highest = std::max(highest, d.y[i] + d.radius[i]);
    return highest;
}

std::int64_t bonds(const State& state) {
    return std::ranges::count(contact_columns(state).bonded, std::uint8_t{1});
}

FaultWeakeningParameters without_enlargement() {
    FaultWeakeningParameters p;
    p.mean_stress_ratio = 0.0;
    return p;
}

/// A column in which a horizontal fault has just been found.
struct Fault {
    GenesisRequest r = request();
    State state = column();
    double fastest_disc = 0.0; ///< so far, m/s

    explicit Fault(const FaultWeakeningParameters& p) {
        FaultWeakening fault(p, rate, 9.81);
        fault.begin(state);
        // As if what lies above the plane had slid by twice the threshold.
        const double threshold = critical_slip(p, 2.0 * state.mean_radius);
        const DiscColumns d = disc_columns(state);
        const auto scanned_x = state.discs.get<double>("scanned_x");
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (d.y[i] > -depth + 1e3)
                scanned_x[i] -= 2.0 * threshold;
        if (fault.apply(state, r.base))
            find_contacts(state, r.base);
    }

    /// Property updates, each 500 cycles after the last.
    void update(const FaultWeakeningParameters& p, int times) {
        PropertyUpdate update(p, rate, 9.81);
        for (int n = 0; n < times; ++n) {
            if (update.apply(state, r.base))
                find_contacts(state, r.base);
            pass(500);
        }
    }

    void pass(int cycles) {
        for (int n = 0; n < cycles; n += 100) {
            advance(state, r.base, r.physics, 100);
            fastest_disc = std::max(fastest_disc, fastest(state));
        }
    }
};

TEST(Weakening, EnlargedDiscsCarryTheirLoad) {
    Fault fault({});
    EXPECT_GT(std::ranges::count(disc_columns(fault.state).material, weak), 15);
    fault.update({}, 20);
    advance_with_restart(fault.state, fault.r.base, fault.r.physics, 1000);
    EXPECT_NEAR(top(fault.state), top(column()), 40.0);
    EXPECT_GT(bonds(fault.state), 7 * bonds(column()) / 10);
    EXPECT_EQ(escaped(fault.state, fault.r.base), 0);
    EXPECT_EQ(total_mass(fault.state), total_mass(column()));
}

TEST(Weakening, TheRockAboveFallsInWithoutEnlargement) {
    Fault fault(without_enlargement());
    fault.pass(4000);
    EXPECT_LT(top(fault.state), top(column()) - 150.0);
    // The fault's segments are five diameters long: two of them cover 2.5 of the column's 3 km.
    EXPECT_LT(bonds(fault.state), 3 * bonds(column()) / 5);
}

/// Greatest speed after the first property update of discs that lack a third of their radius.
double fastest_after_update(double largest_change) {
    Fault fault(without_enlargement());
    fault.pass(4000);
    FaultWeakeningParameters p;
    p.largest_change = largest_change;
    fault.fastest_disc = 0.0;
    fault.update(p, 1);
    EXPECT_EQ(escaped(fault.state, fault.r.base), 0);
    return fault.fastest_disc;
}

TEST(Weakening, RadiiGrowInSmallSteps) {
    const double falling = std::sqrt(2.0 * 9.81 * 0.1 * 125.0); // through a tenth of a radius
    EXPECT_LT(fastest_after_update(0.05), 2.0 * falling);
    EXPECT_GT(fastest_after_update(10.0), 5.0 * falling);
}

} // namespace
} // namespace listric::weakening_test
