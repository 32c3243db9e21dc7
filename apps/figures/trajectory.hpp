#pragma once

#include "apps/archive/exports.hpp"
#include "apps/support/file.hpp"

#include <filesystem>

namespace listric {

/// Discs and bonds of several moments as one GSD file, which OVITO opens: the arrays that the
/// script reads, in a folder that vanishes with this object.
class Trajectory {
public:
    /// @param folder  where the file goes
    explicit Trajectory(const std::filesystem::path& folder) : data_(folder) {}

    /// Throws StorageError.
    void add(const archive::ExportedMoment& at);

    /// Throws UsageError if Python's gsd is missing, StorageError if the file cannot be written.
    void write(const std::filesystem::path& file) const;

private:
    TemporaryFolder data_;
    int frames_ = 0;
};

} // namespace listric
