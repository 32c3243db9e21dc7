#pragma once

#include "dem/base.hpp"
#include "dem/base/contact.hpp"
#include "dem/cycle/aligned_vector.hpp"
#include "dem/cycle/execution.hpp"
#include "dem/cycle/fast_cycle_kernels.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <vector>

namespace listric::dem {

// The plain cycle (plain_cycle.cpp) in the layout of the machine, with the same bits.
//
// Why it gives the same bits: every contact is computed by the same operations in the same order,
// eight at a time; and every disc adds its forces in the same order, base contacts first, then
// contacts by row. Nothing is added by two threads, so their number does not matter.
//
// Why it is fast:
// - A contact's force goes to a slot of its own, and a disc gathers its slots. Scattering with
//   eight lanes would collide.
// - A disc is one record of 64 bytes, a cache line. Eight pairs of records are loaded whole, two
//   halves to a register, and transposed; gathers of single numbers take longer. Discs and slots
//   are listed by their first number, which the processor's addressing takes as it is.
// - Force and motion are one sweep. Contacts are sorted by their first disc, which comes before
//   the second, so once a tile's contacts are done, all forces on its discs are known and no later
//   contact reads them: the discs move at once, while they are in the cache. Slots are then free
//   again, so that a small ring of them is enough.
// - Discs move with their three velocities in one register.
// - Records, blocks and lists are fetched ahead. The processor foresees streams, but not soon
//   enough once they come from beyond its caches: 1.6 times the speed at 100,000 discs. It needs
//   large pages for that, see aligned_vector.hpp: another 1.1 times.
// - Scenes without bonds, friction or resistance to rolling run cycles compiled without them.

class Surroundings;
struct Halo;

/// Does what advance_plainly() does without an account of energy.
std::int64_t advance_fast(State& state, const RigidBase& base, const CyclePhysics& physics,
                          std::int64_t cycles, const Execution& execution, BaseResponse* response,
                          Surroundings& around);

/// See unpack_part() of an execution.
void unpack_part(State& part, const Packed& packed);

class FastCycle {
public:
    /// @param threads  upper limit
    FastCycle(int threads, Cycle level) : threads_(threads), level_(level) {}

    /// Whether what is packed, if anything is, is of that base.
    bool is_for(const RigidBase& base, const Execution& execution) const {
        return threads_ == execution.threads && level_ == execution.cycle &&
               (base_ == &base || base_ == nullptr);
    }

    /// Base and physics must outlive it.
    /// @param halo  of a state that is part of a larger one; none: it is whole
    void pack(const State& state, const RigidBase& base, const CyclePhysics& physics,
              const Halo* halo);

    /// Packs the discs anew, where nothing else has changed.
    void pack_discs(const State& state);

    /// Runs until `cycles` cycles are done or the lists must be updated. Updates clock and bound of
    /// the state and the nodes of its base, nothing else. Returns the number of cycles done.
    std::int64_t run(State& state, std::int64_t cycles, BestTeam& team, BaseResponse* response,
                     Surroundings& around);

    /// Packs what an update of the neighbour lists has changed; ghosts may have come, too.
    /// @param lists_changed  not only where discs have been found
    void pack_updated(const State& state, bool lists_changed, const Halo* halo);

    /// Writes positions, velocities, shear forces and bonds back into the state's columns.
    void unpack(State& state);

private:
    struct Place {
        double x, y; ///< m
    };

    /// Over the neighbour lists, as State has it.
    struct Watch {
        double bound, speed;
        std::int64_t check_interval;

        void enter(double fastest, double time_step);
    };
    struct Piece; ///< of work that the threads share
    class Worker; ///< one of them

    std::int64_t run_piece(State& state, std::int64_t cycles, BestTeam& team,
                           BaseResponse* response, Surroundings& around);
    void mark_ghosts(const Halo* halo);
    void fill(Halo& halo) const;
    void take_ghosts(const Halo& halo);
    void divide_work(const State& state, const Halo* halo);
    void cut_off_borders(const Halo& halo);
    /// Calls work(strip) for all strips, which the threads at hand share.
    template <class Work> void for_each_strip(Work&& work);
    void pack_discs(const State& state, const fast::Strip& strip);
    void pack_contacts(const State& state);
    void pack_searched_places(const State& state);
    void pack_blocks(const State& state, fast::Strip& strip);
    static std::size_t ring_of(const fast::Strip& strip);
    void assign_slots(fast::Strip& strip);
    void pack_base_contacts(const State& state, fast::Strip& strip);
    void pack_gathers(const State& state, fast::Strip& strip);
    void unpack(const fast::Strip& strip, State& state) const;

    template <class Rolling> void compute_base(fast::Strip& strip, const BaseInstant& now);
    template <class Rolling>
    void compute_nodes(fast::Strip& strip, const BaseNodeColumns& nodes, const BaseInstant& now);
    fast::ContactLaw law() const { return {bonded_, frictional_ || rolls_, rolls_}; }
    double move_base(State& state, const BaseNodeColumns& nodes, const Clock& clock,
                     BaseResponse* response, Surroundings& around);
    fast::DampedAgainst damped_against() const;
    double furthest(const fast::Strip& strip) const;
    double greatest_displacement(const State& state, double extension) const;

    int threads_;
    Cycle level_;
    const RigidBase* base_ = nullptr;
    CyclePhysics physics_;
    double time_step_ = 0.0;
    std::size_t disc_count_ = 0;
    AlignedVector<fast::Disc> discs_;
    AlignedVector<fast::Inertia> inertia_;
    std::vector<Place> searched_places_;
    std::vector<std::int64_t> own_; ///< by disc: -1, or 0 for a ghost; empty: there are no ghosts
    AlignedVector<fast::Slot> slots_;
    std::vector<fast::Strip> strips_;
    bool bonded_ = false, frictional_ = false; ///< whether any contact is
    bool rolls_ = false;                       ///< whether contacts resist rolling
    bool deforms_ = false;                     ///< whether the base has nodes
    double fastest_node_[2] = {0.0, 0.0};      ///< in even and in odd cycles, m/s
    double displacement_ = 0.0;                ///< the greatest, as it was measured last, m
    /// Greatest of the cycles since the last check, m/s, where all have to agree on them.
    std::vector<double> speeds_;

    std::vector<std::uint32_t> slot_of_, base_slot_of_; ///< by row of the contact tables
};

} // namespace listric::dem
