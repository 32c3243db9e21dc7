#include "apps/commands/command.hpp"
#include "apps/commands/underlay.hpp"
#include "apps/figures/draw_run.hpp"
#include "apps/figures/picture_order.hpp"
#include "apps/support/error.hpp"
#include "apps/support/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
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
    UnderlayOptions underlay;
    std::vector<double> extensions; ///< m
    std::vector<double> wells;      ///< x, m
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
    if (call.animation && !call.extensions.empty())
        throw UsageError("--at: an animation has all snapshots");
    if (call.animation && !call.wells.empty())
        throw UsageError("--well: is not drawn in an animation");
}

} // namespace

Command add_figures(CLI::App& program) {
    const auto call = std::make_shared<FiguresCall>();
    CLI::App* command =
        add_call(program, {"Look",
                           "figures",
                           "draw the figures of a run",
                           "docs/figures.md",
                           {{{"figures out/lis1", "all figures as PNG"},
                             {"figures out/lis1 --format pdf,svg", "figures for print"},
                             {"figures out/lis1 --animation", "a film of all snapshots"}}}});
    command->add_option("DIR", call->folder, "folder of a run")->type_name("DIR")->required();
    command->add_flag("--animation", call->animation,
                      "make a film of all snapshots instead of the figures");
    add_underlay(*command, call->underlay);
    add_numbers(*command, "--at", call->extensions,
                "extensions of snapshots whose sections are drawn, m, with commas between")
        ->default_str("the scene's output.figures_at_m, and the end");
    add_numbers(*command, "--well", call->wells,
                "distances from the breakaway, m, of wells whose figure alone is drawn")
        ->default_str("the depocentre and its flank, beside all figures");
    command
        ->add_option("--format", call->formats,
                     "png, pdf or svg, or several: png,pdf; discs are an image in all of them")
        ->type_name("FORMAT")
        ->default_str("png")
        ->delimiter(',');
    return {command, [call] {
                const std::optional<Underlay> underlay = underlay_of(call->underlay);
                if (underlay && call->animation)
                    throw UsageError("--underlay: is not drawn in an animation");
                require_formats(*call);
                call->animation ? animate_run(call->folder)
                                : draw_run(call->folder, underlay, call->formats, call->extensions,
                                           call->wells);
                return ExitCode::done;
            }};
}

} // namespace listric
