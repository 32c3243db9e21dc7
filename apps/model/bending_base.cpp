#include "apps/model/bending_base.hpp"

#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

namespace listric {

std::string objection_to_densities(const BendingBase& base) {
    const bool flows = base.asthenosphere_density && base.floats_on() < base.mantle_density;
    const double floats_on = flows ? base.floats_on() : base.mantle_density;
    if (floats_on >= base.crust_density && base.crust_density >= base.infill_density)
        return "";
    return fmt::format("is {}, allowed: between those of infill ({}) and {} ({}), for the base to "
                       "float upright",
                       text(base.crust_density), text(base.infill_density),
                       flows ? "asthenosphere" : "mantle", text(floats_on));
}

std::string objection_to_fill(double density, const BendingBase& base) {
    if (density < base.floats_on())
        return "";
    return fmt::format("is {}, allowed: below the base's {}_density_kg_per_m3 = {}, else the "
                       "hollow that it fills sinks without end",
                       text(density), base.asthenosphere_density ? "asthenosphere" : "mantle",
                       text(base.floats_on()));
}

} // namespace listric
