#include "apps/laboratory/laboratory.hpp"
#include "apps/laboratory/pure_shear.hpp"
#include "apps/laboratory/tests.hpp"
#include "apps/run/run.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/monitor.hpp"
#include "tests/places.hpp"
#include "tests/support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace listric::laboratory_test {

using namespace dem;
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

TEST(Laboratory, ReplacesNoMaterialThatSomebodyKeeps) {
    const Folder folder;
    std::ofstream(folder.path / "material.toml") << "# mine\n";
    EXPECT_THROW(run_laboratory(small("uniaxial", "mat18-b", folder.path)), UsageError);
    EXPECT_EQ(fs::file_size(folder.path / "material.toml"), 7U);
}

TEST(Laboratory, ReplacesNoResultsThatSomebodyKeeps) {
    for (const char* const name : {"summary.json", "curves.csv", "envelopes.csv", "biaxial.png"}) {
        const Folder folder;
        std::ofstream(folder.path / name) << "mine\n";
        EXPECT_THROW(run_laboratory(small("biaxial", "mat18-b", folder.path)), UsageError) << name;
        EXPECT_EQ(fs::file_size(folder.path / name), 5U) << name;
        EXPECT_FALSE(fs::exists(folder.path / "material.toml"));
    }
}

TEST(Calibration, ReplacesNoFileThatSomebodyKeeps) {
    for (const char* const name : {"mine.toml", "mine-weak.toml", "summary.json"}) {
        const Folder folder;
        std::ofstream(folder.path / name) << "mine\n";
        CalibrationRequest request;
        request.name = "mine";
        request.targets.bulk_friction = 0.3;
        request.discs = 60;
        request.seeds = 1;
        request.output = folder.path;
        request.quiet = true;
        for (const bool resume : {false, true}) { // with nothing to resume
            request.resume = resume;
            EXPECT_THROW(run_calibration(request), UsageError) << name;
        }
        EXPECT_EQ(fs::file_size(folder.path / name), 5U) << name;
    }
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

// Sand has no cohesion: the line through its peaks passes the origin. Its peak friction is 0.65 to
// 0.67 in the shear box.
TEST(Laboratory, BiaxialTestTakesSand) {
    const Folder folder;
    LaboratoryRequest request = small("biaxial", "sandbox-sand", folder.path);
    request.stresses = {10.0, 50.0};
    run_laboratory(request);
    const auto s = summary(folder.path);
    EXPECT_NEAR(s["friction"].get<double>(), 0.65, 0.2);
    EXPECT_NEAR(s["cohesion_pa"].get<double>(), 0.0, 5e6);
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

// A slab of 1,500 discs at the paper's rates: what it measures, and that a second call finds the
// finished slab. How faults dip takes finer slabs (docs/guides/laboratory.md).
TEST(Laboratory, PureShearStretchesASlab) {
    const Folder folder;
    LaboratoryRequest request = small("pure-shear", "mat18-b", folder.path);
    request.seeds = 1;
    request.stresses = {10.0, 50.0};
    request.weakening_rates = {1e-13};
    request.healing_rates = {1e-15};
    run_laboratory(request);
    const auto s = summary(folder.path);
    ASSERT_EQ(s["points"].size(), 1u);
    EXPECT_NEAR(s["predicted_dip_deg"].get<double>(), 45.0 + 8.0, 6.0);
    // A slab that stretched evenly would have 0.1.
    EXPECT_GT(s["points"][0]["strain_top10"]["mean"], 0.2);
    EXPECT_GT(s["points"][0]["healed_share"]["mean"], 0.05);
    EXPECT_LT(s["points"][0]["healed_share"]["mean"], 1.0);
    EXPECT_TRUE(fs::exists(folder.path / "pure-shear.png"));
    const auto slab = folder.path / "slab-weakening-1e-13-healing-1e-15-seed-1";
    const auto made = fs::last_write_time(slab / "summary.json");
    run_laboratory(request);
    EXPECT_EQ(summary(folder.path)["points"], s["points"]);
    EXPECT_EQ(fs::last_write_time(slab / "summary.json"), made);
}

TEST(PureShear, FaultsDipAtFortyFiveDegreesAndHalfTheAngleOfFriction) {
    EXPECT_DOUBLE_EQ(anderson_dip(0.0), 45.0);
    EXPECT_NEAR(anderson_dip(0.85), 65.2, 0.05);
    EXPECT_FALSE(mean_dip({}));
    EXPECT_DOUBLE_EQ(*mean_dip({{60.0, 3e3, true}, {50.0, 1e3, false}}), 57.5);
    StretchedSlab slab;
    EXPECT_FALSE(slab.conjugate());
    slab.faults = {{60.0, 3e3, true}};
    EXPECT_FALSE(slab.conjugate());
    slab.faults.push_back({50.0, 1e3, false});
    EXPECT_TRUE(slab.conjugate());
}

TEST(PureShear, NewContactsThatAreBondedHaveHealed) {
    // Three discs in a row touch; then the last goes round and touches both.
    State start = support::make_state(support::row(3, 100.0));
    support::bond_all(start, {});
    EXPECT_FALSE(healed_share(start, start));
    std::vector<support::Disc> moved = support::row(2, 100.0);
    moved.push_back({100.0, 100.0 * std::sqrt(3.0) - 0.01, 100.0});
    State end = support::make_state(moved);
    find_contacts(end, {});
    support::bond(end, support::find_pair(end, 1, 2), 1e30f, 1e30f); // was there before
    EXPECT_EQ(healed_share(start, end), 0.0);
    support::bond(end, support::find_pair(end, 0, 2), 1e30f, 1e30f);
    EXPECT_EQ(healed_share(start, end), 1.0);
    end.materials[basement].bondable = false;
    EXPECT_FALSE(healed_share(start, end));
}

TEST(Laboratory, SamplesSettleAtTheirStressWithoutFloaters) {
    SampleParameters p = compression_sample(200);
    const Specimen s = make_sample(p, Material{});
    const auto loads = surface_loads(s.state, s.base);
    EXPECT_NEAR(loads[walls::bottom].force.y / p.width, p.stress, 0.3 * p.stress);
    EXPECT_NEAR(loads[walls::left].force.x / p.height, p.stress, 0.3 * p.stress);
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

/// How a call ends, and the last line that it says.
struct Ending {
    int code;
    std::string message;
};
Ending ending(const std::string& arguments) {
    const Folder folder;
    const std::string said = folder.path.string() + ".txt";
    const int status = std::system((std::string(program_path) + " " + arguments + " --output " +
                                    folder.path.string() + " >/dev/null 2>" + said)
                                       .c_str());
    std::ifstream in(said);
    std::string line, last;
    while (std::getline(in, line))
        last = line;
    fs::remove(said);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, last};
}

TEST(Laboratory, BadCallsSayWhatIsWrong) {
    using testing::AllOf;
    using testing::HasSubstr;
    const Folder folder;
    const std::string half = (folder.path / "half.toml").string();
    std::ofstream(half) << "[material]\nnormal_stiffness_pa = 1e11\nfriction = 0.5\n";
    const std::string soft = (folder.path / "soft.toml").string();
    std::ofstream(soft) << "[material]\nnormal_stiffness_pa = 1e11\nshear_stiffness_pa = 4e10\n"
                           "friction = 0.5\n[bonds]\nshear_strength_pa = 1e9\n"
                           "shear_strength_sd_pa = 0.0\ntensile_strength_sd_pa = 0.0\n";
    const std::vector<std::pair<std::string, testing::Matcher<std::string>>> calls = {
        {"laboratory uniaxial " + half,
         AllOf(HasSubstr("half.toml:1"), HasSubstr("needs shear_stiffness_pa"))},
        {"laboratory biaxial " + soft, HasSubstr("needs tensile_strength_pa")},
        {"laboratory uniaxial mat18-b --discs 49", HasSubstr("--discs 49: a sample has 50 to")},
        {"laboratory pure-shear mat18-b --discs 49", HasSubstr("--discs 49: a sample has 50 to")},
        {"laboratory pure-shear mat18-w", HasSubstr("needs a rock with [bonds]")},
        {"laboratory pure-shear mat18-b --weakening-rates 1", HasSubstr("at most 1e-3 per second")},
        {"laboratory biaxial mat18-b --healing-rates 1e-15", HasSubstr("pure-shear test has them")},
        {"laboratory triaxial mat18-b", HasSubstr("did you mean uniaxial")},
        {"laboratory uniaxial no-such-rock", HasSubstr("no-such-rock")},
        {"laboratory uniaxial mat18-b --set material.frictoin=1", HasSubstr("did you mean")},
        {"laboratory biaxial mat18-b --confining=-5", HasSubstr("0.5 to 2000 MPa")},
        {"calibrate --young=-1", HasSubstr("--young -1: allowed: 1e6 to 1e13 Pa")},
        {"calibrate --poisson 0.5", HasSubstr("below 0.5")},
        {"calibrate --poisson 0.34", HasSubstr("0.5 in 2D terms")},
        {"calibrate --friction 2", HasSubstr("round discs roll")},
        {"calibrate --cohesion=-1", HasSubstr("0 to 1e9 Pa")},
        {"calibrate --bulk-friction 1.5", HasSubstr("above 0, at most 1")},
        {"calibrate --discs 10", HasSubstr("--discs 10: a sample has 50 to")}};
    for (const auto& [call, message] : calls) {
        const Ending end = ending(call);
        EXPECT_EQ(end.code, 2) << call;
        EXPECT_THAT(end.message, message) << call;
    }
}

} // namespace
} // namespace listric::laboratory_test
