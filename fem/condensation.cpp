// The interface: its nodes, forces on it, and the stiffness condensed to it.

#include "fem/elasticity.hpp"

#include <algorithm>
#include <map>

namespace listric::fem {

using dealii::Point;
using dealii::Tensor;

/// A face on the interface as its process knows it and tells the others: its start, end and, at
/// degree 2, middle.
struct ElasticFootwall::FaceOnWall {
    struct Node {
        std::array<Index, 2> unknowns{}; ///< of x and y
        Vector place;                    ///< m
        bool can_move = false;

        template <class Archive> void serialize(Archive& archive, unsigned /*version*/) {
            archive& unknowns& place.x& place.y& can_move;
        }
    };
    std::array<Node, 3> nodes;

    template <class Archive> void serialize(Archive& archive, unsigned /*version*/) {
        archive& nodes;
    }
};

std::vector<ElasticFootwall::FaceOnWall> ElasticFootwall::own_faces_on_wall() const {
    const unsigned nodes = element_.n_dofs_per_face() / 2;
    const dealii::Quadrature<1> support(
        nodes == 3 ? std::vector<Point<1>>{Point<1>(0.0), Point<1>(1.0), Point<1>(0.5)}
                   : std::vector<Point<1>>{Point<1>(0.0), Point<1>(1.0)});
    dealii::FEFaceValues<2> values(mapping_, element_, support, dealii::update_quadrature_points);
    std::vector<Index> indices(element_.n_dofs_per_face());
    std::vector<FaceOnWall> faces;
    for_each_own_cell([&](const auto& cell) {
        for (const unsigned f : cell->face_indices()) {
            if (!cell->face(f)->at_boundary() || cell->face(f)->boundary_id() != id_of(wall()))
                continue;
            values.reinit(cell, f);
            cell->face(f)->get_dof_indices(indices);
            FaceOnWall& face = faces.emplace_back();
            for (unsigned k = 0; k < nodes; ++k) {
                const Vector place = plain(values.quadrature_point(k));
                const Index x = indices[2 * k], y = indices[2 * k + 1];
                face.nodes[k] = {{x, y},
                                 place,
                                 !constraints_.is_constrained(x) &&
                                     !constraints_.is_constrained(y) &&
                                     place.x <= request_.interface_end + 1e-6 * request_.cell_size};
            }
        }
    });
    return faces;
}

void ElasticFootwall::find_interface() {
    std::vector<FaceOnWall> wall_faces;
    for (const auto& part : dealii::Utilities::MPI::all_gather(processes_, own_faces_on_wall()))
        wall_faces.insert(wall_faces.end(), part.begin(), part.end());
    const unsigned nodes = element_.n_dofs_per_face() / 2;

    struct Node {
        InterfaceNode node;
        std::array<Index, 2> unknowns;
    };
    std::map<Index, Node> found; // by the x unknown
    for (const FaceOnWall& face : wall_faces)
        for (unsigned k = 0; k < nodes; ++k) {
            const auto& [unknowns, place, can_move] = face.nodes[k];
            if (can_move)
                found[unknowns[0]] = {{place, arc_length(place)}, unknowns};
        }
    std::vector<Node> sorted;
    for (const auto& [x, node] : found)
        sorted.push_back(node);
    std::ranges::sort(sorted, {}, [](const Node& n) { return n.node.arc_length; });
    std::map<Index, std::size_t> number;
    nodes_.clear();
    node_unknowns_.clear();
    for (const Node& node : sorted) {
        number[node.unknowns[0]] = nodes_.size();
        nodes_.push_back(node.node);
        node_unknowns_.push_back(node.unknowns);
    }

    faces_.clear();
    for (const FaceOnWall& wall_face : wall_faces) {
        InterfaceFace face{};
        bool is_whole = true;
        for (unsigned k = 0; k < nodes; ++k) {
            const auto it = number.find(wall_face.nodes[k].unknowns[0]);
            is_whole = is_whole && it != number.end();
            face.nodes[k] = is_whole ? it->second : 0;
        }
        if (!is_whole)
            continue;
        if (nodes < 3)
            face.nodes[2] = face.nodes[0];
        if (face.nodes[1] < face.nodes[0])
            std::swap(face.nodes[0], face.nodes[1]);
        faces_.push_back(face);
    }
    std::ranges::sort(faces_, {}, [](const InterfaceFace& f) { return f.nodes[0]; });
}

namespace {

/// Shape functions of a face's start, end and middle.
using Shapes = std::array<double, 3>;

/// Shape functions at t from 0 to 1 along a face.
Shapes shapes(int degree, double t) {
    return degree == 2 ? Shapes{(1 - t) * (1 - 2 * t), t * (2 * t - 1), 4 * t * (1 - t)}
                       : Shapes{1 - t, t, 0.0};
}

Shapes slopes(int degree, double t) {
    return degree == 2 ? Shapes{4 * t - 3, 4 * t - 1, 4 - 8 * t} : Shapes{-1.0, 1.0, 0.0};
}

/// The interface as the curve that its nodes span.
struct Trace {
    const std::vector<InterfaceNode>& nodes;
    const std::vector<InterfaceFace>& faces;
    int degree;

    struct Place {
        const InterfaceFace* face = nullptr;
        double at = 0.0; ///< 0 to 1 along the face
    };

    Vector sum(const InterfaceFace& face, const Shapes& n) const {
        Vector p;
        for (std::size_t k = 0; k < 3; ++k)
            p = p + n[k] * nodes[face.nodes[k]].place;
        return p;
    }

    double closest_on(const InterfaceFace& face, Vector p) const {
        const Vector a = nodes[face.nodes[0]].place, b = nodes[face.nodes[1]].place;
        const double length = norm(b - a);
        double t = std::clamp(dot(p - a, b - a) / (length * length), 0.0, 1.0);
        for (int step = 0; step < 8; ++step) { // Gauss-Newton
            const Vector off = p - sum(face, shapes(degree, t)), d = sum(face, slopes(degree, t));
            t = std::clamp(t + dot(off, d) / dot(d, d), 0.0, 1.0);
        }
        return t;
    }

    /// On no face if p is not finite.
    Place closest(Vector p) const {
        Place closest;
        double least = std::numeric_limits<double>::infinity();
        for (const InterfaceFace& face : faces) {
            const Vector a = nodes[face.nodes[0]].place, b = nodes[face.nodes[1]].place;
            if (std::min(norm(p - a), norm(p - b)) > least + norm(b - a))
                continue; // too far away
            const double t = closest_on(face, p);
            const double distance = norm(p - sum(face, shapes(degree, t)));
            if (distance < least) {
                least = distance;
                closest = {&face, t};
            }
        }
        return closest;
    }
};

} // namespace

std::vector<double> ElasticFootwall::nodal_forces(std::span<const PointForce> forces) const {
    if (faces_.empty())
        throw FootwallError("the footwall has no interface to take forces");
    const Trace trace{nodes_, faces_, request_.degree};
    std::vector<double> result(2 * nodes_.size(), 0.0);
    for (const PointForce& force : forces) {
        const auto [face, at] = trace.closest(force.place);
        if (!face)
            throw FootwallError(
                "a force on the footwall is at no place: x = " + std::to_string(force.place.x) +
                " m, y = " + std::to_string(force.place.y) + " m");
        const Shapes n = shapes(request_.degree, at);
        for (std::size_t k = 0; k < (request_.degree == 2 ? 3u : 2u); ++k) {
            result[2 * face->nodes[k]] += n[k] * force.force.x;
            result[2 * face->nodes[k] + 1] += n[k] * force.force.y;
        }
    }
    return result;
}

std::vector<double> ElasticFootwall::compliance() {
    if (request_.solver != Solver::mumps)
        throw FootwallError("the compliance needs factors of the stiffness: solver mumps");
    if (refined_)
        throw FootwallError("a footwall that was refined for one load has no compliance");
    // PETSc has MUMPS's Schur complement on one process only.
    return dealii::Utilities::MPI::n_mpi_processes(processes_) == 1 ? inverse_of_schur_complement()
                                                                    : unit_solutions();
}

/// The stiffness with everything but the interface eliminated, inverted. Later solutions go through
/// the same factors.
std::vector<double> ElasticFootwall::inverse_of_schur_complement() {
    if (!keeps_interface_)
        make_solver(true);
    const std::size_t n = 2 * nodes_.size();
    Mat factors = solver_factors(), inverse = nullptr;
    must(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr), "condensation");
    const PetscErrorCode indefinite = MatFactorInvertSchurComplement(factors);
    must(PetscPopErrorHandler(), "condensation");
    if (indefinite)
        throw FootwallError("rock along the detachment is too soft to keep its shape under the "
                            "overburden on it; allowed: a shear modulus above that pressure; a "
                            "thicker skin or a smaller relaxation stiffens it");
    must(MatFactorGetSchurComplement(factors, &inverse, nullptr), "condensation");
    std::vector<double> result(n * n);
    const PetscScalar* values = nullptr;
    must(MatDenseGetArrayRead(inverse, &values), "condensation");
    std::copy_n(values, n * n, result.begin());
    must(MatDenseRestoreArrayRead(inverse, &values), "condensation");
    must(MatFactorRestoreSchurComplement(factors, &inverse, MAT_FACTOR_SCHUR_INVERTED),
         "condensation");
    return result;
}

/// The interface's rows of the solutions for unit forces on it.
std::vector<double> ElasticFootwall::unit_solutions() {
    if (!solver_)
        make_solver(false);
    const Mat factors = solver_factors();
    const std::size_t n = 2 * nodes_.size();
    std::vector<double> result(n * n, 0.0);
    const auto unknown = [&](std::size_t i) { return node_unknowns_[i / 2][i % 2]; };
    const auto own = static_cast<PetscInt>(owned_.n_elements());
    constexpr std::size_t at_once = 128; // bounds the memory
    for (std::size_t first = 0; first < n; first += at_once) {
        const std::size_t columns = std::min(at_once, n - first);
        Mat forces = nullptr, displacements = nullptr;
        must(MatCreateDense(processes_, own, PETSC_DECIDE, PETSC_DECIDE,
                            static_cast<PetscInt>(columns), nullptr, &forces),
             "memory");
        for (std::size_t k = 0; k < columns; ++k)
            if (owned_.is_element(unknown(first + k)))
                must(MatSetValue(forces, static_cast<PetscInt>(unknown(first + k)),
                                 static_cast<PetscInt>(k), 1.0, INSERT_VALUES),
                     "unit forces");
        must(MatAssemblyBegin(forces, MAT_FINAL_ASSEMBLY), "unit forces");
        must(MatAssemblyEnd(forces, MAT_FINAL_ASSEMBLY), "unit forces");
        must(MatDuplicate(forces, MAT_DO_NOT_COPY_VALUES, &displacements), "memory");
        must(MatMatSolve(factors, forces, displacements), "condensation");
        const PetscScalar* values = nullptr;
        PetscInt rows = 0;
        must(MatDenseGetLDA(displacements, &rows), "condensation");
        must(MatDenseGetArrayRead(displacements, &values), "condensation");
        for (std::size_t i = 0; i < n; ++i)
            if (owned_.is_element(unknown(i))) {
                const std::size_t row = owned_.index_within_set(unknown(i));
                for (std::size_t k = 0; k < columns; ++k)
                    result[i * n + first + k] = values[row + k * static_cast<std::size_t>(rows)];
            }
        must(MatDenseRestoreArrayRead(displacements, &values), "condensation");
        must(MatDestroy(&forces), "condensation");
        must(MatDestroy(&displacements), "condensation");
    }
    MPI_Allreduce(MPI_IN_PLACE, result.data(), static_cast<int>(result.size()), MPI_DOUBLE, MPI_SUM,
                  processes_);
    return result;
}

Mat ElasticFootwall::solver_factors() const {
    PC preconditioner = nullptr;
    Mat factors = nullptr;
    must(KSPGetPC(solver_, &preconditioner), "no preconditioner");
    must(PCFactorGetMatrix(preconditioner, &factors), "no factors");
    return factors;
}

std::vector<double> ElasticFootwall::at_interface(const GlobalVector& displacement) const {
    std::vector<double> result(2 * nodes_.size(), 0.0);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const Index unknown = node_unknowns_[i / 2][i % 2];
        if (owned_.is_element(unknown))
            result[i] = displacement(unknown);
    }
    if (dealii::Utilities::MPI::n_mpi_processes(processes_) > 1)
        MPI_Allreduce(MPI_IN_PLACE, result.data(), static_cast<int>(result.size()), MPI_DOUBLE,
                      MPI_SUM, processes_);
    return result;
}

std::vector<double> ElasticFootwall::interface_displacement() const {
    require_solution();
    return at_interface(displacement_);
}

} // namespace listric::fem
