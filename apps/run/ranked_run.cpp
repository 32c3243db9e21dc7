#include "apps/run/ranked_run.hpp"

#include "apps/model/model.hpp"
#include "apps/run/exit_code.hpp"
#include "apps/run/run.hpp"
#include "apps/support/error.hpp"
#include "dem/ranked_cycles.hpp"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace listric {

using namespace dem;

namespace {

/// Whether all ranks are as well as this one says that it is.
bool all_are_well(Ranks& ranks, bool well) {
    std::array<std::uint64_t, 1> failed{well ? 0u : 1u};
    ranks.greatest(failed);
    return failed[0] == 0;
}

/// The scene, once all processes have read it.
Scene agreed_scene(Ranks& ranks, const RankedRun& run) {
    std::optional<Scene> scene;
    std::exception_ptr problem;
    try {
        scene = run.read_scene();
    } catch (...) {
        problem = std::current_exception();
    }
    if (all_are_well(ranks, scene.has_value()))
        return std::move(*scene);
    if (problem)
        std::rethrow_exception(problem);
    throw UsageError("not all processes can read the scene; do their machines see the same files?");
}

/// Tells what has been thrown, and ends all ranks. What is wrong with the call the root tells, too:
/// the others wait for that, or for the next that it has to say.
[[noreturn]] void end_all(Ranks& ranks) {
    const Ending ending = ending_of(std::current_exception());
    if (ranks.mine() != 0 && ending.code == ExitCode::bad_call) {
        Bytes next;
        ranks.broadcast(next);
    }
    tell(ending);
    ranks.abort(static_cast<int>(ending.code));
    std::_Exit(static_cast<int>(ending.code));
}

} // namespace

std::optional<Objection> objection_to_ranks(const Scene& scene) {
    if (!scene.hanging_wall)
        return Objection{"flexure", "has no discs to be shared; start one process"};
    for (const EffectPart& part : scene.effects)
        if (part.effect->on_ranks)
            if (auto objection = part.effect->on_ranks(scene))
                return objection;
    return std::nullopt;
}

RunOutcome run_on_ranks(Ranks& ranks, const RankedRun& run) {
    try {
        const Scene scene = agreed_scene(ranks, run);
        RunOptions options = run.prepare(scene, ranks.mine() == 0);
        const ModelParts parts = make_parts(scene);
        RankedCycles cycles(ranks, parts.base, parts.physics,
                            {options.threads, options.plain ? Cycle::plain : best_cycle()});
        options.on_ranks = &cycles;
        try {
            if (ranks.mine() == 0)
                return run_scene(scene, options);
            cycles.serve();
            return RunOutcome::finished;
        } catch (...) {
            end_all(ranks); // before the end of `cycles`, which speaks to the others
        }
    } catch (...) {
        end_all(ranks);
    }
}

} // namespace listric
