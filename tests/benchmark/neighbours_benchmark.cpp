// Cost of a neighbour search per disc, beside the cycle's 10 ns: of all discs, of one that ran
// ahead, and packing the fast cycle's records after it.

#include "dem/cycle/fast_cycle.hpp"
#include "tests/support.hpp"

#include <benchmark/benchmark.h>

namespace listric {

using namespace dem;
namespace {

using namespace support;

State packing(std::size_t discs) {
    const auto rows = static_cast<std::size_t>(std::sqrt(static_cast<double>(discs) / 3.0));
    State state = make_state(cloud(discs / rows, rows, 93.1, 1));
    state.clock.time_step = 0.01;
    sort_discs(state);
    find_contacts(state, {});
    return state;
}

void per_disc(benchmark::State& run, const State& state) {
    run.counters["per_disc"] = benchmark::Counter(static_cast<double>(state.discs.rows()),
                                                  benchmark::Counter::kIsIterationInvariantRate |
                                                      benchmark::Counter::kInvert);
}

void search_all(benchmark::State& run) {
    State state = packing(static_cast<std::size_t>(run.range(0)));
    for (auto _ : run)
        find_contacts(state, {});
    per_disc(run, state);
}

void search_one(benchmark::State& run) {
    State state = packing(static_cast<std::size_t>(run.range(0)));
    const DiscColumns d = disc_columns(state);
    double step = 0.5 * state.skin;
    for (auto _ : run) {
        d.x[d.x.size() / 2] += step;
        step = -step;
        update_contacts(state, {});
    }
    per_disc(run, state);
}

void pack(benchmark::State& run) {
    const State state = packing(static_cast<std::size_t>(run.range(0)));
    const RigidBase base;
    FastCycle cycle(1, fast_cycle());
    cycle.pack(state, base, {}, nullptr);
    for (auto _ : run)
        cycle.pack_updated(state, true, nullptr);
    per_disc(run, state);
}

BENCHMARK(search_all)->Arg(5000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(search_one)->Arg(5000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(pack)->Arg(5000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace listric
