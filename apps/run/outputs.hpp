#pragma once

#include "apps/run/output.hpp"

#include <optional>

// The program's outputs, each in outputs/NAME.cpp, in the order in which they are told:
// - scene.toml comes first, for a folder is resumed by it.
// - The history comes before all that is named by moments: its rows say where windows end. A
//   snapshot holds it.
// - Snapshots come before what can be made again from them, and takes longer.
// - Pictures are drawn by a process beside what comes next. They follow faults back, which the
//   report shows, too.
// - The dilation of rock is measured once, at the end, against the first snapshot.
// - The summary holds what outputs before it have added; the report shows the summary.
// - The results are for people, who are told once all is there.
// - The status says that all the others are there.
// - What a lean run need not keep goes last.
// clang-format off
#define LISTRIC_OUTPUTS(OUTPUT) \
    OUTPUT(scene_copy) \
    OUTPUT(history) \
    OUTPUT(haste) \
    OUTPUT(snapshots) \
    OUTPUT(pictures) \
    OUTPUT(paraview) \
    OUTPUT(base_check) \
    OUTPUT(dilation) \
    OUTPUT(observed) \
    OUTPUT(summary) \
    OUTPUT(report) \
    OUTPUT(results) \
    OUTPUT(status) \
    OUTPUT(thinning)
// clang-format on

namespace listric {

namespace outputs {
#define OUTPUT(name) std::optional<Output> name(const RunView& run);
LISTRIC_OUTPUTS(OUTPUT)
#undef OUTPUT
} // namespace outputs

inline OutputList program_outputs() {
#define OUTPUT(name) outputs::name,
    static constexpr MakeOutput list[] = {LISTRIC_OUTPUTS(OUTPUT)};
#undef OUTPUT
    return list;
}

} // namespace listric
