#pragma once

#include "apps/archive/folder/run_folder.hpp"
#include "apps/measures/faults/shear_field.hpp"
#include "apps/measures/setting.hpp"

#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace listric::archive {

/// Indices of those of some moments, ascending, that measures of `now` look back at: whole windows
/// apart (Setting::is_window), counted back from there, so that the last window of a run that ends
/// within one is not too short. The first moment is one of them if the wall has moved since.
/// @param most  how many
std::vector<std::size_t> whole_windows(std::span<const dem::Travel> moments, dem::Travel now,
                                       const measures::Setting& setting,
                                       std::size_t most = std::numeric_limits<std::size_t>::max());

/// Where the discs were at the past moments of a run: what the faults' history needs of its
/// snapshots, kept so that they are read once.
class RunHistory {
public:
    RunHistory() = default;

    /// The moments of snapshots, oldest first, which must be the ends of windows, but for the last.
    /// Those that cannot be read are passed over. Throws UsageError if another run made one.
    /// @param scene  of the run, its text; nothing: any
    explicit RunHistory(std::span<const std::filesystem::path> snapshots,
                        const std::string& scene = {});

    /// The moments of a run.
    explicit RunHistory(const RunFolder& run) : RunHistory(run.snapshots, run.moments.scene) {}

    /// Adds a moment, and forgets those that are not older: the run has gone back.
    void add(measures::DiscPlaces places);

    /// The whole_windows() before `now`, oldest first; none before the first is over.
    std::vector<measures::DiscPlaces>
    before(dem::Travel now, const measures::Setting& setting,
           std::size_t most = std::numeric_limits<std::size_t>::max()) const;

private:
    std::vector<measures::DiscPlaces> moments_; ///< by travel
};

} // namespace listric::archive
