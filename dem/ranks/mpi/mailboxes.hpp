#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

/// Numbers that ranks of one machine put into each other's memory, one exchange after the other:
/// MPI's own messages take a microsecond more, which is a hundredth of a cycle of 10,000 discs.
class Mailboxes {
public:
    Mailboxes() = default;
    Mailboxes(const Mailboxes&) = delete;
    Mailboxes& operator=(const Mailboxes&) = delete;

    /// Finds the ranks on this machine; none if one has LISTRIC_MAILBOXES=0 in its environment.
    /// Called by all ranks, as connect() and close() are.
    void open(MPI_Comm all);
    void close(); ///< before MPI ends

    /// By rank of all, how many numbers go there and come from there from now on.
    void connect(std::span<const std::size_t> sent, std::span<const std::size_t> received);

    /// Whether a rank is another on this machine.
    bool reaches(std::size_t rank) const { return rank < boxes_.size() && boxes_[rank].is_here; }

    void begin_exchange() { ++exchange_; }
    void put(std::span<const double> numbers, std::size_t rank) const;
    /// Waits for them.
    void take(std::span<double> numbers, std::size_t rank) const;

    /// Whether all ranks can look at so many numbers of each other.
    bool show(std::size_t numbers) const { return !boards_.empty() && numbers <= most_shown; }
    /// One by one, those of all ranks.
    void greatest(std::span<std::uint64_t> numbers);

private:
    /// Two places each, in turns: what is put into one has been taken before the other is used
    /// again, since every exchange goes both ways.
    struct Box {
        bool is_here = false;
        std::size_t to_size = 0, from_size = 0; ///< bytes of a place
        std::byte *to = nullptr, *from = nullptr;
    };
    void give_room(std::size_t bytes);
    std::byte* memory_of(std::size_t number_here) const;
    void await(std::byte* place, std::uint64_t stamp) const;

    static constexpr std::size_t most_shown = 16;
    MPI_Comm all_ = MPI_COMM_NULL, here_ = MPI_COMM_NULL;
    MPI_Win window_ = MPI_WIN_NULL;
    std::size_t room_ = 0;        ///< of a rank, bytes
    std::vector<int> ranks_here_; ///< by number on this machine, that of all
    std::vector<Box> boxes_;      ///< by rank of all
    /// What each rank shows the others, where all are here, by number on this machine; two places,
    /// in turns, at the start of its memory.
    std::vector<std::byte*> boards_;
    std::size_t mine_here_ = 0;
    std::uint64_t exchange_ = 0, look_ = 0;
};

} // namespace listric::dem
