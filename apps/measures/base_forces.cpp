#include "apps/measures/base_forces.hpp"

#include "dem/base/contact.hpp"
#include "dem/columns.hpp"
#include "dem/law.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace listric::measures {

using namespace dem;

namespace {

/// A contact slides from this share of its limit on: discs that slip at the limit have moved by a
/// step since their force was found.
constexpr double at_limit = 0.99;

/// A contact of a disc with the base.
struct Touch {
    std::size_t surface;
    double x;             ///< of the point of the base, where it is without load, m
    double normal, shear; ///< N; shear above 0 pulls the disc along the chain
    double slip;          ///< of the disc along the chain, past the base, m/s
    double limit;         ///< of the shear, N
    double length;        ///< of the base that is the disc's, m
    Point force;          ///< on the disc, N
};

template <class Visit> void for_each_touch(const State& state, const RigidBase& base, Visit visit) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstBaseContactColumns b = base_contact_columns(state);
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    const BasePlace place = base_place(state);
    const BaseInstant now = base_instant(base, state.clock);
    for (std::size_t k = 0; k < b.disc.size(); ++k) {
        const auto i = static_cast<std::size_t>(b.disc[k]);
        const auto s = static_cast<std::size_t>(b.surface[k]);
        const Surface& surface = base.surfaces[s];
        const BaseContactDisc disc{d.x[i], d.y[i], d.vx[i], d.vy[i], d.spin[i], d.radius[i]};
        std::optional<BaseContactMotion> motion;
        double x = 0.0;
        if (place.deforms(surface)) {
            double at = state.base_contacts.get(columns::place)[k];
            const NodeContactMotion moves =
                node_contact_motion(surface, nodes, now.extension, disc, at);
            motion = surface_motion(surface, moves, now, disc);
            x = moves.x;
        } else {
            motion = base_contact_motion(surface, now, disc);
            if (motion)
                x = x_of_foot(motion->foot, disc);
        }
        if (!motion || motion->foot.distance >= disc.radius)
            continue;
        const ContactParameters p =
            base_contact_parameters(base.material, state.materials[d.material[i]], 1.0);
        const double normal =
            static_cast<double>(p.normal_stiffness) * (disc.radius - motion->foot.distance);
        double friction = friction_of(surface, now);
        if (surface.friction_rule == FrictionRule::smaller)
            friction = std::min(friction, static_cast<double>(p.friction));
        const Point n = motion->foot.normal;
        const double shear = b.shear_force[k];
        visit(Touch{s,
                    x,
                    normal,
                    -shear,
                    -motion->slip_rate,
                    friction * normal,
                    2.0 * disc.radius,
                    {normal * n.x - shear * n.y, normal * n.y + shear * n.x}});
    }
}

/// Sums over the contacts of a part.
struct Sums {
    double normal = 0.0, shear = 0.0, length = 0.0, sliding = 0.0, slip = 0.0;

    void add(const Touch& t) {
        normal += t.normal;
        shear += t.shear;
        length += t.length;
        slip += t.slip * t.length;
        if (std::abs(t.shear) >= at_limit * t.limit)
            sliding += t.length;
    }

    std::optional<BasePart> part(double wall_speed) const {
        if (length == 0.0 || normal == 0.0)
            return std::nullopt;
        return BasePart{shear / normal,
                        wall_speed != 0.0 ? std::optional(slip / length / wall_speed)
                                          : std::nullopt,
                        sliding / length};
    }
};

} // namespace

BaseForces measure_base_forces(const State& state, const RigidBase& base) {
    const double flat_from = sole_out(base_line(base, 0.0));
    const Surface* const block = find_basement_block(base);
    Sums ramp, flat, all;
    std::vector<double> pushes(base.surfaces.size()); // horizontal, on the discs, N
    for_each_touch(state, base, [&](const Touch& touch) {
        pushes[touch.surface] += touch.force.x;
        if (touch.surface != 0 && &base.surfaces[touch.surface] != block)
            return;
        (touch.x < flat_from ? ramp : flat).add(touch);
        all.add(touch);
    });
    const double speed = std::abs(base_instant(base, state.clock).speed);
    BaseForces forces{ramp.part(speed), flat.part(speed), all.part(speed), {}, {}};
    for (std::size_t s = 0; s < base.surfaces.size(); ++s) {
        if (base.surfaces[s].name == "right wall")
            forces.right_wall = -pushes[s];
        if (base.surfaces[s].name == "left wall")
            forces.left_wall = pushes[s];
    }
    return forces;
}

} // namespace listric::measures
