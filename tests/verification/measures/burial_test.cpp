// Burial history of wells: decompacted by what the file itself says, strata are as thick as they
// were laid down.
//
// The wells stand on the flat of the detachment, where the hanging wall is neither bent nor
// stretched, so that a column keeps its grains: thickness (1 - porosity) is what it was. A well is
// 20 discs wide and its strata 6 thick: discs that lie across its edges, of which another half is
// counted before and after, are 1 % of it, and 2 % is twice that. 6 s.

#include "apps/figures/sections/export_run.hpp"
#include "apps/support/error.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <map>
#include <sstream>

namespace listric::burial_test {

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const std::string basin = R"([hanging_wall]
length_m = 7000.0
thickness_m = 1500.0
mean_radius_m = 40.0
[detachment]
segments = [{arc = {radius_m = 1500.0, end_dip_deg = 0.0}}, {line = {length_m = 9000.0}}]
[extension]
distance_m = 410.0
[output]
interval_m = 41.0
figures_at_m = []
series = "none"
report = false
[gravity]
)";

const std::string sediment = R"([sedimentation]
interval_a = 10000.0
target = [{time_a = 0.0, points = [[0.0, 0.0]]}, {time_a = 40000.0, points = [[0.0, 1600.0]]}]
[compaction]
interval_a = 500.0
)";

constexpr double porosity_as_deposited = 0.5; ///< default of the scene

/// A row of the file.
using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const fs::path& file) {
    std::istringstream lines(support::contents(file));
    std::vector<std::string> names;
    std::vector<Row> rows;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line);
        std::vector<std::string> words;
        for (std::string word; std::getline(cells, word, ',');)
            words.push_back(word);
        if (names.empty()) {
            names = words;
            continue;
        }
        EXPECT_EQ(words.size(), names.size()) << line;
        Row& row = rows.emplace_back();
        for (std::size_t k = 0; k < names.size(); ++k)
            row[names[k]] = words[k];
    }
    return rows;
}

double number(const Row& row, const char* column) { return std::stod(row.at(column)); }

/// Thickness that a stratum had with the porosity of the surface, if it keeps its grains.
double decompacted(const Row& row) {
    return number(row, "thickness_m") * (1.0 - number(row, "porosity")) /
           (1.0 - porosity_as_deposited);
}

class Burial : public support::SceneRuns {};

TEST_F(Burial, DecompactsToTheThicknessThatWasDeposited) {
    run(load(basin + sediment), "basin");
    const auto files =
        export_run({.kind = "well", .output = folder / "basin", .wells = {4500.0, 5000.0, 5500.0}});
    ASSERT_EQ(files.size(), 1u); // water is in no pores here
    EXPECT_EQ(files[0].filename(), "burial-extension-00410.00m-x-4500_5000_5500m.csv");
    std::map<std::string, int> strata;
    for (const Row& row : rows_of(files[0])) {
        SCOPED_TRACE(row.at("name") + ", stratum " + row.at("stratum") + ", " + row.at("time_a"));
        EXPECT_NEAR(number(row, "base_depth_m") - number(row, "depth_m"),
                    number(row, "thickness_m"), 0.01);
        EXPECT_NEAR(number(row, "time_a") + number(row, "age_a"), 41000.0, 1.0);
        EXPECT_EQ(number(row, "deposited_porosity"), porosity_as_deposited);
        EXPECT_GE(number(row, "discs"), 1.0);
        EXPECT_GE(number(row, "ground_depth_m"), 0.0);
        if (number(row, "age_a") > 0.0)
            continue;
        ++strata[row.at("name")];
        // Laid down up to a line above the original surface, into air: all of it is above.
        EXPECT_LT(number(row, "tectonic_subsidence_m"), 0.0);
        EXPECT_NEAR(decompacted(row) / number(row, "deposited_thickness_m"), 1.0, 0.02);
        if (number(row, "stratum") == 1.0) { // which has lost a quarter of its thickness
            EXPECT_LT(number(row, "thickness_m"), 0.8 * number(row, "deposited_thickness_m"));
        }
    }
    EXPECT_THAT(strata,
                testing::ElementsAre(testing::Pair("x 4500 m", 4), testing::Pair("x 5000 m", 4),
                                     testing::Pair("x 5500 m", 4)));
}

TEST_F(Burial, NeedsSediment) {
    const auto refusal = [&](const ExportRequest& request) -> std::string {
        try {
            export_run(request);
        } catch (const UsageError& error) {
            return error.what();
        }
        return "written";
    };
    run(load(basin, {"extension.distance_m=1", "hanging_wall.mean_radius_m=100"}), "bare");
    EXPECT_THAT(refusal({.kind = "well", .output = folder / "bare"}),
                AllOf(HasSubstr("bare"), HasSubstr("a scene with sediment")));
}

} // namespace
} // namespace listric::burial_test
