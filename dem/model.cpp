#include "dem/model.hpp"

#include "dem/events/equilibrium.hpp"
#include "dem/events/property_update.hpp"
#include "dem/events/sediment_stress.hpp"
#include "dem/events/stage_change.hpp"
#include "dem/events/strain.hpp"

#include <stdexcept>

namespace listric::dem {

namespace {

RigidBase make_base(const Model& m) {
    return make_halfgraben(m.detachment,
                           {m.hanging_wall.length, m.hanging_wall.thickness, m.distance},
                           m.basement, m.motion);
}

void refuse_contradictions(const Model& m) {
    if (m.bond_healing && !m.bonds)
        throw std::invalid_argument("Model::bond_healing needs Model::bonds, which has no value; "
                                    "set it, or leave out bond_healing");
    if (m.compaction && !m.sedimentation)
        throw std::invalid_argument("Model::compaction needs Model::sedimentation, which has no "
                                    "value; set it, or leave out compaction");
    if (m.detachment.footwall_top && m.sedimentation &&
        highest_fill_behind_breakaway(*m.sedimentation, m.motion, m.rate, m.distance) > 0.0)
        throw std::invalid_argument(
            "Model::sedimentation fills above 0 behind the breakaway, beside "
            "Model::detachment.footwall_top, where sediment is not laid down; let its target be 0 "
            "or less at x <= 0");
}

} // namespace

Simulation make_simulation(const Model& m) {
    refuse_contradictions(m);
    const double gravity = m.physics.gravity;
    Simulation simulation(make_base(m), m.physics);
    simulation.end_at(Extension(m.distance));
    simulation.add<Equilibrium>(m.rate, gravity);
    if (m.fault_weakening) {
        simulation.add<PropertyUpdate>(*m.fault_weakening, m.rate, gravity);
        simulation.add<FaultWeakening>(*m.fault_weakening, m.rate, gravity);
    }
    if (m.bond_healing)
        simulation.add<BondHealing>(*m.bond_healing, *m.bonds, m.rate);
    if (m.sedimentation)
        simulation.add<Sedimentation>(*m.sedimentation, m.hanging_wall.radius_ratio, m.rate);
    if (m.sedimentation && gravity > 0.0) {
        std::optional<double> between_changes; // of porosity, m of travel
        if (m.compaction)
            between_changes = Schedule(m.compaction->interval, m.rate).spacing();
        simulation.add<SedimentStress>(strain_window, between_changes, m.rate, m.physics);
    }
    if (m.compaction)
        simulation.add<Compaction>(*m.compaction, m.sedimentation->surface_porosity, m.rate);
    if (StageChange::is_needed(m.motion))
        simulation.add<StageChange>(m.motion);
    simulation.add<Strain>(strain_window, m.rate);
    return simulation;
}

State make_hanging_wall(const Model& m, int threads,
                        const std::function<void(std::string_view, double)>& report) {
    refuse_contradictions(m);
    std::vector<Material> materials(3, m.basement);
    if (m.sedimentation)
        materials[sediment] = m.sedimentation->material;
    if (m.fault_weakening)
        materials[weak] = m.fault_weakening->material;
    RigidBase base = make_base(m);
    stand_backstop(base);
    // The hanging wall comes to rest on a base that does too, so its mean motion is none.
    const GenesisRequest request{
        .hanging_wall = m.hanging_wall,
        .base = std::move(base),
        .materials = std::move(materials),
        .bonds = m.bonds,
        .sediment_density =
            m.sedimentation ? std::optional(disc_density(*m.sedimentation)) : std::nullopt,
        .physics = {.damping = m.physics.damping, .gravity = m.physics.gravity},
        .seed = m.seed,
        .execution = {.threads = threads}};
    return make_hanging_wall(request, [&](std::string_view stage, double share) {
        if (report)
            report(stage, share);
    });
}

} // namespace listric::dem
