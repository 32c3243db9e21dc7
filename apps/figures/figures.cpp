#include "apps/figures/figures.hpp"

#include "apps/archive/folder/provenance.hpp"
#include "apps/figures/frame.hpp"
#include "apps/figures/sections/seismic_section.hpp"
#include "apps/support/files/npy.hpp"
#include "apps/support/machine/memory.hpp"
#include "apps/support/machine/python.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace listric {

using namespace measures;

namespace fs = std::filesystem;

namespace {

/// Arrays of a seismic section for a frame: amplitude, a row per trace, and the numbers of its
/// axes.
void write_seismic(const Observation& now, const fs::path& folder, const std::string& panel) {
    const SeismicSection section =
        seismic_section(now, {}, seismic_horizons(now), {.in_depth = panel != "seismic"});
    const SeismicOptions& o = section.options;
    std::string name = panel;
    std::ranges::replace(name, '-', '_');
    write_npy<float>(folder / (name + ".npy"), std::span<const float>(section.amplitude),
                     section.samples);
    const std::vector<double> axes{section.first_x, o.trace_spacing,   section.first_sample,
                                   o.frequency,     o.sample_interval, o.lateral};
    write_npy<double>(folder / (name + "_axes.npy"), std::span<const double>(axes));
}

} // namespace

FigureFrames::FigureFrames(const fs::path& folder, std::optional<Underlay> underlay,
                           PictureOrder order, std::optional<MomentNames> names)
    : folder_(folder), underlay_(std::move(underlay)), order_(std::move(order)),
      names_(std::move(names)), data_(folder) {}

void FigureFrames::add(const Observation& now, const FaultReport& faults) {
    const fs::path folder = data_.path / fmt::format("{:06d}", frames_++);
    write_frame(now, faults, folder, underlay_, names_);
    for (const char* panel : {"seismic", "seismic-depth"})
        if (order_.wants(panel))
            write_seismic(now, folder, panel);
}

void FigureFrames::draw(const std::string& kind) const {
    run_drawing_script("figures.py", {kind, fs::absolute(data_.path).string(),
                                      fs::absolute(folder_).string(), order_.text()});
}

std::future<std::string> draw_figures(const Observation& now, const FaultReport& faults,
                                      const fs::path& folder, const MomentNames& names) {
    std::unique_ptr<FigureFrames> frames;
    std::string problem;
    try {
        frames = std::make_unique<FigureFrames>(
            folder, std::nullopt, PictureOrder{.provenance = archive::provenance(now.scene)},
            names);
        frames->add(now, faults);
    } catch (const std::exception& error) {
        problem = words_of(error);
    }
    return std::async(std::launch::async, [frames = std::move(frames), problem] {
        try {
            if (problem.empty())
                frames->draw("sections");
        } catch (const std::exception& error) {
            return words_of(error);
        }
        return problem;
    });
}

} // namespace listric
