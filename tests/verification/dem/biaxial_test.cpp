// Hexagonally packed rods under biaxial load, s1 across the close-packed rows, fail when every
// inclined contact slips: the force on it leans by phi_mu = atan mu from its normal, which is 60
// degrees from s3. With V and H the force of a contact across and along the rows,
//   s1 = V / r,  s3 = H / (sqrt(3) r),  V / H = tan(60 deg + phi_mu):
//   s1 / s3 = sqrt(3) tan(60 deg + phi_mu), 3.00, 3.38 and 7.33 for mu = 0, 0.05 and 0.3.
// (Rowe; O'Sullivan & Bray.) The specimen stands between smooth walls. Every second row is one disc
// shorter, the outermost ones too: so each disc has a contact below for every one above, on either
// side, moments cancel and the formula holds for a specimen of any size. Its width is that between
// the centres of the longer rows' outer discs, its height that between its outer rows.
// The limit is that of rigid discs: overlaps of 1e-6 diameters turn the normals by as much, and the
// forces swing by 3e-4 as the walls move on: 1e-3. In larger specimens some rods begin to roll at
// mu = 0.3 before all contacts slip, which costs 1 to 3 % of the strength; none do at 0.05.

#include "dem/contacts/monitor.hpp"
#include "dem/cycle/cycle.hpp"
#include "tests/support.hpp"
#include "tests/verification/every_cycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::biaxial_test {

using namespace dem;
namespace {

using namespace support;

class Biaxial : public OnEveryCycle {};

INSTANTIATE_TEST_SUITE_P(On, Biaxial, every_cycle(), cycle_name);

constexpr double r = 1.0;
const double root = std::sqrt(3.0);

/// Smooth walls that touch discs with these outermost centres.
RigidBase walls(const Material& material, double left, double right, double top) {
    constexpr double far = 1e3;
    RigidBase base;
    base.material = material;
    base.surfaces = {{"left", {line({left - r, far}, {left - r, -far})}},
                     {"right", {line({right + r, -far}, {right + r, far})}},
                     {"floor", {line({-far, -r}, {far, -r})}},
                     {"top", {line({far, top + r}, {-far, top + r})}}};
    return base;
}

/// Greatest s1 / s3 of `rows` rows, the longer ones of `columns` discs, while the sides go apart
/// and the top comes down as rigid rods would let it.
double strength(std::size_t columns, std::size_t rows, double friction,
                const Execution& execution) {
    const Material material{1.7e11, 6.38e10, friction, false};
    std::vector<Disc> discs;
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t shorter = 1 - row % 2;
        for (std::size_t c = 0; c < columns - shorter; ++c)
            discs.push_back(
                {r * static_cast<double>(2 * c + shorter), root * r * static_cast<double>(row), r});
    }
    State state = make_state(discs, material);
    state.clock.time_step = stable_time_step(disc_columns(state).mass[0], material, 0.7, 0.9);
    const CyclePhysics physics{0.7, 0.0};

    // Strains: first the same in both directions, which mobilises no friction; then 3 : -1, along
    // which rigid rods keep touching.
    constexpr double compression = 1e-6, flow = 6e-6;
    constexpr int moves = 10000, cycles_per_move = 4;
    const double width = 2.0 * r * static_cast<double>(columns - 1);
    const double height = root * r * static_cast<double>(rows - 1);
    double along = -compression, across = -compression;
    const auto base = [&] {
        return walls(material, -0.5 * along * width, (1.0 + 0.5 * along) * width,
                     (1.0 + across) * height);
    };
    find_contacts(state, base());
    advance(state, base(), physics, 2000, execution);
    double greatest = 0.0;
    for (int n = 0; n < moves; ++n) {
        along += flow / moves;
        across -= flow / 3.0 / moves;
        const RigidBase moved = base();
        advance(state, moved, physics, cycles_per_move, execution);
        const std::vector<Point> reaction = force_balance(state, moved, 0.0).reaction;
        const double s3 = 0.5 * (reaction[0].x - reaction[1].x) / height;
        const double s1 = 0.5 * (reaction[2].y - reaction[3].y) / width;
        greatest = std::max(greatest, s1 / s3);
    }
    return greatest;
}

TEST_P(Biaxial, StrengthOfHexagonalRods) {
    for (double mu : {0.0, 0.05, 0.3}) {
        const double expected = root * std::tan(pi / 3.0 + std::atan(mu));
        EXPECT_NEAR(strength(3, 5, mu, GetParam()), expected, 1e-3 * expected) << mu;
    }
}

TEST_P(Biaxial, StrengthHardlyDependsOnSize) {
    const double expected = root * std::tan(pi / 3.0 + std::atan(0.05));
    EXPECT_NEAR(strength(6, 11, 0.05, GetParam()), expected, 1e-3 * expected);
}

} // namespace
} // namespace listric::biaxial_test
