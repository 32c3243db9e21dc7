#include "apps/base_figure.hpp"

#include "apps/figures.hpp"
#include "apps/run_folder.hpp"
#include "apps/snapshot.hpp"

#include <fmt/format.h>

namespace listric {

namespace fs = std::filesystem;

void draw_base(const fs::path& output) {
    std::string table = "extension_m,x_m,y_m,ux_m,uy_m\n";
    for (const fs::path& path : list_snapshots(output)) {
        const State state = read_snapshot(path).state;
        const ConstBaseNodeColumns nodes = base_node_columns(state);
        for (std::size_t k = 0; k < nodes.x.size(); ++k)
            table += fmt::format("{:.2f},{:.2f},{:.2f},{:.4f},{:.4f}\n", state.clock.extension,
                                 nodes.x[k], nodes.y[k], nodes.ux[k], nodes.uy[k]);
    }
    write_text(output / "base.csv", table);
    const std::string problem =
        run_drawing_script("base.py", {output.string(), (output / "figures").string()});
    if (!problem.empty())
        throw StorageError(problem);
}

} // namespace listric
