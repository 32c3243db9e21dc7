#pragma once

#include "apps/model/bending_base.hpp"
#include "apps/scene/scene.hpp"
#include "coupling/elastic_base.hpp"
#include "fem/footwall.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// Footwall and basement that bend and float.
struct ElasticBaseParameters {
    BendingBase bending;

    // Under discs.
    std::optional<double> isotherm; ///< where strength ends, in place of Te, degrees Celsius
    double depth = 30e3;            ///< of the base's lower boundary, m
    double relaxation = 100.0;      ///< shear modulus over that below the elastic thickness
    double skin_thickness = 3e3;    ///< rock along the detachment that is not relaxed, m
    double cell_size = 1000.0;      ///< elements at the detachment, m
    std::vector<fem::Layer> layers; ///< rock by depth; none: one of the values above
    std::string mesh_file;          ///< Gmsh .msh instead of elements made from the scene
    fem::Side left_side = fem::Side::roller, right_side = fem::Side::roller;
    int refinements = 0;        ///< times that all elements are halved
    int update_interval = 5;    ///< cycles
    int modes = 100;            ///< 0: all
    double mass_factor = 0.6;   ///< of the modes
    double swing_damping = 0.1; ///< of the modes with the discs, over critical
};

/// Whether rock of it relaxes.
inline bool relaxes(const ElasticBaseParameters& base) {
    return std::ranges::any_of(base.layers,
                               [](const fem::Layer& layer) { return layer.viscosity.has_value(); });
}

/// Whether its stiffness changes in a run: then it moves in all its modes.
inline bool changes(const ElasticBaseParameters& base) { return relaxes(base) || base.isotherm; }

/// Parameters of a scene's base; null where it does not bend.
inline const ElasticBaseParameters* elastic_base(const Scene& scene) {
    return scene.find<ElasticBaseParameters>();
}

} // namespace listric
