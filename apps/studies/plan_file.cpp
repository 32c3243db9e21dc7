#include "apps/studies/plan_file.hpp"

#include "apps/scene/shelf.hpp"
#include "apps/support/spelling.hpp"
#include "apps/support/text.hpp"

#include <fmt/format.h>

#include <iterator>
#include <sstream>

namespace listric {

toml::table study_plan(const std::string& name) {
    constexpr Shelf shelf{"study's plan", "it needs what is varied", "", "studies"};
    return shelf.read(shelf.find(name));
}

std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
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
