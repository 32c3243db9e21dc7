#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace listric::dem {

using Bytes = std::vector<std::byte>;

/// Processes ("ranks") that make a simulation's cycles together, each those of a subdomain. Every
/// call but count() and mine() is made by all ranks, in the same order.
class Ranks {
public:
    virtual ~Ranks() = default;

    virtual int count() const = 0;
    virtual int mine() const = 0; ///< 0: the root, which has the whole state

    /// Says how many numbers go to and come from each rank at every exchange from now on.
    virtual void connect(std::span<const std::size_t> sent,
                         std::span<const std::size_t> received) = 0;
    /// Numbers for rank 0, then for rank 1 and so on; as they come from them. They are on their way
    /// until the exchange has ended, and not to be touched.
    virtual void begin_exchange(std::span<const double> sent, std::span<double> received) = 0;
    virtual void end_exchange() = 0;

    virtual void greatest(std::span<std::uint64_t> numbers) = 0; ///< of all ranks, one by one
    virtual void sum(std::span<std::int64_t> numbers) = 0;       ///< over all ranks, one by one
    virtual void broadcast(Bytes& bytes) = 0;                    ///< from the root, of any length

    /// A message of any length for each rank; returns those of the others for this one.
    virtual std::vector<Bytes> all_to_all(std::vector<Bytes> messages) = 0;
    /// To the root from all ranks, in their order, one message after the other.
    using Take = std::function<void(int rank, const Bytes& message)>;
    virtual void gather(Bytes message, const Take& take) = 0;
    /// From the root to all ranks, one message after the other; returns that for this rank.
    using Make = std::function<Bytes(int rank)>;
    virtual Bytes scatter(const Make& make) = 0;

    /// Ends the processes of all ranks. The only call that one rank makes alone.
    virtual void abort(int exit_code) = 0;
};

/// The greatest of all ranks' numbers, none of which is negative; NaN is greater than all.
inline double greatest(Ranks& ranks, double number) {
    auto bits = std::bit_cast<std::uint64_t>(number); // in the order of numbers, NaN last
    ranks.greatest({&bits, 1});
    return std::bit_cast<double>(bits);
}

} // namespace listric::dem
