#include "dem/ranked_cycles.hpp"

#include "dem/bytes.hpp"
#include "dem/contacts.hpp"

#include <utility>

namespace listric::dem {

RankedCycles::~RankedCycles() {
    if (ranks_.mine() != 0)
        return;
    BytesOut order;
    order.add(Order{});
    Bytes bytes = order.take();
    ranks_.broadcast(bytes);
}

void RankedCycles::take(Share share) {
    share_ = std::move(share);
    links_ = std::make_unique<Links>(ranks_, share_);
    packed_.forget();
}

void RankedCycles::cut_anew(const State& whole) {
    std::vector<Share> shares = cut(whole, ownership_(whole, ranks_.count()), ranks_.count());
    rows_.clear();
    shares_.clear();
    for (const Share& share : shares) {
        rows_.push_back(own_rows(share));
        shares_.push_back(&share == &shares.front() ? Bytes() : packed(share));
    }
    ranks_.scatter(std::move(shares_));
    take(std::move(shares.front()));
    is_current_ = true;
}

std::int64_t RankedCycles::carry_out(const Order& order, BaseResponse* response) {
    links_->response_interval = order.response_interval;
    return advance_share(share_.state, base_, physics_, order.cycles, execution_, response,
                         *links_);
}

void RankedCycles::advance(State& whole, std::int64_t cycles, BaseResponse* response) {
    while (cycles > 0) {
        const Order order{cycles, response ? response->interval : 0, !is_current_};
        BytesOut out;
        out.add(order);
        Bytes bytes = out.take();
        ranks_.broadcast(bytes);
        if (order.has_share)
            cut_anew(whole);
        std::swap(share_.state.base_memory, whole.base_memory); // what answers is the root's
        is_current_ = false;                                    // until all has gone well
        const std::int64_t done = carry_out(order, response);
        std::swap(share_.state.base_memory, whole.base_memory);
        const std::vector<Bytes> all = ranks_.gather(changes(share_));
        for (std::size_t rank = all.size(); rank-- > 0;) // the root's nodes of the base come last
            put_back(all[rank], rows_[rank], whole);
        cycles -= done;
        if (cycles > 0) {
            refuse_runaways(whole);
            update_contacts(whole, base_);
        } else {
            is_current_ = true;
        }
    }
}

void RankedCycles::serve() {
    for (;;) {
        Bytes bytes;
        ranks_.broadcast(bytes);
        const auto order = BytesIn(bytes).take<Order>();
        if (order.cycles == 0)
            return;
        if (order.has_share)
            take(unpacked(ranks_.scatter({})));
        carry_out(order, nullptr);
        ranks_.gather(changes(share_));
    }
}

} // namespace listric::dem
