// Throws of faults made in a real packing, where each horizon's throw is known exactly: the hanging
// wall slides along the fault, so that a horizon's cutoff comes along it by the slip, whatever its
// tilt, and beds far from the fault are straight on.
//
// Rock tells of its horizons to some hundredths of a diameter. A stratum's top is known to a tenth
// in the middle of its discs, 9 diameters from the fault, and its tilt, of three tops, brings
// another 0.2 to where the fault is: both sides 0.3. A radius is 0.5.

#include "apps/measures/faults/fault_throw.hpp"
#include "apps/support/statistics.hpp"
#include "tests/verification/settled_packing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

namespace listric::fault_throw_test {

using namespace dem;
using namespace measures;
namespace {

using namespace support;

constexpr double radius = 93.1, d = 2.0 * radius, degree = pi / 180.0;
constexpr double length = 140.0 * d, depth = 56.0 * d;
constexpr Point pivot{0.5 * length, -0.5 * depth}; ///< of faults and beds: on the pre-rift top
constexpr double thickness = 4.0 * d;              ///< of strata
constexpr int strata = 5;                          ///< that a growing fault offsets

const State& sample() {
    static const State made = settled(packing_request(length, depth, radius));
    return made;
}

/// A fault to be made; it falls right, or left as its mirror image.
struct Order {
    double dip = 60.0, throw_down = 500.0; ///< degrees, m
    double tilt = 0.0;                     ///< of the beds, degrees; > 0: against the fault
    double drag = 0.0;                     ///< full width at half maximum of its shear, diameters
    double arc = 0.0;                      ///< radius of a fault that is curved, diameters
    bool grows = false;                    ///< while the strata are laid down
    bool falls_left = false;
    double other_at = 0.0;    ///< diameters to the side above, of a second fault
    double other_throw = 0.0; ///< of that, m
};

Point turned(Point p, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

/// The fault as it falls right; its place is told from the pivot.
class Made {
public:
    explicit Made(const Order& order) : order_(order), state_(sample()) {
        const DiscColumns c = disc_columns(state_);
        for (std::size_t i = 0; i < c.x.size(); ++i) {
            const Point p = mirrored(Point{c.x[i], c.y[i]} - pivot);
            const Point bed = turned(p, -order.tilt * degree);
            c.start_x[i] = bed.x;
            c.start_y[i] = bed.y;
            c.stratum[i] = bed.y < 0.0 ? 0 : static_cast<std::int32_t>(bed.y / thickness) + 1;
            const Point now = pivot + mirrored(moved(p, slip_at(bed.y)));
            c.x[i] = now.x;
            c.y[i] = now.y;
        }
        trace = line(0.0);
        if (order.other_at > 0.0)
            others = {line(order.other_at)};
    }

    std::map<int, Cutoffs> cutoffs() const {
        return fault_cutoffs(state_, {.trace = trace, .others = others});
    }

    /// Throw of a horizon, m.
    double throw_of(int number) const {
        const double height = number > 0 ? number * thickness : 1000.0 * number;
        const double slip = slip_at(height);
        if (order_.arc == 0.0)
            return slip * std::sin(order_.dip * degree);
        // Where the bed meets the arc, by halving.
        const Point up = turned({0.0, 1.0}, order_.tilt * degree);
        double low = -20.0 * d, high = 30.0 * d; // along the fault, downward
        for (int k = 0; k < 60; ++k)
            (dot(on_arc(0.5 * (low + high)), up) > height ? low : high) = 0.5 * (low + high);
        return on_arc(low).y - on_arc(low + slip).y;
    }

    Polyline trace;
    std::vector<Polyline> others;

private:
    Point mirrored(Point p) const { return order_.falls_left ? Point{-p.x, p.y} : p; }
    Point down() const { return {std::cos(order_.dip * degree), -std::sin(order_.dip * degree)}; }

    double slip_at(double height) const {
        const double share =
            order_.grows ? std::max(0.0, 1.0 - std::max(0.0, height) / (strata * thickness)) : 1.0;
        return share * order_.throw_down / std::sin(order_.dip * degree);
    }

    /// An arc through the pivot, steeper above it, whose centre is above the fault.
    Point centre() const { return order_.arc * d * Point{-down().y, down().x}; }
    Point on_arc(double along) const {
        return centre() + turned(Point{} - centre(), along / (order_.arc * d));
    }

    Point moved(Point p, double slip) const {
        const auto share = [&](double away) { // on the side above
            if (order_.drag == 0.0)
                return away > 0.0 ? 1.0 : 0.0;
            const double deviation = order_.drag * d / (2.0 * std::sqrt(2.0 * std::log(2.0)));
            return 0.5 + 0.5 * std::erf(away / (deviation * std::sqrt(2.0)));
        };
        if (order_.arc > 0.0) {
            const Point r = p - centre();
            const double away = order_.arc * d - norm(r);
            return centre() + turned(r, share(away) * slip / (order_.arc * d));
        }
        const double away = cross(down(), p);
        const double other = order_.other_throw / std::sin(order_.dip * degree);
        return p + (share(away) * slip +
                    (order_.other_at > 0.0 ? share(away - order_.other_at * d) * other : 0.0)) *
                       down();
    }

    /// As traced: a diameter between points, a quarter of one off.
    Polyline line(double aside) const {
        Polyline points;
        const int last = static_cast<int>(26.0 / std::sin(order_.dip * degree));
        for (int k = -16; k <= last; ++k) {
            const double along = k * d;
            const Point n{-down().y, down().x};
            const Point on = order_.arc > 0.0 ? on_arc(along) : along * down();
            points.push_back(pivot + mirrored(on + (aside + 0.25 * std::sin(0.7 * k)) * d * n));
        }
        return points;
    }

    Order order_;
    State state_;
};

const std::vector<Order>& orders() {
    static const std::vector<Order> all{
        {.dip = 60.0, .throw_down = 100.0},
        {.dip = 60.0, .throw_down = 500.0},
        {.dip = 60.0, .throw_down = 2000.0},
        {.dip = 60.0, .throw_down = 1000.0, .falls_left = true},
        {.dip = 30.0, .throw_down = 300.0},
        {.dip = 30.0, .throw_down = 1000.0, .falls_left = true},
        {.dip = 45.0, .throw_down = 1500.0},
        {.dip = 75.0, .throw_down = 700.0},
        {.dip = 89.0, .throw_down = 1200.0},
        {.dip = 90.0, .throw_down = 900.0},
        {.dip = 60.0, .throw_down = 600.0, .tilt = 20.0},
        {.dip = 60.0, .throw_down = 600.0, .tilt = -20.0},
        {.dip = 50.0, .throw_down = 1500.0, .tilt = 40.0},
        {.dip = 70.0, .throw_down = 800.0, .tilt = -40.0, .falls_left = true},
        {.dip = 80.0, .throw_down = 2000.0, .tilt = 40.0, .falls_left = true},
        {.dip = 60.0, .throw_down = 800.0, .drag = 2.0},
        {.dip = 60.0, .throw_down = 1000.0, .drag = 4.0},
        {.dip = 45.0, .throw_down = 500.0, .tilt = 15.0, .drag = 3.0, .falls_left = true},
        {.dip = 60.0, .throw_down = 500.0, .arc = 60.0},
        {.dip = 55.0, .throw_down = 1200.0, .arc = 80.0, .falls_left = true},
        {.dip = 65.0, .throw_down = 600.0, .tilt = 20.0, .drag = 3.0, .arc = 60.0},
        {.dip = 60.0, .throw_down = 1000.0, .grows = true},
        {.dip = 70.0,
         .throw_down = 500.0,
         .tilt = -10.0,
         .drag = 3.0,
         .grows = true,
         .falls_left = true},
        {.dip = 45.0, .throw_down = 2000.0, .tilt = 10.0, .grows = true},
        {.dip = 60.0, .throw_down = 600.0, .other_at = 12.0, .other_throw = 900.0},
        {.dip = 60.0,
         .throw_down = 800.0,
         .drag = 2.0,
         .falls_left = true,
         .other_at = 9.0,
         .other_throw = 500.0},
        {.dip = 75.0, .throw_down = 400.0, .tilt = 20.0, .other_at = 15.0, .other_throw = 1500.0},
    };
    return all;
}

TEST(MadeFaults, ThrowIsThatOfTheirHorizonsToARadius) {
    for (std::size_t k = 0; k < orders().size(); ++k) {
        SCOPED_TRACE(k);
        const Made made(orders()[k]);
        std::vector<double> errors;
        int rock = 0;
        for (const auto& [number, at] : made.cutoffs()) {
            if (!at.is_resolved)
                continue;
            const double sign = orders()[k].dip == 90.0 && at.height() < 0.0 ? -1.0 : 1.0;
            const double off = sign * at.height() - made.throw_of(number);
            EXPECT_LT(std::abs(off), 1.2 * d) << number << " error " << at.error;
            errors.push_back(std::abs(off));
            rock += number <= 0;
        }
        EXPECT_GE(rock, 2);
        ASSERT_GE(errors.size(), 4u);
        EXPECT_LT(spread(errors).mean, radius);
    }
}

// The error that is told holds what is wrong: two thirds of the throws are within it, nearly all
// within three times as much.
TEST(MadeFaults, ErrorIsOfTheMethod) {
    int within = 0, within_three = 0, all = 0;
    for (const Order& order : orders()) {
        const Made made(order);
        for (const auto& [number, at] : made.cutoffs()) {
            if (!at.is_resolved)
                continue;
            const double sign = order.dip == 90.0 && at.height() < 0.0 ? -1.0 : 1.0;
            const double off = std::abs(sign * at.height() - made.throw_of(number));
            all += 1;
            within += off < std::max(at.error, 1.0);
            within_three += off < 3.0 * std::max(at.error, 1.0);
        }
    }
    EXPECT_GT(within, 0.6 * all);
    EXPECT_GT(within_three, 0.95 * all);
}

// Between the cutoffs of strata in succession lies a stratum's thickness. Below the fault nothing
// moves: it is that laid down there; above it, the fault's growth is added.
TEST(MadeFaults, CutoffsTellThicknessOnBothSides) {
    for (const bool falls_left : {true, false}) {
        const Made made({.throw_down = 500.0, .grows = true, .falls_left = falls_left});
        const std::map<int, Cutoffs> cutoffs = made.cutoffs();
        int found = 0;
        for (const auto& [number, at] : cutoffs) {
            const auto below = cutoffs.find(number - 1);
            if (number < 1 || number > strata || below == cutoffs.end())
                continue;
            ++found;
            EXPECT_NEAR(at.footwall.y - below->second.footwall.y, thickness, d) << number;
            EXPECT_NEAR(at.hanging.y - below->second.hanging.y, thickness + 500.0 / strata, d)
                << number;
        }
        EXPECT_GE(found, 3);
    }
}

// A short fault between the discs that tell of a horizon and the place where that meets the trace.
TEST(MadeFaults, NoneWhereAnotherFaultLiesBetween) {
    for (const bool falls_left : {true, false}) {
        Made made({.falls_left = falls_left});
        const std::map<int, Cutoffs> before = made.cutoffs();
        ASSERT_TRUE(throws_of(before).contains(-3));
        const Point cut = before.at(-3).hanging + Point{(falls_left ? -3.0 : 3.0) * d, 0.0};
        made.others = {{cut + Point{0.0, 1.2 * d}, cut - Point{0.0, 1.2 * d}}};
        const std::map<int, double> throws = throws_of(made.cutoffs());
        EXPECT_FALSE(throws.contains(-3));
        EXPECT_TRUE(throws.contains(0));
    }
}

TEST(MadeFaults, NoneWhereStrataAreThinnerThanThreeDiscs) {
    const Made thick({.throw_down = 500.0});
    EXPECT_TRUE(throws_of(thick.cutoffs()).contains(2));
}

} // namespace
} // namespace listric::fault_throw_test
