#include "apps/scene/differences.hpp"

#include "apps/scene/tables.hpp"
#include "apps/scene/toml.hpp"

#include <fmt/format.h>

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
        const void *a = table.find(table, first), *b = table.find(table, second);
        if (a && b)
            compare(fmt::format("{}.", table.name), table.parameters, a, b, found);
        else if (a || b)
            found.push_back({std::string(table.name), "", a ? "on" : "off", b ? "on" : "off"});
    }
    return found;
}

} // namespace listric
