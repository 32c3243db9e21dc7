#include "fem/material.hpp"

#include "fem/relaxation.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace listric::fem {

ElasticRock::ElasticRock(const FootwallRequest& request, Curve detachment)
    : layers_(request.layers), elastic_thickness_(request.elastic_thickness),
      relaxation_(request.relaxation), skin_thickness_(request.skin_thickness), step_(request.step),
      isotherm_(request.isotherm), detachment_(std::move(detachment)) {
    assert(!layers_.empty() && relaxation_ >= 1.0);
}

namespace {

/// Gives rock another shear modulus; that of bulk stays.
void stiffen(Rock& rock, double factor) {
    const double bulk = rock.lambda + 2.0 / 3.0 * rock.mu;
    rock.mu *= factor;
    rock.lambda = bulk - 2.0 / 3.0 * rock.mu;
}

} // namespace

bool ElasticRock::is_hot(Vector place) const {
    if (isotherm_.empty())
        return false;
    const auto right = std::ranges::lower_bound(isotherm_, place.x, {}, &Vector::x);
    if (right == isotherm_.begin() || right == isotherm_.end())
        return place.y < (right == isotherm_.end() ? isotherm_.back() : *right).y;
    const Vector a = *(right - 1), b = *right;
    return place.y < a.y + (b.y - a.y) * (place.x - a.x) / (b.x - a.x);
}

bool ElasticRock::is_in_skin(Vector place) const {
    return skin_thickness_ > 0.0 && !detachment_.empty() &&
           detachment_.distance(place) <= skin_thickness_;
}

Rock ElasticRock::at_once(Vector place) const {
    const Layer* layer = &layers_.front();
    for (const Layer& below : layers_)
        if (-place.y >= below.top_depth)
            layer = &below;
    const double e = layer->young_modulus, nu = layer->poisson_ratio;
    const double bulk = e / (3.0 * (1.0 - 2.0 * nu));
    Rock rock{0.0, e / (2.0 * (1.0 + nu)), layer->density, false};
    const bool is_below = isotherm_.empty()
                              ? elastic_thickness_ > 0.0 && -place.y > elastic_thickness_
                              : is_hot(place);
    if ((is_below || layer->viscosity || !isotherm_.empty()) && !is_in_skin(place)) {
        if (is_below)
            rock.mu /= relaxation_;
        else if (layer->viscosity)
            rock.relaxation_time = *layer->viscosity / rock.mu;
        rock.relaxed = is_below;
        rock.remembers = !isotherm_.empty() || (layer->viscosity && !is_below);
    }
    rock.lambda = bulk - 2.0 / 3.0 * rock.mu;
    return rock;
}

Rock ElasticRock::at(Vector place) const {
    Rock rock = at_once(place);
    const Maxwell over_step = maxwell(step_, rock.relaxation_time);
    if (over_step.share == 1.0)
        return rock;
    stiffen(rock, over_step.share);
    rock.decay = over_step.decay;
    rock.relaxed = over_step.share < 0.5;
    return rock;
}

} // namespace listric::fem
