// `listric export`: a run's horizons, faults, surfaces and discs as files of other programs. The
// formats say the same, and what the run has said before.

#include "apps/archive/run_history.hpp"
#include "apps/archive/setting.hpp"
#include "apps/measures/horizons.hpp"
#include "dem/power_cell.hpp"
#include "tests/program.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <numeric>
#include <sstream>

namespace listric {

using namespace archive;
using namespace dem;
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using support::contents;
using support::Ended;
using support::Program;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

// Four strata of 30 discs each; slip on an arc as narrow as this makes a fault.
const std::string small_scene = support::small_halfgraben("50.0") + R"([extension]
distance_m = 800.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 200.0
figures_at_m = []
[gravity]
[bonds]
[fault_weakening]
interval_a = 6000.0
youngest_sediment_a = 5000.0
[bond_healing]
[sedimentation]
interval_a = 20000.0
)";

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, at);)
        parts.push_back(part);
    return parts;
}

double number(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    EXPECT_TRUE(!text.empty() && *end == '\0') << text;
    return value;
}

/// What a file says of a line: x and depth of its points, and one of its columns.
struct ReadLine {
    std::vector<std::pair<double, double>> points = {};
    std::string value = {};

    bool operator==(const ReadLine&) const = default;
};

std::vector<ReadLine> read_csv_lines(const fs::path& file, const std::string& column) {
    const std::vector<std::string> rows = split(contents(file), '\n');
    const std::vector<std::string> names = split(rows.at(0), ',');
    const auto at = [&](const std::string& name) {
        return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
    };
    std::vector<ReadLine> lines;
    for (std::size_t r = 1; r < rows.size(); ++r) {
        const std::vector<std::string> cells = split(rows[r], ',');
        const auto line = static_cast<std::size_t>(number(cells.at(at("line"))));
        lines.resize(line + 1);
        lines[line].points.emplace_back(number(cells.at(at("x_m"))),
                                        number(cells.at(at("depth_m"))));
        lines[line].value = cells.at(at(column));
    }
    return lines;
}

std::vector<ReadLine> read_geojson_lines(const fs::path& file, const std::string& column) {
    std::vector<ReadLine> lines;
    const json all = json::parse(contents(file));
    EXPECT_EQ(all["type"], "FeatureCollection");
    for (const json& feature : all["features"]) {
        EXPECT_EQ(feature["geometry"]["type"], "LineString");
        ReadLine& line = lines.emplace_back();
        for (const json& place : feature["geometry"]["coordinates"])
            line.points.emplace_back(place.at(0), 0.0 - place.at(1).get<double>());
        const json& value = feature["properties"].at(column);
        line.value =
            value.is_string() ? value.get<std::string>() : fmt::format("{}", value.get<double>());
    }
    return lines;
}

std::vector<ReadLine> read_gmt_lines(const fs::path& file, const std::string& column) {
    std::vector<ReadLine> lines;
    for (const std::string& row : split(contents(file), '\n')) {
        if (row.starts_with(">")) {
            const std::string begin = column == "name" ? " -L\"" : fmt::format(" {}=", column);
            const std::size_t at = row.find(begin) + begin.size();
            const std::size_t end = row.find_first_of(column == "name" ? "\"" : " ", at);
            lines.push_back({{}, row.substr(at, end - at)});
        } else if (!row.starts_with("#")) {
            const std::vector<std::string> cells = split(row, '\t');
            lines.back().points.emplace_back(number(cells.at(0)), number(cells.at(1)));
        }
    }
    return lines;
}

class ExportTest : public support::SceneRuns {
protected:
    json run_it(std::optional<double> until = {}) {
        const json summary = run(load(small_scene), "run", until);
        unsetenv("PYTHONPATH"); // the exported file needs NumPy
        return summary;
    }

    Ended call(std::vector<std::string> words) const {
        words.insert(words.begin(), "export");
        return Program(folder, words).wait();
    }

    fs::path file(const std::string& name) const { return folder / "run/export" / name; }

    /// The lines of a kind at the end of the run, which all formats agree on.
    std::vector<ReadLine> lines(const std::string& kind, const std::string& column) const {
        const Ended ended = call({kind, output, "--format", "csv,geojson,gmt"});
        EXPECT_EQ(ended.code, 0) << ended.err;
        const std::string name = kind + "-extension-00800.00m";
        EXPECT_THAT(split(ended.out, '\n'), SizeIs(3 * 5)); // at 0, 200, ..., 800 m
        EXPECT_THAT(ended.out, HasSubstr(file(name + ".gmt").string()));
        const std::vector<ReadLine> csv = read_csv_lines(file(name + ".csv"), column);
        EXPECT_THAT(csv, Not(IsEmpty()));
        EXPECT_EQ(csv, read_geojson_lines(file(name + ".geojson"), column));
        EXPECT_EQ(csv, read_gmt_lines(file(name + ".gmt"), column));
        return csv;
    }

    const std::string output = (folder / "run").string();
};

// Equal numbers: all formats have the shortest text that reads back the same.
TEST_F(ExportTest, FormatsAgreeWithEachOtherAndWithTheSummary) {
    const json summary = run_it();
    const json& faults = summary["faults"];
    ASSERT_THAT(faults, Not(IsEmpty())); // else nothing is compared
    const std::vector<ReadLine> traced = lines("faults", "dip_deg");
    ASSERT_THAT(traced, SizeIs(faults.size()));
    for (std::size_t k = 0; k < traced.size(); ++k) {
        EXPECT_EQ(number(traced[k].value), faults[k]["dip_deg"].get<double>());
        // summary.json has points to the metre.
        ASSERT_THAT(traced[k].points, SizeIs(faults[k]["points_m"].size()));
        EXPECT_NEAR(traced[k].points[0].first, faults[k]["x_top_m"].get<double>(), 5.1e-4);
        EXPECT_NEAR(traced[k].points[0].second, faults[k]["z_top_m"].get<double>(), 5.1e-4);
    }
    const json exported =
        json::parse(contents(file("faults-extension-00800.00m.geojson")))["features"];
    for (std::size_t k = 0; k < faults.size(); ++k) {
        json expected = faults[k], found = exported[k]["properties"];
        for (const auto& [stratum, value] : expected["throw_m"].items())
            expected["throw_" + stratum + "_m"] = value;
        for (const char* key :
             {"throw_m", "points_m", "x_top_m", "z_top_m", "x_bottom_m", "z_bottom_m"})
            expected.erase(key);
        for (const auto& [key, value] : expected.items())
            EXPECT_EQ(found.at(key), value) << key;
    }
    std::vector<std::string> names;
    for (const ReadLine& line : lines("surfaces", "name"))
        names.push_back(line.value);
    EXPECT_EQ(names, (std::vector<std::string>{"detachment", "original surface", "target line",
                                               "free surface"}));
    EXPECT_EQ(lines("horizons", "stratum").back().value, "4");
}

// Strata of 30 discs: their tops are 1.5 km long and some 7 m off (a twentieth of a mean diameter
// over a correlation of a few discs), 1e4 of 3e5 m2; all of them, of which only the last
// top counts, 1 %.
TEST_F(ExportTest, AreaBetweenHorizonsIsThatOfThePowerCells) {
    run_it();
    const RunFolder run(output);
    const measures::Setting setting = make_setting(run.scene, run.parts);
    const State state = run.read(run.snapshots.back()).state;
    const std::vector<measures::Horizon> horizons =
        measures::trace_horizons(setting, run.parts.base, state, {});
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::int32_t> rows(d.x.size());
    std::iota(rows.begin(), rows.end(), 0);
    const std::vector<PowerCell> cells = power_cells(state, run.parts.base, rows);
    const std::vector<double> radius = rock_radii(state);
    double traced = 0.0, expected = 0.0;
    for (std::size_t k = 1; k < horizons.size(); ++k) {
        if (horizons[k].stratum < 1)
            continue;
        ASSERT_THAT(horizons[k].top, SizeIs(1));
        ASSERT_THAT(horizons[k - 1].top, SizeIs(1));
        measures::Polyline around = horizons[k].top[0];
        around.insert(around.end(), horizons[k - 1].top[0].rbegin(), horizons[k - 1].top[0].rend());
        double area = 0.0;
        for (std::size_t p = 0; p < around.size(); ++p)
            area -= 0.5 * cross(around[p], around[(p + 1) % around.size()]);
        // Discs at the surface have no closed cell: the solid share of those that do.
        double closed = 0.0, solid = 0.0, open = 0.0;
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (d.stratum[i] == horizons[k].stratum) {
                (cells[i].closed ? solid : open) += radius[i] * radius[i];
                closed += cells[i].closed ? cells[i].area : 0.0;
            }
        const double of_cells = closed * (1.0 + open / solid);
        EXPECT_NEAR(area / of_cells, 1.0, 0.05) << horizons[k].stratum;
        traced += area;
        expected += of_cells;
    }
    EXPECT_NEAR(traced / expected, 1.0, 0.02);
}

TEST_F(ExportTest, DiscsAndTheirGsdFile) {
    run_it(200.0);
    Ended ended = call({"discs", output, "--at", "200"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const fs::path csv = file("discs-extension-00200.00m.csv");
    EXPECT_EQ(ended.out, csv.string() + "\n");
    const RunFolder run(output);
    const State state = run.read(run.snapshots.back()).state;
    std::size_t count = 0;
    for (const ReadLine& rock : read_csv_lines(csv, "id"))
        count += rock.points.size();
    EXPECT_EQ(count, state.discs.rows());

    ended = call({"discs", output, "--format", "gsd"});
    if (ended.code == 2 && ended.err.find("python3-gsd") != ended.err.npos)
        GTEST_SKIP() << ended.err;
    ASSERT_EQ(ended.code, 0) << ended.err;
    const std::string script =
        "import gsd.hoomd, sys\n"
        "t = gsd.hoomd.open(sys.argv[1], 'rb')\n"
        "f = t[-1]\n"
        "print(len(t), f.particles.N, f.bonds.N, f.particles.types[f.particles.typeid.max()],\n"
        "      float((f.particles.diameter / 2).sum()), f.bonds.group.max() < f.particles.N)\n";
    std::ofstream(folder / "read.py") << script;
    ASSERT_EQ(
        std::system(fmt::format("/usr/bin/python3 '{}' '{}' > '{}'", (folder / "read.py").string(),
                                file("discs.gsd").string(), (folder / "read").string())
                        .c_str()),
        0);
    const std::vector<std::string> words = split(contents(folder / "read"), ' ');
    ASSERT_THAT(words, SizeIs(6));
    EXPECT_EQ(words[0], "2"); // moments
    EXPECT_EQ(words[1], fmt::format("{}", state.discs.rows()));
    const ConstContactColumns c = contact_columns(state);
    EXPECT_EQ(words[2], fmt::format("{}", std::accumulate(c.bonded.begin(), c.bonded.end(), 0)));
    EXPECT_EQ(words[3], "sediment");
    const ConstDiscColumns d = disc_columns(state);
    const double radii = std::accumulate(d.radius.begin(), d.radius.end(), 0.0);
    EXPECT_NEAR(number(words[4]), radii, 1e-5 * radii); // single precision
    EXPECT_EQ(words[5], "True\n");
}

TEST_F(ExportTest, BadCallsSayWhatIsWrongInOneLine) {
    run_it(200.0);
    const auto expect_refused = [&](const std::vector<std::string>& words,
                                    const std::string& part) {
        const Ended ended = call(words);
        EXPECT_EQ(ended.code, 2) << part;
        EXPECT_THAT(ended.err, HasSubstr(part));
        EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
        EXPECT_EQ(ended.out, "");
    };
    expect_refused({"horizon", output}, "no kind horizon; did you mean horizons?");
    expect_refused({"wells", output}, "no kind wells; allowed: horizons, faults, surfaces, base");
    expect_refused({"horizons", output, "--format", "geojsn"}, "did you mean geojson?");
    expect_refused({"horizons", output, "--format", "gsd"},
                   "export horizons: no format gsd; allowed: csv, geojson, gmt");
    expect_refused({"discs", output, "--format", "csv,gmt"}, "export discs: no format gmt");
    expect_refused({"faults", folder.string()}, "is this a run's folder?");
    expect_refused({"faults", output, "--at", "5000"},
                   "--at 5000: no snapshot there; there are some from 0 to 200 m");
    expect_refused({"base", output}, "the base of this run is rigid");
    setenv("LISTRIC_PYTHON", "/bin/false", 1);
    expect_refused({"discs", output, "--format", "gsd"}, "install the package python3-gsd");
    unsetenv("LISTRIC_PYTHON");
}

} // namespace
} // namespace listric
