#include "apps/archive/folder/run_folder.hpp"
#include "apps/run/outputs.hpp"
#include "apps/run/run_view.hpp"

namespace listric {

std::optional<Output> outputs::thinning(const RunView& run) {
    if (run.options.lean == Lean::no)
        return std::nullopt;
    return Output{.enter = [](RunView& view) {
        if (view.phase == Phase::finished)
            archive::thin_out(view.options.output, view.options.lean == Lean::all);
    }};
}

} // namespace listric
