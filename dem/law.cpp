#include "dem/law.hpp"

namespace listric::dem {

namespace {

double series(double a, double b) { return a > 0.0 && b > 0.0 ? a * b / (a + b) : 0.0; }

} // namespace

ContactParameters contact_parameters(const Material& a, const Material& b, double time_step) {
    const double friction = std::min(a.friction, b.friction);
    return {static_cast<float>(series(a.normal_stiffness, b.normal_stiffness)),
            static_cast<float>(series(a.shear_stiffness, b.shear_stiffness) * time_step),
            static_cast<float>(friction),
            static_cast<float>(std::min({a.rolling_friction, b.rolling_friction, friction}))};
}

ContactParameters base_contact_parameters(const Material& wall, const Material& disc,
                                          double time_step) {
    ContactParameters parameters = contact_parameters(wall, disc, time_step);
    parameters.friction = static_cast<float>(disc.friction);
    parameters.rolling_friction = static_cast<float>(disc.rolling_friction);
    return parameters;
}

PairParameters::PairParameters(std::span<const Material> materials, double time_step)
    : count_(materials.size()) {
    for (const Material& a : materials)
        for (const Material& b : materials)
            table_.push_back(contact_parameters(a, b, time_step));
}

} // namespace listric::dem
