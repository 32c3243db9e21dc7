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
using VerdictName = Verdict::Name;

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
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < seeds.size();) {
        std::size_t end = k + 1;
        while (end < seeds.size() && seeds[end] == seeds[end - 1] + 1)
            ++end;
        if (end == k + 1)
            parts.push_back(fmt::format("{}", seeds[k]));
        else
            parts.push_back(fmt::format("{} to {}", seeds[k], seeds[end - 1]));
        k = end;
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

/// Seeds of a run by whether they are recorded: those that are, and those that are not.
std::pair<std::vector<int>, std::vector<int>> recorded_seeds(const ValidationFindings& f,
                                                             const ValidationRun& run) {
    std::pair<std::vector<int>, std::vector<int>> seeds;
    for (int seed : f.seeds_of(run))
        (f.is_recorded(run, seed) ? seeds.first : seeds.second).push_back(seed);
    return seeds;
}

/// "6 of 20": seeds of an experiment's first run that are recorded.
std::string seeds_so_far(const ValidationFindings& f, const ValidationExperiment& x) {
    const auto [there, missing] = recorded_seeds(f, f.plan.run(x.runs.front()));
    return fmt::format("{} of {}", there.size(), there.size() + missing.size());
}

/// Rows of an experiment's kind by verdict.
std::array<int, 8> tally(const ValidationFindings& f, const ValidationExperiment& x, Kind kind) {
    std::array<int, 8> count{};
    for (const Expectation& e : x.expectations)
        if (e.kind == kind && e.is_judged())
            ++count[static_cast<std::size_t>(f.verdict(e).name)];
    return count;
}

int rows_with(const std::array<int, 8>& count, VerdictName name) {
    return count[static_cast<std::size_t>(name)];
}

/// "7 of 7": rows that hold in every seed; empty where there is none.
std::string held(const ValidationFindings& f, const ValidationExperiment& x, Kind kind) {
    const std::array<int, 8> count = tally(f, x, kind);
    const int met = rows_with(count, VerdictName::met),
              all = met + rows_with(count, VerdictName::missed);
    return all > 0 ? fmt::format("{} of {}", met, all) : "";
}

/// Whether an experiment's faults are what the document is about: several seeds, and not beside an
/// experiment that it is like.
bool is_main(const ValidationFindings& f, const ValidationExperiment& x) {
    return std::ranges::find(f.experiments, x.like, &ValidationExperiment::name) ==
               f.experiments.end() &&
           f.plan.run(x.runs.front()).seeds != 1 &&
           std::ranges::any_of(x.expectations, [](const Expectation& e) {
               return e.kind == Kind::faults && e.is_judged();
           });
}

/// Verdict on a row by the seeds of the run beside it; `no_run` for rows of another run than the
/// first, and for differences between runs.
Verdict verdict_beside(const ValidationFindings& f, const ValidationExperiment& x,
                       const Expectation& e) {
    if (x.compare.empty() || e.run != x.runs.front() || !e.minus.empty())
        return {};
    return judge(e, f.values(e, x.compare));
}

/// Short name of an experiment: "LIS1" of "LIS1: listric detachment", or the one in the plan.
std::string short_name(const ValidationExperiment& x) {
    return x.like.empty() ? x.title.substr(0, x.title.find(':')) : x.name;
}

/// Origin of the record: who made the runs and who measured them, and a warning of mixtures.
std::string origins(const ValidationFindings& f) {
    std::set<std::string> runs, made, measured, definitions;
    const auto known = [](const std::string& text, const char* unknown) {
        return text.empty() ? unknown : text;
    };
    for (const ValidationExperiment& x : f.experiments)
        runs.insert(x.runs.begin(), x.runs.end());
    for (const auto& [place, m] : f.store)
        if (runs.contains(place.run) && std::ranges::find(f.seeds, place.seed) != f.seeds.end()) {
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

/// Criteria of faulting that an experiment shows, and the run beside it, too.
int shown_beside_too(const ValidationFindings& f, const ValidationExperiment& x) {
    return static_cast<int>(std::ranges::count_if(x.expectations, [&](const Expectation& e) {
        return f.verdict(e).name == VerdictName::shown &&
               verdict_beside(f, x, e).name == VerdictName::shown;
    }));
}

/// "width of faults, diameters, 10 km"
std::string what_and_when(const ValidationFindings& f, const Expectation& e) {
    const std::vector<double>& at = f.plan.run(e.run).at;
    return at.size() > 1 || e.at ? e.what + ", " + extension_text(e.at.value_or(at.back()))
                                 : e.what;
}

/// "LIS1: 13 of 18 criteria shown, 4 open, 1 not shown: two grabens, 10 km (20 of 20 seeds)."
std::string sentence(const ValidationFindings& f, const ValidationExperiment& x) {
    const std::array<int, 8> count = tally(f, x, Kind::faults);
    std::vector<std::string> missing;
    for (const Expectation& e : x.expectations)
        if (e.kind == Kind::faults && e.is_judged() && f.verdict(e).name == VerdictName::not_shown)
            missing.push_back(what_and_when(f, e));
    const int all = rows_with(count, VerdictName::shown) + rows_with(count, VerdictName::open) +
                    rows_with(count, VerdictName::not_shown);
    if (all == 0)
        return fmt::format("{}: no criterion is measured.", short_name(x));
    std::string text =
        fmt::format("{}: {} of {} criteria shown, {} open, {} not shown", short_name(x),
                    rows_with(count, VerdictName::shown), all, rows_with(count, VerdictName::open),
                    rows_with(count, VerdictName::not_shown));
    if (!missing.empty())
        text += fmt::format(": {}", fmt::join(missing, "; "));
    if (const int none = rows_with(count, VerdictName::no_case); none > 0)
        text += fmt::format("; {} without a case", none);
    if (const int none = rows_with(count, VerdictName::no_run); none > 0)
        text += fmt::format("; {} not measured", none);
    if (const int both = shown_beside_too(f, x); both > 0)
        text += fmt::format("; {} of those shown `{}` shows, too", both, x.compare);
    return text + fmt::format(" ({} seeds).", seeds_so_far(f, x));
}

/// The findings in as many sentences as there are experiments, and two.
std::string sentences(const ValidationFindings& f) {
    std::vector<std::string> all;
    int shown = 0, open = 0, not_shown = 0, beside_too = 0;
    int met = 0, missed = 0;
    for (const ValidationExperiment& x : f.experiments) {
        if (!is_main(f, x))
            continue;
        all.push_back(sentence(f, x));
        const std::array<int, 8> count = tally(f, x, Kind::faults);
        shown += rows_with(count, VerdictName::shown);
        open += rows_with(count, VerdictName::open);
        not_shown += rows_with(count, VerdictName::not_shown);
        beside_too += shown_beside_too(f, x);
        for (const Kind kind : {Kind::kinematics, Kind::conservation}) {
            met += rows_with(tally(f, x, kind), VerdictName::met);
            missed += rows_with(tally(f, x, kind), VerdictName::missed);
        }
    }
    if (all.empty())
        return "";
    all.insert(all.begin(),
               fmt::format("Criteria of faulting: {} of {} shown, {} open, {} not shown. The "
                           "runs beside them show {} of the {}, too.",
                           shown, shown + open + not_shown, open, not_shown, beside_too, shown));
    all.push_back(fmt::format("Kinematics and conservation hold in every seed in {} of {} rows; a "
                              "hanging wall that slides on these detachments has the geometry with "
                              "any material, so these rows test the machinery and no faults.",
                              met, met + missed));
    std::string text = "## In short\n\n";
    for (std::size_t k = 0; k < all.size(); ++k)
        text += fmt::format("{}. {}\n", k + 1, all[k]);
    return text + "\n";
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
    "| *kinematics*, *conservation* | the machinery; *met* where every seed has it |\n"
    "| a column with a run's name | value of this run, and how many of its seeds meet the "
    "criterion; "
    "what a control without AFD and ICM meets, too, does not need them |\n\n"
    "A value is the mean over the seeds ± its standard deviation (smallest to largest).\n\n";

/// The runs that failed in this call, with their reasons; they count nowhere.
std::string failures(const ValidationFindings& f) {
    if (f.failed.empty())
        return "";
    std::string text = "**Runs that failed**, and do not count:\n\n";
    for (const auto& [run, reason] : f.failed)
        text += fmt::format("- {}: {}\n", run, reason);
    return text + "\n";
}

/// Introduction of the document.
std::string introduction(const ValidationFindings& f) {
    std::set<std::string> names; // experiments may share runs
    for (const ValidationExperiment& x : f.experiments)
        names.insert(x.runs.begin(), x.runs.end());
    std::size_t there = 0, wanted = 0;
    for (const std::string& name : names) {
        const auto [have, lack] = recorded_seeds(f, f.plan.run(name));
        there += have.size();
        wanted += have.size() + lack.size();
    }
    return fmt::format("Made by `listric validate` from the record of {} of {} runs at accuracy "
                       "{}, seeds {}; do not edit. Criteria and their words are in `{}`; "
                       "`docs/measures.md` defines the measures; "
                       "[measures.csv]({}/measures.csv) has every number.\n\n",
                       there, wanted, f.accuracy, seeds_text(f.seeds), f.plan_name,
                       f.beside.filename().string()) +
           origins(f) + failures(f);
}

/// Number of criteria by verdict and experiment.
std::string overview(const ValidationFindings& f) {
    std::string text = "| experiment | seeds | faults: shown | open | not shown | no case | "
                       "kinematics | conservation |\n|---|---|---|---|---|---|---|---|\n";
    for (const ValidationExperiment& x : f.experiments) {
        const std::array<int, 8> count = tally(f, x, Kind::faults);
        text += fmt::format(
            "| {} | {} | {} | {} | {} | {} | {} | {} |\n", x.title, seeds_so_far(f, x),
            rows_with(count, VerdictName::shown), rows_with(count, VerdictName::open),
            rows_with(count, VerdictName::not_shown), rows_with(count, VerdictName::no_case),
            held(f, x, Kind::kinematics), held(f, x, Kind::conservation));
    }
    return text + "\n";
}

/// Measure and place of an expectation: "width of faults, diameters, 10 km
/// (`fault_width_diameters`)".
std::string subject(const ValidationFindings& f, const Expectation& e) {
    const std::string what = what_and_when(f, e);
    return e.over.empty() ? fmt::format("{} (`{}`)", what, e.measure)
                          : fmt::format("{} (`{}` over `{}`)", what, e.measure, e.over);
}

/// "“planar synthetic fault” (Fig. 7a)"
std::string origin_of(const Expectation& e) {
    if (e.words.empty())
        return e.source;
    return e.source.empty() ? fmt::format("“{}”", e.words)
                            : fmt::format("“{}” ({})", e.words, e.source);
}

/// An experiment's row for what another expects; none: it has no such row.
const Expectation* same_row(const ValidationExperiment& x, const Expectation& row) {
    const auto found = std::ranges::find_if(x.expectations, [&](const Expectation& e) {
        return e.measure == row.measure && e.over == row.over && e.what == row.what &&
               e.at == row.at;
    });
    return found == x.expectations.end() ? nullptr : &*found;
}

/// An experiment and those that are like it beside each other: verdicts, and numbers of seeds.
std::string comparison(const ValidationFindings& f, const std::string& like) {
    std::vector<const ValidationExperiment*> columns;
    for (const ValidationExperiment& x : f.experiments)
        if (x.name == like || x.like == like)
            columns.push_back(&x);
    std::string text = fmt::format("Criteria of {} by experiment: verdict, and seeds that meet "
                                   "them.\n\n| kind | measure | expected |",
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
            const Verdict v = e ? f.verdict(*e) : Verdict{};
            text += v.of > 0        ? fmt::format(" {} ({} of {}) |", name_of(v.name), v.met, v.of)
                    : v.no_case > 0 ? " no case |"
                                    : " |";
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

/// "1.00 ± 0.00 (1.00 to 1.00): 20 of 20", seeds of the run beside it that meet the row.
std::string text_beside(const ValidationFindings& f, const ValidationExperiment& x,
                        const Expectation& e) {
    const Verdict v = verdict_beside(f, x, e);
    if (v.name == VerdictName::no_run)
        return "";
    const std::string values = summary(e, f.values(e, x.compare));
    return v.of > 0 && e.is_judged() ? fmt::format("{}: {} of {}", values, v.met, v.of) : values;
}

std::string table(const ValidationFindings& f, const ValidationExperiment& x) {
    const bool beside = !x.compare.empty();
    std::string text = "| kind | measure | expected | by | this program |";
    text += beside ? fmt::format(" {} | verdict |\n|---|---|---|---|---|---|---|\n", x.compare)
                   : " verdict |\n|---|---|---|---|---|---|\n";
    for (const Expectation& e : x.expectations) {
        text += fmt::format("| {} | {} | {} | {} | {} |", name_of(e.kind), subject(f, e),
                            e.target(), origin_of(e), summary(e, f.values(e, e.run)));
        if (beside)
            text += fmt::format(" {} |", text_beside(f, x, e));
        text += fmt::format(" {} |\n", f.verdict(e).text);
    }
    return text + '\n';
}

/// Rows without verdict that have a reason, and rows that are no more.
std::string without_verdict(const ValidationFindings& f, const ValidationExperiment& x) {
    std::string text;
    for (const Expectation& e : x.expectations)
        if (!e.reason.empty() && x.like.empty())
            text += fmt::format("| {} | reported | {} |\n", subject(f, e), e.reason);
    for (const DroppedRow& row : x.dropped)
        text += fmt::format("| {}{}{} | dropped | {} |\n", row.what, row.asked.empty() ? "" : ": ",
                            row.asked, row.reason);
    return text.empty()
               ? ""
               : "Rows without verdict, and rows that were dropped:\n\n| row | now | reason "
                 "|\n|---|---|---|\n" +
                     text + '\n';
}

/// An experiment's section.
std::string section(const ValidationFindings& f, const ValidationExperiment& x) {
    std::string text = fmt::format("## {}\n\n", x.title);
    if (!x.about.empty())
        text += x.about + "\n\n";
    text += table(f, x) + without_verdict(f, x);
    for (const ValidationPicture& picture : x.pictures)
        if (const fs::path file = f.beside / (picture.name + ".png"); fs::exists(file))
            text +=
                fmt::format("![{}]({}/{})\n\n*{}*\n\n", picture.name, f.beside.filename().string(),
                            file.filename().string(), picture.caption);
    if (!x.seen.empty() && f.accuracy == "standard" &&
        std::ranges::all_of(
            x.seen_of, [&](int seed) { return std::ranges::find(f.seeds, seed) != f.seeds.end(); }))
        text += x.seen + "\n\n";
    std::vector<std::string> missing;
    for (const std::string& name : x.runs)
        if (const auto seeds = recorded_seeds(f, f.plan.run(name)).second; !seeds.empty())
            missing.push_back(fmt::format("{} {}", name, seeds_text(seeds)));
    if (!missing.empty())
        text += fmt::format("Runs that are not recorded: {}.\n\n", fmt::join(missing, "; "));
    return text;
}

/// The value of a seed; no outer one where it is not recorded, no inner one where the measure has
/// no meaning.
std::optional<std::optional<double>> value_of(const ValidationFindings& f, const Expectation& e,
                                              const std::string& of, int seed) {
    const ValidationRun& run = f.plan.run(of);
    const double at = e.at.value_or(run.at.back());
    if (!f.store.contains({of, seed, at}) || (e.since && !f.store.contains({of, seed, *e.since})) ||
        (!e.minus.empty() && !f.store.contains({e.minus, seed, at})))
        return std::nullopt;
    const auto number = [&](const std::string& name, double where) -> std::optional<double> {
        const MeasuredPlace place{name, seed, where};
        const auto measure = number_at(f.store, place, e.measure);
        if (e.over.empty())
            return measure;
        const auto over = number_at(f.store, place, e.over);
        return measure && over && *over != 0.0 ? std::optional(*measure / *over) : std::nullopt;
    };
    std::optional<double> value = number(of, at);
    const auto take_off = [&](std::optional<double> other) {
        value = value && other ? std::optional(*value - *other) : std::nullopt;
    };
    if (!e.minus.empty())
        take_off(number(e.minus, at));
    if (e.since)
        take_off(number(of, *e.since));
    return value ? std::optional(*value / e.unit) : std::nullopt;
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
    if (!all.empty() && !is_measured(e)) {
        Verdict v;
        v.text = "not measured";
        return v;
    }
    return judge(e, all);
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
    for (const ValidationExperiment& x : f.experiments) {
        if (!is_main(f, x))
            continue;
        nlohmann::ordered_json rows = nlohmann::ordered_json::array();
        for (const Expectation& e : x.expectations)
            if (e.kind == Kind::faults && e.is_judged())
                rows.push_back(chart_row(f, x, e));
        experiments.push_back({{"title", short_name(x)},
                               {"seeds", seeds_so_far(f, x)},
                               {"kinematics", held(f, x, Kind::kinematics)},
                               {"conservation", held(f, x, Kind::conservation)},
                               {"beside", x.compare},
                               {"rows", rows}});
    }
    return to_text(nlohmann::ordered_json{{"seeds", f.seeds}, {"experiments", experiments}}, 1) +
           '\n';
}

} // namespace listric
