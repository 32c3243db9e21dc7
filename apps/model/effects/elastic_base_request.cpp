#include "apps/model/effects/elastic_base_request.hpp"
#include "apps/scene/parameters/stage.hpp"

#include "apps/model/effects/elastic_base_parameters.hpp"
#include "coupling/creep.hpp"
#include "dem/numbers/elementary.hpp"

#include <cmath>

namespace listric {

using namespace dem;
using namespace coupling;

fem::FootwallRequest make_footwall_request(const Scene& scene, const ModelParts& parts) {
    const auto& base = *elastic_base(scene);
    const double gravity = parts.gravity;
    fem::FootwallRequest request;
    for (const Segment& s : parts.base.surfaces.front().chain)
        request.detachment.push_back({{s.start.x, s.start.y},
                                      dem::arc_tangent(s.start_tangent.y, s.start_tangent.x),
                                      s.length,
                                      s.curvature});
    request.left = base.bending.left;
    request.right = base.bending.right;
    request.depth = base.depth;
    request.layers = base.layers;
    if (request.layers.empty())
        request.layers = {{0.0, base.bending.young_modulus, base.bending.poisson_ratio,
                           base.bending.crust_density}};
    request.mesh_file = base.mesh_file;
    request.left_side = base.left_side;
    request.right_side = base.right_side;
    request.solver = base.bending.solver;
    request.refinements = base.refinements;
    request.elastic_thickness = base.bending.elastic_thickness;
    if (base.isotherm) { // elements of the start end at it
        request.elastic_thickness = parts.depth_of_temperature(*base.isotherm).value_or(base.depth);
        request.isotherm = {{base.bending.left, -request.elastic_thickness},
                            {base.bending.right, -request.elastic_thickness}};
    }
    request.relaxation = base.relaxation;
    request.skin_thickness = base.skin_thickness;
    // Springs at the density contrasts. All of them at the base would leave the plate floating on
    // rock that carries nothing. Linear springs take infill for both signs: as if it lay on the
    // flank, too, where the surface rises.
    request.surface_spring = (base.bending.crust_density - base.bending.infill_density) * gravity;
    request.detachment_spring = base.bending.crust_density * gravity;
    request.base_spring = (base.bending.floats_on() - base.bending.crust_density) * gravity;
    if (relaxes(base))
        request.step = creep_schedule(make_calendar(scene)).seconds(1);
    request.degree = base.bending.degree;
    request.cell_size = base.cell_size;
    // Discs are left of the right wall; the last contact's face reaches a little further.
    const double reach = scene.hanging_wall.length + greatest_extension(scene);
    request.interface_end = reach + 3.0 * base.cell_size;
    request.fine_until = reach + 10.0 * base.cell_size;
    return request;
}

CouplingParameters make_coupling_parameters(const Scene& scene, const ModelParts& parts,
                                            double node_spacing) {
    const auto& base = *elastic_base(scene);
    CouplingParameters p;
    p.interval = base.update_interval;
    p.modes = base.modes;
    p.mass_factor = base.mass_factor;
    p.swing_damping = base.swing_damping;
    p.damping = scene.cycle.damping;
    p.contact_stiffness = node_stiffness(scene.basement, parts.materials, node_spacing,
                                         scene.hanging_wall.mean_radius);
    p.gravity = parts.physics.gravity;
    p.wall_x = scene.hanging_wall.length;
    return p;
}

} // namespace listric
