// How deep a text of TOML is nested, found before tables are made of it.

#include "apps/scene/toml/toml.hpp"
#include "apps/scene/toml/toml_slips.hpp"
#include "apps/support/error.hpp"
#include "tests/message_of.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace listric::toml_depth_test {

namespace {

using testing::HasSubstr;

std::string repeated(const std::string& piece, int times) {
    std::string text;
    for (int k = 0; k < times; ++k)
        text += piece;
    return text;
}

std::string refusal(const std::string& text) {
    return support::message_of<SceneError>([&] { parse(text, "a.toml"); }, "");
}

TEST(TomlDepth, DeepTextIsRefusedWithItsLine) {
    constexpr int deep = 300'000; // toml++ ends in a crash
    const std::string dots = repeated("a.", deep) + "a";
    for (const std::string& text :
         {dots + " = 1", "[" + dots + "]", "[[" + dots + "]]", "x = {" + dots + " = 1}",
          "x = " + repeated("[", deep), "x = " + repeated("{a=", deep),
          repeated("a . ", deep) + "a = 1", repeated("\"a\".", deep) + "a = 1",
          repeated("'.'.", deep) + "a = 1", repeated("[\n", deep),
          "[a]\nb = [" + repeated("{a.b=[", deep)})
        EXPECT_THAT(refusal("\n" + text), HasSubstr("nested too deep, allowed: 32"))
            << text.substr(0, 20);
    EXPECT_THAT(refusal("\n\n[" + dots + "]"), HasSubstr("a.toml:3: "));
    EXPECT_THAT(refusal("s = \"\"\"\n\n\"\"\"\n[" + dots + "]"), HasSubstr("a.toml:4: "));
}

TEST(TomlDepth, AnAssignmentIsRefusedWithItsBeginning) {
    toml::table document;
    const std::string assignment = repeated("a.", 60'000) + "a=1";
    try {
        set(document, assignment, "--set " + assignment);
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_THAT(error.what(), HasSubstr("--set a.a."));
        EXPECT_LT(std::string(error.what()).size(), 300u);
    }
}

TEST(TomlDepth, TextWithManyDotsIsNoDeepText) {
    const std::string numbers = repeated("[1.5, -2.25e-3],\n", 1000);
    EXPECT_EQ(refusal("target = [\n" + numbers + "]"), "");
    for (const std::string& text :
         {"# " + repeated("a.", 1000), "s = \"" + repeated("a.[{", 1000) + "\"",
          "s = '" + repeated("a.[{\"", 1000) + "'", "s = \"\\\"" + repeated("a.", 1000) + "\"",
          "s = \"\"\"" + repeated("a.[\n\"\" ", 1000) + "\"\"\"\"\"",
          "s = '''" + repeated("a.[\n'' ", 1000) + "'''"})
        EXPECT_EQ(refusal("a.b.c = 1\n" + text + "\nx = [[[1.0]]]"), "") << text.substr(0, 20);
}

TEST(TomlDepth, WhatIsNoTomlIsLeftToTheParser) {
    for (const std::string text :
         {"a = \"", "a = '''", "a = \"\\", "'", "]]]]", "a = }", "\"\"\"", ""})
        EXPECT_EQ(too_deep_line(text), std::nullopt) << text;
}

} // namespace

} // namespace listric::toml_depth_test
