#include "dem/ranks/ranked_cycles.hpp"

#include "dem/contacts/contacts.hpp"
#include "dem/ranks/table_bytes.hpp"
#include "dem/rolling.hpp"

#include <utility>

namespace listric::dem {

RankedCycles::~RankedCycles() {
    if (ranks_.mine() == 0)
        give({.task = Task::end});
}

void RankedCycles::give(const Order& order) {
    BytesOut out;
    out.add(order);
    Bytes bytes = out.take();
    ranks_.broadcast(bytes);
}

void RankedCycles::take(Subdomain subdomain) {
    subdomain_ = std::move(subdomain);
    halo_ = std::make_unique<HaloExchange>(ranks_, subdomain_);
    packed_.forget();
}

void RankedCycles::cut_anew(State& whole) {
    own_.resize(static_cast<std::size_t>(ranks_.count()));
    subdomain_ = {};
    Subdomain mine;
    {
        Cut cut(whole, ownership_(whole, ranks_.count()), ranks_.count());
        ranks_.scatter([&](int rank) {
            Subdomain subdomain = cut.subdomain(rank);
            const auto own = cut.own(rank);
            own_[static_cast<std::size_t>(rank)].assign(own.begin(), own.end());
            if (rank != 0)
                return packed(subdomain);
            mine = std::move(subdomain);
            return Bytes();
        });
    }
    take(std::move(mine));
    for (Table* contacts : {&whole.contacts, &whole.base_contacts}) // a fifth of the memory
        *contacts = selected(*contacts, {});
}

std::int64_t RankedCycles::carry_out(const Order& order, BaseResponse* response) {
    halo_->response_interval = order.response_interval;
    return advance_part(subdomain_.state, base_, physics_, order.cycles, execution_, response,
                        *halo_);
}

Bytes RankedCycles::changed() {
    unpack_part(subdomain_.state, execution_);
    return changes(subdomain_);
}

void RankedCycles::advance(State& whole, std::int64_t cycles, bool state_is_untouched,
                           BaseResponse* response) {
    bool has_subdomains = !add_rolling(whole) && state_is_untouched && halo_;
    while (cycles > 0) {
        const Order order{Task::advance, !has_subdomains, response ? response->interval : 0,
                          cycles};
        give(order);
        if (order.has_subdomain)
            cut_anew(whole);
        has_subdomains = true;
        is_ahead_ = true;
        std::swap(subdomain_.state.base_memory, whole.base_memory); // the root's responds
        cycles -= carry_out(order, response);
        std::swap(subdomain_.state.base_memory, whole.base_memory);
        whole.clock = subdomain_.state.clock;
        if (cycles == 0)
            break;
        collect(whole);
        refuse_runaways(whole);
        update_contacts(whole, base_);
        has_subdomains = false;
    }
}

void RankedCycles::collect(State& whole) {
    if (!is_ahead_)
        return;
    give({.task = Task::collect});
    ranks_.gather(changed(), [&](int rank, const Bytes& message) {
        put_back(message, rank, own_[static_cast<std::size_t>(rank)], whole);
    });
    sort_contacts(whole);
    is_ahead_ = false;
}

void RankedCycles::serve() {
    for (;;) {
        Bytes bytes;
        ranks_.broadcast(bytes);
        const auto order = BytesIn(bytes).take<Order>();
        switch (order.task) {
        case Task::end:
            return;
        case Task::advance:
            if (order.has_subdomain) {
                subdomain_ = {};
                take(unpacked(ranks_.scatter({})));
            }
            carry_out(order, nullptr);
            break;
        case Task::collect:
            ranks_.gather(changed(), {});
            break;
        }
    }
}

} // namespace listric::dem
