#include "thermal/geotherm.hpp"

#include "dem/numbers/elementary.hpp"

#include <algorithm>

namespace listric::thermal {

double sediment_conductivity(double grains, double porosity) {
    return grains * dem::power(water_conductivity / grains, porosity);
}

Geotherm::Geotherm(const HeatParameters& p) : p_(p) {
    const double mantle = (p.lithosphere - p.crust) / p.mantle_conductivity; // resistance
    const double crust = p.crust / p.conductivity, made = p.heat_production * p.crust;
    surface_flow_ = (p.base_temperature - p.surface_temperature + made * (0.5 * crust + mantle)) /
                    (crust + mantle);
    mantle_flow_ = surface_flow_ - made;
}

double Geotherm::at(double depth) const {
    const double z = std::clamp(depth, 0.0, p_.crust);
    const double in_crust = p_.surface_temperature + surface_flow_ * z / p_.conductivity -
                            p_.heat_production * z * z / (2.0 * p_.conductivity);
    return in_crust + mantle_flow_ / p_.mantle_conductivity *
                          (std::clamp(depth, p_.crust, p_.lithosphere) - p_.crust);
}

std::optional<double> Geotherm::depth_of(double temperature) const {
    if (temperature < p_.surface_temperature || temperature > p_.base_temperature)
        return std::nullopt;
    double above = 0.0, below = p_.lithosphere;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (above + below);
        (at(middle) < temperature ? above : below) = middle;
    }
    return above;
}

} // namespace listric::thermal
