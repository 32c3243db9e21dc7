#include "coupling/interface.hpp"

#include "coupling/interface_loads.hpp"
#include "dem/base/place.hpp"
#include "dem/columns.hpp"
#include "dem/law.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace listric::coupling {

using namespace dem;

Interface condense(fem::Footwall& footwall, int degree) {
    const auto& faces = footwall.interface_faces();
    const auto d = static_cast<std::size_t>(degree);
    for (std::size_t k = 0; k < faces.size(); ++k)
        if (faces[k].nodes[0] != d * k || faces[k].nodes[1] != d * (k + 1))
            throw fem::FootwallError("the mesh does not follow the detachment from its start on");
    if (faces.empty())
        throw fem::FootwallError("the mesh has no faces on the detachment");
    // Nodes beyond the last whole face carry no disc.
    const std::size_t nodes = d * faces.size() + 1, all = footwall.interface().size();
    Interface interface;
    interface.degree = degree;
    for (std::size_t k = 0; k < nodes; ++k) {
        interface.x.push_back(footwall.interface()[k].place.x);
        interface.y.push_back(footwall.interface()[k].place.y);
    }
    const std::vector<double> whole = footwall.compliance();
    for (std::size_t i = 0; i < 2 * nodes; ++i)
        interface.compliance.insert(
            interface.compliance.end(), whole.begin() + static_cast<std::ptrdiff_t>(2 * all * i),
            whole.begin() + static_cast<std::ptrdiff_t>(2 * all * i + 2 * nodes));
    return interface;
}

std::vector<double> pressure_forces(const Interface& interface, double from, double to) {
    const auto d = static_cast<std::size_t>(interface.degree);
    std::vector<double> forces(interface.x.size(), 0.0);
    for (std::size_t first = 0; first + d < interface.x.size(); first += d) {
        const double start = interface.x[first], end = interface.x[first + d];
        // Nodes of a flat are evenly spaced, so that x is linear along a face.
        const double a = std::clamp((from - start) / (end - start), 0.0, 1.0);
        const double b = std::clamp((to - start) / (end - start), 0.0, 1.0);
        if (!(b > a))
            continue;
        // Gauss's two points are exact for a cubic.
        for (const double sign : {-1.0, 1.0}) {
            const double t = 0.5 * (a + b) + sign * 0.5 * (b - a) / std::sqrt(3.0);
            const std::array<double, 3> n = shape_functions(interface.degree, t);
            for (std::size_t k = 0; k <= d; ++k)
                forces[first + k] += 0.5 * (b - a) * (end - start) * n[k];
        }
    }
    return forces;
}

InterfaceBalance interface_balance(const State& state, const RigidBase& base) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstBaseContactColumns c = base_contact_columns(state);
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    const BasePlace place = base_place(state);
    const auto places = state.base_contacts.get(dem::columns::place);
    std::vector<Point> load(nodes.x.size());
    // Resultants of the discs, from the forces on each of them about its centre.
    double fx = 0.0, fy = 0.0, moment = 0.0, power = 0.0;
    double magnitude = 0.0, moments = 0.0, powers = 0.0;
    for (std::size_t k = 0; k < c.disc.size(); ++k) {
        const Surface& surface = base.surfaces[static_cast<std::size_t>(c.surface[k])];
        const auto i = static_cast<std::size_t>(c.disc[k]);
        if (!place.deforms(surface) || surface.follows != Follows::nodes)
            continue;
        const auto point = place.trace(surface).nearest({d.x[i], d.y[i]}, places[k]);
        if (!point || point->foot.distance >= d.radius[i])
            continue;
        const Point n = point->foot.normal;
        const double normal = contact_parameters(base.material, state.materials[d.material[i]], 1.0)
                                  .normal_stiffness *
                              (d.radius[i] - point->foot.distance);
        const double shear = c.shear_force[k];
        const Point f{normal * n.x - shear * n.y, normal * n.y + shear * n.x};
        const double own = d.x[i] * f.y - d.y[i] * f.x - point->foot.distance * shear;
        fx += f.x;
        fy += f.y;
        moment += own;
        magnitude += hypotenuse(f.x, f.y);
        moments += std::abs(own);
        Point velocity;
        for (std::size_t m = 0; m <= static_cast<std::size_t>(surface.degree); ++m) {
            const std::size_t node = point->node + m;
            load[node].x -= point->weight[m] * f.x;
            load[node].y -= point->weight[m] * f.y;
            velocity.x += point->weight[m] * nodes.vx[node];
            velocity.y += point->weight[m] * nodes.vy[node];
        }
        power += f.x * velocity.x + f.y * velocity.y;
        powers += std::abs(f.x * velocity.x) + std::abs(f.y * velocity.y);
    }
    for (std::size_t k = 0; k < load.size(); ++k) {
        fx += load[k].x;
        fy += load[k].y;
        moment += (nodes.x[k] + nodes.ux[k]) * load[k].y - (nodes.y[k] + nodes.uy[k]) * load[k].x;
        power += load[k].x * nodes.vx[k] + load[k].y * nodes.vy[k];
    }
    const auto over = [](double error, double all) { return all > 0.0 ? error / all : 0.0; };
    return {over(hypotenuse(fx, fy), magnitude), over(std::abs(moment), moments),
            over(std::abs(power), powers)};
}

InterfaceColumns::InterfaceColumns(const Interface& interface, double width)
    : width_(width), nodes_(interface.x.size()) {
    for (double x = 0.0; x + width <= interface.x.back(); x += width)
        per_pascal_.push_back(pressure_forces(interface, x, x + width));
}

void InterfaceColumns::put(State& state, std::string_view effect,
                           std::span<const double> pressure) const {
    const std::span<double> load = interface_load(state, effect, unknowns());
    std::ranges::fill(load, 0.0);
    for (std::size_t k = 0; k < std::min(pressure.size(), per_pascal_.size()); ++k)
        for (std::size_t n = 0; n < nodes_; ++n)
            load[2 * n + 1] -= pressure[k] * per_pascal_[k][n];
}

} // namespace listric::coupling
