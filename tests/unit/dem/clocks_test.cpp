// Travel and extension: the compiler keeps them apart, and a moment that is asked for is that
// moment, whichever cycle it ends in.

#include "apps/measures/faults/fault_throw.hpp"
#include "apps/measures/faults/fault_trace.hpp"
#include "apps/measures/faults/shear_field.hpp"
#include "apps/measures/run_so_far.hpp"
#include "dem/clocks.hpp"
#include "dem/motion.hpp"
#include "dem/simulation.hpp"

#include <gtest/gtest.h>

#include <concepts>
#include <functional>
#include <type_traits>

namespace listric::clocks_test {

using namespace dem;
using namespace measures;

namespace {

template <class One, class Other>
constexpr bool are_apart =
    !std::is_convertible_v<One, Other> && !std::is_constructible_v<Other, One> &&
    !std::is_assignable_v<Other&, One> && !std::equality_comparable_with<One, Other> &&
    !std::is_invocable_v<std::minus<>, One, Other> && !std::is_invocable_v<std::less<>, One, Other>;

static_assert(are_apart<Travel, Extension> && are_apart<Extension, Travel>);
// A number becomes one only where that is said, and none becomes a number.
static_assert(!std::is_convertible_v<double, Travel> && !std::is_convertible_v<double, Extension>);
static_assert(!std::is_assignable_v<Travel&, double> && !std::is_assignable_v<Extension&, double>);
static_assert(!std::is_constructible_v<double, Travel> &&
              !std::is_constructible_v<double, Extension>);

/// Whether a function takes one clock, and neither the other nor a bare number.
template <class Function, class Taken, class... Before>
constexpr bool takes_only =
    std::is_invocable_v<Function, Before..., Taken> &&
    !std::is_invocable_v<Function, Before...,
                         std::conditional_t<std::same_as<Taken, Travel>, Extension, Travel>> &&
    !std::is_invocable_v<Function, Before..., double>;

static_assert(takes_only<decltype(&Motion::position), Travel, Motion>);
static_assert(takes_only<decltype(&Motion::stage), Travel, Motion>);
static_assert(takes_only<decltype(&Motion::shortens), Travel, Motion>);
static_assert(takes_only<decltype(&Motion::time_at), Travel, Motion>);
static_assert(takes_only<decltype(&Motion::at), Travel, Motion, double>);
static_assert(takes_only<decltype(&Motion::way), Travel, Motion, Travel>);
static_assert(takes_only<decltype(&Setting::is_window), Travel, Setting, Travel>);
static_assert(takes_only<decltype(&Simulation::end_at), Extension, Simulation&>);
static_assert(
    takes_only<decltype(&FaultTraceOptions::least_strain_in), Extension, FaultTraceOptions>);
static_assert(std::same_as<decltype(ThrownFault::born_at), Travel>);
static_assert(takes_only<decltype(&RunSoFar::has_come_to), Extension, const RunSoFar&, Extension>);
static_assert(!std::is_invocable_v<decltype(&Simulation::extend_to), Simulation&, Extension,
                                   const Execution&, const Simulation::Report&>);
static_assert(std::same_as<decltype(Motion().position({})), Extension>);
static_assert(std::same_as<decltype(Clock::travel), Travel> &&
              std::same_as<decltype(Clock::extension), Extension>);

TEST(Clocks, APauseAndTheWayBackAddTravelAlone) {
    Motion motion{1.0, 0.0};
    motion.stages = {{.end = Travel(2000.0)},
                     {.start = Travel(2000.0),
                      .end = Travel(4000.0),
                      .start_position = Extension(2000.0),
                      .slope = 0.0},
                     {.start = Travel(4000.0),
                      .end = Travel(6000.0),
                      .start_position = Extension(2000.0),
                      .slope = 0.5},
                     {.start = Travel(6000.0),
                      .end = Travel(7000.0),
                      .start_position = Extension(3000.0),
                      .slope = -1.0}};
    EXPECT_EQ(motion.way(Travel(500.0), Travel(1500.0)).m, 1000.0);
    EXPECT_EQ(motion.way(Travel(2000.0), Travel(4000.0)).m, 0.0);
    EXPECT_EQ(motion.way(Travel(1500.0), Travel(5000.0)).m, 500.0 + 0.0 + 500.0);
    EXPECT_EQ(motion.way(Travel(0.0), Travel(7000.0)).m, 4000.0);
    EXPECT_EQ(motion.position(Travel(7000.0)).m, 2000.0);

    Setting setting{.output_interval = 500.0, .motion = motion};
    EXPECT_TRUE(setting.is_window(Travel(1500.0), Travel(2000.0)));
    EXPECT_FALSE(setting.is_window(Travel(2000.0), Travel(4000.0))); // the wall rests
    EXPECT_FALSE(setting.is_window(Travel(4000.0), Travel(4500.0))); // 250 m
    EXPECT_TRUE(setting.is_window(Travel(4000.0), Travel(5000.0)));
    EXPECT_TRUE(setting.is_window(Travel(6000.0), Travel(6500.0))); // back
}

TEST(Clocks, WhatIsAskedForIsThatMomentToHalfACycle) {
    const Extension asked(5e3), half_a_cycle(0.01);
    EXPECT_TRUE(has_come_to(Extension(4999.992), asked, half_a_cycle));
    EXPECT_TRUE(has_come_to(Extension(5000.008), asked, half_a_cycle));
    EXPECT_FALSE(has_come_to(Extension(4999.98), asked, half_a_cycle));
}

} // namespace
} // namespace listric::clocks_test
