#include "apps/studies/plan_file.hpp"

#include "apps/archive/tables/dictionary.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/toml/document.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <set>
#include <system_error>
#include <utility>

namespace listric {

toml::table study_plan(const std::string& name) {
    constexpr Shelf shelf{"study's plan", "it needs what is varied", "", "studies"};
    return read_document(shelf, shelf.find(name));
}

std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> all;
    std::string word;
    int depth = 0;
    char quote = 0, before = ' ';
    const auto end = [&] {
        if (!word.empty())
            all.push_back(std::move(word));
        word.clear();
    };
    for (const char letter : text) {
        const bool may_begin = std::string_view(" =[{,").find(before) != std::string_view::npos;
        if (quote != 0)
            quote = letter == quote ? 0 : quote;
        else if ((letter == '"' || letter == '\'') && may_begin)
            quote = letter;
        else if (letter == '[' || letter == '{')
            ++depth;
        else if (letter == ']' || letter == '}')
            --depth;
        before = letter;
        if (quote == 0 && depth <= 0 && std::isspace(static_cast<unsigned char>(letter)) != 0)
            end();
        else
            word += letter;
    }
    end();
    return all;
}

std::optional<std::vector<int>> seed_list(std::string_view text) {
    constexpr int largest_seed = 1'000'000'000;
    constexpr std::size_t most_seeds = 1000;
    std::set<int> seeds;
    const auto number = [](std::string_view digits) -> std::optional<int> {
        int value = -1;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), value);
        const bool whole = error == std::errc{} && end == digits.data() + digits.size();
        return whole && value >= 0 && value <= largest_seed ? std::optional(value) : std::nullopt;
    };
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        const std::string_view part = text.substr(from, comma - from);
        const std::size_t dash = part.find('-');
        const auto first = number(part.substr(0, dash));
        const auto last = dash == part.npos ? first : number(part.substr(dash + 1));
        if (!first || !last || *last < *first ||
            static_cast<std::size_t>(*last - *first) >= most_seeds)
            return std::nullopt;
        for (int seed = *first; seed <= *last; ++seed)
            seeds.insert(seed);
        from = comma + 1;
    }
    if (seeds.size() > most_seeds)
        return std::nullopt;
    return std::vector<int>(seeds.begin(), seeds.end());
}

Parameter plan_key(std::string_view key, Value value, std::string_view doc, Range range,
                   std::string_view unit) {
    return {key, std::move(value), unit, range, "", doc};
}

void need_keys(const Entry& entry, const std::vector<const char*>& keys) {
    for (const char* key : keys) {
        const toml::node* const node = entry.node.as_table()->get(key);
        const auto* const list = node ? node->as_array() : nullptr;
        need(entry, key,
             node && node->value_or(std::string("a")) != "" && !(list && list->empty()));
    }
}

void need(const Entry& entry, const char* key, bool present) {
    if (!present)
        fail(entry, fmt::format("needs {}", key));
}

void need_name(const Entry& entry, const char* key, const std::string& name) {
    std::string why = objection_to_name(name);
    if (why.empty() && name.find_first_of(",\"") != name.npos)
        why = "has a comma or a quotation mark, which does not fit into a table";
    if (why.empty())
        return;
    const toml::node* node = entry.node.as_table()->get(key);
    fail({node ? *node : entry.node, entry.path.empty() ? key : entry.path + "." + key},
         fmt::format("\"{}\" {}, allowed: the name of one file or folder", name, why));
}

std::vector<Entry> tables(const Entry& parent, const char* key) {
    std::vector<Entry> all;
    const toml::node* node = parent.node.as_table()->get(key);
    if (!node)
        return all;
    const std::string path = parent.path.empty() ? key : parent.path + "." + key;
    if (!node->is_array_of_tables())
        fail_type({*node, path}, fmt::format("tables [[{}]]", path));
    for (const toml::node& item : *node->as_array())
        all.push_back({item, fmt::format("{}[{}]", path, all.size())});
    return all;
}

nlohmann::ordered_json array_of(std::string_view doc, nlohmann::ordered_json items) {
    return {{"type", "array"}, {"description", doc}, {"items", std::move(items)}};
}

nlohmann::ordered_json measure_schema(MeasuredAt place) {
    using Json = nlohmann::ordered_json;
    Json at_end = Json::array(), at_moments = Json::array();
    std::string pattern;
    for (const archive::DictionaryEntry& entry : archive::dictionary(program_effects())) {
        if (entry.at_end)
            at_end.push_back(entry.quantity.name);
        if (entry.at_moments) {
            at_moments.push_back(entry.quantity.name);
            pattern += fmt::format("{}{}", pattern.empty() ? "" : "|", entry.quantity.name);
        }
    }
    if (place == MeasuredAt::any_snapshot)
        return {{"type", "string"}, {"enum", at_moments}};
    return {
        {"type", "string"},
        {"anyOf",
         {{{"enum", at_end}}, {{"pattern", fmt::format("^({})@[0-9.eE+-]+(k?m)?$", pattern)}}}}};
}

} // namespace listric
