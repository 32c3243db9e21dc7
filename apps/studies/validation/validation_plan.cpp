#include "apps/studies/validation/validation_plan.hpp"

#include "apps/archive/tables/dictionary.hpp"
#include "apps/model/effects.hpp"
#include "apps/scene/toml/document.hpp"
#include "apps/scene/toml/schema_parts.hpp"
#include "apps/studies/plan_file.hpp"
#include "apps/support/statistics.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace listric {

using namespace dem;

namespace {

/// The names of an enumeration's values, in their order.
const std::vector<std::string_view> kinds = {"faults", "kinematics", "conservation"};
const std::vector<std::string_view> verdicts = {"no run yet", "reported",  "no case", "shown",
                                                "open",       "not shown", "met",     "missed"};

/// A run as the file says it.
struct RunText {
    ValidationRun run;
    std::string set, without;
};

PlanTable<RunText> run_table() {
    using T = RunText;
    using R = ValidationRun;
    return {"runs, a folder for each seed",
            {plan_key("name", at<&T::run, &R::name>, "name of the folders"),
             plan_key("scene", at<&T::run, &R::scene>, "scene that is run"),
             plan_key("set", at<&T::set>, "changes, table.key=value"),
             plan_key("without", at<&T::without>, "tables taken out"),
             plan_key("seeds", at<&T::run, &R::seeds>, "0: all", between(0, 1000)),
             plan_key("accuracy", at<&T::run, &R::accuracy>, "if always the same"),
             plan_key("at_m", at<&T::run, &R::at>, "measured there; with stages the wall's way",
                      between(0, 1e6), "m")},
            {"name", "scene", "at_m"}};
}

ValidationRun read_run(const Entry& entry) {
    RunText text = run_table().read(entry);
    need_name(entry, "name", text.run.name);
    text.run.set = words(text.set);
    text.run.without = words(text.without);
    return text.run;
}

PlanTable<Expectation> expectation_table() {
    using E = Expectation;
    return {"rows of the table",
            {plan_key("kind", one_of<&E::kind>(kinds), "kind of the row"),
             plan_key("measure", at<&E::measure>, "name"),
             plan_key("over", at<&E::over>, "measure by which it is divided"),
             plan_key("what", at<&E::what>, "for people"),
             plan_key("run", at<&E::run>, "default: the first"),
             plan_key("minus", at<&E::minus>, "run whose value is taken off"),
             plan_key("at_m", at<&E::at>, "extension", between(0, 1e6), "m"),
             plan_key("since_m", at<&E::since>, "extension taken off", between(0, 1e6), "m"),
             plan_key("mean_from_m", at<&E::mean_from>,
                      "mean over the run's at_m from here to the row's", between(0, 1e6), "m"),
             plan_key("of_mean", at<&E::of_mean>, "the mean over the seeds is judged, not each"),
             plan_key("unit", at<&E::unit>, "value over this is shown", {.above = 0}),
             plan_key("digits", at<&E::digits>, "after the point", between(0, 9)),
             plan_key("expected", at<&E::expected>, "value of the source"),
             plan_key("tolerance", at<&E::tolerance>, "most that a value may differ from it",
                      {.from = 0}),
             plan_key("least", at<&E::least>, "least value"),
             plan_key("most", at<&E::most>, "greatest value"),
             plan_key("words", at<&E::words>, "quoted: what says so"),
             plan_key("source", at<&E::source>, "figure and moment, or formula"),
             plan_key("reason", at<&E::reason>, "why it has no verdict")},
            {"measure", "what"}};
}

Expectation read_expectation(const Entry& entry) {
    Expectation e = expectation_table().read(entry);
    if (e.expected && (e.least || e.most))
        fail(entry, "has expected and least or most: one or the other");
    if (e.least && e.most && *e.least > *e.most)
        fail(entry, "has a least that is above most, which no value meets");
    if (e.is_judged() && !e.reason.empty())
        fail(entry, "has bounds and a reason to have none: one or the other");
    if (e.of_mean && e.kind == Expectation::Kind::faults)
        fail(entry, "of_mean: a row of faults counts seeds; give kind = \"kinematics\"");
    if (e.mean_from && e.since)
        fail(entry, "has mean_from_m and since_m: one or the other");
    return e;
}

PlanTable<ValidationPicture> picture_table() {
    return {"pictures of states",
            {plan_key("name", at<&ValidationPicture::name>, "name of the file"),
             plan_key("caption", at<&ValidationPicture::caption>, "below it")},
            {"name"},
            {"rows"}};
}

PlanTable<ValidationPicture::Row> picture_row_table() {
    using Row = ValidationPicture::Row;
    return {"states below each other",
            {plan_key("run", at<&Row::run>, "drawn"),
             plan_key("at_m", at<&Row::at>, "extension", between(0, 1e6), "m"),
             plan_key("seeds", at<&Row::seeds>, "0: all", between(0, 1000))}};
}

ValidationPicture read_picture(const Entry& entry) {
    ValidationPicture picture = picture_table().read(entry);
    need_name(entry, "name", picture.name);
    for (const Entry& item : tables(entry, "rows"))
        picture.rows.push_back(picture_row_table().read(item));
    return picture;
}

PlanTable<DroppedRow> dropped_table() {
    return {"rows that are no more",
            {plan_key("what", at<&DroppedRow::what>, "row that was"),
             plan_key("asked", at<&DroppedRow::asked>, "expected once"),
             plan_key("reason", at<&DroppedRow::reason>, "why it is no more")},
            {"what", "reason"}};
}

/// Seeds of a key that may be absent. Throws SceneError.
std::vector<int> read_seeds(const Entry& entry, const char* key, const std::string& text) {
    if (text.empty())
        return {};
    if (const auto seeds = seed_list(text))
        return *seeds;
    fail({*entry.node.as_table()->get(key), entry.path.empty() ? key : entry.path + "." + key},
         fmt::format("{} is no list of seeds, such as 51-56,60", text));
}

/// An experiment as the file says it.
struct ExperimentText {
    ValidationExperiment experiment;
    std::string runs, seen_of;
};

PlanTable<ExperimentText> experiment_table() {
    using T = ExperimentText;
    using X = ValidationExperiment;
    return {"what is expected of them",
            {plan_key("name", at<&T::experiment, &X::name>, "for --only"),
             plan_key("title", at<&T::experiment, &X::title>, "heading"),
             plan_key("about", at<&T::experiment, &X::about>, "before the table"),
             plan_key("seen", at<&T::experiment, &X::seen>, "in the pictures"),
             plan_key("seen_of", at<&T::seen_of>, "seeds of these pictures"),
             plan_key("runs", at<&T::runs>, "names of runs; the first is judged"),
             plan_key("like", at<&T::experiment, &X::like>, "has this one's expectations, too"),
             plan_key("compare", at<&T::experiment, &X::compare>, "run whose values stand beside")},
            {"name", "runs"},
            {"expect", "dropped", "picture"}};
}

/// Expectations of an experiment for other runs in the places of its own. Without those that
/// ask for more runs than there are: a control, say.
std::vector<Expectation> expectations_of(const ValidationExperiment& experiment,
                                         const std::vector<std::string>& runs) {
    const auto replace = [&](std::string& name) {
        const auto place = static_cast<std::size_t>(std::ranges::find(experiment.runs, name) -
                                                    experiment.runs.begin());
        if (place < runs.size())
            name = runs[place];
        return place < runs.size();
    };
    std::vector<Expectation> expectations;
    for (Expectation e : experiment.expectations)
        if (replace(e.run) && (e.minus.empty() || replace(e.minus))) {
            e.is_shared = true;
            expectations.push_back(std::move(e));
        }
    return expectations;
}

/// @param before         experiments whose expectations this one may share
/// @param check_measure  refuses a name
ValidationExperiment
read_experiment(const Entry& entry, const std::vector<ValidationExperiment>& before,
                const std::function<void(const Entry&, const std::string&)>& check_measure) {
    ExperimentText text = experiment_table().read(entry);
    ValidationExperiment& x = text.experiment;
    x.runs = words(text.runs);
    x.seen_of = read_seeds(entry, "seen_of", text.seen_of);
    if (!x.like.empty()) {
        const auto other = std::ranges::find(before, x.like, &ValidationExperiment::name);
        if (other == before.end())
            fail(entry, fmt::format("like: no experiment {} before this one", x.like));
        x.expectations = expectations_of(*other, x.runs);
    }
    for (const Entry& item : tables(entry, "expect")) {
        x.expectations.push_back(read_expectation(item));
        for (const auto& [key, name] : {std::pair{"measure", x.expectations.back().measure},
                                        std::pair{"over", x.expectations.back().over}})
            if (!name.empty())
                check_measure(
                    {*item.node.as_table()->get(key), fmt::format("{}.{}", item.path, key)}, name);
        if (x.expectations.back().run.empty())
            x.expectations.back().run = x.runs.front();
    }
    std::ranges::stable_sort(x.expectations, {}, &Expectation::kind);
    for (const Entry& item : tables(entry, "dropped"))
        x.dropped.push_back(dropped_table().read(item));
    for (const Entry& item : tables(entry, "picture"))
        x.pictures.push_back(read_picture(item));
    return x;
}

/// Names of the effects that any of the runs has.
std::vector<std::string> effects_of(const ValidationPlan& plan) {
    std::vector<std::string> names;
    for (const ValidationRun& run : plan.runs)
        for (std::string& name :
             effect_names(load_scene({.scene = run.scene, .set = run.set, .without = run.without})))
            names.push_back(std::move(name));
    return names;
}

/// Refuses a moment at which a run is not measured.
/// @param what  asks for it, with its verb: "expects weak_fraction"
void need_moment(const ValidationPlan& plan, const Entry& entry, const std::string& what,
                 const std::string& run, double at) {
    const std::vector<double>& moments = plan.run(run).at;
    if (std::ranges::find(moments, at) == moments.end())
        fail(entry,
             fmt::format("{} of {} at {:g} m, where that run is not measured; its at_m: {:g}", what,
                         run, at, fmt::join(moments, ", ")));
}

/// A plan's own keys.
struct ValidationText {
    std::string extends, seeds;
};

PlanTable<ValidationText> validation_table() {
    return {"",
            {plan_key("extends", at<&ValidationText::extends>, "a plan"),
             plan_key("seeds", at<&ValidationText::seeds>, "of the record")},
            {},
            {"run", "experiment"}};
}

/// @param extended  by another: then it cannot extend a third, or itself
ValidationPlan read_plan(const std::filesystem::path& file, bool extended) {
    const toml::table document = read_document(validation_plans, file);
    const Entry top{document, ""};
    const ValidationText text = validation_table().read(top);
    ValidationPlan plan;
    plan.seeds = read_seeds(top, "seeds", text.seeds);
    std::vector<ValidationExperiment> known; // that others can be like
    if (const std::string& other = text.extends; !other.empty()) {
        if (extended)
            fail({*document.get("extends"), "extends"}, "is of a plan that is extended itself");
        known = read_plan(validation_plans.find(
                              is_path(other) ? (file.parent_path() / other).string() : other),
                          true)
                    .experiments;
    }
    int runs = 0;
    for (const Entry& entry : tables(top, "run")) {
        plan.runs.push_back(read_run(entry));
        const std::string& name = plan.runs.back().name;
        if (std::ranges::count(plan.runs, name, &ValidationRun::name) > 1)
            fail(entry, fmt::format("name: another run is named {}", name));
        runs += std::max(1, plan.runs.back().seeds);
        if (runs > most_runs)
            fail(entry, fmt::format("is beyond {} runs, the most that a plan may have", most_runs));
    }
    const auto check = [&](const Entry& entry, const std::string& name) {
        std::vector<std::string_view> names;
        for (const ValidationRun& run : plan.runs)
            names.push_back(run.name);
        if (!name.empty() && std::ranges::find(names, name) == names.end())
            fail(entry, fmt::format("no run {}, {}", name, advice(name, names)));
    };
    std::optional<std::vector<std::string>> on; // effects of any run
    const auto check_measure = [&](const Entry& entry, const std::string& name) {
        if (archive::objection_to_measure(name, true, {}, program_effects()).empty())
            return;
        if (!on)
            on = effects_of(plan);
        const std::string why = archive::objection_to_measure(name, true, *on, program_effects());
        if (!why.empty())
            fail(entry, fmt::format("{} {}", name, why));
    };
    const auto check_moments = [&](const Entry& entry, const Expectation& e) {
        const double at = e.at.value_or(plan.run(e.run).at.back());
        need_moment(plan, entry, "expects " + e.measure, e.run, at);
        if (!e.minus.empty())
            need_moment(plan, entry, "expects " + e.measure, e.minus, at);
        for (const auto& other : {e.since, e.mean_from})
            if (other)
                need_moment(plan, entry, "expects " + e.measure, e.run, *other);
    };
    for (const Entry& entry : tables(top, "experiment")) {
        const ValidationExperiment x = read_experiment(entry, known, check_measure);
        known.push_back(x);
        plan.experiments.push_back(x);
        for (const std::string& name : x.runs)
            check(entry, name);
        check(entry, x.compare);
        for (const Expectation& e : x.expectations) {
            check(entry, e.run);
            check(entry, e.minus);
            if (!e.is_shared) // others' runs may be measured elsewhere
                check_moments(entry, e);
        }
        for (const ValidationPicture& picture : x.pictures)
            for (const auto& row : picture.rows) {
                need(entry, "run in rows of its pictures", !row.run.empty());
                check(entry, row.run);
                need_moment(plan, entry, "has picture " + picture.name, row.run, row.at);
            }
    }
    return plan;
}

} // namespace

const ValidationRun& ValidationPlan::run(const std::string& name) const {
    return *std::ranges::find(runs, name, &ValidationRun::name);
}

ValidationPlan load_validation_plan(const std::filesystem::path& file) {
    return read_plan(file, false);
}

std::string validation_schema() {
    nlohmann::ordered_json schema = validation_table().schema();
    schema["properties"]["run"] = run_table().array_schema();
    schema["properties"]["experiment"] = experiment_table().array_schema();
    auto& parts = schema["properties"]["experiment"]["items"]["properties"];
    parts["expect"] = expectation_table().array_schema();
    for (const char* key : {"measure", "over"})
        parts["expect"]["items"]["properties"][key].update(
            measure_schema(MeasuredAt::any_snapshot));
    parts["dropped"] = dropped_table().array_schema();
    parts["picture"] = picture_table().array_schema();
    parts["picture"]["items"]["properties"]["rows"] = picture_row_table().array_schema();
    return finished_schema("A validation plan of Listric", schema);
}

bool Expectation::meets(double value) const {
    if (expected && std::abs(value - *expected) > tolerance)
        return false;
    return !(least && value < *least) && !(most && value > *most);
}

std::string Expectation::target() const {
    const auto number = [&](double value) { return fmt::format("{:.{}f}", value, digits); };
    if (expected)
        return fmt::format("{} ± {}", number(*expected), number(tolerance));
    if (least && most)
        return fmt::format("{} to {}", number(*least), number(*most));
    if (least)
        return "at least " + number(*least);
    if (most)
        return "at most " + number(*most);
    return "–";
}

std::vector<double> Expectation::moments_of(const ValidationRun& of, double last) const {
    if (!mean_from)
        return {last};
    std::vector<double> moments;
    std::ranges::copy_if(of.at, std::back_inserter(moments),
                         [&](double moment) { return moment >= *mean_from && moment <= last; });
    return moments;
}

std::string_view name_of(Expectation::Kind kind) { return kinds[static_cast<std::size_t>(kind)]; }

std::string_view name_of(Verdict::Name name) { return verdicts[static_cast<std::size_t>(name)]; }

Verdict judge(const Expectation& e, std::span<const std::optional<double>> values) {
    using enum Verdict::Name;
    Verdict v;
    for (const auto& value : values) {
        v.of += value.has_value();
        v.no_case += !value;
        v.met += value && e.meets(*value);
    }
    double mean = 0.0;
    for (const auto& value : values)
        mean += value.value_or(0.0) / std::max(v.of, 1);
    if (e.of_mean)
        v.met = e.meets(mean) ? v.of : 0;
    const auto [lower, upper] = probability_limits(v.met, v.of);
    const bool often = e.kind == Expectation::Kind::faults;
    if (values.empty())
        v.name = no_run;
    else if (!e.is_judged())
        v.name = reported;
    else if (v.of == 0)
        v.name = no_case;
    else if (often)
        v.name = lower > 0.5 ? shown : upper < 0.5 ? not_shown : open;
    else
        v.name = v.met == v.of ? met : missed;
    v.text = name_of(v.name);
    if (e.is_judged() && v.of > 0) {
        v.text +=
            e.of_mean ? fmt::format(" (mean of {}", v.of) : fmt::format(" ({} of {}", v.met, v.of);
        v.text += often ? fmt::format(": {:.2f} to {:.2f})", lower, upper) : ")";
        if (v.no_case > 0)
            v.text += fmt::format(", {} no case", v.no_case);
    }
    return v;
}

} // namespace listric
