#include "apps/archive/json_file.hpp"

#include "apps/support/error.hpp"

#include <fstream>

namespace listric {

nlohmann::json read_json(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in)
        throw StorageError(file.string() + ": cannot be read");
    nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
    if (json.is_discarded())
        throw StorageError(file.string() + ": damaged, not JSON");
    return json;
}

} // namespace listric
