// Files of HDF5 that are made without its library, read by the library.

#include "apps/archive/snapshot/hdf5_table.hpp"
#include "apps/page/hdf5_image.hpp"
#include "apps/support/files/file.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <unistd.h>

namespace listric::hdf5_image_test {
namespace {

using namespace archive;
using testing::ElementsAre;

TEST(Hdf5Image, IsReadByTheLibrary) {
    Hdf5Object root;
    root.attributes.emplace_back("format", hdf5_text("of its own", false));
    root.attributes.emplace_back("half", hdf5_number(0.5));
    root.add("scene", hdf5_text(std::string(70'000, 'x') + "Höhe\n", true));
    root.add("empty", hdf5_text("", true));
    Hdf5Object& table = root.add("discs");
    table.attributes.emplace_back("rows", hdf5_number(std::int64_t{3}));
    std::int64_t position = 0;
    const auto add = [&](const char* name, const auto& values) {
        Hdf5Object& set = table.add(name, hdf5_column(values));
        set.attributes.emplace_back("unit", hdf5_text("m", false));
        set.attributes.emplace_back("initial", hdf5_number(values[0]));
        set.attributes.emplace_back("position", hdf5_number(position++));
    };
    add("z", std::vector<double>{1.5, -2e300, 0.1});
    add("of_floats", std::vector<float>{1.5F, -2.0F, 0.1F});
    add("id", std::vector<std::int64_t>{1, -2, std::int64_t{1} << 60});
    add("a", std::vector<std::int32_t>{1, -2, 3});
    add("flags", std::vector<std::uint8_t>{0, 200, 3});
    root.add("none").attributes.emplace_back("rows", hdf5_number(std::int64_t{7}));

    const auto path =
        std::filesystem::path(testing::TempDir()) / fmt::format("listric-image-{}.h5", getpid());
    write_bytes(path, hdf5_image(root));
    prepare_hdf5(1.0);
    {
        const Handle file = open_file(path);
        EXPECT_EQ(read_text_attribute(file, "format"), "of its own");
        EXPECT_EQ(read_number<double>(file, "half"), 0.5);
        EXPECT_EQ(read_text(file, "scene"), std::string(70'000, 'x') + "Höhe\n");
        EXPECT_EQ(read_text(file, "empty"), "");
        EXPECT_THAT(names_in(file), ElementsAre("discs", "empty", "none", "scene"));
        const dem::Table read = read_table(file, "discs");
        ASSERT_EQ(read.columns().size(), 5u);
        EXPECT_EQ(read.columns()[0].name, "z");
        EXPECT_EQ(read.columns()[0].unit, "m");
        EXPECT_THAT(read.get<double>("z"), ElementsAre(1.5, -2e300, 0.1));
        EXPECT_THAT(read.get<float>("of_floats"), ElementsAre(1.5F, -2.0F, 0.1F));
        EXPECT_THAT(read.get<std::int64_t>("id"), ElementsAre(1, -2, std::int64_t{1} << 60));
        EXPECT_THAT(read.get<std::int32_t>("a"), ElementsAre(1, -2, 3));
        EXPECT_THAT(read.get<std::uint8_t>("flags"), ElementsAre(0, 200, 3));
        EXPECT_EQ(read_table(file, "none").rows(), 7u);
    }
    std::filesystem::remove(path);
}

} // namespace
} // namespace listric::hdf5_image_test
