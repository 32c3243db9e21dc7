// One process and two give the same footwall.

#include "tests/places.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <unistd.h>
#include <vector>

namespace listric::fem_parallel_test {

namespace {

std::vector<double> numbers_of(const std::string& call) {
    std::vector<double> numbers;
    // Variables that an MPI of this process has set would confuse another.
    const std::string clean = "env -i PATH=\"$PATH\" HOME=\"$HOME\" "
                              "LISTRIC_FEM_PLUGIN=\"$LISTRIC_FEM_PLUGIN\" ";
    FILE* pipe = popen((clean + call).c_str(), "r");
    double number = 0.0;
    while (pipe && std::fscanf(pipe, "%lf", &number) == 1)
        numbers.push_back(number);
    EXPECT_TRUE(pipe && pclose(pipe) == 0) << call;
    return numbers;
}

TEST(Parallel, TwoProcessesGiveTheSame) {
    ASSERT_EQ(access("/usr/bin/mpirun", X_OK), 0)
        << "no mpirun; deal.II is here without it: apt-get install openmpi-bin";
    const std::string run = std::string("/usr/bin/mpirun --oversubscribe --bind-to none "
                                        "--mca mpi_yield_when_idle 1 ") +
                            (geteuid() == 0 ? "--allow-run-as-root " : "");
    const auto one = numbers_of(footwall_program);
    const auto two = numbers_of(run + "-np 2 " + footwall_program);
    ASSERT_GT(one.size(), 1000u);
    ASSERT_EQ(one.size(), two.size());
    // Displacements are compared with the largest among their neighbours in the list: round-off of
    // other sums, times the condition of the stiffness; multigrid stops at 1e-12 of the load.
    double worst = 0.0;
    for (std::size_t k = 0; k < one.size(); ++k) {
        double size = 0.0;
        for (std::size_t i = k < 50 ? 0 : k - 50; i < std::min(one.size(), k + 50); ++i)
            if (std::abs(one[i]) < 1e6 || std::abs(one[k]) >= 1e6)
                size = std::max(size, std::abs(one[i]));
        worst = std::max(worst, std::abs(two[k] - one[k]) / size);
    }
    std::printf("%zu numbers, worst difference %.1e\n", one.size(), worst);
    EXPECT_LT(worst, 1e-10);
}

} // namespace
} // namespace listric::fem_parallel_test
