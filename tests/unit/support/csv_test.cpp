// Tables as spreadsheets, Fortran, old Macs and people write them.

#include "apps/support/error.hpp"
#include "apps/support/files/csv.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace listric::csv_test {

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Csv : public testing::Test {
protected:
    fs::path folder = fs::path(testing::TempDir()) / fmt::format("listric-csv-{}", getpid());
    fs::path file = folder / "t.csv";
    CsvColumns picks{.words = "name", .numbers = {"x_m", "depth_m"}, .optional = {"age_a"}};
    CsvColumns fault{.numbers = {"x_m", "depth_m"}};

    Csv() { fs::create_directories(folder); }
    ~Csv() override { fs::remove_all(folder); }

    CsvRows rows(const std::string& text, const CsvColumns& columns) const {
        std::ofstream(file, std::ios::binary) << text;
        return read_csv(file, columns);
    }
    /// Message about a file, without its folder; one line, not long.
    std::string refusal(const std::string& text, const CsvColumns& columns) const {
        try {
            rows(text, columns);
        } catch (const SceneError& error) {
            std::string said = error.what();
            EXPECT_LT(said.size(), 700u) << said.substr(0, 1000);
            for (const char letter : said)
                EXPECT_FALSE(static_cast<unsigned char>(letter) < ' ') << said;
            const auto at = said.find("t.csv");
            return at == said.npos ? said : said.substr(at);
        }
        return "accepted";
    }
    std::string refusal(const std::string& text) const { return refusal(text, fault); }
};

TEST_F(Csv, CellsInQuotes) {
    const CsvRows all = rows("name,\"x_m\",depth_m,note\n"
                             "\"Top, of \"\"Trias\"\"\",\"1\",2,\"# no, comment\nsecond line\"\n"
                             "# a comment, with \" in it\n"
                             "\n"
                             "\"two\nlines\" , 3,\"4\",\n",
                             picks);
    EXPECT_THAT(all.words, ElementsAre("Top, of \"Trias\"", "two lines"));
    EXPECT_THAT(all.columns[0], ElementsAre(1.0, 3.0));
    EXPECT_THAT(all.columns[1], ElementsAre(2.0, 4.0));
    EXPECT_THAT(all.line, ElementsAre(2u, 6u));
    EXPECT_EQ(rows("x_m,depth_m\n0,0\n\"1\",\"2\"", fault).size(), 2u);
}

TEST_F(Csv, LineEndsOfAllSystems) {
    for (const char* end : {"\n", "\r\n", "\r", "\r\r\n"}) {
        const std::string text =
            fmt::format("# made by hand{0}x_m,depth_m{0}{0}0,0{0}1,2{0}3,a{0}", end);
        EXPECT_THAT(refusal(text), StartsWith("t.csv:6: depth_m: \"a\""))
            << ::testing::PrintToString(end);
    }
    EXPECT_EQ(rows("\xef\xbb\xbfx_m,depth_m\r\n0,0\r\n1,2", fault).size(), 2u);
    // Lines within quotes count.
    EXPECT_THAT(refusal("note,x_m,depth_m\n\"a\nb\r\nc\",0,0\n,1,b\n"),
                StartsWith("t.csv:5: depth_m"));
}

TEST_F(Csv, DelimitersByTheHeader) {
    for (const char* text :
         {"x_m;depth_m\n1;2\n", "x_m\tdepth_m\n1\t2\n", "x_m depth_m\n1 2\n",
          "  x_m     depth_m  \n  1.0     2.0  \n", "x_m \t depth_m\n1\t2\n",
          "sep=;\nx_m;depth_m\n1;2\n", "x_m depth_m note\n1 2 \"two words\"\n",
          "\"x_m\";\"depth_m\"\n\"1\";\"2\"\n", "x_m,depth_m,,\n1,2,,,\n,,,\n"}) {
        const CsvRows all = rows(text, fault);
        EXPECT_THAT(all.columns[0], ElementsAre(1.0)) << text;
        EXPECT_THAT(all.columns[1], ElementsAre(2.0)) << text;
    }
    fault.delimiter = ",";
    EXPECT_THAT(refusal("x_m;depth_m\n1;2\n"),
                HasSubstr("seem to be parted by ;; give csv_delimiter = \";\""));
    EXPECT_TRUE(csv_has_column(file, "depth_m"));
    EXPECT_FALSE(csv_has_column(file, "depth"));
}

TEST_F(Csv, CellsThatAreNoNumbers) {
    EXPECT_THAT(
        refusal("x_m,depth_m\n0,0\n\"500,50\",\"1012,75\"\n"),
        StartsWith("t.csv:3: x_m: \"500,50\" is not a finite number: a decimal comma; write "
                   "500.50"));
    EXPECT_THAT(refusal("x_m;depth_m\n0;0\n500,50;1\n"), HasSubstr("a decimal comma"));
    EXPECT_THAT(refusal("x_m,depth_m\n\"1,013\",0\n"), HasSubstr("write 1.013 or 1013"));
    EXPECT_THAT(refusal("x_m,depth_m\n12 m,0\n"), HasSubstr("a number and m"));
    EXPECT_THAT(refusal("x_m,depth_m\n1,\n"), StartsWith("t.csv:2: depth_m: \"\""));
    EXPECT_THAT(refusal("x_m,depth_m\n1\n"), StartsWith("t.csv:2: depth_m: \"\""));
    EXPECT_THAT(refusal("x_m,depth_m\nnan,0\n"), HasSubstr("no value"));
    EXPECT_THAT(rows("x_m,depth_m\n+0.00,1.0D+03\n", fault).columns[1], ElementsAre(1000.0));
}

TEST_F(Csv, OptionalCells) {
    const CsvRows all = rows("name,x_m,depth_m,age_a\na,1,2,\nb,1,2,5\nc,1,2\n", picks);
    EXPECT_TRUE(std::isnan(all.columns[2][0]));
    EXPECT_EQ(all.columns[2][1], 5.0);
    EXPECT_TRUE(std::isnan(all.columns[2][2]));
    EXPECT_TRUE(std::isnan(rows("name,x_m,depth_m\na,1,2\n", picks).columns[2][0]));
    EXPECT_THAT(refusal("name,x_m,depth_m,age_a\na,1,2,old\n", picks),
                StartsWith("t.csv:2: age_a"));
}

TEST_F(Csv, RowsThatDoNotFit) {
    EXPECT_THAT(refusal("name,x_m,depth_m\na,1,2\nTrias,500,50,1012,75\n", picks),
                StartsWith("t.csv:3: has 5 cells, but the header 3"));
    EXPECT_THAT(refusal("x_m,depth_m\n0,0\n\"1,2\n3,4\n"),
                AllOf(StartsWith("t.csv:3:"), HasSubstr("not closed")));
    EXPECT_THAT(refusal("x_m,depth_m\n0,0\n\"1,2\n\"3,4\n"),
                AllOf(StartsWith("t.csv:3:"), HasSubstr("line 4")));
    EXPECT_THAT(refusal("x_m,depth_m,note\n0,0,5\" pipe\n"),
                AllOf(StartsWith("t.csv:2:"), HasSubstr("quote")));
    EXPECT_THAT(refusal("x_m,depth_m\n\"0\"1,2\n"),
                AllOf(StartsWith("t.csv:2:"), HasSubstr("quote")));
    EXPECT_THAT(refusal("x_m,depth_m\n0,0\n\"" + std::string(3 << 20, 'a')),
                StartsWith("t.csv:3:"));
    EXPECT_THAT(refusal(std::string(3 << 20, 'a')), HasSubstr("more than 1 MB"));
    EXPECT_THAT(refusal("x_m,depth_m\n0,0" + std::string(20'000, ',') + "\n"),
                HasSubstr("more than 10000 cells"));
}

TEST_F(Csv, HeadersThatAreNearlyRight) {
    const auto said = [&](const std::string& header) { return refusal(header + "\n1,2\n"); };
    EXPECT_THAT(said("x_m,depth_km"), HasSubstr("depth_km is in another unit (1 km = 1000 m"));
    EXPECT_THAT(said("x_m,Depth [km]"), HasSubstr("Depth [km] is in another unit"));
    EXPECT_THAT(said("x_m,depth"), HasSubstr("call depth depth_m"));
    EXPECT_THAT(said("x,depth_m"), HasSubstr("call x x_m"));
    EXPECT_THAT(said("X_M,depth_m"), HasSubstr("did you mean x_m by \"X_M\""));
    EXPECT_THAT(said("x m,depth_m"), HasSubstr("did you mean x_m by \"x m\""));
    EXPECT_THAT(said("x_m,depht_m"), HasSubstr("did you mean depth_m by \"depht_m\""));
    EXPECT_THAT(said("x_m,z_m"), HasSubstr("positive down"));
    EXPECT_THAT(said("x_m,x_m,depth_m"), HasSubstr("t.csv:1: has two columns x_m"));
    EXPECT_THAT(refusal("0,0\n1,2\n"), HasSubstr("put a line with the names, x_m,depth_m, above"));
    EXPECT_THAT(refusal("#x_m,depth_m\n0,0\n1,2\n"), HasSubstr("behind a #"));
    EXPECT_THAT(refusal("x_m,\x1b]0;title\x07\x1b[31m\n1,2\n"), HasSubstr("\\x1b]0;title"));
    EXPECT_THAT(refusal("My fault\r\n\r\nx_m,depth_m\r\n0,0\r\n"),
                HasSubstr("line 3 seems to have them, put a # before"));
    EXPECT_THAT(refusal("# only\n"), HasSubstr("has no header, needs x_m, depth_m"));
    EXPECT_THAT(refusal(std::string(500'000, 'x') + "\n"), Not(HasSubstr("accepted")));
}

TEST_F(Csv, OtherFormats) {
    std::string wide = "\xff\xfe";
    for (const char letter : std::string("x_m,depth_m\r\n0,0\r\n"))
        wide += {letter, '\0'};
    EXPECT_THAT(refusal(wide), HasSubstr("is UTF-16; save it as CSV UTF-8"));
    EXPECT_THAT(refusal(wide.substr(2)), HasSubstr("is UTF-16"));
    EXPECT_THAT(refusal("PK\x03\x04 and so on"), HasSubstr("workbook"));
    EXPECT_THAT(
        refusal("name,x_m,depth_m\nTop,1,2\nH\xf6he,1,2\n", picks),
        AllOf(StartsWith("t.csv:3:"), HasSubstr("\\xf6"), HasSubstr("save the file as CSV UTF-8")));
    EXPECT_THAT(refusal(std::string("x_m,depth_m\r1,2\r3,\0\r", 20)),
                AllOf(StartsWith("t.csv:3:"), HasSubstr("\\x00")));
    EXPECT_THAT(refusal("name,x_m,depth_m\na\x1b[2J,1,2\n", picks),
                AllOf(StartsWith("t.csv:2: name: "), HasSubstr("control character")));
}

TEST_F(Csv, FilesThatAreNone) {
    EXPECT_THAT(refusal(""), StartsWith("t.csv: has no header"));
    EXPECT_THAT(refusal("x_m,depth_m\n"), StartsWith("t.csv: has no rows"));
    fs::remove(file);
    ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
    for (const fs::path& path : {file, folder, fs::path("/dev/zero")})
        try {
            read_csv(path, fault);
            ADD_FAILURE() << path;
        } catch (const SceneError& error) {
            EXPECT_THAT(error.what(), HasSubstr("no regular file"));
        }
    fs::remove(file);
    EXPECT_THROW(read_csv(file, fault), SceneError);
}

} // namespace

} // namespace listric::csv_test
