// A rigid scene costs nothing of what an elastic base needs: the program neither links nor loads
// finite elements, linear algebra or MPI.

#include "tests/places.hpp"
#include "tests/small_halfgraben.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace listric::rigid_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string scene = support::small_halfgraben("50.0") + R"([extension]
distance_m = 300.0
[output]
interval_m = 1.0
figures_at_m = []
[gravity]
[bonds]
)";

/// Files that a run of the program has mapped into memory once `file` exists in its output.
std::string maps_of_run(const fs::path& folder, const std::string& which, const char* file) {
    const fs::path output = folder / "out";
    const pid_t child = fork();
    if (child == 0) {
        setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
        execl(program_path, program_path, "run", which.c_str(), "--output", output.c_str(),
              "--quiet", "--force", nullptr);
        _exit(127);
    }
    for (int k = 0; k < 60000 && !fs::exists(output / file); ++k) {
        siginfo_t info{};
        waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT);
        if (info.si_pid != 0)
            break;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::ostringstream maps;
    maps << std::ifstream("/proc/" + std::to_string(child) + "/maps").rdbuf();
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    return maps.str();
}

class Rigid : public testing::Test {
protected:
    Rigid() { fs::create_directories(folder_); }
    ~Rigid() override { fs::remove_all(folder_); }
    fs::path folder_ = fs::temp_directory_path() / ("listric-rigid-" + std::to_string(getpid()));
};

TEST_F(Rigid, LoadsNoFiniteElements) {
    const fs::path file = folder_ / "small.toml";
    std::ofstream(file) << scene;
    const std::string maps = maps_of_run(folder_, file.string(), "history.csv");
    ASSERT_THAT(maps, HasSubstr("libc.so")); // it was alive
    for (const char* library : {"deal.ii", "deal_II", "petsc", "libmpi", "open-rte", "libopen-pal",
                                "mumps", "HYPRE", "blas", "lapack", "tbb", "listric_fem"})
        EXPECT_THAT(maps, Not(HasSubstr(library)));
}

#ifdef LISTRIC_HAS_FOOTWALL // there is a plug-in
TEST_F(Rigid, TheTestWouldSeeThem) {
    const std::string maps = maps_of_run(folder_, "flexure", "footwall.pvd");
    for (const char* library : {"deal.ii", "petsc", "libmpi", "listric_fem"})
        EXPECT_THAT(maps, HasSubstr(library));
}
#endif

} // namespace
} // namespace listric::rigid_test
