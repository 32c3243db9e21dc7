#include "apps/run/run.hpp"

#include "apps/archive/output_folder.hpp"
#include "apps/archive/run_folder.hpp"
#include "apps/model/base_driver.hpp"
#include "apps/run/flexure.hpp"
#include "apps/run/hints.hpp"
#include "apps/run/prediction.hpp"
#include "apps/run/session.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/file.hpp"
#include "apps/support/log.hpp"
#include "apps/support/memory.hpp"
#include "apps/support/version.hpp"
#include "dem/nothing_left.hpp"
#include "dem/threads/shared_loop.hpp"

#include <fmt/format.h>

#include <cmath>
#include <new>

namespace listric {

using namespace archive;
using namespace dem;

namespace {

namespace fs = std::filesystem;

/// What to do about a run that ended early, after what was wrong.
std::string with_hint(const std::exception& error, const fs::path& output, std::string_view what) {
    const bool has_snapshot = !list_snapshots(output).empty();
    return has_snapshot ? fmt::format("{}\n{}; {}, {}", error.what(), last_good_state(output), what,
                                      resume_hint(output))
                        : error.what();
}

MemoryError memory_error(const Scene& scene) {
    const double bytes = scene.hanging_wall ? predict(scene).memory : 0.0;
    const std::string discs =
        bytes > 0.0 ? fmt::format("the run needs about {:.0f} MB", std::ceil(bytes / 1e6))
                    : "the elastic base takes more than there is";
    return MemoryError("memory is short: " + discs);
}

} // namespace

RunOutcome run_scene(const Scene& scene, const RunOptions& options, OutputList outputs) {
    const fs::path& output = options.output;
    const ExistingRun existing = options.force    ? ExistingRun::replaced
                                 : options.resume ? ExistingRun::resumed
                                                  : ExistingRun::refused;
    if (check_output(scene, output, existing, options.end(scene.extension.distance)))
        return RunOutcome::finished;
    std::error_code error;
    fs::create_directories(output, error);
    const FolderLock lock(output);
    prepare_output(scene, output, existing);

    Log log(output / "log.txt", options.quiet);
    log.say(fmt::format("listric {} runs {} ({}, seed {}) into {}", version, scene.name,
                        scene.accuracy, scene.seed, output.string()));
    if (scene.hanging_wall)
        note_memory_need(predict(scene).memory);
    try {
        if (!scene.flexure) {
            const Team team(options.threads);
            return Session(scene, options, log, outputs).run();
        }
        write_text(output / "scene.toml", to_toml(scene));
        bend_base(scene, options.threads, output, [&](const std::string& text) { log.say(text); });
        return RunOutcome::finished;
    } catch (const BeyondElasticity& limit) {
        throw NumericalFailure(
            fmt::format("{}\n{}, and valid", limit.what(), last_good_state(output)));
    } catch (const NothingLeft& end) {
        throw NumericalFailure(fmt::format("{}\n{}, and valid; resumed it would end the same way",
                                           end.what(), last_good_state(output)));
    } catch (const NumericalFailure& failure) {
        throw NumericalFailure(fmt::format("{}\n{}; {}", failure.what(), last_good_state(output),
                                           retry_hint(scene, output)));
    } catch (const StorageError& failure) {
        throw StorageError(with_hint(failure, output, "once files can be written"));
    } catch (const std::bad_alloc&) {
        const MemoryError failure = memory_error(scene);
        throw MemoryError(with_hint(failure, output, "where there is more memory"));
    }
}

} // namespace listric
