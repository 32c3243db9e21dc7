// One parser of numbers for files, options and plans, and what it says of texts that are none.

#include "apps/support/words/number.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace listric::number_test {

namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Number, AsFilesWriteIt) {
    for (const auto& [text, value] :
         std::vector<std::pair<const char*, double>>{{"12", 12.0},
                                                     {"+80.31", 80.31},
                                                     {"-.5", -0.5},
                                                     {"5.", 5.0},
                                                     {" 7\t", 7.0},
                                                     {"1e3", 1000.0},
                                                     {"1E+3", 1000.0},
                                                     {"1.0D+03", 1000.0},
                                                     {"8.0311d-01", 0.80311},
                                                     {"1e-400", 0.0},
                                                     {"-0", -0.0},
                                                     {"+.5", 0.5}})
        EXPECT_EQ(parse_number(text), value) << text;
}

TEST(Number, WhatIsNone) {
    for (const char* text : {"", " ", "+", "-", "+-1", "++1", "nan", "-inf", "infinity", "0x10",
                             "1e400", "12 m", "1,5", "1 013", "1.0D", "1e", "deep", "12km", "1..2"})
        EXPECT_FALSE(parse_number(text)) << text;
    EXPECT_FALSE(parse_number(std::string(1 << 20, '1')));
    EXPECT_FALSE(parse_number(std::string("1\0002", 3)));
}

TEST(Number, IsToldForWhatItIs) {
    for (const auto& [text, said] : std::vector<std::pair<const char*, const char*>>{
             {"1012,75", "a decimal comma; write 1012.75"},
             {"-100,5", "write -100.5"},
             {"1,013", "write 1.013 or 1013"},
             {"1,234,567.5", "commas between thousands; write 1234567.5"},
             {"1.234.567", "write 1234567"},
             {"1.013,75", "write 1013.75"},
             {"1 013,5", "write 1013.5"},
             {"1\u00a0013", "write 1013"},
             {"1'013", "write 1013"},
             {"1\u2019013", "write 1013"},
             {"12 m", "a number and m"},
             {"12.5km", "a number and km"},
             {"45\u00b0", "a number and \u00b0"},
             {"\u221212", "write -12"},
             {"nan", "no value"},
             {"N/A", "no value"},
             {"#N/A", "no value"},
             {"-", "no value"},
             {"-inf", "infinity"},
             {"#REF!", "spreadsheet"},
             {"####", "spreadsheet"},
             {"*****", "Fortran"},
             {"1.013+103", "without its letter"},
             {"0x10", "hexadecimal"},
             {"1e400", "too large"},
             {"1.0D+400", "too large"},
             {"", "empty"},
             {"12.03.2024", "a date"}})
        EXPECT_THAT(number_objection(text), HasSubstr(said)) << text;
    EXPECT_EQ(number_objection("deep"), "");
    EXPECT_EQ(no_number("deep"), "\"deep\" is not a finite number");
    EXPECT_EQ(no_number("1,5"), "\"1,5\" is not a finite number: a decimal comma; write 1.5");
    EXPECT_EQ(no_number("a\x1b[31m"), "\"a\\x1b[31m\" is not a finite number");
    EXPECT_LT(no_number(std::string(100'000, '1')).size(), 120u);
    EXPECT_LT(no_number(std::string(100'000, ',')).size(), 120u);
}

TEST(Number, LengthsHaveTheirUnit) {
    EXPECT_EQ(read_length("5km").metres, 5e3);
    EXPECT_EQ(read_length(" 500 m").metres, 500.0);
    for (const char* nought : {"0", "0m", "0.0km"})
        EXPECT_EQ(read_length(nought).objection, "") << nought;
    for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
             {"5", "a length needs its unit: 5km or 5m"},
             {"5000", "5000km or 5000m"},
             {"2k", "with its unit, such as 5km or 500m; this is a number and k"},
             {"5 miles", "such as 5km"},
             {"-5km", "at least 0"},
             {"1e9km", "at least 0"},
             {"5,5km", "a decimal comma; write 5.5"},
             {"", "empty"},
             {"km", "empty"}})
        EXPECT_THAT(read_length(text).objection, HasSubstr(said)) << text;
    EXPECT_THAT(read_length("2k").objection, Not(HasSubstr("unit of the name")));
}

} // namespace

} // namespace listric::number_test
