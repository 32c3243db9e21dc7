#include "dem/genesis.hpp"

#include "dem/bond.hpp"
#include "dem/contacts.hpp"
#include "dem/monitor.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace listric {

namespace {

struct RadiusRange {
    double smallest, largest;
};

/// Uniform distribution with the given mean and ratio.
RadiusRange radius_range(const HangingWallParameters& p) {
    const double smallest = 2.0 * p.mean_radius / (1.0 + p.radius_ratio);
    return {smallest, p.radius_ratio * smallest};
}

/// Distance to the nearest surface, m; negative beyond one.
double clearance(const RigidBase& base, Point p) {
    double least = 1e300;
    for (const Surface& s : base.surfaces)
        if (const auto foot = nearest(s.chain, p))
            least = std::min(least, foot->distance);
    return least;
}

/// Random places for discs of the given radii so that none overlaps (random sequential addition).
std::vector<Point> scatter(const RigidBase& base, std::span<const double> radius, double width,
                           double bottom, double top, std::uint64_t seed) {
    const double cell = 2.0 * *std::ranges::max_element(radius);
    const auto columns = static_cast<std::int64_t>(width / cell) + 1;
    const auto rows = static_cast<std::int64_t>((top - bottom) / cell) + 1;
    std::vector<std::vector<std::int32_t>> cells(static_cast<std::size_t>(columns * rows));
    std::vector<Point> place(radius.size());
    std::uint64_t tries = 0;
    for (std::size_t i = 0; i < radius.size();) {
        const Point p{width * uniform(seed, Purpose::packing_place, tries, 0),
                      bottom + (top - bottom) * uniform(seed, Purpose::packing_place, tries, 1)};
        if (++tries > 1000 * radius.size() + 100000)
            throw NumericalFailure("genesis found no room for disc " + std::to_string(i) +
                                   ": the hanging wall is too narrow for this radius");
        if (clearance(base, p) < radius[i])
            continue;
        const auto c = static_cast<std::int64_t>(p.x / cell);
        const auto r = static_cast<std::int64_t>((p.y - bottom) / cell);
        bool free = true;
        for (std::int64_t a = std::max<std::int64_t>(c - 1, 0); a <= std::min(c + 1, columns - 1);
             ++a)
            for (std::int64_t b = std::max<std::int64_t>(r - 1, 0); b <= std::min(r + 1, rows - 1);
                 ++b)
                for (std::int32_t other : cells[static_cast<std::size_t>(a * rows + b)]) {
                    const auto j = static_cast<std::size_t>(other);
                    free = free &&
                           std::hypot(place[j].x - p.x, place[j].y - p.y) >= radius[i] + radius[j];
                }
        if (!free)
            continue;
        cells[static_cast<std::size_t>(c * rows + r)].push_back(static_cast<std::int32_t>(i));
        place[i++] = p;
    }
    return place;
}

void stop_discs(State& state) {
    const DiscColumns d = disc_columns(state);
    for (auto velocity : {d.vx, d.vy, d.spin})
        std::ranges::fill(velocity, 0.0);
}

/// Cycles until the mean unbalanced force falls below `ratio` of the mean contact force, and, with
/// gravity, the base carries the weight to one percent; or until the limit.
void settle(State& state, const RigidBase& base, const CyclePhysics& physics, double ratio,
            int limit, const std::function<void(double)>& report) {
    constexpr int batch = 250;
    for (int n = 0; n < limit; n += batch) {
        advance(state, base, physics, batch);
        report(static_cast<double>(n) / limit);
        const ForceBalance balance = force_balance(state, base, physics.gravity);
        double lift = 0.0;
        for (const Point& r : balance.reaction)
            lift += r.y;
        if (balance.mean_ratio() < ratio && lift >= 0.99 * balance.weight)
            return;
    }
}

/// Grows discs with fewer than three contacts until they carry load (FISHTank's floaters).
void grow_floaters(State& state, const RigidBase& base, const CyclePhysics& physics,
                   double largest) {
    for (int round = 0; round < 40; ++round) {
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
        advance(state, base, physics, 50);
    }
}

/// Drops discs above the level, found by bisection, that brings the mean top of columns one mean
/// diameter wide to y = 0.
void trim(State& state, double length) {
    const DiscColumns d = disc_columns(state);
    const double width = 2.0 * state.mean_radius;
    const auto columns = static_cast<std::size_t>(length / width);
    const auto mean_top = [&](double cut) {
        std::vector<double> top(columns, -1e300);
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const double x = d.x[i] / width;
            if (d.y[i] + d.radius[i] <= cut && x >= 0.0 && x < static_cast<double>(columns)) {
                double& t = top[static_cast<std::size_t>(x)];
                t = std::max(t, d.y[i] + d.radius[i]);
            }
        }
        return std::accumulate(top.begin(), top.end(), 0.0) / static_cast<double>(columns);
    };
    double low = -2.0 * width, high = 20.0 * width;
    for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        (mean_top(middle) < 0.0 ? low : high) = middle;
    }
    std::vector<std::int32_t> kept;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.y[i] + d.radius[i] <= high)
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

} // namespace

double hanging_wall_area(const HangingWallParameters& p, const Chain& detachment) {
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
        area -= 0.5 * (a.y + b.y) * (b.x - a.x);
        a = b;
    }
    return area;
}

std::size_t disc_count(const HangingWallParameters& p, double area) {
    const auto [smallest, largest] = radius_range(p);
    const double mean_square = (largest * largest + largest * smallest + smallest * smallest) / 3.0;
    return static_cast<std::size_t>((1.0 - p.porosity) * area / (pi * mean_square));
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
    const HangingWallParameters& p = request.hanging_wall;
    const auto [smallest, largest] = radius_range(p);

    // Gravity and trimming take some height; the lid leaves it.
    const double lid = 0.02 * p.thickness + 4.0 * p.mean_radius;
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

    const double area = hanging_wall_area(p, request.base.surfaces.front().chain);
    const double porosity_under_gravity = 0.166; // where frictionless packings end by themselves
    const double density = p.rock_density / (1.0 - porosity_under_gravity);
    const double mean_mass = density * pi * p.mean_radius * p.mean_radius;
    state.inertial_mass_floor = request.inertial_mass_floor * mean_mass;
    state.clock.time_step =
        stable_time_step(request.inertial_mass_floor > 0.0 ? state.inertial_mass_floor
                                                           : density * pi * smallest * smallest,
                         state.materials, request.physics.damping, request.time_step_safety);

    add_discs(state, disc_count(p, area + lid * p.length));
    DiscColumns d = disc_columns(state);
    std::vector<double> radius(d.x.size()), seedling(d.x.size());
    constexpr double start_scale = 0.55;
    for (std::size_t i = 0; i < radius.size(); ++i) {
        radius[i] =
            smallest + (largest - smallest) * uniform(state.seed, Purpose::packing_radius, i);
        seedling[i] = start_scale * radius[i];
        d.mass[i] = density * pi * radius[i] * radius[i];
    }
    report("scattering discs", 0.0);
    const std::vector<Point> place =
        scatter(closed, seedling, p.length, -p.thickness, lid, state.seed);
    for (std::size_t i = 0; i < radius.size(); ++i) {
        d.x[i] = place[i].x;
        d.y[i] = place[i].y;
        d.radius[i] = seedling[i];
    }

    constexpr int increments = 150;
    const CyclePhysics weightless{request.physics.damping, 0.0};
    for (int k = 1; k <= increments; ++k) {
        const double scale = start_scale + (1.0 - start_scale) * k / increments;
        for (std::size_t i = 0; i < radius.size(); ++i)
            d.radius[i] = scale * radius[i];
        find_contacts(state, closed);
        for (int batch = 0; batch < 3; ++batch) {
            stop_discs(state);
            advance(state, closed, weightless, 4);
        }
        if (k % 10 == 0)
            report("expanding discs", static_cast<double>(k) / increments);
    }
    stop_discs(state);
    sort_discs(state);
    find_contacts(state, closed);
    settle(state, closed, weightless, 1e-2, 2000,
           [&](double share) { report("first equilibrium", share); });

    // Pressure and gravity travel a layer of discs in a few cycles; settling takes many crossings.
    const int crossing = static_cast<int>(p.thickness / p.mean_radius);
    find_contacts(state, open);
    settle(state, open, request.physics, 2.5e-3, 150 * crossing,
           [&](double share) { report("settling under gravity", share); });
    grow_floaters(state, open, request.physics, largest);
    trim(state, p.length);
    set_masses(state, p.rock_density, area);
    sort_discs(state);
    find_contacts(state, open);
    settle(state, open, request.physics, 2.5e-3, 150 * crossing,
           [&](double share) { report("second equilibrium", share); });

    state.materials = request.materials;
    if (request.bonds) {
        const std::vector<bool> touches = touching(state);
        for (std::size_t k = 0; k < touches.size(); ++k)
            if (touches[k])
                install_bond(state, k, *request.bonds, 0);
    }
    d = disc_columns(state);
    std::iota(d.id.begin(), d.id.end(), 0);
    state.next_id = static_cast<std::int64_t>(d.id.size());
    std::ranges::copy(d.x, d.start_x.begin());
    std::ranges::copy(d.y, d.start_y.begin());
    std::ranges::fill(d.rotation, 0.0);
    state.ledger.initial = std::accumulate(d.mass.begin(), d.mass.end(), 0.0);
    state.clock.cycle = 0;
    state.clock.extension = 0.0;
    return state;
}

} // namespace listric
