#include "apps/run/genesis_cache.hpp"

#include "apps/archive/snapshot.hpp"
#include "apps/support/version.hpp"
#include "dem/genesis.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <system_error>

namespace listric {

using namespace dem;

namespace {

namespace fs = std::filesystem;

std::optional<State> recall(const fs::path& cache, const Scene& scene, Log& log) {
    std::error_code ignored;
    if (!fs::exists(cache, ignored))
        return std::nullopt;
    try {
        State state = read_snapshot(cache).state;
        state.materials = make_materials(scene);
        log.say("hanging wall: kept from an earlier run, " + cache.string());
        return state;
    } catch (const StorageError& error) {
        log.say(std::string("warning: the kept hanging wall is made anew: ") + error.what());
        return std::nullopt;
    }
}

void keep(const State& state, const fs::path& cache, Log& log) {
    try {
        fs::create_directories(cache.parent_path());
        write_snapshot(cache, state, {}, {});
    } catch (const std::exception& error) {
        log.say(std::string("warning: the hanging wall cannot be kept for later runs: ") +
                error.what());
    }
}

} // namespace

fs::path genesis_cache_path(const Scene& scene) {
    Scene start = scene;
    start.accuracy = start.description = start.name = "";
    start.extension = {};
    start.output = {};
    start.extension.distance = scene.extension.distance; // decides how far the base reaches
    start.fault_weakening.reset();
    start.bond_healing.reset();
    start.sedimentation.reset();
    start.compaction.reset();
    start.elastic_base.reset();
    start.lower_crust_thinning.reset();
    start.basin_water.reset();
    start.footwall_erosion.reset();
    start.base_motion.reset();
    start.energy.reset();
    std::uint64_t key = 1469598103934665603u; // FNV-1a
    const auto stir = [&](std::string_view text) {
        for (char letter : text)
            key = (key ^ static_cast<unsigned char>(letter)) * 1099511628211u;
    };
    stir(to_toml(start));
    // The time step is that of the stiffest material, also of those that discs become later.
    stir(fmt::format("{}", stable_time_step(1.0, make_materials(scene), 0.0, 1.0)));
    stir(source_hash);
    stir(compiler);
    stir(build_flags);
    stir(instruction_set);
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    const fs::path folder = cache && *cache ? fs::path(cache)
                            : home && *home ? fs::path(home) / ".cache"
                                            : fs::temp_directory_path();
    return folder / "listric" / fmt::format("genesis-{:016x}.h5", key);
}

State make_or_recall_hanging_wall(const Scene& scene, const RigidBase& base, Log& log,
                                  StopToken stop) {
    const fs::path cache = genesis_cache_path(scene);
    if (auto state = recall(cache, scene, log))
        return std::move(*state);
    const GenesisRequest request{
        .hanging_wall = *scene.hanging_wall,
        .base = base,
        .materials = make_materials(scene),
        .bonds = scene.bonds,
        .physics = {.damping = scene.cycle.damping,
                    .gravity = scene.gravity ? scene.gravity->acceleration : 0.0},
        .time_step_safety = scene.cycle.time_step_safety,
        .inertial_mass_floor = scene.cycle.inertial_mass_floor,
        .skin = scene.cycle.skin,
        .seed = scene.seed};
    State state = make_hanging_wall(request, [&](std::string_view stage, double share) {
        if (stop.requested())
            throw Interrupted{};
        log.progress(fmt::format("hanging wall: {} ({:.0f} %)", stage, 100.0 * share));
    });
    keep(state, cache, log);
    return state;
}

} // namespace listric
