#include "apps/studies/sweep/sweep_effects.hpp"

#include "apps/studies/least_squares.hpp"
#include "apps/studies/sweep/student.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>
#include <set>
#include <utility>

namespace listric {

namespace {

/// Columns of a linear model, a row a run.
using Columns = std::vector<std::vector<double>>;

/// Adds one for every value but the first, of which the others tell the difference.
template <class Value> void add_indicators(Columns& columns, const std::vector<Value>& of) {
    std::set<Value> all(of.begin(), of.end());
    if (!all.empty())
        all.erase(all.begin());
    for (const Value& value : all) {
        std::vector<double> column;
        for (const Value& one : of)
            column.push_back(one == value ? 1.0 : 0.0);
        columns.push_back(std::move(column));
    }
}

/// A parameter, or two together.
struct Term {
    std::string name;
    std::vector<double> column;
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

std::vector<double> product(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> result;
    std::ranges::transform(a, b, std::back_inserter(result), std::multiplies());
    return result;
}

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
                                            const std::vector<int>& seed,
                                            const std::vector<double>& y) {
    Columns means{std::vector<double>(y.size(), 1.0)};
    add_indicators(means, point);
    add_indicators(means, seed);
    const LeastSquares model(means);
    const auto freedom = static_cast<int>(y.size() - model.rank());
    if (freedom < 1)
        return std::nullopt;
    return Variance{model.residual(y) / freedom, freedom};
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
    std::vector<double> y;
    for (std::size_t k : runs)
        y.push_back(*values[k]);
    const std::vector<int> seeds = kept(seed, runs);

    Columns columns{std::vector<double>(y.size(), 1.0)};
    add_indicators(columns, seeds);
    std::vector<Term> main;
    for (const SweepFactor& factor : factors)
        if (factor.word.empty()) {
            const std::vector<double> place = kept(std::span(factor.place), runs);
            const auto [least, greatest] = std::ranges::minmax(place);
            if (least > middle || greatest < -middle) // where all other effects are told
                return effects;
            main.push_back({factor.name, place, reach(place) >= least_reach * reach(factor.place)});
        } else {
            add_indicators(columns, kept(std::span(factor.word), runs));
        }
    const std::size_t first_term = columns.size();
    std::vector<Term> terms = main;
    for (std::size_t a = 0; a < main.size(); ++a)
        for (std::size_t b = a + 1; b < main.size(); ++b)
            terms.push_back({main[a].name + ":" + main[b].name,
                             product(main[a].column, main[b].column),
                             main[a].is_reached && main[b].is_reached});
    for (const Term& term : terms)
        columns.push_back(term.column);

    const LeastSquares model(columns);
    const auto variance = variance_of_repeats(kept(point, runs), seeds, y);
    double largest = 0.0;
    for (double value : y)
        largest = std::max(largest, std::abs(value));
    for (std::size_t k = 0; k < terms.size(); ++k) {
        const auto weights = model.weights(first_term + k);
        if (!weights || !terms[k].is_reached)
            continue;
        SweepEffect effect{measure, terms[k].name, 2.0 * dot(*weights, y), std::nullopt};
        if (variance)
            add_chance(effect, *variance, dot(*weights, *weights), largest);
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

} // namespace listric
