#pragma once

#include "dem/ranks/ranks.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

// A state in subdomains, one for each process ("rank"), that come to the same bits as the whole:
// forces on a disc are added in the order of rows, so a subdomain keeps that order; a contact of
// two subdomains is computed by both from equal numbers.

/// Part of the state that one rank needs for cycles: its own discs, and ghosts, copies of those
/// that they have contacts with, in the order of the whole's rows; and all contacts of its own
/// discs.
struct Subdomain {
    State state;
    std::vector<std::int32_t> rows; ///< in the whole, by row of the subdomain's discs
    std::vector<std::uint8_t> own;  ///< by row of the subdomain's discs

    /// Discs renewed after every cycle, by the other rank: own discs that are ghosts there, and
    /// ghosts that are its own, as rows of the subdomain in the order of the whole.
    std::vector<std::vector<std::int32_t>> sent, received;
};

/// The rank of every disc, by row: rows in succession, about equal work for each.
std::vector<std::int32_t> ranks_by_rows(const State& state, int count);

/// A state that is cut into subdomains, which are made one after the other: together they take as
/// much memory as the whole.
class Cut {
public:
    /// The state must outlive it.
    /// @param rank  of every disc, by row; any at all below `count`
    Cut(const State& whole, std::vector<std::int32_t> rank, int count);

    Subdomain subdomain(int rank);

    /// Rows of a rank's own discs.
    std::span<const std::int32_t> own(int rank) const {
        return lists_[static_cast<std::size_t>(rank)].own;
    }

private:
    /// Rows of the whole that go into one subdomain.
    struct Lists {
        std::vector<std::int32_t> own, ghosts, contacts, base_contacts;
    };
    Lists& lists_of(std::size_t disc);

    const State& whole_;
    std::vector<std::int32_t> rank_;
    std::vector<Lists> lists_;        ///< by rank
    std::vector<std::int32_t> local_; ///< by row of the whole, that in the subdomain made last
};

/// Changes of own discs by cycles; contacts whose first disc is own, and those with the
/// base; and what all ranks know alike: its numbers and the nodes of the base.
Bytes changes(const Subdomain& subdomain);

/// Puts them into the whole, those of rank 0 first: contacts are added one after the other, and
/// loads on the nodes of the base.
/// @param own  rows of the rank's discs in the whole
void put_back(const Bytes& changes, int rank, std::span<const std::int32_t> own, State& whole);

/// Contacts of all ranks, once they have been put back.
void sort_contacts(State& whole);

/// A subdomain as bytes, and back.
Bytes packed(const Subdomain& subdomain);
Subdomain unpacked(const Bytes& bytes);

} // namespace listric::dem
