#pragma once

#include "apps/archive/run_folder.hpp"
#include "apps/measures/setting.hpp"
#include "apps/measures/shear_field.hpp"

#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace listric::archive {

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

    /// The last moments before `extension`, m, oldest first. They are whole windows apart, counted
    /// back from there, so that the last window of a run that ends within one is not too short.
    /// @param most  how many
    std::vector<measures::DiscPlaces>
    before(double extension, const measures::Setting& setting,
           std::size_t most = std::numeric_limits<std::size_t>::max()) const;

private:
    std::vector<measures::DiscPlaces> moments_; ///< by extension
};

} // namespace listric::archive
