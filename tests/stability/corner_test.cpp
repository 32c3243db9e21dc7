// Corners of the base: the breakaway, where the backstop above meets the detachment, and the joints
// of a detachment made of lines.
//
// A surface pushes a disc with one force, from its closest point. So over a joint of two lines that
// enclose nearly 180 degrees a disc rests as on a plane:
//   Known answer: weight W sinks in by W / (K cos(a / 2)), a the angle between the lines, within
//   the change of the normal.
// And over a ridge the ridge itself is the closest point, so that nothing falls between two lines.
// Above the breakaway a backstop keeps what is thrown at it.
// Without these remedies, with every line a surface of its own, a disc in the joint is pushed twice
// (it sinks in by half) and one over a ridge falls in; without the backstop discs leave.

#include "tests/stability/hard_case.hpp"

namespace listric::corner_test {

using namespace dem;
namespace {

using namespace support;

constexpr double r = 93.1, degree = pi / 180.0;

/// A chain as one surface, or each of its pieces as a surface of its own.
RigidBase base_of(const Chain& chain, bool remedy) {
    RigidBase base;
    if (remedy)
        base.surfaces = {{"chain", chain}};
    else
        for (const Segment& s : chain)
            base.surfaces.push_back({"piece", {s}});
    return base;
}

/// Two lines that meet at the origin, the second turned left by an angle: a valley, or a ridge if
/// it is negative.
Chain joint(double angle) {
    const double half = 0.5 * angle;
    const Point t{std::cos(half), -std::sin(half)}, u{std::cos(half), std::sin(half)};
    return {line({-1e4 * t.x, -1e4 * t.y}, {0.0, 0.0}), line({0.0, 0.0}, {1e4 * u.x, 1e4 * u.y})};
}

/// How far a disc has sunk in the valley of a joint, over the depth W / K in which it rests on a
/// plane.
double sunk_in_joint(double angle, bool remedy) {
    const RigidBase base = base_of(joint(angle), remedy);
    State state = make_state({{0.0, r / std::cos(0.5 * angle), r}});
    const Material m;
    const DiscColumns d = disc_columns(state);
    const double start = d.y[0];
    state.clock.time_step = stable_time_step(d.mass[0], m, 0.7, 0.95);
    find_contacts(state, base);
    advance_with_restart(state, base, {0.7, 9.81}, 4000);
    EXPECT_LT(fastest(state), 0.01);
    return (start - disc_columns(state).y[0]) * contact_stiffness(m) /
           (disc_columns(state).mass[0] * 9.81);
}

TEST(Corner, OneForceInAJoint) {
    for (double angle : {0.1, 1.0, 5.0}) {
        EXPECT_NEAR(sunk_in_joint(angle * degree, true), 1.0, 0.02) << angle;
        EXPECT_NEAR(sunk_in_joint(angle * degree, false), 0.5, 0.01) << angle;
    }
}

/// Least distance to a ridge, in radii, of a disc that is put on it.
double least_distance_on_ridge(double angle, bool remedy) {
    const RigidBase base = base_of(joint(-angle), remedy);
    State state = make_state({{1e-3 * r, r, r}});
    state.clock.time_step = stable_time_step(disc_columns(state).mass[0], {}, 0.0, 0.5);
    find_contacts(state, base);
    double least = 1e300;
    for (int n = 0; n < 2000; ++n) {
        advance(state, base, {0.0, 9.81}, 1);
        const DiscColumns d = disc_columns(state);
        least = std::min(least, std::hypot(d.x[0], d.y[0]) / r);
    }
    return least;
}

TEST(Corner, NothingFallsThroughARidge) {
    for (double angle : {1.0, 30.0, 80.0, 85.0, 90.0, 100.0}) {
        EXPECT_GT(least_distance_on_ridge(angle * degree, true), 0.999) << angle;
        EXPECT_LT(least_distance_on_ridge(angle * degree, false), 0.95) << angle;
    }
}

/// Discs thrown at the breakaway from all sides.
int escaped_at_breakaway(double dip, bool remedy) {
    RigidBase base = listric_base(3e3, 6e3);
    if (dip < 90.0)
        base.surfaces[0].chain = {line({0.0, 0.0}, {3e3 / std::tan(dip * degree), -3e3}),
                                  line({3e3 / std::tan(dip * degree), -3e3}, {2e4, -3e3})};
    if (!remedy)
        base.surfaces.erase(base.surfaces.begin() + 1);
    std::vector<Disc> discs = hexagonal(8, 9, r);
    for (Disc& disc : discs) {
        disc.x += 1.5 * r;
        disc.y -= 2.0 * r;
    }
    std::erase_if(discs, [&](const Disc& disc) {
        const auto foot = nearest(base.surfaces[0].chain, {disc.x, disc.y});
        return foot && foot->distance < disc.radius;
    });
    State state = make_state(discs);
    const DiscColumns d = disc_columns(state);
    Random random(17);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        d.vx[i] = random.between(-60.0, -10.0);
        d.vy[i] = random.between(-20.0, 20.0);
    }
    state.clock.time_step = stable_time_step(d.mass[0], state.materials[basement], 0.7, 0.95);
    base.motion.speed = 1.0;
    find_contacts(state, base);
    advance_with_restart(state, base, {0.0, 9.81}, 6000);
    const ConstDiscColumns e = disc_columns(std::as_const(state));
    return escaped(state, base) +
           static_cast<int>(std::ranges::count_if(e.x, [](double x) { return x < 0.0; }));
}

TEST(Corner, NothingEscapesAtTheBreakaway) {
    for (double dip : {90.0, 60.0, 30.0}) {
        EXPECT_EQ(escaped_at_breakaway(dip, true), 0) << dip;
        // A disc that leaves where no surface is comes back through one, or does not come back.
        try {
            EXPECT_GT(escaped_at_breakaway(dip, false), 0) << dip;
        } catch (const NumericalFailure&) {
        }
    }
}

} // namespace
} // namespace listric::corner_test
