// The plan of flexure from the call to the files: names and numbers.

#include "apps/studies/flexure_plan.hpp"
#include "apps/support/files/file.hpp"
#include "fem/elastic_layer.hpp"
#include "tests/xml_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace listric::fem_flexure_test {

using namespace dem;
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class FlexureRun : public testing::Test {
protected:
    fs::path output_ = fs::temp_directory_path() / ("listric-flexure-" + std::to_string(getpid()));

    FlexureRun() {
        fs::create_directories(output_);
        setenv("LISTRIC_PYTHON", "/bin/false", 1); // pictures take longer than these runs
    }
    ~FlexureRun() override {
        unsetenv("LISTRIC_PYTHON");
        fs::remove_all(output_);
    }

    json run(const std::vector<std::string>& set, bool resume = false) {
        SceneRequest request;
        request.scene = "flexure";
        request.set = set;
        RunOptions options;
        options.output = output_;
        options.quiet = true;
        options.resume = resume;
        options.force = !resume;
        run_flexure(load_flexure_plan(request), options);
        return json::parse(std::ifstream(output_ / "summary.json"));
    }
};

struct Textbook { // FEM-independent: E 70 GPa, nu 0.25, 3300 kg/m3; V = 1e12 N/m
    double te, alpha, w0, plate_error;
};

TEST_F(FlexureRun, LineLoadIsThatOfTheTextbook) {
    // Flexural parameter and deflection of the thin plate (Turcotte & Schubert); last the plate's
    // error against the exact layer: shear, which it neglects.
    for (const Textbook& t : {Textbook{5e3, 17.6e3, 877, 0.03}, Textbook{10e3, 29.6e3, 522, 0.04},
                              Textbook{20e3, 49.8e3, 310, 0.055}}) {
        const json s =
            run({"elastic_base.elastic_thickness_m=" + std::to_string(std::lround(t.te))});
        EXPECT_NEAR(s["alpha_m"], t.alpha, 51.0); // the table's digits
        EXPECT_NEAR(s["analytic_w0_m"], t.w0, 1.0);
        EXPECT_LT(s["relative_error"], t.plate_error);
        // Elements against the exact layer, everywhere within six flexural parameters.
        EXPECT_LT(s["exact_relative_error"], 1e-4);
        EXPECT_NEAR(s["bulge_m"].get<double>() / s["exact_bulge_m"].get<double>(), 1.0, 1e-3);
        EXPECT_NEAR(s["bulge_x_m"].get<double>() / s["exact_bulge_x_m"].get<double>(), 1.0, 1e-3);
        EXPECT_NEAR(s["analytic_bulge_m"].get<double>() / s["analytic_w0_m"].get<double>(), 0.0432,
                    1e-4);
        EXPECT_NEAR(s["analytic_bulge_x_m"].get<double>() / s["alpha_m"].get<double>(),
                    std::numbers::pi, 1e-3);
        EXPECT_LT(s["reaction_error"], 1e-10); // round-off
    }
}

TEST_F(FlexureRun, LeavesFilesAndAFigure) {
    unsetenv("LISTRIC_PYTHON");
    run({});
    for (const char* file : {"scene.toml", "log.txt", "deflection.csv", "footwall.pvd",
                             "footwall.vtu", "paraview.py", "figures/flexure.png"})
        EXPECT_TRUE(fs::exists(output_ / file)) << file;
    EXPECT_EQ(support::xml_files(output_), "1 of .pvd\n1 of .vtu\n");
}

TEST_F(FlexureRun, BrokenPlate) {
    const json s = run({"flexure.load=broken"});
    EXPECT_NEAR(s["analytic_w0_m"], 1043.0, 1.0);
    EXPECT_LT(s["relative_error"], 0.02); // shear near the loaded end
    EXPECT_NEAR(s["analytic_bulge_m"].get<double>() / s["analytic_w0_m"].get<double>(), 0.0670,
                1e-4);
    EXPECT_NEAR(s["bulge_m"].get<double>() / s["analytic_bulge_m"].get<double>(), 1.0, 0.02);
    EXPECT_FALSE(s.contains("exact_w0_m"));
}

TEST_F(FlexureRun, StripAndSinusoid) {
    json s = run({"flexure.load=strip"});
    EXPECT_LT(s["relative_error"], 0.03); // the plate's
    EXPECT_LT(s["exact_relative_error"], 1e-4);
    s = run({"flexure.load=sinusoid", "flexure.wavelength_m=100000", "elastic_base.cells=4"});
    EXPECT_LT(s["exact_relative_error"], 1e-4); // discretisation, four elements
    EXPECT_NEAR(s["relative_error"], 0.06, 0.02);
    EXPECT_FALSE(s.contains("bulge_m"));
}

TEST_F(FlexureRun, IsTheSameTwiceAndResumesToItself) {
    const json first = run({});
    const auto written = fs::last_write_time(output_ / "summary.json");
    run({}, true);
    EXPECT_EQ(fs::last_write_time(output_ / "summary.json"), written);
    EXPECT_EQ(run({})["state_hash"], first["state_hash"]);
}

} // namespace
} // namespace listric::fem_flexure_test
