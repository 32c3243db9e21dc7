#include "apps/figures/flexure_figure.hpp"

#include "apps/support/machine/python.hpp"

namespace listric {

namespace fs = std::filesystem;

void draw_flexure(const fs::path& output, const fs::path& pictures, const PictureOrder& order) {
    std::error_code error;
    fs::create_directories(pictures, error);
    run_drawing_script("flexure.py", {fs::absolute(output).string(),
                                      fs::absolute(pictures).string(), order.text()});
}

} // namespace listric
