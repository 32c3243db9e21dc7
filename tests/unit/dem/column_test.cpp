// A table keeps its columns equally long and its rows together. All comparisons are exact: values
// are copied, never computed.

#include "dem/column.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace listric::column_test {

using namespace dem;
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Table three_rows() {
    Table t;
    t.resize(3);
    t.add<double>("length", "m", 1.5);
    t.add<float>("strength", "N", 2.5f);
    t.add<std::int64_t>("id", "1", -1);
    t.add<std::int32_t>("stratum", "1", 7);
    t.add<std::uint8_t>("flag", "1", 1);
    return t;
}

TEST(Column, AddFillsWithTheInitialValue) {
    Table t = three_rows();
    EXPECT_THAT(t.get<double>("length"), ElementsAre(1.5, 1.5, 1.5));
    EXPECT_THAT(t.get<float>("strength"), ElementsAre(2.5f, 2.5f, 2.5f));
    EXPECT_THAT(t.get<std::int64_t>("id"), ElementsAre(-1, -1, -1));
    EXPECT_EQ(t.columns()[0].unit, "m");
}

TEST(Column, ThatBeginsAsAnotherFollowsItInNewRowsAlone) {
    Table t = three_rows();
    t.get<double>("length")[0] = 4.0;
    EXPECT_THAT(t.add_like<double>("remembered", "m", "length"), ElementsAre(4.0, 1.5, 1.5));
    t.get<double>("length")[1] = 5.0;
    t.resize(5);
    t.get<double>("length")[3] = 6.0;
    t.begin_rows(3);
    EXPECT_THAT(t.get<double>("remembered"), ElementsAre(4.0, 1.5, 1.5, 6.0, 1.5));
    EXPECT_THAT(t.get<std::int64_t>("id"), ElementsAre(-1, -1, -1, -1, -1));
    EXPECT_THAT(t.add_like<double>("remembered", "m", "length"),
                ElementsAre(4.0, 1.5, 1.5, 6.0, 1.5));
}

TEST(Column, AddKeepsWhatIsThere) {
    Table t = three_rows();
    t.get<double>("length")[1] = 4.0;
    EXPECT_THAT(t.add<double>("length", "m", 9.0), ElementsAre(1.5, 4.0, 1.5));
    EXPECT_EQ(t.columns().size(), 5u);
}

TEST(Column, GetWritesThrough) {
    Table t = three_rows();
    t.get<std::int32_t>("stratum")[2] = 9;
    const Table& constant = t;
    EXPECT_THAT(constant.get<std::int32_t>("stratum"), ElementsAre(7, 7, 9));
}

TEST(Column, GetRefusesUnknownNamesAndOtherTypes) {
    Table t = three_rows();
    EXPECT_THROW(t.get<double>("width"), std::out_of_range);
    EXPECT_THROW(t.get<float>("length"), std::bad_variant_access);
}

TEST(Column, SetGivesAnEmptyTableItsRows) {
    Table t;
    t.set({"x", "m", std::vector<double>{1.0, 2.0}, 0.0});
    EXPECT_EQ(t.rows(), 2u);
    EXPECT_THROW(t.set({"y", "m", std::vector<double>{1.0}, 0.0}), std::logic_error);
    EXPECT_FALSE(t.has("y"));
}

TEST(Column, SetReplacesValuesAndType) {
    Table t = three_rows();
    t.set({"flag", "1", std::vector<std::int64_t>{4, 5, 6}, std::int64_t{0}});
    EXPECT_THAT(t.get<std::int64_t>("flag"), ElementsAre(4, 5, 6));
    EXPECT_EQ(t.columns().size(), 5u);
}

TEST(Column, ResizeGivesNewRowsTheInitialValue) {
    Table t = three_rows();
    t.get<double>("length")[0] = 8.0;
    t.set({"set", "1", std::vector<std::int32_t>{1, 2, 3}, std::int32_t{42}});
    t.resize(4);
    EXPECT_EQ(t.rows(), 4u);
    EXPECT_THAT(t.get<double>("length"), ElementsAre(8.0, 1.5, 1.5, 1.5));
    EXPECT_THAT(t.get<std::uint8_t>("flag"), ElementsAre(1, 1, 1, 1));
    EXPECT_THAT(t.get<std::int32_t>("set"), ElementsAre(1, 2, 3, 42));
    t.resize(1);
    EXPECT_THAT(t.get<double>("length"), ElementsAre(8.0));
}

TEST(Column, ReorderSortsSelectsAddsAndDrops) {
    Table t = three_rows();
    for (std::size_t k = 0; k < 3; ++k) {
        t.get<double>("length")[k] = 10.0 + static_cast<double>(k);
        t.get<std::uint8_t>("flag")[k] = static_cast<std::uint8_t>(k);
    }
    t.reorder(std::vector<std::int32_t>{2, 0, 2, 1});
    EXPECT_EQ(t.rows(), 4u);
    EXPECT_THAT(t.get<double>("length"), ElementsAre(12.0, 10.0, 12.0, 11.0));
    EXPECT_THAT(t.get<std::uint8_t>("flag"), ElementsAre(2, 0, 2, 1));
    t.reorder(std::vector<std::int32_t>{3});
    EXPECT_THAT(t.get<double>("length"), ElementsAre(11.0));
    t.reorder(std::vector<std::int32_t>{1, 0, 1}); // of one row
    EXPECT_THAT(t.get<double>("length"), ElementsAre(1.5, 11.0, 1.5));
    t.reorder(std::vector<std::int32_t>{});
    EXPECT_EQ(t.rows(), 0u);
    EXPECT_THAT(t.get<float>("strength"), IsEmpty());
}

TEST(Column, RemoveTakesTheColumnOnly) {
    Table t = three_rows();
    EXPECT_TRUE(t.has("strength"));
    t.remove("strength");
    EXPECT_FALSE(t.has("strength"));
    EXPECT_TRUE(t.has("length"));
    EXPECT_EQ(t.rows(), 3u);
    EXPECT_EQ(t.columns().size(), 4u);
}

} // namespace
} // namespace listric::column_test
