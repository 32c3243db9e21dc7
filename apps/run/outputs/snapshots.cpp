#include "apps/archive/folder/run_files.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"

namespace listric {

using namespace archive;

namespace fs = std::filesystem;

namespace {

/// Removes what was written where the run was stopped before, and from where it has gone on: it is
/// then as if it had never stopped.
void remove_passed_stops(const RunView& run) {
    const fs::path& output = run.options.output;
    const MomentNames names = run.names();
    const std::string present = names.metres(run.travel().m);
    std::error_code error;
    for (const fs::path& path : list_snapshots(output)) {
        const std::string moment = *moment_of_snapshot(path.filename().string());
        const double stop = snapshot_extension(path);
        const auto end = names.window_end(moment);
        const bool is_old_name = end && *end == run.travel().m; // of an older version
        if (moment == present || (!is_old_name && (stop > run.travel().m || end)))
            continue;
        for (const fs::path& file : files_of_moment(output, moment, names.kilometres(stop)))
            fs::remove(file, error);
        fs::remove(path, error);
    }
}

/// Writes the state from which the run can go on.
void save(RunView& run) {
    run.kept = run.snapshot();
    write_snapshot(run.kept, run.state(), run.simulation.events(), run.record);
    remove_passed_stops(run);
}

} // namespace

std::optional<Output> outputs::snapshots(const RunView&) {
    return Output{.begin = save, .window = save, .save = save, .finish = remove_passed_stops};
}

} // namespace listric
