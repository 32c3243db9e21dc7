// Limits of control groups, from files made here as kernels write them.

#include "apps/support/machine/job_limits.hpp"

#include "apps/support/machine/cores.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace listric::job_limits_test {
namespace {

namespace fs = std::filesystem;

class JobLimitsTest : public testing::Test {
protected:
    fs::path root = fs::path(testing::TempDir()) /
                    fmt::format("listric-job-limits-{}-{}", getpid(),
                                testing::UnitTest::GetInstance()->current_test_info()->name());
    ~JobLimitsTest() override { fs::remove_all(root); }

    void write(const std::string& name, const std::string& text) const {
        fs::create_directories((root / name).parent_path());
        std::ofstream(root / name) << text;
    }
    void is_in(const std::string& groups) const { write("proc/self/cgroup", groups); }
};

TEST_F(JobLimitsTest, NothingGrantsAll) {
    EXPECT_TRUE(std::isinf(granted_cores(root)));
    is_in("0::/\n");
    EXPECT_TRUE(std::isinf(granted_cores(root)));
    write("sys/fs/cgroup/cpu.max", "max 100000\n");
    EXPECT_TRUE(std::isinf(granted_cores(root)));
}

TEST_F(JobLimitsTest, AContainerHasItsGroupAtTheTop) {
    is_in("0::/\n");
    write("sys/fs/cgroup/cpu.max", "150000 100000\n");
    EXPECT_EQ(granted_cores(root), 1.5);
}

TEST_F(JobLimitsTest, AGroupHasNoMoreThanThoseAboveIt) {
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

TEST_F(JobLimitsTest, OfVersionOne) {
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

TEST_F(JobLimitsTest, WhatIsNoNumberGrantsAll) {
    is_in("\n::\n0::/a\nx\n");
    for (const char* text : {"", "abc", "100000", "100000 0", "0 100000", "-5 100000"}) {
        write("sys/fs/cgroup/a/cpu.max", text);
        EXPECT_TRUE(std::isinf(granted_cores(root))) << text;
    }
    EXPECT_GE(usable_cores(), 1);
}

TEST_F(JobLimitsTest, MemoryAndTasksOfBothVersions) {
    is_in("0::/slurm/job_7\n");
    write("sys/fs/cgroup/slurm/job_7/memory.max", "max\n");
    write("sys/fs/cgroup/slurm/job_7/pids.max", "max\n");
    EXPECT_TRUE(std::isinf(granted_memory(root)));
    EXPECT_TRUE(std::isinf(granted_tasks(root)));
    write("sys/fs/cgroup/slurm/memory.max", "41943040\n");
    write("sys/fs/cgroup/slurm/pids.max", "2\n");
    EXPECT_EQ(granted_memory(root), 40.0 * 1024 * 1024);
    EXPECT_EQ(granted_tasks(root), 2.0);

    is_in("7:pids:/docker/1\n5:memory:/docker/1\n0::/\n");
    EXPECT_TRUE(std::isinf(granted_memory(root)));
    write("sys/fs/cgroup/memory/docker/1/memory.limit_in_bytes", "41943040\n");
    write("sys/fs/cgroup/pids/docker/1/pids.max", "3\n");
    EXPECT_EQ(granted_memory(root), 40.0 * 1024 * 1024);
    EXPECT_EQ(granted_tasks(root), 3.0);
}

} // namespace
} // namespace listric::job_limits_test
