#include "apps/scene/differences.hpp"

#include "apps/scene/tables.hpp"
#include "apps/scene/toml.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric {

namespace {

void compare(const std::string& before, const std::vector<Parameter>& parameters, const void* first,
             const void* second, std::vector<SceneDifference>& found) {
    for (const Parameter& parameter : parameters) {
        const std::string a = value_text(parameter, first), b = value_text(parameter, second);
        if (a != b)
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
