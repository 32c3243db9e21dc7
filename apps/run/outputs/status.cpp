#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/tables/rock_record.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"
#include "apps/scene/parameters/stage.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>

namespace listric {

namespace {

const char* name(Phase phase) {
    constexpr const char* names[] = {"genesis", "extension", "stopped", "finished", "failed"};
    return names[static_cast<int>(phase)];
}

/// Writes how far the run is.
void tell(const RunView& run) {
    const double left = run.phase == Phase::finished ? 0.0 : run.seconds_left();
    JsonObject status{{"phase", name(run.phase)}, {"extension_m", run.extension().m}};
    if (run.has_stages()) {
        status[travel_column] = run.travel().m; // of_m is of the travel
        status["stage"] = run.simulation.base().motion.stage(run.travel());
    }
    status["of_m"] = run.target().m;
    if (run.rocks)
        status["rocks"] = archive::rocks_json(*run.rocks);
    status["seconds_left"] = std::int64_t{std::llround(left)};
    write_object(run.options.output / "status.json", status);
}

} // namespace

std::optional<Output> outputs::status(const RunView&) {
    return Output{.enter = tell, .window = tell};
}

} // namespace listric
