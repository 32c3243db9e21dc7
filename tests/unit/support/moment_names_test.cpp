// Names of moments in names of files: kilometres in basins, more digits in small models.

#include "apps/support/words/moment_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace listric::moment_names_test {
namespace {

TEST(MomentNames, OfABasinHaveTwoDecimals) {
    const std::vector<double> ends{0.0, 499.98, 1000.004, 12499.9889, 123500.011};
    const MomentNames names(500.0, ends);
    EXPECT_EQ(names.metres(0.0), "00000.00");
    EXPECT_EQ(names.metres(499.98), "00500.00"); // which was asked for
    EXPECT_EQ(names.metres(1000.004), "01000.00");
    EXPECT_EQ(names.metres(12499.9889), "12500.00");
    EXPECT_EQ(names.metres(123500.011), "123500.00");
    for (const double end : ends)
        EXPECT_EQ(names.window_end(names.metres(end)), end);
    EXPECT_EQ(names.window_end("00499.98"), 499.98); // an older version's name
    EXPECT_EQ(names.kilometres(0.0), "0.0");
    EXPECT_EQ(names.kilometres(499.98), "0.5");
    EXPECT_EQ(names.kilometres(12499.9889), "12.5");
}

TEST(MomentNames, OfASmallModelTellItsMomentsApart) {
    const std::vector<double> ends{0.0, 0.0040002, 0.0079998, 0.012, 0.0160001, 0.02};
    const MomentNames names(0.004, ends);
    std::set<std::string> metres, kilometres;
    for (const double end : ends) {
        metres.insert(names.metres(end));
        kilometres.insert(names.kilometres(end));
        EXPECT_EQ(names.window_end(names.metres(end)), end);
    }
    EXPECT_EQ(metres.size(), ends.size());
    EXPECT_EQ(kilometres.size(), ends.size());
    EXPECT_EQ(names.metres(0.0), "00000.00");
    EXPECT_EQ(names.metres(0.02), "00000.02");
    EXPECT_EQ(names.metres(0.0040002), "00000.004");
}

TEST(MomentNames, OfAStopAreNotThoseOfAWindow) {
    const std::vector<double> ends{0.0, 99.9981, 199.9999};
    MomentNames names(100.0, ends);
    EXPECT_EQ(names.metres(120.04), "00120.04");
    // Stops are cycles away from ends.
    for (const double stop : {99.98, 100.02, 200.04, 299.999, 0.02}) {
        const std::string name = names.metres(stop);
        EXPECT_FALSE(names.window_end(name)) << name;
        EXPECT_NE(name, "00300.00");
        EXPECT_NEAR(*extension_of(name), stop, 0.01);
    }
    names.name_after(120.0, 0.01);
    EXPECT_EQ(names.metres(119.993), "00120.00");
    EXPECT_EQ(names.metres(119.98), "00119.98");
    EXPECT_EQ(names.kilometres(120.0), "0.12");
    EXPECT_NE(names.kilometres(203.0), names.kilometres(199.9999));
    EXPECT_NE(names.kilometres(297.0), "0.3"); // which comes
}

TEST(MomentNames, AreReadStrictly) {
    EXPECT_EQ(extension_of("00100.02"), 100.02);
    EXPECT_EQ(extension_of("123456.0001"), 123456.0001);
    for (const char* other : {"100.02", "00100", "00100.0", "000100.02", "00100.02m", "-0100.02",
                              "1e100.00", " 0100.02", "00100.0x", ""})
        EXPECT_FALSE(extension_of(other)) << other;
    EXPECT_TRUE(is_kilometres("0.00002") && is_kilometres("12.35"));
    EXPECT_FALSE(is_kilometres("25") || is_kilometres("01.5") || is_kilometres(".5") ||
                 is_kilometres("1.5.2"));
}

TEST(MomentNames, LengthsAreToldInTheirUnit) {
    EXPECT_EQ(way_text(520.0, 10e3), "0.52 of 10.00 km");
    EXPECT_EQ(way_text(0.0105, 0.04), "10.50 of 40.00 mm");
    EXPECT_EQ(length_text(2500.0), "2.50 km");
    EXPECT_EQ(length_text(-1000.0), "-1.00 km"); // shortened
    EXPECT_EQ(length_text(100.016, 100.0), "100.02 m");
    EXPECT_EQ(length_text(0.0113, 0.004), "0.011 m");
}

} // namespace
} // namespace listric::moment_names_test
