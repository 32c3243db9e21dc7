#include "apps/archive/folder/scene_lines.hpp"

#include "apps/model/effects.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/scene/toml/toml.hpp"

#include <fmt/format.h>

#include <sstream>

namespace listric::archive {

namespace {

/// A line of TOML without its comment and the blanks before it.
std::string_view without_comment(std::string_view line) {
    char quote = 0;
    for (std::size_t k = 0; k < line.size(); ++k) {
        const char c = line[k];
        if (quote == '"' && c == '\\')
            ++k;
        else if (quote)
            quote = c == quote ? 0 : quote;
        else if (c == '"' || c == '\'')
            quote = c;
        else if (c == '#') {
            line = line.substr(0, k);
            break;
        }
    }
    return line.substr(0, line.find_last_not_of(' ') + 1);
}

/// Defaults of all parameters of all tables, as scene_values() has them, and of former keys what is
/// done without them.
const std::map<std::string, std::string>& default_values() {
    static const auto values = [] {
        Scene scene;
        for (const SceneTable& table : scene_tables(program_effects()))
            table.add(table, scene);
        auto all = scene_values(to_toml(scene));
        for (const Effect* effect : program_effects())
            for (const FormerKey& former : effect->former)
                if (!former.stays.empty())
                    all[fmt::format("{}.{}", effect->name, former.key)] =
                        quoted(std::string(former.stays));
        return all;
    }();
    return values;
}

/// Value of a parameter; its default where the table is there without it, as in scenes that an
/// earlier program wrote: a new parameter's default is what was done before there was one.
std::string value_in(const std::map<std::string, std::string>& values,
                     const std::string& parameter) {
    if (const auto found = values.find(parameter); found != values.end())
        return found->second;
    const std::string table = parameter.substr(0, parameter.rfind('.'));
    if (!values.contains("[" + table + "]"))
        return "nothing";
    // Defaults of every table [[name]] are those of the first.
    const std::size_t item = table.find('.');
    const auto found = default_values().find(
        item == table.npos ? parameter
                           : table.substr(0, item) + ".0" + parameter.substr(table.size()));
    return found != default_values().end() ? found->second : "nothing";
}

} // namespace

namespace {

/// Whether a line of a scene is nothing of the run, but of what is shown of it.
bool is_of_looks(std::string_view line) {
    return line.starts_with("report = ") || line.starts_with("picture = ") ||
           line.starts_with("corners_m = ");
}

} // namespace

std::vector<std::string> scene_lines(std::string_view text) {
    std::vector<std::string> lines;
    std::istringstream in{std::string(text)};
    for (std::string line; std::getline(in, line);)
        if (const std::string_view said = without_comment(line);
            !said.empty() && !is_of_looks(said))
            lines.emplace_back(said);
    return lines;
}

std::map<std::string, std::string> scene_values(std::string_view text) {
    std::map<std::string, std::string> values;
    std::string table;
    std::map<std::string, int> items; // tables [[name]] so far
    std::string* last = nullptr;
    for (const std::string& line : scene_lines(text)) {
        const std::size_t equals = line.find(" = ");
        if (line.starts_with('[') && line.ends_with(']') && line.find(',') == line.npos) {
            table = line.substr(1, line.size() - 2);
            if (table.starts_with('[')) {
                table = table.substr(1, table.size() - 2);
                table += fmt::format(".{}", items[table]++);
            }
            last = nullptr;
            values["[" + table + "]"] = "a table";
            table += ".";
        } else if (equals != line.npos && line.front() != ' ' && line.front() != '{') {
            last = &values[table + line.substr(0, equals)];
            *last = line.substr(equals + 3);
        } else if (last) { // a value of several lines
            *last += " " + line;
        }
    }
    return values;
}

std::optional<LineDifference> scene_difference(const std::map<std::string, std::string>& one,
                                               const std::map<std::string, std::string>& other,
                                               SceneScope scope) {
    const auto is_compared = [&](const std::string& parameter) {
        return scope == SceneScope::all || parameter == "output.interval_m" ||
               !(parameter == "name" || parameter == "description" ||
                 parameter.starts_with("output."));
    };
    for (const auto& [parameter, value] : one)
        if (is_compared(parameter) && value_in(other, parameter) != value)
            return LineDifference{parameter, value, value_in(other, parameter)};
    for (const auto& [parameter, value] : other)
        if (is_compared(parameter) && value_in(one, parameter) != value)
            return LineDifference{parameter, value_in(one, parameter), value};
    return std::nullopt;
}

} // namespace listric::archive
