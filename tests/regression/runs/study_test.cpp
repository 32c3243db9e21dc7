// Studies of accuracy against time, on a scene small enough for a test.

#include "apps/run/run.hpp"
#include "apps/studies/study.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/csv_records.hpp"
#include "tests/small_halfgraben.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <string>
#include <unistd.h>

namespace listric::study_test {

using namespace dem;
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class StudyTest : public testing::Test {
protected:
    ~StudyTest() override { fs::remove_all(folder); }

    StudyRequest small(const std::string& name) const {
        const fs::path scene = folder / "small.toml";
        fs::create_directories(folder);
        std::ofstream(scene) << support::small_halfgraben("90.0") + R"([extension]
distance_m = 100.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
figures_at_m = []
series = "none"
[gravity]
[bonds]
)";
        StudyRequest request;
        request.name = name;
        request.scene = scene.string();
        request.seeds = 2;
        request.quiet = true;
        request.output = folder / "study";
        return request;
    }

    const fs::path folder =
        fs::path(testing::TempDir()) / ("listric-study-" + std::to_string(getpid()));
};

std::vector<StudyPoint> points(const fs::path& output) {
    std::vector<StudyPoint> all;
    const std::string text = support::contents(output / "study.csv");
    EXPECT_THAT(text, testing::StartsWith("method,parameter,quantity,error,wall_s,disc_steps\n"));
    read_records(text, "study.csv", ',', [&](const CsvRecord& r) {
        if (r.line > 1)
            all.push_back({r.cells[0], r.cells[1], r.cells[2], std::stod(r.cells[3]),
                           std::stod(r.cells[4]), std::stod(r.cells[5])});
        return true;
    });
    return all;
}

double error_of(const std::vector<StudyPoint>& all, const std::string& method,
                const std::string& parameter) {
    for (const StudyPoint& p : all)
        if (p.method == method && p.parameter == parameter)
            return p.error;
    ADD_FAILURE() << method << ' ' << parameter << " is missing";
    return 0.0;
}

TEST_F(StudyTest, OfRunsMeasuresAgainstTheFinest) {
    StudyRequest request = small("resolution");
    request.values = {90.0, 115.0};
    run_study(request);
    const auto all = points(request.output);
    ASSERT_FALSE(all.empty());
    for (const StudyPoint& p : all) {
        if (p.quantity == "unbalanced_ratio_mean" || p.quantity == "inertial_number")
            continue; // errors by themselves, of the finest, too
        EXPECT_EQ(p.parameter, "mean_radius_m=115") << p.quantity;
        EXPECT_GT(p.disc_steps, 0.0);
    }
    EXPECT_GT(error_of(all, request.scene, "mean_radius_m=115"), 0.0);
    EXPECT_TRUE(fs::exists(request.output / "study.png"));
    std::ifstream in(request.output / "study.json");
    EXPECT_GT(nlohmann::json::parse(in).at("floors").at("area_balance"), 0.0);

    // A run that is there is not made again.
    const fs::path run = request.output / "runs" / "mean_radius_m=115-seed=2" / "summary.json";
    const auto made = fs::last_write_time(run);
    run_study(request);
    EXPECT_EQ(fs::last_write_time(run), made);
}

TEST_F(StudyTest, OfTheTimeStepShowsOrderAndLimit) {
    StudyRequest request = small("time-step");
    request.seeds = 1;
    request.set = {"extension.distance_m=5.0", "hanging_wall.mean_radius_m=115.0"};
    run_study(request);
    const auto all = points(request.output);
    const std::string wave = "wave in a chain: time step";
    // Leapfrog is of second order in the time step; 5 % for the next order.
    EXPECT_NEAR(error_of(all, wave, "safety=0.25") / error_of(all, wave, "safety=0.125"), 4.0, 0.2);
    EXPECT_TRUE(std::isinf(error_of(all, wave, "safety=1.01")));
    // A step below the limit does not matter to what rests; heavier discs do.
    const std::string scaling = "bonded lattice: density scaling";
    EXPECT_GT(error_of(all, scaling, "mass=256"), 2.0 * error_of(all, scaling, "mass=1"));
}

TEST_F(StudyTest, OfSoftnessCountsCyclesAgainstStiffDiscs) {
    StudyRequest request = small("softness");
    request.values = {1.0, 4.0};
    request.seeds = 1;
    request.set = {"extension.distance_m=5.0"};
    run_study(request);
    const auto disc_steps = [all = points(request.output)](const std::string& method,
                                                           const std::string& parameter) {
        for (const StudyPoint& p : all)
            if (p.method.ends_with(method + ": runs") && p.parameter == parameter)
                return p.disc_steps;
        ADD_FAILURE() << method << ' ' << parameter << " is missing";
        return 1.0;
    };
    // Equal times in steps that go with the root; packings differ by some discs.
    for (const char* speed : {"2", "3"}) {
        const std::string method = fmt::format("{} m/s after a slow start", speed);
        const auto at = [&](const char* softness) {
            return disc_steps(method, fmt::format("{}-m-per-s-softness={}", speed, softness));
        };
        EXPECT_NEAR(at("4") / at("1"), 0.5, 0.03) << speed;
        EXPECT_EQ(disc_steps(method, "softness=1"), disc_steps("the speed of draft", "softness=1"));
    }
}

TEST_F(StudyTest, RefusesWhatItDoesNotKnow) {
    StudyRequest request = small("resolutoin");
    try {
        run_study(request);
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), HasSubstr("did you mean resolution?"));
    }
    request = small("speed");
    request.values = {-1.0};
    EXPECT_THROW(run_study(request), UsageError);
    request = small("speed");
    request.seeds = 0;
    EXPECT_THROW(run_study(request), UsageError);
    for (const char* fixed : {"coupling", "time-step", "precision"}) {
        request = small(fixed);
        request.values = {2.0};
        EXPECT_THROW(run_study(request), UsageError) << fixed;
    }
    EXPECT_THROW(run_study(small("footwall")), UsageError); // it has no scene
}

TEST_F(StudyTest, OfASceneWithoutACutoffLeavesItOut) {
    StudyRequest request = small("speed");
    request.scene = "pure-shear";
    request.values = {8.0, 4.0};
    request.seeds = 1;
    request.set = {"extension.distance_m=50.0"};
    run_study(request);
    for (const StudyPoint& p : points(request.output))
        EXPECT_NE(p.quantity, "cutoff");
}

} // namespace
} // namespace listric::study_test
