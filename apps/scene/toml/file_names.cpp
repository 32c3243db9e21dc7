#include "apps/scene/toml/file_names.hpp"

#include <algorithm>
#include <iterator>

namespace listric {

Parameter file_name(std::string_view key, std::string_view doc, std::string_view changes) {
    return {key, at<&FileName::file>, "", ranges::any, "", doc, changes};
}

std::vector<RockSource> rock_sources(EffectList effects) {
    std::vector<RockSource> sources{basement_source};
    for (const Effect* effect : effects)
        if (effect->rock &&
            std::ranges::find(sources, effect->rock->key, &RockSource::key) == sources.end())
            sources.push_back(*effect->rock);
    return sources;
}

std::vector<Parameter> rock_file_names(EffectList effects) {
    std::vector<Parameter> names;
    std::ranges::transform(
        rock_sources(effects), std::back_inserter(names),
        [](const RockSource& rock) { return file_name(rock.key, rock.doc, rock.changes); });
    return names;
}

std::vector<Parameter> file_names(const SceneTable& table) {
    std::vector<Parameter> names;
    if (!table.effect)
        return names;
    for (const FileParameter& file : table.effect->files)
        if (std::ranges::find(table.parameters, file.key, &Parameter::key) ==
            table.parameters.end())
            names.push_back(file_name(file.key, file.doc, file.changes));
    return names;
}

} // namespace listric
