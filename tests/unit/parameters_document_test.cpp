// docs/parameters.md and the schemas are what the program says of its parameters.

#include "apps/archive/dictionary.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/schema.hpp"
#include "apps/studies/flexure_plan.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace listric {
namespace {

std::string contents(const char* file) {
    std::ifstream in(std::string(LISTRIC_SOURCE_DIR "/") + file);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ParametersDocument, IsCurrent) {
    const std::string document = contents("docs/parameters.md");
    const std::size_t begin = document.find("```\n"), end = document.rfind("```\n");
    ASSERT_LT(begin, end) << "docs/parameters.md has no block of parameters";
    EXPECT_EQ(document.substr(begin + 4, end - begin - 4),
              parameter_reference(program_effects()) + flexure_reference())
        << "make it anew: docs/parameters.sh";
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
} // namespace listric
