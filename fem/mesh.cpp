#include "fem/mesh.hpp"

#include "fem/blocks.hpp"

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace listric::fem {

namespace {

using dealii::Point;

constexpr dealii::types::manifold_id interior_id = 10;

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
            s += weights[k] * curve_.nearest({surrounding[k][0], surrounding[k][1]});
        const Vector p = curve_.at(s);
        return {p.x, p.y};
    }

private:
    Curve curve_;
};

/// Area of the quadrilateral's corner at which it is smallest.
double least_corner(const std::array<Point<2>, 4>& v) {
    const auto corner = [&](int at, int right, int up) {
        const auto a = v[static_cast<std::size_t>(right)] - v[static_cast<std::size_t>(at)];
        const auto b = v[static_cast<std::size_t>(up)] - v[static_cast<std::size_t>(at)];
        return a[0] * b[1] - a[1] * b[0];
    };
    return std::min({corner(0, 1, 2), corner(1, 3, 0), corner(2, 0, 3), corner(3, 2, 1)});
}

void read_blocks(Mesh& mesh, const FootwallRequest& request) {
    const BlockMesh blocks = make_blocks(request);
    std::vector<Point<2>> vertices;
    for (const Vector& v : blocks.vertices)
        vertices.emplace_back(v.x, v.y);
    std::vector<dealii::CellData<2>> cells;
    for (const BlockMesh::Cell& cell : blocks.cells) {
        dealii::CellData<2> data;
        std::array<Point<2>, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) {
            data.vertices[k] = cell.vertices[k];
            corners[k] = vertices[cell.vertices[k]];
        }
        if (!(least_corner(corners) > 0.0))
            throw FootwallError(
                "no mesh: cells fold over near x = " + std::to_string(corners[0][0]) +
                " m, y = " + std::to_string(corners[0][1]) +
                " m; make the skin thinner, the bends of the detachment wider or "
                "the base deeper");
        data.manifold_id = interior_id;
        cells.push_back(data);
    }
    dealii::GridTools::consistently_order_cells(cells);
    dealii::SubCellData lines;
    for (const BlockMesh::Edge& edge : blocks.edges) {
        dealii::CellData<1> data;
        data.vertices = {edge.start, edge.end};
        data.boundary_id = edge.boundary ? static_cast<dealii::types::boundary_id>(edge.boundary)
                                         : dealii::numbers::internal_face_boundary_id;
        data.manifold_id = edge.curve == EdgeCurve::straight
                               ? interior_id
                               : static_cast<dealii::types::manifold_id>(edge.curve);
        // Both neighbours name the strip's lower edge.
        bool known = false;
        for (const auto& other : lines.boundary_lines)
            known |= (other.vertices[0] == edge.start && other.vertices[1] == edge.end) ||
                     (other.vertices[0] == edge.end && other.vertices[1] == edge.start);
        if (!known)
            lines.boundary_lines.push_back(data);
    }
    mesh.detachment = blocks.detachment;
    mesh.cells->create_triangulation(vertices, cells, lines);
    mesh.cells->set_all_manifold_ids(interior_id);
    // Again, because the line above has overwritten them on the curves.
    const double tolerance = 1e-6 * request.cell_size;
    for (const auto& cell : mesh.cells->cell_iterators_on_level(0))
        for (const auto& face : cell->face_iterators())
            for (const auto& [curve, id] :
                 {std::pair(&blocks.detachment, 1u), std::pair(&blocks.skin, 2u)}) {
                if (curve->empty() || (id == 1 && !face->at_boundary()))
                    continue;
                const Point<2> a = face->vertex(0), b = face->vertex(1);
                const double s = curve->nearest({a[0], a[1]}), t = curve->nearest({b[0], b[1]});
                const auto off = [&](const Point<2>& p, double at) {
                    const Vector q = curve->at(at);
                    return std::hypot(q.x - p[0], q.y - p[1]);
                };
                // An edge of the curve, not one between two of its points.
                if (off(a, s) < tolerance && off(b, t) < tolerance &&
                    (face->at_boundary() ? face->boundary_id() == 5 && id == 1
                                         : std::abs(s - t) < 1.6 * face->measure()))
                    face->set_manifold_id(id);
            }
    if (!blocks.detachment.empty()) {
        mesh.cells->set_manifold(1, CurveManifold(blocks.detachment));
        mesh.cells->set_manifold(2, CurveManifold(blocks.skin));
    }
    mesh.interior->initialize(*mesh.cells);
    mesh.cells->set_manifold(interior_id, *mesh.interior);
    mesh.cells->refine_global(blocks.halvings);
}

void read_gmsh(Mesh& mesh, const FootwallRequest& request) {
    namespace fs = std::filesystem;
    const auto refuse = [&](const std::string& reason) {
        throw FootwallError(request.mesh_file + ": " + reason);
    };
    std::error_code error;
    if (!fs::is_regular_file(request.mesh_file, error))
        refuse("no such mesh file");

    // deal.II turns inverted cells over without a word, so the file is looked at first.
    std::ifstream file(request.mesh_file);
    std::string word;
    file >> word;
    double version = 0.0;
    if (word != "$MeshFormat" || !(file >> version) || version < 2.0 || version >= 3.0)
        refuse("is no Gmsh mesh of format 2.2; write one with gmsh -2 -format msh22");
    std::vector<Point<2>> nodes;
    std::size_t quads = 0;
    while (file >> word) {
        if (word == "$Nodes") {
            std::size_t count = 0, number = 0;
            double x = 0.0, y = 0.0, z = 0.0;
            file >> count;
            nodes.resize(count + 1);
            for (std::size_t k = 0; k < count && file >> number >> x >> y >> z; ++k) {
                if (number > count)
                    refuse("node numbers have gaps; write it with gmsh's renumbering");
                nodes[number] = {x, y};
            }
        } else if (word == "$Elements") {
            std::size_t count = 0;
            file >> count;
            for (std::size_t k = 0; k < count; ++k) {
                std::size_t number = 0, type = 0, tags = 0, tag = 0;
                file >> number >> type >> tags;
                for (std::size_t i = 0; i < tags; ++i)
                    file >> tag;
                const std::size_t corners = type == 15 ? 1 : type == 1 ? 2 : type == 3 ? 4 : 0;
                if (corners == 0)
                    refuse("element " + std::to_string(number) + " is of Gmsh type " +
                           std::to_string(type) +
                           ", allowed: first-order lines and quadrilaterals; recombine all "
                           "surfaces");
                std::array<std::size_t, 4> v{};
                for (std::size_t i = 0; i < corners; ++i)
                    file >> v[i];
                if (!file)
                    refuse("ends in the middle of its elements");
                if (type != 3)
                    continue;
                ++quads;
                const auto at = [&](std::size_t i) {
                    if (v[i] >= nodes.size())
                        refuse("element " + std::to_string(number) + " names node " +
                               std::to_string(v[i]) + ", which is not there");
                    return nodes[v[i]];
                };
                if (!(least_corner({at(0), at(1), at(3), at(2)}) > 0.0))
                    refuse("element " + std::to_string(number) +
                           " is inverted or folded: nodes must run anticlockwise around a convex "
                           "quadrilateral");
            }
        }
    }
    if (quads == 0)
        refuse("has no quadrilaterals");
    try {
        dealii::GridIn<2> reader(*mesh.cells);
        std::ifstream in(request.mesh_file);
        reader.read_msh(in);
    } catch (const std::exception& problem) {
        refuse(std::string("cannot be read: ") + problem.what());
    }
    const bool flat = request.detachment.empty();
    if (!flat)
        mesh.detachment = extended_detachment(request);
    bool has_interface = false;
    const double tolerance = 0.05 * request.cell_size;
    for (const auto& cell : mesh.cells->cell_iterators_on_level(0))
        for (const auto& face : cell->face_iterators()) {
            if (!face->at_boundary())
                continue;
            const auto id = face->boundary_id();
            const auto place = [](const Point<2>& p) {
                return "(" + std::to_string(std::lround(p[0])) + ", " +
                       std::to_string(std::lround(p[1])) + ") m";
            };
            if (id < 1 || id > 5)
                refuse("the edge at " + place(face->center()) +
                       " is on no named boundary; physical lines: 1 left, 2 base, 3 right, "
                       "4 surface, 5 detachment");
            has_interface |= id == (flat ? 4 : 5);
            const auto must_lie = [&](double off, const char* what) {
                if (std::abs(off) > tolerance)
                    refuse("does not match the scene: its " + std::string(what) + " at " +
                           place(face->center()) + " is " +
                           std::to_string(std::lround(std::abs(off))) + " m off");
            };
            for (unsigned k = 0; k < 2; ++k) {
                const Point<2> p = face->vertex(k);
                if (id == 5) {
                    if (flat)
                        refuse("has a detachment (physical line 5), the scene has none");
                    must_lie(mesh.detachment.distance({p[0], p[1]}), "detachment");
                } else if (id == 1) {
                    must_lie(p[0] - request.left, "left side");
                } else if (id == 3) {
                    must_lie(p[0] - request.right, "right side");
                } else if (id == 2) {
                    must_lie(p[1] + request.depth, "base");
                }
            }
            if (id == 5)
                face->set_manifold_id(1);
        }
    if (!has_interface)
        refuse(flat ? "has no surface (physical line 4)" : "has no detachment (physical line 5)");
    if (!flat)
        mesh.cells->set_manifold(1, CurveManifold(mesh.detachment));
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
