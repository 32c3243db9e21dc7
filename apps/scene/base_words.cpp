#include "apps/scene/base_words.hpp"

#include "apps/scene/parameters/flat_base.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <fmt/format.h>

#include <cmath>

namespace listric {

using dem::BaseKind;

std::string base_name(BaseKind base) {
    return base == BaseKind::sheet   ? "sheet (pulls)"
           : base == BaseKind::rests ? "rests (resists)"
                                     : "ramp (resists, the flat pulls)";
}

namespace {

/// Blocks of basement, what they stand on apart.
std::string fault_words(const dem::BasementFault& fault, double distance) {
    const double slip = std::abs(fault.slip) * distance, angle = fault.dip * dem::pi / 180.0;
    const bool is_normal = fault.slip > 0.0;
    return fmt::format(
        "a {} fault of the basement dips by {:g} degrees to the right from x = {:g} km: the block "
        "on its right, and the right wall with it, moves {} the dip, {:g} m in all ({:.3g} m to "
        "the {} and {:.3g} m {})",
        is_normal ? "normal" : "reverse", fault.dip, fault.x / 1e3, is_normal ? "down" : "up", slip,
        slip * dem::cosine(angle), is_normal ? "right" : "left", slip * dem::sine(angle),
        is_normal ? "down" : "up");
}

std::string flat_base_words(const Scene& scene) {
    const auto fault = basement_fault(scene);
    const std::string moves = fault ? fault_words(*fault, scene.extension.distance) : "";
    if (scene.stretching)
        return "the base stretches uniformly between the walls and pulls the discs along" +
               (fault ? fmt::format("; {}, in proportion to the right wall's way, which it is a "
                                    "part of",
                                    moves)
                      : "");
    return fault ? moves + "; the block on its left and the left wall rest"
                 : "a flat base that moves as prescribed; both walls rest";
}

} // namespace

std::string base_words(const Scene& scene) {
    if (!scene.detachment)
        return flat_base_words(scene);
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
