#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "coupling/elastic_base.hpp"
#include "fem/footwall.hpp"

namespace listric {

/// The elastic footwall under the discs of a scene.
fem::FootwallRequest make_footwall_request(const Scene& scene, const ModelParts& parts);

/// How it is coupled to them. `node_spacing` in m.
coupling::CouplingParameters make_coupling_parameters(const Scene& scene, const ModelParts& parts,
                                                      double node_spacing);

} // namespace listric
