// Plane-strain elasticity of the footwall: assembly, solvers, condensation to the interface,
// output.

#include "fem/blocks.hpp"
#include "fem/footwall.hpp"
#include "fem/material.hpp"
#include "fem/mesh.hpp"

#include <deal.II/base/mpi.h>
#include <deal.II/base/mpi.templates.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/error_estimator.h>
#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace listric::fem {

namespace {

using dealii::Point;
using dealii::Tensor;
using Index = dealii::types::global_dof_index;
using GlobalVector = dealii::PETScWrappers::MPI::Vector;

const MPI_Comm processes = MPI_COMM_WORLD;

void must(PetscErrorCode code, const char* what) {
    if (code)
        throw FootwallError(std::string("the solver failed: ") + what);
}

Vector plain(const Point<2>& p) { return {p[0], p[1]}; }

/// Where loads jump along a straight face: from 0 at its first vertex to 1, sorted.
template <class Face>
std::vector<double> jumps_within(const Face& face, const std::vector<double>& jumps) {
    std::vector<double> result;
    const double start = face.vertex(0)[0], end = face.vertex(1)[0];
    for (const double x : jumps)
        if ((x - start) * (x - end) < 0.0)
            result.push_back((x - start) / (end - start));
    std::ranges::sort(result);
    return result;
}

/// The same points once in every part of a face.
dealii::Quadrature<1> in_parts(const dealii::Quadrature<1>& points, std::vector<double> ends) {
    ends.insert(ends.begin(), 0.0);
    ends.push_back(1.0);
    std::vector<Point<1>> place;
    std::vector<double> weight;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        for (unsigned q = 0; q < points.size(); ++q) {
            const double length = ends[k + 1] - ends[k];
            place.emplace_back(ends[k] + length * points.point(q)[0]);
            weight.push_back(length * points.weight(q));
        }
    return {place, weight};
}

/// Whether a plane slides under a stress whose Mohr circle has this centre (pressure > 0) and
/// radius, Pa: its circle crosses one of the two lines of Byerlee's law.
bool beyond_byerlee(double pressure, double radius) {
    const auto crosses = [&](double friction, double cohesion) {
        return radius * std::hypot(1.0, friction) > cohesion + friction * pressure;
    };
    return crosses(0.85, 0.0) || crosses(0.6, 60e6);
}

/// Stress, elastic moduli and density at the points of output.
class StressOutput : public dealii::DataPostprocessor<2> {
public:
    explicit StressOutput(const Material& material) : material_(material) {}

    std::vector<std::string> get_names() const override {
        return {"stress_xx_pa",     "stress_yy_pa",  "stress_xy_pa",
                "young_modulus_pa", "poisson_ratio", "density_kg_per_m3"};
    }
    std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>
    get_data_component_interpretation() const override {
        return std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation>(
            6, dealii::DataComponentInterpretation::component_is_scalar);
    }
    dealii::UpdateFlags get_needed_update_flags() const override {
        return dealii::update_gradients | dealii::update_quadrature_points;
    }
    void evaluate_vector_field(const dealii::DataPostprocessorInputs::Vector<2>& in,
                               std::vector<dealii::Vector<double>>& out) const override {
        // A cell's rock is that of its middle, lest a layer's edge flicker.
        Point<2> middle;
        for (const auto& p : in.evaluation_points)
            middle += p / static_cast<double>(in.evaluation_points.size());
        const Rock rock = material_.at(plain(middle));
        for (std::size_t k = 0; k < out.size(); ++k) {
            const auto& g = in.solution_gradients[k];
            const double trace = rock.lambda * (g[0][0] + g[1][1]);
            out[k](0) = trace + 2.0 * rock.mu * g[0][0];
            out[k](1) = trace + 2.0 * rock.mu * g[1][1];
            out[k](2) = rock.mu * (g[0][1] + g[1][0]);
            out[k](3) = rock.mu * (3.0 * rock.lambda + 2.0 * rock.mu) / (rock.lambda + rock.mu);
            out[k](4) = 0.5 * rock.lambda / (rock.lambda + rock.mu);
            out[k](5) = rock.density;
        }
    }

private:
    const Material& material_;
};

class ElasticFootwall final : public Footwall {
public:
    explicit ElasticFootwall(const FootwallRequest& request)
        : request_(request), mesh_(make_mesh(request, processes)),
          material_(request, mesh_.detachment),
          element_(dealii::FE_Q<2>(static_cast<unsigned>(request.degree)), 2),
          mapping_(static_cast<unsigned>(request.degree)), unknowns_(*mesh_.cells) {
        set_up();
    }

    ~ElasticFootwall() override {
        if (solver_)
            KSPDestroy(&solver_);
    }

    MeshFacts mesh() const override { return facts_; }
    int process() const override {
        return static_cast<int>(dealii::Utilities::MPI::this_mpi_process(processes));
    }
    const std::vector<InterfaceNode>& interface() const override { return nodes_; }
    const std::vector<InterfaceFace>& interface_faces() const override { return faces_; }
    int iterations() const override { return iterations_; }
    Vector total_load() const override { return total_load_; }

    std::vector<double> nodal_forces(std::span<const PointForce> forces) const override;
    std::vector<double> compliance() override;
    void solve(const Load& load) override;
    Responses responses(std::span<const Load> loads) override;
    std::vector<double> interface_displacement() const override;
    Field field() const override;
    std::vector<StressPatch> stress() const override;
    FieldError error(const ExactField& exact) const override;
    Vector reaction() const override;
    Guard guard(double rock_weight) const override;
    void refine(double share_of_cells) override;
    void write(const std::string& folder, const std::string& name) const override;

private:
    static inline const dealii::UpdateFlags volume_flags =
        dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points |
        dealii::update_JxW_values;
    static inline const dealii::UpdateFlags face_flags =
        dealii::update_values | dealii::update_quadrature_points | dealii::update_JxW_values |
        dealii::update_normal_vectors;

    dealii::QGauss<2> quadrature() const {
        return dealii::QGauss<2>(static_cast<unsigned>(request_.degree) + 1);
    }
    dealii::QGauss<1> face_quadrature() const {
        return dealii::QGauss<1>(static_cast<unsigned>(request_.degree) + 2);
    }
    double spring(int boundary) const {
        switch (static_cast<Boundary>(boundary)) {
        case Boundary::surface:
            return request_.surface_spring;
        case Boundary::detachment:
            return request_.detachment_spring;
        case Boundary::base:
            return request_.base_spring;
        default:
            return 0.0;
        }
    }
    /// Horizontal stiffness of a far side, Pa/m.
    double side_spring(int boundary, Vector place) const {
        const Side side = boundary == static_cast<int>(Boundary::left)    ? request_.left_side
                          : boundary == static_cast<int>(Boundary::right) ? request_.right_side
                                                                          : Side::free;
        if (side != Side::elastic)
            return 0.0;
        const Rock rock = material_.at(place);
        return (rock.lambda + 2.0 * rock.mu) / (request_.right - request_.left);
    }

    void set_up();
    void measure_mesh();
    void find_interface();
    void assemble();
    void make_solver(bool keep_interface);
    Mat solver_factors() const;
    std::pair<GlobalVector, Vector> forces_of(const Load& load) const;
    GlobalVector displacement_under(const GlobalVector& forces);
    std::vector<double> at_interface(const GlobalVector& displacement) const;
    std::vector<double> inverse_of_schur_complement();
    std::vector<double> unit_solutions();
    void require_solution() const {
        if (displacement_.size() == 0)
            throw FootwallError("the footwall has no solution yet: solve first");
    }
    template <class Visit> void for_each_own_cell(Visit&& visit) const {
        for (const auto& cell : unknowns_.active_cell_iterators())
            if (cell->is_locally_owned())
                visit(cell);
    }

    FootwallRequest request_;
    Mesh mesh_;
    Material material_;
    dealii::FESystem<2> element_;
    dealii::MappingQCache<2> mapping_;
    dealii::DoFHandler<2> unknowns_;
    dealii::IndexSet owned_, relevant_;
    dealii::AffineConstraints<double> constraints_;
    dealii::PETScWrappers::MPI::SparseMatrix stiffness_;
    KSP solver_ = nullptr;
    GlobalVector displacement_; ///< with ghosts
    MeshFacts facts_;
    std::vector<InterfaceNode> nodes_;
    std::vector<std::array<Index, 2>> node_unknowns_;
    std::vector<InterfaceFace> faces_;
    Vector total_load_;
    int iterations_ = 0;
    bool refined_ = false;
    bool keeps_interface_ = false; ///< the factors end at the interface's Schur complement
};

void ElasticFootwall::set_up() {
    if (solver_)
        must(KSPDestroy(&solver_), "cannot drop the old factors");
    keeps_interface_ = false;
    displacement_.clear();
    mapping_.initialize(dealii::MappingQ<2>(static_cast<unsigned>(request_.degree)), *mesh_.cells);
    unknowns_.distribute_dofs(element_);
    owned_ = unknowns_.locally_owned_dofs();
    dealii::DoFTools::extract_locally_relevant_dofs(unknowns_, relevant_);

    constraints_.clear();
    constraints_.reinit(relevant_);
    dealii::DoFTools::make_hanging_node_constraints(unknowns_, constraints_);
    for (const auto& [side, boundary] : {std::pair(request_.left_side, Boundary::left),
                                         std::pair(request_.right_side, Boundary::right)})
        if (side == Side::roller) {
            const dealii::IndexSet held = dealii::DoFTools::extract_boundary_dofs(
                unknowns_, dealii::ComponentMask(std::vector<bool>{true, false}),
                {static_cast<dealii::types::boundary_id>(boundary)});
            for (const Index i : held)
                if (!constraints_.is_constrained(i))
                    constraints_.add_line(i);
        }
    constraints_.close();

    dealii::DynamicSparsityPattern pattern(relevant_);
    dealii::DoFTools::make_sparsity_pattern(unknowns_, pattern, constraints_, false);
    dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned_, processes, relevant_);
    stiffness_.reinit(owned_, owned_, pattern, processes);
    measure_mesh();
    find_interface();
    assemble();
}

void ElasticFootwall::measure_mesh() {
    const dealii::QGauss<2> points = quadrature();
    dealii::FEValues<2> values(mapping_, element_, points,
                               dealii::update_JxW_values | dealii::update_jacobians);
    double area = 0.0, least = 1.0;
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        double small = std::numeric_limits<double>::infinity(), large = -small;
        for (unsigned q = 0; q < points.size(); ++q) {
            area += values.JxW(q);
            const double j = dealii::determinant(Tensor<2, 2>(values.jacobian(q)));
            small = std::min(small, j);
            large = std::max(large, j);
        }
        least = std::min(least, small / large);
    });
    facts_ = {mesh_.cells->n_global_active_cells(), unknowns_.n_dofs(),
              dealii::Utilities::MPI::sum(area, processes),
              dealii::Utilities::MPI::min(least, processes)};
    if (!(facts_.least_jacobian > 0.0))
        throw FootwallError("no mesh: cells fold over; make cells or skin smaller");
}

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

void ElasticFootwall::assemble() {
    const dealii::QGauss<2> points = quadrature();
    const dealii::QGauss<1> face_points = face_quadrature();
    dealii::FEValues<2> values(mapping_, element_, points, volume_flags);
    dealii::FEFaceValues<2> face_values(mapping_, element_, face_points, face_flags);
    const unsigned n = element_.n_dofs_per_cell();
    dealii::FullMatrix<double> local(n, n);
    std::vector<Index> indices(n);
    std::vector<unsigned> component(n);
    for (unsigned i = 0; i < n; ++i)
        component[i] = element_.system_to_component_index(i).first;
    stiffness_ = 0.0;
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        local = 0.0;
        for (unsigned q = 0; q < points.size(); ++q) {
            const Rock rock = material_.at(plain(values.quadrature_point(q)));
            const double w = values.JxW(q);
            for (unsigned i = 0; i < n; ++i) {
                const Tensor<1, 2> gi = values.shape_grad(i, q);
                const unsigned a = component[i];
                for (unsigned j = 0; j <= i; ++j) {
                    const Tensor<1, 2> gj = values.shape_grad(j, q);
                    const unsigned b = component[j];
                    // sigma(u) : eps(v) of one-component fields u = N_j e_b, v = N_i e_a
                    local(i, j) += w * (rock.lambda * gi[a] * gj[b] + rock.mu * gi[b] * gj[a] +
                                        (a == b ? rock.mu * (gi * gj) : 0.0));
                }
            }
        }
        for (const unsigned f : cell->face_indices()) {
            if (!cell->face(f)->at_boundary())
                continue;
            const int boundary = static_cast<int>(cell->face(f)->boundary_id());
            const double k = spring(boundary);
            const bool is_side = boundary == static_cast<int>(Boundary::left) ||
                                 boundary == static_cast<int>(Boundary::right);
            if (k == 0.0 && !is_side)
                continue;
            face_values.reinit(cell, f);
            for (unsigned q = 0; q < face_points.size(); ++q) {
                const double w = face_values.JxW(q);
                const double stiffness[2] = {
                    side_spring(boundary, plain(face_values.quadrature_point(q))),
                    k * std::abs(face_values.normal_vector(q)[1])};
                for (unsigned i = 0; i < n; ++i)
                    for (unsigned j = 0; j <= i; ++j)
                        if (component[i] == component[j])
                            local(i, j) += w * stiffness[component[i]] *
                                           face_values.shape_value(i, q) *
                                           face_values.shape_value(j, q);
            }
        }
        for (unsigned i = 0; i < n; ++i)
            for (unsigned j = 0; j < i; ++j)
                local(j, i) = local(i, j);
        cell->get_dof_indices(indices);
        constraints_.distribute_local_to_global(local, indices, stiffness_);
    });
    stiffness_.compress(dealii::VectorOperation::add);
    const Mat matrix = stiffness_;
    must(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE), "symmetry");
    must(MatSetOption(matrix, MAT_SPD, PETSC_TRUE), "positive definiteness");
}

Mat ElasticFootwall::solver_factors() const {
    PC preconditioner = nullptr;
    Mat factors = nullptr;
    must(KSPGetPC(solver_, &preconditioner), "no preconditioner");
    must(PCFactorGetMatrix(preconditioner, &factors), "no factors");
    return factors;
}

void ElasticFootwall::make_solver(bool keep_interface) {
    if (solver_)
        must(KSPDestroy(&solver_), "cannot drop the old factors");
    keeps_interface_ = keep_interface;
    const Mat matrix = stiffness_;
    PC preconditioner = nullptr;
    must(KSPCreate(processes, &solver_), "no solver");
    must(KSPSetOperators(solver_, matrix, matrix), "no operator");
    must(KSPGetPC(solver_, &preconditioner), "no preconditioner");
    if (request_.solver == Solver::mumps) {
        must(KSPSetType(solver_, KSPPREONLY), "type");
        must(PCSetType(preconditioner, PCCHOLESKY), "Cholesky");
        must(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS), "MUMPS");
        if (keep_interface) {
            std::vector<PetscInt> kept;
            for (const auto& node : node_unknowns_)
                for (const Index unknown : node)
                    kept.push_back(static_cast<PetscInt>(unknown));
            IS interface = nullptr;
            must(ISCreateGeneral(processes, static_cast<PetscInt>(kept.size()), kept.data(),
                                 PETSC_COPY_VALUES, &interface),
                 "interface");
            must(PCFactorSetUpMatSolverType(preconditioner), "MUMPS");
            must(MatFactorSetSchurIS(solver_factors(), interface), "interface");
            must(ISDestroy(&interface), "interface");
        }
    } else {
        must(KSPSetType(solver_, KSPCG), "conjugate gradients");
        must(KSPSetTolerances(solver_, 1e-12, PETSC_DEFAULT, PETSC_DEFAULT, 1000), "tolerance");
        // Unknowns come in pairs x, y, which both multigrids want to know.
        must(MatSetBlockSize(matrix, 2), "block size");
        if (request_.solver == Solver::boomeramg) {
            must(PCSetType(preconditioner, PCHYPRE), "hypre");
            must(PCHYPRESetType(preconditioner, "boomeramg"), "BoomerAMG");
        } else {
            must(PCSetType(preconditioner, PCGAMG), "GAMG");
            GlobalVector places(owned_, processes);
            const auto units = element_.base_element(0).get_unit_support_points();
            dealii::FEValues<2> values(mapping_, element_, dealii::Quadrature<2>(units),
                                       dealii::update_quadrature_points);
            std::vector<Index> indices(element_.n_dofs_per_cell());
            for_each_own_cell([&](const auto& cell) {
                values.reinit(cell);
                cell->get_dof_indices(indices);
                for (unsigned i = 0; i < indices.size(); ++i) {
                    const auto [component, place] = element_.system_to_component_index(i);
                    if (owned_.is_element(indices[i]))
                        places(indices[i]) = values.quadrature_point(place)[component];
                }
            });
            places.compress(dealii::VectorOperation::insert);
            const Vec coordinates = places;
            MatNullSpace motions = nullptr;
            must(VecSetBlockSize(coordinates, 2), "block size");
            must(MatNullSpaceCreateRigidBody(coordinates, &motions), "rigid motions");
            must(MatSetNearNullSpace(matrix, motions), "rigid motions");
            must(MatNullSpaceDestroy(&motions), "rigid motions");
        }
    }
    must(KSPSetUp(solver_), "the stiffness has no factors");
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

/// The load's forces on all unknowns, and their sum.
std::pair<GlobalVector, Vector> ElasticFootwall::forces_of(const Load& load) const {
    GlobalVector forces(owned_, processes);
    const dealii::QGauss<2> points(static_cast<unsigned>(request_.degree) + 2);
    // Points enough for loads that bend inside an element, or end there unannounced.
    const dealii::QGauss<1> gauss(static_cast<unsigned>(request_.degree) + 3);
    dealii::FEValues<2> values(mapping_, element_, points, volume_flags);
    dealii::FEFaceValues<2> whole_face(mapping_, element_, dealii::QIterated<1>(gauss, 4),
                                       face_flags);
    const unsigned n = element_.n_dofs_per_cell();
    dealii::Vector<double> local(n);
    std::vector<Index> indices(n);
    double total[2] = {0.0, 0.0};
    if (load.body || load.traction)
        for_each_own_cell([&](const auto& cell) {
            local = 0.0;
            bool is_loaded = false;
            if (load.body) {
                is_loaded = true;
                values.reinit(cell);
                for (unsigned q = 0; q < points.size(); ++q) {
                    const Vector f = load.body(plain(values.quadrature_point(q)));
                    const double w = values.JxW(q);
                    total[0] += w * f.x;
                    total[1] += w * f.y;
                    for (unsigned i = 0; i < n; ++i)
                        local(i) += w * values.shape_value(i, q) *
                                    (element_.system_to_component_index(i).first == 0 ? f.x : f.y);
                }
            }
            for (const unsigned f : cell->face_indices()) {
                if (!load.traction || !cell->face(f)->at_boundary())
                    continue;
                is_loaded = true;
                std::unique_ptr<dealii::FEFaceValues<2>> parts;
                if (const std::vector<double> at = jumps_within(*cell->face(f), load.jumps);
                    !at.empty())
                    parts = std::make_unique<dealii::FEFaceValues<2>>(
                        mapping_, element_, in_parts(gauss, at), face_flags);
                dealii::FEFaceValues<2>& face_values = parts ? *parts : whole_face;
                face_values.reinit(cell, f);
                for (unsigned q = 0; q < face_values.n_quadrature_points; ++q) {
                    const auto normal = face_values.normal_vector(q);
                    const Vector t = load.traction(
                        plain(face_values.quadrature_point(q)), {normal[0], normal[1]},
                        static_cast<Boundary>(cell->face(f)->boundary_id()));
                    const double w = face_values.JxW(q);
                    total[0] += w * t.x;
                    total[1] += w * t.y;
                    for (unsigned i = 0; i < n; ++i)
                        local(i) += w * face_values.shape_value(i, q) *
                                    (element_.system_to_component_index(i).first == 0 ? t.x : t.y);
                }
            }
            if (!is_loaded)
                return;
            cell->get_dof_indices(indices);
            constraints_.distribute_local_to_global(local, indices, forces);
        });
    Vector sum{dealii::Utilities::MPI::sum(total[0], processes),
               dealii::Utilities::MPI::sum(total[1], processes)};
    if (!load.interface.empty()) {
        if (load.interface.size() != 2 * nodes_.size())
            throw FootwallError("the load has " + std::to_string(load.interface.size()) +
                                " interface forces, the interface " +
                                std::to_string(2 * nodes_.size()));
        for (std::size_t i = 0; i < load.interface.size(); ++i) {
            const Index unknown = node_unknowns_[i / 2][i % 2];
            if (owned_.is_element(unknown))
                forces(unknown) += load.interface[i];
            (i % 2 ? sum.y : sum.x) += load.interface[i];
        }
    }
    forces.compress(dealii::VectorOperation::add);
    return {std::move(forces), sum};
}

GlobalVector ElasticFootwall::displacement_under(const GlobalVector& forces) {
    if (!solver_)
        make_solver(false);
    GlobalVector solution(owned_, processes);
    const Vec right = forces, left = solution;
    must(KSPSolve(solver_, right, left), "no solution");
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    must(KSPGetConvergedReason(solver_, &reason), "no solution");
    must(KSPGetIterationNumber(solver_, &iterations), "no solution");
    if (reason < 0)
        throw FootwallError("the solver did not converge in " + std::to_string(iterations) +
                            " iterations; the solver mumps always does");
    iterations_ = static_cast<int>(iterations);
    constraints_.distribute(solution);
    return solution;
}

void ElasticFootwall::solve(const Load& load) {
    const auto [forces, sum] = forces_of(load);
    total_load_ = sum;
    const GlobalVector solution = displacement_under(forces);
    displacement_.reinit(owned_, relevant_, processes);
    displacement_ = solution;
}

Responses ElasticFootwall::responses(std::span<const Load> loads) {
    Responses result;
    std::vector<GlobalVector> forces;
    for (const Load& load : loads) {
        auto [force, sum] = forces_of(load);
        forces.push_back(std::move(force));
        result.sums.push_back(sum);
    }
    for (const GlobalVector& force : forces) {
        const GlobalVector solution = displacement_under(force);
        const std::vector<double> interface = at_interface(solution);
        result.interface.insert(result.interface.end(), interface.begin(), interface.end());
        for (const GlobalVector& other : forces)
            result.work.push_back(other * solution);
    }
    return result;
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

Field ElasticFootwall::field() const {
    require_solution();
    const auto units = element_.base_element(0).get_unit_support_points();
    dealii::FEValues<2> values(mapping_, element_, dealii::Quadrature<2>(units),
                               dealii::update_quadrature_points);
    std::vector<Index> indices(element_.n_dofs_per_cell());
    std::map<Index, std::array<double, 4>> found; // by the x unknown
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        cell->get_dof_indices(indices);
        for (unsigned i = 0; i < indices.size(); ++i) {
            const auto [component, place] = element_.system_to_component_index(i);
            if (component != 0 || !owned_.is_element(indices[i]))
                continue;
            const Point<2> p = values.quadrature_point(place);
            // The y unknown of a node follows the x unknown.
            found[indices[i]] = {p[0], p[1], displacement_(indices[i]),
                                 displacement_(indices[i] + 1)};
        }
    });
    std::vector<std::array<double, 4>> own;
    for (const auto& [index, row] : found)
        own.push_back(row);
    std::vector<std::array<double, 4>> rows;
    for (const auto& part : dealii::Utilities::MPI::all_gather(processes, own))
        rows.insert(rows.end(), part.begin(), part.end());
    // Places of one row of nodes agree to round-off only.
    const double grain = 1e-6 * request_.cell_size;
    std::ranges::sort(rows, {}, [grain](const std::array<double, 4>& row) {
        return std::pair(std::llround(row[1] / grain), row[0]);
    });
    Field field;
    for (const auto& row : rows) {
        field.place.push_back({row[0], row[1]});
        field.displacement.push_back({row[2], row[3]});
    }
    return field;
}

FieldError ElasticFootwall::error(const ExactField& exact) const {
    require_solution();
    const dealii::QGauss<2> points(static_cast<unsigned>(request_.degree) + 3);
    dealii::FEValues<2> values(mapping_, element_, points, volume_flags);
    const dealii::FEValuesExtractors::Vector u(0);
    std::vector<Tensor<1, 2>> found(points.size());
    std::vector<Tensor<2, 2>> slopes(points.size());
    double sums[4] = {0.0, 0.0, 0.0, 0.0};
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        values[u].get_function_values(displacement_, found);
        values[u].get_function_gradients(displacement_, slopes);
        for (unsigned q = 0; q < points.size(); ++q) {
            const Vector p = plain(values.quadrature_point(q));
            const Vector e = exact.displacement(p);
            const std::array<double, 4> g = exact.gradient(p);
            const double w = values.JxW(q);
            sums[0] += w * (std::pow(found[q][0] - e.x, 2) + std::pow(found[q][1] - e.y, 2));
            sums[1] += w * (e.x * e.x + e.y * e.y);
            for (unsigned k = 0; k < 4; ++k) {
                sums[2] += w * std::pow(slopes[q][k / 2][k % 2] - g[k], 2);
                sums[3] += w * g[k] * g[k];
            }
        }
    });
    for (double& sum : sums)
        sum = dealii::Utilities::MPI::sum(sum, processes);
    return {std::sqrt(sums[0] / sums[1]), std::sqrt(sums[2] / sums[3])};
}

std::vector<StressPatch> ElasticFootwall::stress() const {
    require_solution();
    // The corners of the quarters, three in a row, then their middles.
    std::vector<Point<2>> places;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            places.emplace_back(0.5 * column, 0.5 * row);
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 2; ++column)
            places.emplace_back(0.25 + 0.5 * column, 0.25 + 0.5 * row);
    dealii::FEValues<2> values(mapping_, element_, dealii::Quadrature<2>(places), volume_flags);
    const dealii::FEValuesExtractors::Vector u(0);
    std::vector<Tensor<1, 2>> moved(places.size());
    std::vector<Tensor<2, 2>> slopes(places.size());
    std::vector<StressPatch> result;
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        values[u].get_function_values(displacement_, moved);
        values[u].get_function_gradients(displacement_, slopes);
        for (unsigned quarter = 0; quarter < 4; ++quarter) {
            StressPatch patch;
            const unsigned first = quarter / 2 * 3 + quarter % 2;
            const unsigned around[4] = {first, first + 1, first + 4, first + 3};
            for (unsigned k = 0; k < 4; ++k) {
                patch.corner[k] = plain(values.quadrature_point(around[k]));
                patch.displacement[k] = {moved[around[k]][0], moved[around[k]][1]};
            }
            const auto& g = slopes[9 + quarter];
            const Rock rock = material_.at(plain(values.quadrature_point(9 + quarter)));
            const double trace = rock.lambda * (g[0][0] + g[1][1]);
            patch.xx = trace + 2.0 * rock.mu * g[0][0];
            patch.yy = trace + 2.0 * rock.mu * g[1][1];
            patch.xy = rock.mu * (g[0][1] + g[1][0]);
            result.push_back(patch);
        }
    });
    return result;
}

Vector ElasticFootwall::reaction() const {
    require_solution();
    const dealii::QGauss<1> points = face_quadrature();
    dealii::FEFaceValues<2> values(mapping_, element_, points, face_flags);
    const dealii::FEValuesExtractors::Vector u(0);
    std::vector<Tensor<1, 2>> found(points.size());
    double sums[2] = {0.0, 0.0};
    for_each_own_cell([&](const auto& cell) {
        for (const unsigned f : cell->face_indices()) {
            if (!cell->face(f)->at_boundary())
                continue;
            const int boundary = static_cast<int>(cell->face(f)->boundary_id());
            values.reinit(cell, f);
            values[u].get_function_values(displacement_, found);
            for (unsigned q = 0; q < points.size(); ++q) {
                sums[0] -= values.JxW(q) * found[q][0] *
                           side_spring(boundary, plain(values.quadrature_point(q)));
                sums[1] -= values.JxW(q) * found[q][1] * spring(boundary) *
                           std::abs(values.normal_vector(q)[1]);
            }
        }
    });
    return {dealii::Utilities::MPI::sum(sums[0], processes),
            dealii::Utilities::MPI::sum(sums[1], processes)};
}

Guard ElasticFootwall::guard(double rock_weight) const {
    require_solution();
    const dealii::QGauss<2> points = quadrature();
    dealii::FEValues<2> values(mapping_, element_, points, volume_flags);
    const dealii::FEValuesExtractors::Vector u(0);
    std::vector<Tensor<2, 2>> slopes(points.size());
    Guard guard;
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        values[u].get_function_gradients(displacement_, slopes);
        for (unsigned q = 0; q < points.size(); ++q) {
            const Vector place = plain(values.quadrature_point(q));
            const Rock rock = material_.at(place);
            const Tensor<2, 2>& slope = slopes[q];
            // Centre and radius of the strain's Mohr circle.
            const double centre = 0.5 * (slope[0][0] + slope[1][1]);
            const double radius =
                0.5 * std::hypot(slope[0][0] - slope[1][1], slope[0][1] + slope[1][0]);
            double& most = rock.relaxed ? guard.relaxed_strain : guard.strong_strain;
            most = std::max(most, std::abs(centre) + radius);
            guard.rotation = std::max(guard.rotation, 0.5 * std::abs(slope[1][0] - slope[0][1]));
            const double pressure =
                -rock_weight * place.y - 2.0 * (rock.lambda + rock.mu) * centre;
            if (!rock.relaxed && beyond_byerlee(pressure, 2.0 * rock.mu * radius))
                guard.beyond_byerlee += values.JxW(q);
        }
    });
    return {dealii::Utilities::MPI::max(guard.strong_strain, processes),
            dealii::Utilities::MPI::max(guard.relaxed_strain, processes),
            dealii::Utilities::MPI::max(guard.rotation, processes),
            dealii::Utilities::MPI::sum(guard.beyond_byerlee, processes)};
}

void ElasticFootwall::refine(double share_of_cells) {
    require_solution();
    dealii::Vector<float> jumps(mesh_.cells->n_active_cells());
    dealii::KellyErrorEstimator<2>::estimate(
        mapping_, unknowns_, face_quadrature(), {}, displacement_, jumps, {}, nullptr,
        dealii::numbers::invalid_unsigned_int, mesh_.cells->locally_owned_subdomain());
    dealii::parallel::distributed::GridRefinement::refine_and_coarsen_fixed_number(
        *mesh_.cells, jumps, share_of_cells, 0.0);
    mesh_.cells->execute_coarsening_and_refinement();
    refined_ = true;
    set_up();
}

void ElasticFootwall::write(const std::string& folder, const std::string& name) const {
    require_solution();
    const StressOutput stress(material_);
    dealii::DataOut<2> out;
    out.attach_dof_handler(unknowns_);
    const std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation> vector(
        2, dealii::DataComponentInterpretation::component_is_part_of_vector);
    out.add_data_vector(displacement_, std::vector<std::string>(2, "displacement_m"),
                        dealii::DataOut<2>::type_dof_data, vector);
    out.add_data_vector(displacement_, stress);
    out.build_patches(mapping_, static_cast<unsigned>(request_.degree),
                      dealii::DataOut<2>::curved_inner_cells);
    const std::string file = folder + "/" + name + ".vtu";
    out.write_vtu_in_parallel(file, processes);
}

/// Starts MPI and PETSc with the first footwall and ends them with the program.
void start_once() {
    static char name[] = "listric", quiet[] = "-no_signal_handler";
    static char* words[] = {name, quiet, nullptr};
    static int count = 2;
    static char** arguments = words;
    // The 1 keeps deal.II's own threads away.
    static dealii::Utilities::MPI::MPI_InitFinalize session(count, arguments, 1);
}

} // namespace

} // namespace listric::fem

extern "C" __attribute__((visibility("default"))) listric::fem::Footwall*
listric_make_footwall(const listric::fem::FootwallRequest& request, std::string& message) {
    try {
        listric::fem::start_once();
        return new listric::fem::ElasticFootwall(request);
    } catch (const std::exception& error) {
        message = error.what();
        return nullptr;
    }
}
