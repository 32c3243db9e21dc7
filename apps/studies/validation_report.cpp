#include "apps/studies/validation_report.hpp"

#include "apps/support/statistics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace listric {

namespace {

namespace fs = std::filesystem;

/// "38.20 ± 0.03 (38.17 to 38.24)"
std::string summary(const Expectation& e, const std::vector<std::optional<double>>& all) {
    std::vector<double> numbers;
    for (const auto& value : all)
        if (value)
            numbers.push_back(*value);
    if (numbers.empty())
        return all.empty() ? "" : "no value";
    const auto [low, high] = std::ranges::minmax(numbers);
    const Spread s = spread(numbers);
    std::string text = fmt::format("{:.{}f}", s.mean, e.digits);
    if (numbers.size() > 1)
        text += fmt::format(" ± {:.{}f} ({:.{}f} to {:.{}f})", s.deviation, e.digits, low, e.digits,
                            high, e.digits);
    if (numbers.size() < all.size())
        text += fmt::format(", {} without", all.size() - numbers.size());
    return text;
}

/// Names of an experiment's runs: those that are there, and all.
std::pair<std::set<std::string>, std::set<std::string>> runs_of(const ValidationFindings& f,
                                                                const ValidationExperiment& x) {
    std::set<std::string> present, all;
    for (const std::string& name : x.runs)
        for (int seed : f.seeds_of(f.plan.run(name)))
            all.insert(run_name(name, seed));
    std::ranges::set_intersection(all, f.finished, std::inserter(present, present.end()));
    return {present, all};
}

/// "The runs were made by Listric 0.2.0+abc, their measures taken by 0.2.0+def.", of all runs.
std::string makers(const ValidationFindings& f, const std::set<std::string>& runs) {
    std::set<std::string> made, measured;
    for (const auto& [place, m] : f.store)
        if (runs.contains(run_name(place.run, place.seed))) {
            made.insert(m.made_by.empty() ? "a version that is not recorded" : m.made_by);
            measured.insert(m.measured_by.empty() ? "one that is not recorded" : m.measured_by);
        }
    return made.empty() ? ""
                        : fmt::format("The runs were made by Listric {}, their measures taken by "
                                      "{}.\n\n",
                                      fmt::join(made, ", "), fmt::join(measured, ", "));
}

/// Introduction of the document, and how to read it.
std::string introduction(const ValidationFindings& f) {
    std::set<std::string> wanted, there; // experiments may share runs
    for (const ValidationExperiment& x : f.experiments) {
        auto [present, all] = runs_of(f, x);
        there.merge(present);
        wanted.merge(all);
    }
    std::string text = fmt::format(
        "# Validation\n\n"
        "Made by `listric validate` from the files of {} of {} runs at accuracy {}, up to {} "
        "seeds each{}; do not edit. What is expected, and by whom, is in "
        "`{}`; `docs/measures.md` defines the measures; "
        "[measures.csv]({}/measures.csv) has every number.\n\n",
        there.size(), wanted.size(), f.accuracy, f.seeds,
        f.first_seed == 1 ? "" : fmt::format(", from {} on", f.first_seed), f.plan_name,
        f.beside.filename().string());
    return text + makers(f, there) +
           "A value is the mean over the seeds ± its standard deviation (smallest to "
           "largest). *Met* is the number of seeds that fulfil the expectation; where it requires "
           "most seeds or the mean, that decides. Rows of kind *kinematics* check the "
           "machinery: a hanging wall that slides on that detachment has them with any "
           "material, faults or none, so meeting them proves nothing about faults. Rows of kind "
           "*faults* are the subject of the paper. Rows of kind *conservation* are "
           "bookkeeping.\n\n";
}

/// How many expectations of each kind are met, by experiment.
std::string overview(const ValidationFindings& f) {
    std::string text = "| experiment | runs | kinematics | faults | conservation |\n"
                       "|---|---|---|---|---|\n";
    for (const ValidationExperiment& x : f.experiments) {
        const auto [present, all] = runs_of(f, x);
        text += fmt::format("| {} | {} of {} |", x.title, present.size(), all.size());
        for (auto kind : {Expectation::Kind::kinematics, Expectation::Kind::faults,
                          Expectation::Kind::conservation}) {
            int met = 0, judged = 0;
            for (const Expectation& e : x.expectations)
                if (const Verdict v = judge(e, f.values(e, e.run));
                    e.kind == kind && v.of > 0 && e.is_judged()) {
                    ++judged;
                    met += v.fulfilled;
                }
            text += judged ? fmt::format(" {} of {} |", met, judged) : " |";
        }
        text += '\n';
    }
    return text + "\n";
}

/// Measure and place of an expectation: "width of faults, diameters, 10 km
/// (`fault_width_diameters`)".
std::string subject(const ValidationFindings& f, const Expectation& e) {
    std::string what = e.what;
    if (f.plan.run(e.run).at.size() > 1 || e.at)
        what += ", " + extension_text(e.at.value_or(f.plan.run(e.run).at.back()));
    return fmt::format("{} (`{}`)", what, e.measure);
}

/// An experiment's row for what another expects; none: it has no such row.
const Expectation* same_row(const ValidationExperiment& x, const Expectation& row) {
    const auto found = std::ranges::find_if(x.expectations, [&](const Expectation& e) {
        return e.measure == row.measure && e.what == row.what && e.at == row.at;
    });
    return found == x.expectations.end() ? nullptr : &*found;
}

/// An experiment and those that are like it beside each other: in how many seeds each row is met.
std::string comparison(const ValidationFindings& f, const std::string& like) {
    std::vector<const ValidationExperiment*> columns;
    for (const ValidationExperiment& x : f.experiments)
        if (x.name == like || x.like == like)
            columns.push_back(&x);
    std::string text = fmt::format("Rows of {} by experiment: met, or in how many seeds.\n\n"
                                   "| kind | measure | expected |",
                                   like);
    std::string rule = "|---|---|---|";
    for (const ValidationExperiment* x : columns) {
        text += fmt::format(" {} |", x->name);
        rule += "---|";
    }
    text += '\n' + rule + '\n';
    for (const Expectation& row : columns.front()->expectations) {
        if (!row.is_judged())
            continue;
        text += fmt::format("| {} | {} | {} |", name_of(row.kind), subject(f, row), row.target());
        for (const ValidationExperiment* x : columns) {
            const Expectation* const e = same_row(*x, row);
            const Verdict v = e ? judge(*e, f.values(*e, e->run)) : Verdict{};
            text += v.of == 0     ? " |"
                    : v.fulfilled ? " met |"
                                  : fmt::format(" {} of {} |", v.met, v.of);
        }
        text += '\n';
    }
    return text + '\n';
}

/// Those comparisons that there are.
std::string comparisons(const ValidationFindings& f) {
    std::set<std::string> liked;
    for (const ValidationExperiment& x : f.experiments)
        if (!x.like.empty())
            liked.insert(x.like);
    std::string text;
    for (const std::string& like : liked)
        text += comparison(f, like);
    return text;
}

std::string table(const ValidationFindings& f, const ValidationExperiment& x) {
    const bool beside = !x.compare.empty();
    std::string text = "| kind | measure | expected | by | this program |";
    text += beside ? fmt::format(" {} | verdict |\n|---|---|---|---|---|---|---|\n", x.compare)
                   : " verdict |\n|---|---|---|---|---|---|\n";
    for (const Expectation& e : x.expectations) {
        const auto all = f.values(e, e.run);
        const Verdict v = judge(e, all);
        text += fmt::format("| {} | {} | {} | {} | {} |", name_of(e.kind), subject(f, e),
                            e.target(), e.source, summary(e, all));
        if (beside)
            text += fmt::format(" {} |", e.run == x.runs.front() && e.minus.empty()
                                             ? summary(e, f.values(e, x.compare))
                                             : "");
        text += fmt::format(" {} |\n", v.text);
    }
    return text;
}

} // namespace

std::vector<int> ValidationFindings::seeds_of(const ValidationRun& run) const {
    std::vector<int> all(
        static_cast<std::size_t>(run.seeds > 0 ? std::min(run.seeds, seeds) : seeds));
    std::iota(all.begin(), all.end(), first_seed);
    return all;
}

std::vector<std::optional<double>> ValidationFindings::values(const Expectation& e,
                                                              const std::string& of) const {
    const ValidationRun& run = plan.run(of);
    const double at = e.at.value_or(run.at.back());
    std::vector<std::optional<double>> all;
    const auto number = [&](const std::string& name, int seed, double where) {
        return number_at(store, {name, seed, where}, e.measure);
    };
    for (int seed : seeds_of(run)) {
        if (!store.contains({of, seed, at}) ||
            (!e.minus.empty() && !store.contains({e.minus, seed, at})))
            continue;
        std::optional<double> value = number(of, seed, at);
        const auto take_off = [&](std::optional<double> other) {
            value = value && other ? std::optional(*value - *other) : std::nullopt;
        };
        if (!e.minus.empty())
            take_off(number(e.minus, seed, at));
        if (e.since)
            take_off(number(of, seed, *e.since));
        all.push_back(value ? std::optional(*value / e.unit) : std::nullopt);
    }
    return all;
}

std::string run_name(const std::string& run, int seed) { return fmt::format("{}-{}", run, seed); }

std::string extension_text(double at) { return fmt::format("{:g} km", at / 1e3); }

std::string validation_document(const ValidationFindings& f) {
    std::string text = introduction(f) + overview(f) + comparisons(f);
    for (const ValidationExperiment& x : f.experiments) {
        text += fmt::format("## {}\n\n", x.title);
        if (!x.about.empty())
            text += x.about + "\n\n";
        text += table(f, x) + "\n";
        for (const ValidationPicture& picture : x.pictures)
            if (const fs::path file = f.beside / (picture.name + ".png"); fs::exists(file))
                text += fmt::format("![{}]({}/{})\n\n*{}*\n\n", picture.name,
                                    f.beside.filename().string(), file.filename().string(),
                                    picture.caption);
        if (!x.seen.empty() && f.accuracy == "standard")
            text += x.seen + "\n\n";
        const auto [present, all] = runs_of(f, x);
        std::vector<std::string> missing;
        std::ranges::set_difference(all, present, std::back_inserter(missing));
        if (!missing.empty())
            text += fmt::format("Runs that were not there: {}.\n\n", fmt::join(missing, ", "));
    }
    text.pop_back();
    return text;
}

} // namespace listric
