// Layers of an effect that the program does not have, from its description alone: they are in what
// the figures' scripts read, in their pictures and in the report.

#include "apps/figures/frame.hpp"
#include "tests/regression/runs/speed_gauge.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>
#include <zlib.h>

#include <string_view>

namespace listric::own_look_test {

using namespace dem;
namespace {

using namespace support;
using nlohmann::json;
using testing::Contains;
using testing::HasSubstr;

/// The text that zlib packed and that is in base64 between quotes at this place.
std::string unpacked(const std::string& text, std::size_t place) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned bits = 0;
    for (int n = 0; digits.find(text[place]) != digits.npos; ++place) {
        bits = bits << 6 | static_cast<unsigned>(digits.find(text[place]));
        if (++n % 4 != 1)
            bytes += static_cast<char>(bits >> (6 - 2 * ((n - 1) % 4)) & 255u);
    }
    std::string whole(1'000'000, ' ');
    uLongf size = whole.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(whole.data()), &size,
                         reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
              Z_OK);
    return whole.substr(0, size);
}

/// How many pixels of all pictures in a folder have the colour "#rrggbb".
int pixels(const std::filesystem::path& pictures, const std::string& ink) {
    constexpr const char* script = R"(import sys
from pathlib import Path
from matplotlib.colors import to_rgb
from matplotlib.image import imread
print(sum(int((abs(imread(file)[..., :3] - to_rgb(sys.argv[1])).max(axis=2) < 1 / 256).sum())
          for file in Path(sys.argv[2]).glob('*.png'))))";
    const std::string call =
        fmt::format("/usr/bin/python3 -I -c \"{}\" '{}' '{}'", script, ink, pictures.string());
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(call.c_str(), "r"), pclose);
    int found = -1;
    EXPECT_EQ(std::fscanf(pipe.get(), "%d", &found), 1) << call;
    return found;
}

class OwnLook : public SceneRuns {};

// From one description to the picture: without the effect no pixel has its inks.
TEST_F(OwnLook, LayersAreInThePictures) {
    unsetenv("LISTRIC_PYTHON");
    for (const bool is_on : {true, false}) {
        const Scene scene = load_scene({.scene = test_scene("every-effect.toml"),
                                        .set = is_on ? std::vector<std::string>{"speed_gauge={}"}
                                                     : std::vector<std::string>{}},
                                       effects_and_gauge());
        RunOptions o = options(is_on ? "with" : "without");
        o.until = 50.0;
        run_scene(scene, o);
        for (const char* ink : {"#8e24aa", "#00695c"})
            if (is_on)
                EXPECT_GT(pixels(o.output / "figures", ink), 100) << ink;
            else
                EXPECT_EQ(pixels(o.output / "figures", ink), 0) << ink;
    }
}

TEST_F(OwnLook, LayersAreInFiguresAndReport) {
    const Scene scene = load_scene(
        {.scene = test_scene("every-effect.toml"), .set = {"speed_gauge={}"}}, effects_and_gauge());
    const RunOptions o = options("look");
    run(scene, o);

    const json discs{{"name", "layer_fast_discs"},
                     {"kind", "discs"},
                     {"label", "greatest speed"},
                     {"ink", "#8e24aa"}};
    const json line{{"name", "layer_gauge_level"},
                    {"kind", "line"},
                    {"label", "level of the gauge"},
                    {"ink", "#00695c"}};
    const RunFolder left(o.output, scene);
    const Moment last = left.read(left.snapshots.back());
    const std::filesystem::path frame = folder / "frame";
    const Observation now{left.scene, left.parts, last.state, last.events};
    write_frame(now, {}, frame);
    const json layers = json::parse(contents(frame / "frame.json"))["layers"];
    EXPECT_THAT(layers, Contains(discs));
    EXPECT_THAT(layers, Contains(line));
    const auto numbers = [&](const char* name) { // of an .npy file, behind 128 bytes
        return (std::filesystem::file_size(frame / name) - 128) / sizeof(double);
    };
    EXPECT_EQ(numbers("layer_fast_discs.npy"), last.state.discs.rows());
    EXPECT_EQ(numbers("layer_gauge_level.npy"), 4u);

    const std::string report = contents(o.output / "report.html");
    EXPECT_THAT(report, HasSubstr(discs.dump()));
    EXPECT_THAT(report, HasSubstr(line.dump()));
    EXPECT_THAT(report, HasSubstr("\"layer_fast_discs\":["));
    const std::string key = "\"lines\":\"";
    const json lines = json::parse(unpacked(report, report.rfind(key) + key.size()));
    EXPECT_EQ(lines["layers"]["layer_gauge_level"], json(speed_gauge().layers[1].rows(now)));
}

} // namespace
} // namespace listric::own_look_test
