#pragma once

#include "dem/event.hpp"
#include "dem/numbers/point.hpp"

#include <functional>
#include <string>
#include <vector>

namespace listric::dem {

/// Faults of before extension: bands along lines whose rock is weak from the start, made so as
/// fault detection does it.
struct OldFaultsParameters {
    /// A fault: its points, x and y, m, y up, the width of its band, m, and a name for messages.
    struct Fault {
        std::vector<Point> points;
        double width = 0.0;
        std::string name = {};
    };

    std::vector<Fault> faults;
    double mean_stress_ratio = 0.75; ///< mean stress in a fault over the weight above it
    /// Told of a fault without discs that can be weakened; it may throw. None: nobody wants to
    /// know.
    std::function<void(const Fault&)> on_empty = {};
};

/// Discs of rock that can be weakened whose centres are in a band, ascending.
std::vector<std::int32_t> discs_on(const State& state, const OldFaultsParameters::Fault& fault);

/// Weakens old faults before the first cycle, and does nothing ever after.
class OldFaults : public Event {
public:
    OldFaults(OldFaultsParameters parameters, double gravity);

    void begin(State& state) override;
    bool start(State& state, const RigidBase& base) override;
    bool apply(State&, const RigidBase&) override { return false; }

private:
    OldFaultsParameters parameters_;
    double gravity_; ///< m/s^2
};

} // namespace listric::dem
