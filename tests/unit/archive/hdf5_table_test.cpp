// Tables in HDF5: columns with the same bytes are there once.

#include "apps/archive/snapshot/hdf5_table.hpp"
#include "apps/support/files/file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <unistd.h>

namespace listric::archive {
namespace {

constexpr std::size_t rows = 5000;

dem::Table table_with(double last_of_noted) {
    dem::Table table;
    table.resize(rows);
    const auto x = table.add("x", "m", 1.0), noted = table.add("noted_x", "m", 2.0);
    for (std::size_t k = 0; k < rows; ++k)
        x[k] = noted[k] = std::sin(static_cast<double>(k));
    x[0] = noted[0] = std::nan("");
    noted.back() = last_of_noted;
    table.add("steps", "1", std::int64_t{0});
    table.add("other_steps", "1", std::int64_t{1}); // has other values
    return table;
}

/// Writes and reads a table in a group of a group; tells the file's size.
std::size_t size_when_kept(const dem::Table& table) {
    const auto path =
        std::filesystem::path(testing::TempDir()) / fmt::format("listric-table-{}.h5", getpid());
    {
        const Handle file = make_file();
        const Handle group = create_group(file, "memory");
        write_table(create_group(group, "discs"), table);
        write_bytes(path, image_of(file));
    }
    const Handle file = open_file(path);
    const dem::Table read = read_table(open_group(file, "memory"), "discs");
    EXPECT_EQ(read.columns().size(), table.columns().size());
    for (const dem::Column& column : table.columns()) {
        const auto found = std::ranges::find(read.columns(), column.name, &dem::Column::name);
        if (found == read.columns().end()) {
            ADD_FAILURE() << column.name;
            continue;
        }
        EXPECT_EQ(found->initial, column.initial) << column.name << " keeps what is its own";
        if (const auto* values = std::get_if<std::vector<double>>(&column.values)) {
            EXPECT_EQ(std::memcmp(std::get<std::vector<double>>(found->values).data(),
                                  values->data(), rows * sizeof(double)),
                      0)
                << column.name;
        }
    }
    const auto size = static_cast<std::size_t>(std::filesystem::file_size(path));
    std::filesystem::remove(path);
    return size;
}

TEST(Hdf5Table, KeepsColumnsOfTheSameBytesOnce) {
    const double last = std::sin(static_cast<double>(rows - 1));
    const std::size_t same = size_when_kept(table_with(last));
    const std::size_t other = size_when_kept(table_with(-last));
    EXPECT_GT(other, same + rows * 4);
    // Equal numbers of other bytes are other columns.
    dem::Table zeros;
    zeros.resize(rows);
    zeros.add("x", "m", 0.0);
    for (double& value : zeros.add("y", "m", 0.0))
        value = -0.0;
    size_when_kept(zeros);
}

} // namespace
} // namespace listric::archive
