// Drawings of a fault: what is read, what is refused by name, and fits that are kept.

#include "apps/scene/picks/kept_fit.hpp"
#include "apps/scene/picks/picked_fault.hpp"
#include "apps/scene/svg/fault_svg.hpp"
#include "apps/scene/svg/svg_path.hpp"
#include "apps/support/error.hpp"
#include "apps/support/words/spelling.hpp"
#include "tests/message_of.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace listric::fault_svg_test {

using namespace dem;

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* d = "M60,40C130,250 230,340 320,340H710";

class Drawing : public testing::Test {
protected:
    fs::path file = fs::path(testing::TempDir()) / fmt::format("listric-{}.svg", getpid());
    FaultSource source;
    Drawing() {
        source.svg = file.string();
        source.svg_path = "fault";
        source.svg_points = {{60, 40, 0, 0}, {710, 340, 13000, 3000}};
    }
    ~Drawing() override { fs::remove(file); }

    FaultPoints read(const std::string& inside, const std::string& outer = "") {
        std::ofstream(file) << fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" {}>{}</svg>",
                                           outer, inside);
        return read_fault_svg(source, file);
    }
    std::string complaint(const std::string& inside, const std::string& outer = "") {
        return support::message_of<SceneError>([&] {
            const FaultPoints fault = read(inside, outer);
            DetachmentParameters detachment;
            fit_detachment(detachment, fault, source.tolerance);
        });
    }
    /// Whether the first and the last point are at the ends of the section.
    void expect_placed(const std::string& inside, const std::string& outer = "") {
        SCOPED_TRACE(inside);
        const FaultPoints fault = read(inside, outer);
        EXPECT_NEAR(fault.points.front().x, 0.0, 1e-6);
        EXPECT_NEAR(fault.points.front().y, 0.0, 1e-6);
        EXPECT_NEAR(fault.points.back().x, 13000.0, 1e-6);
        EXPECT_NEAR(fault.points.back().y, -3000.0, 1e-6);
    }
};

std::string path(const std::string& attributes = "", const std::string& data = d) {
    return fmt::format("<path id=\"fault\" {} d=\"{}\"/>", attributes, data);
}

TEST_F(Drawing, AllThatMovesAPathIsRead) {
    expect_placed(path());
    expect_placed(path("transform=\"skewX(0) skewY(0)\""));
    expect_placed(path("transform=\"rotate(90 60 40),rotate(-90,60,40)\""));
    expect_placed(path("transform=\"skewX(30) matrix(1 0 -.5773502691896257 1 0 0)\""));
    const std::string from_zero = "m0 0c70 210 170 300 260 300h390";
    expect_placed(path("style=\"fill:url(a;b);transform: translate(60px,40px)\"", from_zero));
    expect_placed(
        "<g style=\"transform:rotate(0.5turn)\"><g transform=\"scale(-1) translate(60 40)\">" +
        path("", from_zero) + "</g></g>");
    expect_placed("<svg x=\"60\" y=\"40\">" + path("", from_zero) + "</svg>");
    expect_placed("<svg x=\"60\" y=\"40\" width=\"100\" height=\"30\" viewBox=\"10 0 50 10\">" +
                  path("transform=\"translate(10 -2.5) scale(.5)\"", from_zero) + "</svg>");
    expect_placed("<svg width=\"100%\" height=\"50%\" viewBox=\"0 0 800 200\">" + path() + "</svg>",
                  "viewBox=\"0 0 800 400\"");
    EXPECT_THAT(complaint(path("style=\"transform:rotate(3)\"")), HasSubstr("has no unit"));
    EXPECT_THAT(complaint(path("transform=\"rotate3d(3)\"")), HasSubstr("rotate3d with 1 number"));
}

TEST_F(Drawing, LinesOfEveryKindAreFound) {
    expect_placed("<polyline id=\"fault\" points=\"60,40 100 140 320,340,710-.340e3 710,340\"/>");
    expect_placed("<line id=\"fault\" x1=\"60\" y1=\"40px\" x2=\"710\" y2=\"340\"/>");
    expect_placed(fmt::format("<path id=\"path12\" inkscape:label=\"fault\" d=\"{}\"/>", d));
    expect_placed(fmt::format("<g id=\"fault\"><text/><path d=\"{}\"/></g>", d));
    expect_placed(fmt::format("<s:g xmlns:s=\"http://www.w3.org/2000/svg\"><s:path id=\"fault\" "
                              "d=\"{}\"/></s:g>",
                              d));
    EXPECT_THAT(complaint("<rect id=\"fault\"/>"), HasSubstr("fault is a <rect>, which is closed"));
    EXPECT_THAT(complaint("<use id=\"fault\" href=\"#a\"/>"), HasSubstr("a clone of #a"));
    EXPECT_THAT(complaint("<g id=\"fault\"><path id=\"a\"/><path id=\"b\"/></g>"),
                HasSubstr("has 2 paths: a, b"));
    EXPECT_THAT(complaint("<path id=\"falt\033[31m\"/>"),
                AllOf(HasSubstr("has no path with the id")));
    EXPECT_THAT(complaint("<text/>"), HasSubstr("has no path, polyline or line"));
}

TEST_F(Drawing, NamesOfDrawingProgramsAreFound) {
    source.svg_path = "Main fault";
    const auto layer = [](const char* attributes, const char* first = "") {
        return fmt::format(
            "<g id=\"horizons\"><path d=\"M0,0H9\"/></g><g {}>{}<path d=\"{}\"/></g>", attributes,
            first, d);
    };
    expect_placed(layer("id=\"Main_fault\" data-name=\"Main fault\"")); // Illustrator
    expect_placed(layer("id=\"Main_x20_fault\""));
    expect_placed(layer("id=\"Main_fault\""));
    expect_placed(layer("id=\"Main-fault1\" serif:id=\"Main fault\"")); // Affinity
    expect_placed(layer("id=\"Main_x0020_fault\""));                    // CorelDRAW
    expect_placed(layer("id=\"g7\"", "<title>Main fault</title>"));
    EXPECT_THAT(complaint(layer("id=\"Main_faults\"")),
                AllOf(HasSubstr("did you mean Main_faults?"),
                      HasSubstr("its groups: horizons, Main_faults")));
    EXPECT_THAT(complaint(layer("id=\"x\" data-name=\"Thrust\"")),
                HasSubstr("its groups: horizons, x (label Thrust)"));
}

TEST_F(Drawing, WhatIsNotReadIsNamed) {
    EXPECT_THAT(complaint("<symbol>" + path() + "</symbol>"), HasSubstr("is inside <symbol>"));
    EXPECT_THAT(complaint("<defs><g>" + path() + "</g></defs>"), HasSubstr("is inside <defs>"));
    EXPECT_THAT(complaint("<g style=\"display:none\">" + path() + "</g>"),
                HasSubstr("display: none"));
    EXPECT_THAT(complaint("<style>.a{transform:scale(2)}</style>" + path()),
                HasSubstr("for classes"));
    EXPECT_THAT(complaint(path("transform=\"scale(0)\"")), HasSubstr("a point or a line"));
    EXPECT_THAT(complaint("<g transform=\"matrix(1e300 0 0 1e300 0 0)\">" +
                          path("transform=\"scale(1e300)\"") + "</g>"),
                HasSubstr("not finite"));
    EXPECT_THAT(complaint(path("", "M60 40 60 40")), HasSubstr("at one place"));
    EXPECT_THAT(complaint(path("", "M60 40H700H710")), HasSubstr("the fault is flat"));
    for (const char* wrong : {"M60,,40 7 7", "M60 40 +-7 7", "M60 40 L inf 7", "M 60 40 L 1e999 7"})
        EXPECT_THAT(complaint(path("", wrong)), HasSubstr("number")) << wrong;
}

TEST_F(Drawing, DepthAndNumberAreNoCrash) {
    std::string deep;
    for (int k = 0; k < 100'000; ++k)
        deep += "<g>";
    deep += path();
    for (int k = 0; k < 100'000; ++k)
        deep += "</g>";
    expect_placed(deep);
    std::string arcs = "M0 0";
    for (int k = 0; k < 30'000; ++k)
        arcs += "a1 1 0 0110 10";
    EXPECT_THAT(complaint(path("", arcs)), HasSubstr("has 30001 nodes, allowed: at most 20000"));
    std::string pencil = "M60 40";
    for (int k = 0; k < 400; ++k)
        pencil += "c.5.2 1 .5 1.625.75";
    const FaultPoints fault = read(path("", pencil));
    EXPECT_LT(fault.points.size(), 1000u);
    EXPECT_EQ(fault.where.size(), 1u);
}

TEST_F(Drawing, ReferencePointsThatDisagreeAreRefused) {
    source.svg_points = {{60, 40, 0, 0}, {385, 190, 6500, 1600}, {710, 340, 13000, 3000}};
    EXPECT_THAT(complaint(path()), HasSubstr("the second is 67 m off"));
    source.svg_points[1][3] = 1530.0;
    EXPECT_NEAR(read(path()).place.misfit, 20.0, 1e-6);
    EXPECT_NEAR(read(path()).place.exaggeration, 2.0, 0.02);
    source.svg_points = {{60, 40, 0, 0}, {61, 340, 20, 3000}};
    EXPECT_THAT(complaint(path()), HasSubstr("take points further apart"));
}

TEST_F(Drawing, StraightPiecesAreNoGaps) {
    const std::string lines = "M 60 40 L 210 290 L 460 360 ";
    EXPECT_EQ(complaint(path("", lines + "L 560 374 L 760 374")), "accepted");
    EXPECT_EQ(complaint(path("", lines + "C 504.565 372.478 515 374 560 374 L 760 374")),
              "accepted");
    DetachmentParameters detachment;
    fit_detachment(detachment, read(path("", lines + "L 560 374 L 760 374")), source.tolerance);
    EXPECT_EQ(too_sharp(detachment, 90.0), "");
}

TEST(PickedGap, IsJudgedByWhatTheFaultMayDoInIt) {
    FaultPoints fault;
    const auto add = [&](double x, double depth) {
        fault.points.push_back({x, -depth});
        fault.where.push_back(fmt::format("f.csv:{}", fault.points.size() + 1));
    };
    const auto said = [&] {
        DetachmentParameters detachment;
        return support::message_of<SceneError>([&] { fit_detachment(detachment, fault, 50.0); });
    };
    // Near picks on a bend, a straight ramp of 4 km without any, and again near ones.
    for (double k = 0.0; k < 20.0; ++k)
        add(50.0 * k, 50.0 * k);
    for (double k = 0.0; k < 20.0; ++k)
        add(5000.0 + 50.0 * k, 5000.0 + 50.0 * k);
    for (double dip = 45.0; dip >= 0.0; dip -= 1.0) {
        const double a = dip * 3.14159265358979 / 180.0;
        add(5950.0 + 3000.0 * (std::sqrt(0.5) - std::sin(a)),
            5950.0 + 3000.0 * (std::cos(a) - std::sqrt(0.5)));
    }
    for (double k = 1.0; k < 100.0; ++k)
        add(8071.0 + 50.0 * k, 6829.0);
    EXPECT_EQ(said(), "accepted");
    for (std::size_t k = 0; k < 40; ++k) { // without most of the bend
        fault.points.erase(fault.points.begin() + 43);
        fault.where.erase(fault.where.begin() + 43);
    }
    EXPECT_THAT(said(), AllOf(HasSubstr("f.csv:"), HasSubstr("after a gap of")));
    fault.points[3].y = std::nan("");
    EXPECT_THAT(said(), HasSubstr("f.csv:5: has coordinates that are not finite"));
}

TEST(KeptFit, IsBelievedByItsContent) {
    std::vector<Point> points;
    for (double x = 0.0; x <= 15e3; x += 500.0)
        points.push_back({x, -std::sqrt(15e3 * 15e3 - (15e3 - x) * (15e3 - x))});
    points.push_back({25e3, -15e3});
    const FaultFit fit = fit_fault(points, 50.0);
    const std::string text = kept_text(fit, points, 50.0);
    const auto again = recalled(text, points, 50.0);
    ASSERT_TRUE(again);
    EXPECT_EQ(kept_text(*again, points, 50.0), text);
    EXPECT_EQ(again->worst, fit.worst);
    EXPECT_FALSE(recalled(text, points, 49.0));
    EXPECT_FALSE(recalled(text.substr(0, text.size() - 12), points, 50.0));
    EXPECT_FALSE(recalled("", points, 50.0));
    std::string other = text;
    other[other.rfind("0x1.") + 5] ^= 1; // the length of the flat: no point tells of it
    other[other.find("0x1.", text.size() - 150) + 5] ^= 1;
    EXPECT_FALSE(recalled(other, points, 50.0));
    points.back().x += 1.0;
    EXPECT_FALSE(recalled(text, points, 50.0));
}

TEST(Ordinal, IsEnglish) {
    EXPECT_EQ(ordinal(2), "second");
    EXPECT_EQ(ordinal(11), "11th");
    EXPECT_EQ(ordinal(21), "21st");
    EXPECT_EQ(ordinal(112), "112th");
}

} // namespace

} // namespace listric::fault_svg_test
