#include "coupling/modes.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace listric::coupling {

Modes find_modes(std::span<const double> compliance, std::size_t unknowns, std::size_t most) {
    assert(unknowns > 0 && compliance.size() == unknowns * unknowns);
    const auto n = static_cast<Eigen::Index>(unknowns);
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Matrix given = Eigen::Map<const Matrix>(compliance.data(), n, n);
    if (!((given - given.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * given.cwiseAbs().maxCoeff()))
        throw std::invalid_argument("the compliance is not symmetric");
    const Eigen::MatrixXd symmetric = 0.5 * (given + given.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
    if (solver.info() != Eigen::Success || !(solver.eigenvalues()(0) > 0.0))
        throw std::invalid_argument("the compliance is not positive definite");
    const auto kept = most == 0 ? unknowns : std::min(most, unknowns);
    Modes modes;
    modes.unknowns = unknowns;
    modes.by_unknown.resize(unknowns * kept);
    modes.by_mode.resize(unknowns * kept);
    for (std::size_t k = 0; k < kept; ++k) {
        const auto column = n - 1 - static_cast<Eigen::Index>(k); // Eigen sorts upward
        modes.compliance.push_back(solver.eigenvalues()(column));
        for (std::size_t i = 0; i < unknowns; ++i)
            modes.by_unknown[i * kept + k] = modes.by_mode[k * unknowns + i] =
                solver.eigenvectors()(static_cast<Eigen::Index>(i), column);
    }
    return modes;
}

} // namespace listric::coupling
