#pragma once

#include "fem/footwall.hpp"
#include "fem/material.hpp"
#include "fem/mesh.hpp"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q_cache.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/petsc_sparse_matrix.h>
#include <deal.II/lac/petsc_vector.h>
#include <petscksp.h>

#include <utility>

namespace listric::fem {

using Index = dealii::types::global_dof_index;
using GlobalVector = dealii::PETScWrappers::MPI::Vector;

inline void must(PetscErrorCode code, const char* what) {
    if (code)
        throw FootwallError(std::string("the solver failed: ") + what);
}

/// Plane-strain elasticity by finite elements of degree 1 or 2: assembled and solved in
/// elasticity.cpp, condensed to the interface in condensation.cpp, read off in solution.cpp.
class ElasticFootwall final : public Footwall {
public:
    /// @param processes  those that solve together
    ElasticFootwall(const FootwallRequest& request, MPI_Comm processes)
        : processes_(processes), request_(request), mesh_(make_mesh(request, processes)),
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
        return static_cast<int>(dealii::Utilities::MPI::this_mpi_process(processes_));
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
    const std::vector<StressPoint>& stress_points() const override { return stress_points_; }
    void take_step(double seconds) override;
    std::vector<double> stress_left(double seconds) const override;
    void take_isotherm(std::vector<Vector> line) override;
    std::vector<double> stress_left_below(const std::vector<Vector>& isotherm) const override;
    std::vector<double> work() const override;
    void refine(double share_of_cells) override;
    void write(const std::string& folder, const std::string& name) const override;

private:
    static inline const dealii::UpdateFlags volume_flags =
        dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points |
        dealii::update_JxW_values;
    static inline const dealii::UpdateFlags face_flags =
        dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points |
        dealii::update_JxW_values | dealii::update_normal_vectors;

    dealii::QGauss<2> quadrature() const {
        return dealii::QGauss<2>(static_cast<unsigned>(request_.degree) + 1);
    }
    dealii::QGauss<1> face_quadrature() const {
        return dealii::QGauss<1>(static_cast<unsigned>(request_.degree) + 2);
    }
    /// The boundary that the interface lies on.
    Boundary wall() const {
        return request_.detachment.empty() ? Boundary::surface : Boundary::detachment;
    }
    double arc_length(Vector on_wall) const {
        return wall() == Boundary::surface ? on_wall.x - request_.left
                                           : mesh_.detachment.nearest(on_wall);
    }
    /// Vertical stiffness of what a boundary rests in, Pa/m.
    double spring(Boundary boundary) const {
        switch (boundary) {
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
    /// Pressure -k y in the rock that turns with a boundary: k y, Pa. The surface has none, and
    /// at the level base rock and mantle press the same.
    double turned_pressure(Boundary boundary, Vector place) const {
        return boundary == Boundary::detachment ? spring(boundary) * place.y : 0.0;
    }
    /// Horizontal stiffness of a far side, Pa/m.
    double side_spring(Boundary boundary, Vector place) const {
        const Side side = boundary == Boundary::left    ? request_.left_side
                          : boundary == Boundary::right ? request_.right_side
                                                        : Side::free;
        if (side != Side::elastic)
            return 0.0;
        const Rock rock = material_.at_once(place);
        return (rock.lambda + 2.0 * rock.mu) / (request_.right - request_.left);
    }

    void set_up();
    void assemble_anew();
    std::vector<double> stress_left(const ElasticRock& next) const;
    void measure_mesh();
    struct FaceOnWall;
    std::vector<FaceOnWall> own_faces_on_wall() const;
    void find_interface();
    void find_stress_points();
    void assemble();
    void add_springs(const dealii::FEFaceValues<2>& values, Boundary boundary,
                     const std::vector<unsigned>& component,
                     dealii::FullMatrix<double>& local) const;
    void make_solver(bool keep_interface);
    void use_factors(PC preconditioner, bool keep_interface);
    void use_multigrid(PC preconditioner);
    void name_rigid_motions(); ///< to the multigrid
    Mat solver_factors() const;
    std::vector<unsigned> components() const;
    std::pair<GlobalVector, Vector> forces_of(const Load& load) const;
    void add_stress(const std::vector<double>& stress, GlobalVector& forces) const;
    std::vector<double> strain_deviators() const; ///< by stress_points(), xx, yy, xy
    std::vector<double> stress_deviators() const;
    void add_interface_forces(const std::vector<double>& load, GlobalVector& forces,
                              Vector& sum) const;
    GlobalVector displacement_under(const GlobalVector& forces);
    std::vector<double> at_interface(const GlobalVector& displacement) const;
    std::vector<double> inverse_of_schur_complement();
    std::vector<double> unit_solutions();
    void require_solution() const {
        if (displacement_.size() == 0)
            throw FootwallError("the footwall has no solution yet: solve first");
    }
    /// Cells with stress points, the first of these and their quadrature points.
    template <class Visit> void for_each_relaxing_cell(Visit&& visit) const {
        if (stress_points_.empty())
            return;
        std::size_t first = 0;
        for_each_own_cell([&](const auto& cell) {
            const std::vector<unsigned>& points = relaxing_[cell->active_cell_index()];
            if (!points.empty())
                visit(cell, first, points);
            first += points.size();
        });
    }
    template <class Visit> void for_each_own_cell(Visit&& visit) const {
        for (const auto& cell : unknowns_.active_cell_iterators())
            if (cell->is_locally_owned())
                visit(cell);
    }

    MPI_Comm processes_;
    FootwallRequest request_;
    Mesh mesh_;
    ElasticRock material_;
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
    std::vector<StressPoint> stress_points_;
    std::vector<std::vector<unsigned>> relaxing_; ///< by cell: its quadrature points that relax
    std::vector<double> stress_;                  ///< of the last load
    std::vector<GlobalVector> kept_loads_;        ///< of the last responses(), where rock relaxes
    Vector total_load_;
    int iterations_ = 0;
    bool refined_ = false;
    bool keeps_interface_ = false; ///< the factors end at the interface's Schur complement
};

} // namespace listric::fem
