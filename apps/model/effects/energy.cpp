#include "dem/events/energy_account.hpp"
#include "dem/events/equilibrium.hpp"

#include "apps/model/effect_list.hpp"

#include <algorithm>

namespace listric::effects {

namespace {

using P = dem::EnergyParameters;

std::vector<StagedEvent> make_events(const Scene&, const ModelParts& parts,
                                     std::span<const StagedEvent> others) {
    std::vector<std::string> names;
    for (const StagedEvent& other : others)
        if (other.stage != EventStage::sample) // which only looks
            names.push_back(other.event->name());
    std::vector<StagedEvent> events;
    events.push_back({EventStage::account, std::make_unique<dem::EnergyAccount>(
                                               parts.physics.gravity, parts.base_moves, names)});
    return events;
}

EffectMeasures measure(const Observation& now) {
    const auto* account = dem::find<const dem::EnergyAccount>(now.events);
    if (!account)
        return {};
    const dem::EnergyBalance e = account->balance(now.state, now.parts.base);
    EffectMeasures measures;
    measures.numbers = {
        {"energy_boundary_work_j_per_m", e.boundary_work},
        {"energy_gravity_work_j_per_m", e.gravity_work},
        {"energy_events_j_per_m", e.events},
        {"energy_kinetic_j_per_m", e.stored.kinetic},
        {"energy_strain_normal_j_per_m", e.stored.normal_strain},
        {"energy_strain_shear_j_per_m", e.stored.shear_strain},
        {"energy_stored_change_j_per_m", e.stored_change},
        {"energy_friction_j_per_m", e.friction},
        {"energy_damping_j_per_m", e.damping},
        {"energy_bond_breaking_j_per_m", e.bond_breaking},
        {"energy_stepping_j_per_m", e.stepping},
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double work = e.boundary_work + e.gravity_work;
    measures.numbers.emplace_back("energy_base_work_j_per_m", e.base_work.value_or(nan));
    measures.numbers.emplace_back("energy_residual", work != 0.0 ? e.residual() / work : nan);
    measures.groups.emplace_back("energy_by_event_j_per_m",
                                 NamedNumbers(e.by_event.begin(), e.by_event.end()));
    return measures;
}

} // namespace

const Effect& energy() {
    static const Effect effect{
        .name = "energy",
        .doc = "account of where the work goes; then the cycle takes one thread and five times as "
               "long",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .on_ranks = [](const Scene&) -> std::optional<Objection> {
            return Objection{"energy", "is added up contact by contact, which one process can; "
                                       "leave the table out, or start one process"};
        },
        .contribute = [](const Scene&, ModelParts& parts) { parts.accounts_energy = true; },
        .make_events = make_events,
        .measure = measure,
    };
    return effect;
}

} // namespace listric::effects
