// Detachments from picked faults: fitted to points whose chain is known, read from good files, and
// refused with file, line and cure.

#include "apps/measures/paper/blocks.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/picks/fault_fit.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/error.hpp"
#include "dem/numbers/random.hpp"
#include "tests/message_of.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace listric::picked_fault_test {

using namespace dem;

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

Scene shipped(const char* name) {
    SceneRequest request;
    request.scene = name;
    return load_scene(request, program_effects());
}

/// Points of a shipped scene's detachment every so many metres, down to 15 km beyond its last arc.
std::vector<Point> sampled(const Scene& scene, double spacing, double noise) {
    const Chain chain = detachment_chain(*scene.detachment, 0.0);
    const double end = length_of(chain) - chain.back().length + 15e3;
    std::vector<Point> points;
    for (std::uint64_t k = 0; static_cast<double>(k) * spacing <= end; ++k) {
        Point p = point_at(chain, static_cast<double>(k) * spacing);
        if (k > 0) {
            p.x += noise * (2.0 * uniform(7, Purpose::sweep_order, k, 1) - 1.0);
            p.y += noise * (2.0 * uniform(7, Purpose::sweep_order, k, 2) - 1.0);
        }
        points.push_back(p);
    }
    return points;
}

/// Largest distance of a chain from another, down to 15 km beyond its last arc.
double largest_distance(const Chain& of, const Chain& from) {
    const double end = length_of(of) - of.back().length + 15e3;
    double largest = 0.0;
    for (double s = 0.0; s <= end; s += 20.0)
        largest = std::max(largest, distance_from(from, point_at(of, s)));
    return largest;
}

double largest_distance(const std::vector<Point>& points, const Chain& from) {
    double largest = 0.0;
    for (const Point p : points)
        largest = std::max(largest, distance_from(from, p));
    return largest;
}

// Without noise the points are on arcs and lines, which the fit must find: a hundredth of the
// tolerance. With noise of 20 m along each axis it may be off by as much as the noise, since what
// is fitted is a mean of many points, but at the kink of rfr, which has few.
TEST(FaultFit, FindsTheChainsOfTheShippedScenes) {
    for (const char* name : {"lis1", "lis2", "rfr"})
        for (double noise : {0.0, 20.0}) {
            SCOPED_TRACE(fmt::format("{}, noise {}", name, noise));
            const Scene scene = shipped(name);
            const std::vector<Point> points = sampled(scene, 500.0, noise);
            const double tolerance = noise > 0.0 ? 60.0 : 50.0;
            const FaultFit fit = fit_fault(points, tolerance);
            EXPECT_TRUE(fit.flat);
            EXPECT_LE(fit.segments.size(), 7u);
            for (const DetachmentSegment& segment : fit.segments)
                EXPECT_LE(segment.radius, 1e9) << "scene.toml could not be read again";
            const Chain chain =
                detachment_chain({.start_dip = fit.start_dip, .segments = fit.segments}, 1e5);
            EXPECT_LT(largest_distance(detachment_chain(*scene.detachment, 0.0), chain),
                      noise > 0.0 ? tolerance : 0.5);
            EXPECT_NEAR(fit.misfit, largest_distance(points, chain), 1e-9);
            EXPECT_LE(fit.misfit, tolerance);
            // Measures of a ramp-flat-ramp want a flat that is flat.
            EXPECT_EQ(measures::find_ramp_flat_ramp(chain).has_value(), name == std::string("rfr"));
        }
}

TEST(FaultFit, SamplesThatEndWhereTheArcIsNearlyFlat) {
    const Scene scene = shipped("lis1");
    std::vector<Point> points = sampled(scene, 500.0, 0.0);
    std::erase_if(points, [](Point p) { return p.x > 14.5e3; }); // dip 1.9 degrees, 8 m from flat
    const FaultFit fit = fit_fault(points, 50.0);
    EXPECT_TRUE(fit.flat);
    EXPECT_NEAR(
        detachment_chain({.start_dip = fit.start_dip, .segments = fit.segments}, 0.0).back().end.y,
        -15e3, 10.0);
    std::erase_if(points, [](Point p) { return p.x > 10e3; }); // dip 21.2 degrees
    const FaultFit steep = fit_fault(points, 50.0);
    EXPECT_FALSE(steep.flat);
    EXPECT_NEAR(steep.end_dip, 90.0 - 18e3 / 15e3 * 180.0 / 3.14159265, 0.1);
}

class PickedFaultFile : public testing::Test {
protected:
    fs::path folder = fs::path(testing::TempDir()) / fmt::format("listric-picked-{}", getpid());
    PickedFaultFile() { fs::create_directories(folder); }
    ~PickedFaultFile() override { fs::remove_all(folder); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name, std::ios::binary) << text;
    }
    /// lis1 with the keys of [detachment] given.
    Scene load(const std::string& keys, const std::string& more = "") const {
        write("own.toml", fmt::format("accuracy = \"draft\"\n[hanging_wall]\nlength_m = 40000.0\n{}"
                                      "[detachment]\n{}\n[gravity]\n",
                                      more, keys));
        SceneRequest request;
        request.scene = (folder / "own.toml").string();
        return load_scene(request, program_effects());
    }
    std::string complaint(const std::string& keys, const std::string& more = "") const {
        return support::message_of<SceneError>([&] { load(keys, more); });
    }
    /// Message about a file of this text; one line.
    std::string complaint_of(const std::string& text) const {
        write("fault.csv", text);
        const std::string said = complaint("csv = \"fault.csv\"");
        EXPECT_EQ(std::ranges::count(said, '\n'), 0) << said;
        EXPECT_THAT(said, HasSubstr("fault.csv"));
        return said;
    }
};

/// lis1's detachment every 500 m as a table.
std::string table(const char* delimiter = ",", const char* end = "\n", double factor = 1.0) {
    std::string text = fmt::format("x_m{}depth_m{}", delimiter, end);
    for (const Point p : sampled(shipped("lis1"), 500.0, 0.0))
        text +=
            fmt::format("{:.3f}{}{:.3f}{}", factor * p.x, delimiter, factor * std::abs(p.y), end);
    return text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST_F(PickedFaultFile, ASceneOfIt) {
    write("fault.csv", table());
    const Scene scene = load("csv = \"fault.csv\"");
    ASSERT_TRUE(scene.picked_fault);
    EXPECT_NEAR(scene.hanging_wall.thickness, 15e3, 0.01);
    EXPECT_NEAR(scene.detachment->start_dip, 90.0, 0.01);
    ASSERT_EQ(scene.detachment->segments.size(), 2u);
    EXPECT_NEAR(scene.detachment->segments[0].radius, 15e3, 1.0);
    EXPECT_LT(scene.picked_fault->misfit, 0.1);
    // The scene that a run writes stands alone.
    write("written.toml", to_toml(scene));
    fs::remove(folder / "fault.csv");
    SceneRequest request;
    request.scene = (folder / "written.toml").string();
    EXPECT_EQ(to_toml(load_scene(request, program_effects())), to_toml(scene));
}

TEST_F(PickedFaultFile, GoodVariants) {
    const double wanted = 15e3;
    const auto depth = [&](const std::string& text, const std::string& keys) {
        write("fault.csv", text);
        return load("csv = \"fault.csv\"\n" + keys).hanging_wall.thickness;
    };
    EXPECT_NEAR(depth("\xef\xbb\xbf" + table(), ""), wanted, 0.01);
    EXPECT_NEAR(depth(table(",", "\r\n"), ""), wanted, 0.01);
    EXPECT_NEAR(depth(table(";"), "csv_delimiter = \";\""), wanted, 0.01);
    EXPECT_NEAR(depth(table("\t"), "csv_delimiter = \"tab\""), wanted, 0.01);
    for (const char* delimiter : {";", "\t", " ", "   "}) // the header tells
        EXPECT_NEAR(depth(table(delimiter), ""), wanted, 0.01);
    EXPECT_NEAR(depth(table(",", "\r"), ""), wanted, 0.01);
    std::string fortran = "x_m,depth_m\n";
    for (const Point p : sampled(shipped("lis1"), 500.0, 0.0)) {
        std::string row = fmt::format("{:+.6E},{:+.6E}\n", p.x, std::abs(p.y));
        std::ranges::replace(row, 'E', 'D');
        fortran += row;
    }
    EXPECT_NEAR(depth(fortran, ""), wanted, 0.1);
    EXPECT_NEAR(depth("# picked by hand\n\n" + table(), ""), wanted, 0.01);
    std::string moved = "x_m,depth_m\n";
    for (const Point p : sampled(shipped("lis1"), 500.0, 0.0))
        moved += fmt::format("{:.3f},{:.3f}\n", p.x + 31250.0, -p.y);
    EXPECT_NEAR(depth(moved, "shift_x_m = -31250.0"), wanted, 0.01);
    // Noise goes back and up by less than the tolerance.
    std::string noisy = "x_m,depth_m\n";
    for (const Point p : sampled(shipped("lis1"), 100.0, 20.0))
        noisy += fmt::format("{:.3f},{:.3f}\n", p.x, -p.y);
    EXPECT_NEAR(depth(noisy, "tolerance_m = 60.0"), wanted, 20.0);
}

TEST_F(PickedFaultFile, DamagedOnesAreRefusedWithLineAndCure) {
    EXPECT_THAT(complaint_of(""), HasSubstr("needs x_m, depth_m"));
    EXPECT_THAT(complaint_of("x_m,depth_m\n"), HasSubstr("has no rows"));
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,0\n"), HasSubstr(":2: has 1 point, needs at least 3"));
    EXPECT_THAT(complaint_of(replaced(table(), "\n0.000,0.000", "\n0.000,surface")),
                HasSubstr(":2: depth_m: \"surface\" is not a finite number"));
    EXPECT_THAT(complaint_of(replaced(table(), "\n0.000,0.000", "\nnan,0")), HasSubstr(":2: x_m"));
    EXPECT_THAT(complaint_of(replaced(table(), "\n0.000,0.000", "\n0.000,")),
                HasSubstr(":2: depth_m: \"\""));
    EXPECT_THAT(complaint_of(replaced(table(), "x_m,depth_m", "x_ft,depth_ft")),
                HasSubstr("1 ft = 0.3048 m"));
    EXPECT_THAT(complaint_of(replaced(table(), "x_m,depth_m", "x,z")),
                AllOf(HasSubstr("has no column x_m, needs a header with x_m, depth_m"),
                      HasSubstr("call x x_m")));
    write("fault.csv", table());
    EXPECT_THAT(complaint("csv = \"fault.csv\"\ncsv_delimiter = \"tab\""),
                HasSubstr("seem to be parted by ,; give csv_delimiter = \",\""));
    // In the order of the file: 500 m further down the points go on from 2 km.
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,0\n5000,5000\n2000,2000\n20000,8000\n40000,8000\n"),
                AllOf(HasSubstr(":4: x_m goes back by 3000 m"), HasSubstr("fold back")));
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,0\n5000,5000\n15000,3000\n20000,5000\n40000,5000\n"),
                HasSubstr(":4: the fault rises by 2000 m"));
    EXPECT_THAT(complaint_of("x_m,depth_m\n40000,8000\n20000,8000\n5000,5000\n0,0\n"),
                HasSubstr("deep end; turn their order round"));
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,0\n-5000,5000\n-20000,8000\n-40000,8000\n"),
                HasSubstr("change the sign of x_m"));
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,0\n5000,-5000\n20000,-8000\n40000,-8000\n"),
                AllOf(HasSubstr(":3:"), HasSubstr("depth is positive down")));
    EXPECT_THAT(complaint_of("x_m,depth_m\n1000,0\n5000,5000\n20000,8000\n40000,8000\n"),
                HasSubstr("shift_x_m = -1000"));
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,600\n5000,5000\n20000,8000\n40000,8000\n"),
                HasSubstr(":2: begins at a depth of 600 m"));
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,0\n5000,5000\n10000,10000\n15000,15000\n"),
                AllOf(HasSubstr(":5: ends with a dip of 45"), HasSubstr("flat")));
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,0\n5e9,5000\n6e9,8000\n"), HasSubstr("in metres?"));
    std::string gap = "x_m,depth_m\n";
    for (const Point p : sampled(shipped("lis1"), 500.0, 0.0))
        if (p.x < 1e3 || p.x > 9e3)
            gap += fmt::format("{:.3f},{:.3f}\n", p.x, -p.y);
    EXPECT_THAT(complaint_of(gap), HasSubstr("after a gap of"));
    std::string many = "x_m,depth_m\n";
    for (int k = 0; k < 1'000'000; ++k)
        many += "0,0\n";
    EXPECT_THAT(complaint_of(many), HasSubstr("has 1000000 points, allowed: at most 20000"));
    EXPECT_THAT(complaint_of("x_m,depth_m\n0,0\n200,5000\n200,8000\n10000,8000\n20000,8000\n"),
                HasSubstr("more sharply than discs"));
}

TEST_F(PickedFaultFile, OfSeveralLinesIsRefused) {
    const std::string rows[] = {"0,0\n", "5000,5000\n", "10000,9000\n", "20000,9000\n"};
    for (const std::string column : {"line", "name", "segment"})
        EXPECT_THAT(complaint_of(column + ",x_m,depth_m\na," + rows[0] + "a," + rows[1] + "b," +
                                 rows[2] + "b," + rows[3]),
                    HasSubstr(":4: begins the line \"b\" after the line \"a\"; a detachment is one "
                              "line: leave the rows of the others out"));
    // Names of points, and what an export writes of one line.
    std::string named = "name,x_m,depth_m\n", line = "line,name,depth_reference,x_m,depth_m\n";
    int number = 0;
    for (const Point p : sampled(shipped("lis1"), 500.0, 0.0)) {
        named += fmt::format("p{},{:.3f},{:.3f}\n", number++, p.x, -p.y);
        line += fmt::format("0,detachment,original surface,{:.3f},{:.3f}\n", p.x, -p.y);
    }
    for (const std::string& text : {named, line}) {
        write("fault.csv", text);
        EXPECT_NEAR(load("csv = \"fault.csv\"").hanging_wall.thickness, 15e3, 1.0);
    }
}

TEST_F(PickedFaultFile, KeysThatDoNotGoTogether) {
    write("fault.csv", table());
    EXPECT_THAT(complaint("csv = \"falt.csv\""), HasSubstr("own.toml:5"));
    EXPECT_THAT(complaint("csv = \"fault.csv\"\nstart_dip_deg = 60.0"),
                HasSubstr("start_dip_deg: follows from the picked fault"));
    EXPECT_THAT(complaint("csv = \"fault.csv\"\nsvg = \"fault.svg\""), HasSubstr("leave out one"));
    EXPECT_THAT(complaint("csv = \"fault.csv\"\ntolerance = 3.0"),
                HasSubstr("did you mean tolerance_m"));
    EXPECT_THAT(complaint("csv = \"fault.csv\"", "thickness_m = 12000.0\n"),
                HasSubstr("leave out hanging_wall.thickness_m"));
}

/// The arc of 15 km as an elliptic arc and as Bezier curves, in groups with transformations, 100 m
/// a unit, with the breakaway at (50, 20).
TEST_F(PickedFaultFile, ADrawingGivesTheChainOfTheTable) {
    const std::string keys = "svg = \"fault.svg\"\nsvg_path = \"fault\"\n"
                             "svg_points = [[50, 20, 0, 0], [450, 170, 40000, 15000]]";
    const double k = 150.0 * 0.5522847498; // of a quarter circle by one cubic curve
    const auto drawn = [&](const std::string& group, const std::string& path) {
        write("fault.svg", fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\"><g {}><path id="
                                       "\"other\" d=\"M0 0L1 1\"/><path id=\"fault\" d=\"{}\"/>"
                                       "</g></svg>",
                                       group, path));
        return load(keys);
    };
    const std::string curve = fmt::format("M50,20C50,{} {},170 200,170H450", 20.0 + k, 200.0 - k);
    const std::string shifted = fmt::format("m 40 10 c 0,{} {},150 150,150 l 250 0", k, 150.0 - k);
    for (const auto& [group, path] : std::vector<std::pair<std::string, std::string>>{
             {"", "M 50 20 A 150 150 0 0 0 200 170 L 450 170"},
             {"", curve},
             {"transform=\"translate(10 10)\"", shifted},
             {"transform=\"matrix(2 0 0 2 0 0)\"", "M25 10a75 75 0 0075 75h125"}}) {
        SCOPED_TRACE(path);
        const Scene scene = drawn(group, path);
        EXPECT_NEAR(scene.hanging_wall.thickness, 15e3, 5.0);
        EXPECT_LT(largest_distance(detachment_chain(*shipped("lis1").detachment, 0.0),
                                   detachment_chain(*scene.detachment, 1e5)),
                  50.0);
    }
    EXPECT_THAT(complaint(replaced(keys, "\"fault\"", "\"falt\"")), HasSubstr("other, fault"));
    EXPECT_THAT(complaint(replaced(keys, ", [450, 170, 40000, 15000]", "")),
                HasSubstr("two points that differ across"));
    const auto refused = [&](const std::string& path) {
        write("fault.svg", fmt::format("<svg><path id=\"fault\" d=\"{}\"/></svg>", path));
        return complaint(keys);
    };
    EXPECT_THAT(refused("M 50 20 L 200 170 450 170 Z"), HasSubstr("closed"));
    EXPECT_THAT(refused("M 50 20 L 200"), HasSubstr("a number is missing"));
    EXPECT_THAT(refused("M 50 20 L 200 170 M 300 170 L 450 170"), HasSubstr("second part"));
    write("fault.svg", "<svg><path");
    EXPECT_THAT(complaint(keys), HasSubstr("cannot be read as SVG"));
}

} // namespace

} // namespace listric::picked_fault_test
