#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace listric {

/// A parameter of many runs, as effects see it.
struct SweepFactor {
    std::string name;
    /// By run: from -1 at the least value to 1 at the greatest, or -1 and 1 for two words; by the
    /// logarithm of values that go up by factors.
    std::vector<double> place;
    /// Number of the word, by run, where there are more than two: they have no order, so that no
    /// effect is given, but what they change is not taken for another's.
    std::vector<std::size_t> word = {};
};

/// Effect of a parameter, or of two together.
struct SweepEffect {
    std::string measure;
    std::string term; ///< a or a:b
    /// For a: change of the measure from the least value of a to the greatest, others in their
    /// middle. For a:b: half of what that effect of a changes from the least b to the greatest.
    double effect = 0.0;
    /// None: no run was repeated with another seed.
    std::optional<double> standard_error = std::nullopt;
    int degrees_of_freedom = 0; ///< that the standard error is known from
    /// How likely chance alone gives such an effect or a larger one, by Student's t, and how far to
    /// either side the truth may lie in 95 of 100 sweeps; there where the standard error is.
    std::optional<double> p = std::nullopt, margin_95 = std::nullopt;
};

/// Least squares on all main effects and two-way interactions with a constant for each seed, since
/// runs of one seed begin with one packing (a block; Montgomery, Design and Analysis of
/// Experiments, ch. 5 and 6). A term that the runs cannot tell from others is left out, and so is
/// one of a parameter over more than a quarter of whose reach the measure has no value; all are,
/// where it has none in the middle of one. Errors are
/// those of repeated points: the spread between seeds once the mean difference of seeds is off,
/// taken to be the same at all points. Of n points and s seeds, all finished, it has
/// (n - 1) (s - 1) degrees of freedom.
/// @param point   number of the design point, by run
/// @param values  by run; none: it failed or the measure has no meaning
std::vector<SweepEffect> effects_on(const std::string& measure,
                                    std::span<const SweepFactor> factors,
                                    std::span<const std::size_t> point, std::span<const int> seed,
                                    std::span<const std::optional<double>> values);

/// effects.csv: measure, term, effect, standard_error, degrees_of_freedom, p, low_95, high_95; from
/// standard_error on empty where nothing is known of chance.
std::string effects_csv(std::span<const SweepEffect> effects);

/// Effects as text: each parameter's own, and of two together those that are clear.
std::string effects_text(std::span<const SweepEffect> effects);

/// Warning of too few seeds; empty from three seeds on.
std::string warning_of_few(int seeds);

} // namespace listric
