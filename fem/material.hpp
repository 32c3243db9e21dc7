#pragma once

#include "fem/curve.hpp"

namespace listric::fem {

/// Isotropic rock at a point.
struct Rock {
    double lambda = 0.0, mu = 0.0; ///< Lame's constants, Pa
    double density = 0.0;          ///< kg/m^3
    bool relaxed = false;
};

/// Where which rock is: layers by depth, relaxed below the elastic thickness except in the skin.
class ElasticRock {
public:
    ElasticRock(const FootwallRequest& request, Curve detachment);
    Rock at(Vector place) const;

private:
    std::vector<Layer> layers_;
    double elastic_thickness_, relaxation_, skin_thickness_;
    Curve detachment_;
};

} // namespace listric::fem
