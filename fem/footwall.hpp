#pragma once

// The elastic footwall as the rest of the program sees it: plain numbers in, plain numbers out. It
// knows no discs and names no finite-element library, which lives in a plug-in that is loaded when
// a scene asks for an elastic base.

#include "fem/relaxation.hpp"
#include "fem/request.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace listric::fem {

struct InterfaceNode {
    Vector place;            ///< m
    double arc_length = 0.0; ///< along the detachment (or the flat surface) from its start, m
};

/// Edge of an element on the interface: nodes in the order start, end, middle (degree 2 only).
struct InterfaceFace {
    std::array<std::size_t, 3> nodes;
};

struct PointForce {
    Vector place; ///< m; the closest point of the interface takes it
    Vector force; ///< N per m of strike
};

/// Loads on the footwall, in addition to its initial state.
struct Load {
    std::function<Vector(Vector place)> body;                                      ///< N/m^3
    std::function<Vector(Vector place, Vector outward_normal, Boundary)> traction; ///< Pa
    std::vector<double> interface; ///< forces on the nodes: x, y of the first, ...; N per m
    /// x where the traction jumps, m: straight faces are integrated in parts there, so that the
    /// load keeps its sum and its moment on any mesh.
    std::vector<double> jumps;
    /// Stress that rock has beside that of its strain, by Footwall::stress_points(), Pa: what is
    /// left from before the step.
    std::vector<double> stress;
};

/// Responses of the footwall to m loads, each alone.
struct Responses {
    std::vector<double> interface; ///< displacement of the interface's n nodes: m rows of 2 n, m
    /// Work of every load on another's displacement: m by m, symmetric (Betti), J/m. The work of a
    /// unit pressure over its width is the mean displacement of the boundary there.
    std::vector<double> work;
    std::vector<Vector> sums; ///< of the loads, N/m
};

struct MeshFacts {
    std::size_t cells = 0, unknowns = 0;
    double area = 0.0;           ///< m^2
    double least_jacobian = 0.0; ///< smallest over largest area element within a cell: 1 is best
};

/// Displacement at the nodes of all elements, sorted by y, then x.
struct Field {
    std::vector<Vector> place, displacement; ///< m
    std::vector<std::size_t> surface;        ///< nodes on the surface, from the left
};

/// A quarter of an element, and the stress in its middle.
struct StressPatch {
    std::array<Vector, 4> corner, displacement; ///< around it, m
    double xx = 0.0, yy = 0.0, xy = 0.0;        ///< Pa; tension positive
    bool is_relaxed = false;                    ///< its rock's shear modulus is divided
};

struct ExactField {
    std::function<Vector(Vector place)> displacement;
    std::function<std::array<double, 4>(Vector place)>
        gradient; ///< du_x/dx du_x/dy du_y/dx du_y/dy
};

/// Norms of the difference over those of the exact field; H1 is of the gradient alone.
struct FieldError {
    double l2 = 0.0, h1 = 0.0;
};

/// Signs that the last solution is one of linear elasticity. Strains are the largest
/// principal ones of (grad u + grad u^T) / 2, without sign.
struct Guard {
    double strong_strain = 0.0;  ///< in rock that is not relaxed
    double relaxed_strain = 0.0; ///< in relaxed rock
    double rotation = 0.0;       ///< largest in any rock, rad
    /// Area of rock that is not relaxed where lithostatic pressure and the solution's stress exceed
    /// Byerlee's law (1978): tau = 0.85 sigma_n, or 60 MPa + 0.6 sigma_n at high pressure; m^2.
    double beyond_byerlee = 0.0;
};

/// A footwall that was meshed and whose stiffness is known. One thread at a time may make, ask or
/// end footwalls, for MUMPS has variables that all factorisations share. Under MPI every call is
/// collective and every process gets the same answer.
class Footwall {
public:
    Footwall() = default;
    virtual ~Footwall() = default;
    Footwall(const Footwall&) = delete;
    Footwall& operator=(const Footwall&) = delete;

    virtual MeshFacts mesh() const = 0;
    virtual int process() const = 0; ///< number of this one under MPI, 0 without

    /// Nodes on the detachment (of a flat layer: on the surface) that can move, from its start on.
    virtual const std::vector<InterfaceNode>& interface() const = 0;
    virtual const std::vector<InterfaceFace>& interface_faces() const = 0;

    /// Forces on the interface's nodes that are equivalent to forces at points: the shape functions
    /// at the closest point of the trace X = sum N_i X_i, so that force and moment are kept. Throws
    /// FootwallError where a place is not finite.
    virtual std::vector<double> nodal_forces(std::span<const PointForce> forces) const = 0;

    /// Displacements of the interface's nodes for unit forces on them: symmetric, positive
    /// definite, 2 n by 2 n for n nodes, by rows; m per N/m. Condensed exactly from the full
    /// stiffness.
    virtual std::vector<double> compliance() = 0;

    /// Solves for the full field, which the calls below then describe.
    virtual void solve(const Load& load) = 0;

    /// Where rock relaxes; nowhere: it has no viscosity. One process only.
    virtual const std::vector<StressPoint>& stress_points() const = 0;

    /// From now on solutions are those of a step's end, s, over which rock relaxes as Maxwell says;
    /// 0: it answers at once. Compliance and solution are gone.
    virtual void take_step(double seconds) = 0;

    /// Load::stress for a step that begins with the last solution, by stress_points(), Pa.
    virtual std::vector<double> stress_left(double seconds) const = 0;

    /// From now on the isotherm is this one, m; the request had one, too. Compliance and solution
    /// are gone.
    virtual void take_isotherm(std::vector<Vector> line) = 0;

    /// Load::stress for a footwall with that isotherm that begins with the last solution: none for
    /// what is hot then, whose strain makes its stress.
    virtual std::vector<double> stress_left_below(const std::vector<Vector>& isotherm) const = 0;

    /// Work of the loads of the last responses() on the last solution, J/m.
    virtual std::vector<double> work() const = 0;

    /// Solves for loads that are to be superposed. Forces on the interface displace a load's
    /// boundary by the transpose: work = row of `interface` times forces. Leaves the last solution.
    virtual Responses responses(std::span<const Load> loads) = 0;
    virtual int iterations() const = 0; ///< of the last solve; 1 for factors
    virtual std::vector<double> interface_displacement() const = 0;
    virtual Field field() const = 0;
    virtual std::vector<StressPatch> stress() const = 0; ///< of this process's elements
    virtual FieldError error(const ExactField& exact) const = 0;
    virtual Vector reaction() const = 0;   ///< force of springs and sides on the rock, N/m
    virtual Vector total_load() const = 0; ///< sum of the last load, N/m
    virtual Guard guard(double rock_weight) const = 0; ///< weight of rock, N/m^3

    /// Refines the cells with the largest jumps of the last solution's gradient (Kelly et al.
    /// 1983), a share from 0 to 1. The solution is gone; the interface has no condensed form any
    /// more.
    virtual void refine(double share_of_cells) = 0;

    /// Writes the last solution as folder/name.vtu: displacement, stress, density, elastic moduli.
    /// The file is replaced whole or not at all. Throws WriteError.
    virtual void write(const std::string& folder, const std::string& name) const = 0;
};

/// Least size of cells over the footwall's width and depth.
inline constexpr double least_cell_share = 1e-5;

/// Refuses impossible numbers. Throws FootwallError.
void check(const FootwallRequest& request);

/// Loads the plug-in, at the first call, and makes a footwall. Throws FootwallError, which names
/// the packages to install where the plug-in is missing.
std::unique_ptr<Footwall> make_footwall(const FootwallRequest& request);

/// A series of written fields that ParaView opens: file names beside the .pvd, and their times. The
/// file is replaced whole or not at all. Throws WriteError.
void write_series(const std::string& pvd, std::span<const std::pair<double, std::string>> moments);

/// The plug-in's only entry. On failure null, with the reason in `message`. Its name,
/// LISTRIC_FEM_ENTRY, has a hash of this file and of those of fem/ that it includes: a plug-in of
/// another build has none of that name.
extern "C" {
using MakeFootwall = Footwall* (*)(const FootwallRequest& request, std::string& message);
}

} // namespace listric::fem
