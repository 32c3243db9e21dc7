#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// Formats that pictures can have.
inline constexpr std::string_view picture_formats[] = {"png", "pdf", "svg"};

/// In which formats pictures are written, and what they say of the run that they show.
struct PictureOrder {
    std::vector<std::string> formats{"png"};
    nlohmann::ordered_json provenance = nullptr; ///< none: of no single run

    /// The drawing scripts' last argument.
    std::string text() const;
};

} // namespace listric
