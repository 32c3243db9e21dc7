#pragma once

#include "dem/base.hpp"
#include "dem/contacts/energy.hpp"
#include "dem/cycle/cycle_choice.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/state.hpp"
#include "dem/threads/best_team.hpp"

#include <cstdint>
#include <memory>

namespace listric::dem {

class FastCycle;

/// Packed state of the fast cycle and its best team, kept from call to call: packing
/// takes as long as some ten cycles. Whoever keeps it forgets what is packed when anything but
/// advance() has changed the state.
class Packed {
public:
    Packed() = default;
    Packed(const Packed&) = delete;
    Packed& operator=(const Packed&) = delete;
    Packed(Packed&&) = default;
    Packed& operator=(Packed&&) = default;

    void forget() { holds_ = false; }
    /// Forgets the packed columns of discs, where nothing else has changed.
    void forget_discs() { holds_discs_ = false; }
    BestTeam& team() { return team_; }

private:
    friend std::int64_t advance_fast(State&, const RigidBase&, const CyclePhysics&, std::int64_t,
                                     const struct Execution&, BaseResponse*, class Surroundings&);
    friend void unpack_part(State&, const Packed&);

    std::shared_ptr<FastCycle> cycle_; ///< never shared; FastCycle is incomplete here
    BestTeam team_{1};
    bool holds_ = false;       ///< whether it is what the state is
    bool holds_discs_ = false; ///< whether its discs are, too
};

/// How the cycle is computed; the result is the same to the last bit.
struct Execution {
    int threads = 1; ///< at least 1: else who is to compute throws std::invalid_argument
    Cycle cycle = best_cycle();
    /// Adds up energies, if given: then the cycle is the plain one, on one thread.
    EnergyFlows* energy = nullptr;
    Packed* packed = nullptr; ///< none: every call packs anew
    /// Whether the state is as the last call left it, for those who keep a copy elsewhere.
    bool state_is_untouched = false;

    /// This execution for several calls, which pack into `here` if there is nothing else.
    Execution keeping(Packed& here) const {
        Execution kept = *this;
        if (!kept.packed)
            kept.packed = &here;
        return kept;
    }
};

} // namespace listric::dem
