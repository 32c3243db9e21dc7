#pragma once

// Runs of small scenes, in-process, in a folder of their own and without pictures.

#include "apps/run.hpp"
#include "apps/snapshot.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace listric::support {

/// A scene that the tests ship, in tests/scenes.
inline std::string test_scene(const std::string& name) {
    return (std::filesystem::path(LISTRIC_SOURCE_DIR) / "tests/scenes" / name).string();
}

inline std::string contents(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

inline bool all_finite(const Table& table) {
    return std::ranges::all_of(table.columns(), [](const Column& column) {
        const auto* values = std::get_if<std::vector<double>>(&column.values);
        return !values || std::ranges::all_of(*values, [](double x) { return std::isfinite(x); });
    });
}

/// Test fixture.
class SceneRuns : public testing::Test {
protected:
    SceneRuns() {
        namespace fs = std::filesystem;
        fs::create_directories(folder / "python");
        // Pictures take longer than these runs: a NumPy that ends the script.
        std::ofstream(folder / "python/numpy.py") << "import os\nos._exit(1)\n";
        setenv("PYTHONPATH", (folder / "python").c_str(), 1);
        setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
    }
    ~SceneRuns() override {
        std::filesystem::remove_all(folder);
        unsetenv("XDG_CACHE_HOME");
        unsetenv("PYTHONPATH");
    }

    RunOptions options(const std::string& name) const {
        RunOptions options;
        options.output = folder / name;
        options.quiet = true;
        return options;
    }

    /// Runs a scene to its end and returns the summary.
    static nlohmann::json run(const Scene& scene, const RunOptions& options) {
        EXPECT_EQ(run_scene(scene, options), RunOutcome::finished);
        return nlohmann::json::parse(contents(options.output / "summary.json"));
    }

    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / fmt::format("listric-scenes-{}", getpid());
};

} // namespace listric::support
