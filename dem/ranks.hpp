#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

using Bytes = std::vector<std::byte>;

/// Processes ("ranks") that make a simulation's cycles together, each those of a share. Every call
/// but count() and mine() is made by all ranks, in the same order.
class Ranks {
public:
    virtual ~Ranks() = default;

    virtual int count() const = 0;
    virtual int mine() const = 0; ///< 0: the root, which has the whole state

    /// Says how many numbers go to and come from each rank at every exchange from now on.
    virtual void connect(std::span<const std::size_t> sent,
                         std::span<const std::size_t> received) = 0;
    /// Numbers for rank 0, then for rank 1 and so on; as they come from them.
    virtual void exchange(std::span<const double> sent, std::span<double> received) = 0;

    virtual void greatest(std::span<std::uint64_t> numbers) = 0; ///< of all ranks, one by one
    virtual void sum(std::span<std::int64_t> numbers) = 0;       ///< over all ranks, one by one
    virtual void broadcast(Bytes& bytes) = 0;                    ///< from the root, of any length

    virtual std::vector<Bytes> gather(Bytes bytes) = 0;  ///< on the root all ranks', else nothing
    virtual Bytes scatter(std::vector<Bytes> bytes) = 0; ///< from the root, one for each rank
};

} // namespace listric::dem
