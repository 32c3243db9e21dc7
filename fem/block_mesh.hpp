#pragma once

#include "fem/curve.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <unordered_map>
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
        std::optional<Boundary> boundary = {}; ///< none: inside
        EdgeCurve curve = EdgeCurve::straight;
    };
    std::vector<Vector> vertices;
    std::vector<Cell> cells;
    std::vector<Edge> edges; ///< those on a boundary or a curve
    Curve detachment;        ///< extended to the right side
    Curve skin;              ///< its lower edge, where the strip of cells along the detachment ends
    unsigned halvings = 0;   ///< that lead to the requested cell size
};

using Path = std::function<Vector(double)>; ///< from 0 to 1

Path segment(Vector a, Vector b);
/// Between two arc lengths of a curve, which has to live as long.
Path stretch(const Curve& curve, double from, double to);
Path reversed(Path path);

struct MeshSide {
    Path path;
    std::optional<Boundary> boundary = {}; ///< none: inside
    EdgeCurve curve = EdgeCurve::straight;
};

/// Four sides of a block; bottom and top run to the right, left and right upward.
struct Block {
    MeshSide bottom, top, left, right;
};

/// Where cells meet along a side: fractions of it, ascending from 0 to 1.
using Fractions = std::vector<double>;

/// Parts that are all about `size` long.
Fractions even(double length, double size);
/// Parts that are `size` long up to `fine` and then grow, each by `ratio`, to at most `largest`.
/// The length is above 0.
Fractions growing(double length, double size, double fine, double ratio, double largest);
/// Parts counted from the other end.
Fractions reversed(Fractions fractions);

/// Cuts blocks into cells and joins those of neighbours.
class BlockMesher {
public:
    /// Vertices closer than the tolerance, m, are one.
    explicit BlockMesher(double tolerance) : tolerance_(tolerance) {}

    /// Cells of a block at the fractions u to the right and v upward, by transfinite interpolation
    /// (Gordon & Hall 1973).
    void add(const Block& block, const Fractions& u, const Fractions& v);

    /// Vertices, cells and edges of all blocks so far; afterwards there are none.
    BlockMesh take();

private:
    unsigned vertex(Vector p);

    BlockMesh mesh_;
    double tolerance_;
    std::unordered_multimap<std::size_t, unsigned> vertices_by_square_;
};

} // namespace listric::fem
