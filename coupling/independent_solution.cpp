#include "coupling/independent_solution.hpp"

#include "coupling/modes.hpp"
#include "dem/base/trace.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>

namespace listric::coupling {

using namespace dem;

namespace {

constexpr double gauss_point[3] = {0.5 - 0.3872983346207417, 0.5, 0.5 + 0.3872983346207417};
constexpr double gauss_weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

/// The trace and what lives on it.
struct Line {
    std::span<const double> x, y;
    std::size_t degree;

    std::size_t faces() const { return (x.size() - 1) / degree; }
    std::array<double, 3> shapes(double t) const {
        return shape_functions(static_cast<int>(degree), t);
    }
    double sum(std::size_t face, double t, const std::function<double(std::size_t)>& value) const {
        const std::array<double, 3> n = shapes(t);
        double s = 0.0;
        for (std::size_t k = 0; k <= degree; ++k)
            s += n[k] * value(degree * face + k);
        return s;
    }
    Point at(std::size_t face, double t) const {
        return {sum(face, t, [&](std::size_t k) { return x[k]; }),
                sum(face, t, [&](std::size_t k) { return y[k]; })};
    }
    /// |dX/dt|; shape functions are quadratic, so central differences are exact.
    double stretch(std::size_t face, double t) const {
        const Point a = at(face, t - 0.5), b = at(face, t + 0.5);
        return hypotenuse(b.x - a.x, b.y - a.y);
    }
};

/// Solves a symmetric positive definite system of `n` by the method of Cholesky, in place, for
/// two right-hand sides that alternate in `b`. Entries further than `band` from the diagonal are 0.
void solve_banded(std::vector<double>& a, std::size_t n, std::size_t band, std::vector<double>& b) {
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t end = std::min(n, k + band + 1);
        a[k * n + k] = std::sqrt(a[k * n + k]);
        for (std::size_t i = k + 1; i < end; ++i)
            a[i * n + k] /= a[k * n + k];
        for (std::size_t j = k + 1; j < end; ++j)
            for (std::size_t i = j; i < end; ++i)
                a[i * n + j] -= a[i * n + k] * a[j * n + k];
    }
    for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t k = 0; k < n; ++k) {
            b[2 * k + c] /= a[k * n + k];
            for (std::size_t i = k + 1; i < std::min(n, k + band + 1); ++i)
                b[2 * i + c] -= a[i * n + k] * b[2 * k + c];
        }
        for (std::size_t k = n; k-- > 0;) {
            for (std::size_t i = k + 1; i < std::min(n, k + band + 1); ++i)
                b[2 * k + c] -= a[i * n + k] * b[2 * i + c];
            b[2 * k + c] /= a[k * n + k];
        }
    }
}

} // namespace

std::vector<double> tractions(const Interface& interface, std::span<const double> forces) {
    const Line line{interface.x, interface.y, static_cast<std::size_t>(interface.degree)};
    const std::size_t n = interface.x.size();
    assert(forces.size() == interface.unknowns());
    std::vector<double> mass(n * n, 0.0);
    for (std::size_t face = 0; face < line.faces(); ++face)
        for (std::size_t q = 0; q < 3; ++q) {
            const std::array<double, 3> shape = line.shapes(gauss_point[q]);
            const double w = gauss_weight[q] * line.stretch(face, gauss_point[q]);
            for (std::size_t i = 0; i <= line.degree; ++i)
                for (std::size_t j = 0; j <= line.degree; ++j)
                    mass[(line.degree * face + i) * n + line.degree * face + j] +=
                        w * shape[i] * shape[j];
        }
    std::vector<double> result(forces.begin(), forces.end());
    solve_banded(mass, n, line.degree, result);
    return result;
}

double relative_difference(std::span<const double> a, std::span<const double> b) {
    assert(a.size() == b.size());
    double square = 0.0, size = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        square += (a[k] - b[k]) * (a[k] - b[k]);
        size += b[k] * b[k];
    }
    return size > 0.0 ? std::sqrt(square / size) : 0.0;
}

IndependentSolution solve_independently(fem::FootwallRequest request, const Interface& interface,
                                        std::span<const double> forces, const fem::Load& other,
                                        std::span<const fem::StressPoint> relaxing) {
    if (request.mesh_file.empty())
        request.cell_size *= 0.5;
    else
        ++request.refinements;
    const auto footwall = fem::make_footwall(request);
    const std::vector<double> traction = tractions(interface, forces);
    const Line coarse{interface.x, interface.y, static_cast<std::size_t>(interface.degree)};
    std::vector<double> still(interface.x.size(), 0.0);
    const Trace trace(interface.x, interface.y, still, still, interface.degree);
    fem::Load load;
    load.jumps = other.jumps;
    load.stress = fem::carried_over(relaxing, other.stress, footwall->stress_points());
    load.traction = [&](fem::Vector place, fem::Vector normal, fem::Boundary boundary) {
        fem::Vector t;
        if (other.traction)
            t = other.traction(place, normal, boundary);
        const auto point = boundary == fem::Boundary::detachment ? trace.nearest({place.x, place.y})
                                                                 : std::nullopt;
        // The recorded interface ends before the detachment does.
        if (point && std::abs(point->foot.distance) < request.cell_size)
            for (std::size_t k = 0; k <= coarse.degree; ++k) {
                t.x += point->weight[k] * traction[2 * (point->node + k)];
                t.y += point->weight[k] * traction[2 * (point->node + k) + 1];
            }
        return t;
    };
    footwall->solve(load);

    IndependentSolution result;
    result.unknowns = footwall->mesh().unknowns;
    const std::vector<double> u = footwall->interface_displacement();
    std::vector<double> x, y;
    for (const fem::InterfaceNode& node : footwall->interface()) {
        x.push_back(node.place.x);
        y.push_back(node.place.y);
    }
    x.resize(coarse.degree * footwall->interface_faces().size() + 1);
    y.resize(x.size());
    still.assign(x.size(), 0.0);
    const Trace fine(x, y, still, still, interface.degree);
    for (std::size_t k = 0; k < interface.x.size(); ++k) {
        // By round-off the breakaway may lie beyond the wall's start, which then is the place.
        TracePoint point = fine.nearest({interface.x[k], interface.y[k]})
                               .value_or(TracePoint{{}, 0.0, 0, {1.0, 0.0, 0.0}});
        for (std::size_t c = 0; c < 2; ++c) {
            double there = 0.0;
            for (std::size_t i = 0; i <= coarse.degree; ++i)
                there += point.weight[i] * u[2 * (point.node + i) + c];
            result.displacement.push_back(there);
        }
    }
    return result;
}

} // namespace listric::coupling
