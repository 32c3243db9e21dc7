#include "dem/genesis/genesis.hpp"

#include "dem/columns.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/contacts/soft_discs.hpp"
#include "dem/genesis/packing.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/units.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace listric::dem {

namespace {

/// Grows discs with fewer than three contacts until they carry load (FISHTank's floaters).
void grow_floaters(State& state, const RigidBase& base, const CyclePhysics& physics, double largest,
                   const Execution& execution,
                   const std::function<void(std::string_view, double)>& report) {
    constexpr int rounds = 40;
    for (int round = 0; round < rounds; ++round) {
        report("growing of floaters", static_cast<double>(round) / rounds);
        const std::vector<int> contacts = coordination(state, base);
        const DiscColumns d = disc_columns(state);
        std::size_t floaters = 0;
        for (std::size_t i = 0; i < d.x.size(); ++i)
            if (contacts[i] < 3 && d.y[i] < -4.0 * state.mean_radius && d.radius[i] < largest) {
                d.radius[i] = std::min(largest, 1.01 * d.radius[i]);
                ++floaters;
            }
        if (floaters < d.x.size() / 500)
            break;
        find_contacts(state, base);
        execution.packed->forget();
        advance(state, base, physics, 50, execution);
    }
}

/// Lets the packing come to rest under its weight; without gravity it is at rest.
void settle_under_gravity(State& state, const RigidBase& base, const CyclePhysics& physics,
                          int crossing, std::string_view stage, const Execution& execution,
                          const std::function<void(std::string_view, double)>& report) {
    find_contacts(state, base);
    if (physics.gravity > 0.0)
        settle(
            state, base, physics, 2.5e-3, 150 * crossing,
            [&](double share) { report(stage, share); }, execution);
}

/// Shrinks discs in a closed space, each by half of what overlaps in the mean, until the pressure
/// that has closed the packing is gone: without gravity nothing else would hold it together. Discs
/// still touch, by 1e-8 of a radius, a stress far below the strength of bonds.
void release_pressure(State& state, const RigidBase& base, const CyclePhysics& physics,
                      const Execution& execution,
                      const std::function<void(std::string_view, double)>& report) {
    constexpr int rounds = 60;
    constexpr double enough = 1e-8; // of a radius
    for (int round = 0; round < rounds; ++round) {
        report("release of pressure", static_cast<double>(round) / rounds);
        find_contacts(state, base);
        settle(
            state, base, physics, 1e-2, 2000, [](double) {}, execution);
        const DiscColumns d = disc_columns(state);
        const ConstContactColumns c = contact_columns(std::as_const(state));
        double sum = 0.0, count = 0.0;
        for (std::size_t k = 0; k < c.first.size(); ++k) {
            const auto i = static_cast<std::size_t>(c.first[k]);
            const auto j = static_cast<std::size_t>(c.second[k]);
            const double reach = d.radius[i] + d.radius[j];
            const double overlap = 1.0 - hypotenuse(d.x[j] - d.x[i], d.y[j] - d.y[i]) / reach;
            if (overlap > 0.0) {
                sum += overlap;
                count += 1.0;
            }
        }
        const double mean = count > 0.0 ? sum / count : 0.0;
        if (mean < enough)
            break;
        for (double& radius : d.radius)
            radius *= 1.0 - 0.5 * mean;
    }
    stop_discs(state);
}

/// Mean top over the ground of columns one mean diameter wide, m, of the discs below a level of it.
/// Columns without a disc have no top: the wedge over a gentle breakaway may be too thin for one.
/// None at all: nothing.
std::optional<double> mean_top(const State& state, double length, const TargetLine& ground,
                               double level) {
    const ConstDiscColumns d = disc_columns(state);
    const double width = 2.0 * state.mean_radius;
    const auto columns = static_cast<std::size_t>(length / width);
    constexpr double none = -1e300;
    std::vector<double> top(columns, none);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double x = d.x[i] / width;
        const double disc_top = d.y[i] + d.radius[i] - ground.height(d.x[i]);
        if (disc_top <= level && x >= 0.0 && x < static_cast<double>(columns)) {
            double& t = top[static_cast<std::size_t>(x)];
            t = std::max(t, disc_top);
        }
    }
    std::erase(top, none);
    if (top.empty())
        return std::nullopt;
    return std::accumulate(top.begin(), top.end(), 0.0) / static_cast<double>(top.size());
}

/// Drops discs above the level, found by bisection, that brings the mean top to the ground.
void trim(State& state, double length, const TargetLine& ground) {
    double low = -4.0 * state.mean_radius, high = 40.0 * state.mean_radius;
    for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (mean_top(state, length, ground, middle).value_or(-1.0) < 0.0 ? low : high) = middle;
    }
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    std::vector<std::int32_t> kept;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.y[i] + d.radius[i] - ground.height(d.x[i]) <= high)
            kept.push_back(static_cast<std::int32_t>(i));
    reorder_discs(state, kept);
}

/// Gives the discs below the surface the density that makes their bulk density the rock's.
void set_masses(State& state, double rock_density, double area) {
    const DiscColumns d = disc_columns(state);
    double solid = 0.0;
    for (double r : d.radius)
        solid += pi * r * r;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        d.mass[i] = rock_density * area / solid * pi * d.radius[i] * d.radius[i];
}

/// Tells discs which layer they are of, and gives them its material and density. A soft layer stays
/// as stiff as the basement for now.
void lay(State& state, const GenesisRequest& request) {
    if (request.layers.empty())
        return;
    const auto layer_of = state.discs.add(columns::layer);
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const auto layer = std::ranges::find_if(request.layers, [&](const RockLayer& l) {
            return l.contains({d.x[i], d.y[i]});
        });
        if (layer == request.layers.end())
            continue;
        layer_of[i] = static_cast<std::uint8_t>(layer - request.layers.begin() + 1);
        d.mass[i] *= layer->density / request.hanging_wall.rock_density;
        if (!is_soft(request.materials, layer->material))
            d.material[i] = layer->material;
    }
}

/// Gives discs and detachment friction, for a slope to stand: that of the run, or where rock will
/// be bonded enough for any slope that sand has.
void hold_slope(State& state, RigidBase& base, const GenesisRequest& request) {
    constexpr double rough = 1.0;
    if (!request.hanging_wall.has_ground())
        return;
    base.surfaces.front().friction = request.base.surfaces.front().friction;
    for (std::size_t m = 0; m < state.materials.size(); ++m)
        state.materials[m].friction = request.bonds ? std::max(rough, request.materials[m].friction)
                                                    : request.materials[m].friction;
}

/// Trims the packing to the ground, gives what is left its masses, and lets it come to rest.
void level(State& state, const RigidBase& base, const GenesisRequest& request,
           const CyclePhysics& physics, int crossing, std::string_view stage,
           const Execution& execution,
           const std::function<void(std::string_view, double)>& report) {
    const HangingWallParameters& p = request.hanging_wall;
    trim(state, p.length, ground_of(p));
    set_masses(state, p.rock_density, hanging_wall_area(p, request.base.surfaces.front().chain));
    lay(state, request);
    sort_discs(state);
    settle_under_gravity(state, base, physics, crossing, stage, execution, report);
}

/// Breaks bonds where rock of the layers is not to have any.
void part_unbonded(State& state, const GenesisRequest& request) {
    if (request.layers.empty())
        return;
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    const ContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (!may_bond(state.materials, d.material[static_cast<std::size_t>(c.first[k])],
                      d.material[static_cast<std::size_t>(c.second[k])]))
            c.bonded[k] = 0;
}

/// Makes soft layers of the stiff rock that they are so far, and lets the packing come to rest
/// while the property update keeps their volume.
void soften(State& state, const RigidBase& base, const GenesisRequest& request,
            const CyclePhysics& physics, int crossing, const Execution& execution,
            const std::function<void(std::string_view, double)>& report) {
    if (request.layers.empty())
        return;
    constexpr int rounds = 40;
    constexpr double enough = 0.002; // of the volume
    const VolumeKeeping how{2.0 * state.mean_radius};
    const auto layer_of = state.discs.get(columns::layer);
    const DiscColumns d = disc_columns(state);
    std::vector<std::int32_t> rows;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (layer_of[i] > 0)
            if (const std::uint8_t m = request.layers[layer_of[i] - 1u].material;
                is_soft(request.materials, m)) {
                d.material[i] = m;
                rows.push_back(static_cast<std::int32_t>(i));
            }
    if (rows.empty())
        return;
    add_enlarged_columns(state);
    enlarge(state, base, rows, how.mean_stress_ratio, physics.gravity);
    if (physics.gravity == 0.0) // it carries nothing, and is as large as it was
        return;
    for (int round = 0; round < rounds; ++round) {
        report("softening of layers", static_cast<double>(round) / rounds);
        find_contacts(state, base);
        execution.packed->forget();
        advance(state, base, physics, 20 * crossing, execution);
        if (std::abs(*keep_volume(state, base, how, physics.gravity)) < enough && round > 4)
            break;
    }
    settle_under_gravity(state, base, physics, crossing, "third equilibrium", execution, report);
}

/// Density of the lightest discs there will be, kg/m^3.
/// @param density  of the discs of the hanging wall's rock, kg/m^3
double lightest_density(const GenesisRequest& request, double density) {
    double lightest = std::min(density, request.sediment_density.value_or(density));
    for (const RockLayer& layer : request.layers)
        lightest =
            std::min(lightest, density * (layer.density / request.hanging_wall.rock_density));
    return lightest;
}

/// Height that the weight of the hanging wall takes from it, m, where it is thickest.
double elastic_settlement(const GenesisRequest& request) {
    const HangingWallParameters& p = request.hanging_wall;
    return 0.5 * p.thickness *
           compression_at_depth(request.materials[basement],
                                p.rock_density * request.physics.gravity * p.thickness);
}

/// The hanging wall with level ground, which is trimmed once it has settled.
HangingWallParameters untrimmed(HangingWallParameters p) {
    p.ground.clear();
    p.ground_slope = 0.0;
    return p;
}

/// Motion of discs counts from here.
void begin_history(State& state) {
    const DiscColumns d = disc_columns(state);
    std::iota(d.id.begin(), d.id.end(), 0);
    state.next_id = static_cast<std::int64_t>(d.id.size());
    std::ranges::copy(d.x, d.start_x.begin());
    std::ranges::copy(d.y, d.start_y.begin());
    std::ranges::fill(d.rotation, 0.0);
    state.ledger.initial = std::accumulate(d.mass.begin(), d.mass.end(), 0.0);
    state.clock.cycle = 0;
    state.clock.travel = {};
    state.clock.extension = {};
}

} // namespace

double compression_at_depth(const Material& rock, double weight) {
    return weight / (0.6 * 0.5 * rock.normal_stiffness);
}

TargetLine ground_of(const HangingWallParameters& p) {
    std::vector<Point> points;
    for (const Point& one : p.ground)
        points.push_back({one.x, -one.y});
    if (points.empty() && p.ground_slope != 0.0) {
        const double angle = std::abs(p.ground_slope) * pi / 180.0, from = p.ground_slope_from;
        const double end = p.ground_slope > 0.0 ? p.length : 0.0;
        points = {{from, 0.0}, {end, -std::abs(end - from) * sine(angle) / cosine(angle)}};
        if (end < from)
            std::swap(points[0], points[1]);
    }
    return TargetLine(points.empty() ? std::vector<Point>{{0.0, 0.0}} : points);
}

double hanging_wall_area(const HangingWallParameters& p, const Chain& detachment) {
    const TargetLine ground = ground_of(p);
    double area = 0.0, length = 0.0;
    for (const Segment& s : detachment)
        length += s.length;
    constexpr int pieces = 20000;
    Point a = point_at(detachment, 0.0);
    for (int k = 1; k <= pieces; ++k) {
        Point b = point_at(detachment, length * k / pieces);
        if (b.x > p.length) {
            const double share = b.x > a.x ? std::max(0.0, (p.length - a.x) / (b.x - a.x)) : 0.0;
            b = {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
        }
        if (p.has_ground())
            area += 0.5 *
                    (std::max(0.0, ground.height(a.x) - a.y) +
                     std::max(0.0, ground.height(b.x) - b.y)) *
                    (b.x - a.x);
        else
            area -= 0.5 * (a.y + b.y) * (b.x - a.x);
        a = b;
    }
    return area;
}

std::size_t disc_count(const HangingWallParameters& p, double area) {
    return static_cast<std::size_t>(
        (1.0 - p.porosity) * area /
        (pi * radius_range(p.mean_radius, p.radius_ratio).mean_square()));
}

double stable_time_step(double mass, std::span<const Material> materials, double damping,
                        double safety) {
    double step = std::numeric_limits<double>::infinity();
    for (const Material& material : materials)
        step = std::min(step, stable_time_step(mass, material, damping, safety));
    return step;
}

State make_hanging_wall(const GenesisRequest& request,
                        const std::function<void(std::string_view, double)>& report) {
    const Team team(request.execution.threads);
    Packed packed;
    Execution execution = request.execution;
    execution.packed = &packed;
    const HangingWallParameters& p = request.hanging_wall;
    const auto [smallest, largest] = radius_range(p.mean_radius, p.radius_ratio);

    // Gravity and trimming take some height; the lid leaves it. Rock may be softer than any.
    const double settles = std::min(1.5 * elastic_settlement(request), 0.3 * p.thickness);
    const double lid = std::max(0.02 * p.thickness, settles) + 4.0 * p.mean_radius;
    RigidBase closed = request.base;
    closed.motion = {};
    for (Surface& s : closed.surfaces)
        s.friction = 0.0;
    RigidBase open = closed;
    closed.surfaces.push_back({"lid", {line({2.0 * p.length, lid}, {-p.length, lid})}});

    State state = empty_state();
    state.seed = request.seed;
    state.mean_radius = p.mean_radius;
    state.skin = request.skin * p.mean_radius;
    state.materials = request.materials;
    for (Material& m : state.materials)
        m.friction = 0.0;

    const double area = hanging_wall_area(untrimmed(p), request.base.surfaces.front().chain);
    const double density = p.rock_density / (1.0 - packing_porosity);
    const double mean_mass = density * pi * p.mean_radius * p.mean_radius;
    state.inertial_mass_floor = request.inertial_mass_floor * mean_mass;
    state.clock.time_step =
        stable_time_step(request.inertial_mass_floor > 0.0
                             ? state.inertial_mass_floor
                             : lightest_density(request, density) * pi * smallest * smallest,
                         state.materials, request.physics.damping, request.time_step_safety);

    add_discs(state, disc_count(p, area + lid * p.length));
    const std::vector<double> radius =
        draw_radii({smallest, largest}, state.discs.rows(), state.seed);
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < radius.size(); ++i)
        d.mass[i] = density * pi * radius[i] * radius[i];
    const CyclePhysics weightless{request.physics.damping, 0.0};
    // Toward rest, against no mean motion.
    const CyclePhysics physics{request.physics.damping, request.physics.gravity};
    scatter_and_expand(state, closed, radius, p.length, -p.thickness, lid, request.physics.damping,
                       report, execution);
    sort_discs(state);
    find_contacts(state, closed);
    settle(
        state, closed, weightless, 1e-2, 2000,
        [&](double share) { report("first equilibrium", share); }, execution);

    // Pressure and gravity travel a layer of discs in a few cycles; settling takes many crossings.
    const int crossing = static_cast<int>(p.thickness / p.mean_radius);
    if (physics.gravity > 0.0) {
        settle_under_gravity(state, open, physics, crossing, "settling under gravity", execution,
                             report);
        grow_floaters(state, open, physics, largest, execution, report);
    } else {
        release_pressure(state, closed, physics, execution, report);
    }
    hold_slope(state, open, request);
    level(state, open, request, physics, crossing, "second equilibrium", execution, report);
    // Soft rock rises when the load above is cut off.
    constexpr double uneven = 0.25; // mean radii
    if (mean_top(state, p.length, ground_of(p), std::numeric_limits<double>::infinity())
            .value_or(0.0) > uneven * p.mean_radius)
        level(state, open, request, physics, crossing, "levelling", execution, report);

    soften(state, open, request, physics, crossing, execution, report);

    state.materials = request.materials;
    if (request.bonds)
        bond_touching(state, *request.bonds, 0);
    part_unbonded(state, request);
    begin_history(state);
    return state;
}

} // namespace listric::dem
