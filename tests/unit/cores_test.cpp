// Cores that control groups grant, from files made here as kernels write them.

#include "apps/support/cores.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace listric::cores_test {
namespace {

namespace fs = std::filesystem;

class CoresTest : public testing::Test {
protected:
    fs::path root = fs::path(testing::TempDir()) /
                    fmt::format("listric-cores-{}-{}", getpid(),
                                testing::UnitTest::GetInstance()->current_test_info()->name());
    ~CoresTest() override { fs::remove_all(root); }

    void write(const std::string& name, const std::string& text) const {
        fs::create_directories((root / name).parent_path());
        std::ofstream(root / name) << text;
    }
    void is_in(const std::string& groups) const { write("proc/self/cgroup", groups); }
};

TEST_F(CoresTest, NothingGrantsAll) {
    EXPECT_TRUE(std::isinf(granted_cores(root)));
    is_in("0::/\n");
    EXPECT_TRUE(std::isinf(granted_cores(root)));
    write("sys/fs/cgroup/cpu.max", "max 100000\n");
    EXPECT_TRUE(std::isinf(granted_cores(root)));
}

TEST_F(CoresTest, AContainerHasItsGroupAtTheTop) {
    is_in("0::/\n");
    write("sys/fs/cgroup/cpu.max", "150000 100000\n");
    EXPECT_EQ(granted_cores(root), 1.5);
}

TEST_F(CoresTest, AGroupHasNoMoreThanThoseAboveIt) {
    is_in("0::/system.slice/slurm/job_7\n");
    write("sys/fs/cgroup/system.slice/slurm/job_7/cpu.max", "800000 100000\n");
    EXPECT_EQ(granted_cores(root), 8.0);
    write("sys/fs/cgroup/system.slice/cpu.max", "200000 50000\n");
    EXPECT_EQ(granted_cores(root), 4.0);
    write("sys/fs/cgroup/system.slice/slurm/cpu.max", "max 100000\n");
    EXPECT_EQ(granted_cores(root), 4.0);
    write("sys/fs/cgroup/other.slice/cpu.max", "100000 100000\n");
    EXPECT_EQ(granted_cores(root), 4.0);
}

TEST_F(CoresTest, OfVersionOne) {
    is_in("5:memory:/docker/1\n4:cpu,cpuacct:/docker/1\n0::/\n");
    const std::string top = "sys/fs/cgroup/cpu,cpuacct/";
    write(top + "docker/1/cpu.cfs_quota_us", "-1\n");
    write(top + "docker/1/cpu.cfs_period_us", "100000\n");
    EXPECT_TRUE(std::isinf(granted_cores(root)));
    write(top + "docker/1/cpu.cfs_quota_us", "300000\n");
    EXPECT_EQ(granted_cores(root), 3.0);
    is_in("4:cpu:/docker/2\n"); // seen from within: mounted at the top
    write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "50000\n");
    write("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(granted_cores(root), 0.5);
}

TEST_F(CoresTest, WhatIsNoNumberGrantsAll) {
    is_in("\n::\n0::/a\nx\n");
    for (const char* text : {"", "abc", "100000", "100000 0", "0 100000", "-5 100000"}) {
        write("sys/fs/cgroup/a/cpu.max", text);
        EXPECT_TRUE(std::isinf(granted_cores(root))) << text;
    }
    EXPECT_GE(usable_cores(), 1);
}

} // namespace
} // namespace listric::cores_test
