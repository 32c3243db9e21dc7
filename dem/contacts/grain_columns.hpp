#pragma once

#include "dem/state.hpp"
#include "dem/threads/shared_loop.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

/// Rows of all discs by columns two mean diameters wide, each from the top down.
class GrainColumns {
public:
    explicit GrainColumns(const State& state);

    /// Calls work(rows) for every column that has discs; threads share the columns.
    template <class Work> void for_each(Work&& work) const {
        in_pieces(ends_.size(), 8, [&](std::size_t column, std::size_t end) {
            for (; column < end; ++column) {
                const std::size_t begin = column == 0 ? 0 : ends_[column - 1];
                work(std::span(order_).subspan(begin, ends_[column] - begin));
            }
        });
    }

private:
    std::vector<std::int32_t> order_; ///< of rows
    std::vector<std::size_t> ends_;   ///< of columns that have discs, in the order
};

/// Height of the grains above every disc's centre, m: what would be left of the discs above without
/// their pores. Depth below the ground times the mean share of grains in the discs above in the
/// disc's column and in half of itself; a ratio, so that it is smooth where their number jumps.
/// @param porosity  of sediment discs, by row; rock has none
std::vector<double> grains_above(const State& state, std::span<const double> porosity);

} // namespace listric::dem
