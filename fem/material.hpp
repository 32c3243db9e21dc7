#pragma once

#include "fem/curve.hpp"

#include <limits>
#include <utility>
#include <vector>

namespace listric::fem {

/// Isotropic rock at a point.
struct Rock {
    double lambda = 0.0, mu = 0.0; ///< Lame's constants, of what happens in a step, Pa
    double density = 0.0;          ///< kg/m^3
    bool relaxed = false;          ///< carries little of its stress, if any, beyond a step
    double relaxation_time = std::numeric_limits<double>::infinity(); ///< s
    double decay = 1.0;     ///< of the stress's deviator in a step: see Maxwell
    bool remembers = false; ///< may have stress beside that of its strain
};

/// Where which rock is: layers by depth, relaxed below the elastic thickness or an isotherm, with
/// time where they have a viscosity; all of it but the skin.
class ElasticRock {
public:
    ElasticRock(const FootwallRequest& request, Curve detachment);

    Rock at(Vector place) const;      ///< over the step
    Rock at_once(Vector place) const; ///< as it answers at once
    void take_step(double seconds) { step_ = seconds; }
    void take_isotherm(std::vector<Vector> line) { isotherm_ = std::move(line); }

    bool is_hot(Vector place) const; ///< below the isotherm, if there is one

private:
    bool is_in_skin(Vector place) const;

    std::vector<Layer> layers_;
    double elastic_thickness_, relaxation_, skin_thickness_, step_;
    std::vector<Vector> isotherm_;
    Curve detachment_;
};

} // namespace listric::fem
