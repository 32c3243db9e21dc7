// The schemas and the dictionary, of which docs/parameters.sh makes the reference pages, are
// current.

#include "apps/archive/dictionary.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/schema.hpp"
#include "apps/studies/flexure_plan.hpp"
#include "tests/places.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace listric::parameters_document_test {
namespace {

std::string contents(const char* file) {
    std::ifstream in(std::string(source_folder) + "/" + file);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ParametersDocument, SchemasAreCurrent) {
    EXPECT_EQ(contents("apps/scene.schema.json"), scene_schema(program_effects()))
        << "make it anew: docs/parameters.sh";
    EXPECT_EQ(contents("apps/material.schema.json"), material_schema())
        << "make it anew: docs/parameters.sh";
}

TEST(ParametersDocument, DictionaryIsCurrent) {
    EXPECT_EQ(contents("apps/python/listric/dictionary.json"),
              archive::dictionary_json(program_effects()).dump(1) + "\n")
        << "make it anew: docs/parameters.sh";
}

} // namespace
} // namespace listric::parameters_document_test
