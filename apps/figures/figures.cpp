#include "apps/figures/figures.hpp"

#include "apps/figures/frame.hpp"
#include "apps/support/error.hpp"
#include "apps/support/python.hpp"

#include <fmt/format.h>

#include <exception>

namespace listric {

using namespace measures;

namespace fs = std::filesystem;

FigureFrames::FigureFrames(const fs::path& folder) : folder_(folder), data_(folder) {}

void FigureFrames::add(const Observation& now, const FaultReport& faults) {
    write_frame(now, faults, data_.path / fmt::format("{:06d}", frames_++));
}

void FigureFrames::draw(const std::string& kind) const {
    const std::string problem =
        run_drawing_script("figures.py", {kind, data_.path.string(), folder_.string()});
    if (!problem.empty())
        throw StorageError(problem);
}

std::string draw_figures(const Observation& now, const FaultReport& faults,
                         const fs::path& folder) {
    try {
        FigureFrames frames(folder);
        frames.add(now, faults);
        frames.draw("sections");
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

} // namespace listric
