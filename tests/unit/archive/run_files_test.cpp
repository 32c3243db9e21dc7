// Which files of a folder are a run's, and in what scenes differ.

#include "apps/archive/folder/output_folder.hpp"
#include "apps/archive/folder/run_files.hpp"
#include "apps/archive/folder/scene_lines.hpp"
#include "tests/message_of.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace listric::archive::run_files_test {
namespace {

namespace fs = std::filesystem;

using testing::UnorderedElementsAreArray;

class RunFiles : public testing::Test {
protected:
    ~RunFiles() override { fs::remove_all(folder); }

    void write(const std::vector<std::string>& names) const {
        for (const std::string& name : names) {
            fs::create_directories((folder / name).parent_path());
            std::ofstream(folder / name) << "a file";
        }
    }

    std::vector<std::string> names(const std::vector<fs::path>& files) const {
        std::vector<std::string> result;
        for (const fs::path& file : files)
            result.push_back(file.lexically_relative(folder).string());
        return result;
    }

    fs::path folder = fs::path(testing::TempDir()) / ("listric-files-" + std::to_string(getpid()));
};

TEST_F(RunFiles, OfCallsWithoutARunReplaceOnlyTheirOwn) {
    write({"sweep.csv", "scene.toml"});
    const fs::path table = folder / "sweep.csv";
    const auto objection = [&](const std::string& mark, const std::vector<fs::path>& read) {
        const OwnFile written[]{{table, mark}, {folder / "none.csv", mark}};
        return support::message_of<UsageError>([&] { require_own(written, read); }, "");
    };
    EXPECT_EQ(objection("a file", {folder / "scene.toml", folder / "missing"}), "");
    EXPECT_THAT(objection("run,seed", {}), testing::HasSubstr("is no file of such a call"));
    EXPECT_THAT(objection("a file", {folder / "." / "sweep.csv"}),
                testing::HasSubstr("is read by this call"));
    std::ofstream(table).close(); // an empty one holds nothing
    EXPECT_EQ(objection("run,seed", {}), "");
}

TEST_F(RunFiles, HaveNamesAsTheProgramMakesThem) {
    const std::vector<std::string> ours = {
        "snapshots/extension-00000.00m.h5",
        "snapshots/extension-100000.01m.h5",
        "snapshots/extension-00000.0045m.h5",
        "paraview/discs-00100.02m.vtp",
        "paraview/footwall-00100.02m.vtu",
        "figures/strata-0.0km.png",
        "figures/experiment-10.0km.svg",
        "figures/animation-2.5km.mp4",
        "figures/animation-2.5km.webp",
        "figures/strata-seismic-depth-strain-5.0km-85mm.pdf",
        "figures/seismic-depth-5.0km.png",
        "figures/inversion-9.0km.png",
        "export/seismic-extension-00100.02m.segy",
        "export/seismic-extension-00100.02m-image.npy",
        "export/horizons-extension-00100.02m.geojson",
        "export/burial-extension-00100.02m.csv",
        "export/discs-extension-00100.02m.csv",
        "export/discs.gsd",
        "figures/strata-5.0km-plain.png",
        "figures/overview-5.0km-plain-600dpi.png",
        "figures/layer-overpressure-5.0km-72.5dpi.png",
        "figures/strata-layer-overpressure-5.0km-85mm-plain-600dpi.pdf",
        "figures/underlay-5.0km-10.5km-line_7-0123abcd-plain.png",
        "figures/well-5.0km-x-3750_12000m.png",
        "export/burial-extension-00100.02m-x-3300m.csv",
        "export/well-extension-00100.02m-x-1000_2000.25m.geojson",
        "export/discs-extension-00100.02m.gsd",
        "export/discs-extension-00100.02_00200.00m.gsd",
        "export/seismic-extension-00100.02m-depth-40Hz-lateral-500m.segy",
        "export/seismic-extension-00100.02m-lateral-500m-strain.npy",
        "export/seismic-extension-00100.02m-depth.json",
    };
    write(ours);
    write({"snapshots/._extension-00000.00m.h5",
           "snapshots/extension-0m.h5",
           "snapshots/extension-00000.00m.h5.bak",
           "snapshots/extension-000000.00m.h5",
           "snapshots/mine.h5",
           "paraview/discs-00100m.vtp",
           "paraview/discs-00100.02m.vtu",
           "figures/strata-map-5.0km-85mm.png",
           "figures/strata-5.0km-85mm.txt",
           "figures/strata-5.0km-widemm.png",
           "figures/5.0km-85mm.png",
           "figures/strata-25km.png",
           "figures/strata-5.0km-old.png",
           "figures/strata-5.0km-600dpi-plain.png",
           "figures/strata-5.0km-section-0123abcd.png",
           "figures/underlay-5.0km-mine.png",
           "figures/well-5.0km-x-m.png",
           "export/horizons-extension-00100.02m-x-3300m.csv",
           "export/burial-extension-00100.02m-old.csv",
           "export/seismic-extension-00100.02m-40Hz-depth.segy",
           "export/discs-mine.gsd",
           "figures/my-1.5km.png",
           "figures/strata-1.5km.gif",
           "figures/base.png",
           "export/discs-extension-00100.02m.gmt",
           "export/wells-m.geojson",
           "extension-00000.00m.h5",
           "base.csv",
           "scene.toml",
           "history.csv"});
    fs::create_directories(folder / "snapshots/extension-00200.00m.h5");
    EXPECT_THAT(names(run_files(folder)), UnorderedElementsAreArray(ours));
}

TEST_F(RunFiles, HalfWrittenOnesAreOnlyOurs) {
    const std::vector<std::string> ours = {"history.csv.123.part",
                                           "snapshots/extension-00100.02m.h5.9.part",
                                           "paraview/base-00100.02m.vtp.9.part",
                                           "figures/.strata-1.5km-123.tmp", "figures/.base-7.tmp"};
    write(ours);
    write({"thesis.2024.part", "history.csv.part", "snapshots/mine.h5.9.part", "figures/.map-1.tmp",
           "figures/.data-backup/a", "figures/history.csv.1.part"});
    EXPECT_THAT(names(remains(folder)), UnorderedElementsAreArray(ours));
}

TEST(LineDifference, NamesTableParameterAndValues) {
    const auto a =
        scene_values("seed = 1  # of all\n[gravity]\n[bonds]\nlist = [\n    {a = 1},\n]\n"
                     "[output]\ninterval_m = 5\nreport = true\nseries = \"none\"\n");
    const auto with = [](std::string text) { return scene_values(text); };
    EXPECT_FALSE(scene_difference(a, a));
    const auto b = scene_difference(
        a, with("seed = 1\n[gravity]\n[bonds]\nlist = [\n    {a = 2},\n]\n[output]\n"
                "interval_m = 5\nseries = \"none\"\n"));
    ASSERT_TRUE(b);
    EXPECT_EQ(b->parameter, "bonds.list");
    EXPECT_EQ(b->other, "[     {a = 2}, ]");
    const auto c = scene_difference(
        a, with("seed = 1\n[bonds]\nlist = [\n    {a = 1},\n]\n[output]\ninterval_m = 5\n"
                "series = \"none\"\n"));
    ASSERT_TRUE(c);
    EXPECT_EQ(c->parameter, "[gravity]");
    const auto d = with("seed = 1\nname = \"b\"\n[gravity]\n[bonds]\nlist = [\n    {a = 1},\n]\n"
                        "[output]\ninterval_m = 5\nseries = \"paraview\"\n");
    EXPECT_TRUE(scene_difference(a, d));
    EXPECT_FALSE(scene_difference(a, d, SceneScope::results));
}

TEST(LineDifference, AParameterThatAnEarlierProgramDidNotHaveHasItsDefault) {
    const auto earlier = scene_values("[sedimentation]\n");
    EXPECT_FALSE(scene_difference(earlier, scene_values("[sedimentation]\nlevel_m = 0.0\n")));
    const auto found = scene_difference(earlier, scene_values("[sedimentation]\nlevel_m = 1.0\n"));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->one, "0.0");
    EXPECT_TRUE(scene_difference(scene_values(""), scene_values("[sedimentation]\n")));
    const auto with_scheme = [](const char* name) {
        return scene_values(fmt::format("[elastic_base]\nscheme = \"{}\"\n", name));
    };
    const auto now = scene_values("[elastic_base]\n");
    EXPECT_FALSE(scene_difference(with_scheme("modal"), now));
    EXPECT_EQ(scene_difference(with_scheme("lumped"), now)->other, "\"modal\"");
}

} // namespace
} // namespace listric::archive::run_files_test
