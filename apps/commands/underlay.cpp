#include "apps/commands/underlay.hpp"

#include "apps/support/error.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace listric {

void add_underlay(CLI::App& command, UnderlayOptions& options) {
    command.add_option("--underlay", options.image,
                       "PNG of a section, over which the model's lines are drawn");
    command
        .add_option("--corners", options.corners,
                    "x0,z0,x1,z1: its upper left and lower right corner in the section, m")
        ->delimiter(',');
}

std::optional<Underlay> underlay_of(const UnderlayOptions& options) {
    if (options.image.empty() && options.corners.empty())
        return std::nullopt;
    std::error_code error;
    if (options.image.empty())
        throw UsageError("--corners: is of --underlay, which is not there");
    if (!std::filesystem::is_regular_file(options.image, error))
        throw UsageError(fmt::format("--underlay {}: no such file", options.image));
    const std::vector<double>& c = options.corners;
    if (c.size() != 4 || !(c[0] < c[2]) || !(c[1] < c[3]))
        throw UsageError("--corners: needs x0,z0,x1,z1 in metres, of the picture's upper left and "
                         "lower right corner, depth positive down: --corners 0,0,50000,15000");
    return Underlay{options.image, c[0], c[1], c[2], c[3]};
}

} // namespace listric
