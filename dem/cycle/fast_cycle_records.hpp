#pragma once

#include "dem/base/contact.hpp"
#include "dem/cycle/aligned_vector.hpp"
#include "dem/law.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

// Packed state of the fast cycle: plain numbers, which all its levels read alike.

namespace listric::dem::fast {

struct alignas(64) Disc {
    double place[4];    ///< x, y, rotation, radius
    double velocity[4]; ///< vx, vy, spin, rate of the radius
};

/// Data of a disc's motion beside the forces. The means are sampled rarely.
struct alignas(32) Inertia {
    double per_mass;        ///< time step over inertial mass, s/kg
    double weight;          ///< N
    double per_moment;      ///< time step over moment of inertia, s/(kg m^2)
    float mean_velocity[2]; ///< m/s
};

/// Force on the second disc; moments on the first (negative) and the second.
struct alignas(32) Slot {
    double numbers[4];
};

/// Eight contacts, a lane each.
struct alignas(64) Block {
    double shear_force[8];
    float tensile_strength[8]; ///< minus infinity: not bonded
    float shear_strength[8];
    float normal_stiffness[8], shear_stiffness_times_step[8], friction[8];
    std::uint32_t first[8], second[8]; ///< discs, as their places among the numbers of all
    std::uint32_t slot;                ///< of the first contact; the others follow
};

/// Memory of the contacts of a block that resist rolling.
struct alignas(32) Rolling {
    double moment[8];  ///< N m
    float friction[8]; ///< mu_r
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
    AlignedVector<Rolling> rolling; ///< of each block; empty where nothing resists it
    std::vector<std::int32_t> rows; ///< of the contact table by lane; -1: idle
};

/// Discs that move together once their contacts are computed.
struct Tile {
    std::size_t end_block;
    std::size_t end_group;
};

/// Contiguous discs that one thread computes.
struct Strip {
    std::size_t first_disc = 0, end_disc = 0;
    std::size_t first_row = 0, end_row = 0;           ///< of its contacts in the table
    std::size_t first_base_row = 0, end_base_row = 0; ///< of its base contacts
    std::size_t first_slot = 0, ring = 0; ///< slots of inner blocks; boundary's and base's follow
    std::size_t first_push_slot = 0;      ///< and those of pushed discs
    bool bonded = false, frictional = false; ///< whether any contact is
    bool sends = false;                      ///< whether a disc of it is a ghost of another rank
    bool has_ghosts = false;                 ///< whether a disc of it is another rank's
    Blocks inner;                            ///< contacts of its discs, by tiles
    Blocks boundary;                         ///< those with a second disc in a later strip
    std::vector<BaseContact> base_contacts;  ///< with rigid surfaces
    std::vector<std::size_t> base_rows;      ///< of the table
    std::vector<NodeContact> node_contacts;
    /// Moments against rolling of the two, N m; empty where nothing resists it.
    std::vector<double> base_rolling, node_rolling;
    std::vector<Tile> tiles;
    std::size_t look_ahead = 0;           ///< discs between the one that moves and those fetched
    AlignedVector<std::uint32_t> gathers; ///< see FastCycle::pack_gathers
    double furthest = 0.0;                ///< greatest distance from a searched place, squared, m^2

    std::size_t disc_count() const { return end_disc - first_disc; }
};

inline constexpr std::size_t tile_discs = 128; ///< a tile's records and slots fit the cache
inline constexpr std::size_t group_discs = 4;  ///< discs that gather together
/// Slots that a group gathers at least, a disc and a direction. Most need no more, so that the
/// processor seldom guesses a loop's end wrongly: 7 % of a faulted basin's time.
inline constexpr std::uint32_t usual_slots = 4;
/// Discs and slots are addressed by their first number: the processor scales by 8, not by more.
inline constexpr std::size_t disc_numbers = sizeof(Disc) / 8, slot_numbers = sizeof(Slot) / 8;
inline constexpr float not_bonded = -std::numeric_limits<float>::infinity();

/// Where the slot of a lane lies among a block's eight: that of lane k + 4 follows that of lane k,
/// as they share a register where eight lanes are one.
inline constexpr std::size_t stored_row(std::size_t lane) { return 2 * (lane % 4) + lane / 4; }

} // namespace listric::dem::fast
