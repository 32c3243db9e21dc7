#include "apps/commands/command.hpp"
#include "apps/figures/draw_run.hpp"
#include "apps/figures/picture_order.hpp"
#include "apps/run/run.hpp"
#include "apps/support/error.hpp"
#include "apps/support/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

namespace {

struct FiguresCall {
    std::string folder;
    bool animation = false;
    std::string underlay;
    std::vector<double> corners; ///< x0, depth0, x1, depth1, m
    std::vector<std::string> formats{"png"};
};

void require_formats(const FiguresCall& call) {
    const std::vector<std::string_view> known(std::begin(picture_formats),
                                              std::end(picture_formats));
    for (const std::string& format : call.formats)
        if (std::ranges::find(known, format) == known.end())
            throw UsageError(
                fmt::format("--format: no format {}; {}", format, advice(format, known)));
    if (call.animation && call.formats != std::vector<std::string>{"png"})
        throw UsageError("--format: is not of an animation, which is a film");
}

std::optional<Underlay> underlay_of(const FiguresCall& call) {
    if (call.underlay.empty() && call.corners.empty())
        return std::nullopt;
    std::error_code error;
    if (call.underlay.empty())
        throw UsageError("--corners: is of --underlay, which is not there");
    if (!std::filesystem::is_regular_file(call.underlay, error))
        throw UsageError(fmt::format("--underlay {}: no such file", call.underlay));
    const std::vector<double>& c = call.corners;
    if (c.size() != 4 || !(c[0] < c[2]) || !(c[1] < c[3]))
        throw UsageError("--corners: needs x0,z0,x1,z1 in metres, of the picture's upper left and "
                         "lower right corner, depth positive down: --corners 0,0,50000,15000");
    return Underlay{call.underlay, c[0], c[1], c[2], c[3]};
}

} // namespace

Command add_figures(CLI::App& program) {
    const auto call = std::make_shared<FiguresCall>();
    CLI::App* command = program.add_subcommand("figures", "Draw the figures of a run");
    command->add_option("DIR", call->folder, "The run's output folder")->required();
    command->add_flag("--animation", call->animation,
                      "An animation of all snapshots instead of the figures");
    command->add_option("--underlay", call->underlay,
                        "PNG of a section, over which the model's lines are drawn");
    command
        ->add_option("--corners", call->corners,
                     "x0,z0,x1,z1: its upper left and lower right corner in the section, m")
        ->delimiter(',');
    command
        ->add_option("--format", call->formats,
                     "png, pdf, svg, or several: png,pdf; discs are an image in all of them")
        ->delimiter(',')
        ->capture_default_str();
    return {command, [call] {
                const std::optional<Underlay> underlay = underlay_of(*call);
                if (underlay && call->animation)
                    throw UsageError("--underlay: is not drawn in an animation");
                require_formats(*call);
                call->animation ? animate_run(call->folder)
                                : draw_run(call->folder, underlay, call->formats);
                return ExitCode::done;
            }};
}

} // namespace listric
