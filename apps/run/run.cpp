#include "apps/run/run.hpp"

#include "apps/archive/folder/output_folder.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/tables/rock_record.hpp"
#include "apps/model/base_driver.hpp"
#include "apps/run/forecast/hints.hpp"
#include "apps/run/forecast/prediction.hpp"
#include "apps/run/session.hpp"
#include "apps/support/machine/memory.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/log.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/threads/shared_loop.hpp"

#include <fmt/format.h>

#include <cmath>
#include <new>

namespace listric {

using namespace archive;
using namespace dem;

namespace {

namespace fs = std::filesystem;

/// Cure for a run that ended early, after its error.
std::string with_hint(const std::exception& error, const fs::path& output, std::string_view what) {
    const bool has_snapshot = !list_snapshots(output).empty();
    return has_snapshot ? fmt::format("{}\n{}; {}, {}", error.what(), last_good_state(output), what,
                                      resume_hint(output))
                        : error.what();
}

MemoryError memory_error(const Scene& scene) {
    return MemoryError(fmt::format("memory is short: the run needs about {:.0f} MB{}",
                                   std::ceil(predict(scene).memory / 1e6),
                                   words_of_address_limit()));
}

} // namespace

RunOutcome run_scene(const Scene& scene, const RunOptions& options, OutputList outputs) {
    const fs::path& output = options.output;
    FolderUse use = folder_use(scene, options.end(scene.extension.distance));
    use.with_report = options.report && scene.output.report;
    const auto lock = take_output(use, output, options.existing());
    if (!lock)
        return RunOutcome::finished;

    Log log(output / "log.txt", options.quiet);
    log.say(fmt::format("listric {} runs {} ({}, seed {}) into {}", version, scene.name,
                        scene.accuracy, scene.seed, output.string()));
    log.say(rock_line(scene, list_snapshots(output).empty() ? known_rocks(scene)
                                                            : recorded_rocks(output)));
    note_memory_need(predict(scene).memory);
    try {
        const Team team(options.threads);
        return Session(scene, options, log, outputs).run();
    } catch (const BeyondElasticity& limit) {
        throw NumericalFailure(
            fmt::format("{}\n{}, and valid", limit.what(), last_good_state(output)));
    } catch (const NothingLeft& end) {
        throw NumericalFailure(fmt::format("{}\n{}, and valid; resumed it would end the same way",
                                           end.what(), last_good_state(output)));
    } catch (const NumericalFailure& failure) {
        throw NumericalFailure(fmt::format("{}\n{}; {}", failure.what(), last_good_state(output),
                                           retry_hint(scene, output)));
    } catch (const UnreadableFile& failure) { // of the run that was to be resumed
        throw UnreadableFile(std::string(failure.what()) +
                             "; make it readable, or move it away to resume without it");
    } catch (const StorageError& failure) {
        throw StorageError(with_hint(failure, output, "once files can be written"));
    } catch (const std::bad_alloc&) {
        const MemoryError failure = memory_error(scene);
        throw MemoryError(with_hint(failure, output, "where there is more memory"));
    }
}

} // namespace listric
