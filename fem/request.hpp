#pragma once

// Description of a footwall, in plain numbers.

#include "fem/vector.hpp"

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace listric::fem {

/// Straight or circular piece of the detachment. The footwall lies to the right of its direction.
struct Piece {
    Vector start;           ///< m
    double direction = 0.0; ///< of travel at the start: angle from +x, rad; downward negative
    double length = 0.0;    ///< m
    double curvature = 0.0; ///< 1/m; > 0 turns left, away from the footwall
};

/// Rock from a depth down to the next layer's.
struct Layer {
    double top_depth = 0.0;               ///< m below y = 0
    double young_modulus = 70e9;          ///< Pa
    double poisson_ratio = 0.25;          ///< below 0.5
    double density = 2700.0;              ///< kg/m^3, for output; springs have their own
    std::optional<double> viscosity = {}; ///< with which its shear relaxes, Pa s; none: never
};

enum class Boundary { left = 1, base = 2, right = 3, surface = 4, detachment = 5 };

/// Support of a far side: none, no horizontal motion, or springs of the stiffness of as much
/// rock again, (lambda + 2 mu) / width, held beyond.
enum class Side { free, roller, elastic };

enum class Solver {
    mumps,     ///< Cholesky factors; needed for the compliance
    boomeramg, ///< conjugate gradients with hypre's algebraic multigrid
    gamg       ///< multigrid of PETSc, which knows the rigid motions
};

struct FootwallRequest {
    std::vector<Piece> detachment; ///< from the breakaway at (0, 0) down; none: a flat layer
    double left = -300e3;          ///< x of the far sides, m
    double right = 350e3;
    double depth = 30e3; ///< of the base, m
    Side left_side = Side::roller, right_side = Side::roller;

    std::vector<Layer> layers = std::vector<Layer>(1); ///< by depth, the first from 0
    /// Below this depth, m, rock keeps its bulk modulus and has its shear modulus divided by
    /// `relaxation`: a crust that is no longer rigid but still incompressible. 0: nowhere.
    double elastic_thickness = 0.0;
    double relaxation = 100.0;
    /// In its place, a line whose x ascends, level beyond its ends, m: rock that gets below it, hot
    /// as that is, sheds its stress, and rock that comes above it begins with what it has. See
    /// Footwall::take_isotherm(). Empty: none.
    std::vector<Vector> isotherm = {};
    /// Rock within this distance of the detachment, m, is never relaxed and has no viscosity.
    double skin_thickness = 0.0;
    double step = 0.0; ///< of relaxation by viscosity, s: see Footwall::take_step()

    /// Vertical springs at the density contrasts: Pa per m of vertical displacement, on the
    /// horizontal projection of the boundary. rho_c g above, (rho_m - rho_c) g at the base. On the
    /// detachment the rock's overburden, -rho_c g y, is taken along: forces there are on the
    /// undeformed boundary, in the direction that they have.
    double surface_spring = 0.0, detachment_spring = 0.0, base_spring = 0.0;

    int degree = 2;                     ///< of the elements: 1 or 2
    int refinements = 0;                ///< times that all cells are halved on top
    double cell_size = 1000.0;          ///< near the detachment, m
    std::vector<double> surface_breaks; ///< x where cells of a flat layer meet: edges of loads, m
    double fine_until = 60e3;           ///< cells grow beyond this x, m
    /// The interface ends here, m; by default one node before the right side.
    double interface_end = std::numeric_limits<double>::infinity();
    std::string mesh_file; ///< Gmsh .msh to use instead of the mesh made from the detachment
    Solver solver = Solver::mumps;
};

/// A file that cannot be written.
struct WriteError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Input that makes no footwall; what() says what is wrong and what is allowed.
struct FootwallError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace listric::fem
