#include "apps/figures/flexure_figure.hpp"

#include "apps/support/python.hpp"

namespace listric {

namespace fs = std::filesystem;

std::string draw_flexure(const fs::path& output, const PictureOrder& order) {
    std::error_code error;
    fs::create_directories(output / "figures", error);
    return run_drawing_script("flexure.py",
                              {output.string(), (output / "figures").string(), order.text()});
}

} // namespace listric
