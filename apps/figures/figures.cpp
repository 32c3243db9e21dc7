#include "apps/figures/figures.hpp"

#include "apps/figures/frame.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/figure_layers.hpp"
#include "apps/support/error.hpp"
#include "apps/support/python.hpp"

#include <fmt/format.h>

#include <exception>

namespace listric {

using namespace dem;

namespace fs = std::filesystem;

FigureFrames::FigureFrames(const fs::path& folder) : folder_(folder), data_(folder) {}

void FigureFrames::add(const Scene& scene, const State& state, const RigidBase& base,
                       std::span<const std::unique_ptr<Event>> events, const FaultReport& faults) {
    write_frame({scene, state, base, events, faults, effect_names(scene),
                 figure_layers(scene, state), figure_numbers(scene)},
                data_.path / fmt::format("{:06d}", frames_++));
}

void FigureFrames::draw(const std::string& kind) const {
    const std::string problem =
        run_drawing_script("figures.py", {kind, data_.path.string(), folder_.string()});
    if (!problem.empty())
        throw StorageError(problem);
}

std::string draw_figures(const Scene& scene, const State& state, const RigidBase& base,
                         std::span<const std::unique_ptr<Event>> events, const FaultReport& faults,
                         const fs::path& folder) {
    try {
        FigureFrames frames(folder);
        frames.add(scene, state, base, events, faults);
        frames.draw("sections");
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

} // namespace listric
