#include "dem/monitor.hpp"

#include "dem/base_place.hpp"
#include "dem/law.hpp"
#include "dem/order_free.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace listric::dem {

namespace {

/// Calls visit(row, i, j, normal, overlap) for every pair that touches or is bonded.
template <class Visit> void for_each_touching(const State& state, Visit&& visit) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
        const double distance = std::hypot(dx, dy);
        const double overlap = d.radius[i] + d.radius[j] - distance;
        if (overlap > 0.0 || c.bonded[k])
            visit(k, i, j, Point{dx / distance, dy / distance}, overlap);
    }
}

template <class Visit>
void for_each_base_contact(const State& state, const RigidBase& base, Visit&& visit) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstBaseContactColumns c = base_contact_columns(state);
    const BasePlace place = base_place(state);
    for (std::size_t k = 0; k < c.disc.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.disc[k]);
        const auto s = static_cast<std::size_t>(c.surface[k]);
        const auto foot = nearest(base.surfaces[s], place, {d.x[i], d.y[i]});
        if (foot && foot->distance < d.radius[i])
            visit(k, i, s, foot->normal, d.radius[i] - foot->distance);
    }
}

} // namespace

ForceBalance force_balance(const State& state, const RigidBase& base, double gravity) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    ForceBalance balance;
    balance.reaction.resize(base.surfaces.size());
    std::vector<Point> force(d.x.size());
    OrderFreeSum contact_sum, weight_sum, unbalanced_sum;
    std::vector<std::array<OrderFreeSum, 2>> reaction(base.surfaces.size());
    const auto act = [&](const Material& p, const Material& q, Point n, double overlap,
                         double shear) {
        const double normal = contact_parameters(p, q, 1.0).normal_stiffness * overlap;
        return Point{normal * n.x - shear * n.y, normal * n.y + shear * n.x};
    };
    for_each_touching(
        state, [&](std::size_t k, std::size_t i, std::size_t j, Point n, double overlap) {
            const Point f = act(state.materials[d.material[i]], state.materials[d.material[j]], n,
                                overlap, c.shear_force[k]);
            force[i] = {force[i].x - f.x, force[i].y - f.y};
            force[j] = {force[j].x + f.x, force[j].y + f.y};
            contact_sum += std::hypot(f.x, f.y);
            ++balance.touching;
        });
    for_each_base_contact(
        state, base, [&](std::size_t k, std::size_t i, std::size_t s, Point n, double overlap) {
            const Point f =
                act(base.material, state.materials[d.material[i]], n, overlap, b.shear_force[k]);
            force[i] = {force[i].x + f.x, force[i].y + f.y};
            reaction[s][0] += f.x;
            reaction[s][1] += f.y;
        });
    for (std::size_t s = 0; s < reaction.size(); ++s)
        balance.reaction[s] = {reaction[s][0].value(), reaction[s][1].value()};
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double weight = d.mass[i] * gravity;
        const double unbalanced = std::hypot(force[i].x, force[i].y - weight);
        weight_sum += weight;
        unbalanced_sum += unbalanced;
        balance.max_unbalanced = greater(balance.max_unbalanced, unbalanced);
    }
    balance.weight = weight_sum.value();
    if (!d.x.empty())
        balance.mean_unbalanced = unbalanced_sum.value() / static_cast<double>(d.x.size());
    if (balance.touching)
        balance.mean_contact = contact_sum.value() / static_cast<double>(balance.touching);
    return balance;
}

std::vector<SurfaceLoad> surface_loads(const State& state, const RigidBase& base) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    std::vector<SurfaceLoad> loads(base.surfaces.size());
    for_each_base_contact(
        state, base, [&](std::size_t k, std::size_t i, std::size_t s, Point n, double overlap) {
            const double normal =
                contact_parameters(base.material, state.materials[d.material[i]], 1.0)
                    .normal_stiffness *
                overlap;
            const double shear = b.shear_force[k];
            SurfaceLoad& load = loads[s];
            load.force.x += normal * n.x - shear * n.y;
            load.force.y += normal * n.y + shear * n.x;
            ++load.contacts;
        });
    return loads;
}

std::vector<Stress> disc_stresses(const State& state, const RigidBase& base) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    std::vector<Stress> stress(d.x.size());
    // `out` points from the disc's centre to the contact, `normal` and `shear` act on the disc.
    const auto add = [&](std::size_t i, double arm, Point out, double normal, Point t,
                         double shear) {
        const double fx = -normal * out.x + shear * t.x, fy = -normal * out.y + shear * t.y;
        const double area = pi * d.radius[i] * d.radius[i];
        stress[i].xx += fx * arm * out.x / area;
        stress[i].yy += fy * arm * out.y / area;
        stress[i].xy += 0.5 * arm * (fx * out.y + fy * out.x) / area;
    };
    for_each_touching(state, [&](std::size_t k, std::size_t i, std::size_t j, Point n,
                                 double overlap) {
        const double normal =
            contact_parameters(state.materials[d.material[i]], state.materials[d.material[j]], 1.0)
                .normal_stiffness *
            overlap;
        const Point t{-n.y, n.x};
        add(i, d.radius[i] - 0.5 * overlap, n, normal, t, -c.shear_force[k]);
        add(j, d.radius[j] - 0.5 * overlap, {-n.x, -n.y}, normal, t, c.shear_force[k]);
    });
    for_each_base_contact(
        state, base, [&](std::size_t k, std::size_t i, std::size_t, Point n, double overlap) {
            const double normal =
                contact_parameters(base.material, state.materials[d.material[i]], 1.0)
                    .normal_stiffness *
                overlap;
            add(i, d.radius[i] - overlap, {-n.x, -n.y}, normal, {-n.y, n.x}, b.shear_force[k]);
        });
    return stress;
}

std::vector<int> coordination(const State& state, const RigidBase& base) {
    std::vector<int> count(state.discs.rows(), 0);
    for_each_touching(state, [&](std::size_t, std::size_t i, std::size_t j, Point, double) {
        ++count[i];
        ++count[j];
    });
    for_each_base_contact(
        state, base, [&](std::size_t, std::size_t i, std::size_t, Point, double) { ++count[i]; });
    return count;
}

} // namespace listric::dem
