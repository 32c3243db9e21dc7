#include "dem/events/equilibrium.hpp"

#include "dem/contacts/monitor.hpp"

#include <algorithm>

namespace listric::dem {

Equilibrium::Equilibrium(double extension_rate, double gravity)
    : Observer("equilibrium", Schedule::every(equilibrium_spacing, extension_rate)),
      gravity_(gravity) {
    for (const char* name : {"samples", "mean_ratio_sum", "max_ratio", "last_ratio", "touching"})
        memory.add<double>(name, "1", 0.0);
    memory.resize(1);
}

bool Equilibrium::apply(State& state, const RigidBase& base) {
    const ForceBalance balance = force_balance(state, base, gravity_);
    const auto value = [&](const char* name) -> double& { return memory.get<double>(name)[0]; };
    value("samples") += 1.0;
    value("mean_ratio_sum") += balance.mean_ratio();
    value("max_ratio") = std::max(value("max_ratio"), balance.max_ratio());
    value("last_ratio") = balance.mean_ratio();
    value("touching") = static_cast<double>(balance.touching);
    return false;
}

} // namespace listric::dem
