#include "dem/genesis/packing.hpp"

#include "dem/contacts/bond.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/random.hpp"

#include <algorithm>

namespace listric::dem {

namespace {

/// Distance to the nearest surface, m; negative beyond one.
double clearance(const RigidBase& base, Point p) {
    double least = 1e300;
    for (const Surface& s : base.surfaces)
        if (const auto foot = nearest(s.chain, p))
            least = std::min(least, foot->distance);
    return least;
}

} // namespace

RadiusRange radius_range(double mean_radius, double radius_ratio) {
    const double smallest = 2.0 * mean_radius / (1.0 + radius_ratio);
    return {smallest, radius_ratio * smallest};
}

std::vector<double> draw_radii(const RadiusRange& range, std::size_t discs, std::uint64_t seed) {
    std::vector<double> radius(discs);
    for (std::size_t i = 0; i < discs; ++i)
        radius[i] = range.smallest +
                    (range.largest - range.smallest) * uniform(seed, Purpose::packing_radius, i);
    return radius;
}

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
                                   ": the space is too narrow for this radius");
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
                           hypotenuse(place[j].x - p.x, place[j].y - p.y) >= radius[i] + radius[j];
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

void scatter_and_expand(State& state, const RigidBase& base, std::span<const double> radius,
                        double width, double bottom, double top, double damping,
                        const std::function<void(std::string_view, double)>& report,
                        const Execution& execution) {
    constexpr double start_scale = 0.55;
    constexpr int increments = 150;
    Packed for_this_call;
    const Execution how = execution.keeping(for_this_call);
    const DiscColumns d = disc_columns(state);
    std::vector<double> seedling(radius.size());
    for (std::size_t i = 0; i < radius.size(); ++i)
        seedling[i] = start_scale * radius[i];
    report("scattering discs", 0.0);
    const std::vector<Point> place = scatter(base, seedling, width, bottom, top, state.seed);
    for (std::size_t i = 0; i < radius.size(); ++i) {
        d.x[i] = place[i].x;
        d.y[i] = place[i].y;
        d.radius[i] = seedling[i];
    }
    for (int k = 1; k <= increments; ++k) {
        const double scale = start_scale + (1.0 - start_scale) * k / increments;
        for (std::size_t i = 0; i < radius.size(); ++i)
            d.radius[i] = scale * radius[i];
        find_contacts(state, base);
        how.packed->forget();
        for (int batch = 0; batch < 3; ++batch) {
            stop_discs(state);
            how.packed->forget_discs();
            advance(state, base, {damping, 0.0}, 4, how);
        }
        if (k % 10 == 0)
            report("expanding discs", static_cast<double>(k) / increments);
    }
    stop_discs(state);
}

void settle(State& state, const RigidBase& base, const CyclePhysics& physics, double ratio,
            int limit, const std::function<void(double)>& report, const Execution& execution) {
    constexpr int batch = 250;
    Packed for_this_call;
    const Execution how = execution.keeping(for_this_call);
    how.packed->forget();
    for (int n = 0; n < limit; n += batch) {
        advance(state, base, physics, batch, how);
        report(static_cast<double>(n) / limit);
        const ForceBalance balance = force_balance(state, base, physics.gravity);
        double lift = 0.0;
        for (const Point& r : balance.reaction)
            lift += r.y;
        if (balance.mean_ratio() < ratio && lift >= 0.99 * balance.weight)
            return;
    }
}

void bond_touching(State& state, const BondStrength& strength, std::int64_t occasion) {
    const std::vector<bool> touches = touching(state);
    for (std::size_t k = 0; k < touches.size(); ++k)
        if (touches[k])
            install_bond(state, k, strength, occasion);
}

} // namespace listric::dem
