#include "apps/scene/base_words.hpp"

#include <fmt/format.h>

namespace listric {

using dem::BaseKind;

std::string base_name(BaseKind base) {
    return base == BaseKind::sheet   ? "sheet (pulls)"
           : base == BaseKind::rests ? "rests (resists)"
                                     : "ramp (resists, the flat pulls)";
}

std::string base_words(const Scene& scene) {
    if (!scene.detachment)
        return "the base stretches uniformly between the walls and pulls the discs along";
    const double flat = dem::sole_out(dem::detachment_chain(*scene.detachment, 0.0));
    switch (scene.detachment->base) {
    case BaseKind::sheet:
        return "sheet: the whole detachment moves with the right wall and pulls the discs along, "
               "as a plastic sheet does in a sandbox; nothing of it resists";
    case BaseKind::rests:
        return "rests: the footwall is at rest and resists along the whole detachment; the right "
               "wall alone moves";
    case BaseKind::ramp:
        break;
    }
    return fmt::format(
        "ramp: the footwall is at rest and resists down to the sole-out point at x = "
        "{:g} km; the flat beyond moves with the right wall and pulls",
        flat / 1e3);
}

} // namespace listric
