#include "apps/commands/underlay.hpp"

#include "apps/commands/command.hpp"
#include "apps/support/error.hpp"
#include "apps/support/picture.hpp"
#include "apps/support/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace listric {

void add_underlay(CLI::App& command, UnderlayOptions& options) {
    command
        .add_option("--underlay", options.image,
                    "PNG or JPEG of a section, over which the model's lines are drawn")
        ->type_name("FILE")
        ->default_str("none");
    add_numbers(command, "--corners", options.corners,
                "upper left and lower right corner of the picture in the section, m: x0,z0,x1,z1")
        ->default_str("none; required with --underlay");
}

namespace {

/// Largest coordinate of a section of the Earth: nobody means more, m.
constexpr double furthest = 1e8;

} // namespace

void require_corners(const std::vector<double>& c) {
    const auto refuse = [](const std::string& why) {
        throw UsageError(fmt::format(
            "--corners: {}; needs x0,z0,x1,z1 in metres, of the picture's upper left and lower "
            "right corner, depth positive down: --corners 0,0,50000,15000",
            why));
    };
    if (c.size() != 4)
        refuse(c.empty() ? "are missing" : fmt::format("{} numbers", c.size()));
    for (const double value : c)
        if (!(std::abs(value) <= furthest))
            refuse(fmt::format("{:g} is no place in a section", value));
    const auto is_above = [](double low, double high) {
        return high - low > 1e-6 * std::max(std::abs(low), std::abs(high));
    };
    if (!is_above(c[0], c[2]))
        refuse(fmt::format("x1 = {:g} must be greater than x0 = {:g}", c[2], c[0]));
    if (!is_above(c[1], c[3]))
        refuse(fmt::format("z1 = {:g} must be greater than z0 = {:g}{}", c[3], c[1],
                           c[3] < 0.0 ? ", these are heights" : ""));
}

std::optional<Underlay> underlay_of(const UnderlayOptions& options) {
    if (options.image.empty() && options.corners.empty())
        return std::nullopt;
    std::error_code error;
    if (options.image.empty())
        throw UsageError("--corners: is of --underlay, which is not there");
    if (!std::filesystem::is_regular_file(options.image, error))
        throw UsageError(fmt::format("--underlay {}: {}", shown(options.image),
                                     std::filesystem::is_directory(options.image, error)
                                         ? "is a directory, needs a PNG or JPEG"
                                         : "no such file"));
    require_corners(options.corners);
    try {
        read_picture(options.image);
    } catch (const UsageError& problem) {
        throw UsageError(fmt::format("--underlay {}", problem.what()));
    }
    const std::vector<double>& c = options.corners;
    return Underlay{options.image, c[0], c[1], c[2], c[3]};
}

} // namespace listric
