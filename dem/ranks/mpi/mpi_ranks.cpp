#include "dem/ranks/mpi/require.hpp"
#include "dem/ranks/ranks.hpp"

#include <mpi.h>
#include <petscsys.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace listric::dem {

namespace {

void require_petsc(PetscErrorCode error, const char* what) {
    if (error != 0)
        throw std::runtime_error(std::string(what) + ": PETSc error " + std::to_string(error));
}

int as_int(std::size_t size) {
    if (size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw std::runtime_error("a message of more than 2 GB");
    return static_cast<int>(size);
}

/// Messages between this rank and others that are on their way; empty ones are none.
class Messages {
public:
    Messages() = default;
    Messages(MPI_Comm all, int tag) : all_(all), tag_(tag) {}

    template <class T> void receive(std::span<T> to, MPI_Datatype type, std::size_t rank) {
        if (!to.empty())
            require(MPI_Irecv(to.data(), as_int(to.size()), type, static_cast<int>(rank), tag_,
                              all_, &under_way_.emplace_back()),
                    "MPI_Irecv");
    }
    template <class T> void send(std::span<const T> from, MPI_Datatype type, std::size_t rank) {
        if (!from.empty())
            require(MPI_Isend(from.data(), as_int(from.size()), type, static_cast<int>(rank), tag_,
                              all_, &under_way_.emplace_back()),
                    "MPI_Isend");
    }
    void wait() {
        require(MPI_Waitall(static_cast<int>(under_way_.size()), under_way_.data(),
                            MPI_STATUSES_IGNORE),
                "MPI_Waitall");
        under_way_.clear();
    }

private:
    MPI_Comm all_ = MPI_COMM_NULL;
    int tag_ = 0;
    std::vector<MPI_Request> under_way_;
};

class MpiRanks : public Ranks {
public:
    MpiRanks() {
        // PETSc starts MPI: the root's elastic base may need both. Signals are the program's.
        require_petsc(PetscInitializeNoArguments(), "PetscInitialize");
        require_petsc(PetscPopSignalHandler(), "PetscPopSignalHandler");
        require(MPI_Comm_dup(MPI_COMM_WORLD, &all_), "MPI_Comm_dup");
        MPI_Comm_size(all_, &count_);
        MPI_Comm_rank(all_, &mine_);
        messages_ = Messages(all_, exchanged);
    }
    ~MpiRanks() override {
        MPI_Comm_free(&all_);
        PetscFinalize();
    }
    MpiRanks(const MpiRanks&) = delete;
    MpiRanks& operator=(const MpiRanks&) = delete;

    int count() const override { return count_; }
    int mine() const override { return mine_; }

    void connect(std::span<const std::size_t> sent,
                 std::span<const std::size_t> received) override {
        sent_.assign(sent.begin(), sent.end());
        received_.assign(received.begin(), received.end());
    }

    // Messages of MPI's own: PetscSF's take longer (docs/guides/scaling.md).
    void begin_exchange(std::span<const double> sent, std::span<double> received) override {
        each_part(received, received_, [&](std::span<double> part, std::size_t rank) {
            messages_.receive(part, MPI_DOUBLE, rank);
        });
        each_part(sent, sent_, [&](std::span<const double> part, std::size_t rank) {
            messages_.send(part, MPI_DOUBLE, rank);
        });
    }
    void end_exchange() override { messages_.wait(); }

    void greatest(std::span<std::uint64_t> numbers) override {
        require(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), as_int(numbers.size()), MPI_UINT64_T,
                              MPI_MAX, all_),
                "MPI_Allreduce");
    }
    void sum(std::span<std::int64_t> numbers) override {
        require(MPI_Allreduce(MPI_IN_PLACE, numbers.data(), as_int(numbers.size()), MPI_INT64_T,
                              MPI_SUM, all_),
                "MPI_Allreduce");
    }
    void broadcast(Bytes& bytes) override {
        std::uint64_t size = bytes.size();
        require(MPI_Bcast(&size, 1, MPI_UINT64_T, 0, all_), "MPI_Bcast");
        bytes.resize(size);
        require(MPI_Bcast(bytes.data(), as_int(size), MPI_BYTE, 0, all_), "MPI_Bcast");
    }

    std::vector<Bytes> all_to_all(std::vector<Bytes> sent) override {
        const auto ranks = static_cast<std::size_t>(count_);
        std::vector<std::uint64_t> there, here(ranks);
        for (const Bytes& message : sent)
            there.push_back(message.size());
        require(MPI_Alltoall(there.data(), 1, MPI_UINT64_T, here.data(), 1, MPI_UINT64_T, all_),
                "MPI_Alltoall");
        std::vector<Bytes> received(ranks);
        Messages messages(all_, all_exchanged);
        for (std::size_t rank = 0; rank < ranks; ++rank) {
            received[rank].resize(here[rank]);
            messages.receive(std::span(received[rank]), MPI_BYTE, rank);
        }
        for (std::size_t rank = 0; rank < ranks; ++rank)
            messages.send(std::span<const std::byte>(sent[rank]), MPI_BYTE, rank);
        messages.wait();
        return received;
    }
    void gather(Bytes message, const Take& take) override {
        if (mine_ != 0)
            return send(message, 0, gathered);
        take(0, message);
        for (int rank = 1; rank < count_; ++rank)
            take(rank, receive(rank, gathered));
    }
    Bytes scatter(const Make& make) override {
        if (mine_ != 0)
            return receive(0, scattered);
        for (int rank = 1; rank < count_; ++rank)
            send(make(rank), rank, scattered);
        return make(0);
    }

    void abort(int exit_code) override { MPI_Abort(MPI_COMM_WORLD, exit_code); }

private:
    static constexpr std::size_t most_at_once = 1u << 30; // bytes
    static constexpr int gathered = 1, scattered = 2, all_exchanged = 3, exchanged = 4;

    /// Sends a message of any length: MPI 3 counts bytes by int.
    void send(const Bytes& message, int rank, int tag) const {
        const std::uint64_t size = message.size();
        require(MPI_Send(&size, 1, MPI_UINT64_T, rank, tag, all_), "MPI_Send");
        for (std::size_t at = 0; at < message.size(); at += most_at_once)
            require(MPI_Send(message.data() + at, piece(message, at), MPI_BYTE, rank, tag, all_),
                    "MPI_Send");
    }
    Bytes receive(int rank, int tag) const {
        std::uint64_t size = 0;
        require(MPI_Recv(&size, 1, MPI_UINT64_T, rank, tag, all_, MPI_STATUS_IGNORE), "MPI_Recv");
        Bytes bytes(size);
        for (std::size_t at = 0; at < bytes.size(); at += most_at_once)
            require(MPI_Recv(bytes.data() + at, piece(bytes, at), MPI_BYTE, rank, tag, all_,
                             MPI_STATUS_IGNORE),
                    "MPI_Recv");
        return bytes;
    }
    /// Calls `go` with the part of every other rank.
    template <class T, class Go>
    static void each_part(std::span<T> all, const std::vector<std::size_t>& sizes, Go&& go) {
        for (std::size_t rank = 0, at = 0; rank < sizes.size(); at += sizes[rank++])
            go(all.subspan(at, sizes[rank]), rank);
    }
    static int piece(const Bytes& bytes, std::size_t at) {
        return static_cast<int>(std::min(most_at_once, bytes.size() - at));
    }

    MPI_Comm all_ = MPI_COMM_NULL;
    int count_ = 1, mine_ = 0;
    std::vector<std::size_t> sent_, received_; ///< numbers to and from each rank, at an exchange
    Messages messages_;
};

} // namespace

} // namespace listric::dem

/// The processes that mpirun or srun has started. Starts MPI and PETSc, which end with what it
/// returns; the caller deletes it.
extern "C" __attribute__((visibility("default"))) listric::dem::Ranks* LISTRIC_RANKS_ENTRY();

listric::dem::Ranks* LISTRIC_RANKS_ENTRY() { return new listric::dem::MpiRanks(); }
