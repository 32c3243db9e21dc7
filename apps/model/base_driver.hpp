#pragma once

#include "apps/support/named_numbers.hpp"
#include "dem/base.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/state.hpp"
#include "fem/footwall.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

/// The footwall is strained or turned by more than linear elasticity can mean.
struct BeyondElasticity : dem::NumericalFailure {
    using dem::NumericalFailure::NumericalFailure;
};

/// A driver's account of a window of extension that has ended.
struct BaseWindow {
    NamedNumbers measures; ///< columns of history.csv
    /// Why the run must not go on: the field is beyond linear elasticity.
    std::optional<std::string> beyond_elasticity = {};
};

/// A base that was solved for once more.
struct BaseCheck {
    NamedNumbers measures; ///< numbers of summary.json
    std::string line;      ///< that says so in the log
};

/// Moves the nodes of a base that deforms, as an effect of the scene wants: a run knows no more of
/// it. Made when the run begins or resumes; all that it remembers is in the state and in the events
/// of its loads.
class BaseDriver {
public:
    BaseDriver() = default;
    BaseDriver(const BaseDriver&) = delete;
    BaseDriver& operator=(const BaseDriver&) = delete;
    virtual ~BaseDriver() = default;

    /// Lines for the log.
    virtual std::vector<std::string> description() const { return {}; }

    /// Sets the nodes' velocities between cycles.
    virtual dem::BaseResponse& response() = 0;

    /// Wall time spent in responses since the last call, s; 0 where it is not worth counting.
    virtual double take_seconds() { return 0.0; }

    /// Told the stage and the share of it that is done; may throw.
    using Progress = std::function<void(std::string_view stage, double share)>;

    /// Gives a hanging wall before extension the nodes, on which it comes to rest where they answer
    /// to its loads. Throws NumericalFailure.
    virtual void settle(dem::State& state, const dem::RigidBase& base,
                        const dem::CyclePhysics& physics, const dem::Execution& execution,
                        const Progress& progress) const = 0;

    /// Refuses a state that has come to rest on another base, else is the base of that state.
    /// Throws UsageError.
    virtual void require_own(const dem::State&) {}

    /// Ends a window of extension and begins the next.
    virtual BaseWindow end_window(dem::State&, const dem::RigidBase&) { return {}; }

    /// The footwall with its field at that moment, which lasts until another moment's is recovered;
    /// null: nothing is known of what lies below the nodes. Throws as require_own.
    virtual const fem::Footwall* recover(const dem::State&) { return nullptr; }

    /// Solves for the base under the mean forces of the last window on a finer mesh; none before a
    /// window has ended, or where there is nothing to solve.
    virtual std::optional<BaseCheck> check(const dem::State&) const { return std::nullopt; }
};

} // namespace listric
