#include "apps/commands/command.hpp"
#include "apps/commands/underlay.hpp"
#include "apps/figures/draw_run.hpp"
#include "apps/figures/picture_order.hpp"
#include "apps/studies/ensemble/ensemble.hpp"
#include "apps/support/error.hpp"
#include "apps/support/words/number.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

namespace {

struct FiguresCall {
    FiguresRequest request;
    bool animation = false;
    UnderlayOptions underlay;
    std::vector<std::string> formats; ///< none: png, or the best film
    std::string width;
};

template <std::size_t Count>
void require_formats(const std::vector<std::string>& formats,
                     const std::string_view (&all)[Count]) {
    const std::vector<std::string_view> known(std::begin(all), std::end(all));
    for (const std::string& format : formats)
        if (std::ranges::find(known, format) == known.end())
            throw UsageError(
                fmt::format("--format: no format {}; {}", format, advice(format, known)));
}

/// "85mm" in millimetres.
double parse_width(std::string_view text) {
    constexpr double least = 40.0, most = 500.0;
    const bool has_unit = text.ends_with("mm");
    const double width =
        has_unit ? parse_number(text.substr(0, text.size() - 2)).value_or(NAN) : NAN;
    if (!(width >= least && width <= most))
        throw UsageError(fmt::format("--width {}: a width from {:g}mm to {:g}mm; a column has "
                                     "85mm, a page 180mm",
                                     text, least, most));
    return width;
}

void require_sense(const FiguresCall& call) {
    if (!call.animation)
        return;
    require_formats(call.formats, film_formats);
    if (call.formats.size() > 1)
        throw UsageError("--format: an animation has one format");
    if (!call.request.extensions.empty())
        throw UsageError("--at: an animation has all snapshots");
    if (!call.request.wells.empty())
        throw UsageError("--well: is not drawn in an animation");
    if (!call.underlay.image.empty())
        throw UsageError("--underlay: is not drawn in an animation");
    const PictureOrder& order = call.request.order;
    if (!call.width.empty() || !order.only.empty() || order.plain || order.dpi > 0.0)
        throw UsageError("--animation: has no --width, --only, --plain and --dpi");
}

} // namespace

Command add_figures(CLI::App& program) {
    const auto call = std::make_shared<FiguresCall>();
    FiguresRequest& request = call->request;
    CLI::App* command =
        add_call(program, {"Look",
                           "figures",
                           "draw the figures of a run",
                           "docs/guides/figures.md",
                           {{{"figures out/lis1 --format pdf,svg", "figures for print"},
                             {"figures out/lis1 --width 85mm --at 5km", "one for a column"},
                             {"figures out/lis1 --animation", "a film of all snapshots"}}}});
    command
        ->add_option("DIR", request.output,
                     "folder of a run, or of many: then of all seeds on one section")
        ->type_name("DIR")
        ->required();
    add_output(*command, request.pictures, "DIR/figures", "folder of the pictures");
    command->add_flag("--animation", call->animation,
                      "make a film of all snapshots instead of the figures");
    add_underlay(*command, call->underlay);
    add_lengths(
        *command, "--at", request.extensions,
        "extensions of snapshots whose sections are drawn, such as 5km, with commas between")
        ->default_str("the scene's output.figures_at_m, and the end");
    add_lengths(*command, "--well", request.wells,
                "distances from the breakaway, such as 3.3km, of wells whose figure alone is drawn")
        ->default_str("the depocentre and its flank, beside all figures");
    command
        ->add_option("--width", call->width,
                     "width of a figure for print, such as 85mm or 180mm: panels below each "
                     "other, letters, text of 8 points")
        ->type_name("WIDTH")
        ->default_str("pages for a screen");
    command
        ->add_option("--only", request.order.only,
                     fmt::format("panels, with commas between: {}, layer-NAME",
                                 fmt::join(panel_names, ", ")))
        ->type_name("PANELS")
        ->default_str("all but seismic; for print strata,strain")
        ->delimiter(',');
    command->add_flag("--plain", request.order.plain, "draw no headline and no small print");
    add_number(*command, "--dpi", request.order.dpi, "resolution of pictures, dots per inch")
        ->check(CLI::Range(30.0, 2400.0).description(""))
        ->default_str("150; for print 300");
    command
        ->add_option("--format", call->formats,
                     "png, pdf or svg, or several: png,pdf; discs are an image in all of them; of "
                     "an animation mp4, gif or webp")
        ->type_name("FORMAT")
        ->default_str("png; of an animation mp4 with ffmpeg, else gif")
        ->delimiter(',');
    return {command, [call] {
                FiguresRequest wanted = call->request;
                require_sense(*call);
                if (holds_runs(wanted.output)) {
                    for (const auto& file : draw_ensembles(wanted.output, false))
                        std::cout << file.string() << '\n';
                    return ExitCode::done;
                }
                wanted.underlay = underlay_of(call->underlay, {wanted.output});
                if (!call->animation)
                    require_formats(call->formats, picture_formats);
                if (!call->formats.empty())
                    wanted.order.formats = call->formats;
                if (!call->width.empty())
                    wanted.order.width_mm = parse_width(call->width);
                wanted.order.caption = true;
                const auto files = call->animation
                                       ? animate_run(wanted.output, call->formats, wanted.pictures)
                                       : draw_run(wanted);
                for (const auto& file : files)
                    std::cout << file.string() << '\n';
                return ExitCode::done;
            }};
}

} // namespace listric
