#include "apps/commands/underlay.hpp"

#include "apps/commands/command.hpp"
#include "apps/model/effects.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/picture.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string>

namespace listric {

namespace fs = std::filesystem;

void add_underlay(CLI::App& command, UnderlayOptions& options) {
    command
        .add_option("--underlay", options.image,
                    "PNG or JPEG of a section, over which the model's lines are drawn")
        ->type_name("FILE")
        ->default_str("none");
    add_numbers(command, "--corners", options.corners,
                "upper left and lower right corner of the picture in the section, m: x0,z0,x1,z1")
        ->default_str("those that the run's scene has for the picture");
}

void require_corners(const std::vector<double>& corners) {
    if (const std::string why = objection_to_corners(corners); !why.empty())
        throw UsageError(fmt::format(
            "--corners: {}; needs x0,z0,x1,z1 in metres, of the picture's upper left and lower "
            "right corner, depth positive down: --corners 0,0,50000,15000",
            why));
}

namespace {

/// Corners that the scene of a run has for a picture of that name; empty: it has none.
std::vector<double> corners_in(const std::vector<fs::path>& runs, const fs::path& picture) {
    for (const fs::path& run : runs) {
        const fs::path file = run / "scene.toml";
        std::error_code error;
        if (!fs::is_regular_file(file, error))
            continue;
        const auto observed = load_scene({.scene = file.string(), .is_record = true}).observed;
        if (observed && fs::path(observed->picture).filename() == picture.filename())
            return observed->corners;
    }
    return {};
}

} // namespace

std::optional<Underlay> underlay_of(const UnderlayOptions& options,
                                    const std::vector<fs::path>& runs) {
    if (options.image.empty() && options.corners.empty())
        return std::nullopt;
    std::error_code error;
    if (options.image.empty())
        throw UsageError("--corners: is of --underlay, which is not there");
    if (!fs::is_regular_file(options.image, error))
        throw UsageError(fmt::format("--underlay {}: {}", shown(options.image),
                                     fs::is_directory(options.image, error)
                                         ? "is a directory, needs a PNG or JPEG"
                                         : "no such file"));
    const std::vector<double> c =
        options.corners.empty() ? corners_in(runs, options.image) : options.corners;
    require_corners(c);
    try {
        read_picture(options.image);
    } catch (const UsageError& problem) {
        throw UsageError(fmt::format("--underlay {}", problem.what()));
    }
    return Underlay{options.image, c[0], c[1], c[2], c[3]};
}

} // namespace listric
