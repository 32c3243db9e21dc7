#pragma once

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// Formats that pictures can have.
inline constexpr std::string_view picture_formats[] = {"png", "pdf", "svg"};

/// Formats that animations can have.
inline constexpr std::string_view film_formats[] = {"mp4", "gif", "webp"};

/// Panels that a figure can have, besides layers of effects: layer-NAME.
inline constexpr std::string_view panel_names[] = {"strata",    "bonds",    "behaviour",
                                                   "strain",    "sediment", "kinematics",
                                                   "inversion", "seismic",  "seismic-depth"};

/// In which formats pictures are written, and what they say of the run that they show.
struct PictureOrder {
    std::vector<std::string> formats{"png"};
    nlohmann::ordered_json provenance = nullptr; ///< none: of no single run
    std::string errors = {};                     ///< of what is shown, a sentence for captions
    double width_mm = 0.0;                       ///< of a figure for print; 0: pages for a screen
    std::vector<std::string> only = {};          ///< panels; none: all that are drawn unasked
    bool plain = false;                          ///< without headline and small print
    double dpi = 0.0;                            ///< of pictures; 0: 150, for print 300
    bool caption = false;                        ///< write caption.txt, too

    bool wants(std::string_view panel) const {
        return std::find(only.begin(), only.end(), panel) != only.end();
    }

    /// The drawing scripts' last argument.
    std::string text() const;
};

} // namespace listric
