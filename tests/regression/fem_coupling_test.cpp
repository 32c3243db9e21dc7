// A small halfgraben on an elastic footwall: recorded numbers, and the same end after a stop.

#include "apps/run.hpp"
#include "apps/scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace listric {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const char* small = R"([hanging_wall]
length_m = 4000.0
thickness_m = 1500.0
mean_radius_m = 60.0
[detachment]
segments = [{arc = {radius_m = 1500.0, end_dip_deg = 0.0}}, {line = {length_m = 6000.0}}]
[extension]
distance_m = 200.0
[output]
interval_m = 50.0
figures_at_m = []
series = "none"
[gravity]
[bonds]
[bond_healing]
[sedimentation]
interval_a = 5000
[elastic_base]
elastic_thickness_m = 1000.0
depth_m = 3000.0
left_m = -30e3
right_m = 35e3
skin_thickness_m = 300.0
cell_size_m = 150.0
)";

class CoupledRun : public testing::Test {
protected:
    CoupledRun() {
        fs::create_directories(folder_);
        std::ofstream(folder_ / "small.toml") << small;
    }
    ~CoupledRun() override { fs::remove_all(folder_); }

    nlohmann::json run(const std::string& name, int threads, std::optional<double> until = {},
                       bool resume = false, std::vector<std::string> set = {}) {
        SceneRequest request;
        request.scene = (folder_ / "small.toml").string();
        request.set = std::move(set);
        RunOptions options;
        options.output = folder_ / name;
        options.threads = threads;
        options.until = until;
        options.resume = resume;
        options.quiet = true;
        run_scene(load_scene(request), options);
        std::ifstream in(options.output / "summary.json");
        return nlohmann::json::parse(in);
    }

    fs::path folder_ = fs::temp_directory_path() / ("listric-coupled-" + std::to_string(getpid()));
};

TEST_F(CoupledRun, HasTheRecordedUpliftAndKeepsTheLoad) {
    const nlohmann::json one = run("one", 1);
    EXPECT_LT(one["interface_force_error"].get<double>(), 1e-12);
    EXPECT_LT(one["interface_moment_error"].get<double>(), 1e-12);
    EXPECT_LT(one["interface_work_error"].get<double>(), 1e-12);
    // Recorded: 21.60 m. Another machine's linear algebra rounds otherwise, and the discs take
    // another path. The tenth is an allowance for that; its spread over seeds is not measured yet.
    EXPECT_NEAR(one["footwall_uplift_m"].get<double>(), 21.60, 2.2);
    run("two", 2, 110.0);
    const nlohmann::json two = run("two", 1, {}, true);
    EXPECT_EQ(one["state_hash"], two["state_hash"]);
}

TEST_F(CoupledRun, LumpedMassesComeToTheSame) {
    // Lumped masses slow the soft modes, too: with an update every 5 cycles the base is half behind
    // its load, with one every cycle it follows. Uplift differs by the path that discs take.
    const nlohmann::json modal = run("modal", 1);
    const nlohmann::json lumped =
        run("lumped", 1, {}, false,
            {"elastic_base.scheme=lumped", "elastic_base.update_interval_cycles=1"});
    const double uplift = modal["footwall_uplift_m"];
    EXPECT_NEAR(lumped["footwall_uplift_m"].get<double>(), uplift, 0.15 * uplift);
    EXPECT_LT(modal["base_resolved_difference"].get<double>(), 0.06);
    EXPECT_LT(lumped["base_resolved_difference"].get<double>(), 0.08);
}

TEST_F(CoupledRun, NearlyIncompressibleRockCarriesDiscs) {
    const auto uplift = [&](const std::string& name, double ratio, int degree) {
        return run(name, 1, 100.0, false,
                   {fmt::format("elastic_base.poisson_ratio={}", ratio),
                    fmt::format("elastic_base.degree={}", degree), "output.interval_m=100.0"})
            ["footwall_uplift_m"].get<double>();
    };
    const double usual = uplift("usual", 0.25, 2), hard = uplift("hard", 0.4999, 2),
                 locked = uplift("locked", 0.4999, 1);
    std::printf("uplift with nu 0.25: %.2f m, 0.4999: %.2f m, with linear elements: %.2f m\n", usual,
                hard, locked);
    EXPECT_NEAR(hard / usual, 1.0, 0.3);
    EXPECT_LT(locked, 0.7 * hard); // what quadratic elements are for
}

TEST_F(CoupledRun, RefusesToBlowUp) {
    try {
        run("staggered", 1, {}, false, {"elastic_base.scheme=staggered"});
        FAIL() << "not refused";
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("staggered would blow up"), std::string::npos);
    }
}

} // namespace
} // namespace listric
