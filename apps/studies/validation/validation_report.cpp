#include "apps/studies/validation/validation_report.hpp"

#include "apps/scene/toml/json_text.hpp"
#include "apps/support/statistics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace listric {

namespace {

namespace fs = std::filesystem;
using Kind = Expectation::Kind;
using enum Verdict::Name;

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

/// "51 to 56, 60"
std::string seeds_text(const std::vector<int>& seeds) {
    std::string text;
    for (std::size_t k = 0, end = 0; k < seeds.size(); k = end) {
        for (end = k + 1; end < seeds.size() && seeds[end] == seeds[end - 1] + 1;)
            ++end;
        text += fmt::format("{}{}", k > 0 ? ", " : "", seeds[k]);
        if (end > k + 1)
            text += fmt::format(" to {}", seeds[end - 1]);
    }
    return text;
}

/// Seeds of a run by whether they are recorded: those that are, and those that are not.
std::pair<std::vector<int>, std::vector<int>> recorded_seeds(const ValidationFindings& f,
                                                             const std::string& run) {
    std::pair<std::vector<int>, std::vector<int>> seeds;
    for (int seed : f.seeds_of(f.plan.run(run)))
        (f.is_recorded(f.plan.run(run), seed) ? seeds.first : seeds.second).push_back(seed);
    return seeds;
}

/// "6 of 20": seeds of an experiment's first run that are recorded.
std::string seeds_so_far(const ValidationFindings& f, const ValidationExperiment& x) {
    const auto [there, missing] = recorded_seeds(f, x.runs.front());
    return fmt::format("{} of {}", there.size(), there.size() + missing.size());
}

/// Names of all runs of the document's experiments, which may share them.
std::set<std::string> runs_of(const ValidationFindings& f) {
    std::set<std::string> names;
    for (const ValidationExperiment& x : f.experiments)
        names.insert(x.runs.begin(), x.runs.end());
    return names;
}

/// Verdict on a row by the seeds of the run beside it; `no_run` for rows of another run than the
/// first, and for differences between runs.
Verdict verdict_beside(const ValidationFindings& f, const ValidationExperiment& x,
                       const Expectation& e) {
    if (x.compare.empty() || e.run != x.runs.front() || !e.minus.empty())
        return {};
    return judge(e, f.values(e, x.compare));
}

/// Judged rows by verdict.
struct Tally {
    std::array<int, 8> rows{};
    int beside_too = 0; ///< shown, and by the run beside, too

    int operator[](Verdict::Name name) const { return rows[static_cast<std::size_t>(name)]; }
    int decided() const { return (*this)[shown] + (*this)[open] + (*this)[not_shown]; }

    /// "7 of 7": rows that hold in every seed; empty where there is none.
    std::string held() const {
        const int all = (*this)[met] + (*this)[missed];
        return all > 0 ? fmt::format("{} of {}", (*this)[met], all) : "";
    }

    void add(const ValidationFindings& f, const ValidationExperiment& x, Kind kind) {
        for (const Expectation& e : x.expectations)
            if (e.kind == kind && e.is_judged()) {
                const Verdict::Name name = f.verdict(e).name;
                ++rows[static_cast<std::size_t>(name)];
                beside_too += name == shown && verdict_beside(f, x, e).name == shown;
            }
    }
};

Tally tally(const ValidationFindings& f, const ValidationExperiment& x, Kind kind) {
    Tally count;
    count.add(f, x, kind);
    return count;
}

/// Experiments whose faults the document is about: several seeds, and not beside one that they are
/// like.
std::vector<ValidationExperiment> main_experiments(const ValidationFindings& f) {
    std::vector<ValidationExperiment> all;
    std::ranges::copy_if(f.experiments, std::back_inserter(all), [&](const auto& x) {
        return std::ranges::find(f.experiments, x.like, &ValidationExperiment::name) ==
                   f.experiments.end() &&
               f.plan.run(x.runs.front()).seeds != 1 &&
               std::ranges::any_of(x.expectations, [](const Expectation& e) {
                   return e.kind == Kind::faults && e.is_judged();
               });
    });
    return all;
}

/// Short name of an experiment: "LIS1" of "LIS1: listric detachment", or the one in the plan.
std::string short_name(const ValidationExperiment& x) {
    return x.like.empty() ? x.title.substr(0, x.title.find(':')) : x.name;
}

/// Origin of the record: who made the runs and who measured them, and a warning of mixtures.
std::string origins(const ValidationFindings& f) {
    std::set<std::string> made, measured, definitions;
    const auto known = [](const std::string& text, const char* unknown) {
        return text.empty() ? unknown : text;
    };
    const std::set<std::string> runs = runs_of(f);
    for (const auto& [place, m] : f.store)
        if (runs.contains(place.run) && std::ranges::count(f.seeds, place.seed) > 0) {
            made.insert(known(m.from.made_by, "a version that is not recorded"));
            measured.insert(known(m.from.measured_by, "one that is not recorded"));
            definitions.insert(known(m.from.measures_hash, "not recorded"));
        }
    if (made.empty())
        return "";
    std::string text =
        fmt::format("The runs were made by Listric {}, their measures taken by {} "
                    "(definitions {}).",
                    fmt::join(made, ", "), fmt::join(measured, ", "), fmt::join(definitions, ", "));
    std::vector<std::string> mixtures;
    if (definitions.size() > 1)
        mixtures.emplace_back("its measures have several definitions");
    if (!f.with_other_parameters.empty())
        mixtures.push_back(fmt::format("other parameters than the plan's had {}",
                                       fmt::join(f.with_other_parameters, ", ")));
    if (!mixtures.empty())
        text += fmt::format(" **This record is mixed**: {}.", fmt::join(mixtures, "; "));
    if (!f.uncompared.empty())
        text += fmt::format(" Runs of another version whose scenes are written otherwise than the "
                            "plan's: {}; it is not known whether their parameters differ.",
                            f.uncompared.size());
    return text + "\n\n";
}

/// "width of faults, diameters, 10 km"
std::string what_and_when(const ValidationFindings& f, const Expectation& e) {
    const std::vector<double>& at = f.plan.run(e.run).at;
    return at.size() > 1 || e.at ? e.what + ", " + extension_text(e.at.value_or(at.back()))
                                 : e.what;
}

/// "LIS1: 13 of 18 criteria shown, 4 open, 1 not shown: two grabens, 10 km (20 of 20 seeds)."
std::string sentence(const ValidationFindings& f, const ValidationExperiment& x) {
    const Tally count = tally(f, x, Kind::faults);
    if (count.decided() == 0)
        return fmt::format("{}: no criterion is measured.", short_name(x));
    std::vector<std::string> missing;
    for (const Expectation& e : x.expectations)
        if (e.kind == Kind::faults && e.is_judged() && f.verdict(e).name == not_shown)
            missing.push_back(what_and_when(f, e));
    std::string text =
        fmt::format("{}: {} of {} criteria shown, {} open, {} not shown{}{}", short_name(x),
                    count[shown], count.decided(), count[open], count[not_shown],
                    missing.empty() ? "" : ": ", fmt::join(missing, "; "));
    if (count[no_case] > 0)
        text += fmt::format("; {} without a case", count[no_case]);
    if (count[no_run] > 0)
        text += fmt::format("; {} not measured", count[no_run]);
    if (count.beside_too > 0)
        text += fmt::format("; {} of those shown `{}` shows, too", count.beside_too, x.compare);
    return text + fmt::format(" ({} seeds).", seeds_so_far(f, x));
}

/// The findings in as many sentences as there are experiments, and two.
std::string sentences(const ValidationFindings& f) {
    const std::vector<ValidationExperiment> experiments = main_experiments(f);
    if (experiments.empty())
        return "";
    Tally faults, machinery;
    std::string each;
    int number = 1;
    for (const ValidationExperiment& x : experiments) {
        faults.add(f, x, Kind::faults);
        machinery.add(f, x, Kind::kinematics);
        machinery.add(f, x, Kind::conservation);
        each += fmt::format("{}. {}\n", ++number, sentence(f, x));
    }
    return fmt::format(
        "## In short\n\n1. Criteria of faulting: {} of {} shown, {} open, {} not shown. The runs "
        "beside them show {} of the {}, too.\n{}{}. Kinematics and conservation hold in every seed "
        "in {} of {} rows; a hanging wall that slides on these detachments has the geometry with "
        "any material, so these rows test the machinery and no faults.\n\n",
        faults[shown], faults.decided(), faults[open], faults[not_shown], faults.beside_too,
        faults[shown], each, number + 1, machinery[met], machinery[met] + machinery[missed]);
}

constexpr std::string_view how_to_read =
    "## How it is judged\n\n"
    "| word | what it means |\n|---|---|\n"
    "| *faults* | the subject of the paper; each criterion quotes its words |\n"
    "| *shown* | more packings do it than not: of the probability that a seed meets the criterion "
    "the lower limit is above one half |\n"
    "| *not shown* | the upper limit is below one half |\n"
    "| *open* | the seeds decide neither |\n"
    "| *no case* | the value cannot exist, such as the order of two grabens where there is one; "
    "such a seed does not count |\n"
    "| limits | each by itself at a confidence of 95 %, exact (Clopper and Pearson 1934): 5 of 5 "
    "seeds, or 15 of 20, show; 0 of 5, or 5 of 20, do not |\n"
    "| *kinematics*, *conservation* | the machinery; *met* where every seed has it, or the mean of "
    "the seeds where the verdict says so |\n"
    "| a column with a run's name | value of this run, and how many of its seeds meet the "
    "criterion; "
    "what a control without AFD and ICM meets, too, does not need them |\n\n"
    "A value is the mean over the seeds ± its standard deviation (smallest to largest).\n\n";

/// Introduction of the document. The runs that failed in this call count nowhere.
std::string introduction(const ValidationFindings& f) {
    std::size_t there = 0, wanted = 0;
    for (const std::string& name : runs_of(f)) {
        const auto [have, lack] = recorded_seeds(f, name);
        there += have.size();
        wanted += have.size() + lack.size();
    }
    std::string failures = f.failed.empty() ? "" : "**Runs that failed**, and do not count:\n\n";
    for (const auto& [run, reason] : f.failed)
        failures += fmt::format("- {}: {}\n", run, reason);
    return fmt::format("Made by `listric validate` from the record of {} of {} runs at accuracy "
                       "{}, seeds {}; do not edit. Criteria and their words are in `{}`; "
                       "`docs/reference/measures.md` defines the measures; "
                       "[measures.csv]({}/measures.csv) has every number.\n\n{}{}{}",
                       there, wanted, f.accuracy, seeds_text(f.seeds), f.plan_name,
                       f.beside.filename().string(), origins(f), failures,
                       failures.empty() ? "" : "\n");
}

/// A row of a table.
std::string row(const std::vector<std::string>& cells) {
    return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

/// A table's first row and the rule below it.
std::string head(const std::vector<std::string>& names) {
    std::string rule = "|";
    for (std::size_t k = 0; k < names.size(); ++k)
        rule += "---|";
    return row(names) + rule + '\n';
}

/// Number of criteria by verdict and experiment.
std::string overview(const ValidationFindings& f) {
    std::string text = head({"experiment", "seeds", "faults: shown", "open", "not shown", "no case",
                             "kinematics", "conservation"});
    for (const ValidationExperiment& x : f.experiments) {
        std::vector<std::string> cells{x.title, seeds_so_far(f, x)};
        for (const Verdict::Name name : {shown, open, not_shown, no_case})
            cells.push_back(std::to_string(tally(f, x, Kind::faults)[name]));
        for (const Kind kind : {Kind::kinematics, Kind::conservation})
            cells.push_back(tally(f, x, kind).held());
        text += row(cells);
    }
    return text + "\n";
}

/// Measure and place of an expectation: "width of faults, diameters, 10 km
/// (`fault_width_diameters`)".
std::string subject(const ValidationFindings& f, const Expectation& e) {
    return fmt::format("{} (`{}{}{}`)", what_and_when(f, e), e.measure,
                       e.over.empty() ? "" : "` over `", e.over);
}

/// "“planar synthetic fault” (Fig. 7a)"
std::string origin_of(const Expectation& e) {
    if (e.words.empty())
        return e.source;
    return e.source.empty() ? fmt::format("“{}”", e.words)
                            : fmt::format("“{}” ({})", e.words, e.source);
}

/// An experiment's verdict on what another expects, and its numbers of seeds.
std::string verdict_on(const ValidationFindings& f, const ValidationExperiment& x,
                       const Expectation& row) {
    const auto e = std::ranges::find_if(x.expectations, [&](const Expectation& own) {
        return own.measure == row.measure && own.over == row.over && own.what == row.what &&
               own.at == row.at;
    });
    const Verdict v = e == x.expectations.end() ? Verdict{} : f.verdict(*e);
    return v.of > 0        ? fmt::format("{} ({} of {})", name_of(v.name), v.met, v.of)
           : v.no_case > 0 ? "no case"
                           : "";
}

/// An experiment and those that are like it beside each other.
std::string comparison(const ValidationFindings& f, const std::string& like) {
    std::vector<const ValidationExperiment*> columns;
    std::vector<std::string> names{"kind", "measure", "expected"};
    for (const ValidationExperiment& x : f.experiments)
        if (x.name == like || x.like == like) {
            columns.push_back(&x);
            names.push_back(x.name);
        }
    std::string text =
        fmt::format("Criteria of {} by experiment: verdict, and seeds that meet them.\n\n{}", like,
                    head(names));
    for (const Expectation& e : columns.front()->expectations) {
        if (!e.is_judged())
            continue;
        std::vector<std::string> cells{std::string(name_of(e.kind)), subject(f, e), e.target()};
        for (const ValidationExperiment* x : columns)
            cells.push_back(verdict_on(f, *x, e));
        text += row(cells);
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

/// "1.00 ± 0.00 (1.00 to 1.00): 20 of 20", seeds of the run beside it that meet the row.
std::string text_beside(const ValidationFindings& f, const ValidationExperiment& x,
                        const Expectation& e) {
    const Verdict v = verdict_beside(f, x, e);
    if (v.name == no_run)
        return "";
    const std::string values = summary(e, f.values(e, x.compare));
    return v.of > 0 && e.is_judged() ? fmt::format("{}: {} of {}", values, v.met, v.of) : values;
}

std::string table(const ValidationFindings& f, const ValidationExperiment& x) {
    const auto with_beside = [&](std::vector<std::string> cells, const std::string& beside,
                                 const std::string& verdict) {
        if (!x.compare.empty())
            cells.push_back(beside);
        cells.push_back(verdict);
        return cells;
    };
    std::string text = head(
        with_beside({"kind", "measure", "expected", "by", "this program"}, x.compare, "verdict"));
    for (const Expectation& e : x.expectations)
        text += row(with_beside({std::string(name_of(e.kind)), subject(f, e), e.target(),
                                 origin_of(e), summary(e, f.values(e, e.run))},
                                text_beside(f, x, e), f.verdict(e).text));
    return text + '\n';
}

/// Rows without verdict that have a reason, and rows that are no more.
std::string without_verdict(const ValidationFindings& f, const ValidationExperiment& x) {
    std::string rows;
    for (const Expectation& e : x.expectations)
        if (!e.reason.empty() && x.like.empty())
            rows += row({subject(f, e), "reported", e.reason});
    for (const DroppedRow& d : x.dropped)
        rows += row({d.what + (d.asked.empty() ? "" : ": ") + d.asked, "dropped", d.reason});
    return rows.empty() ? ""
                        : "Rows without verdict, and rows that were dropped:\n\n" +
                              head({"row", "now", "reason"}) + rows + '\n';
}

/// An experiment's section.
std::string section(const ValidationFindings& f, const ValidationExperiment& x) {
    std::string text =
        fmt::format("## {}\n\n{}{}", x.title, x.about, x.about.empty() ? "" : "\n\n");
    text += table(f, x) + without_verdict(f, x);
    for (const ValidationPicture& picture : x.pictures)
        if (fs::exists(f.beside / (picture.name + ".png")))
            text += fmt::format("![{}]({}/{}.png)\n\n*{}*\n\n", picture.name,
                                f.beside.filename().string(), picture.name, picture.caption);
    if (!x.seen.empty() && f.accuracy == "standard" &&
        std::ranges::all_of(x.seen_of,
                            [&](int seed) { return std::ranges::count(f.seeds, seed) > 0; }))
        text += x.seen + "\n\n";
    std::vector<std::string> missing;
    for (const std::string& name : x.runs)
        if (const auto seeds = recorded_seeds(f, name).second; !seeds.empty())
            missing.push_back(fmt::format("{} {}", name, seeds_text(seeds)));
    if (!missing.empty())
        text += fmt::format("Runs that are not recorded: {}.\n\n", fmt::join(missing, "; "));
    return text;
}

/// The expectation's number of a run at a moment; none where it has no meaning.
std::optional<double> number_of(const ValidationFindings& f, const Expectation& e,
                                const MeasuredPlace& place) {
    auto number = number_at(f.store, place, e.measure);
    if (number && !e.over.empty()) {
        const double over = number_at(f.store, place, e.over).value_or(0.0);
        number = over != 0.0 ? std::optional(*number / over) : std::nullopt;
    }
    return number;
}

/// The value of a seed; no outer one where it is not recorded, no inner one where the measure has
/// no meaning.
std::optional<std::optional<double>> value_of(const ValidationFindings& f, const Expectation& e,
                                              const std::string& of, int seed) {
    struct Part {
        std::string run;
        std::vector<double> moments;
        double sign;
    };
    const double last = e.at.value_or(f.plan.run(of).at.back());
    std::vector<Part> parts{{of, e.moments_of(f.plan.run(of), last), 1.0}};
    if (!e.minus.empty())
        parts.push_back({e.minus, e.moments_of(f.plan.run(e.minus), last), -1.0});
    if (e.since)
        parts.push_back({of, {*e.since}, -1.0});
    std::optional<double> value = 0.0;
    for (const Part& part : parts)
        for (const double at : part.moments) {
            const MeasuredPlace place{part.run, seed, at};
            if (!f.store.contains(place))
                return std::nullopt;
            const auto number = number_of(f, e, place);
            if (value && number)
                *value += part.sign * *number / static_cast<double>(part.moments.size());
            else
                value.reset();
        }
    return value ? std::optional(*value / e.unit) : value;
}

/// A row of the chart; `beside` counts the seeds of the run beside it that meet the row.
nlohmann::ordered_json chart_row(const ValidationFindings& f, const ValidationExperiment& x,
                                 const Expectation& e) {
    std::string cells;
    for (int seed : f.seeds_of(f.plan.run(e.run))) {
        const auto value = value_of(f, e, e.run, seed);
        cells += !value || !f.is_measured(e) ? '-' : !*value ? 'o' : e.meets(**value) ? 'm' : 'x';
    }
    const Verdict v = f.verdict(e);
    const Verdict beside = verdict_beside(f, x, e);
    return {{"what", what_and_when(f, e)},
            {"expected", e.target()},
            {"cells", cells},
            {"verdict", name_of(v.name)},
            {"met", v.met},
            {"of", v.of},
            {"beside", beside.of > 0 ? fmt::format("{} of {}", beside.met, beside.of) : ""}};
}

} // namespace

std::vector<int> ValidationFindings::seeds_of(const ValidationRun& run) const {
    std::vector<int> all = seeds;
    if (run.seeds > 0 && std::ssize(all) > run.seeds)
        all.resize(static_cast<std::size_t>(run.seeds));
    return all;
}

bool ValidationFindings::is_recorded(const ValidationRun& run, int seed) const {
    return std::ranges::all_of(run.at, [&](double extension) {
        return store.contains({run.name, seed, extension});
    });
}

bool ValidationFindings::is_measured(const Expectation& e) const {
    const auto is_there = [&](const std::string& measure) {
        return std::ranges::any_of(
            store, [&](const auto& entry) { return entry.second.numbers.contains(measure); });
    };
    return is_there(e.measure) && (e.over.empty() || is_there(e.over));
}

Verdict ValidationFindings::verdict(const Expectation& e) const {
    const auto all = values(e, e.run);
    if (all.empty() || is_measured(e))
        return judge(e, all);
    Verdict v;
    v.text = "not measured";
    return v;
}

std::vector<std::optional<double>> ValidationFindings::values(const Expectation& e,
                                                              const std::string& of) const {
    std::vector<std::optional<double>> all;
    for (int seed : seeds_of(plan.run(of)))
        if (const auto value = value_of(*this, e, of, seed))
            all.push_back(*value);
    return all;
}

std::string run_name(const std::string& run, int seed) { return fmt::format("{}-{}", run, seed); }

std::string extension_text(double at) { return fmt::format("{:g} km", at / 1e3); }

std::string validation_document(const ValidationFindings& f) {
    std::string text = "# Validation\n\n";
    if (fs::exists(f.beside / "verdicts.png"))
        text += fmt::format("![criteria of faulting by experiment and seed]({}/verdicts.png)\n\n",
                            f.beside.filename().string());
    text +=
        sentences(f) + std::string(how_to_read) + introduction(f) + overview(f) + comparisons(f);
    for (const ValidationExperiment& x : f.experiments)
        text += section(f, x);
    if (!f.missing.empty())
        text +=
            fmt::format("Experiments that are not recorded: {}.\n\n", fmt::join(f.missing, ", "));
    text.pop_back();
    return text;
}

std::string validation_chart(const ValidationFindings& f) {
    nlohmann::ordered_json experiments = nlohmann::ordered_json::array();
    for (const ValidationExperiment& x : main_experiments(f)) {
        nlohmann::ordered_json rows = nlohmann::ordered_json::array();
        for (const Expectation& e : x.expectations)
            if (e.kind == Kind::faults && e.is_judged())
                rows.push_back(chart_row(f, x, e));
        experiments.push_back({{"title", short_name(x)},
                               {"seeds", seeds_so_far(f, x)},
                               {"kinematics", tally(f, x, Kind::kinematics).held()},
                               {"conservation", tally(f, x, Kind::conservation).held()},
                               {"beside", x.compare},
                               {"rows", rows}});
    }
    return to_text(nlohmann::ordered_json{{"seeds", f.seeds}, {"experiments", experiments}}, 1) +
           '\n';
}

} // namespace listric
