#pragma once

#include "dem/aligned_vector.hpp"
#include "dem/base.hpp"
#include "dem/base_contact.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/law.hpp"
#include "dem/simd.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <limits>
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
// - Scenes without bonds or friction run cycles compiled without them.

/// What the velocity of a disc is damped against; with or without a sample for the mean.
enum class DampedAgainst { rest, mean_motion, mean_motion_sampled, stretching };

/// The same as advance_plainly() without an account of energy. `threads` >= 1.
void advance_fast(State& state, const RigidBase& base, const CyclePhysics& physics,
                  std::int64_t cycles, int threads, BaseResponse* response);

class FastCycle {
public:
    /// Packs a state. `threads` >= 1. Base and physics must outlive this.
    FastCycle(const State& state, const RigidBase& base, const CyclePhysics& physics, int threads);

    /// Runs until `cycles` cycles are done or the lists must be updated. Updates clock and bound of
    /// the state and the nodes of its base, nothing else. Returns the number of cycles done.
    std::int64_t run(State& state, std::int64_t cycles, BaseResponse* response = nullptr);

    /// Packs new contact lists, of the same discs.
    void pack_contacts(const State& state);

    void pack_searched_places(const State& state);

    /// Writes positions, velocities, shear forces and bonds back into the state's columns.
    void unpack(State& state) const;

private:
    struct alignas(64) Disc {
        Double4 place;    ///< x, y, rotation, radius
        Double4 velocity; ///< vx, vy, spin, rate of the radius
    };

    /// What a disc's motion depends on beside the forces. The means are sampled rarely.
    struct alignas(32) Inertia {
        double per_mass;        ///< time step over inertial mass, s/kg
        double weight;          ///< N
        double per_moment;      ///< time step over moment of inertia, s/(kg m^2)
        float mean_velocity[2]; ///< m/s
    };
    /// Force on the second disc; moments on the first (negative) and the second.
    using Slot = Double4;

    /// Eight contacts, a lane each.
    struct alignas(64) Block {
        double shear_force[8];
        float tensile_strength[8]; ///< minus infinity: not bonded
        float shear_strength[8];
        float normal_stiffness[8], shear_stiffness_times_step[8], friction[8];
        std::uint32_t first[8], second[8]; ///< discs, as their places among the numbers of discs_
        std::uint32_t slot;                ///< of the first contact; the others follow
    };

    struct BaseContact {
        std::int32_t disc;
        const Surface* surface;
        ContactParameters parameters;
        double shear_force;
        std::uint32_t slot;
    };

    /// With a surface that deforms.
    struct NodeContact {
        BaseContact contact;
        std::size_t row; ///< of the table
        double place;
        NodeContactForce force; ///< of this cycle
    };

    /// Contacts, eight at a time.
    struct Blocks {
        AlignedVector<Block> blocks;
        std::vector<std::int32_t> rows; ///< of the contact table by lane; -1: idle
    };

    /// Discs that move together once their contacts are computed.
    struct Tile {
        std::size_t end_block;
        std::size_t end_group;
    };

    /// The contiguous discs of one thread.
    struct Strip {
        std::size_t first_disc = 0, end_disc = 0;
        Blocks inner;                           ///< contacts of its discs, by tiles
        Blocks boundary;                        ///< those with a second disc in a later strip
        std::vector<BaseContact> base_contacts; ///< with rigid surfaces
        std::vector<std::size_t> base_rows;     ///< of the table
        std::vector<NodeContact> node_contacts;
        std::vector<Tile> tiles;
        std::size_t look_ahead = 0; ///< discs between the one that moves and those fetched
        AlignedVector<std::uint32_t> gathers; ///< see pack_gathers
        /// Greatest component of a velocity, m/s, in even and in odd cycles: while one is written,
        /// others may still read the other.
        alignas(64) double fastest[2] = {0.0, 0.0};
        double furthest = 0.0; ///< greatest distance from a searched place, squared, m^2
    };

    struct Place {
        double x, y; ///< m
    };

    /// Over the neighbour lists, as State has it.
    struct Watch {
        double bound, speed;
        std::int64_t look_interval;
    };

    void divide_work(const State& state, int threads);
    std::size_t pack_blocks(const State& state, std::size_t row, Strip& strip);
    std::size_t pack_base_contacts(const State& state, std::size_t row, std::size_t slot,
                                   Strip& strip);
    std::size_t assign_slots(std::size_t slot, Strip& strip);
    void pack_gathers(const State& state);

    /// The cycle is compiled for contacts with and without bonds and friction, and chosen when
    /// contacts are packed: bonds never form within a cycle.
    template <bool bonded, bool frictional>
    void compute(Block& block, const double* discs, Slot* slots);
    template <bool bonded, bool frictional>
    void compute_blocks(Blocks& blocks, std::size_t begin, std::size_t end);
    template <bool bonded, bool frictional> void compute_boundary(Strip& strip);
    /// Discs are compiled with damping against each of the motions.
    template <bool bonded, bool frictional, DampedAgainst motion>
    double sweep(Strip& strip, Stretching thins);
    static Double4 numbers_of(const Inertia& inertia);
    struct Kernels {
        void (FastCycle::*compute_boundary)(Strip&);
        double (FastCycle::*sweep)(Strip&, Stretching);
        double (FastCycle::*sampling_sweep)(Strip&, Stretching); ///< at every averaging_interval
    };
    template <bool bonded, bool frictional> Kernels kernels_of() const;
    Kernels choose_kernels() const;
    void compute_base(Strip& strip, BaseMoment base);
    void compute_nodes(Strip& strip, const BaseNodeColumns& nodes, BaseMoment base);
    double move_base(State& state, const BaseNodeColumns& nodes, const Clock& clock,
                     BaseResponse* response);
    double furthest(const Strip& strip) const;

    static constexpr std::size_t tile_discs = 128; ///< a tile's records and slots fit the cache
    static constexpr std::size_t group_discs = 4;  ///< discs that gather together
    /// Discs and slots are addressed by their first number: the processor scales by 8, not by more.
    static constexpr std::size_t disc_numbers = sizeof(Disc) / 8, slot_numbers = sizeof(Slot) / 8;
    static constexpr float not_bonded = -std::numeric_limits<float>::infinity();

    const RigidBase& base_;
    CyclePhysics physics_;
    double time_step_;
    std::size_t disc_count_;
    AlignedVector<Disc> discs_;
    AlignedVector<Inertia> inertia_;
    std::vector<Place> searched_places_;
    AlignedVector<Slot> slots_;
    std::vector<Strip> strips_;
    bool bonded_ = false, frictional_ = false; ///< whether any contact is
    bool deforms_ = false;                     ///< whether the base has nodes
    double fastest_node_[2] = {0.0, 0.0};      ///< as Strip::fastest

    std::vector<std::uint32_t> slot_of_, base_slot_of_; ///< by row of the contact tables
};

} // namespace listric::dem
