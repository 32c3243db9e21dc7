#include "dem/contacts/monitor.hpp"

#include "dem/base/place.hpp"
#include "dem/law.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/order_free.hpp"
#include "dem/numbers/units.hpp"
#include "dem/pushes.hpp"
#include "dem/threads/shared_loop.hpp"

#include <array>

namespace listric::dem {

namespace {

/// Calls visit(row, i, j, normal, overlap) for every pair from row k on, before the end, that
/// touches or is bonded and has a disc in the strip.
template <class Visit>
void for_each_touching(const State& state, SectionStrip strip, std::size_t k, std::size_t end,
                       Visit&& visit) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    for (; k < end; ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        if (!strip.holds(d.x[i]) && !strip.holds(d.x[j]))
            continue;
        const double dx = d.x[j] - d.x[i], dy = d.y[j] - d.y[i];
        const double distance = hypotenuse(dx, dy);
        const double overlap = d.radius[i] + d.radius[j] - distance;
        if (overlap > 0.0 || c.bonded[k])
            visit(k, i, j, Point{dx / distance, dy / distance}, overlap);
    }
}

template <class Visit> void for_each_touching(const State& state, Visit&& visit) {
    for_each_touching(state, {}, 0, state.contacts.rows(), visit);
}

template <class Visit>
void for_each_base_contact(const State& state, const RigidBase& base, SectionStrip strip,
                           Visit&& visit) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstBaseContactColumns c = base_contact_columns(state);
    const BasePlace place = base_place(state);
    for (std::size_t k = 0; k < c.disc.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.disc[k]);
        const auto s = static_cast<std::size_t>(c.surface[k]);
        if (!strip.holds(d.x[i]))
            continue;
        const auto foot = nearest(base.surfaces[s], place, {d.x[i], d.y[i]});
        if (foot && foot->distance < d.radius[i])
            visit(k, i, s, foot->normal, d.radius[i] - foot->distance);
    }
}

/// Force along the normal and the shear force across it.
Point acting(const Material& p, const Material& q, Point n, double overlap, double shear) {
    const double normal = contact_parameters(p, q, 1.0).normal_stiffness * overlap;
    return {normal * n.x - shear * n.y, normal * n.y + shear * n.x};
}

} // namespace

ContactForces contact_forces(const State& state, const RigidBase& base, SectionStrip strip) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const auto material = [&](std::size_t i) -> const Material& {
        return state.materials[d.material[i]];
    };
    ContactForces forces;
    forces.pairs = joined(by_piece(c.first.size(), 2048, [&](std::size_t begin, std::size_t end) {
        std::vector<PairForce> pairs;
        for_each_touching(
            state, strip, begin, end,
            [&](std::size_t k, std::size_t i, std::size_t j, Point n, double overlap) {
                pairs.push_back(
                    {i, j, acting(material(i), material(j), n, overlap, c.shear_force[k])});
            });
        return pairs;
    }));
    for_each_base_contact(
        state, base, strip,
        [&](std::size_t k, std::size_t i, std::size_t s, Point n, double overlap) {
            const double distance = d.radius[i] - overlap;
            const Point foot{d.x[i] - distance * n.x, d.y[i] - distance * n.y};
            forces.base.push_back(
                {i, s, foot, acting(base.material, material(i), n, overlap, b.shear_force[k])});
        });
    return forces;
}

std::vector<Point> net_forces(const ContactForces& contacts, std::size_t discs) {
    std::vector<Point> net(discs);
    for (const auto& [first, second, f] : contacts.pairs) {
        net[first] = {net[first].x - f.x, net[first].y - f.y};
        net[second] = {net[second].x + f.x, net[second].y + f.y};
    }
    for (const BaseForce& contact : contacts.base) {
        Point& on_disc = net[contact.disc];
        on_disc = {on_disc.x + contact.force.x, on_disc.y + contact.force.y};
    }
    return net;
}

ForceBalance force_balance(const State& state, const RigidBase& base, double gravity) {
    const ConstDiscColumns d = disc_columns(state);
    const ContactForces contacts = contact_forces(state, base);
    const std::vector<Point> force = net_forces(contacts, d.x.size());
    const Pushes pushes(state);
    ForceBalance balance;
    balance.reaction.resize(base.surfaces.size());
    std::vector<std::array<OrderFreeSum, 2>> reaction(base.surfaces.size());
    for (const BaseForce& contact : contacts.base) {
        reaction[contact.surface][0] += contact.force.x;
        reaction[contact.surface][1] += contact.force.y;
    }
    for (std::size_t s = 0; s < reaction.size(); ++s)
        balance.reaction[s] = {reaction[s][0].value(), reaction[s][1].value()};
    struct Sums {
        OrderFreeSum weight, unbalanced;
        double max_unbalanced = 0.0;
    };
    OrderFreeSum weight_sum, unbalanced_sum, contact_sum;
    for (const Sums& piece : by_piece(d.x.size(), 2048, [&](std::size_t i, std::size_t end) {
             Sums sums;
             for (; i < end; ++i) {
                 const double weight = d.mass[i] * gravity - pushes[i].y;
                 const double unbalanced =
                     hypotenuse(force[i].x + pushes[i].x, force[i].y - weight);
                 sums.weight += weight;
                 sums.unbalanced += unbalanced;
                 sums.max_unbalanced = greater(sums.max_unbalanced, unbalanced);
             }
             return sums;
         })) {
        weight_sum += piece.weight;
        unbalanced_sum += piece.unbalanced;
        balance.max_unbalanced = greater(balance.max_unbalanced, piece.max_unbalanced);
    }
    balance.weight = weight_sum.value();
    if (!d.x.empty())
        balance.mean_unbalanced = unbalanced_sum.value() / static_cast<double>(d.x.size());
    balance.touching = static_cast<std::int64_t>(contacts.pairs.size());
    for (const OrderFreeSum& piece :
         by_piece(contacts.pairs.size(), 2048, [&](std::size_t k, std::size_t end) {
             OrderFreeSum sum;
             for (; k < end; ++k)
                 sum += hypotenuse(contacts.pairs[k].force.x, contacts.pairs[k].force.y);
             return sum;
         }))
        contact_sum += piece;
    if (balance.touching)
        balance.mean_contact = contact_sum.value() / static_cast<double>(balance.touching);
    return balance;
}

std::vector<SurfaceLoad> surface_loads(const State& state, const RigidBase& base) {
    std::vector<SurfaceLoad> loads(base.surfaces.size());
    const ConstDiscColumns d = disc_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    for_each_base_contact(
        state, base, {}, [&](std::size_t k, std::size_t i, std::size_t s, Point n, double overlap) {
            const Point f =
                acting(base.material, state.materials[d.material[i]], n, overlap, b.shear_force[k]);
            SurfaceLoad& load = loads[s];
            load.force = {load.force.x + f.x, load.force.y + f.y};
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
        state, base, {}, [&](std::size_t k, std::size_t i, std::size_t, Point n, double overlap) {
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
        state, base, {},
        [&](std::size_t, std::size_t i, std::size_t, Point, double) { ++count[i]; });
    return count;
}

} // namespace listric::dem
