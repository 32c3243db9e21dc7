#include "dem/events/energy_account.hpp"
#include "dem/events/equilibrium.hpp"

#include "apps/model/effect_list.hpp"
#include "apps/scene/parameters/stage.hpp"

#include <algorithm>
#include <cmath>

namespace listric::effects::energy {

namespace {

using P = dem::EnergyParameters;

void add_events(const Scene&, const ModelParts& parts, dem::Events& events) {
    std::vector<std::string> names;
    for (const auto& other : events)
        if (other->stage() != dem::Stage::sample) // which only looks
            names.push_back(other->name());
    dem::add(events,
             std::make_unique<dem::EnergyAccount>(parts.physics.gravity, parts.base_moves, names));
}

using E = dem::EnergyBalance;

std::optional<E> balance(const Observation& now) {
    const auto* account = dem::find<const dem::EnergyAccount>(now.events);
    return account ? std::optional(account->balance(now.state, now.parts.base)) : std::nullopt;
}

/// A member of the balance; not a number where that is not known.
template <auto... Member> std::optional<double> of(const Observation& now) {
    const auto e = balance(now);
    return e ? std::optional(taken<Member...>(*e).value_or(std::nan(""))) : std::nullopt;
}

std::optional<double> residual(const Observation& now) {
    const auto e = balance(now);
    if (!e)
        return std::nullopt;
    const double work = e->boundary_work + e->gravity_work;
    return work != 0.0 ? e->residual() / work : std::nan("");
}

std::vector<Measure<Observation>> measures() {
    using Stored = dem::StoredEnergy;
    constexpr std::string_view unit = "J/m";
    return {
        {"energy_boundary_work_j_per_m", unit, "work of base and wall",
         "work of base and right wall on the discs by extension; negative where they are pulled "
         "along",
         of<&E::boundary_work>},
        {"energy_gravity_work_j_per_m", unit, "work of weight", "work of weight, over the cycles",
         of<&E::gravity_work>},
        {"energy_events_j_per_m", unit, "energy changed by events",
         "change of kinetic and strain energy by events: radii, stiffnesses and masses that "
         "change, bonds made, sediment that comes and goes",
         of<&E::events>},
        {"energy_kinetic_j_per_m", unit, "kinetic energy", "kinetic energy now",
         of<&E::stored, &Stored::kinetic>},
        {"energy_strain_normal_j_per_m", unit, "strain energy, normal",
         "energy in the contacts' normal springs now", of<&E::stored, &Stored::normal_strain>},
        {"energy_strain_shear_j_per_m", unit, "strain energy, shear",
         "energy in the contacts' shear springs now", of<&E::stored, &Stored::shear_strain>},
        {"energy_stored_change_j_per_m", unit, "growth of stored energy",
         "change of kinetic and strain energy since extension began", of<&E::stored_change>},
        {"energy_friction_j_per_m", unit, "energy lost by friction",
         "energy lost by slip, between discs and on the base", of<&E::friction>},
        {"energy_damping_j_per_m", unit, "energy lost by damping",
         "energy lost by local damping; where damping is relative to a mean motion or to a "
         "stretching base, less the work of its force on that motion",
         of<&E::damping>},
        {"energy_bond_breaking_j_per_m", unit, "energy lost by breaking bonds",
         "energy in the springs of bonds when they broke", of<&E::bond_breaking>},
        {"energy_stepping_j_per_m", unit, "energy lost by the time step",
         "energy lost by the integration where contacts close or open within a step; it shrinks "
         "with the step",
         of<&E::stepping>},
        {"energy_base_work_j_per_m", unit, "work of the deforming base",
         "work of a deforming base on the discs; negative where the base gives way to them. The "
         "base's elastic energy, reference load and virtual loads are not counted",
         of<&E::base_work>},
        {"energy_residual", "1", "error of the energy's balance",
         "(stored change + friction + damping + bond breaking + stepping - boundary, base and "
         "gravity work - events) over boundary and gravity work",
         residual},
    };
}

std::optional<std::vector<NamedNumbers>> by_event(const Observation& now) {
    const auto e = balance(now);
    if (!e)
        return std::nullopt;
    return std::vector<NamedNumbers>{e->by_event};
}

} // namespace

Works works() { return {}; }

const Effect& effect() {
    static const Effect effect{
        .name = "energy",
        .doc = "energy budget; the cycle then takes one thread and five times as long",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .check =
            [](const Scene& scene, const Refuse& refuse) {
                if (scene.find<Stages>())
                    refuse("energy", "is beside [[stage]], but the account of energy knows one "
                                     "steady motion alone; leave out one of the two");
            },
        .on_ranks = [](const Scene&) -> std::optional<Objection> {
            return Objection{"energy", "is added up contact by contact, which one process can; "
                                       "leave the table out, or start one process"};
        },
        .contribute = [](const Scene&, ModelParts& parts) { parts.accounts_energy = true; },
        .add_events = add_events,
        .measures = measures(),
        .objects = {{"energy_by_event_j_per_m",
                     "J/m",
                     "energy changed by",
                     "change of kinetic and strain energy by each event",
                     {},
                     by_event,
                     false}},
    };
    return effect;
}

} // namespace listric::effects::energy
