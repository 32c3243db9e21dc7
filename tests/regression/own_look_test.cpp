// Layers of an effect that the program does not have, from its description alone: they are in what
// the figures' scripts read and in the report. How a layer is drawn by its kind is tested where
// pictures are: python_figures_test.py, report_test.py.

#include "apps/figures/frame.hpp"
#include "tests/regression/speed_gauge.hpp"
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

class OwnLook : public SceneRuns {};

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
