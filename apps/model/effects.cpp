#include "apps/model/effects.hpp"

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

using namespace dem;

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
