#include "apps/archive/folder/output_folder.hpp"
#include "apps/archive/quality.hpp"
#include "apps/archive/reservations.hpp"
#include "apps/archive/tables/headline.hpp"
#include "apps/commands/command.hpp"
#include "apps/figures/report_run.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/process.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sys/stat.h>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// A finished run, for its card.
struct Card { // NOLINT(bugprone-exception-escape): JSON that is moved does not throw
    fs::path run;
    std::time_t when = 0; ///< it was finished
    JsonObject summary;
};

/// Runs in a folder and in the folders in it.
struct Runs {
    std::vector<Card> finished;      ///< newest first
    std::vector<std::string> others; ///< that have not ended, or whose summary is damaged
};

Runs runs_in(const fs::path& folder) {
    constexpr int deepest = 2; // runs of sweeps and validations
    Runs runs;
    const auto options = fs::directory_options::skip_permission_denied;
    std::error_code error; // of an entry of somebody else's, which is passed over
    for (auto at = fs::recursive_directory_iterator(folder, options, error);
         !error && at != end(at); at.increment(error)) {
        if (at.depth() >= deepest)
            at.disable_recursion_pending();
        struct stat facts {};
        const fs::path summary = at->path() / "summary.json";
        std::error_code of_entry;
        if (!at->is_directory(of_entry) || !fs::exists(at->path() / "scene.toml", of_entry))
            continue;
        at.disable_recursion_pending();
        JsonObject found = object_in(summary);
        if (is_true_at(found, "finished") && stat(summary.c_str(), &facts) == 0)
            runs.finished.push_back({at->path(), facts.st_mtime, std::move(found)});
        else
            runs.others.push_back(at->path().lexically_normal().string());
    }
    std::ranges::sort(runs.finished, std::greater{}, &Card::when);
    std::ranges::sort(runs.others);
    return runs;
}

std::string html(const std::string& text) {
    std::string out;
    for (const char letter : shown(text))
        out += letter == '<'   ? "&lt;"
               : letter == '&' ? "&amp;"
               : letter == '"' ? "&quot;"
                               : std::string(1, letter);
    return out;
}

/// A file beside the page or below its folder, as a link has it.
std::string link_to(const fs::path& file, const fs::path& page) {
    std::string link;
    for (const unsigned char letter : fs::relative(file, page.parent_path()).generic_string())
        if (std::isalnum(letter) ||
            std::string_view("/._-~").find(letter) != std::string_view::npos)
            link += static_cast<char>(letter);
        else
            link += fmt::format("%{:02X}", letter);
    return link;
}

/// The run's last picture of strata; empty: there is none.
std::string picture_of(const fs::path& run, const fs::path& page) {
    fs::path newest;
    fs::file_time_type newest_time;
    std::error_code error;
    for (const auto& file : fs::directory_iterator(run / "figures", error)) {
        std::error_code vanished; // or a link that leads nowhere
        const fs::file_time_type time = file.last_write_time(vanished);
        if (!vanished && file.path().filename().string().starts_with("strata-") &&
            file.path().extension() == ".png" && (newest.empty() || time > newest_time)) {
            newest = file.path();
            newest_time = time;
        }
    }
    return newest.empty() ? ""
                          : fmt::format("<img alt=\"strata\" loading=\"lazy\" src=\"{}\">",
                                        link_to(newest, page));
}

/// Whether the run is good by its own numbers, in words; empty: not known.
std::string quality_html(const Card& card) {
    try {
        const Scene scene =
            load_scene({.scene = (card.run / "scene.toml").string()}, program_effects());
        const auto checks =
            archive::quality_checks(card.summary, {.base_moves = make_parts(scene).base_moves});
        std::vector<std::string> why;
        for (const archive::QualityCheck& check : checks)
            if (check.verdict == archive::QualityVerdict::doubtful)
                why.push_back(check.brief);
        const char* const verdict = archive::name_of(archive::verdict_of(checks));
        return fmt::format("<p class={0}><b>{0}</b>{1}{2}</p>", verdict, why.empty() ? "" : ": ",
                           html(fmt::format("{}", fmt::join(why, ", "))));
    } catch (const std::exception&) { // a card shows what there is
        return "";
    }
}

std::string card_html(const Card& card, const fs::path& page) {
    const fs::path report = card.run / "report.html";
    std::string rows;
    for (const archive::Headline& one : archive::headline_of(card.summary))
        if (one.value)
            rows += fmt::format("<tr><td title=\"{}\">{}<td>{}", html(one.key), html(one.name),
                                html(archive::value_text(one)));
    std::string doubts;
    for (const std::string& one : archive::reservations(card.run))
        doubts += "<p>" + html(one);
    if (fs::exists(report) && !archive::is_up_to_date(report, card.run))
        doubts += "<p>the report is older than the run: listric view makes it again";
    const std::string name = html(card.run.lexically_normal().string());
    return fmt::format(
        "<article>{}<h2>{}</h2><p>{}, {}, seed {}; {:%Y-%m-%d %H:%M}</p>{}<table>{}</table>{}"
        "</article>\n",
        picture_of(card.run, page),
        fs::exists(report) ? fmt::format("<a href=\"{}\">{}</a>", link_to(report, page), name)
                           : name,
        html(text_at(card.summary, "scene")), html(text_at(card.summary, "accuracy")),
        html(whole_number_at(card.summary, "seed").value_or("unknown")), fmt::localtime(card.when),
        quality_html(card), rows, doubts);
}

/// Writes a page of cards, whose pictures and links are files of the runs. Returns the file.
fs::path write_cards(const fs::path& folder) {
    constexpr std::size_t most = 200;
    if (!fs::is_directory(folder))
        throw UsageError(fmt::format("there is no folder {} here; listric run makes it",
                                     shown(folder.string())));
    auto [cards, others] = runs_in(folder);
    const std::string unfinished =
        others.empty() ? ""
                       : fmt::format("not shown, as they have not ended or have no readable "
                                     "summary.json: {}; listric run --resume goes on",
                                     shown_start(fmt::format("{}", fmt::join(others, ", ")), 1000));
    if (cards.empty())
        throw UsageError(fmt::format("{} has no finished run{}{}", shown(folder.string()),
                                     unfinished.empty() ? "" : "; ", unfinished));
    if (!unfinished.empty())
        warn(unfinished);
    const std::size_t all = cards.size();
    cards.resize(std::min(all, most));
    const fs::path page = folder / "index.html";
    const archive::OwnFile written[]{{page, "<title>Runs in "}};
    archive::require_own(written, {});
    std::string text = fmt::format(R"(<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Runs in {0}</title>
<style>
:root {{ color-scheme: light dark; --edge: #ccc; --page: #fff; --ink: #222; --link: #05c; --good: #1d6b35; --bad: #9c1c1c }}
@media (prefers-color-scheme: dark) {{ :root {{ --edge: #444; --page: #181818; --ink: #ddd; --link: #8bf;
  --good: #7fd097; --bad: #ff9c8f }} }}
body {{ font: 15px/1.4 sans-serif; background: var(--page); color: var(--ink); margin: 1rem }}
main {{ display: grid; gap: 1rem; grid-template-columns: repeat(auto-fill, minmax(min(100%, 22rem), 1fr)) }}
article {{ border: 1px solid var(--edge); border-radius: 6px; padding: .8rem; overflow: hidden }}
img {{ width: 100%; background: #fff; border-radius: 3px }}
h2 {{ font-size: 1.05rem; margin: .4rem 0 0; overflow-wrap: anywhere }}
p {{ margin: .1rem 0 .4rem }}
.good b {{ color: var(--good) }}
.doubtful {{ color: var(--bad) }}
.note {{ display: none }}
a {{ color: var(--link) }}
table {{ width: 100%; border-collapse: collapse; font-size: .9em }}
td {{ border-top: 1px solid var(--edge); padding: .1rem 0 }}
td + td {{ text-align: right; white-space: nowrap }}
</style>
<h1>Runs in {0}</h1>
<p>{1} of {2} finished runs, newest first. A name leads to the report.</p>
<p>{3}</p>
<main>
)",
                                   html(folder.string()), cards.size(), all, html(unfinished));
    for (const Card& card : cards)
        text += card_html(card, page);
    write_text(page, text + "</main>\n");
    return page;
}

/// The report of a run, made if it is not there, or shows less than the run has come to.
fs::path report_of(const fs::path& run) {
    const fs::path page = run / "report.html";
    if (archive::is_up_to_date(page, run)) {
        archive::warn_of(run, archive::reservations(run));
        return page;
    }
    for (const std::string& lack : report_run({.outputs = {run}}).lacks)
        warn("the page is not whole: " + lack);
    return page;
}

/// Shows a page in the user's browser, where there is a display.
void open_page(const fs::path& page) {
    const auto has = [](const char* name) {
        const char* value = std::getenv(name);
        return value && *value;
    };
    std::cout << page.string() << std::endl;
    if (has("DISPLAY") || has("WAYLAND_DISPLAY"))
        run_silently({"xdg-open", fs::absolute(page).string()});
}

} // namespace

Command add_view(CLI::App& program) {
    const auto run = std::make_shared<std::string>();
    CLI::App* command =
        add_call(program, {"Look",
                           "view",
                           "open the report of a run, or cards of all runs",
                           "docs/guides/report.md",
                           {{{"view out/lis1", "the report of a run, made if it is missing"},
                             {"view", "a page of cards of the runs in out"},
                             {"report out/lis1", "write the report again"}}}});
    command
        ->add_option("DIR", *run,
                     "folder of a run; without a display the call prints only the page's path")
        ->type_name("DIR")
        ->default_str("cards of out");
    return {command, [run] {
                open_page(run->empty() ? write_cards("out") : report_of(*run));
                return ExitCode::done;
            }};
}

} // namespace listric
