#include "apps/figures/flexure_figure.hpp"

#include "apps/support/python.hpp"

namespace listric {

namespace fs = std::filesystem;

void draw_flexure(const fs::path& output, const PictureOrder& order) {
    std::error_code error;
    fs::create_directories(output / "figures", error);
    const fs::path run = fs::absolute(output);
    run_drawing_script("flexure.py", {run.string(), (run / "figures").string(), order.text()});
}

} // namespace listric
