#pragma once

#include "dem/ranks/ranks.hpp"
#include "dem/ranks/share.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

class BaseResponse;
struct RigidBase;

/// What the cycles of a share tell and ask the other ranks. Called by one thread.
class Links {
public:
    /// The share must outlive it. Made by all ranks.
    Links(Ranks& ranks, Share& share);

    /// Updates the share's lists; it may have more ghosts then. False if a disc has run away, or
    /// the base: the root looks into it.
    bool update_lists(const RigidBase& base);

    /// By row of the share's discs: whether the disc is the rank's own.
    std::span<const std::uint8_t> own() const { return share_.own; }

    /// Rows of own discs that are ghosts elsewhere, rank after rank.
    std::span<const std::int32_t> sent() const { return sent_; }

    /// Sends what they are now.
    /// @param read  of a row, writes ghost_numbers numbers
    template <class Read> void send_ghosts(Read&& read) {
        for (std::size_t k = 0; k < sent_.size(); ++k)
            read(static_cast<std::size_t>(sent_[k]), to_.data() + ghost_numbers * k);
        ranks_.begin_exchange(to_, from_);
    }
    /// Takes what the others have sent since.
    /// @param write  to a row, from ghost_numbers numbers
    template <class Write> void receive_ghosts(Write&& write) {
        ranks_.end_exchange();
        for (std::size_t k = 0; k < received_.size(); ++k)
            write(static_cast<std::size_t>(received_[k]), from_.data() + ghost_numbers * k);
    }

    /// See dem::greatest().
    double greatest(double number) { return dem::greatest(ranks_, number); }

    /// Greatest speeds of cycles that the others have not been told of, m/s.
    std::vector<double> speeds;
    /// Makes them the greatest of all ranks.
    void share_speeds();

    int response_interval = 0; ///< cycles between responses of the base; 0: it does not respond
    /// Sums the loads on the base's nodes over the ranks and lets the root's base respond; all get
    /// the nodes' velocities.
    /// @param response  null but on the root
    void respond(State& state, const Clock& clock, BaseResponse* response);

private:
    void connect();

    Ranks& ranks_;
    Share& share_;
    std::vector<std::int32_t> sent_, received_; ///< rows, rank after rank
    std::vector<double> to_, from_;
};

/// Lets a base that deforms answer at the end of a cycle where its time has come, of a whole state
/// or, with links, of all shares.
void respond_if_due(State& state, const Clock& clock, BaseResponse* response, Links* links);

} // namespace listric::dem
