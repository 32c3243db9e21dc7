// The series for ParaView, opened and drawn by ParaView's own libraries (or VTK's, its readers).

#include "apps/archive/folder/run_folder.hpp"
#include "apps/figures/sections/paraview.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/run.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/numbers/units.hpp"
#include "tests/places.hpp"
#include "tests/small_halfgraben.hpp"
#include "tests/xml_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <sys/wait.h>
#include <unistd.h>

namespace listric::paraview_test {

using namespace archive;
using namespace dem;
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using support::contents;
using testing::HasSubstr;

// 565 discs; sediment, weak discs and broken bonds in 300 m of extension.
const std::string small_scene = support::small_halfgraben("50.0") + R"([extension]
distance_m = 300.0
speed_m_per_s = 4.0
ramp_s = 2.0
[output]
interval_m = 100.0
figures_at_m = []
[gravity]
[bonds]
[fault_weakening]
interval_a = 6000.0
youngest_sediment_a = 5000.0
[bond_healing]
[sedimentation]
interval_a = 6000.0
)";

/// Largest relative error of a double that is stored as a float.
constexpr double single_precision = 6e-8;

/// Replaces the first occurrence in a file by words of the same length.
void replace(const fs::path& file, const std::string& what, const std::string& with) {
    std::string text = contents(file);
    const std::size_t place = text.find(what);
    ASSERT_NE(place, text.npos) << what;
    std::ofstream(file, std::ios::binary) << text.replace(place, what.size(), with);
}

/// Replaces an array of as many floats by one whose last is infinite.
void end_in_infinity(const fs::path& file, const std::string& name, std::size_t count) {
    std::vector<float> values(count);
    values.back() = std::numeric_limits<float>::infinity();
    const std::string text = contents(file);
    const std::size_t begin = text.find(">\n", text.find("Name=\"" + name + '"')) + 2;
    const std::size_t end = text.find("\n</DataArray>", begin);
    std::ofstream(file, std::ios::binary)
        << text.substr(0, begin)
        << vtk_array({reinterpret_cast<const unsigned char*>(values.data()), 4 * count})
        << text.substr(end);
}

bool on_path(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
}

/// Command that lends a picture a display, of a number that no other test takes meanwhile. ParaView
/// connects more than once: a server that resets itself in between refuses it now and then.
std::string display() {
    return on_path("xvfb-run") ? fmt::format("xvfb-run -n {} -s '-screen 0 1280x1024x24 -noreset' ",
                                             100 + getpid() % 20000)
                               : "";
}

class ParaviewTest : public testing::Test {
protected:
    struct Seen {
        int code;
        std::string out, err;
    };

    void SetUp() override {
        ASSERT_TRUE(on_path("xvfb-run") || std::getenv("DISPLAY")) << "packages xvfb, xauth";
        fs::create_directories(folder);
        std::ofstream(folder / "small.toml") << small_scene;
        setenv("XDG_CACHE_HOME", (folder / "cache").c_str(), 1);
        RunOptions options;
        options.output = run;
        options.quiet = true;
        setenv("LISTRIC_PYTHON", "/bin/false", 1); // pictures take longer than the run
        scene = load_scene({.scene = (folder / "small.toml").string()});
        run_scene(scene, options);
        unsetenv("LISTRIC_PYTHON");
        ASSERT_NE(look().code, 77) << look().err; // no ParaView
    }

    ~ParaviewTest() override {
        fs::remove_all(folder);
        unsetenv("XDG_CACHE_HOME");
    }

    /// Opens the series, and draws it if a picture is named.
    Seen look(const std::string& picture = "") const {
        std::string line =
            fmt::format("/usr/bin/python3 '{}' '{}'",
                        std::string(source_folder) + "/tests/regression/render_paraview.py",
                        (run / "paraview.pvd").string());
        if (!picture.empty())
            line = fmt::format("{}{} '{}'", display(), line, (folder / picture).string());
        const int status =
            std::system(fmt::format("{} >'{}' 2>'{}'", line, (folder / "stdout").string(),
                                    (folder / "stderr").string())
                            .c_str());
        return {WEXITSTATUS(status), contents(folder / "stdout"), contents(folder / "stderr")};
    }

    fs::path last(const std::string& part) const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(run / "paraview"))
            if (entry.path().filename().string().starts_with(part))
                files.push_back(entry.path());
        return std::ranges::max(files);
    }

    const fs::path folder =
        fs::path(testing::TempDir()) / fmt::format("listric-paraview-{}", getpid());
    const fs::path run = folder / "run";
    Scene scene;
};

/// Pixels whose centre lies in a disc.
int covered_pixels(const State& state, const json& picture) {
    const int width = picture["width"], height = picture["height"];
    const double pixel = picture["metres_per_pixel"];
    const ConstDiscColumns d = disc_columns(state);
    std::vector<bool> covered(static_cast<std::size_t>(width * height));
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double x = (d.x[i] - picture["left_m"].get<double>()) / pixel - 0.5;
        const double y = (d.y[i] - picture["bottom_m"].get<double>()) / pixel - 0.5;
        const double radius = d.radius[i] / pixel;
        for (int row = std::max(0, static_cast<int>(y - radius));
             row < std::min<double>(height, y + radius + 1.0); ++row)
            for (int column = std::max(0, static_cast<int>(x - radius));
                 column < std::min<double>(width, x + radius + 1.0); ++column)
                if (std::hypot(column - x, row - y) < radius)
                    covered[static_cast<std::size_t>(row * width + column)] = true;
    }
    return static_cast<int>(std::ranges::count(covered, true));
}

double sum(std::span<const double> values) {
    double result = 0.0;
    for (const double value : values)
        result += value;
    return result;
}

/// As zlib's crc32 sees them, in the type that the file has.
template <class Stored, class Range> std::uint32_t checksum(const Range& values) {
    std::vector<Stored> stored;
    for (const auto& value : values)
        stored.push_back(static_cast<Stored>(value));
    const auto bytes = static_cast<uInt>(stored.size() * sizeof(Stored));
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(stored.data()), bytes));
}

/// Rows of three components.
std::vector<double> rows(std::span<const double> first, std::span<const double> second) {
    std::vector<double> values;
    for (std::size_t i = 0; i < first.size(); ++i)
        values.insert(values.end(), {first[i], second[i], 0.0});
    return values;
}

/// Every number of a moment that is a copy of a column.
std::map<std::string, std::uint32_t> checksums(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const std::vector<bool> touches = touching(state);
    std::vector<double> depth(d.start_y.begin(), d.start_y.end()), bonded, shear;
    std::ranges::transform(depth, depth.begin(), std::negate());
    for (std::size_t k = 0; k < touches.size(); ++k)
        if (touches[k]) {
            bonded.push_back(c.bonded[k]);
            shear.push_back(c.shear_force[k]);
        }
    return {{"place_m", checksum<float>(rows(d.x, d.y))},
            {"velocity_m_per_s", checksum<float>(rows(d.vx, d.vy))},
            {"id", checksum<std::int64_t>(d.id)},
            {"radius_m", checksum<float>(d.radius)},
            {"material", checksum<std::int32_t>(d.material)},
            {"stratum", checksum<std::int32_t>(d.stratum)},
            {"rotation_rad", checksum<float>(d.rotation)},
            {"start_depth_m", checksum<float>(depth)},
            {"bonded", checksum<std::uint8_t>(bonded)},
            {"shear_force_n", checksum<float>(shear)}};
}

TEST_F(ParaviewTest, EveryMomentHoldsWhatTheSnapshotDoes) {
    const Seen seen = look();
    ASSERT_EQ(seen.code, 0) << seen.err;
    const json moments = json::parse(seen.out)["moments"];
    const auto snapshots = list_snapshots(run);
    ASSERT_EQ(snapshots.size(), 4); // 0, 100, 200, 300 m
    EXPECT_EQ(support::xml_files(run), "1 of .pvd\n12 of .vtp\n");
    ASSERT_EQ(moments.size(), snapshots.size());
    const RigidBase base = make_rigid_base(scene);
    for (std::size_t k = 0; k < snapshots.size(); ++k) {
        SCOPED_TRACE(snapshots[k]);
        const State state = read_snapshot(snapshots[k]).state;
        const json& moment = moments[k];
        const ConstDiscColumns d = disc_columns(state);
        const ConstContactColumns c = contact_columns(state);
        // File names tell the moment to 0.01 m.
        EXPECT_NEAR(moment["time_ma"].get<double>(),
                    state.clock.extension.m / scene.extension.rate / 1e6,
                    0.005 / scene.extension.rate / 1e6);
        EXPECT_EQ(moment["discs"], d.x.size());
        EXPECT_EQ(moment["contacts"], std::ranges::count(touching(state), true));
        EXPECT_EQ(moment["bonded"], std::ranges::count(c.bonded, 1));
        EXPECT_EQ(moment["sums"]["bonds"], 2.0 * std::ranges::count(c.bonded, 1));
        for (const auto& [name, expected] : checksums(state))
            EXPECT_EQ(moment["checksums"][name], expected) << name;
        double xx = 0.0, yy = 0.0, magnitude = 0.0;
        for (const Stress& s : disc_stresses(state, base)) {
            xx += s.xx;
            yy += s.yy;
            magnitude += std::abs(s.xx) + std::abs(s.yy);
        }
        EXPECT_NEAR(moment["sums"]["stress_pa"][0].get<double>(), xx, single_precision * magnitude);
        EXPECT_NEAR(moment["sums"]["stress_pa"][1].get<double>(), yy, single_precision * magnitude);
        const double forces = force_balance(state, base, 0.0).mean_contact *
                              static_cast<double>(std::ranges::count(touching(state), true));
        // Rounded: stiffness, overlap, their product, shear force.
        EXPECT_NEAR(moment["contact_forces_n"].get<double>(), forces,
                    4.0 * single_precision * forces);
        EXPECT_EQ(moment["surfaces"], base.surfaces.size());
        // The right wall is where the extension has brought it.
        EXPECT_FLOAT_EQ(moment["right_wall_x_m"].get<float>(),
                        static_cast<float>(scene.hanging_wall.length + state.clock.extension.m));
    }
    // The run has made strata and weak rock, which the numbers are about.
    EXPECT_GE(moments.back()["highest"]["stratum"], 2);
    EXPECT_EQ(moments.back()["highest"]["material"], weak);
    EXPECT_LT(moments.back()["bonded"], moments.back()["contacts"]);
}

TEST_F(ParaviewTest, OneCallShowsTheLastMoment) {
    ASSERT_TRUE(on_path("pvpython")) << "package python3-paraview";
    const fs::path picture = folder / "view.png";
    const std::string line =
        fmt::format("{}pvpython '{}' '{}' 2>'{}'", display(), (run / "paraview.py").string(),
                    picture.string(), (folder / "stderr").string());
    EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 0) << contents(folder / "stderr");
    EXPECT_THAT(contents(picture), HasSubstr("IEND"));
}

TEST_F(ParaviewTest, ThePictureShowsTheDiscs) {
    const Seen seen = look("picture.png");
    ASSERT_EQ(seen.code, 0) << seen.err;
    EXPECT_THAT(contents(folder / "picture.png"), HasSubstr("IEND"));
    const json picture = json::parse(seen.out)["picture"];
    const State state = read_snapshot(list_snapshots(run).back()).state;
    const ConstDiscColumns d = disc_columns(state);
    const double pixel = picture["metres_per_pixel"];
    // Single precision may shift a rim, here by at most a hundredth of a pixel.
    const double rims = 2.0 * pi * sum(d.radius) / pixel;
    EXPECT_NEAR(picture["pixels"]["discs"].get<double>(), covered_pixels(state, picture),
                0.01 * rims);
    // A line a pixel wide has as many pixels as its longer side. The ends of two lines may share
    // one, and each end may be a pixel longer or shorter.
    const ConstContactColumns c = contact_columns(state);
    double lines = 0.0, bonds = 0.0;
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (c.bonded[k]) {
            const auto i = static_cast<std::size_t>(c.first[k]);
            const auto j = static_cast<std::size_t>(c.second[k]);
            lines += std::max(std::abs(d.x[j] - d.x[i]), std::abs(d.y[j] - d.y[i])) / pixel;
            bonds += 1.0;
        }
    EXPECT_NEAR(picture["pixels"]["bonds"].get<double>(), lines, 2.0 * bonds);
    // Two pixels wide: at least the flat and the right wall.
    EXPECT_GT(picture["pixels"]["base"].get<double>(),
              2.0 * (scene.hanging_wall.length + scene.hanging_wall.thickness) / pixel);
}

TEST_F(ParaviewTest, DamageIsNoticed) {
    const fs::path series = run / "paraview.pvd", whole = folder / "whole";
    fs::copy(run, whole, fs::copy_options::recursive);
    const std::size_t discs = read_snapshot(list_snapshots(run).back()).state.discs.rows();
    // Message that is expected, and the damage that causes it.
    const std::vector<std::pair<std::string, std::function<void()>>> damages = {
        {"radius_x", [&] { replace(last("discs"), "radius_m", "radius_x"); }},
        {"stress of", [&] { replace(last("discs"), "\"XY\"", "\"XZ\""); }},
        {"not finite", [&] { end_in_infinity(last("discs"), "radius_m", discs); }},
        {"parts at", [&] { replace(series, "name=\"base\"", "nama=\"base\""); }},
        {"contacts", [&] { fs::remove(last("contacts")); }},
        {"discs", [&] { fs::resize_file(last("discs"), fs::file_size(last("discs")) / 2); }},
    };
    EXPECT_EQ(look().code, 0);
    for (const auto& [said, damage] : damages) {
        damage();
        const Seen seen = look();
        EXPECT_EQ(seen.code, 1) << said;
        EXPECT_THAT(seen.err, HasSubstr(said));
        fs::remove_all(run);
        fs::copy(whole, run, fs::copy_options::recursive);
    }
}

} // namespace
} // namespace listric::paraview_test
