#include "apps/studies/sweep/effects_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric {

namespace {

bool is_clear(const SweepEffect& effect) { return effect.p && *effect.p < clear_p; }

bool is_of_two(const SweepEffect& effect) { return effect.term.find(':') != std::string::npos; }

std::string row(const SweepEffect& e, std::size_t measure_width, std::size_t term_width) {
    const std::string names = fmt::format("{:<{}}  {:<{}}  {:>10.3g}", e.measure, measure_width,
                                          e.term, term_width, e.effect);
    if (!e.p)
        return names + "\n";
    return fmt::format("{}  {:>9.2g}  {:>4}  {:>8.2g}  {}", names, *e.margin_95,
                       e.degrees_of_freedom, *e.p, is_clear(e) ? "clear\n" : "may be chance\n");
}

} // namespace

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
            text += row(e, measure_width, term_width);
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
