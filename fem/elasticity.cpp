// Assembly, loads and solvers.

#include "fem/elasticity.hpp"

#include <deal.II/base/multithread_info.h>
#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/error_estimator.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <new>

namespace listric::fem {

using dealii::Point;
using dealii::Tensor;

namespace {

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

/// Quadrature points once in every part of a face.
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

/// Adds the lower triangle of a cell's integral of sigma(u) : eps(v).
void add_stiffness(const dealii::FEValues<2>& values, const ElasticRock& material,
                   const std::vector<unsigned>& component, dealii::FullMatrix<double>& local) {
    for (const unsigned q : values.quadrature_point_indices()) {
        const Rock rock = material.at(plain(values.quadrature_point(q)));
        const double w = values.JxW(q);
        for (unsigned i = 0; i < component.size(); ++i) {
            const Tensor<1, 2> gi = values.shape_grad(i, q);
            const unsigned a = component[i];
            for (unsigned j = 0; j <= i; ++j) {
                const Tensor<1, 2> gj = values.shape_grad(j, q);
                const unsigned b = component[j];
                // of one-component fields u = N_j e_b, v = N_i e_a
                local(i, j) += w * (rock.lambda * gi[a] * gj[b] + rock.mu * gi[b] * gj[a] +
                                    (a == b ? rock.mu * (gi * gj) : 0.0));
            }
        }
    }
}

/// Adds the integral of v . f over a cell or face, and of f to the total; f by quadrature point.
template <class Values, class Force>
void add_forces(const Values& values, const std::vector<unsigned>& component, Force&& force,
                dealii::Vector<double>& local, Vector& total) {
    for (const unsigned q : values.quadrature_point_indices()) {
        const Vector f = force(q);
        const double w = values.JxW(q);
        total = total + w * f;
        for (unsigned i = 0; i < component.size(); ++i)
            local(i) += w * values.shape_value(i, q) * (component[i] == 0 ? f.x : f.y);
    }
}

/// Takes a cell's integral of stress : eps(v) from its forces, by quadrature point, xx, yy, xy.
void take_stress(const dealii::FEValues<2>& values, unsigned q, const double* stress,
                 const std::vector<unsigned>& component, dealii::Vector<double>& local) {
    const double rows[2][2] = {{stress[0], stress[2]}, {stress[2], stress[1]}};
    for (unsigned i = 0; i < component.size(); ++i) {
        const Tensor<1, 2> g = values.shape_grad(i, q);
        const double* row = rows[component[i]];
        local(i) -= values.JxW(q) * (row[0] * g[0] + row[1] * g[1]);
    }
}

/// Stands in for deal.II's start, where MPI and PETSc have already been started.
bool join_those_who_started() {
    int started = 0;
    MPI_Initialized(&started);
    if (!started)
        return false;
    sc_init(MPI_COMM_SELF, 0, 0, nullptr, SC_LP_SILENT);
    p4est_init(nullptr, SC_LP_SILENT);
    dealii::MultithreadInfo::set_thread_limit(1);
    return true;
}

/// Starts MPI and PETSc with the first footwall and ends them with the program. Returns those that
/// solve together: all that were started, or this one alone where MPI is already there for
/// something else, as where processes share the discs.
MPI_Comm start_once() {
    static const bool has_joined = join_those_who_started();
    if (has_joined)
        return MPI_COMM_SELF;
    static char name[] = "listric", quiet[] = "-no_signal_handler";
    static char* words[] = {name, quiet, nullptr};
    static int count = 2;
    static char** arguments = words;
    // The 1 keeps deal.II's own threads away.
    static dealii::Utilities::MPI::MPI_InitFinalize session(count, arguments, 1);
    return MPI_COMM_WORLD;
}

} // namespace

void ElasticFootwall::set_up() {
    if (solver_)
        must(KSPDestroy(&solver_), "cannot drop the old factors");
    keeps_interface_ = false;
    displacement_.clear();
    mapping_.initialize(dealii::MappingQ<2>(static_cast<unsigned>(request_.degree)), *mesh_.cells);
    unknowns_.distribute_dofs(element_);
    owned_ = unknowns_.locally_owned_dofs();
    relevant_ = dealii::DoFTools::extract_locally_relevant_dofs(unknowns_);

    constraints_.clear();
#if DEAL_II_VERSION_GTE(9, 6, 0)
    constraints_.reinit(owned_, relevant_);
#else
    constraints_.reinit(relevant_);
#endif
    dealii::DoFTools::make_hanging_node_constraints(unknowns_, constraints_);
    for (const auto& [side, boundary] : {std::pair(request_.left_side, Boundary::left),
                                         std::pair(request_.right_side, Boundary::right)})
        if (side == Side::roller) {
            const dealii::IndexSet held = dealii::DoFTools::extract_boundary_dofs(
                unknowns_, dealii::ComponentMask(std::vector<bool>{true, false}),
                {id_of(boundary)});
            for (const Index i : held)
                if (!constraints_.is_constrained(i))
                    constraints_.add_line(i);
        }
    constraints_.close();

    dealii::DynamicSparsityPattern pattern(relevant_);
    dealii::DoFTools::make_sparsity_pattern(unknowns_, pattern, constraints_, false);
    dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned_, processes_, relevant_);
    stiffness_.reinit(owned_, owned_, pattern, processes_);
    measure_mesh();
    find_interface();
    find_stress_points();
    assemble();
}

void ElasticFootwall::find_stress_points() {
    stress_points_.clear();
    relaxing_.clear();
    if (request_.isotherm.empty() && std::ranges::none_of(request_.layers, [](const Layer& layer) {
            return layer.viscosity.has_value();
        }))
        return;
    if (dealii::Utilities::MPI::n_mpi_processes(processes_) > 1)
        throw FootwallError("rock with a viscosity, or that gets hot, needs one process for the "
                            "footwall");
    relaxing_.resize(mesh_.cells->n_active_cells());
    const dealii::QGauss<2> points = quadrature();
    dealii::FEValues<2> values(mapping_, element_, points, dealii::update_quadrature_points);
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        for (unsigned q = 0; q < points.size(); ++q) {
            const Vector place = plain(values.quadrature_point(q));
            const Rock rock = material_.at_once(place);
            if (!rock.remembers)
                continue;
            relaxing_[cell->active_cell_index()].push_back(q);
            stress_points_.push_back({place, rock.relaxation_time, cell->active_cell_index()});
        }
    });
}

void ElasticFootwall::take_step(double seconds) {
    material_.take_step(seconds);
    assemble_anew();
}

void ElasticFootwall::take_isotherm(std::vector<Vector> line) {
    material_.take_isotherm(std::move(line));
    assemble_anew();
}

void ElasticFootwall::assemble_anew() {
    if (solver_)
        must(KSPDestroy(&solver_), "cannot drop the old factors");
    keeps_interface_ = false;
    displacement_.clear();
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
              dealii::Utilities::MPI::sum(area, processes_),
              dealii::Utilities::MPI::min(least, processes_)};
    if (!(facts_.least_jacobian > 0.0))
        throw FootwallError("no mesh: cells fold over; make cells or skin smaller");
}

/// Component of every unknown of an element: 0 for x, 1 for y.
std::vector<unsigned> ElasticFootwall::components() const {
    std::vector<unsigned> component(element_.n_dofs_per_cell());
    for (unsigned i = 0; i < component.size(); ++i)
        component[i] = element_.system_to_component_index(i).first;
    return component;
}

void ElasticFootwall::assemble() {
    const dealii::QGauss<1> face_points = face_quadrature();
    dealii::FEValues<2> values(mapping_, element_, quadrature(), volume_flags);
    dealii::FEFaceValues<2> face_values(mapping_, element_, face_points, face_flags);
    const unsigned n = element_.n_dofs_per_cell();
    dealii::FullMatrix<double> local(n, n); // its lower triangle first
    std::vector<Index> indices(n);
    const std::vector<unsigned> component = components();
    stiffness_ = 0.0;
    for_each_own_cell([&](const auto& cell) {
        values.reinit(cell);
        local = 0.0;
        add_stiffness(values, material_, component, local);
        for (const unsigned f : cell->face_indices()) {
            if (!cell->face(f)->at_boundary())
                continue;
            const auto boundary = static_cast<Boundary>(cell->face(f)->boundary_id());
            if (spring(boundary) == 0.0 && boundary != Boundary::left &&
                boundary != Boundary::right)
                continue;
            face_values.reinit(cell, f);
            add_springs(face_values, boundary, component, local);
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

/// Adds the lower triangle of what holds a boundary. Rock of weight k = rho g (N/m^3) under its
/// overburden presses on its boundary as a liquid does that fills it; the energy of such a liquid
/// is k / 2 times the integral of y^2 dx, and its second variation along the tangent t is
///   k (u_y v_y n_y + y (v_y du_x/dt + u_y dv_x/dt)) ds.
/// The first term are the vertical springs; the others turn the pressure with the boundary. In
/// parts, k (u_y n + y (-du_y/dt, du_x/dt)): stress that the displacement carries along (k u_y n),
/// and the change of the element on which the pressure stood. Neither is symmetric without the
/// other. The liquid is what the rock becomes where it keeps its volume: the rest of its prestress,
/// k times displacement and dilation, is k L / (lambda + 2 mu) of its elasticity, 0.5 % at 15 km.
void ElasticFootwall::add_springs(const dealii::FEFaceValues<2>& values, Boundary boundary,
                                  const std::vector<unsigned>& component,
                                  dealii::FullMatrix<double>& local) const {
    for (const unsigned q : values.quadrature_point_indices()) {
        const double w = values.JxW(q);
        const Vector place = plain(values.quadrature_point(q));
        const auto normal = values.normal_vector(q);
        const double stiffness[2] = {side_spring(boundary, place),
                                     spring(boundary) * std::abs(normal[1])};
        const double turned = turned_pressure(boundary, place);
        const Tensor<1, 2> tangent({normal[1], -normal[0]});
        for (unsigned i = 0; i < component.size(); ++i)
            for (unsigned j = 0; j <= i; ++j) {
                const double ni = values.shape_value(i, q), nj = values.shape_value(j, q);
                if (component[i] == component[j])
                    local(i, j) += w * stiffness[component[i]] * ni * nj;
                else if (turned != 0.0)
                    local(i, j) += w * turned *
                                   (component[i] == 1 ? ni * (values.shape_grad(j, q) * tangent)
                                                      : nj * (values.shape_grad(i, q) * tangent));
            }
    }
}

void ElasticFootwall::make_solver(bool keep_interface) {
    if (solver_)
        must(KSPDestroy(&solver_), "cannot drop the old factors");
    keeps_interface_ = keep_interface;
    const Mat matrix = stiffness_;
    PC preconditioner = nullptr;
    must(KSPCreate(processes_, &solver_), "no solver");
    must(KSPSetOperators(solver_, matrix, matrix), "no operator");
    must(KSPGetPC(solver_, &preconditioner), "no preconditioner");
    if (request_.solver == Solver::mumps)
        use_factors(preconditioner, keep_interface);
    else
        use_multigrid(preconditioner);
    must(KSPSetUp(solver_), "the stiffness has no factors");
}

void ElasticFootwall::use_factors(PC preconditioner, bool keep_interface) {
    must(KSPSetType(solver_, KSPPREONLY), "type");
    must(PCSetType(preconditioner, PCCHOLESKY), "Cholesky");
    must(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS), "MUMPS");
    if (!keep_interface)
        return;
    std::vector<PetscInt> kept;
    for (const auto& node : node_unknowns_)
        for (const Index unknown : node)
            kept.push_back(static_cast<PetscInt>(unknown));
    IS interface = nullptr;
    must(ISCreateGeneral(processes_, static_cast<PetscInt>(kept.size()), kept.data(),
                         PETSC_COPY_VALUES, &interface),
         "interface");
    must(PCFactorSetUpMatSolverType(preconditioner), "MUMPS");
    must(MatFactorSetSchurIS(solver_factors(), interface), "interface");
    must(ISDestroy(&interface), "interface");
}

void ElasticFootwall::use_multigrid(PC preconditioner) {
    const Mat matrix = stiffness_;
    must(KSPSetType(solver_, KSPCG), "conjugate gradients");
    must(KSPSetTolerances(solver_, 1e-12, PETSC_DEFAULT, PETSC_DEFAULT, 1000), "tolerance");
    // Unknowns come in pairs x, y, which both multigrids want to know.
    must(MatSetBlockSize(matrix, 2), "block size");
    if (request_.solver == Solver::boomeramg) {
        must(PCSetType(preconditioner, PCHYPRE), "hypre");
        must(PCHYPRESetType(preconditioner, "boomeramg"), "BoomerAMG");
    } else {
        must(PCSetType(preconditioner, PCGAMG), "GAMG");
        name_rigid_motions();
    }
}

void ElasticFootwall::name_rigid_motions() {
    GlobalVector places(owned_, processes_);
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
    const Mat matrix = stiffness_;
    MatNullSpace motions = nullptr;
    must(VecSetBlockSize(coordinates, 2), "block size");
    must(MatNullSpaceCreateRigidBody(coordinates, &motions), "rigid motions");
    must(MatSetNearNullSpace(matrix, motions), "rigid motions");
    must(MatNullSpaceDestroy(&motions), "rigid motions");
}

/// The load's forces on all unknowns, and their sum.
std::pair<GlobalVector, Vector> ElasticFootwall::forces_of(const Load& load) const {
    GlobalVector forces(owned_, processes_);
    const dealii::QGauss<2> points(static_cast<unsigned>(request_.degree) + 2);
    // Points enough for loads that bend inside an element, or end there unannounced.
    const dealii::QGauss<1> gauss(static_cast<unsigned>(request_.degree) + 3);
    dealii::FEValues<2> values(mapping_, element_, points, volume_flags);
    dealii::FEFaceValues<2> whole_face(mapping_, element_, dealii::QIterated<1>(gauss, 4),
                                       face_flags);
    const std::vector<unsigned> component = components();
    dealii::Vector<double> local(element_.n_dofs_per_cell());
    std::vector<Index> indices(element_.n_dofs_per_cell());
    Vector total;
    for_each_own_cell([&](const auto& cell) {
        if (!load.body && !(load.traction && cell->at_boundary()))
            return;
        local = 0.0;
        if (load.body) {
            values.reinit(cell);
            add_forces(
                values, component,
                [&](unsigned q) { return load.body(plain(values.quadrature_point(q))); }, local,
                total);
        }
        for (const unsigned f : cell->face_indices()) {
            if (!load.traction || !cell->face(f)->at_boundary())
                continue;
            std::unique_ptr<dealii::FEFaceValues<2>> parts;
            if (const std::vector<double> at = jumps_within(*cell->face(f), load.jumps);
                !at.empty())
                parts = std::make_unique<dealii::FEFaceValues<2>>(mapping_, element_,
                                                                  in_parts(gauss, at), face_flags);
            dealii::FEFaceValues<2>& face_values = parts ? *parts : whole_face;
            face_values.reinit(cell, f);
            const auto boundary = static_cast<Boundary>(cell->face(f)->boundary_id());
            const auto traction = [&](unsigned q) {
                const auto normal = face_values.normal_vector(q);
                return load.traction(plain(face_values.quadrature_point(q)), {normal[0], normal[1]},
                                     boundary);
            };
            add_forces(face_values, component, traction, local, total);
        }
        cell->get_dof_indices(indices);
        constraints_.distribute_local_to_global(local, indices, forces);
    });
    Vector sum{dealii::Utilities::MPI::sum(total.x, processes_),
               dealii::Utilities::MPI::sum(total.y, processes_)};
    if (!load.interface.empty())
        add_interface_forces(load.interface, forces, sum);
    if (!load.stress.empty())
        add_stress(load.stress, forces);
    forces.compress(dealii::VectorOperation::add);
    return {std::move(forces), sum};
}

/// Forces that balance a stress; their sum is 0.
void ElasticFootwall::add_stress(const std::vector<double>& stress, GlobalVector& forces) const {
    if (stress.size() != 3 * stress_points_.size())
        throw FootwallError("the load has stress at " + std::to_string(stress.size() / 3) +
                            " points, the footwall relaxes at " +
                            std::to_string(stress_points_.size()));
    dealii::FEValues<2> values(mapping_, element_, quadrature(),
                               dealii::update_gradients | dealii::update_JxW_values);
    const std::vector<unsigned> component = components();
    dealii::Vector<double> local(element_.n_dofs_per_cell());
    std::vector<Index> indices(element_.n_dofs_per_cell());
    for_each_relaxing_cell([&](const auto& cell, std::size_t first, const auto& points) {
        values.reinit(cell);
        local = 0.0;
        for (std::size_t k = 0; k < points.size(); ++k)
            take_stress(values, points[k], &stress[3 * (first + k)], component, local);
        cell->get_dof_indices(indices);
        constraints_.distribute_local_to_global(local, indices, forces);
    });
}

void ElasticFootwall::add_interface_forces(const std::vector<double>& load, GlobalVector& forces,
                                           Vector& sum) const {
    if (load.size() != 2 * nodes_.size())
        throw FootwallError("the load has " + std::to_string(load.size()) +
                            " interface forces, the interface " +
                            std::to_string(2 * nodes_.size()));
    for (std::size_t i = 0; i < load.size(); ++i) {
        const Index unknown = node_unknowns_[i / 2][i % 2];
        if (owned_.is_element(unknown))
            forces(unknown) += load[i];
        (i % 2 ? sum.y : sum.x) += load[i];
    }
}

GlobalVector ElasticFootwall::displacement_under(const GlobalVector& forces) {
    if (!solver_)
        make_solver(false);
    GlobalVector solution(owned_, processes_);
    const Vec right = forces, left = solution;
    must(KSPSolve(solver_, right, left), "no solution");
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    must(KSPGetConvergedReason(solver_, &reason), "no solution");
    must(KSPGetIterationNumber(solver_, &iterations), "no solution");
    if (reason == KSP_DIVERGED_PC_FAILED) {
        PC factors = nullptr;
        PCFailedReason cause = PC_NOERROR;
        must(KSPGetPC(solver_, &factors), "no solution");
        must(PCGetFailedReason(factors, &cause), "no solution");
        if (cause == PC_FACTOR_OUTMEMORY)
            throw std::bad_alloc();
    }
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
    displacement_.reinit(owned_, relevant_, processes_);
    displacement_ = solution;
    stress_ = load.stress;
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
    if (!stress_points_.empty())
        kept_loads_ = std::move(forces);
    return result;
}

void ElasticFootwall::refine(double share_of_cells) {
    assert(share_of_cells >= 0.0 && share_of_cells <= 1.0);
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

} // namespace listric::fem

extern "C" __attribute__((visibility("default"))) listric::fem::Footwall*
LISTRIC_FEM_ENTRY(const listric::fem::FootwallRequest& request, std::string& message);

listric::fem::Footwall* LISTRIC_FEM_ENTRY(const listric::fem::FootwallRequest& request,
                                          std::string& message) {
    try {
        return new listric::fem::ElasticFootwall(request, listric::fem::start_once());
    } catch (const std::exception& error) {
        message = error.what();
        return nullptr;
    }
}
