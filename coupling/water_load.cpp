#include "coupling/water_load.hpp"

#include "coupling/base_memory.hpp"
#include "coupling/interface_loads.hpp"
#include "dem/base/trace.hpp"
#include "dem/columns.hpp"
#include "dem/pushes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

namespace listric::coupling {

using namespace dem;

namespace {

constexpr const char* effect_name = "pore_fluid"; // of its load on the interface

/// X(t) = a + b t + c t^2, and one of its parts that is below the level.
struct WetPiece {
    std::size_t node; ///< first of the face
    Point a, b, c;
    double from, to; ///< t

    Point at(double t) const { return {a.x + t * (b.x + t * c.x), a.y + t * (b.y + t * c.y)}; }
    Point slope(double t) const { return {b.x + 2.0 * t * c.x, b.y + 2.0 * t * c.y}; }
};

/// Where a face crosses the level, between 0 and `end`, ascending, with both of these.
std::vector<double> crossings(const WetPiece& face, double level, double end) {
    std::vector<double> t{0.0};
    const double a = face.c.y, b = face.b.y, c = face.a.y - level;
    const double root = b * b - 4.0 * a * c;
    if (root >= 0.0) {
        // The sum of equal signs loses nothing.
        const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
        for (const double at : {q / a, c / q})
            if (at > 0.0 && at < end)
                t.push_back(at);
    }
    t.push_back(end);
    std::ranges::sort(t);
    return t;
}

/// Visits the parts of the trace below the level.
void for_each_wet(const DeformedTrace& trace, double level, double to_x,
                  const std::function<void(const WetPiece&)>& visit) {
    const auto d = static_cast<std::size_t>(trace.degree);
    const auto node = [&](std::size_t k) {
        return trace.ux.empty() ? Point{trace.x[k], trace.y[k]}
                                : Point{trace.x[k] + trace.ux[k], trace.y[k] + trace.uy[k]};
    };
    for (std::size_t first = 0; first + d < trace.x.size(); first += d) {
        const double start = trace.x[first], length = trace.x[first + d] - start;
        // Nodes of a flat are evenly spaced, so that x is linear along a face.
        const double end = to_x >= start + length ? 1.0 : (to_x - start) / length;
        if (!(end > 0.0))
            break;
        const Point a = node(first), z = node(first + d), m = node(first + d / 2);
        WetPiece piece{first, a, {z.x - a.x, z.y - a.y}, {}, 0.0, 0.0};
        if (d == 2) {
            piece.b = {4.0 * m.x - 3.0 * a.x - z.x, 4.0 * m.y - 3.0 * a.y - z.y};
            piece.c = {2.0 * (a.x + z.x) - 4.0 * m.x, 2.0 * (a.y + z.y) - 4.0 * m.y};
        }
        const std::vector<double> t = crossings(piece, level, end);
        for (std::size_t k = 0; k + 1 < t.size(); ++k) {
            piece.from = t[k];
            piece.to = t[k + 1];
            if (piece.to > piece.from && piece.at(0.5 * (piece.from + piece.to)).y < level)
                visit(piece);
        }
    }
}

double sum_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

double vertical(std::span<const double> forces) {
    double sum = 0.0;
    for (std::size_t k = 1; k < forces.size(); k += 2)
        sum += forces[k];
    return sum;
}

double sum_of_pushes(const State& state) {
    const Pushes pushes(state);
    double sum = 0.0;
    for (std::size_t i = 0; pushes.any() && i < state.discs.rows(); ++i)
        sum += pushes[i].y;
    return sum;
}

} // namespace

std::vector<double> water_forces(const DeformedTrace& trace, double level, double weight,
                                 double to_x) {
    std::vector<double> forces(2 * trace.x.size(), 0.0);
    for_each_wet(trace, level, to_x, [&](const WetPiece& piece) {
        // Gauss's three points are exact to degree 5: of shape, depth and slope.
        constexpr std::array<double, 3> gauss{-0.7745966692414834, 0.0, 0.7745966692414834};
        constexpr std::array<double, 3> part{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
        const double length = piece.to - piece.from;
        for (std::size_t q = 0; q < gauss.size(); ++q) {
            const double t = piece.from + 0.5 * length * (1.0 + gauss[q]);
            const double push = part[q] * length * weight * (level - piece.at(t).y);
            const Point slope = piece.slope(t);
            const std::array<double, 3> shape = shape_functions(trace.degree, t);
            for (std::size_t k = 0; k <= static_cast<std::size_t>(trace.degree); ++k) {
                forces[2 * (piece.node + k)] += push * shape[k] * slope.y;
                forces[2 * (piece.node + k) + 1] -= push * shape[k] * slope.x;
            }
        }
    });
    return forces;
}

double water_area(const DeformedTrace& trace, double level, double to_x) {
    double area = 0.0;
    for_each_wet(trace, level, to_x, [&](const WetPiece& p) {
        // Term by term, so that it is no other form of the sum above.
        const std::array<double, 3> depth{level - p.a.y, -p.b.y, -p.c.y};
        const std::array<double, 2> slope{p.b.x, 2.0 * p.c.x};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 2; ++j) {
                double high = p.to, low = p.from; // to the power of i + j + 1
                for (int n = 0; n < i + j; ++n) {
                    high *= p.to;
                    low *= p.from;
                }
                area += depth[static_cast<std::size_t>(i)] * slope[static_cast<std::size_t>(j)] *
                        (high - low) / (i + j + 1);
            }
    });
    return area;
}

WaterLoad::WaterLoad(const Interface& interface, const WaterLoadParameters& parameters,
                     const dem::Calendar& calendar)
    : Event("water_load", {parameters.interval, calendar}, Stage::load), parameters_(parameters),
      x_(interface.x), y_(interface.y), degree_(interface.degree) {
    memory.add<double>(water_load_name, "N", 0.0);
    memory.add<double>(water_force_error_name, "1", 0.0);
    memory.resize(1);
}

void WaterLoad::prepare(State& state) const {
    add_pushes(state);
    const std::vector<double> dry =
        dry_weights(state, parameters_.level.at(state), parameters_.buoyancy());
    std::ranges::transform(dry, state.discs.get(columns::push_y).begin(), std::negate());
    set_push_sums(state, {-sum_of(dry), -sum_of(dry)});
}

void WaterLoad::begin(State& state) { interface_load(state, effect_name, 2 * x_.size()); }

/// Adds excess pressure's forces on the nodes. Discs that have gone since they were lifted took
/// their lift along, and with it a part of the pressure. Returns their sum upward, N.
double WaterLoad::excess_forces(State& state, std::span<double> forces) const {
    if (!state.base_nodes.has(columns::excess_size))
        return 0.0;
    const auto x = state.base_nodes.get(columns::excess_x);
    const auto y = state.base_nodes.get(columns::excess_y);
    const auto size = state.base_nodes.get(columns::excess_size);
    const double all = sum_of(size);
    const double missing = sum_of(state.discs.get(columns::lift)) + sum_of(y);
    double upward = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        if (all > 0.0)
            y[k] -= missing / all * size[k];
        forces[2 * k] += x[k];
        forces[2 * k + 1] += y[k];
        upward += y[k];
    }
    return upward;
}

/// What the base bears, by discs at rest and water, against the weight of all that is above it,
/// over that weight.
/// @param on_base  water's force, downward, N
double WaterLoad::force_error(const State& state, double level, const DeformedTrace& trace,
                              double to_x, double on_base) const {
    const ConstDiscColumns d = disc_columns(state);
    const double in_water = parameters_.gravity - parameters_.buoyancy();
    const std::vector<double> dry = dry_weights(state, level, parameters_.buoyancy());
    const bool excess = state.discs.has(columns::lift);
    const auto lift = excess ? state.discs.get(columns::lift) : std::span<const double>{};
    const Pushes pushes(state);
    double borne = on_base, weight = parameters_.weight() * water_area(trace, level, to_x);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        borne += d.mass[i] * in_water - pushes[i].y;
        // All but what floats, and the stratum that is to come, of which a push is the weight.
        const double to_come = (excess ? lift[i] : 0.0) - pushes[i].y - dry[i];
        weight += d.mass[i] * parameters_.gravity + to_come -
                  (d.mass[i] * parameters_.buoyancy() - dry[i]);
    }
    return weight > 0.0 ? (borne - weight) / weight : 0.0;
}

bool WaterLoad::apply(State& state, const RigidBase&) {
    const double level = parameters_.level.at(state);
    const double to = parameters_.wall_x + state.clock.extension.m;
    const ConstBaseNodeColumns nodes = base_node_columns(std::as_const(state));
    const DeformedTrace now{x_, y_, nodes.ux, nodes.uy, degree_};
    const double at_start =
        parameters_.level.heights.at(0.0).height(0.0); // before the wall has moved
    std::vector<double> forces = water_forces(now, level, parameters_.weight(), to);
    double on_base = -vertical(forces);
    const std::vector<double> before =
        water_forces({x_, y_, {}, {}, degree_}, at_start, parameters_.weight(), to);
    std::ranges::transform(forces, before, forces.begin(), std::minus());
    on_base -= excess_forces(state, forces);
    std::ranges::copy(forces, interface_load(state, effect_name, forces.size()).begin());
    set_push_sums(state, {push_sums(state).start, sum_of_pushes(state)});
    memory.get<double>(water_load_name)[0] = -vertical(forces);
    memory.get<double>(water_force_error_name)[0] = force_error(state, level, now, to, on_base);
    return false;
}

NamedValues WaterLoad::measures() const {
    NamedValues values;
    for (const char* name : {water_load_name, water_force_error_name})
        values.emplace_back(name, memory.get<double>(name)[0]);
    return values;
}

FootwallLoad water_load(const WaterLoadParameters& parameters, const dem::Calendar& calendar) {
    return {{}, [=](const LoadSolution& solution) {
                auto event =
                    std::make_unique<WaterLoad>(solution.base.interface(), parameters, calendar);
                const WaterLoad& water = *event;
                LoadingEvent effect{.event = std::move(event)};
                effect.prepare = [&water](State& state) { water.prepare(state); };
                effect.measures = [&water](const State&) { return water.measures(); };
                return effect;
            }};
}

} // namespace listric::coupling
