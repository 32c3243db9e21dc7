#include "fem/mesh.hpp"

#include "fem/blocks.hpp"
#include "fem/mesh_scan.hpp"

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

namespace listric::fem {

namespace {

using dealii::Point;

constexpr dealii::types::manifold_id interior_id = 10;

constexpr dealii::types::manifold_id id_of(EdgeCurve curve) {
    return curve == EdgeCurve::straight ? interior_id
                                        : static_cast<dealii::types::manifold_id>(curve);
}

/// Places new points on a curve, in the middle by arc length.
class CurveManifold : public dealii::Manifold<2> {
public:
    explicit CurveManifold(Curve curve) : curve_(std::move(curve)) {}

    std::unique_ptr<dealii::Manifold<2>> clone() const override {
        return std::make_unique<CurveManifold>(curve_);
    }

    Point<2> get_new_point(const dealii::ArrayView<const Point<2>>& surrounding,
                           const dealii::ArrayView<const double>& weights) const override {
        double s = 0.0;
        for (std::size_t k = 0; k < surrounding.size(); ++k)
            s += weights[k] * curve_.nearest(plain(surrounding[k]));
        const Vector p = curve_.at(s);
        return {p.x, p.y};
    }

private:
    Curve curve_;
};

std::vector<dealii::CellData<2>> coarse_cells(const BlockMesh& blocks) {
    std::vector<dealii::CellData<2>> cells;
    for (const BlockMesh::Cell& cell : blocks.cells) {
        dealii::CellData<2> data;
        for (std::size_t k = 0; k < 4; ++k)
            data.vertices[k] = cell.vertices[k];
        data.manifold_id = interior_id;
        cells.push_back(data);
    }
    dealii::GridTools::consistently_order_cells(cells);
    return cells;
}

dealii::SubCellData coarse_edges(const BlockMesh& blocks) {
    dealii::SubCellData lines;
    for (const BlockMesh::Edge& edge : blocks.edges) {
        dealii::CellData<1> data;
        data.vertices = {edge.start, edge.end};
        data.boundary_id =
            edge.boundary ? id_of(*edge.boundary) : dealii::numbers::internal_face_boundary_id;
        data.manifold_id = id_of(edge.curve);
        // Both neighbours name the strip's lower edge.
        const bool is_known = std::ranges::any_of(lines.boundary_lines, [&](const auto& other) {
            return (other.vertices[0] == edge.start && other.vertices[1] == edge.end) ||
                   (other.vertices[0] == edge.end && other.vertices[1] == edge.start);
        });
        if (!is_known)
            lines.boundary_lines.push_back(data);
    }
    return lines;
}

/// Arc lengths of a face's ends, if both are on the curve.
template <class Face>
std::optional<std::pair<double, double>> ends_on(const Curve& curve, const Face& face,
                                                 double tolerance) {
    const Vector a = plain(face.vertex(0)), b = plain(face.vertex(1));
    const double s = curve.nearest(a), t = curve.nearest(b);
    if (!(norm(curve.at(s) - a) < tolerance && norm(curve.at(t) - b) < tolerance))
        return std::nullopt;
    return std::pair(s, t);
}

void follow_curves(Mesh& mesh, const BlockMesh& blocks, double tolerance) {
    for (const auto& cell : mesh.cells->cell_iterators_on_level(0))
        for (const auto& face : cell->face_iterators())
            if (face->at_boundary()) {
                if (face->boundary_id() == id_of(Boundary::detachment) &&
                    ends_on(blocks.detachment, *face, tolerance))
                    face->set_manifold_id(id_of(EdgeCurve::detachment));
            } else if (const auto ends = ends_on(blocks.skin, *face, tolerance);
                       // an edge of the curve, not one between two of its points
                       ends && std::abs(ends->first - ends->second) < 1.6 * face->measure()) {
                face->set_manifold_id(id_of(EdgeCurve::skin));
            }
    mesh.cells->set_manifold(id_of(EdgeCurve::detachment), CurveManifold(blocks.detachment));
    mesh.cells->set_manifold(id_of(EdgeCurve::skin), CurveManifold(blocks.skin));
}

void read_blocks(Mesh& mesh, const FootwallRequest& request) {
    const BlockMesh blocks = make_blocks(request);
    std::vector<Point<2>> vertices;
    for (const Vector& v : blocks.vertices)
        vertices.emplace_back(v.x, v.y);
    mesh.detachment = blocks.detachment;
    mesh.cells->create_triangulation(vertices, coarse_cells(blocks), coarse_edges(blocks));
    mesh.cells->set_all_manifold_ids(interior_id); // on the curves, too
    if (!blocks.detachment.empty())
        follow_curves(mesh, blocks, 1e-6 * request.cell_size);
    mesh.interior->initialize(*mesh.cells);
    mesh.cells->set_manifold(interior_id, *mesh.interior);
    mesh.cells->refine_global(blocks.halvings);
}

std::string place(const Point<2>& p) {
    return "(" + std::to_string(std::lround(p[0])) + ", " + std::to_string(std::lround(p[1])) +
           ") m";
}

/// Refuses a face of the boundary that has no name or lies off the boundary of its name.
template <class Face>
void check_boundary(const Mesh& mesh, const FootwallRequest& request, const Face& face) {
    const auto refuse = [&](const std::string& reason) {
        throw FootwallError(request.mesh_file + ": " + reason);
    };
    const auto must_lie = [&](double off, const char* what) {
        if (std::abs(off) > 0.05 * request.cell_size)
            refuse("does not match the scene: its " + std::string(what) + " at " +
                   place(face.center()) + " is " + std::to_string(std::lround(std::abs(off))) +
                   " m off");
    };
    const Vector start = plain(face.vertex(0)), end = plain(face.vertex(1));
    const auto must_not_lie = [&](double start_off, double end_off, const char* what) {
        if (std::max(std::abs(start_off), std::abs(end_off)) < 0.05 * request.cell_size)
            refuse("the edge at " + place(face.center()) + " is on the " + what +
                   " and is named surface (physical line 4)");
    };
    for (const Vector p : {start, end})
        switch (static_cast<Boundary>(face.boundary_id())) {
        case Boundary::left:
            must_lie(p.x - request.left, "left side");
            break;
        case Boundary::base:
            must_lie(p.y + request.depth, "base");
            break;
        case Boundary::right:
            must_lie(p.x - request.right, "right side");
            break;
        case Boundary::surface: // of any shape between the sides
            must_not_lie(start.x - request.left, end.x - request.left, "left side (1)");
            must_not_lie(start.x - request.right, end.x - request.right, "right side (3)");
            must_not_lie(start.y + request.depth, end.y + request.depth, "base (2)");
            break;
        case Boundary::detachment:
            if (mesh.detachment.empty())
                refuse("has a detachment (physical line 5), the scene has none");
            must_lie(mesh.detachment.distance(p), "detachment");
            break;
        default:
            refuse("the edge at " + place(face.center()) +
                   " is on no named boundary; physical lines: 1 left, 2 base, 3 right, "
                   "4 surface, 5 detachment");
        }
}

void check_boundaries(const Mesh& mesh, const FootwallRequest& request) {
    const bool is_flat = mesh.detachment.empty();
    bool has_interface = false;
    for (const auto& cell : mesh.cells->cell_iterators_on_level(0))
        for (const auto& face : cell->face_iterators())
            if (face->at_boundary()) {
                check_boundary(mesh, request, *face);
                has_interface |= face->boundary_id() ==
                                 id_of(is_flat ? Boundary::surface : Boundary::detachment);
            }
    if (!has_interface)
        throw FootwallError(request.mesh_file + (is_flat
                                                     ? ": has no surface (physical line 4)"
                                                     : ": has no detachment (physical line 5)"));
}

void read_gmsh(Mesh& mesh, const FootwallRequest& request) {
    scan_mesh(request.mesh_file);
    try {
        dealii::GridIn<2> reader(*mesh.cells);
        std::ifstream in(request.mesh_file);
        reader.read_msh(in);
    } catch (const std::exception& problem) {
        throw FootwallError(request.mesh_file + ": cannot be read: " + problem.what());
    }
    if (!request.detachment.empty())
        mesh.detachment = extended_detachment(request);
    check_boundaries(mesh, request);
    if (mesh.detachment.empty())
        return;
    for (const auto& cell : mesh.cells->cell_iterators_on_level(0))
        for (const auto& face : cell->face_iterators())
            if (face->at_boundary() && face->boundary_id() == id_of(Boundary::detachment))
                face->set_manifold_id(id_of(EdgeCurve::detachment));
    mesh.cells->set_manifold(id_of(EdgeCurve::detachment), CurveManifold(mesh.detachment));
}

} // namespace

Mesh make_mesh(const FootwallRequest& request, MPI_Comm processes) {
    Mesh mesh;
    mesh.cells = std::make_unique<dealii::parallel::distributed::Triangulation<2>>(processes);
    mesh.interior = std::make_unique<dealii::TransfiniteInterpolationManifold<2>>();
    if (request.mesh_file.empty())
        read_blocks(mesh, request);
    else
        read_gmsh(mesh, request);
    mesh.cells->refine_global(static_cast<unsigned>(std::max(0, request.refinements)));
    return mesh;
}

} // namespace listric::fem
