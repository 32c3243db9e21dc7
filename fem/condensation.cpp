// The interface: its nodes, forces on it, and the stiffness condensed to it.

#include "fem/elasticity.hpp"

#include <deal.II/base/mpi.templates.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace listric::fem {

using dealii::Point;
using dealii::Tensor;

void ElasticFootwall::find_interface() {
    const bool flat = request_.detachment.empty();
    const auto id =
        static_cast<dealii::types::boundary_id>(flat ? Boundary::surface : Boundary::detachment);
    const unsigned per_face = element_.n_dofs_per_face();
    const unsigned places = per_face / 2;
    std::vector<Index> indices(per_face);
    // Of a face's start, end and middle: unknowns of x and y (below 2^53, so that doubles hold
    // them), place, and whether it can move.
    std::vector<std::array<double, 15>> own;
    const dealii::Quadrature<1> support(
        places == 3 ? std::vector<Point<1>>{Point<1>(0.0), Point<1>(1.0), Point<1>(0.5)}
                    : std::vector<Point<1>>{Point<1>(0.0), Point<1>(1.0)});
    dealii::FEFaceValues<2> values(mapping_, element_, support, dealii::update_quadrature_points);
    for_each_own_cell([&](const auto& cell) {
        for (const unsigned f : cell->face_indices()) {
            if (!cell->face(f)->at_boundary() || cell->face(f)->boundary_id() != id)
                continue;
            values.reinit(cell, f);
            cell->face(f)->get_dof_indices(indices);
            std::array<double, 15> row{};
            for (unsigned k = 0; k < 3; ++k) {
                const unsigned from = k < places ? k : 0;
                const Point<2> p = values.quadrature_point(from);
                const Index x = indices[2 * from], y = indices[2 * from + 1];
                row[5 * k] = static_cast<double>(x);
                row[5 * k + 1] = static_cast<double>(y);
                row[5 * k + 2] = p[0];
                row[5 * k + 3] = p[1];
                row[5 * k + 4] = !constraints_.is_constrained(x) &&
                                 !constraints_.is_constrained(y) &&
                                 p[0] <= request_.interface_end + 1e-6 * request_.cell_size;
            }
            own.push_back(row);
        }
    });
    const auto all = dealii::Utilities::MPI::all_gather(processes, own);

    struct Node {
        InterfaceNode node;
        std::array<Index, 2> unknowns;
    };
    std::map<Index, Node> found;
    for (const auto& part : all)
        for (const auto& row : part)
            for (unsigned k = 0; k < places; ++k) {
                if (row[5 * k + 4] == 0.0)
                    continue;
                const Vector p{row[5 * k + 2], row[5 * k + 3]};
                const double s = flat ? p.x - request_.left : mesh_.detachment.nearest(p);
                const auto x = static_cast<Index>(row[5 * k]);
                found[x] = {{p, s}, {x, static_cast<Index>(row[5 * k + 1])}};
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
    for (const auto& part : all)
        for (const auto& row : part) {
            InterfaceFace face{};
            bool whole = true;
            for (unsigned k = 0; k < places; ++k) {
                const auto it = number.find(static_cast<Index>(row[5 * k]));
                whole = whole && it != number.end();
                face.nodes[k] = whole ? it->second : 0;
            }
            if (places < 3)
                face.nodes[2] = face.nodes[0];
            if (!whole)
                continue;
            if (face.nodes[1] < face.nodes[0])
                std::swap(face.nodes[0], face.nodes[1]);
            faces_.push_back(face);
        }
    std::ranges::sort(faces_, {}, [](const InterfaceFace& f) { return f.nodes[0]; });
}

std::vector<double> ElasticFootwall::nodal_forces(std::span<const PointForce> forces) const {
    if (faces_.empty())
        throw FootwallError("the footwall has no interface to take forces");
    std::vector<double> result(2 * nodes_.size(), 0.0);
    const bool quadratic = request_.degree == 2;
    // Shape functions at t from 0 to 1 along a face, and the place there.
    const auto shapes = [&](double t) {
        return quadratic ? std::array{(1 - t) * (1 - 2 * t), t * (2 * t - 1), 4 * t * (1 - t)}
                         : std::array{1 - t, t, 0.0};
    };
    const auto slopes = [&](double t) {
        return quadratic ? std::array{4 * t - 3, 4 * t - 1, 4 - 8 * t} : std::array{-1.0, 1.0, 0.0};
    };
    const auto sum = [&](const InterfaceFace& face, const std::array<double, 3>& n) {
        Vector p;
        for (std::size_t k = 0; k < 3; ++k) {
            p.x += n[k] * nodes_[face.nodes[k]].place.x;
            p.y += n[k] * nodes_[face.nodes[k]].place.y;
        }
        return p;
    };
    for (const PointForce& force : forces) {
        double least = std::numeric_limits<double>::infinity(), at = 0.0;
        const InterfaceFace* on = nullptr;
        for (const InterfaceFace& face : faces_) {
            const Vector a = nodes_[face.nodes[0]].place, b = nodes_[face.nodes[1]].place;
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            const double away = std::min(std::hypot(force.place.x - a.x, force.place.y - a.y),
                                         std::hypot(force.place.x - b.x, force.place.y - b.y));
            if (away > least + length)
                continue;
            double t = ((force.place.x - a.x) * (b.x - a.x) + (force.place.y - a.y) * (b.y - a.y)) /
                       (length * length);
            t = std::clamp(t, 0.0, 1.0);
            for (int step = 0; step < 8; ++step) { // Gauss-Newton toward the closest point
                const Vector p = sum(face, shapes(t)), d = sum(face, slopes(t));
                t += ((force.place.x - p.x) * d.x + (force.place.y - p.y) * d.y) /
                     (d.x * d.x + d.y * d.y);
                t = std::clamp(t, 0.0, 1.0);
            }
            const Vector p = sum(face, shapes(t));
            const double distance = std::hypot(force.place.x - p.x, force.place.y - p.y);
            if (distance < least) {
                least = distance;
                at = t;
                on = &face;
            }
        }
        const auto n = shapes(at);
        for (std::size_t k = 0; k < (quadratic ? 3u : 2u); ++k) {
            result[2 * on->nodes[k]] += n[k] * force.force.x;
            result[2 * on->nodes[k] + 1] += n[k] * force.force.y;
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
    return dealii::Utilities::MPI::n_mpi_processes(processes) == 1 ? inverse_of_schur_complement()
                                                                   : unit_solutions();
}

/// The stiffness with everything but the interface eliminated, inverted. Later solutions go through
/// the same factors.
std::vector<double> ElasticFootwall::inverse_of_schur_complement() {
    if (!keeps_interface_)
        make_solver(true);
    const std::size_t n = 2 * nodes_.size();
    Mat factors = solver_factors(), inverse = nullptr;
    must(MatFactorInvertSchurComplement(factors), "condensation");
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
        must(MatCreateDense(processes, own, PETSC_DECIDE, PETSC_DECIDE,
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
                  processes);
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
    if (dealii::Utilities::MPI::n_mpi_processes(processes) > 1)
        MPI_Allreduce(MPI_IN_PLACE, result.data(), static_cast<int>(result.size()), MPI_DOUBLE,
                      MPI_SUM, processes);
    return result;
}

std::vector<double> ElasticFootwall::interface_displacement() const {
    require_solution();
    return at_interface(displacement_);
}

} // namespace listric::fem
