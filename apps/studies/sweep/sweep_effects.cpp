#include "apps/studies/sweep/sweep_effects.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>
#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <utility>

namespace listric {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns of a linear model, a row a run.
struct Columns {
    std::vector<VectorXd> columns = {};

    MatrixXd matrix() const {
        MatrixXd m(columns[0].size(), static_cast<Eigen::Index>(columns.size()));
        for (std::size_t k = 0; k < columns.size(); ++k)
            m.col(static_cast<Eigen::Index>(k)) = columns[k];
        return m;
    }
    /// One for every value but the first, of which the others tell the difference.
    template <class Value> void add_indicators(const std::vector<Value>& of) {
        std::set<Value> all(of.begin(), of.end());
        if (!all.empty())
            all.erase(all.begin());
        for (const Value& value : all) {
            VectorXd column(static_cast<Eigen::Index>(of.size()));
            for (std::size_t k = 0; k < of.size(); ++k)
                column(static_cast<Eigen::Index>(k)) = of[k] == value ? 1.0 : 0.0;
            columns.push_back(std::move(column));
        }
    }
};

/// A parameter, or two together.
struct Term {
    std::string name;
    VectorXd column;
    bool is_reached; ///< the measure has values over its reach: its effect is no extrapolation
};

/// Values of a list, by run.
template <class Value>
std::vector<Value> kept(std::span<const Value> all, const std::vector<std::size_t>& runs) {
    std::vector<Value> result;
    for (std::size_t k : runs)
        result.push_back(all[k]);
    return result;
}

/// Share of a parameter's values that a measure must reach over.
constexpr double least_reach = 0.75;

/// How near to 0 the middle of a parameter's values is.
constexpr double middle = 1e-9;

/// Greatest less least place.
double reach(const std::vector<double>& places) {
    const auto [least, greatest] = std::ranges::minmax(places);
    return greatest - least;
}

/// A variance, and how many independent differences it is the mean square of.
struct Variance {
    double value;
    int degrees_of_freedom;
};

/// Variance of a run about the mean of its point and seed; none without repeated points.
std::optional<Variance> variance_of_repeats(const std::vector<std::size_t>& point,
                                            const std::vector<int>& seed, const VectorXd& y) {
    Columns means{{VectorXd::Ones(y.size())}};
    means.add_indicators(point);
    means.add_indicators(seed);
    const MatrixXd m = means.matrix();
    const Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(m);
    const auto freedom = static_cast<int>(y.size() - solver.rank());
    if (freedom < 1)
        return std::nullopt;
    return Variance{(y - m * solver.solve(y)).squaredNorm() / freedom, freedom};
}

/// Adds what chance may do. What is round-off, beside values of such a size, is no effect.
void add_chance(SweepEffect& effect, const Variance& variance, double square_of_weights,
                double largest_value) {
    const double error = 2.0 * std::sqrt(variance.value * square_of_weights);
    const double round_off = 1e-12 * largest_value;
    effect.standard_error = error;
    effect.degrees_of_freedom = variance.degrees_of_freedom;
    effect.p = std::abs(effect.effect) <= round_off
                   ? 1.0
                   : student_p(effect.effect / error, variance.degrees_of_freedom);
    effect.margin_95 = error * student_quantile(0.95, variance.degrees_of_freedom);
}

/// Whether chance alone gives an effect like that in fewer than one of twenty sweeps.
bool is_clear(const SweepEffect& effect) { return effect.p && *effect.p < 0.05; }

bool is_of_two(const SweepEffect& effect) { return effect.term.find(':') != std::string::npos; }

std::string effect_row(const SweepEffect& e, std::size_t measure_width, std::size_t term_width) {
    const std::string names = fmt::format("{:<{}}  {:<{}}  {:>10.3g}", e.measure, measure_width,
                                          e.term, term_width, e.effect);
    if (!e.p)
        return names + "\n";
    return fmt::format("{}  {:>9.2g}  {:>4}  {:>8.2g}  {}", names, *e.margin_95,
                       e.degrees_of_freedom, *e.p, is_clear(e) ? "clear\n" : "may be chance\n");
}

} // namespace

std::vector<SweepEffect> effects_on(const std::string& measure,
                                    std::span<const SweepFactor> factors,
                                    std::span<const std::size_t> point, std::span<const int> seed,
                                    std::span<const std::optional<double>> values) {
    std::vector<std::size_t> runs;
    for (std::size_t k = 0; k < values.size(); ++k)
        if (values[k])
            runs.push_back(k);
    std::vector<SweepEffect> effects;
    if (runs.empty())
        return effects;
    const auto n = static_cast<Eigen::Index>(runs.size());
    VectorXd y(n);
    for (Eigen::Index k = 0; k < n; ++k)
        y(k) = *values[runs[static_cast<std::size_t>(k)]];
    const std::vector<int> seeds = kept(seed, runs);

    Columns model{{VectorXd::Ones(n)}};
    model.add_indicators(seeds);
    std::vector<Term> main;
    for (const SweepFactor& factor : factors)
        if (factor.word.empty()) {
            const std::vector<double> place = kept(std::span(factor.place), runs);
            const auto [least, greatest] = std::ranges::minmax(place);
            if (least > middle || greatest < -middle) // where all other effects are told
                return effects;
            main.push_back({factor.name, Eigen::Map<const VectorXd>(place.data(), n),
                            reach(place) >= least_reach * reach(factor.place)});
        } else {
            model.add_indicators(kept(std::span(factor.word), runs));
        }
    const std::size_t first_term = model.columns.size();
    std::vector<Term> terms = main;
    for (std::size_t a = 0; a < main.size(); ++a)
        for (std::size_t b = a + 1; b < main.size(); ++b)
            terms.push_back({main[a].name + ":" + main[b].name,
                             main[a].column.cwiseProduct(main[b].column),
                             main[a].is_reached && main[b].is_reached});
    for (const Term& term : terms)
        model.columns.push_back(term.column);

    const MatrixXd m = model.matrix();
    const Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(m);
    const MatrixXd inverse = solver.pseudoInverse();
    const VectorXd fit = inverse * y;
    const MatrixXd told_apart = inverse * m; // the identity, as far as columns are independent
    const auto variance = variance_of_repeats(kept(point, runs), seeds, y);
    for (std::size_t k = 0; k < terms.size(); ++k) {
        const auto j = static_cast<Eigen::Index>(first_term + k);
        VectorXd rest = told_apart.row(j);
        rest(j) -= 1.0;
        if (rest.cwiseAbs().maxCoeff() > 1e-8 || !terms[k].is_reached)
            continue;
        SweepEffect effect{measure, terms[k].name, 2.0 * fit(j), std::nullopt};
        if (variance)
            add_chance(effect, *variance, inverse.row(j).squaredNorm(), y.cwiseAbs().maxCoeff());
        effects.push_back(std::move(effect));
    }
    return effects;
}

std::string effects_csv(std::span<const SweepEffect> effects) {
    std::string text = "measure,term,effect,standard_error,degrees_of_freedom,p,low_95,high_95\n";
    for (const SweepEffect& e : effects) {
        text += fmt::format("{},{},{:.6g},", e.measure, e.term, e.effect);
        text += e.p ? fmt::format("{:.3g},{},{:.3g},{:.6g},{:.6g}\n", *e.standard_error,
                                  e.degrees_of_freedom, *e.p, e.effect - *e.margin_95,
                                  e.effect + *e.margin_95)
                    : ",,,,\n";
    }
    return text;
}

std::string effects_text(std::span<const SweepEffect> effects) {
    std::size_t measure_width = 7, term_width = 4, left_out = 0;
    for (const SweepEffect& e : effects) {
        measure_width = std::max(measure_width, e.measure.size());
        term_width = std::max(term_width, e.term.size());
    }
    std::string text =
        fmt::format("{:<{}}  {:<{}}  {:>10}  {:>9}  {:>4}  {:>8}\n", "measure", measure_width,
                    "term", term_width, "effect", "+- 95 %", "df", "p");
    for (const SweepEffect& e : effects)
        if (is_of_two(e) && !is_clear(e))
            ++left_out;
        else
            text += effect_row(e, measure_width, term_width);
    if (left_out > 0)
        text +=
            fmt::format("effects.csv has {} more, of two parameters together, that {}\n", left_out,
                        effects.front().p ? "may be chance" : "have no standard error");
    return effects.empty() ? "" : text;
}

std::string warning_of_few(int seeds) {
    if (seeds >= 3)
        return "";
    return seeds == 1
               ? "one seed shows nothing of chance: effects have neither standard errors nor p; "
                 "three seeds or more do (seeds = 3)"
               : "two seeds show little of chance: by Student's t an effect of one parameter with "
                 "two values must be 12.7 standard errors large to be clear, with three seeds 4.3 "
                 "(seeds = 3)";
}

double student_p(double t, double degrees_of_freedom) {
    assert(degrees_of_freedom > 0.0);
    if (std::isinf(t))
        return 0.0;
    // Abramowitz and Stegun, Handbook of Mathematical Functions, 26.7.1 and 26.5.27.
    return Eigen::numext::betainc(0.5 * degrees_of_freedom, 0.5,
                                  degrees_of_freedom / (degrees_of_freedom + t * t));
}

double student_quantile(double probability, double degrees_of_freedom) {
    assert(probability > 0.0 && probability < 1.0);
    const double beyond = 1.0 - probability;
    double low = 0.0, high = 1.0;
    while (student_p(high, degrees_of_freedom) > beyond)
        high *= 2.0;
    for (double middle = 0.5 * high; low < middle && middle < high; middle = 0.5 * (low + high))
        (student_p(middle, degrees_of_freedom) > beyond ? low : high) = middle;
    return high;
}

} // namespace listric
