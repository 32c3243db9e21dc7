#pragma once

#include "fem/curve.hpp"

#include <deal.II/distributed/tria.h>
#include <deal.II/grid/manifold_lib.h>

#include <memory>

namespace listric::fem {

constexpr dealii::types::boundary_id id_of(Boundary boundary) {
    return static_cast<dealii::types::boundary_id>(boundary);
}

inline Vector plain(const dealii::Point<2>& p) { return {p[0], p[1]}; }

/// Cells of the footwall with the curves that new vertices come to lie on.
struct Mesh {
    std::unique_ptr<dealii::parallel::distributed::Triangulation<2>> cells;
    std::unique_ptr<dealii::TransfiniteInterpolationManifold<2>> interior;
    Curve detachment; ///< empty: a flat layer, whose interface is its surface
};

/// From the detachment, or from the request's .msh file. Throws FootwallError.
Mesh make_mesh(const FootwallRequest& request, MPI_Comm processes);

} // namespace listric::fem
