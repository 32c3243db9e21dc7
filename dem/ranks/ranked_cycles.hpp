#pragma once

#include "dem/cycle/cycle.hpp"
#include "dem/ranks/halo_exchange.hpp"
#include "dem/ranks/subdomain.hpp"

#include <memory>
#include <vector>

namespace listric::dem {

/// Cycles of a whole state on several ranks, with the bits of one. The root has the state and asks
/// for cycles; the others serve it until it is destroyed.
///
/// Subdomains are cut anew after what is not a cycle. An exception on the root leaves the other
/// ranks blocked: then Ranks::abort() ends them.
class RankedCycles {
public:
    /// The rank of every disc, by row.
    using Ownership = std::vector<std::int32_t> (*)(const State& whole, int count);

    /// Referred objects must outlive it.
    RankedCycles(Ranks& ranks, const RigidBase& base, const CyclePhysics& physics,
                 const Execution& execution, Ownership ownership = ranks_by_rows)
        : ranks_(ranks), base_(base), physics_(physics), execution_(execution),
          ownership_(ownership) {
        execution_.packed = &packed_;
    }
    ~RankedCycles();
    RankedCycles(const RankedCycles&) = delete;
    RankedCycles& operator=(const RankedCycles&) = delete;

    int ranks() const { return ranks_.count(); }

    /// As dem::advance(), on the root, but that until collect() only the clock of the state is up
    /// to date, and its contacts are with the subdomains. Throws NumericalFailure if a disc runs
    /// away.
    /// @param state_is_untouched  whether the state is as the last call left it
    void advance(State& whole, std::int64_t cycles, bool state_is_untouched,
                 BaseResponse* response = nullptr);

    /// Puts into the state what cycles have changed since.
    void collect(State& whole);

    /// On the other ranks: until the root ends.
    void serve();

private:
    enum class Task : std::uint8_t { end, advance, collect };
    struct Order {
        Task task = Task::end;
        bool has_subdomain = false; ///< comes with a new subdomain
        int response_interval = 0;
        std::int64_t cycles = 0;
    };

    void give(const Order& order);
    void cut_anew(State& whole);
    void take(Subdomain subdomain);
    std::int64_t carry_out(const Order& order, BaseResponse* response);
    Bytes changed();

    Ranks& ranks_;
    const RigidBase& base_;
    CyclePhysics physics_;
    Execution execution_;
    Ownership ownership_;
    Packed packed_; ///< of the subdomain
    Subdomain subdomain_;
    std::unique_ptr<HaloExchange> halo_;
    std::vector<std::vector<std::int32_t>> own_; ///< on the root, by rank, rows of its discs
    bool is_ahead_ = false; ///< true while the subdomains are newer than the whole
};

} // namespace listric::dem
