#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/reservations.hpp"
#include "apps/commands/command.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/works.hpp"
#include "apps/support/error.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// The program that made a run, and the effects that were on.
struct Origin {
    std::string version, commit; ///< commit: may be empty
    std::vector<std::string> effects = {};
    std::vector<std::string> earlier_versions = {}; ///< that made a part of the run
};

Origin program_origin() {
    const std::size_t plus = version.find('+');
    return {std::string(version.substr(0, plus)),
            plus == version.npos ? "" : std::string(version.substr(plus + 1))};
}

/// Throws UsageError, SceneError.
Origin origin_of(const fs::path& output) {
    const fs::path scene = output / "scene.toml";
    if (!fs::exists(scene))
        throw UsageError(
            fmt::format("{}: is no folder of a run, which has scene.toml", shown(output.string())));
    const JsonObject made = object_at(object_in(output / "summary.json"), "provenance");
    if (made.empty())
        throw UsageError(fmt::format("{}: the run has not ended: summary.json, which has the "
                                     "version, is missing or damaged; run --resume goes on",
                                     shown(output.string())));
    archive::warn_of(output, archive::reservations(output, false));
    return {text_at(made, "version"), text_at(made, "commit"),
            effect_names(load_scene({.scene = scene.string(), .is_record = true})),
            texts_at(made, "earlier_versions")};
}

struct Citation {
    const Work* work;
    std::string behind;
};

/// Each work once, with the effects that it is behind.
std::vector<Citation> citations(const std::vector<std::string>& effects) {
    std::vector<Citation> all{{&works::seyferth_henk, "the method"}};
    for (const std::string& effect : effects)
        for (const Work* work : works_behind(effect)) {
            const auto known = std::ranges::find(all, work, &Citation::work);
            if (known == all.end())
                all.push_back({work, effect});
            else
                known->behind += ", " + effect;
        }
    return all;
}

std::string record_of(const Origin& origin) {
    const auto all = citations(origin.effects);
    const std::string commit =
        origin.commit.empty() ? "" : fmt::format(" (commit {})", origin.commit);
    std::string text = fmt::format(
        "Listric: a numerical sandbox for halfgrabens, version {}{}{}\n", origin.version, commit,
        origin.earlier_versions.empty()
            ? ""
            : fmt::format("; begun by {}", fmt::join(origin.earlier_versions, ", ")));
    for (const Citation& citation : all)
        text += fmt::format("{}: {}\n", citation.work->name, citation.behind);
    text += fmt::format(
        "\n@software{{listric,\n"
        "  author  = {{{{The Listric developers}}}},\n"
        "  title   = {{Listric: a numerical sandbox for halfgrabens}},\n"
        "  version = {{{}}},\n"
        "{}"
        "  license = {{Apache-2.0}},\n"
        "}}\n",
        origin.version,
        origin.commit.empty() ? "" : fmt::format("  note    = {{Commit {}}},\n", origin.commit));
    for (const Citation& citation : all)
        text += fmt::format("\n{}\n", citation.work->bibtex);
    return text;
}

} // namespace

Command add_cite(CLI::App& program) {
    const auto output = std::make_shared<std::string>();
    CLI::App* command =
        add_call(program, {"Look",
                           "cite",
                           "print what a paper about a run should cite",
                           "docs/reference/citing.md",
                           {{{"cite out/lis1", "program and works behind the effects of a run"},
                             {"cite out/lis1 > run.bib", "BibTeX, after lines that it ignores"},
                             {"cite", "this program and the method"}}}});
    command->add_option("DIR", *output, "folder of a finished run")
        ->type_name("DIR")
        ->default_str("this program alone");
    return {command, [output] {
                std::cout << shown_lines(
                    record_of(output->empty() ? program_origin() : origin_of(*output)));
                return ExitCode::done;
            }};
}

} // namespace listric
