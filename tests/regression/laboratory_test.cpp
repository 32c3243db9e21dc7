#include "apps/calibration.hpp"
#include "apps/laboratory.hpp"
#include "apps/run.hpp"
#include "dem/monitor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace listric {
namespace {

namespace fs = std::filesystem;

/// A folder that lives as long as its test.
class Folder {
public:
    Folder() {
        std::string pattern = (fs::temp_directory_path() / "listric-lab-XXXXXX").string();
        path = mkdtemp(pattern.data());
    }
    ~Folder() { fs::remove_all(path); }
    fs::path path;
};

nlohmann::json summary(const fs::path& folder) {
    std::ifstream in(folder / "summary.json");
    return nlohmann::json::parse(in);
}

LaboratoryRequest small(std::string test, std::string material, const fs::path& output) {
    LaboratoryRequest request;
    request.test = std::move(test);
    request.material = std::move(material);
    request.discs = 100;
    request.seeds = 2;
    request.speed = 4.0;
    request.quiet = true;
    request.output = output;
    return request;
}

// Tolerances are three standard deviations of single samples this small over two seeds: E 4 GPa and
// nu 0.035 at 239 discs, peak strength about 20 % at 100.
TEST(Laboratory, UniaxialTestFindsTheRocksStiffness) {
    const Folder folder;
    LaboratoryRequest request = small("uniaxial", "mat18-b", folder.path);
    request.discs = 239;
    run_laboratory(request);
    const auto s = summary(folder.path);
    EXPECT_NEAR(s["young_modulus_pa"]["mean"].get<double>(), 48e9, 12e9);
    EXPECT_NEAR(s["poisson_ratio"]["mean"].get<double>(), 0.24, 0.1);
    EXPECT_GT(s["young_modulus_2d_pa"]["mean"], s["young_modulus_pa"]["mean"]);
    EXPECT_TRUE(fs::exists(folder.path / "curves.csv"));
    EXPECT_TRUE(fs::exists(folder.path / "uniaxial.png"));
}

TEST(Laboratory, BiaxialStrengthGrowsWithConfinementWhateverTheThreads) {
    const Folder one, two;
    LaboratoryRequest request = small("biaxial", "mat18-b-calibrated", one.path);
    request.stresses = {50.0, 200.0};
    run_laboratory(request);
    request.output = two.path;
    request.threads = 2;
    run_laboratory(request);
    const auto s = summary(one.path);
    EXPECT_EQ(s["points"], summary(two.path)["points"]);
    EXPECT_NEAR(s["points"][0]["peak_axial_pa"].get<double>(), 200e6, 80e6);
    EXPECT_NEAR(s["points"][1]["peak_axial_pa"].get<double>(), 800e6, 300e6);
    EXPECT_NEAR(s["friction"].get<double>(), 0.75, 0.2);
    EXPECT_TRUE(fs::exists(one.path / "biaxial.png"));
}

TEST(Laboratory, StrengthsReadAsForcesMakeWeakerRock) {
    const Folder stress, force;
    LaboratoryRequest request = small("biaxial", "mat18-b-calibrated", stress.path);
    request.stresses = {50.0};
    run_laboratory(request);
    request.output = force.path;
    request.reading = "force";
    run_laboratory(request);
    EXPECT_LT(summary(force.path)["points"][0]["peak_axial_pa"],
              summary(stress.path)["points"][0]["peak_axial_pa"]);
}

TEST(Laboratory, ShearBoxMeasuresBulkFriction) {
    const Folder folder;
    LaboratoryRequest request = small("shear-box", "mat18-w-calibrated", folder.path);
    request.stresses = {50.0};
    request.vice = "elastic";
    run_laboratory(request);
    const auto point = summary(folder.path)["points"][0];
    EXPECT_NEAR(point["bulk_friction"].get<double>(), 0.5, 0.2);
    EXPECT_EQ(point["broken_outside_zone"], 0.0);
    EXPECT_GT(point["displacement_share_in_zone"], 0.9);
    EXPECT_TRUE(fs::exists(folder.path / "shear-box.png"));
}

TEST(Laboratory, SamplesSettleAtTheirStressWithoutFloaters) {
    SampleParameters p = compression_sample(200);
    const Specimen s = make_sample(p, Material{});
    const auto loads = surface_loads(s.state, s.base);
    EXPECT_NEAR(loads[bottom_wall].force.y / p.width, p.stress, 0.3 * p.stress);
    EXPECT_NEAR(loads[left_wall].force.x / p.height, p.stress, 0.3 * p.stress);
    int floaters = 0;
    for (int contacts : coordination(s.state, s.base))
        floaters += contacts < 3;
    EXPECT_LE(floaters, 10);
}

TEST(Laboratory, CalibrationResumesWhereItWas) {
    const Folder folder;
    CalibrationRequest request;
    request.targets.young = 20e9;
    request.targets.poisson = 0.2;
    request.discs = 60;
    request.seeds = 1;
    request.output = folder.path;
    run_calibration(request);
    const auto first = summary(folder.path);
    EXPECT_NEAR(first["young_modulus_pa"]["validation"].get<double>(), 20e9, 8e9);
    // A history cut short ends in the same rock; nothing is measured twice.
    std::ifstream in(folder.path / "history.json");
    auto history = nlohmann::json::parse(in);
    const std::size_t evaluations = history.size();
    history.erase(history.begin() + 3, history.end());
    std::ofstream(folder.path / "history.json") << history;
    EXPECT_THROW(run_calibration(request), UsageError);
    request.resume = true;
    run_calibration(request);
    EXPECT_EQ(summary(folder.path), first);
    EXPECT_EQ(first["evaluations"], evaluations);
}

int exit_code(const std::string& arguments) {
    const Folder folder;
    const int status = std::system((std::string(LISTRIC_PROGRAM) + " " + arguments + " --output " +
                                    folder.path.string() + " >/dev/null 2>&1")
                                       .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Laboratory, BadCallsEndWithCodeTwo) {
    for (const char* call : {"laboratory uniaxial mat18-b --discs 49", "laboratory biaxial mat18-w",
                             "laboratory triaxial mat18-b", "laboratory uniaxial no-such-rock",
                             "laboratory uniaxial mat18-b --set material.frictoin=1",
                             "laboratory biaxial mat18-b --confining=-5", "calibrate --young=-1",
                             "calibrate --poisson 0.34", "calibrate --poisson 0.5",
                             "calibrate --friction 2", "calibrate --discs 10"})
        EXPECT_EQ(exit_code(call), 2) << call;
}

} // namespace
} // namespace listric
