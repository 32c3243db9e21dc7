#include "apps/archive/folder/provenance.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/reservations.hpp"
#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/archive/tables/headline.hpp"
#include "apps/commands/command.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/toml/differences.hpp"
#include "apps/support/error.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// A scene, or a run with its scene and what it has found.
struct Side {
    std::string name;
    Scene scene;
    fs::path run;       ///< its folder; empty: a scene
    JsonObject summary; ///< empty: no finished run
};

/// A folder without a run gives way to a scene of its name, as in every call that takes scenes.
Side read_side(const std::string& name) {
    const fs::path scene = fs::path(name) / "scene.toml";
    if (fs::exists(scene))
        return {name, load_scene({.scene = scene.string(), .is_record = true}), name,
                object_in(fs::path(name) / "summary.json")};
    const auto shipped = list_scenes();
    const auto is_name = [&](const auto& one) { return one.first == name; };
    if (fs::is_directory(name) && std::ranges::none_of(shipped, is_name))
        throw UsageError(
            fmt::format("{}: is no folder of a run, which has scene.toml", shown(name)));
    return {name, load_scene({.scene = name}), {}, {}};
}

struct Row {
    std::string what, first, second, unit;
};

/// Lines of a table; nothing without rows.
std::string table_text(const char* heading, const std::vector<Row>& rows) {
    std::size_t what = std::string_view(heading).size(), first = 1, second = 1;
    for (const Row& row : rows) {
        what = std::max(what, row.what.size());
        first = std::max(first, row.first.size());
        second = std::max(second, row.second.size());
    }
    std::string text;
    for (const Row& row : rows) {
        if (text.empty())
            text = fmt::format("\n{:<{}}  {:<{}}  {}\n", heading, what, "A", first, "B");
        std::string line = fmt::format("{:<{}}  {:<{}}  {:<{}}  {}", row.what, what, row.first,
                                       first, row.second, second, row.unit);
        text += line.erase(line.find_last_not_of(' ') + 1) + '\n';
    }
    return text;
}

/// A value in one line of a readable length.
std::string short_value(std::string value) {
    constexpr std::size_t longest = 40;
    std::ranges::replace(value, '\n', ' ');
    for (std::size_t at; (at = value.find("  ")) != value.npos;)
        value.erase(at, 1);
    if (value.size() > longest)
        value = value.substr(0, longest - 3) + "...";
    return value.empty() ? "-" : value;
}

std::vector<Row> parameter_rows(const Side& a, const Side& b) {
    std::vector<Row> rows;
    for (const SceneDifference& one : scene_differences(a.scene, b.scene, program_effects())) {
        Row row{one.path, short_value(one.first), short_value(one.second), one.unit};
        if (row.first == row.second) // long lists that differ beyond what is shown
            row.second = "another one";
        rows.push_back(row);
    }
    return rows;
}

/// Versions that made a run, by its summary or else by its newest snapshot.
std::string makers_of(const Side& side) {
    return side.summary.empty()
               ? fmt::format("{}", fmt::join(archive::run_moments(side.run).makers, ", "))
               : archive::makers_of(side.summary);
}

std::vector<Row> program_rows(const Side& a, const Side& b) {
    const std::string first = makers_of(a), second = makers_of(b);
    return first == second ? std::vector<Row>{}
                           : std::vector<Row>{{"made by", first.empty() ? "unknown" : first,
                                               second.empty() ? "unknown" : second, ""}};
}

std::vector<Row> result_rows(const JsonObject& a, const JsonObject& b) {
    const auto text = [](const std::optional<double>& value) {
        return value ? fmt::format("{:.5g}", *value) : "-";
    };
    std::vector<Row> rows;
    const auto first = archive::headline_of(a), second = archive::headline_of(b);
    for (std::size_t k = 0; k < first.size(); ++k)
        if (first[k].value != second[k].value)
            rows.push_back(
                {first[k].key, text(first[k].value), text(second[k].value), first[k].unit});
    if (text_at(a, "state_hash") != text_at(b, "state_hash"))
        rows.push_back({"state_hash", text_at(a, "state_hash"), text_at(b, "state_hash"), ""});
    return rows;
}

/// Name and hash of the newest state of a run; nothing where it has none that can be read, which is
/// said.
std::optional<std::pair<std::string, std::string>> newest_state(const Side& side) {
    try {
        const auto snapshots = archive::list_snapshots(side.run);
        if (!snapshots.empty())
            return std::pair(snapshots.back().stem().string(),
                             fmt::format("{:016x}", archive::run_hash(
                                                        archive::read_snapshot(snapshots.back()))));
        warn(fmt::format("{} has neither summary.json nor a snapshot: nothing of its results is "
                         "compared",
                         shown(side.name)));
    } catch (const StorageError& error) {
        warn(fmt::format("nothing of the results is compared: {}", error.what()));
    }
    return std::nullopt;
}

/// Rows of runs of which one or both have no readable summary: their newest states.
/// @param looked  whether there were two to compare
std::vector<Row> state_rows(const Side& a, const Side& b, bool& looked) {
    warn("the newest snapshots are compared");
    const auto first = newest_state(a), second = newest_state(b);
    looked = first && second;
    std::vector<Row> rows;
    if (looked && first->first != second->first)
        rows.push_back({"newest snapshot", first->first, second->first, ""});
    if (looked && first->second != second->second)
        rows.push_back({"state_hash", first->second, second->second, ""});
    return rows;
}

ExitCode compare(const std::string& first, const std::string& second) {
    const Side a = read_side(first), b = read_side(second);
    bool looked = true;
    std::string text = table_text("parameter", parameter_rows(a, b));
    for (const Side* side : {&a, &b})
        if (!side->run.empty())
            archive::warn_of(side->name, archive::reservations(side->run, false));
    if (!a.run.empty() && !b.run.empty())
        text += table_text("program", program_rows(a, b));
    if (!a.summary.empty() && !b.summary.empty())
        text += table_text("result", result_rows(a.summary, b.summary));
    else if (!a.run.empty() && !b.run.empty())
        text += table_text("result", state_rows(a, b, looked));
    else if (a.run.empty() != b.run.empty())
        warn(fmt::format("{} is a scene: only parameters are compared",
                         shown((a.run.empty() ? a : b).name)));
    if (text.empty())
        return looked ? ExitCode::done : ExitCode::differs;
    std::cout << shown_lines(fmt::format("A: {}\nB: {}\n{}", a.name, b.name, text));
    return ExitCode::differs;
}

} // namespace

Command add_diff(CLI::App& program) {
    struct Call {
        std::string first, second;
    };
    const auto call = std::make_shared<Call>();
    CLI::App* command =
        add_call(program, {"Look",
                           "diff",
                           "show what differs between two runs or scenes",
                           "docs/reference/commands.md",
                           {{{"diff out/lis1 out/lis1-second", "parameters, program and results"},
                             {"diff lis1 my.toml", "parameters of two scenes"},
                             {"diff lis1 out/lis1", "parameters that a run's options changed"}}}});
    command->add_option("A", call->first, "a scene, by name or file, or the folder of a run")
        ->type_name("SCENE")
        ->required();
    command
        ->add_option("B", call->second,
                     "another one; the exit code is 0 if nothing differs, else 1")
        ->type_name("SCENE")
        ->required();
    return {command, [call] { return compare(call->first, call->second); }};
}

} // namespace listric
