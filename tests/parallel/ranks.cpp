// lis1 on as many ranks as mpirun starts; the root prints the hash of its end.
//   ranks SCENE EXTENSION_M ACCURACY

#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/run/genesis_cache.hpp"
#include "apps/scene/scene_file.hpp"
#include "dem/ranked_cycles.hpp"
#include "dem/ranks/mpi_ranks.hpp"
#include "dem/simulation.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>

using namespace listric;
using namespace listric::dem;

int main(int, char** words) {
    const auto ranks = make_mpi_ranks();
    const Scene scene = load_scene({.scene = words[1], .accuracy = words[3]});
    const ModelParts parts = make_parts(scene);
    if (ranks->mine() != 0) {
        RankedCycles(*ranks, parts.base, parts.physics, {}).serve();
        return 0;
    }
    Simulation sandbox(parts.base, parts.physics);
    for (auto& event : make_events(scene, parts))
        sandbox.add(std::move(event));
    Log log(true);
    sandbox.begin(make_or_recall_hanging_wall(scene, parts, log, {}, 1));
    RankedCycles on_ranks(*ranks, parts.base, parts.physics, {});
    if (ranks->count() > 1)
        sandbox.advance_by([&](State& state, const RigidBase&, const CyclePhysics&, std::int64_t n,
                               const Execution& asked) {
            if (!asked.packed->holds())
                on_ranks.forget();
            on_ranks.advance(state, n);
            asked.packed->hold();
        });
    double cycle = 0.0;
    sandbox.report_times_to([&](const std::string& part, double seconds) {
        if (part == "cycle")
            cycle += seconds;
    });
    sandbox.extend_to(std::atof(words[2]));
    std::printf("%016lx %.2f s of cycles, %.1f M disc-steps/s\n", sandbox.hash(), cycle,
                sandbox.disc_steps() / cycle / 1e6);
}
