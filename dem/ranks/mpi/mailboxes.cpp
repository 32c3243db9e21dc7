#include "dem/ranks/mpi/mailboxes.hpp"

#include "dem/ranks/mpi/require.hpp"
#include "dem/threads/pause.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <sched.h>
#include <thread>

namespace listric::dem {

namespace {

/// What a place begins with: the number of the exchange that has filled it.
using Stamp = std::atomic_ref<std::uint64_t>;
static_assert(Stamp::is_always_lock_free, "processes share it");
constexpr std::size_t line = 64; // bytes that a processor moves at once

Stamp stamp_of(std::byte* place) { return Stamp(*reinterpret_cast<std::uint64_t*>(place)); }

/// Bytes of a place for so many numbers.
std::size_t size_of(std::size_t numbers) {
    return line + (numbers * sizeof(double) + line - 1) / line * line;
}

} // namespace

void Mailboxes::open(MPI_Comm all) {
    all_ = all;
    int count = 0, mine = 0, here = 0, mine_here = 0;
    MPI_Comm_size(all_, &count);
    MPI_Comm_rank(all_, &mine);
    const char* wanted = std::getenv("LISTRIC_MAILBOXES");
    int are_wanted = !wanted || std::strcmp(wanted, "0") != 0;
    require(MPI_Allreduce(MPI_IN_PLACE, &are_wanted, 1, MPI_INT, MPI_MIN, all_), "MPI_Allreduce");
    if (are_wanted)
        require(MPI_Comm_split_type(all_, MPI_COMM_TYPE_SHARED, mine, MPI_INFO_NULL, &here_),
                "MPI_Comm_split_type");
    else
        require(MPI_Comm_split(all_, mine, 0, &here_), "MPI_Comm_split");
    MPI_Comm_size(here_, &here);
    MPI_Comm_rank(here_, &mine_here);
    mine_here_ = static_cast<std::size_t>(mine_here);
    ranks_here_.resize(static_cast<std::size_t>(here));
    require(MPI_Allgather(&mine, 1, MPI_INT, ranks_here_.data(), 1, MPI_INT, here_),
            "MPI_Allgather");
    boxes_.resize(static_cast<std::size_t>(count));
    for (const int rank : ranks_here_)
        boxes_[static_cast<std::size_t>(rank)].is_here = rank != mine;
}

void Mailboxes::close() {
    give_room(0);
    MPI_Comm_free(&here_);
}

void Mailboxes::give_room(std::size_t bytes) {
    if (window_ != MPI_WIN_NULL) {
        MPI_Win_unlock_all(window_);
        MPI_Win_free(&window_);
    }
    room_ = bytes;
    boards_.clear();
    if (bytes == 0)
        return;
    void* mine = nullptr;
    require(MPI_Win_allocate_shared(static_cast<MPI_Aint>(bytes), 1, MPI_INFO_NULL, here_, &mine,
                                    &window_),
            "MPI_Win_allocate_shared");
    require(MPI_Win_lock_all(MPI_MODE_NOCHECK, window_), "MPI_Win_lock_all");
}

std::byte* Mailboxes::memory_of(std::size_t number_here) const {
    MPI_Aint size = 0;
    int unit = 0;
    void* memory = nullptr;
    require(MPI_Win_shared_query(window_, static_cast<int>(number_here), &size, &unit, &memory),
            "MPI_Win_shared_query");
    return static_cast<std::byte*>(memory);
}

void Mailboxes::connect(std::span<const std::size_t> sent, std::span<const std::size_t> received) {
    const bool all_are_here = ranks_here_.size() > 1 && ranks_here_.size() == boxes_.size();
    std::vector<std::uint64_t> offsets(ranks_here_.size()), offsets_there(ranks_here_.size());
    std::uint64_t room = all_are_here ? 2 * size_of(most_shown) : 0;
    for (std::size_t k = 0; k < ranks_here_.size(); ++k) {
        const auto rank = static_cast<std::size_t>(ranks_here_[k]);
        Box& box = boxes_[rank];
        box.to_size = size_of(sent[rank]);
        box.from_size = size_of(received[rank]);
        offsets[k] = room;
        if (box.is_here && sent[rank] + received[rank] > 0)
            room += 2 * box.from_size;
    }
    require(MPI_Allreduce(MPI_IN_PLACE, &room, 1, MPI_UINT64_T, MPI_MAX, here_), "MPI_Allreduce");
    if (room == 0)
        return;
    const bool is_larger = room > room_;
    if (is_larger)
        give_room(room + room / 2);
    std::byte* const mine = memory_of(mine_here_);
    const auto clear = [&](std::size_t offset, std::size_t size) { // before anybody knows of it
        stamp_of(mine + offset).store(0);
        stamp_of(mine + offset + size).store(0);
    };
    if (all_are_here && is_larger)
        clear(0, size_of(most_shown));
    for (std::size_t k = 0; k < ranks_here_.size(); ++k) {
        const auto rank = static_cast<std::size_t>(ranks_here_[k]);
        Box& box = boxes_[rank];
        if (!box.is_here || sent[rank] + received[rank] == 0)
            continue;
        box.from = mine + offsets[k];
        clear(offsets[k], box.from_size);
    }
    require(
        MPI_Alltoall(offsets.data(), 1, MPI_UINT64_T, offsets_there.data(), 1, MPI_UINT64_T, here_),
        "MPI_Alltoall");
    boards_.clear();
    for (std::size_t k = 0; k < ranks_here_.size(); ++k) {
        std::byte* const memory = memory_of(k);
        boxes_[static_cast<std::size_t>(ranks_here_[k])].to = memory + offsets_there[k];
        if (all_are_here)
            boards_.push_back(memory);
    }
}

void Mailboxes::await(std::byte* place, std::uint64_t stamp) const {
    // Pauses, some 20 us, before others may have the core; then some 0.2 ms of offering it, after
    // which the rank that is waited for has none: sleepers do not keep it from one.
    constexpr int awake = 1000, offers = 200;
    for (int waited = 0; stamp_of(place).load(std::memory_order_acquire) != stamp; ++waited) {
        pause();
        if (waited < awake)
            continue;
        int any = 0; // what MPI has under way goes on meanwhile
        MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, all_, &any, MPI_STATUS_IGNORE);
        if (waited < awake + offers)
            sched_yield();
        else
            std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
}

void Mailboxes::put(std::span<const double> numbers, std::size_t rank) const {
    const Box& box = boxes_[rank];
    std::byte* place = box.to + exchange_ % 2 * box.to_size;
    std::memcpy(place + line, numbers.data(), numbers.size_bytes());
    stamp_of(place).store(exchange_, std::memory_order_release);
}

void Mailboxes::take(std::span<double> numbers, std::size_t rank) const {
    const Box& box = boxes_[rank];
    std::byte* place = box.from + exchange_ % 2 * box.from_size;
    await(place, exchange_);
    std::memcpy(numbers.data(), place + line, numbers.size_bytes());
}

void Mailboxes::greatest(std::span<std::uint64_t> numbers) {
    ++look_;
    const std::size_t place = look_ % 2 * size_of(most_shown);
    std::memcpy(boards_[mine_here_] + place + line, numbers.data(), numbers.size_bytes());
    stamp_of(boards_[mine_here_] + place).store(look_, std::memory_order_release);
    std::array<std::uint64_t, most_shown> theirs;
    for (std::byte* const board : boards_) {
        await(board + place, look_);
        std::memcpy(theirs.data(), board + place + line, numbers.size_bytes());
        for (std::size_t k = 0; k < numbers.size(); ++k)
            numbers[k] = std::max(numbers[k], theirs[k]);
    }
}

} // namespace listric::dem
