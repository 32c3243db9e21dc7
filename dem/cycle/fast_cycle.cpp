#include "dem/cycle/fast_cycle.hpp"

#include "dem/base/contact.hpp"
#include "dem/base/rest.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/cycle/surroundings.hpp"
#include "dem/law.hpp"
#include "dem/numbers/order_free.hpp"
#include "dem/threads/shared_loop.hpp"
#include "dem/threads/team.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace listric::dem {

using namespace fast;

template <class Rolling> void FastCycle::compute_base(Strip& strip, const BaseInstant& now) {
    for (std::size_t k = 0; k < strip.base_contacts.size(); ++k) {
        BaseContact& contact = strip.base_contacts[k];
        Rolling moment{};
        if constexpr (rolls<Rolling>)
            moment = strip.base_rolling[k];
        const Disc& d = discs_[static_cast<std::size_t>(contact.disc)];
        const BaseContactForce f = base_contact_force(
            *contact.surface, now,
            {d.place[0], d.place[1], d.velocity[0], d.velocity[1], d.velocity[2], d.place[3]},
            contact.parameters, contact.shear_force, moment);
        if constexpr (rolls<Rolling>)
            strip.base_rolling[k] = moment;
        slots_[contact.slot] = Slot{f.x, f.y, 0.0, f.moment};
    }
}

template <class Rolling>
void FastCycle::compute_nodes(Strip& strip, const BaseNodeColumns& nodes, const BaseInstant& now) {
    for (std::size_t k = 0; k < strip.node_contacts.size(); ++k) {
        NodeContact& node_contact = strip.node_contacts[k];
        BaseContact& contact = node_contact.contact;
        Rolling moment{};
        if constexpr (rolls<Rolling>)
            moment = strip.node_rolling[k];
        const Disc& d = discs_[static_cast<std::size_t>(contact.disc)];
        node_contact.force = node_contact_force(
            *contact.surface, nodes, now,
            {d.place[0], d.place[1], d.velocity[0], d.velocity[1], d.velocity[2], d.place[3]},
            contact.parameters, contact.shear_force, node_contact.place, moment);
        if constexpr (rolls<Rolling>)
            strip.node_rolling[k] = moment;
        const BaseContactForce& f = node_contact.force.force;
        slots_[contact.slot] = Slot{f.x, f.y, 0.0, f.moment};
    }
}

/// As in the plain cycle: loads by row, which is the order of strips and of their contacts.
double FastCycle::move_base(State& state, const BaseNodeColumns& nodes, const Clock& clock,
                            BaseResponse* response, Surroundings& around) {
    for (const Strip& strip : strips_)
        for (const NodeContact& c : strip.node_contacts)
            add_load(nodes, c.force, c.contact.surface->degree);
    around.respond(state, clock, response);
    return move_nodes(nodes, clock.time_step);
}

DampedAgainst FastCycle::damped_against() const {
    if (physics_.averaging_time > 0.0)
        return DampedAgainst::mean_motion;
    return stretching(*base_, 0.0, 1.0).rate > 0.0 ? DampedAgainst::stretching
                                                   : DampedAgainst::rest;
}

/// Square of the greatest distance of the strip's discs from their searched places, m^2.
double FastCycle::furthest(const Strip& strip) const {
    double greatest = 0.0;
    for (std::size_t i = strip.first_disc; i < strip.end_disc; ++i) {
        const double dx = discs_[i].place[0] - searched_places_[i].x;
        const double dy = discs_[i].place[1] - searched_places_[i].y;
        greatest = greater(greatest, dx * dx + dy * dy);
    }
    return greatest;
}

/// By what furthest() has found in the strips, m.
double FastCycle::greatest_displacement(const State& state, double extension) const {
    double square = 0.0;
    for (const Strip& strip : strips_)
        square = greater(square, strip.furthest);
    return greater(std::sqrt(square), surface_travel(state, *base_, extension));
}

void FastCycle::mark_ghosts(const Halo* halo) {
    own_.clear();
    for (Strip& strip : strips_)
        strip.sends = strip.has_ghosts = false;
    if (!halo)
        return;
    own_.assign(inertia_.size(), -1);
    std::fill(own_.begin() + static_cast<std::ptrdiff_t>(disc_count_), own_.end(), 0);
    for (const std::int32_t row : halo->received)
        own_[static_cast<std::size_t>(row)] = 0;
    for (Strip& strip : strips_) {
        const auto has_any_of = [&](std::span<const std::int32_t> rows) {
            return std::ranges::any_of(rows, [&](std::int32_t row) {
                const auto disc = static_cast<std::size_t>(row);
                return disc >= strip.first_disc && disc < strip.end_disc;
            });
        };
        strip.sends = has_any_of(halo->sent);
        strip.has_ghosts = has_any_of(halo->received);
    }
}

void FastCycle::fill(Halo& halo) const {
    double* to = halo.to.data();
    for (const std::int32_t row : halo.sent) {
        const Disc& disc = discs_[static_cast<std::size_t>(row)];
        to = std::copy_n(disc.place, 2, to);
        to = std::copy_n(disc.velocity, 3, to);
    }
}

void FastCycle::take_ghosts(const Halo& halo) {
    const double* from = halo.from.data();
    for (const std::int32_t row : halo.received) {
        Disc& disc = discs_[static_cast<std::size_t>(row)];
        std::copy_n(from, 2, disc.place);
        std::copy_n(from + 2, 3, disc.velocity);
        from += Halo::numbers;
    }
}

/// Lets the team's size follow what it does, in disc-steps. With others all must do alike: it
/// stays.
std::int64_t FastCycle::run(State& state, std::int64_t cycles, BestTeam& team,
                            BaseResponse* response, Surroundings& around) {
    mark_ghosts(around.halo());
    std::int64_t done = 0;
    for (bool holds = true; holds && done < cycles;) {
        std::int64_t piece = cycles - done;
        if (team.most() > 1 && !around.halo())
            piece = std::min(piece, 1 + static_cast<std::int64_t>(
                                            team.piece() / static_cast<double>(disc_count_ + 1)));
        const std::int64_t ran = run_piece(state, piece, team, response, around);
        holds = ran == piece;
        done += ran;
    }
    return done;
}

void FastCycle::Watch::enter(double fastest, double time_step) {
    speed = greater(speed, fastest);
    bound += std::numbers::sqrt2 * fastest * time_step;
}

struct FastCycle::Piece {
    State& state;
    BaseResponse* response;
    Surroundings& around;
    Halo* halo; ///< null: there are no others
    Kernels kernels, kernels_with_ghosts;
    Shared shared;
    BaseNodeColumns nodes;
    double surface_translation; ///< see greatest_translation()
    Clock clock;                ///< at the start
    Watch watch;                ///< at the start
    int threads;
    Barrier barrier;
    Claims claims;
    struct alignas(64) Fastest {
        double in[2]; ///< a cycle, by its parity: one is read while the next is written
    };
    std::vector<Fastest> fastest; ///< of what each thread has moved, m/s
};

/// Keeps clock and watch for itself; all come to the same decisions.
class FastCycle::Worker {
public:
    Worker(FastCycle& fast, Piece& piece, int thread)
        : fast_(fast), piece_(piece), thread_(thread), clock_(piece.clock), watch_(piece.watch) {}

    void run(std::int64_t cycles) {
        for (std::int64_t n = 0; n < cycles; ++n) {
            if (clock_.cycle % watch_.check_interval == 0 && !check_lists())
                break;
            cycle();
        }
        if (piece_.halo)
            enter_speeds();
        piece_.barrier.wait(); // until all have read the state
        if (thread_ != 0)
            return;
        State& state = piece_.state;
        state.clock = clock_;
        state.displacement_bound = watch_.bound;
        state.window_speed = watch_.speed;
        state.check_interval = watch_.check_interval;
    }

private:
    template <class Work> void for_free_strips(Work&& work) {
        piece_.claims.take(thread_, ++phase_, [&](std::size_t k) { work(fast_.strips_[k]); });
    }

    /// Whether the neighbour lists are good for the cycles up to the next check; else they must be
    /// updated.
    bool check_lists() {
        const State& state = piece_.state;
        if (piece_.halo)
            enter_speeds();
        if (is_measurement_due(watch_.bound, state.skin)) {
            for_free_strips([&](Strip& strip) { strip.furthest = fast_.furthest(strip); });
            piece_.barrier.wait();
            if (thread_ == 0) {
                fast_.displacement_ = fast_.greatest_displacement(state, clock_.extension.m);
                piece_.around.agree_on({&fast_.displacement_, 1});
            }
            piece_.barrier.wait();
            watch_.bound = fast_.displacement_;
            if (is_update_due(watch_.bound, state.skin))
                return false;
        }
        watch_.check_interval =
            next_check_interval(watch_.check_interval, watch_.speed, clock_.time_step, state.skin);
        watch_.speed = 0.0;
        return true;
    }

    void cycle() {
        const MotionInstant motion = fast_.base_->motion.at(clock_.time(), clock_.travel);
        const BaseInstant now = base_instant(motion, clock_.extension.m);
        for_free_strips([&](Strip& strip) {
            if (fast_.deforms_)
                fast_.rolls_ ? fast_.compute_nodes<double>(strip, piece_.nodes, now)
                             : fast_.compute_nodes<FreeRolling>(strip, piece_.nodes, now);
            piece_.kernels.compute_boundary(piece_.shared, strip);
        });
        piece_.barrier.wait();
        const auto parity = static_cast<std::size_t>(clock_.cycle % 2);
        // No disc looks at the nodes between the two barriers.
        if (fast_.deforms_ && thread_ == 0)
            fast_.fastest_node_[parity] =
                fast_.move_base(piece_.state, piece_.nodes, clock_, piece_.response, piece_.around);
        const Stretching thins = stretching(*fast_.base_, clock_.extension.m, motion.speed);
        const auto sweep = stops(fast_.base_->motion, clock_.travel) ? &Kernels::resting_sweep
                           : clock_.cycle % averaging_interval == 0  ? &Kernels::sampling_sweep
                                                                     : &Kernels::sweep;
        double& mine = piece_.fastest[static_cast<std::size_t>(thread_)].in[parity];
        mine = 0.0;
        const auto sweep_strips = [&](bool that_send) {
            for_free_strips([&](Strip& strip) {
                if (strip.sends != that_send)
                    return;
                fast_.rolls_ ? fast_.compute_base<double>(strip, now)
                             : fast_.compute_base<FreeRolling>(strip, now);
                const Kernels& kernels =
                    strip.has_ghosts ? piece_.kernels_with_ghosts : piece_.kernels;
                mine = greater(mine, (kernels.*sweep)(piece_.shared, strip, thins));
            });
        };
        if (piece_.halo) { // ghosts travel while the other strips are swept
            sweep_strips(true);
            piece_.barrier.wait();
            if (thread_ == 0) {
                fast_.fill(*piece_.halo);
                piece_.around.begin_exchange();
            }
        }
        sweep_strips(false);
        piece_.barrier.wait();
        double fastest = greater(piece_.surface_translation * std::abs(motion.speed),
                                 fast_.fastest_node_[parity]);
        for (const Piece::Fastest& all : piece_.fastest)
            fastest = greater(fastest, all.in[parity]);
        if (piece_.halo)
            exchange(fastest);
        else
            watch_.enter(fastest, clock_.time_step);
        clock_.travel.m += motion.travel_speed * clock_.time_step;
        clock_.extension = fast_.base_->motion.position(clock_.travel);
        ++clock_.cycle;
    }

    void exchange(double fastest) {
        if (thread_ == 0) {
            fast_.speeds_.push_back(fastest);
            piece_.around.end_exchange();
            fast_.take_ghosts(*piece_.halo);
        }
        piece_.barrier.wait();
    }

    /// Enters the speeds of the cycles since the last check, the greatest that all have.
    void enter_speeds() {
        std::vector<double>& speeds = fast_.speeds_;
        if (thread_ == 0)
            piece_.around.agree_on(speeds);
        piece_.barrier.wait();
        for (const double fastest : speeds)
            watch_.enter(fastest, clock_.time_step);
        piece_.barrier.wait();
        if (thread_ == 0)
            speeds.clear();
    }

    FastCycle& fast_;
    Piece& piece_;
    int thread_;
    std::uint32_t phase_ = 0;
    Clock clock_;
    Watch watch_;
};

std::int64_t FastCycle::run_piece(State& state, std::int64_t cycles, BestTeam& team,
                                  BaseResponse* response, Surroundings& around) {
    const auto begin = std::chrono::steady_clock::now();
    const int threads =
        threads_at_hand(std::min(static_cast<std::size_t>(team.size()), strips_.size()));
    Piece piece{.state = state,
                .response = response,
                .around = around,
                .halo = around.halo(),
                .kernels = choose_kernels(level_, law(), damped_against(), false),
                .kernels_with_ghosts = choose_kernels(level_, law(), damped_against(), true),
                .shared = {discs_, inertia_, slots_.data(), time_step_, physics_.damping,
                           averaging_interval * time_step_ / physics_.averaging_time,
                           own_.empty() ? nullptr : own_.data()},
                .nodes = base_node_columns(state),
                .surface_translation = greatest_translation(*base_),
                .clock = state.clock,
                .watch = {state.displacement_bound, state.window_speed, state.check_interval},
                .threads = threads,
                .barrier = Barrier(threads),
                .claims = Claims(strips_.size(), threads),
                .fastest = std::vector<Piece::Fastest>(static_cast<std::size_t>(threads))};
    run_team(threads, [&](int thread) { Worker(*this, piece, thread).run(cycles); });
    const std::int64_t done = state.clock.cycle - piece.clock.cycle;
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    team.report(static_cast<double>(done) * static_cast<double>(disc_count_), seconds.count(),
                piece.barrier.asleep());
    return done;
}

std::int64_t advance_fast(State& state, const RigidBase& base, const CyclePhysics& physics,
                          std::int64_t cycles, const Execution& execution, BaseResponse* response,
                          Surroundings& around) {
    Packed for_this_call;
    Packed& packed = *execution.keeping(for_this_call).packed;
    if (!packed.cycle_ || !packed.cycle_->is_for(base, execution)) {
        packed.cycle_ = std::make_shared<FastCycle>(execution.threads, execution.cycle);
        packed.holds_ = false;
    }
    if (packed.team_.most() != execution.threads)
        packed.team_ = BestTeam(execution.threads);
    FastCycle& fast = *packed.cycle_;
    if (!packed.holds_)
        fast.pack(state, base, physics, around.halo());
    else if (!packed.holds_discs_)
        fast.pack_discs(state);
    packed.holds_ = false; // until all has gone well
    packed.holds_discs_ = true;
    std::int64_t done = 0;
    while (done < cycles) {
        done += fast.run(state, cycles - done, packed.team_, response, around);
        if (done == cycles)
            break;
        fast.unpack(state);
        const ListUpdate update = around.update_lists(state, base);
        if (update == ListUpdate::runaway)
            return done;
        fast.pack_updated(state, update == ListUpdate::changed, around.halo());
    }
    if (!around.halo())
        fast.unpack(state);
    packed.holds_ = true;
    return done;
}

void unpack_part(State& part, const Packed& packed) {
    if (packed.holds_)
        packed.cycle_->unpack(part);
}

} // namespace listric::dem
