#include "apps/model/bending_base.hpp"

#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

namespace listric {

std::string objection_to_densities(const BendingBase& base) {
    if (base.mantle_density >= base.crust_density && base.crust_density >= base.infill_density)
        return "";
    return fmt::format("is {}, allowed: between those of infill ({}) and mantle ({}), for the base "
                       "to float upright",
                       text(base.crust_density), text(base.infill_density),
                       text(base.mantle_density));
}

std::string objection_to_fill(double density, const BendingBase& base) {
    if (density < base.mantle_density)
        return "";
    return fmt::format("is {}, allowed: below the base's mantle_density_kg_per_m3 = {}, else the "
                       "hollow that it fills sinks without end",
                       text(density), text(base.mantle_density));
}

} // namespace listric
