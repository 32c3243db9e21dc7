#include "apps/effects.hpp"

#include "dem/events/bond_healing.hpp"
#include "dem/events/compaction.hpp"
#include "dem/events/energy_account.hpp"
#include "dem/events/equilibrium.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/property_update.hpp"
#include "dem/events/sedimentation.hpp"
#include "dem/events/strain.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <cmath>

namespace listric {

std::vector<std::unique_ptr<Event>> make_events(const Scene& s) {
    const double rate = s.extension.rate;
    const double gravity = s.gravity ? s.gravity->acceleration : 0.0;
    const double density = s.hanging_wall->rock_density;
    std::vector<std::unique_ptr<Event>> events;
    events.push_back(std::make_unique<Equilibrium>(2500.0, rate, gravity));
    if (s.fault_weakening)
        events.push_back(
            std::make_unique<PropertyUpdate>(*s.fault_weakening, rate, gravity, density));
    if (s.compaction)
        events.push_back(std::make_unique<Compaction>(
            *s.compaction, s.sedimentation->surface_porosity,
            Target(s.sedimentation->level, s.sedimentation->target), rate));
    if (s.bond_healing)
        events.push_back(std::make_unique<BondHealing>(*s.bond_healing, *s.bonds, rate));
    if (s.fault_weakening)
        events.push_back(
            std::make_unique<FaultWeakening>(*s.fault_weakening, rate, gravity, density));
    if (s.sedimentation)
        events.push_back(
            std::make_unique<Sedimentation>(*s.sedimentation, s.hanging_wall->radius_ratio, rate));
    if (s.energy) {
        std::vector<std::string> names;
        for (const auto& event : events)
            if (event->name() != "equilibrium") // which only looks
                names.push_back(event->name());
        events.push_back(
            std::make_unique<EnergyAccount>(gravity, s.elastic_base || s.base_motion, names));
    }
    // Last, so that a window starts with the discs that were deposited at its start.
    events.push_back(std::make_unique<Strain>(strain_window, rate));
    return events;
}

std::vector<Material> make_materials(const Scene& s) {
    std::vector<Material> materials(3, s.basement);
    if (s.sedimentation)
        materials[sediment] = s.sedimentation->material;
    if (s.fault_weakening)
        materials[weak] = s.fault_weakening->material;
    return materials;
}

RigidBase make_base(const Scene& s) {
    constexpr double high = 1e5; // m, higher than anything piles up
    const double degree = pi / 180.0;
    RigidBase base;
    base.material = s.basement;
    base.motion = {s.extension.speed, s.extension.ramp};
    const double length = s.hanging_wall->length;
    // The flat must reach beyond the right wall's last position.
    const double far = length + 1.5 * s.extension.distance + s.hanging_wall->thickness;
    const Surface right_wall{
        "right wall", {line({length, -high}, {length, high})}, 0.0, 0.0, {1.0, 0.0}};
    if (s.stretching) {
        const double floor = -s.hanging_wall->thickness;
        base.surfaces = {
            {"base", {line({0.0, floor}, {far, floor})}, s.stretching->friction, 0.0, {}, length},
            {"left wall", {line({0.0, high}, {0.0, -high})}},
            right_wall};
        return base;
    }
    Chain detachment;
    Point start{0.0, 0.0};
    double dip = s.detachment->start_dip;
    for (const DetachmentSegment& piece : s.detachment->segments) {
        dip = piece.start_dip.value_or(dip);
        const Point along{std::cos(dip * degree), -std::sin(dip * degree)};
        if (piece.kind == DetachmentSegment::Kind::arc) {
            detachment.push_back(arc(start, along, piece.radius, (dip - piece.end_dip) * degree));
            dip = piece.end_dip;
        } else {
            detachment.push_back(
                line(start, {start.x + piece.length * along.x, start.y + piece.length * along.y}));
        }
        start = detachment.back().end;
    }
    if (start.x < far)
        detachment.push_back(line(start, {far, start.y}));
    base.surfaces = {
        {"detachment", detachment, s.detachment->friction, 1.0, {}},
        {"backstop", {line({0.0, high}, {0.0, 0.0})}},
        right_wall,
    };
    if (s.elastic_base || s.base_motion) {
        base.surfaces[0].follows = Follows::nodes;
        base.surfaces[0].degree = s.elastic_base ? s.elastic_base->degree : 2;
        base.surfaces[1].follows = Follows::breakaway;
    }
    return base;
}

std::vector<std::string> effect_names(const Scene& s) {
    std::vector<std::string> names;
    if (s.gravity)
        names.push_back("gravity");
    if (s.bonds)
        names.push_back("bonds");
    if (s.fault_weakening)
        names.push_back("fault_weakening");
    if (s.bond_healing)
        names.push_back("bond_healing");
    if (s.sedimentation)
        names.push_back("sedimentation");
    if (s.compaction)
        names.push_back("compaction");
    if (s.energy)
        names.push_back("energy");
    if (s.elastic_base)
        names.push_back("elastic_base");
    if (s.lower_crust_thinning)
        names.push_back("lower_crust_thinning");
    if (s.basin_water)
        names.push_back("basin_water");
    if (s.footwall_erosion)
        names.push_back("footwall_erosion");
    if (s.base_motion)
        names.push_back("base_motion");
    return names;
}

} // namespace listric
