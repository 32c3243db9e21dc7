#pragma once

#include "apps/figures/frame.hpp"
#include "apps/figures/report_moments.hpp"
#include "apps/scene/picks/rock_line.hpp"
#include "apps/scene/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace listric {

/// A run, or two side by side, as a page.
struct ReportPage {
    struct Run {
        const Scene& scene;
        const ReportMoments& moments;
        double mean_radius = 0.0; ///< m
        std::string history;      ///< as history.csv
        std::string summary = {}; ///< as summary.json; empty: the run has not ended
        std::string folder = {};  ///< with a separator, for messages
        bool has_summary = false; ///< the file is there, be it empty
        bool base_moves = false;  ///< the detachment deforms
        std::optional<RockOrigins> rocks = std::nullopt; ///< none: not recorded
    };
    std::vector<Run> runs;
    std::string left_out = {}; ///< parts left out so that the file is smaller
    bool live = false;         ///< the page looks for newer moments in its file
    std::optional<Underlay> underlay = std::nullopt;
};

/// The page: one file that asks for no other, with its scripts and data. Throws StorageError if a
/// file of the program's is missing.
std::string report_html(const ReportPage& page);

/// Parts that the runs' folders lack, a sentence each; the page shows them, too.
std::vector<std::string> lacks_of(const ReportPage& page);

} // namespace listric
