#pragma once

// Verification problems are solved by every way to compute the cycle.

#include "dem/cycle/cycle.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace listric {

using namespace dem;

inline std::string name(const Execution& e) {
    return e.cycle == Cycle::plain ? "plain" : "fast_" + std::to_string(e.threads);
}

inline void PrintTo(const Execution& e, std::ostream* out) { *out << name(e); }

namespace support {

/// To derive a test suite from; instantiate it with every_cycle() and cycle_name.
class OnEveryCycle : public testing::TestWithParam<Execution> {};

inline auto every_cycle() {
    return testing::Values(Execution{1, Cycle::plain}, Execution{1, fast_cycle()},
                           Execution{2, fast_cycle()});
}

inline std::string cycle_name(const testing::TestParamInfo<Execution>& test) {
    return name(test.param);
}

} // namespace support
} // namespace listric
