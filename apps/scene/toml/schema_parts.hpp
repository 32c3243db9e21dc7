#pragma once

#include "apps/scene/parameters/parameter.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <string_view>
#include <vector>

// Parts that schemas of scenes, materials and plans are made of, from declarations of parameters.

namespace listric {

/// A table that has no other keys.
nlohmann::ordered_json closed_table(std::string_view doc, nlohmann::ordered_json properties,
                                    const std::vector<std::string>& required = {});

/// A table of declared parameters, with the defaults of the object.
nlohmann::ordered_json table_schema(std::string_view doc, const std::vector<Parameter>& parameters,
                                    const void* object);

/// Text of a document's schema, whose top is a table.
std::string finished_schema(const char* title, const nlohmann::ordered_json& schema);

} // namespace listric
