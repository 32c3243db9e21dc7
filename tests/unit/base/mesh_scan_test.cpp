// Gmsh files of any kind end in a sentence with file and line, whatever numbers they announce.

#include "fem/footwall.hpp"
#include "fem/mesh_scan.hpp"
#include "tests/places.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace listric::fem::mesh_scan_test {

namespace {

using testing::HasSubstr;

const std::string good = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
1 5 "detachment"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 +1e3 0 0
3 1000 1000.5 0
4 0 1000 0
$EndNodes
$Elements
2
1 1 2 5 1 1 2
2 3 4 1 1 2 -1 1 2 3 4
$EndElements
)";

/// Message about a mesh with a piece of its text replaced; empty: nothing is wrong with it.
std::string refusal(const std::string& from = "", const std::string& to = "") {
    std::string text = good;
    text.replace(from.empty() ? 0 : text.find(from), from.size(), to);
    const auto file =
        std::filesystem::temp_directory_path() / ("mesh-scan-" + std::to_string(getpid()) + ".msh");
    std::ofstream(file) << text;
    std::string said;
    try {
        scan_mesh(file.string());
    } catch (const FootwallError& error) {
        said = error.what();
    }
    std::filesystem::remove(file);
    return said.empty() ? said : said.substr(said.find(".msh") + 4);
}

TEST(MeshScan, AMeshIsTakenAsGmshWritesIt) {
    EXPECT_EQ(refusal(), "");
    EXPECT_EQ(refusal("$Nodes", "$Comments\nanything 1e99 at all\n$EndComments\n$Nodes"), "");
    EXPECT_NO_THROW(scan_mesh(std::string(source_folder) + "/meshes/lis1-footwall.msh"));
}

TEST(MeshScan, NumbersThatAreAnnouncedAreBoundByTheFile) {
    for (const char* count :
         {"-1", "1000000000", "1000000000000000000", "99999999999999999999999", "nan", "4.0"})
        EXPECT_THAT(refusal("$Nodes\n4", std::string("$Nodes\n") + count), HasSubstr(":9: "))
            << count;
    EXPECT_THAT(refusal("$Nodes\n4", "$Nodes\n1000000000"),
                HasSubstr("announces 1000000000 nodes"));
    for (const char* count : {"-1", "1000000000", "x", "1e3"})
        EXPECT_THAT(refusal("$Elements\n2", std::string("$Elements\n") + count), HasSubstr(":16: "))
            << count;
    for (const char* tags : {"999999999999", "-1", "99999999999999999999", "1.5"})
        EXPECT_THAT(refusal("1 1 2 5", std::string("1 1 ") + tags + " 5"), HasSubstr(":17: "))
            << tags;
}

TEST(MeshScan, NodesAndElementsHoldTogether) {
    EXPECT_THAT(refusal("1 0 0 0", "1 nan 0 0"), HasSubstr(":10: node 1 is further"));
    EXPECT_THAT(refusal("1 0 0 0", "1 0 1e300 0"), HasSubstr(":10: node 1 is further"));
    EXPECT_THAT(refusal("1 0 0 0", "2 0 0 0"), HasSubstr(":11: node 2 is there twice"));
    EXPECT_THAT(refusal("1 0 0 0", "-1 0 0 0"), HasSubstr("gaps"));
    EXPECT_THAT(refusal("1 0 0 0", "9 0 0 0"), HasSubstr("gaps"));
    EXPECT_THAT(refusal("1 2 3 4\n", "1 2 3 9\n"), HasSubstr(":18: element 2 names node 9"));
    EXPECT_THAT(refusal("1 2 3 4\n", "1 2 3 0\n"), HasSubstr("names node 0"));
    EXPECT_THAT(refusal("1 2 3 4\n", "1 2 3 -1\n"), HasSubstr(":18: needs a node's number"));
    EXPECT_THAT(refusal("1 2 3 4\n", "1 4 3 2\n"), HasSubstr(":18: element 2 is inverted"));
    EXPECT_THAT(refusal("5 1 1 2", "5 1 1 7"), HasSubstr(":17: element 1 names node 7"));
    EXPECT_THAT(refusal("5 1 1 2", "-5 1 1 2"), HasSubstr(":17: needs a tag"));
    EXPECT_THAT(refusal("2 3 4", "2 2 4"), HasSubstr("is of Gmsh type 2"));
    EXPECT_THAT(refusal("1 0 0 0\n", "1 0 0\n"), HasSubstr("needs a node"));
}

TEST(MeshScan, SectionsEnd) {
    for (const char* end : {"$EndMeshFormat", "$EndPhysicalNames", "$EndNodes", "$EndElements"})
        EXPECT_THAT(refusal(end), HasSubstr(std::string("ends without ") + end));
    EXPECT_THAT(refusal("2.2 0 8", "4.1 0 8"), HasSubstr("format 2.2"));
    EXPECT_THAT(refusal("2.2 0 8", "nan 0 8"), HasSubstr("format 2.2"));
    EXPECT_THAT(refusal("2.2 0 8", "2.2 1 8"), HasSubstr("binary"));
    EXPECT_THAT(refusal("$Elements", "$Nodes"), HasSubstr("twice"));
    EXPECT_THAT(refusal("2 3 4 1 1 2 -1 1 2 3 4", "2 1 2 5 1 1 2"), HasSubstr("no quadrilaterals"));
    EXPECT_THAT(refusal(good, ""), HasSubstr(":1: is no Gmsh mesh"));
}

} // namespace

} // namespace listric::fem::mesh_scan_test
