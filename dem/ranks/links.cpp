#include "dem/ranks/links.hpp"

#include "dem/cycle_physics.hpp"
#include "dem/ranks/share_update.hpp"

#include <bit>
#include <cstring>

namespace listric::dem {

Links::Links(Ranks& ranks, Share& share) : ranks_(ranks), share_(share) { connect(); }

void Links::connect() {
    std::vector<std::size_t> sent, received;
    const auto take = [](const std::vector<std::vector<std::int32_t>>& by_rank,
                         std::vector<std::int32_t>& all, std::vector<std::size_t>& sizes) {
        all.clear();
        for (const auto& rows : by_rank) {
            all.insert(all.end(), rows.begin(), rows.end());
            sizes.push_back(ghost_numbers * rows.size());
        }
    };
    take(share_.sent, sent_, sent);
    take(share_.received, received_, received);
    to_.resize(ghost_numbers * sent_.size());
    from_.resize(ghost_numbers * received_.size());
    ranks_.connect(sent, received);
}

bool Links::update_lists(const RigidBase& base) {
    // All know the same bound.
    if (!(share_.state.displacement_bound < 10.0 * share_.state.mean_radius))
        return false;
    if (update_share(share_, base, ranks_))
        connect();
    return true;
}

void Links::share_speeds() {
    std::vector<std::uint64_t> bits;
    for (const double speed : speeds)
        bits.push_back(std::bit_cast<std::uint64_t>(speed));
    ranks_.greatest(bits);
    for (std::size_t k = 0; k < speeds.size(); ++k)
        speeds[k] = std::bit_cast<double>(bits[k]);
}

void Links::respond(State& state, const Clock& clock, BaseResponse* response) {
    const BaseNodeColumns nodes = base_node_columns(state);
    ranks_.sum(nodes.load_x);
    ranks_.sum(nodes.load_y);
    if (response)
        response->respond(state, clock);
    Bytes velocities(2 * sizeof(double) * nodes.vx.size());
    const auto half = static_cast<std::ptrdiff_t>(velocities.size() / 2);
    if (ranks_.mine() == 0) {
        std::memcpy(velocities.data(), nodes.vx.data(), velocities.size() / 2);
        std::memcpy(velocities.data() + half, nodes.vy.data(), velocities.size() / 2);
    }
    ranks_.broadcast(velocities);
    std::memcpy(nodes.vx.data(), velocities.data(), velocities.size() / 2);
    std::memcpy(nodes.vy.data(), velocities.data() + half, velocities.size() / 2);
    for (const auto loads : {nodes.load_x, nodes.load_y})
        std::ranges::fill(loads, 0); // the response has them, or there is none
}

void respond_if_due(State& state, const Clock& clock, BaseResponse* response, Links* links) {
    const std::int64_t interval = links      ? links->response_interval
                                  : response ? response->interval
                                             : 0;
    if (interval == 0 || (clock.cycle + 1) % interval != 0)
        return;
    if (links)
        links->respond(state, clock, response);
    else
        response->respond(state, clock);
}

} // namespace listric::dem
