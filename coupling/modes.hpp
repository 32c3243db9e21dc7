#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace listric::coupling {

/// The softest modes of a base that is condensed to its interface: C = Q diag(c) Q^T.
struct Modes {
    std::size_t unknowns = 0;
    std::vector<double> compliance; ///< c, m per N/m, softest first
    std::vector<double> by_unknown; ///< Q by rows: unknown, then mode
    std::vector<double> by_mode;    ///< Q^T by rows

    std::size_t count() const { return compliance.size(); }
};

/// Modes of a symmetric positive definite compliance, `unknowns` squared numbers by rows.
/// @param most  modes that are kept, softest first; 0: all
/// Throws std::invalid_argument if it is not symmetric and positive definite.
Modes find_modes(std::span<const double> compliance, std::size_t unknowns, std::size_t most = 0);

/// result = M^T v for M by rows. Adds row after row: the order of the sums, and so the bits, do not
/// depend on how wide a processor's vectors are.
void add_rows(std::span<const double> rows, std::span<const double> v, std::span<double> result);

} // namespace listric::coupling
