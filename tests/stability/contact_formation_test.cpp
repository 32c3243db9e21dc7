// Contacts that form make a packing stiffer between two neighbour searches.
// Loose rows of discs, each held by the two neighbours of its row, are pushed together by a wall
// until every disc has six contacts. The time step allows for six contacts from the start, whatever
// there is. Without this remedy, with the step that the two contacts allow, the squeezed packing
// diverges: the limit falls from sqrt(m / K) to sqrt(2/3) of it.

#include "tests/stability/hard_case.hpp"

namespace listric::contact_formation_test {

using namespace dem;
namespace {

using namespace support;

constexpr double r = 93.1, damping = 0.7;

/// The fastest disc long after a lid has pushed loose rows together.
double fastest_when_squeezed(bool remedy) {
    constexpr std::size_t columns = 16, rows = 10;
    const Material m{1.7e11, 1e-3, 0.0, true};
    RigidBase base;
    const double gap = 0.01 * r, squeeze = 0.02 * r;
    std::vector<Disc> discs = hexagonal(columns, rows, r);
    const double height = discs.back().y + 2.0 * r;
    for (std::size_t k = 0; k < discs.size(); ++k) {
        discs[k].x += r;
        discs[k].y += r + gap * static_cast<double>(k / columns);
    }
    const double width = 2.0 * r * (columns + 0.5) - squeeze;
    State state = make_state(discs, m);
    const double closing = gap * static_cast<double>(rows - 1) + squeeze;
    const double lid = height + gap * static_cast<double>(rows - 1) + 1e-3;
    base.surfaces = {{"left", {line({0.0, 1e5}, {0.0, -1e5})}},
                     {"floor", {line({-1e5, 0.0}, {1e5, 0.0})}},
                     {"right", {line({width, -1e5}, {width, 1e5})}},
                     {"lid", {line({1e5, lid}, {-1e5, lid})}, 0.0, 0.0, {0.0, -1.0}}};
    base.material = m;
    find_contacts(state, base);
    const double mass = disc_columns(state).mass[0];
    const double of_a_row = std::sqrt(mass / (contact_stiffness(m) * (1.0 + damping)));
    state.clock.time_step = 0.95 * (remedy ? stable_time_step(mass, m, damping, 1.0) : of_a_row);
    base.motion.speed = 0.2;
    const auto cycles =
        static_cast<std::int64_t>(closing / (base.motion.speed * state.clock.time_step));
    advance_with_restart(state, base, {damping, 0.0}, cycles);
    base.motion.speed = 0.0;
    advance_with_restart(state, base, {damping, 0.0}, 3000);
    EXPECT_EQ(escaped(state, base), 0);
    return fastest(state);
}

TEST(ContactFormation, SqueezedRowsComeToRest) { EXPECT_LT(fastest_when_squeezed(true), 0.01); }

TEST(ContactFormation, NeverDoWithTheStepOfWhatTouchedBefore) {
    try {
        EXPECT_GT(fastest_when_squeezed(false), 1.0);
    } catch (const NumericalFailure&) {
    }
}

} // namespace
} // namespace listric::contact_formation_test
