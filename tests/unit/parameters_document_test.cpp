// docs/parameters.md is what the program says of its parameters.

#include "apps/model/effects.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace listric {
namespace {

TEST(ParametersDocument, IsCurrent) {
    std::ifstream in(LISTRIC_SOURCE_DIR "/docs/parameters.md");
    const std::string document(std::istreambuf_iterator<char>(in), {});
    const std::size_t begin = document.find("```\n"), end = document.rfind("```\n");
    ASSERT_LT(begin, end) << "docs/parameters.md has no block of parameters";
    EXPECT_EQ(document.substr(begin + 4, end - begin - 4), parameter_reference(program_effects()))
        << "make it anew: docs/parameters.sh";
}

} // namespace
} // namespace listric
