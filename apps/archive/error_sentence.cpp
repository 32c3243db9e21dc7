#include "apps/archive/error_sentence.hpp"

#include "apps/archive/folder/known_errors.hpp"
#include "apps/archive/tables/dictionary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <utility>
#include <vector>

namespace listric::archive {

std::string error_sentence(const JsonObject& summary) {
    const auto list = summary.find(std::string(known_errors_quantity.name));
    if (list == summary.end() || !list->is_array() || list->empty())
        return "";
    std::vector<std::string> parts, none;
    for (const JsonObject& one : *list) {
        const std::string key = text_at(one, "measure"), label(label_of(key));
        std::vector<std::string> known;
        for (const auto& [name, words] :
             {std::pair("resolution", "resolution"), std::pair("speed", "speed"),
              std::pair("spread", "seeds ±")})
            if (const auto value = number_at(one, name))
                known.push_back(fmt::format("{} {}", words, error_text(key, *value)));
        if (known.empty())
            none.push_back(label);
        else
            parts.push_back(fmt::format("{}: {}{}", label, fmt::join(known, ", "),
                                        known.size() < 3 ? ", else unknown" : ""));
    }
    if (parts.empty())
        return "Errors: unknown; no recorded runs are like this one.";
    if (!none.empty())
        parts.push_back(fmt::format("unknown: {}", fmt::join(none, ", ")));
    return fmt::format("Errors by recorded runs: {}.", fmt::join(parts, "; "));
}

} // namespace listric::archive
