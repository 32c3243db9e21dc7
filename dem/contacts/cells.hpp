#pragma once

#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

/// Square cells over the discs, for finding all discs within one cell width of a point.
class Cells {
public:
    /// @param x, y  centres, m, finite, as their differences are
    /// @param width  cell width = reach of a search, m, above 0
    Cells(std::span<const double> x, std::span<const double> y, double width) : width_(width) {
        if (x.empty())
            return;
        const auto [left, right] = std::ranges::minmax(x);
        const auto [bottom, top] = std::ranges::minmax(y);
        left_ = left;
        bottom_ = bottom;
        // Few far-flung discs must not cost memory: then cells get wider.
        const double most = 4.0 * static_cast<double>(x.size()) + 64.0;
        // Nor must many along a line, whose rows and columns multiply to nothing.
        const auto is_many = [&](double columns, double rows) {
            return columns * rows > most || columns + rows > 2.0 * most;
        };
        while (is_many((right - left) / width_, (top - bottom) / width_))
            width_ *= 2.0;
        columns_ = static_cast<std::int64_t>((right - left) / width_) + 1;
        rows_ = static_cast<std::int64_t>((top - bottom) / width_) + 1;
        begin_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
        std::vector<std::int32_t> cell(x.size());
        in_pieces(x.size(), 8192, [&](std::size_t i, std::size_t end) {
            for (; i < end; ++i)
                cell[i] =
                    static_cast<std::int32_t>(static_cast<std::int64_t>(column(x[i])) * rows_ +
                                              static_cast<std::int64_t>(row(y[i])));
        });
        for (const std::int32_t c : cell)
            ++begin_[static_cast<std::size_t>(c) + 1];
        for (std::size_t c = 1; c < begin_.size(); ++c)
            begin_[c] += begin_[c - 1];
        discs_.resize(x.size());
        std::vector<std::int32_t> next(begin_.begin(), begin_.end() - 1);
        for (std::size_t i = 0; i < x.size(); ++i)
            discs_[static_cast<std::size_t>(next[static_cast<std::size_t>(cell[i])]++)] =
                static_cast<std::int32_t>(i);
    }

    /// All discs, by cell.
    std::span<const std::int32_t> discs() const { return discs_; }

    /// Calls visit(disc) for every disc within one cell width of (x, y), and for some beyond.
    template <class Visit> void for_each_near(double x, double y, Visit&& visit) const {
        for_each_run_near(x, y, [&](std::size_t begin, std::size_t end) {
            for (; begin < end; ++begin)
                visit(discs_[begin]);
        });
    }

    /// Visits runs of discs(): visit(begin, end).
    template <class Visit> void for_each_run_near(double x, double y, Visit&& visit) const {
        if (discs_.empty())
            return;
        const std::int64_t c = within(column(x), columns_), r = within(row(y), rows_);
        const std::int64_t low = std::max<std::int64_t>(r - 1, 0);
        const std::int64_t high = std::min(r + 1, rows_ - 1);
        if (low > high)
            return;
        for (std::int64_t k = std::max<std::int64_t>(c - 1, 0); k <= std::min(c + 1, columns_ - 1);
             ++k) {
            const auto begin = static_cast<std::size_t>(k * rows_ + low);
            const auto end = static_cast<std::size_t>(k * rows_ + high + 1);
            visit(static_cast<std::size_t>(begin_[begin]), static_cast<std::size_t>(begin_[end]));
        }
    }

private:
    // Whole numbers; those of centres fit, those of other places may be far beyond the grid.
    double column(double x) const { return std::floor((x - left_) / width_); }
    double row(double y) const { return std::floor((y - bottom_) / width_); }
    static std::int64_t within(double place, std::int64_t count) {
        return static_cast<std::int64_t>(std::clamp(place, -2.0, static_cast<double>(count + 1)));
    }

    double width_, left_ = 0.0, bottom_ = 0.0;
    std::int64_t columns_ = 0, rows_ = 0;
    std::vector<std::int32_t> begin_, discs_;
};

} // namespace listric::dem
