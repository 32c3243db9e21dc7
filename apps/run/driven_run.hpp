#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/named_numbers.hpp"
#include "dem/state.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace listric {

/// A run of a scene that another program drives, with the bits of `listric run`. It writes no file
/// but those that save() is asked for, and the cache of hanging walls.
class Run {
public:
    /// Begins with the hanging wall before extension. Throws UsageError where the scene has no
    /// hanging wall, NumericalFailure.
    explicit Run(Scene scene, int threads = 1);
    /// As above, but knows no cache: writes and reads no file until save() is called.
    static Run without_files(Scene scene, int threads = 1);
    ~Run();
    Run(Run&&) noexcept;

    /// Told after every batch of cycles, a fraction of a second. If it returns false, the run stops
    /// once due events are applied.
    using Report = std::function<bool(const Run&)>;

    /// Extends to `goal`, m, at most extension.distance_m of the scene. Returns false if the report
    /// has stopped it. Throws UsageError, NumericalFailure.
    bool extend_to(double goal, const Report& report = {});

    const Scene& scene() const;
    const dem::State& state() const;
    double extension() const;   ///< m
    std::uint64_t hash() const; ///< `state_hash` of summary.json

    /// Measures of the present moment by the names of docs/reference/measures.md: those of
    /// history.csv, and those that the faults have in common.
    NamedNumbers measures();

    /// Active faults, followed back to their birth.
    const measures::FaultReport& faults();

    /// Writes a snapshot, which archive::read_snapshot() reads. Throws StorageError.
    void save(const std::filesystem::path& path) const;

    // The files of the folder that `listric run` would leave, as bytes and texts.

    /// Told where a window has ended, once the history has its row.
    void at_windows(std::function<void(const Run&)> told);
    std::vector<std::byte> snapshot() const; ///< that save() writes
    std::string snapshot_name() const;       ///< of the present moment
    std::string history() const;             ///< history.csv so far
    std::string summary();                   ///< summary.json of a run that ends here

private:
    struct Parts;
    explicit Run(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
};

} // namespace listric
