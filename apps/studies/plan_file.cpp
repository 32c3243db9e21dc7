#include "apps/studies/plan_file.hpp"

#include "apps/support/spelling.hpp"
#include "apps/support/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <sstream>

namespace listric {

std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

void read_values(const Entry& entry, const std::vector<Parameter>& parameters, void* object,
                 const std::vector<std::string_view>& elsewhere) {
    std::vector<std::string_view> allowed = keys(parameters);
    allowed.insert(allowed.end(), elsewhere.begin(), elsewhere.end());
    for (const auto& [key, node] : *entry.node.as_table()) {
        const std::string path = entry.path.empty() ? std::string(key.str())
                                                    : fmt::format("{}.{}", entry.path, key.str());
        if (std::ranges::find(allowed, key.str()) == allowed.end())
            fail({node, path}, fmt::format("unknown key, {}", advice(key.str(), allowed)));
        const auto parameter = std::ranges::find(parameters, key.str(), &Parameter::key);
        if (parameter != parameters.end())
            read({node, path}, *parameter, object);
    }
}

void need(const Entry& entry, const char* key, bool present) {
    if (!present)
        fail(entry, fmt::format("needs {}", key));
}

void need_name(const Entry& entry, const char* key, const std::string& name) {
    need(entry, key, !name.empty());
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

} // namespace listric
