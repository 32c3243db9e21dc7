// Study of the elastic base: elements, refinement and solvers against the exact elastic layer.

#include "apps/studies/study.hpp"

#include "apps/support/error.hpp"
#include "apps/support/stopwatch.hpp"
#include "dem/numbers/elementary.hpp"
#include "fem/elastic_layer.hpp"
#include "fem/footwall.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace listric {

namespace {

/// A strip load on a layer that floats: its edges are where elements of uniform size do worst.
struct Strip {
    static constexpr double thickness = 10e3, half_width = 20e3; // m
    static constexpr double pressure = 5e7;                      // Pa
    static constexpr double far = 300e3;                         // m, ten flexural parameters
    static constexpr double compared_to = 120e3;                 // m
    static constexpr double coarsest = 10e3;                     // m
    fem::ElasticLayer layer{70e9, 0.25, thickness, 2700.0 * 9.81, 600.0 * 9.81};

    fem::FootwallRequest request(int degree, fem::Solver solver, int refinements) const {
        fem::FootwallRequest r;
        r.layers = {{0.0, layer.young_modulus, layer.poisson_ratio, 2700.0}};
        r.left = -far;
        r.right = far;
        // A layer that is held on both sides would feel that it cannot grow longer.
        r.right_side = fem::Side::free;
        r.depth = thickness;
        r.surface_spring = layer.top_spring;
        r.base_spring = layer.base_spring;
        r.degree = degree;
        r.solver = solver;
        // The nodes of the layer's middle exist from two rows of cells on.
        r.cell_size = 0.5 * coarsest;
        r.refinements = refinements;
        r.surface_breaks = {-half_width, 0.0, half_width};
        return r;
    }

    fem::Load load() const {
        fem::Load load;
        load.traction = [](fem::Vector p, fem::Vector, fem::Boundary boundary) {
            const bool on = boundary == fem::Boundary::surface && std::abs(p.x) < half_width;
            return on ? fem::Vector{0.0, -pressure} : fem::Vector{};
        };
        return load;
    }

    /// Largest difference from the exact layer along its middle, over the deflection at the centre.
    double error(const fem::Footwall& footwall) const {
        const fem::Field field = footwall.field();
        std::vector<double> x, w;
        for (std::size_t k = 0; k < field.place.size(); ++k)
            if (std::abs(field.place[k].y + 0.5 * thickness) < 1.0 &&
                std::abs(field.place[k].x) <= compared_to) {
                x.push_back(field.place[k].x);
                w.push_back(-field.displacement[k].y);
            }
        const std::vector<double> exact = layer.deflection(x, 0.5 * thickness, [](double q) {
            return 2.0 * pressure * dem::sine(q * half_width) / q;
        });
        double worst = 0.0, greatest = 0.0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            worst = std::max(worst, std::abs(w[k] - exact[k]));
            greatest = std::max(greatest, std::abs(exact[k]));
        }
        return worst / greatest;
    }
};

StudyPoint point(const std::string& method, const Strip& strip, const fem::Footwall& footwall,
                 double seconds) {
    return {method,       fmt::format("unknowns={}", footwall.mesh().unknowns),
            "deflection", strip.error(footwall),
            seconds,      0.0};
}

} // namespace

StudyResult study_footwall(const StudyRequest& request) {
    StudyResult result;
    result.title = "Elastic base: strip load against the exact layer";
    const Strip strip;
    // The plug-in is loaded before any clock runs.
    fem::make_footwall(strip.request(1, fem::Solver::mumps, 0));
    struct Method {
        const char* name;
        int degree;
        fem::Solver solver;
        int levels;
    };
    constexpr int usual = 3, largest = 5; // refinements, each of four times the elements
    const double asked = request.values.empty() ? usual : request.values[0];
    if (request.values.size() > 1 || asked > largest || asked != std::floor(asked))
        throw UsageError(fmt::format("study footwall: --values {}: allowed: one number of "
                                     "refinements, 1 to {}",
                                     fmt::join(request.values, ","), largest));
    const int most = static_cast<int>(asked);
    for (const Method& m : {Method{"Q1 uniform MUMPS", 1, fem::Solver::mumps, most + 1},
                            Method{"Q2 uniform MUMPS", 2, fem::Solver::mumps, most},
                            Method{"Q2 uniform BoomerAMG", 2, fem::Solver::boomeramg, most},
                            Method{"Q2 uniform GAMG", 2, fem::Solver::gamg, most}})
        for (int level = 0; level <= m.levels; ++level) {
            request.stop.check();
            const auto start = SteadyClock::now();
            const auto footwall = fem::make_footwall(strip.request(m.degree, m.solver, level));
            footwall->solve(strip.load());
            result.points.push_back(point(m.name, strip, *footwall, seconds_since(start)));
        }
    for (int degree : {1, 2}) {
        const auto start = SteadyClock::now();
        const auto footwall = fem::make_footwall(strip.request(degree, fem::Solver::mumps, 0));
        for (int step = 0; step <= 2 * most + 2; ++step) {
            request.stop.check();
            if (step > 0)
                footwall->refine(0.2);
            footwall->solve(strip.load());
            result.points.push_back(point(fmt::format("Q{} adaptive MUMPS", degree), strip,
                                          *footwall, seconds_since(start)));
        }
    }
    return result;
}

} // namespace listric
