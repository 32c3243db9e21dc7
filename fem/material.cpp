#include "fem/material.hpp"

#include <cassert>
#include <utility>

namespace listric::fem {

ElasticRock::ElasticRock(const FootwallRequest& request, Curve detachment)
    : layers_(request.layers), elastic_thickness_(request.elastic_thickness),
      relaxation_(request.relaxation), skin_thickness_(request.skin_thickness),
      detachment_(std::move(detachment)) {
    assert(!layers_.empty() && relaxation_ >= 1.0);
}

Rock ElasticRock::at(Vector place) const {
    const Layer* layer = &layers_.front();
    for (const Layer& below : layers_)
        if (-place.y >= below.top_depth)
            layer = &below;
    const double e = layer->young_modulus, nu = layer->poisson_ratio;
    const double bulk = e / (3.0 * (1.0 - 2.0 * nu));
    Rock rock{0.0, e / (2.0 * (1.0 + nu)), layer->density, false};
    if (elastic_thickness_ > 0.0 && -place.y > elastic_thickness_ &&
        (skin_thickness_ <= 0.0 || detachment_.empty() ||
         detachment_.distance(place) > skin_thickness_)) {
        rock.mu /= relaxation_;
        rock.relaxed = true;
    }
    rock.lambda = bulk - 2.0 / 3.0 * rock.mu;
    return rock;
}

} // namespace listric::fem
