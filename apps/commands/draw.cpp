#include "apps/commands/command.hpp"
#include "apps/commands/underlay.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/drawing_page.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>

namespace listric {

namespace fs = std::filesystem;

namespace {

struct DrawCall {
    std::string scene = "lis1";
    std::string over;
    std::vector<double> corners;
    fs::path file;
    int threads = all_threads();
};

/// Refuses to write over a file that is no page of this call's.
void require_own_or_none(const fs::path& file) {
    std::error_code error;
    const auto status = fs::symlink_status(file, error);
    if (!fs::exists(status))
        return;
    if (fs::is_regular_file(status) && read_text_if_there(file).starts_with(drawing_page_begins))
        return;
    throw UsageError(fmt::format("{}: exists and is no page that draw wrote; give another name "
                                 "with --output",
                                 shown(file.string())));
}

std::optional<UnderPicture> picture_of(const DrawCall& call) {
    if (call.over.empty() && call.corners.empty())
        return std::nullopt;
    if (call.over.empty())
        throw UsageError("--corners: is of --over, which is not there");
    UnderPicture picture{call.over, std::nullopt};
    if (!call.corners.empty()) {
        require_corners(call.corners);
        std::array<double, 4> corners{};
        std::ranges::copy(call.corners, corners.begin());
        picture.corners = corners;
    }
    return picture;
}

ExitCode draw(const DrawCall& call) {
    const fs::path file = call.file.empty()
                              ? fs::path(fs::path(call.scene).stem().string() + "-drawing.html")
                              : call.file;
    require_own_or_none(file);
    const auto picture = picture_of(call);
    write_text(file, drawing_html(call.scene, picture, call.threads, program_effects()));
    std::cout << file.string() << '\n';
    return ExitCode::done;
}

} // namespace

Command add_draw(CLI::App& program) {
    const auto call = std::make_shared<DrawCall>();
    CLI::App* command = add_call(
        program, {"Run",
                  "draw",
                  "write a page in which a section is drawn in a browser",
                  "docs/start/drawing.md",
                  {{{"draw", "write lis1-drawing.html, which begins with lis1"},
                    {"draw my.toml --over section.png", "your own scene over a picture of it"},
                    {"draw rfr -o ramps.html", "two ramps to begin with"}}}});
    command->add_option("SCENE", call->scene, "scene with which to begin, by name or file")
        ->type_name("SCENE")
        ->default_str(call->scene);
    command
        ->add_option("--over", call->over,
                     "PNG or JPEG of a section, put into the page under the drawing")
        ->type_name("FILE")
        ->default_str("none");
    add_numbers(*command, "--corners", call->corners,
                "upper left and lower right corner of the picture in the section, m: x0,z0,x1,z1")
        ->default_str("none; two points of the picture are set in the page");
    command->add_option("-o,--output", call->file, "file of the page")
        ->type_name("FILE")
        ->default_str("SCENE-drawing.html");
    add_threads(*command, call->threads);
    return {command, [call] { return draw(*call); }};
}

} // namespace listric
