#include "apps/scene/toml/differences.hpp"

#include "apps/scene/toml/tables.hpp"
#include "apps/scene/toml/toml.hpp"
#include "apps/support/words/number.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric {

namespace {

/// Two numbers with the digits that tell them apart, six at least.
void shorten(std::string& first, std::string& second) {
    constexpr int fewest = 6, most = 17;
    const auto a = parse_number(first), b = parse_number(second);
    if (!a || !b || (first + second).find('.') == std::string::npos) // whole numbers are exact
        return;
    for (int count = fewest; count < most; ++count) {
        const auto rounded = [&](double value) {
            return text(*parse_number(fmt::format("{:.{}g}", value, count)));
        };
        if (rounded(*a) == rounded(*b))
            continue;
        first = rounded(*a);
        second = rounded(*b);
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
