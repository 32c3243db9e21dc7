#include "apps/run/ranks/ranked_run.hpp"

#include "apps/model/model.hpp"
#include "apps/run/exit_code.hpp"
#include "apps/run/ranks/rank_reports.hpp"
#include "apps/run/ranks/ranked_call.hpp"
#include "apps/run/run.hpp"
#include "dem/ranks/ranked_cycles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace listric {

using namespace dem;

namespace {

/// Tells how it ends, and ends all ranks.
[[noreturn]] void end_all(Ranks& ranks, const Ending& ending) {
    tell(ending);
    report_end(ranks.mine(), static_cast<int>(ending.code));
    ranks.abort(static_cast<int>(ending.code));
    std::_Exit(static_cast<int>(ending.code));
}

/// Ends all ranks for what has been thrown here. What is wrong with the call the root tells, too:
/// the others wait for that, or for the next that it has to say.
[[noreturn]] void end_all(Ranks& ranks, const std::exception_ptr& thrown) {
    const Ending ending = ending_of(thrown);
    if (ranks.mine() != 0 && ending.code == ExitCode::bad_call) {
        Bytes next;
        ranks.broadcast(next);
    }
    end_all(ranks, ending);
}

/// Reason that keeps a process from the run, as a letter.
Bytes packed(const Ending& ending) {
    Bytes letter(1 + ending.message.size(), static_cast<std::byte>(ending.code));
    std::ranges::copy(std::as_bytes(std::span(ending.message)), letter.begin() + 1);
    return letter;
}

Ending unpacked_ending(const Bytes& letter) {
    Ending ending{static_cast<ExitCode>(letter.at(0)), ""};
    for (auto byte = letter.begin() + 1; byte != letter.end(); ++byte)
        ending.message += static_cast<char>(*byte);
    return ending;
}

/// Ends all ranks if anything keeps one from the run, or if one was called otherwise than the root:
/// with one message, the root's. What is said here must not change from version to version, or else
/// two of them would wait for each other.
/// @param problem  of this one; its call is empty then
void agree(Ranks& ranks, const std::vector<CallPart>& call, const Ending& problem) {
    // Programs that know nothing of this (to f005c7a) take anything but 0 for a process that cannot
    // read its scene. They say so, and end all, where the root speaks next.
    std::array<std::uint64_t, 1> met{2};
    ranks.greatest(met);
    Bytes of_root = ranks.mine() == 0 ? packed(call) : Bytes();
    ranks.broadcast(of_root);
    const std::vector<CallPart> wanted = unpacked_call(of_root);
    Ending mine = problem;
    if (mine.code == ExitCode::done && !wanted.empty())
        if (const auto difference = first_difference(wanted, call))
            mine = {ExitCode::bad_call, *difference + "; all processes of a run need the same, "
                                                      "--ranks=1 makes one of each"};
    std::optional<Ending> first;
    ranks.gather(packed(mine), [&](int rank, const Bytes& letter) {
        Ending ending = unpacked_ending(letter);
        if (first || ending.code == ExitCode::done)
            return;
        if (rank != 0)
            ending.message = fmt::format("process {} {}", rank, ending.message);
        first = ending;
    });
    if (first)
        end_all(ranks, *first);
    Bytes go_on; // which never comes if that was the end
    ranks.broadcast(go_on);
}

/// Task of all processes, once they agree.
std::pair<Scene, RunOptions> agreed_call(Ranks& ranks, const RankedRun& run) {
    std::optional<Scene> scene;
    RunOptions options;
    std::vector<CallPart> call;
    Ending problem{ExitCode::done, ""};
    try {
        scene = run.read_scene();
        options = run.prepare(*scene, ranks.mine() == 0);
        call = call_of(*scene, options);
    } catch (...) {
        problem = ending_of(std::current_exception());
        if (ranks.mine() != 0)
            problem.message = "cannot begin: " + problem.message;
    }
    agree(ranks, call, problem);
    return {std::move(*scene), std::move(options)};
}

} // namespace

std::optional<Objection> objection_to_ranks(const Scene& scene) {
    for (const EffectPart& part : scene.effects)
        if (part.effect->on_ranks)
            if (auto objection = part.effect->on_ranks(scene))
                return objection;
    return std::nullopt;
}

RunOutcome run_on_ranks(Ranks& ranks, const RankedRun& run) {
    try {
        const auto [scene, given] = agreed_call(ranks, run);
        RunOptions options = given;
        const ModelParts parts = make_parts(scene);
        RankedCycles cycles(ranks, parts.base, parts.physics, options.execution());
        options.on_ranks = &cycles;
        try {
            if (ranks.mine() == 0)
                return run_scene(scene, options);
            cycles.serve();
            return RunOutcome::finished;
        } catch (...) { // before the end of `cycles`, which speaks to the others
            end_all(ranks, std::current_exception());
        }
    } catch (...) {
        end_all(ranks, std::current_exception());
    }
}

} // namespace listric
