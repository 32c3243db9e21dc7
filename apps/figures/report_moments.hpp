#pragma once

#include "apps/measures/faults/fault.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "fem/footwall.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace listric {

/// Parts that a report leaves out to be smaller.
struct ReportDetail {
    bool bonds = true;
    bool stress = true;
    int every = 1; ///< n: every n-th snapshot, and the last
};

/// The lines of a section as the page of a report reads them, packed, and what the faults among
/// them make of its discs.
struct SectionLines {
    std::string packed;
    bool followed = false;                    ///< faults back to their birth
    std::vector<std::uint8_t> behaviour = {}; ///< class of rock by row; empty without bonds
};

using LinesOfMoments = std::map<dem::Travel, SectionLines>;

/// Faults, horizons, surfaces, the base, predictions and what effects draw.
/// @param followed  whether the faults are followed back to their birth; then horizons, which
///                  take as long, are traced, too
/// @param footwall  stress below the base; none: it is rigid, or has not been recovered
SectionLines section_lines(const Observation& now, const measures::FaultReport& faults,
                           bool followed, std::span<const fem::StressPatch> footwall = {});

/// The moments of a run as the page of a report reads them: whole numbers by the discs' ids, as
/// differences from the moment before; docs/guides/report.md, "What is in the file".
class ReportMoments {
public:
    explicit ReportMoments(const ReportDetail& detail = {}) : detail_(detail) {}

    /// Adds the discs of a moment and the lines of its section. The moment that was added last
    /// may come again, with other lines.
    void add(const Observation& now, const SectionLines& lines);

    /// About how many bytes json() has.
    std::size_t bytes() const;

    /// Whether the last moment is that one, and as much of it is there.
    bool has(dem::Travel moment, bool followed) const {
        return at_ == moment && followed_ >= followed;
    }

    /// A JSON array of all moments.
    std::string json() const;

private:
    struct Text {
        std::string discs, lines;
    };

    using Stream = std::function<std::string()>; ///< makes the text of some numbers
    std::vector<Stream> streams(const Observation& now, std::span<const std::uint8_t> behaviour,
                                std::map<std::string, double>& ends);
    std::string bonds(const dem::State& state);

    ReportDetail detail_;
    std::optional<dem::Travel> at_; ///< the last moment
    bool followed_ = false;         ///< whether its faults are
    std::vector<Text> moments_;
    std::map<std::string, std::vector<std::int32_t>> before_; ///< codes of the last moment
    std::vector<std::int64_t> bonded_; ///< pairs of ids that were bonded then, as one number each
};

/// Keys to the numbers of ReportMoments, as JSON: by name the value of one
/// step (unit), and whether the number is its square root.
std::string report_scales(double mean_radius);

} // namespace listric
