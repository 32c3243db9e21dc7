// A block of random discs cut by a plane along which its two sides slid by 1.3 times the least
// slip. A measure circle of radius R whose centre lies h off the plane sees the slip reduced by the
// share of discs on the wrong side, about 4 h / (pi R), and with some ten discs on a side the slip
// of a cut is read to a fifth; so what is found lies within h = (1 - 0.8 / 1.3) pi R / 4 = 0.75
// mean diameters of the plane if discs were dense, and within one with discs of that size. The
// angle is one of the twelve tried, hence within one step, 15 degrees. Where the block ends in a
// circle, less is known: only circles wholly inside are looked at.

#include "dem/contacts/soft_discs.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/property_update.hpp"
#include "tests/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace listric::fault_weakening_test {

using namespace dem;
namespace {

using namespace support;

constexpr double r = 93.1, rate = 0.01;
constexpr double degree = pi / 180.0;
constexpr FaultWeakeningParameters parameters;

struct Band {
    Point middle, along;
    double length, width;

    bool contains(Point at) const {
        return std::abs(dot(along, at - middle)) < 0.5 * length &&
               std::abs(cross(along, at - middle)) < 0.5 * width;
    }
};

struct Block {
    State state;
    FaultWeakening event;
    Point middle;
    double diameter, threshold;

    explicit Block(const FaultWeakeningParameters& p = parameters) : event(p, rate, 9.81) {
        std::vector<Disc> discs = cloud(50, 45, r, 8);
        for (Disc& disc : discs)
            disc.y -= 9e3;
        middle = {49.0 * r, -9e3 + 22.0 * std::sqrt(3.0) * r};
        state = make_state(discs);
        diameter = 2.0 * state.mean_radius;
        threshold = critical_slip(parameters, diameter);
        bond_all(state, {});
        event.begin(state);
        state.clock.travel.m = state.clock.extension.m = 500.0;
    }

    /// Distance of a point from the plane through the block's middle, > 0 on the left of the
    /// plane's direction.
    double off_plane(double x, double y, double angle) const {
        return (y - middle.y) * std::cos(angle) - (x - middle.x) * std::sin(angle);
    }

    /// Whether the measure circle is wholly in the block.
    bool inside(double x, double y) const {
        return std::abs(x - middle.x) < 46.0 * r - 2.5 * diameter &&
               std::abs(y - middle.y) < 21.0 * std::sqrt(3.0) * r - 2.5 * diameter;
    }

    void slide(double angle, double slip) {
        const DiscColumns d = disc_columns(state);
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const double half = off_plane(d.x[i], d.y[i], angle) > 0.0 ? 0.5 * slip : -0.5 * slip;
            d.x[i] += half * std::cos(angle);
            d.y[i] += half * std::sin(angle);
        }
    }
    void apply() { event.apply(state, {}); }
    /// Bands of the segments found, and of the gaps between those that lie on one line: here all
    /// do.
    std::vector<Band> bands() {
        const auto x = found("x_m"), y = found("y_m"), a = found("angle_rad");
        const double width = parameters.band_diameters * diameter;
        const double circle = parameters.circle_diameters * diameter;
        std::vector<Band> result;
        for (std::size_t k = 0; k < x.size(); ++k) {
            const Point centre{x[k], y[k]};
            result.push_back({centre, {std::cos(a[k]), std::sin(a[k])}, circle, width});
            for (std::size_t m = 0; m < k; ++m) {
                const Point between = Point{x[m], y[m]} - centre;
                const double gap = norm(between) - circle;
                if (gap >= diameter && gap <= 3.5 * diameter)
                    result.push_back({centre + 0.5 * between, unit(between), gap, width});
            }
        }
        return result;
    }
    std::span<double> found(const char* column) { return event.memory.get<double>(column); }
    std::ptrdiff_t weak_discs() { return std::ranges::count(disc_columns(state).material, weak); }
};

TEST(FaultWeakening, FindsThePlane) {
    for (double angle : {60.0, 120.0, 52.5, 0.0})
        for (double sense : {-1.0, 1.0}) {
            Block b;
            b.slide(angle * degree, sense * 1.3 * b.threshold);
            b.apply();
            const auto x = b.found("x_m"), y = b.found("y_m"), a = b.found("angle_rad");
            // The plane is 42 diameters long or more; gaps are below twice the spacing.
            EXPECT_GE(x.size(), 4u) << angle;
            for (std::size_t k = 0; k < x.size(); ++k) {
                EXPECT_GT(std::abs(b.found("slip_m")[k]), b.threshold);
                for (std::size_t m = 0; m < k; ++m)
                    EXPECT_GE(std::hypot(x[k] - x[m], y[k] - y[m]), 5.0 * b.diameter);
                if (!b.inside(x[k], y[k]))
                    continue;
                double turn = std::abs(a[k] - angle * degree);
                turn = std::min(turn, pi - turn);
                EXPECT_LE(turn, 15.0 * degree + 1e-12) << angle;
                EXPECT_LT(std::abs(b.off_plane(x[k], y[k], angle * degree)), b.diameter) << angle;
                const double slip = b.found("slip_m")[k];
                EXPECT_LE(std::abs(slip), 1.2 * 1.3 * b.threshold);
                // 165 degrees and 0 are neighbours but point opposite ways.
                if (std::abs(a[k] - angle * degree) < 0.5 * pi) {
                    EXPECT_GT(sense * slip, 0.0) << angle;
                }
                EXPECT_EQ(b.found("found_at_m")[k], 500.0);
            }
        }
}

TEST(FaultWeakening, ConvertsTheBandAndNothingElse) {
    Block b;
    b.slide(60.0 * degree, 1.3 * b.threshold);
    const std::vector<double> before(disc_columns(b.state).radius.begin(),
                                     disc_columns(b.state).radius.end());
    std::vector<std::int32_t> rows(before.size());
    std::iota(rows.begin(), rows.end(), 0);
    const std::vector<double> weight = overburden(b.state, rows, 9.81);
    b.apply();
    const DiscColumns d = disc_columns(b.state);
    const EnlargedColumns w = enlarged_columns(b.state);
    const std::vector<Band> bands = b.bands();
    const double soft = 0.5 * b.state.materials[weak].normal_stiffness;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const bool in_band = std::ranges::any_of(bands, [&](const Band& band) {
            return band.contains({d.x[i], d.y[i]});
        });
        ASSERT_EQ(d.material[i] == weak, in_band) << d.x[i] << " " << d.y[i];
        EXPECT_EQ(w.rock_radius[i], in_band ? before[i] : 0.0);
        EXPECT_EQ(b.state.discs.get<double>("scanned_x")[i], d.x[i]);
        const double q = 0.75 * weight[i] / soft;
        const double enlarged = in_band ? 1.0 + q / (1.0 + 0.42 * q) : 1.0;
        EXPECT_NEAR(d.radius[i], before[i] * enlarged, 1e-12 * before[i]);
    }
    EXPECT_GT(b.weak_discs(), 50);
    const ContactColumns c = contact_columns(b.state);
    std::size_t bonds = 0;
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        bonds += c.bonded[k];
        if (c.bonded[k]) {
            EXPECT_NE(d.material[static_cast<std::size_t>(c.first[k])], weak);
            EXPECT_NE(d.material[static_cast<std::size_t>(c.second[k])], weak);
        }
    }
    EXPECT_GT(bonds, 1000u);
}

TEST(FaultWeakening, NoGapIsLeftInAFault) {
    for (const double angle : {30.0, 60.0, 120.0}) {
        Block b;
        b.slide(angle * degree, 2.0 * b.threshold);
        b.apply();
        // Along the plane, but beyond the last segments.
        const Point along{std::cos(angle * degree), std::sin(angle * degree)};
        const DiscColumns d = disc_columns(b.state);
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const double place = dot(along, Point{d.x[i], d.y[i]} - b.middle);
            if (std::abs(place) < 13.0 * b.diameter &&
                std::abs(b.off_plane(d.x[i], d.y[i], angle * degree)) < 0.25 * b.diameter) {
                EXPECT_EQ(d.material[i], weak) << angle << " " << place / b.diameter;
            }
        }
    }
}

TEST(FaultWeakening, NothingBelowTheThreshold) {
    Block b;
    b.slide(60.0 * degree, 0.7 * b.threshold);
    b.apply();
    EXPECT_EQ(b.event.memory.rows(), 0u);
    EXPECT_EQ(b.weak_discs(), 0);
}

TEST(FaultWeakening, NothingUnderRigidMotion) {
    Block b;
    const DiscColumns d = disc_columns(b.state);
    const double cosine = std::cos(0.033), sine = std::sin(0.033);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double x = d.x[i], y = d.y[i];
        d.x[i] = cosine * x - sine * y + 500.0;
        d.y[i] = sine * x + cosine * y - 300.0;
    }
    b.apply();
    EXPECT_EQ(b.event.memory.rows(), 0u);
    EXPECT_EQ(b.weak_discs(), 0);
}

TEST(FaultWeakening, SlipCountsFromTheLastScan) {
    Block b;
    b.slide(60.0 * degree, 1.3 * b.threshold);
    b.apply();
    const std::size_t first = b.event.memory.rows();
    const std::ptrdiff_t discs = b.weak_discs();
    ASSERT_GT(first, 0u);
    b.apply();
    EXPECT_EQ(b.event.memory.rows(), first);
    EXPECT_EQ(b.weak_discs(), discs);
}

TEST(FaultWeakening, WeakBandsAreNotWidened) {
    Block b;
    const DiscColumns d = disc_columns(b.state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (std::abs(b.off_plane(d.x[i], d.y[i], 60.0 * degree)) <
            0.5 * parameters.band_diameters * b.diameter) {
            d.material[i] = weak;
            enlarged_columns(b.state).rock_radius[i] = d.radius[i];
        }
    const std::ptrdiff_t before = b.weak_discs();
    for (int window = 0; window < 3; ++window) {
        b.slide(60.0 * degree, 1.3 * b.threshold);
        b.apply();
        EXPECT_EQ(b.weak_discs(), before);
    }
    EXPECT_GE(b.event.memory.rows(), 12u); // the fault's activity is recorded all the same
}

TEST(FaultWeakening, RockThatRestsIsSoundAgain) {
    FaultWeakeningParameters p;
    p.heal_after = 2.0 * p.interval;
    Block b(p);
    const auto radius = disc_columns(b.state).radius;
    const std::vector<double> before(radius.begin(), radius.end());
    b.slide(60.0 * degree, 1.3 * b.threshold);
    b.apply();
    const std::ptrdiff_t weakened = b.weak_discs();
    ASSERT_GT(weakened, 20);
    b.apply(); // an interval at rest
    EXPECT_EQ(b.weak_discs(), weakened);
    EXPECT_EQ(std::ranges::max(b.state.discs.get<double>("rested_a")), p.interval);
    for (const double sense : {-1.0, 1.0}) { // there and back: no fault, and no rest
        b.slide(60.0 * degree, sense * 0.1 * b.threshold);
        b.apply();
    }
    EXPECT_EQ(std::ranges::max(b.state.discs.get<double>("rested_a")), 0.0);
    b.apply();
    EXPECT_EQ(b.weak_discs(), weakened);
    b.apply(); // the second interval at rest
    const EnlargedColumns w = enlarged_columns(b.state);
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(disc_columns(b.state).material[i], basement);
        // Under the load of before, but for what of the enlarged neighbours lies above a centre: a
        // tenth of a disc of some two hundred in the column.
        EXPECT_NEAR(radius[i], before[i], 5e-4 * r);
        EXPECT_EQ(w.rock_radius[i], 0.0);
        EXPECT_EQ(w.rock_area[i], 0.0);
    }
    EXPECT_EQ(std::ranges::max(b.state.discs.get<double>("rested_a")), 0.0);
}

TEST(FaultWeakening, NothingHealsUnlessAskedFor) {
    Block b;
    EXPECT_FALSE(b.state.discs.has("rested_a"));
    b.slide(60.0 * degree, 1.3 * b.threshold);
    b.apply();
    const std::ptrdiff_t weakened = b.weak_discs();
    for (int interval = 0; interval < 20; ++interval)
        b.apply();
    EXPECT_EQ(b.weak_discs(), weakened);
}

TEST(FaultWeakening, YoungSedimentIsLeftAlone) {
    Block b;
    b.state.clock.travel.m = b.state.clock.extension.m =
        5000.0; // sediment younger than 2 km of extension is young
    const DiscColumns d = disc_columns(b.state);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.y[i] > b.middle.y) {
            d.stratum[i] = d.x[i] < b.middle.x ? 1 : 2;
            d.start_travel[i] = d.x[i] < b.middle.x ? 2900.0 : 3100.0;
        }
    b.slide(0.5 * pi - 1e-9, 1.3 * b.threshold); // between the two strata
    b.slide(60.0 * degree, 1.3 * b.threshold);
    b.apply();
    EXPECT_GT(b.weak_discs(), 0);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 2) {
            ASSERT_NE(d.material[i], weak);
        }
}

TEST(FaultWeakening, TheWholeDomainHasLooseAndYoungSediment) {
    for (const bool whole : {false, true}) {
        FaultWeakeningParameters p;
        p.whole_domain = whole;
        Block b(p);
        b.state.clock.travel.m = b.state.clock.extension.m = 500.0;
        const DiscColumns d = disc_columns(b.state);
        std::ranges::fill(d.stratum, 1); // deposited when the last scan was over
        std::ranges::fill(contact_columns(b.state).bonded, std::uint8_t{0});
        b.slide(60.0 * degree, 1.3 * b.threshold);
        b.apply();
        EXPECT_EQ(b.weak_discs() > 0, whole);
    }
}

TEST(FaultWeakening, LooseSedimentIsLeftAlone) {
    for (const bool loose : {true, false}) {
        Block b;
        b.state.clock.travel.m = b.state.clock.extension.m = 5000.0;
        const DiscColumns d = disc_columns(b.state);
        for (std::size_t i = 0; i < d.x.size(); ++i)
            d.stratum[i] = d.y[i] > b.middle.y ? 1 : 0;
        const ContactColumns c = contact_columns(b.state);
        for (std::size_t k = 0; k < c.first.size(); ++k)
            if (loose && (d.stratum[static_cast<std::size_t>(c.first[k])] > 0 ||
                          d.stratum[static_cast<std::size_t>(c.second[k])] > 0))
                c.bonded[k] = 0;
        b.slide(0.0, 1.3 * b.threshold); // sediment on the basin's floor
        b.apply();
        if (loose) {
            EXPECT_EQ(b.weak_discs(), 0);
        } else {
            EXPECT_GT(b.weak_discs(), 50);
        }
    }
}

/// The slip of a scan at the start of a pause is from before it: the discs are weakened when the
/// wall moves on, as many as a scan in motion weakens at once.
TEST(FaultWeakening, WaitsForTheEndOfAPause) {
    RigidBase base;
    base.motion = {
        .speed = 1.0,
        .stages = {{.end = Travel(500.0), .speed = 1.0},
                   {.start = Travel(500.0), .end = Travel(1500.0), .slope = 0.0, .speed = 1.0},
                   {.start = Travel(1500.0), .end = Travel(3000.0), .speed = 1.0}}};
    Block moves, rests;
    for (Block* block : {&moves, &rests})
        block->slide(60.0 * degree, 1.3 * block->threshold);
    moves.apply();
    ASSERT_GT(moves.weak_discs(), 0);
    for (const double travel : {499.999, 1000.0}) { // half a cycle early, and amid the pause
        rests.state.clock.time_step = 0.01;
        rests.state.clock.travel = Travel(travel);
        rests.event.apply(rests.state, base);
        EXPECT_EQ(rests.weak_discs(), 0) << travel;
        EXPECT_FALSE(rests.found("x_m").empty());
    }
    rests.state.clock.travel = Travel(1499.999);
    rests.event.apply(rests.state, base);
    EXPECT_TRUE(
        std::ranges::equal(disc_columns(rests.state).material, disc_columns(moves.state).material));
}

} // namespace
} // namespace listric::fault_weakening_test
