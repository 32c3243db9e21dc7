#include "dem/links.hpp"

#include "dem/cycle_physics.hpp"

#include <bit>
#include <cstring>

namespace listric::dem {

Links::Links(Ranks& ranks, const Share& share) : ranks_(ranks), own_(share.own) {
    std::vector<std::size_t> sent, received;
    for (const auto& rows : share.sent) {
        sent_.insert(sent_.end(), rows.begin(), rows.end());
        sent.push_back(ghost_numbers * rows.size());
    }
    for (const auto& rows : share.received) {
        received_.insert(received_.end(), rows.begin(), rows.end());
        received.push_back(ghost_numbers * rows.size());
    }
    to_.resize(ghost_numbers * sent_.size());
    from_.resize(ghost_numbers * received_.size());
    ranks.connect(sent, received);
}

double Links::greatest(double number) {
    std::uint64_t bits = std::bit_cast<std::uint64_t>(number); // in the order of numbers, NaN last
    ranks_.greatest({&bits, 1});
    return std::bit_cast<double>(bits);
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

} // namespace listric::dem
