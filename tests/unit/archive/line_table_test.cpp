// Lines as files of other programs: whatever a name holds, a line stays a line.

#include "apps/archive/tables/line_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace listric::archive {
namespace {

using testing::HasSubstr;

LineTable layers() {
    return {.name = "layers",
            .level = "",
            .columns = {"name", "area_m2"},
            .lines = {{.values = {"salt, \"lower\"\nZechstein", 12.5},
                       .points = {{1000.0, -2000.0}, {3000.0, -2500.0}}}}};
}

TEST(LineTable, NamesWithCommasQuotesAndLineEndsStayOneCellOfCsv) {
    const std::string text = to_csv(layers());
    EXPECT_EQ(text, "line,name,area_m2,depth_reference,x_m,depth_m\n"
                    "0,\"salt, \"\"lower\"\"\nZechstein\",12.5,original surface,1000,2000\n"
                    "0,\"salt, \"\"lower\"\"\nZechstein\",12.5,original surface,3000,2500\n");
}

TEST(LineTable, NamesStayInTheirHeaderOfGmt) {
    EXPECT_THAT(to_gmt(layers()), HasSubstr("> -L\"salt, 'lower' Zechstein\" area_m2=12.5\n"
                                            "1000\t2000\n"));
}

TEST(LineTable, ALineOfOnePositionIsAPointOfGeojson) {
    LineTable table = layers();
    EXPECT_THAT(to_geojson(table),
                HasSubstr(R"("LineString", "coordinates": [[1000, -2000], [3000, -2500]])"));
    table.lines[0].points.pop_back();
    EXPECT_THAT(to_geojson(table), HasSubstr(R"("Point", "coordinates": [1000, -2000])"));
}

TEST(LineTable, EveryFormatSaysWhereDepthIsZero) {
    EXPECT_THAT(to_geojson(layers()),
                testing::AllOf(HasSubstr("\"description\": \"x: m from the breakaway into the "
                                         "hanging wall; y: m above the original surface (y = 0)"),
                               HasSubstr("\"depth_reference\": \"original surface\"")));
    EXPECT_THAT(to_gmt(layers()), HasSubstr("\n# x_m: m from the breakaway; depth_m: m below the "
                                            "original surface (depth 0), above it negative\n>"));
}

} // namespace
} // namespace listric::archive
