// Files that are written and read where somebody else's lie, and what is said where that fails.

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/snapshot/hdf5_table.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/files/npy.hpp"
#include "tests/message_of.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace listric::file_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

/// Message of the StorageError that a call throws.
template <class Call> std::string refusal(Call&& call) {
    return support::message_of<StorageError>(call, "nothing");
}

class FileTest : public testing::Test {
protected:
    fs::path folder = fs::path(testing::TempDir()) / fmt::format("listric-file-{}", getpid());
    FileTest() { fs::create_directories(folder); }
    ~FileTest() override { fs::remove_all(folder); }

    JsonObject found(const std::string& text) const {
        std::ofstream(folder / "a.json") << text;
        return object_in(folder / "a.json");
    }
};

TEST_F(FileTest, HalfWrittenFilesOverwriteNothing) {
    write_text(folder / "diary.txt", "dear diary");
    const std::string part = fmt::format("a.txt.{}.part", getpid());
    fs::create_symlink("diary.txt", folder / part);
    fs::create_directory(folder / fmt::format("a.txt.{}1.part", getpid()));
    write_text(folder / fmt::format("a.txt.{}2.part", getpid()), "somebody's");
    write_text(folder / "a.txt", "new");
    EXPECT_EQ(read_text(folder / "a.txt"), "new");
    EXPECT_FALSE(fs::is_symlink(folder / "a.txt"));
    EXPECT_EQ(read_text(folder / "diary.txt"), "dear diary");
    EXPECT_TRUE(fs::is_symlink(folder / part));
    EXPECT_EQ(read_text(folder / fmt::format("a.txt.{}2.part", getpid())), "somebody's");
}

TEST_F(FileTest, WhatIsNoFileIsNotRead) {
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_EQ(read_text_if_there(folder / "pipe"), ""); // nobody ever writes there
    EXPECT_EQ(read_text_if_there(folder), "");
    EXPECT_TRUE(object_in(folder).empty());
}

TEST_F(FileTest, MessagesNameFileAndCause) {
    const fs::path none = folder / "none/a";
    const auto named = [&](const std::string& what) {
        return AllOf(StartsWith(none.string()), HasSubstr(what),
                     EndsWith("No such file or directory"));
    };
    EXPECT_THAT(refusal([&] { read_text(none); }), named("cannot be read"));
    EXPECT_THAT(refusal([&] { write_text(none, ""); }), named("cannot write"));
    EXPECT_THAT(refusal([&] { write_npy<double>(none, {}); }), named("cannot be written"));
    EXPECT_THAT(refusal([&] { read_text(folder); }), HasSubstr("it is a folder"));
    write_text(folder / "file", "");
    EXPECT_THAT(refusal([&] { TemporaryFolder there(folder / "file/in"); }),
                AllOf(StartsWith((folder / "file/in").string()), EndsWith("Not a directory")));
}

TEST_F(FileTest, Hdf5TextsOfAnyLength) {
    using namespace archive;
    prepare_hdf5(1.0);
    const Handle file = make_file();
    const std::string text(70'000, 'x');
    for (const std::string& t : {text, std::string(), std::string("Höhe\n")}) {
        const std::string name = fmt::format("text {}", t.size());
        write_text(file, name.c_str(), t);
        EXPECT_EQ(read_text(file, name.c_str()), t);
    }
    EXPECT_THAT(refusal([&] { write_text_attribute(file, "scene", text); }),
                AllOf(StartsWith("cannot make the attribute scene (HDF5: "), HasSubstr("large")));
    EXPECT_THAT(refusal([&] { read_text(file, "none"); }),
                HasSubstr("lacks the text none (HDF5: "));
    EXPECT_THAT(refusal([&] { read_number<double>(file, "none"); }),
                HasSubstr("lacks the attribute none (HDF5: "));
    EXPECT_THAT(refusal([&] { open_group(file, "none"); }),
                HasSubstr("lacks the group none (HDF5: "));
}

TEST_F(FileTest, JsonOfAnotherShapeIsAsIfItWereNotThere) {
    for (const char* text :
         {"", "[]", "null", "3", "{\"a\": tr", "{\"a\": 1e999}", "{\"a\": \"\xf6\"}", "{} {}"})
        EXPECT_TRUE(found(text).empty()) << text;
    EXPECT_TRUE(found(std::string(1'000'000, '[')).empty());
    std::string deep;
    for (int k = 0; k < 100'000; ++k)
        deep += "{\"a\":";
    EXPECT_TRUE(found(deep + "1" + std::string(100'000, '}')).empty());
    const JsonObject brackets = found("{\"a\": \"" + std::string(200, '[') + "\\\"{\"}");
    EXPECT_EQ(text_at(brackets, "a").size(), 202u); // within a text they mean nothing

    const JsonObject json = found(R"({"t": "x", "n": 3, "b": true, "o": {"n": 1.5}, "l": [1]})");
    for (const char* key : {"n", "b", "o", "l", "none"})
        EXPECT_EQ(text_at(json, key), "") << key;
    for (const char* key : {"t", "b", "o", "l", "none"})
        EXPECT_EQ(number_at(json, key), std::nullopt) << key;
    for (const char* key : {"t", "n", "o", "l", "none"})
        EXPECT_FALSE(is_true_at(json, key)) << key;
    EXPECT_EQ(text_at(json, "t"), "x");
    EXPECT_EQ(number_at(json, "n"), 3.0);
    EXPECT_TRUE(is_true_at(json, "b"));
    EXPECT_EQ(number_at(object_at(json, "o"), "n"), 1.5);
    EXPECT_TRUE(object_at(json, "l").empty());
    EXPECT_EQ(text_at(json["l"], "t"), ""); // of what is no object, too
    EXPECT_THAT(refusal([&] { need_number(json, "none"); }), HasSubstr("lacks the number none"));
}

TEST_F(FileTest, JsonIsWrittenWhateverItHolds) {
    EXPECT_EQ(to_text(JsonObject{{"name", "H\xf6he"}, {"x", INFINITY}}),
              "{\"name\":\"H\xef\xbf\xbdhe\",\"x\":null}");
}

} // namespace
} // namespace listric::file_test
