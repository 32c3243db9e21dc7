#include "apps/run/genesis_cache.hpp"

#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/cache_folder.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/memory.hpp"
#include "apps/support/version.hpp"
#include "dem/genesis/genesis.hpp"
#include "dem/numbers/hash.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace listric {

using namespace archive;
using namespace dem;

namespace {

namespace fs = std::filesystem;

/// All that a hanging wall depends on, as text: it is kept with it.
std::string asked_for(const Scene& scene, const ModelParts& parts) {
    // The time step is that of the stiffest material, also of those that discs become later; these
    // shift the places of the layers' rocks in the list, by which kept discs name them.
    std::string text = fmt::format("{}\n# {} {} {} {} {}\n", to_toml(genesis_of(scene)),
                                   stable_time_step(1.0, parts.materials, 0.0, 1.0), source_hash,
                                   compiler, build_flags, instruction_set);
    if (scene.cycle.inertial_mass_floor == 0.0 && parts.sediment) // see genesis' time step
        text += fmt::format("# sediment: {}\n", parts.sediment->disc_density);
    for (const LayerFacts& layer : parts.layers)
        text += fmt::format("# {}: material {}\n", layer.name, layer.rock.material);
    return text;
}

/// Content of a kept file, if it is the wanted one: the name alone is no proof.
std::optional<State> recall(const fs::path& cache, const std::string& asked,
                            const std::vector<Material>& materials, Log& log) {
    std::error_code ignored;
    if (!fs::exists(cache, ignored))
        return std::nullopt;
    try {
        Snapshot kept = read_snapshot(cache);
        if (kept.record.scene != asked)
            throw StorageError(cache.string() + ": is of another one");
        kept.state.materials = materials;
        log.say("hanging wall: kept from an earlier run, " + cache.string());
        return std::move(kept.state);
    } catch (const std::runtime_error& error) {
        log.say(std::string("warning: the kept hanging wall is made again: ") + error.what());
        return std::nullopt;
    }
}

void keep(const State& state, const fs::path& cache, const std::string& asked, Log& log) {
    try {
        make_folder(cache.parent_path());
        RunRecord record;
        record.scene = asked;
        write_snapshot(cache, state, {}, record);
    } catch (const std::exception& error) {
        log.say(std::string("warning: the hanging wall cannot be kept for later runs: ") +
                words_of(error));
    }
}

/// Held by the process that makes a hanging wall, so that runs side by side make equal ones once.
/// Where no file can be written nothing is locked.
class MakingLock {
public:
    /// Waits for the process that holds it. Throws Interrupted.
    MakingLock(const fs::path& cache, Log& log, StopToken stop) {
        std::error_code ignored;
        fs::create_directories(cache.parent_path(), ignored);
        file_ = open((cache.string() + ".lock").c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC,
                     0666);
        while (file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            if (!has_waited_)
                log.say("hanging wall: another run makes it");
            has_waited_ = true;
            if (stop.requested()) {
                close(file_);
                throw Interrupted{};
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }
    ~MakingLock() {
        if (file_ >= 0)
            close(file_);
    }
    MakingLock(const MakingLock&) = delete;
    MakingLock& operator=(const MakingLock&) = delete;

    bool has_waited() const { return has_waited_; }

private:
    int file_ = -1;
    bool has_waited_ = false;
};

} // namespace

fs::path genesis_cache_path(const Scene& scene, const ModelParts& parts) {
    const fs::path folder = cache_folder();
    if (folder.empty())
        return {};
    return folder / fmt::format("genesis-{:016x}.h5", fnv1a(asked_for(scene, parts)));
}

State make_or_recall_hanging_wall(const Scene& scene, const ModelParts& parts, Log& log,
                                  const StageReport& report, StopToken stop, int threads) {
    const fs::path cache = genesis_cache_path(scene, parts);
    if (cache.empty()) {
        log.say("warning: the hanging wall cannot be kept for later runs: HOME is not set, and "
                "there is no folder for temporary files that is yours alone; XDG_CACHE_HOME may "
                "name one");
        return make_hanging_wall(scene, parts, report, stop, threads);
    }
    const std::string asked = asked_for(scene, parts);
    if (auto state = recall(cache, asked, parts.materials, log))
        return std::move(*state);
    const MakingLock lock(cache, log, stop);
    if (lock.has_waited())
        if (auto state = recall(cache, asked, parts.materials, log))
            return std::move(*state);
    State state = make_hanging_wall(scene, parts, report, stop, threads);
    keep(state, cache, asked, log);
    return state;
}

} // namespace listric
