// Apart from modes.cpp, which is compiled without wide vectors: here they change no bit.

#include "coupling/modes.hpp"

#include <algorithm>
#include <cassert>

namespace listric::coupling {

void add_rows(std::span<const double> rows, std::span<const double> v, std::span<double> result) {
    assert(rows.size() == v.size() * result.size());
    std::ranges::fill(result, 0.0);
    const std::size_t n = result.size();
    double* const __restrict sum = result.data();
    const double* row = rows.data();
    std::size_t i = 0;
    // Four rows at a time, added one after the other: the same sums with a quarter of the traffic.
    for (; i + 4 <= v.size(); i += 4, row += 4 * n) {
        const double a = v[i], b = v[i + 1], c = v[i + 2], d = v[i + 3];
        const double *const ra = row, *const rb = row + n, *const rc = row + 2 * n,
                            *const rd = row + 3 * n;
        for (std::size_t k = 0; k < n; ++k)
            sum[k] = (((sum[k] + a * ra[k]) + b * rb[k]) + c * rc[k]) + d * rd[k];
    }
    for (; i < v.size(); ++i, row += n)
        for (std::size_t k = 0; k < n; ++k)
            sum[k] += v[i] * row[k];
}

} // namespace listric::coupling
