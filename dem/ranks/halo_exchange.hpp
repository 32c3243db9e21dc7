#pragma once

#include "dem/cycle/surroundings.hpp"
#include "dem/ranks/ranks.hpp"
#include "dem/ranks/subdomain.hpp"

#include <span>

namespace listric::dem {

/// Surroundings of a subdomain: the subdomains of the other ranks.
class HaloExchange final : public Surroundings {
public:
    /// The subdomain must outlive it. Made by all ranks.
    HaloExchange(Ranks& ranks, Subdomain& subdomain);

    double after_cycle(State& state, double) override;
    Halo* halo() override { return &halo_; }
    void begin_exchange() override { ranks_.begin_exchange(halo_.to, halo_.from); }
    void end_exchange() override { ranks_.end_exchange(); }
    void agree_on(std::span<double> numbers) override;

    /// There may be more ghosts then. All know if a disc has run away, or the base: the root looks
    /// into it.
    ListUpdate update_lists(State& state, const RigidBase& base) override;

    /// Sums the loads on the base's nodes over the ranks and lets the root's base respond; all get
    /// the nodes' velocities.
    /// @param response  null but on the root
    void respond(State& state, const Clock& clock, BaseResponse* response) override;

    int response_interval = 0; ///< cycles between responses of the base; 0: it does not respond

private:
    void connect();

    Ranks& ranks_;
    Subdomain& subdomain_;
    Halo halo_; ///< rank after rank
};

} // namespace listric::dem
