#include "dem/events/energy_account.hpp"

#include "dem/pushes.hpp"

namespace listric::dem {

namespace {

const std::string prefix = "event_";
const std::string shrinking = "event_compaction"; ///< also works in the cycles, by its rates

} // namespace

EnergyAccount::EnergyAccount(double gravity, bool base_deforms, std::span<const std::string> events)
    : Observer("energy", never, Stage::account), gravity_(gravity) {
    for (const char* name : {"initial", "stored", "potential", "boundary_work", "gravity_work",
                             "friction", "damping", "bond_breaking", "stepping"})
        memory.add<double>(name, "J/m", 0.0);
    if (base_deforms)
        memory.add<double>("base_work", "J/m", 0.0);
    for (const std::string& event : events)
        memory.add<double>(prefix + event, "J/m", 0.0);
    memory.resize(1);
}

void EnergyAccount::open(const State& state, const RigidBase& base) {
    const StoredEnergy now = stored_energy(state, base, gravity_);
    value("initial") = value("stored") = now.motion_and_strain();
    value("potential") = now.potential;
    if (Pushes(state).any())
        for (const char* name : {"push_work", "push_potential"})
            memory.add<double>(name, "J/m", 0.0);
    keep_push_potential(now);
}

void EnergyAccount::keep_push_potential(const StoredEnergy& now) {
    if (memory.has("push_potential"))
        value("push_potential") = now.push_potential;
}

EnergyFlows EnergyAccount::flows() const {
    return {.boundary_work = value("boundary_work"),
            .base_work = memory.has("base_work") ? value("base_work") : 0.0,
            .friction = value("friction"),
            .damping = value("damping"),
            .bond_breaking = value("bond_breaking"),
            .stepping = value("stepping"),
            .radii = memory.has(shrinking) ? value(shrinking) : 0.0};
}

void EnergyAccount::put(const EnergyFlows& flows) {
    value("boundary_work") = flows.boundary_work;
    if (memory.has("base_work"))
        value("base_work") = flows.base_work;
    value("friction") = flows.friction;
    value("damping") = flows.damping;
    value("bond_breaking") = flows.bond_breaking;
    value("stepping") = flows.stepping;
    if (memory.has(shrinking))
        value(shrinking) = flows.radii;
}

void EnergyAccount::book_cycles(const State& state, const RigidBase& base) {
    const StoredEnergy now = stored_energy(state, base, gravity_);
    value("gravity_work") += value("potential") - now.potential;
    value("potential") = now.potential;
    value("stored") = now.motion_and_strain();
    if (memory.has("push_work"))
        value("push_work") += value("push_potential") - now.push_potential;
    keep_push_potential(now);
}

void EnergyAccount::book_event(const std::string& name, const State& state, const RigidBase& base) {
    if (!memory.has(prefix + name))
        return;
    const StoredEnergy now = stored_energy(state, base, gravity_);
    value(prefix + name) += now.motion_and_strain() - value("stored");
    value("potential") = now.potential;
    value("stored") = now.motion_and_strain();
    keep_push_potential(now);
}

EnergyBalance EnergyAccount::balance(const State& state, const RigidBase& base) const {
    const StoredEnergy now = stored_energy(state, base, gravity_);
    EnergyBalance b{
        value("boundary_work"),
        value("gravity_work") + value("potential") - now.potential,
        memory.has("base_work") ? std::optional(value("base_work")) : std::nullopt,
        memory.has("push_work")
            ? std::optional(value("push_work") + value("push_potential") - now.push_potential)
            : std::nullopt,
        now,
        now.motion_and_strain() - value("initial"),
        value("friction"),
        value("damping"),
        value("bond_breaking"),
        value("stepping"),
        0.0,
        {}};
    for (const Column& column : memory.columns())
        if (column.name.starts_with(prefix)) {
            b.by_event.emplace_back(column.name.substr(prefix.size()), value(column.name));
            b.events += value(column.name);
        }
    return b;
}

} // namespace listric::dem
