#pragma once

#include "dem/columns.hpp"
#include "dem/numbers/point.hpp"
#include "dem/state.hpp"

#include <span>

namespace listric::dem {

/// Gives discs a constant force beside their weight: columns `push_x` and `push_y`, N, for events
/// to set. Cycles start the sum of a disc's forces with it.
inline void add_pushes(State& state) {
    state.discs.add(columns::push_x);
    state.discs.add(columns::push_y);
}

/// The columns of add_pushes(), or no force where there are none.
class Pushes {
public:
    explicit Pushes(const State& state) {
        if (!state.discs.has(columns::push_x))
            return;
        x_ = state.discs.get(columns::push_x);
        y_ = state.discs.get(columns::push_y);
    }

    bool any() const { return !x_.empty(); }

    Point operator[](std::size_t i) const { return x_.empty() ? Point{} : Point{x_[i], y_[i]}; }

    bool on(std::size_t i) const { return !x_.empty() && (x_[i] != 0.0 || y_[i] != 0.0); }

    /// Number of pushed discs among the rows from `begin` on, before `end`.
    std::size_t count(std::size_t begin, std::size_t end) const {
        std::size_t pushed = 0;
        for (; !x_.empty() && begin < end; ++begin)
            pushed += on(begin);
        return pushed;
    }

private:
    std::span<const double> x_, y_;
};

} // namespace listric::dem
