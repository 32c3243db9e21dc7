#include "dem/ranks/halo_exchange.hpp"

#include "dem/numbers/order_free.hpp"
#include "dem/ranks/subdomain_update.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

namespace listric::dem {

HaloExchange::HaloExchange(Ranks& ranks, Subdomain& subdomain)
    : ranks_(ranks), subdomain_(subdomain) {
    connect();
}

void HaloExchange::connect() {
    std::vector<std::size_t> sent, received;
    const auto take = [](const std::vector<std::vector<std::int32_t>>& by_rank,
                         std::vector<std::int32_t>& all, std::vector<std::size_t>& sizes) {
        all.clear();
        for (const auto& rows : by_rank) {
            all.insert(all.end(), rows.begin(), rows.end());
            sizes.push_back(Halo::numbers * rows.size());
        }
    };
    take(subdomain_.sent, halo_.sent, sent);
    take(subdomain_.received, halo_.received, received);
    halo_.to.resize(Halo::numbers * halo_.sent.size());
    halo_.from.resize(Halo::numbers * halo_.received.size());
    ranks_.connect(sent, received);
}

double HaloExchange::after_cycle(State& state, double) {
    const DiscColumns d = disc_columns(state);
    const std::span<double> columns[Halo::numbers] = {d.x, d.y, d.vx, d.vy, d.spin};
    double* to = halo_.to.data();
    for (const std::int32_t row : halo_.sent)
        for (const auto column : columns)
            *to++ = column[static_cast<std::size_t>(row)];
    begin_exchange();
    end_exchange();
    const double* from = halo_.from.data();
    for (const std::int32_t row : halo_.received)
        for (const auto column : columns)
            column[static_cast<std::size_t>(row)] = *from++;
    double fastest = 0.0; // ghosts had been moved without all of their forces
    for (std::size_t i = 0; i < d.x.size(); ++i)
        fastest = greater(fastest, greater(std::abs(d.vx[i]), std::abs(d.vy[i])));
    return fastest;
}

void HaloExchange::agree_on(std::span<double> numbers) {
    std::vector<std::uint64_t> bits; // in the order of numbers, NaN last
    for (const double number : numbers)
        bits.push_back(std::bit_cast<std::uint64_t>(number));
    ranks_.greatest(bits);
    for (std::size_t k = 0; k < numbers.size(); ++k)
        numbers[k] = std::bit_cast<double>(bits[k]);
}

ListUpdate HaloExchange::update_lists(State& state, const RigidBase& base) {
    assert(&state == &subdomain_.state);
    // All know the same bound.
    if (!(state.displacement_bound < 10.0 * state.mean_radius))
        return ListUpdate::runaway;
    if (update_subdomain(subdomain_, base, ranks_))
        connect();
    return ListUpdate::changed;
}

void HaloExchange::respond(State& state, const Clock& clock, BaseResponse* response) {
    if (!is_response_due(response_interval, clock))
        return;
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
