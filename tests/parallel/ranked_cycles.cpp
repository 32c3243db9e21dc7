// Cycles alone, on as many ranks as mpirun starts, with so many threads each: prints million
// disc-steps per second, and the greatest memory of all ranks together beyond what they had before
// there was a state, bytes per disc; or the hash at the end, for which the state is collected.
//   mpirun -n 2 ranked_cycles SCENE ACCURACY RADIUS_M CYCLES REPEATS THREADS [hash]

#include "dem/ranks/ranked_cycles.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/run/genesis_cache.hpp"
#include "apps/run/ranks/join_ranks.hpp"
#include "apps/scene/scene_file.hpp"
#include "dem/contacts/contacts.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <malloc.h>
#include <string>
#include <thread>

using namespace listric;
using namespace listric::dem;

namespace {

/// A number of /proc/self/status, bytes.
std::int64_t memory(const std::string& name) {
    std::ifstream status("/proc/self/status");
    std::string word;
    std::int64_t kilobytes = 0;
    while (status >> word)
        if (word == name + ":")
            status >> kilobytes;
    return 1024 * kilobytes;
}

} // namespace

int main(int count, char** words) {
    if (count < 7)
        return 2;
    const auto ranks = join_ranks(read_launch());
    const std::int64_t before = memory("VmRSS");
    const Scene scene = load_scene({.scene = words[1],
                                    .set = {std::string("hanging_wall.mean_radius_m=") + words[3]},
                                    .accuracy = words[2]});
    const ModelParts parts = make_parts(scene);
    const Execution how{.threads = std::atoi(words[6])};
    const bool hashes = count > 7;
    std::int64_t discs = 0;
    {
        RankedCycles on_ranks(*ranks, parts.base, parts.physics, how);
        if (ranks->mine() != 0) {
            on_ranks.serve();
        } else {
            Log log(true);
            State state = make_or_recall_hanging_wall(
                scene, parts, log, {}, {}, static_cast<int>(std::thread::hardware_concurrency()));
            add_mean_velocities(state);
            find_contacts(state, parts.base);
            malloc_trim(0);
            std::ofstream("/proc/self/clear_refs") << 5; // the greatest memory from here on
            discs = static_cast<std::int64_t>(state.discs.rows());
            const std::int64_t cycles = std::atoll(words[4]);
            Packed packed;
            for (int repeat = 0; repeat < std::atoi(words[5]); ++repeat) {
                const auto begin = std::chrono::steady_clock::now();
                if (ranks->count() > 1)
                    on_ranks.advance(state, cycles, repeat > 0);
                else
                    advance(state, parts.base, parts.physics, cycles,
                            {.threads = how.threads, .packed = &packed});
                const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
                std::printf("%.2f\n", static_cast<double>(discs * cycles) / took.count() / 1e6);
            }
            if (hashes) {
                on_ranks.collect(state);
                std::printf("%016lx\n", hash(state));
            }
        }
    }
    std::int64_t numbers[] = {memory("VmHWM") - before, discs};
    ranks->sum(numbers);
    if (ranks->mine() == 0 && !hashes)
        std::printf("%lld discs, %.0f bytes per disc\n", static_cast<long long>(numbers[1]),
                    static_cast<double>(numbers[0]) / static_cast<double>(numbers[1]));
}
