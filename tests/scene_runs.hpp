#pragma once

// Runs of small scenes, in-process, in a folder of their own and without pictures.

#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/run/run.hpp"
#include "tests/places.hpp"
#include "tests/small_halfgraben.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <unistd.h>
#include <vector>

namespace listric::support {

using namespace archive;
using namespace dem;

/// A scene that the tests ship, in tests/scenes.
inline std::string test_scene(const std::string& name) {
    return (std::filesystem::path(source_folder) / "tests/scenes" / name).string();
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
        std::filesystem::create_directories(folder);
        setenv("LISTRIC_PYTHON", "/bin/false", 1); // pictures take longer than these runs
        setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
    }
    ~SceneRuns() override {
        std::filesystem::remove_all(folder);
        unsetenv("XDG_CACHE_HOME");
        unsetenv("LISTRIC_PYTHON");
    }

    /// A scene from its text, in small.toml.
    Scene load(const std::string& text, const std::vector<std::string>& set = {}) const {
        const std::filesystem::path file = folder / "small.toml";
        std::ofstream(file) << text;
        return load_scene({.scene = file.string(), .set = set});
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

    /// Runs the scene in the folder `name`, from the beginning, to `until`, or on from there.
    nlohmann::json run(const Scene& scene, const std::string& name,
                       std::optional<double> until = {}, bool resume = false,
                       int threads = 1) const {
        RunOptions o = options(name);
        o.until = until;
        o.resume = resume;
        o.force = !resume;
        o.threads = threads;
        return run(scene, o);
    }

    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / fmt::format("listric-scenes-{}", getpid());
};

} // namespace listric::support
