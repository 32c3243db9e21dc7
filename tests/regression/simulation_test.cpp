// The library alone: a client of dem drives LIS1 and gets the bits of the program's run.

#include "tests/install/consumer/drive_lis1.hpp"
#include "tests/scene_runs.hpp"

namespace listric {

namespace {

using namespace dem;

class SimulationOfAScene : public support::SceneRuns {};

TEST_F(SimulationOfAScene, HasTheBitsOfTheRun) {
    const Scene scene = load_scene({.scene = "lis1", .accuracy = "draft"});
    EXPECT_EQ(run(scene, "run", 500.0)["state_hash"], fmt::format("{:016x}", drive_lis1(2)));
}

} // namespace

} // namespace listric
