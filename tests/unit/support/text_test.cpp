#include "apps/support/words/text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace listric::text_test {
namespace {

TEST(Text, is_sound_where_it_is_utf8) {
    for (const std::string text : {"", "Trias", "H\xc3\xb6he", "\xe2\x82\xac", "\xf0\x9f\x8f\x94",
                                   "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"})
        EXPECT_FALSE(unsound_byte(text)) << shown(text);
}

TEST(Text, tells_the_first_byte_that_is_none) {
    EXPECT_EQ(unsound_byte("H\xf6he"), 1u);          // Windows-1252
    EXPECT_EQ(unsound_byte("ab\xc0\xaf"), 2u);       // overlong
    EXPECT_EQ(unsound_byte("\xe0\x80\x80"), 0u);     // overlong
    EXPECT_EQ(unsound_byte("\xed\xa0\x80"), 0u);     // surrogate
    EXPECT_EQ(unsound_byte("\xf4\x90\x80\x80"), 0u); // above 10FFFF
    EXPECT_EQ(unsound_byte("\xe2\x82"), 0u);         // cut short
    EXPECT_EQ(unsound_byte("a\x80"), 1u);
    EXPECT_EQ(unsound_byte(std::string("a\0b", 3)), 1u);
}

TEST(Text, is_shown_without_what_a_terminal_obeys) {
    EXPECT_EQ(shown("H\xc3\xb6he 10 %"), "H\xc3\xb6he 10 %");
    EXPECT_EQ(shown("\x1b[31mred"), "\\x1b[31mred");
    EXPECT_EQ(shown("H\xf6he"), "H\\xf6he");
    EXPECT_EQ(shown("a\xc2\x9b"
                    "b"),
              "a\\xc2\\x9bb");
    EXPECT_EQ(shown("one\ntwo"), "one\\x0atwo");
}

TEST(Text, is_cut_to_the_columns_of_a_terminal) {
    EXPECT_EQ(cut_to("genesis 12 %", 12), "genesis 12 %");
    EXPECT_EQ(cut_to("genesis 12 %", 11), "genesis ...");
    EXPECT_EQ(cut_to("genesis", 3), "gen");
    EXPECT_EQ(cut_to("genesis", 0), "");
    EXPECT_EQ(cut_to("H\xc3\xb6he", 4), "H\xc3\xb6he");                           // a column each
    EXPECT_EQ(cut_to("\xe5\xb1\xb1\xe5\xb1\xb1", 4), "\xe5\xb1\xb1\xe5\xb1\xb1"); // two
    EXPECT_EQ(cut_to("\xe5\xb1\xb1\xe5\xb1\xb1", 3), "\xe5\xb1\xb1");
    EXPECT_EQ(cut_to("\xf0\x9f\x8f\x94", 1), "");
    EXPECT_EQ(cut_to("e\xcc\x81t\xc3\xa9", 3),
              "e\xcc\x81t\xc3\xa9"); // an accent of its own has none
}

TEST(Text, LinesKeepTheirEnds) {
    EXPECT_EQ(shown_lines("a\nb\x1b\n"), "a\nb\\x1b\n");
    EXPECT_EQ(shown_lines(""), "");
    EXPECT_EQ(shown_lines("\n"), "\n");
}

TEST(Text, NamesOfOneFolder) {
    for (const std::string name : {"lis1", "Höhe (2), Süd", ".hidden", "...", "-rf", "a\\b", " "})
        EXPECT_EQ(objection_to_name(name), "") << name;
    EXPECT_EQ(objection_to_name(std::string(200, 'x')), "");
    for (const std::string& name :
         {std::string(), std::string("."), std::string(".."), std::string("a/b"), std::string("/"),
          std::string("a\0b", 3), std::string("a\nb"), std::string("\x1b[m"), std::string("\xe4"),
          std::string("\xc2\x85"), std::string(201, 'x')})
        EXPECT_NE(objection_to_name(name), "") << name;
}

TEST(Text, LongTextsThatDifferAreShownWhereTheyPart) {
    EXPECT_EQ(shown_apart("0.5", "0.7"), std::pair(std::string("0.5"), std::string("0.7")));
    const std::string same(3000, 'a');
    const auto [one, other] = shown_apart(same + "1, 2", same + "3");
    EXPECT_EQ(one, "..." + std::string(20, 'a') + "1, 2");
    EXPECT_EQ(other, "..." + std::string(20, 'a') + "3");
    EXPECT_LT(shown_apart(same, "").first.size(), 70u);
    EXPECT_EQ(shown_apart(same, same).first, "..." + std::string(20, 'a'));
}

} // namespace
} // namespace listric::text_test
