// Data sets of labelled sections: their plans and splits, lines as masks, noise, hashes.

#include "apps/studies/dataset/labelled_section.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/sha256.hpp"
#include "tests/message_of.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

namespace listric::dataset_test {

namespace {

using dem::Point;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

const std::string plan_text = R"(scene = "lis1"
accuracy = "draft"
measures = ["strain_top10"]
[dataset]
split_by = "shape"
validation = "lis1"
test = "shallow"
[[vary]]
parameter = "shape"
values = ["lis1", "shallow", "steep"]
sets = [
    "",
    "hanging_wall.thickness_m=10000 detachment={start_dip_deg=90, segments=[{arc={radius_m=10000, end_dip_deg=0}}, {line={length_m=60000}}]}",
    "hanging_wall.thickness_m=12000 detachment={start_dip_deg=90, segments=[{arc={radius_m=12000, end_dip_deg=0}}, {line={length_m=60000}}]}",
]
[[vary]]
parameter = "detachment.friction"
values = [0.1, 0.5]
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

class DatasetPlanFile : public testing::Test {
protected:
    std::filesystem::path file =
        std::filesystem::temp_directory_path() /
        ("dataset-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
         ".toml");
    ~DatasetPlanFile() override { std::filesystem::remove(file); }

    DatasetPlan load(const std::string& text) {
        std::ofstream(file) << text;
        return load_dataset_plan(file);
    }
    std::string complaint(const std::string& from, const std::string& to) {
        return support::message_of<SceneError>([&] { load(replaced(plan_text, from, to)); });
    }
};

TEST_F(DatasetPlanFile, AShapeIsInOneSplitAndChangesSeveralParameters) {
    const DatasetPlan plan = load(plan_text);
    const std::vector<SweepPoint> points = sweep_points(plan.sweep);
    ASSERT_EQ(points.size(), 6u);
    std::set<std::pair<std::string, std::string>> splits; // of shapes
    for (const SweepPoint& point : points)
        splits.emplace(point[0].text, plan.split_of(point));
    EXPECT_THAT(splits, ElementsAre(Pair("lis1", "validation"), Pair("shallow", "test"),
                                    Pair("steep", "train")));
    const Scene scene = scene_at(plan.sweep, points[2], 1);
    EXPECT_EQ(scene.hanging_wall.thickness, 10000.0);
    EXPECT_EQ(scene.detachment->segments[0].radius, 10000.0);
    EXPECT_TRUE(plan.sweep.needs_moments()); // runs keep what faults are traced from
}

TEST_F(DatasetPlanFile, WrongOnesAreRefusedWithLineAndCure) {
    EXPECT_THAT(complaint("split_by = \"shape\"", "split_by = \"form\""),
                HasSubstr(".toml:5: dataset.split_by: form: no [[vary]] has this parameter"));
    EXPECT_THAT(
        complaint("validation = \"lis1\"", "validation = \"lis2\""),
        HasSubstr(".toml:6: dataset.validation: shape has no value lis2; did you mean lis1"));
    EXPECT_THAT(complaint("test = \"shallow\"", "test = \"shallow lis1\""),
                HasSubstr(".toml:7: dataset.test: lis1 is in validation, too"));
    EXPECT_THAT(complaint("test =", "noise = [0.5, 0.1]\ntest ="),
                HasSubstr(".toml:7: dataset.noise: needs two numbers, [least, greatest]"));
    EXPECT_THAT(complaint("test =", "noise = [0.5, 11]\ntest ="), HasSubstr("dataset.noise"));
    EXPECT_THAT(complaint("test =", "tests ="), HasSubstr("dataset.tests: unknown key"));
    EXPECT_THAT(complaint("[dataset]\nsplit_by = \"shape\"\nvalidation = \"lis1\"\ntest = "
                          "\"shallow\"\n",
                          ""),
                HasSubstr("needs [dataset]"));
    EXPECT_THAT(complaint("    \"\",\n", ""),
                HasSubstr(".toml:11: vary[0].sets: needs as many texts as there are values, 3; it "
                          "has 2"));
    EXPECT_THAT(complaint("    \"\",\n", "    \"seed=3\",\n"),
                HasSubstr("give seeds and first_seed"));
    EXPECT_THAT(complaint("    \"\",\n", "    \"detachment.frction=0.1\",\n"),
                HasSubstr("detachment.frction"));
}

/// Samples of a grid that a line marks.
std::set<std::pair<std::size_t, std::size_t>> marked(const std::vector<Point>& line, double width,
                                                     std::size_t traces = 40,
                                                     std::size_t samples = 40) {
    std::set<std::pair<std::size_t, std::size_t>> all;
    for_samples_near(
        line, width, traces, samples,
        [&](std::size_t trace, std::size_t sample, double) { all.emplace(trace, sample); });
    return all;
}

TEST(FaultMask, IsAsWideAsStatedAndWithoutGaps) {
    // An upright line on a trace, three samples wide, from sample 5 to 25.
    const auto upright = marked({{10.0, 5.0}, {10.0, 25.0}}, 3.0);
    for (std::size_t k = 5; k <= 25; ++k)
        for (std::size_t trace = 0; trace < 40; ++trace)
            EXPECT_EQ(upright.contains({trace, k}), trace >= 9 && trace <= 11) << trace << " " << k;
    EXPECT_FALSE(upright.contains({10, 3}));
    // A dipping one: distance to the line decides.
    const auto dipping = marked({{2.0, 1.0}, {30.0, 37.0}}, 3.0);
    for (std::size_t trace = 0; trace < 40; ++trace)
        for (std::size_t k = 0; k < 40; ++k) {
            const Point p{static_cast<double>(trace) - 2.0, static_cast<double>(k) - 1.0};
            const double length = std::hypot(28.0, 36.0);
            const double along = (28.0 * p.x + 36.0 * p.y) / length;
            const bool is_beside = along >= 0.0 && along <= length;
            if (is_beside) {
                EXPECT_EQ(dipping.contains({trace, k}),
                          std::abs(28.0 * p.y - 36.0 * p.x) / length <= 1.5);
            }
        }
}

TEST(FaultMask, LinesBeyondTheGridMarkWhatLiesWithin) {
    EXPECT_TRUE(marked({{-9.0, -9.0}, {-5.0, -5.0}}, 3.0).empty());
    EXPECT_TRUE(marked({{60.0, 10.0}, {70.0, 20.0}}, 3.0).empty());
    const auto across = marked({{-5.0, 20.0}, {50.0, 20.0}}, 1.0);
    EXPECT_EQ(across.size(), 40u);
    EXPECT_TRUE(marked({}, 3.0).empty());
}

TEST(FaultMask, ThrowIsOfTheNearestPoint) {
    double at_middle = 0.0;
    for_samples_near(std::vector<Point>{{10.0, 0.0}, {10.0, 20.0}}, 1.0, 40, 40,
                     [&](std::size_t, std::size_t sample, double place) {
                         if (sample == 10)
                             at_middle = place;
                     });
    EXPECT_DOUBLE_EQ(at_middle, 0.5);
}

TEST(FaultMask, PiecesBelowTheLeastThrowOrHeightAreLeftOut) {
    std::vector<Point> points;
    for (int k = 0; k < 10; ++k)
        points.push_back({0.0, -100.0 * k});
    const std::vector<double> offset{5, 40, 50, 60, 5, 80, -70, -60, -90, 40};
    EXPECT_THAT(visible_pieces(points, offset, 30.0, 150.0),
                ElementsAre(Pair(1u, 3u), Pair(5u, 9u)));
    EXPECT_THAT(visible_pieces(points, offset, 30.0, 300.0), ElementsAre(Pair(5u, 9u)));
    EXPECT_TRUE(visible_pieces(points, offset, 100.0, 0.0).empty());
}

// The mean square of 64 x 256 samples, of which those of a wavelet's length and of neighbouring
// traces are alike: some 64/3 x 256/16 independent ones, an error of 8 %; four times that.
TEST(SeismicNoise, IsOfItsKeyAndOfUnitSize) {
    const std::vector<float> one = seismic_noise(7, 3, 64, 256, 0.1);
    EXPECT_EQ(one, seismic_noise(7, 3, 64, 256, 0.1));
    EXPECT_NE(one, seismic_noise(7, 4, 64, 256, 0.1));
    EXPECT_NE(one, seismic_noise(8, 3, 64, 256, 0.1));
    double square = 0.0, mean = 0.0;
    for (const float value : one) {
        square += static_cast<double>(value) * static_cast<double>(value) / (64.0 * 256.0);
        mean += static_cast<double>(value) / (64.0 * 256.0);
    }
    EXPECT_NEAR(square, 1.0, 0.32);
    EXPECT_NEAR(mean, 0.0, 0.05); // the wavelet has none
}

std::string sha256(const std::string& text) {
    Sha256 hash;
    for (std::size_t at = 0; at < text.size(); at += 7) // in pieces
        hash.add(
            std::as_bytes(std::span(text).subspan(at, std::min<std::size_t>(7, text.size() - at))));
    return hash.hexadecimal();
}

TEST(Sha256, OfTheStandardsExamples) {
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256(std::string(1'000'000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

} // namespace
} // namespace listric::dataset_test
