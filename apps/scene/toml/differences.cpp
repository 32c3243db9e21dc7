#include "apps/scene/toml/differences.hpp"

#include "apps/scene/toml/tables.hpp"
#include "apps/scene/toml/toml.hpp"
#include "apps/support/words/number.hpp"
#include "apps/support/words/pattern.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace listric {

namespace {

/// A value as a scene writes it, with numbers of so many digits; words stay.
std::string rounded(const std::string& value, int digits) {
    if (value.find('"') != std::string::npos)
        return value;
    std::string shown;
    std::size_t from = 0; // whole numbers are exact
    for (const auto& [begin, size] : find_all(value, R"(-?[0-9]+\.[0-9]+([eE][-+]?[0-9]+)?)")) {
        shown.append(value, from, begin - from);
        const double number = parse_number(value.substr(begin, size)).value_or(0.0);
        shown += text(*parse_number(fmt::format("{:.{}g}", number, digits)));
        from = begin + size;
    }
    return shown.append(value, from);
}

/// Two values with the digits that tell them apart, six at least.
void shorten(std::string& first, std::string& second) {
    constexpr int fewest = 6, most = 17;
    for (int digits = fewest; digits < most; ++digits)
        if (std::string a = rounded(first, digits), b = rounded(second, digits); a != b) {
            first = std::move(a);
            second = std::move(b);
            return;
        }
}

void compare(const std::string& before, const std::vector<Parameter>& parameters, const void* first,
             const void* second, std::vector<SceneDifference>& found) {
    for (const Parameter& parameter : parameters) {
        std::string a = value_text(parameter, first), b = value_text(parameter, second);
        if (a == b)
            continue;
        shorten(a, b);
        found.push_back(
            {fmt::format("{}{}", before, parameter.key), std::string(parameter.unit), a, b});
    }
}

} // namespace

std::vector<SceneDifference> scene_differences(const Scene& first, const Scene& second,
                                               EffectList effects) {
    std::vector<SceneDifference> found;
    std::vector<Parameter> top = top_level();
    std::erase_if(top,
                  [](const Parameter& p) { return p.key == "name" || p.key == "description"; });
    compare("", top, &first, &second, found);
    for (const SceneTable& table : scene_tables(effects)) {
        const std::size_t a = table.count(first), b = table.count(second);
        for (std::size_t item = 0; item < std::max(a, b); ++item)
            if (item < std::min(a, b))
                compare(table.path(item) + ".", table.parameters, table.item(first, item),
                        table.item(second, item), found);
            else
                found.push_back(
                    {table.path(item), "", item < a ? "on" : "off", item < b ? "on" : "off"});
    }
    return found;
}

} // namespace listric
