// Runs that another program drives.

#include "apps/model/effects.hpp"
#include "apps/run/driven_run.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/files/reading.hpp"
#include "tests/small_halfgraben.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <unistd.h>

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

} // namespace listric::driven_run_test
