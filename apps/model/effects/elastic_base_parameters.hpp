#pragma once

#include "apps/scene/scene.hpp"
#include "coupling/elastic_base.hpp"
#include "fem/footwall.hpp"

#include <string>
#include <vector>

namespace listric {

/// Footwall and basement that bend and float.
struct ElasticBaseParameters {
    double elastic_thickness = 10e3; ///< effective elastic thickness Te, m
    double young_modulus = 70e9;     ///< Pa
    double poisson_ratio = 0.25;
    double crust_density = 2700.0;  ///< kg/m^3
    double mantle_density = 3300.0; ///< kg/m^3
    double infill_density = 0.0;    ///< of what fills the deflection, kg/m^3
    int cells = 8;                  ///< elements through the elastic thickness, without discs
    int degree = 2;                 ///< of the elements

    // Under discs.
    double left = -300e3, right = 350e3; ///< x of the far sides, m
    double depth = 30e3;                 ///< of the base's lower boundary, m
    double relaxation = 100.0;           ///< shear modulus over that below the elastic thickness
    double skin_thickness = 3e3;         ///< rock along the detachment that is not relaxed, m
    double cell_size = 1000.0;           ///< elements at the detachment, m
    std::vector<fem::Layer> layers;      ///< rock by depth; none: one of the values above
    std::string mesh_file;               ///< Gmsh .msh instead of elements made from the scene
    fem::Side left_side = fem::Side::roller, right_side = fem::Side::roller;
    fem::Solver solver = fem::Solver::mumps;
    int refinements = 0; ///< times that all elements are halved
    coupling::CouplingScheme scheme = coupling::CouplingScheme::modal;
    int update_interval = 5;    ///< cycles
    int modes = 100;            ///< 0: all
    double mass_factor = 0.6;   ///< of the modes
    double swing_damping = 0.1; ///< of the modes with the discs, over critical
};

/// Parameters of a scene's base; null where it does not bend.
inline const ElasticBaseParameters* elastic_base(const Scene& scene) {
    return scene.find<ElasticBaseParameters>();
}

} // namespace listric
