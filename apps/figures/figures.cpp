#include "apps/figures/figures.hpp"

#include "apps/archive/provenance.hpp"
#include "apps/figures/frame.hpp"
#include "apps/support/python.hpp"

#include <fmt/format.h>

#include <exception>
#include <memory>
#include <utility>

namespace listric {

using namespace measures;

namespace fs = std::filesystem;

FigureFrames::FigureFrames(const fs::path& folder, std::optional<Underlay> underlay,
                           PictureOrder order, std::optional<MomentNames> names)
    : folder_(folder), underlay_(std::move(underlay)), order_(std::move(order)),
      names_(std::move(names)), data_(folder) {}

void FigureFrames::add(const Observation& now, const FaultReport& faults) {
    write_frame(now, faults, data_.path / fmt::format("{:06d}", frames_++), underlay_, names_);
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
        problem = error.what();
    }
    return std::async(std::launch::async, [frames = std::move(frames), problem] {
        try {
            if (problem.empty())
                frames->draw("sections");
        } catch (const std::exception& error) {
            return std::string(error.what());
        }
        return problem;
    });
}

} // namespace listric
