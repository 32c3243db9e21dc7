// Runs that another program drives.

#include "apps/model/effects.hpp"
#include "apps/run/driven_run.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/files/reading.hpp"
#include "tests/small_halfgraben.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <unistd.h>
#include <vector>

namespace listric::driven_run_test {

namespace fs = std::filesystem;

TEST(DrivenRun, WithoutFilesMakesTheSameStates) {
    const fs::path cache =
        fs::path(testing::TempDir()) / fmt::format("listric-driven-{}", getpid());
    setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    const GivenTexts scene({{"/nowhere/small.toml",
                             support::small_halfgraben() + "[extension]\ndistance_m = 100.0\n"}});
    const auto read = [] {
        return load_scene({.scene = "/nowhere/small.toml"}, program_effects());
    };
    listric::Run alone = listric::Run::without_files(read());
    EXPECT_FALSE(fs::exists(cache));
    listric::Run with_cache{read()};
    EXPECT_TRUE(fs::exists(cache));
    alone.extend_to(60.0, [](const auto&) { return false; }); // stops, and goes on
    EXPECT_TRUE(alone.extend_to(60.0));
    EXPECT_TRUE(with_cache.extend_to(60.0));
    EXPECT_EQ(alone.hash(), with_cache.hash());
    EXPECT_EQ(alone.measures(), with_cache.measures());
    fs::remove_all(cache);
    unsetenv("XDG_CACHE_HOME");
}

TEST(DrivenRun, HandsOverTheFilesOfItsFolder) {
    const GivenTexts scene({{"/nowhere/small.toml",
                             support::small_halfgraben() +
                                 "[extension]\ndistance_m = 60.0\n[output]\ninterval_m = 30.0\n"}});
    listric::Run run = listric::Run::without_files(
        load_scene({.scene = "/nowhere/small.toml"}, program_effects()));
    std::vector<std::string> names{run.snapshot_name()};
    run.at_windows([&](const listric::Run& now) { names.push_back(now.snapshot_name()); });
    EXPECT_TRUE(run.extend_to(60.0));
    EXPECT_EQ(names, (std::vector<std::string>{"extension-00000.00m.h5", "extension-00030.00m.h5",
                                               "extension-00060.00m.h5"}));
    const std::string history = run.history();
    EXPECT_EQ(std::ranges::count(history, '\n'), 4); // a header and three rows
    EXPECT_NE(run.summary().find(fmt::format("{:016x}", run.hash())), std::string::npos);
    const fs::path file =
        fs::path(testing::TempDir()) / fmt::format("listric-driven-{}.h5", getpid());
    run.save(file);
    const std::vector<std::byte> bytes = run.snapshot();
    EXPECT_EQ(read_text(file),
              std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    fs::remove(file);
}

} // namespace listric::driven_run_test
