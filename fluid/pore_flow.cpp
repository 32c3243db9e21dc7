#include "fluid/pore_flow.hpp"

#include "fluid/sparse_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace listric::fluid {

namespace {

constexpr int steps_before_halving = 16, most_steps = 40, most_halvings = 10;
/// Steps after which more is missing that are taken all the same: on the way to the set of cells at
/// their bounds one is needed where much water flows, but by more of them kinks of the law of pores
/// are jumped over to and fro.
constexpr int growths_allowed = 1;
constexpr double close_enough = 1.0;    ///< Pa
constexpr double water_missing = 1e-12; ///< over all water

std::vector<MatrixEntry> pattern(const FlowNetwork& network) {
    std::vector<MatrixEntry> entries;
    for (const FlowLink& link : network.links)
        entries.push_back({link.first, link.second});
    return entries;
}

enum class At : std::uint8_t { neither, lowest, highest };

/// The balance of every cell at some pressures.
struct Balance {
    std::vector<double> missing;  ///< storage less what is left of the water, m^2
    std::vector<double> diagonal; ///< of the derivative by pressure, m^2/Pa
    std::vector<At> at;           ///< the bound that Newton's step of the cell alone would pass
    double merit = 0.0;           ///< sum of what is missing, or of what bounds leave of it, m^2
    double round_off = 0.0;       ///< of that sum, m^2

    double of_bounds(const PressureBounds& bounds, std::size_t i, double u) const {
        return at[i] == At::lowest    ? bounds.lowest[i] - u
               : at[i] == At::highest ? bounds.highest[i] - u
                                      : -missing[i] / diagonal[i];
    }
};

class Step {
public:
    Step(const FlowNetwork& network, const Storage& storage, const PressureBounds& bounds,
         SparseSolver& solver)
        : network_(network), storage_(storage), bounds_(bounds), solver_(solver) {}

    /// Solves for the pressures after some seconds. False if it does not converge in `most` steps.
    bool solve(double seconds, std::span<const double> water, std::vector<double>& u, int most);

    int steps = 0; ///< of all calls
    std::size_t worst_cell() const;
    const std::vector<At>& at() const { return now_.at; }

private:
    Balance balance(double seconds, std::span<const double> water, std::span<const double> u) const;
    bool find_change(double seconds, std::span<const double> u);
    std::vector<double> moved(std::span<const double> u, double share) const;
    void shorten(double seconds, std::span<const double> water, std::span<const double> u,
                 std::vector<double>& next, Balance& there) const;

    const FlowNetwork& network_;
    const Storage& storage_;
    const PressureBounds& bounds_;
    SparseSolver& solver_;
    Balance now_;
    std::vector<double> change_;
    std::vector<double> off_diagonal_, right_side_;
};

Balance Step::balance(double seconds, std::span<const double> water,
                      std::span<const double> u) const {
    // Round-off of a solution is some times that of a sum.
    constexpr double unit = 16.0 * std::numeric_limits<double>::epsilon();
    Balance b;
    b.missing.resize(u.size());
    b.diagonal.resize(u.size());
    b.at.resize(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) {
        const Stored stored = storage_(i, u[i]);
        const double drained = seconds * network_.drains[i];
        b.missing[i] = stored.water - water[i] + drained * u[i];
        b.diagonal[i] = stored.slope + drained;
        b.round_off += unit * (water[i] + drained * std::abs(u[i]));
    }
    for (const auto& [first, second, conductance] : network_.links) {
        const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
        const double t = seconds * conductance, flows = t * (u[i] - u[j]);
        b.missing[i] += flows;
        b.missing[j] -= flows;
        b.diagonal[i] += t;
        b.diagonal[j] += t;
        b.round_off += unit * t * (std::abs(u[i]) + std::abs(u[j]));
    }
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double alone = u[i] - b.missing[i] / b.diagonal[i];
        b.at[i] = alone > bounds_.highest[i]  ? At::highest
                  : alone < bounds_.lowest[i] ? At::lowest
                                              : At::neither;
        b.merit += b.diagonal[i] * std::abs(b.of_bounds(bounds_, i, u[i]));
    }
    return b;
}

/// Newton's step: to the bounds where a cell is beyond them, by the linearised balance elsewhere.
bool Step::find_change(double seconds, std::span<const double> u) {
    const std::size_t cells = u.size();
    right_side_.resize(cells);
    off_diagonal_.resize(network_.links.size());
    change_.resize(cells);
    const auto is_free = [&](std::size_t i) { return now_.at[i] == At::neither; };
    const auto to_bound = [&](std::size_t i) { return now_.of_bounds(bounds_, i, u[i]); };
    for (std::size_t i = 0; i < cells; ++i)
        right_side_[i] = is_free(i) ? -now_.missing[i] : now_.diagonal[i] * to_bound(i);
    for (std::size_t k = 0; k < network_.links.size(); ++k) {
        const auto& [first, second, conductance] = network_.links[k];
        const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
        const double t = seconds * conductance;
        off_diagonal_[k] = is_free(i) && is_free(j) ? -t : 0.0;
        if (is_free(i) && !is_free(j))
            right_side_[i] += t * to_bound(j);
        if (is_free(j) && !is_free(i))
            right_side_[j] += t * to_bound(i);
    }
    return solver_.solve(now_.diagonal, off_diagonal_, right_side_, change_);
}

bool Step::solve(double seconds, std::span<const double> water, std::vector<double>& u, int most) {
    for (std::size_t i = 0; i < u.size(); ++i)
        u[i] = std::clamp(u[i], bounds_.lowest[i], bounds_.highest[i]);
    double all = 0.0;
    for (const double w : water)
        all += w;
    now_ = balance(seconds, water, u);
    int growths = 0; // of what is missing
    for (int k = 0; k < most; ++k) {
        ++steps;
        if (!find_change(seconds, u))
            return false;
        std::vector<double> next = moved(u, 1.0);
        Balance there = balance(seconds, water, next);
        if (there.merit > now_.merit + there.round_off && ++growths > growths_allowed)
            shorten(seconds, water, u, next, there);
        double greatest = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i)
            greatest = std::max(greatest, std::abs(next[i] - u[i]));
        u = std::move(next);
        now_ = std::move(there);
        if (greatest <= close_enough && now_.merit <= water_missing * all + now_.round_off)
            return true;
    }
    return false;
}

std::vector<double> Step::moved(std::span<const double> u, double share) const {
    std::vector<double> there(u.begin(), u.end());
    for (std::size_t i = 0; i < u.size(); ++i)
        there[i] += share * change_[i];
    return there;
}

/// Takes the longest half, quarter ... of the change after which less is missing, or the best.
void Step::shorten(double seconds, std::span<const double> water, std::span<const double> u,
                   std::vector<double>& next, Balance& there) const {
    double share = 1.0;
    for (int halving = 0; halving < most_halvings && there.merit >= now_.merit; ++halving) {
        share *= 0.5;
        std::vector<double> tried = moved(u, share);
        Balance balance_tried = balance(seconds, water, tried);
        if (balance_tried.merit < there.merit) {
            next = std::move(tried);
            there = std::move(balance_tried);
        }
    }
}

std::size_t Step::worst_cell() const {
    const auto greatest = std::ranges::max_element(
        now_.missing, {}, [](double missing) { return std::abs(missing); });
    return static_cast<std::size_t>(greatest - now_.missing.begin());
}

/// Books what has flown in some seconds at these pressures.
void book(const FlowNetwork& network, const Storage& storage, const PressureBounds& bounds,
          const std::vector<At>& at, double seconds, std::span<const double> u,
          std::span<double> water, FlowOutcome& outcome) {
    for (const auto& [first, second, conductance] : network.links) {
        const auto i = static_cast<std::size_t>(first), j = static_cast<std::size_t>(second);
        const double flows = seconds * conductance * (u[i] - u[j]);
        water[i] -= flows;
        water[j] += flows;
    }
    for (std::size_t i = 0; i < u.size(); ++i) {
        const double drained = seconds * network.drains[i] * u[i];
        water[i] -= drained;
        outcome.surface += drained;
        if (at[i] != At::highest)
            continue;
        const double left = std::max(0.0, water[i] - storage(i, u[i]).water);
        water[i] -= left;
        (!bounds.at_ground.empty() && bounds.at_ground[i] ? outcome.surface : outcome.vented) +=
            left;
    }
}

} // namespace

FlowOutcome flow(const FlowNetwork& network, const Storage& storage, const PressureBounds& bounds,
                 double seconds, std::span<double> water, std::span<double> excess_pressure) {
    assert(water.size() == network.cells() && excess_pressure.size() == network.cells());
    assert(bounds.lowest.size() == network.cells() && bounds.highest.size() == network.cells());
    FlowOutcome outcome;
    if (network.cells() == 0)
        return outcome;
    SparseSolver solver(network.cells(), pattern(network));
    Step step(network, storage, bounds, solver);
    std::vector<double> u(excess_pressure.begin(), excess_pressure.end());
    int pieces = 1;
    bool done = step.solve(seconds, water, u, steps_before_halving);
    if (!done) {
        pieces = 2;
        u.assign(excess_pressure.begin(), excess_pressure.end());
    }
    for (int piece = 0; piece < pieces; ++piece) {
        if (pieces > 1)
            done = step.solve(seconds / pieces, water, u, most_steps);
        if (!done) {
            outcome.stuck = step.worst_cell();
            break;
        }
        book(network, storage, bounds, step.at(), seconds / pieces, u, water, outcome);
    }
    outcome.steps = step.steps;
    std::ranges::copy(u, excess_pressure.begin());
    return outcome;
}

} // namespace listric::fluid
