#include "apps/studies/pictured_states.hpp"

#include "apps/archive/examine.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/folder/setting.hpp"
#include "apps/figures/figures.hpp"

#include <algorithm>
#include <cmath>

namespace listric {

using namespace archive;

void draw_states(std::span<const PicturedState> states, const std::string& kind,
                 const std::filesystem::path& file, StopToken stop) {
    const TemporaryFolder place(file.parent_path()); // a picture of that name may be somebody's
    FigureFrames figure(place.path);
    for (const PicturedState& state : states) {
        stop.check();
        RunFolder folder(state.run);
        folder.scene.description = state.caption;
        const auto distance = [&](const std::filesystem::path& snapshot) {
            return std::abs(snapshot_extension(snapshot) - *state.at);
        };
        const Moment moment =
            folder.read(state.at ? *std::ranges::min_element(folder.snapshots, {}, distance)
                                 : folder.snapshots.back());
        figure.add({folder.scene, folder.parts, moment.state, moment.events},
                   report_faults(make_setting(folder.scene, folder.parts), folder.parts.base,
                                 moment.state, RunHistory(folder)));
    }
    figure.draw(kind);
    std::filesystem::rename(place.path / (kind + ".png"), file);
}

} // namespace listric
