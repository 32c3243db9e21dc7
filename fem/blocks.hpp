#pragma once

#include "fem/curve.hpp"

#include <array>
#include <vector>

namespace listric::fem {

enum class EdgeCurve { straight = 0, detachment = 1, skin = 2 };

/// Coarse quadrilaterals that follow the detachment; halving them gives the mesh.
struct BlockMesh {
    struct Cell {
        std::array<unsigned, 4> vertices; ///< lower left, lower right, upper left, upper right
    };
    struct Edge {
        unsigned start, end;
        int boundary = 0; ///< a Boundary, or 0 inside
        EdgeCurve curve = EdgeCurve::straight;
    };
    std::vector<Vector> vertices;
    std::vector<Cell> cells;
    std::vector<Edge> edges; ///< those on a boundary or a curve
    Curve detachment;        ///< extended to the right side
    Curve skin;              ///< its lower edge, where the strip of cells along the detachment ends
    unsigned halvings = 0;   ///< that lead to the requested cell size
};

/// The detachment extended to the right side. Throws FootwallError if it leaves the mesh.
Curve extended_detachment(const FootwallRequest& request);

/// Blocks between the detachment and the base. Where the detachment is steeper than 45 degrees,
/// rows of cells end at it; where it is flatter, columns do; a strip of cells lies along it.
BlockMesh make_blocks(const FootwallRequest& request);

} // namespace listric::fem
