#include "apps/studies/sweep/sweep_plan.hpp"

#include "apps/archive/tables/dictionary.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/forecast/oversize.hpp"
#include "apps/scene/toml/document.hpp"
#include "apps/scene/toml/schema_parts.hpp"
#include "apps/studies/dataset/dataset_settings.hpp"
#include "apps/studies/plan_file.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/number.hpp"
#include "apps/support/words/text.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/random.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace listric {

namespace {

constexpr Shelf shelf{"sweep plan", "it needs scene, measures and [[vary]]", "", "studies"};

/// Runs of a plan without its parameters and measures.
struct SweepPlanText {
    SweepPlan plan;
    std::string set, without;
};

PlanTable<SweepPlanText> plan_table() {
    using T = SweepPlanText;
    using P = SweepPlan;
    constexpr double most = most_runs;
    return {
        "",
        {plan_key("scene", at<&T::plan, &P::scene>, "scene that is run"),
         plan_key("accuracy", at<&T::plan, &P::accuracy>, "level; empty: the scene's"),
         plan_key("set", at<&T::set>, "changes for every run, table.key=value"),
         plan_key("without", at<&T::without>, "tables taken out of every run"),
         plan_key("seeds", at<&T::plan, &P::seeds>, "number of runs per point", between(1, 1000)),
         plan_key("first_seed", at<&T::plan, &P::first_seed>, "first of the seeds",
                  between(0, 1e9)),
         plan_key("own_seeds", at<&T::plan, &P::own_seeds>,
                  "whether each point has seeds of its own, as an emulator wants: no packing is "
                  "shared"),
         plan_key("design", one_of<&T::plan, &P::design>({"grid", "list", "latin-hypercube"}),
                  "how values are combined"),
         plan_key("samples", at<&T::plan, &P::samples>, "number of points of a Latin hypercube",
                  between(0, most))},
        {},
        {"measures", "vary", dataset_table}};
}

PlanTable<SweepParameter> varied_table() {
    return {"parameters that vary",
            {plan_key("parameter", at<&SweepParameter::name>, "table.key of what varies")},
            {"parameter"},
            {"values", "range", "sets"}};
}

/// @param name  of the parameter
SweepValue value_of(const Entry& entry, const std::string& name) {
    if (const auto* word = entry.node.as_string()) {
        if (word->get().find_first_of(",\"") != std::string::npos ||
            shown(word->get()) != word->get())
            fail(entry,
                 "a comma, a quotation mark or a control character does not fit into a table");
        return {word->get(), {name + "=" + quoted(word->get())}, std::nullopt};
    }
    if (const auto* yes = entry.node.as_boolean()) {
        const std::string text = yes->get() ? "true" : "false";
        return {text, {name + "=" + text}, std::nullopt};
    }
    const auto number = entry.node.value<double>();
    if (!entry.node.is_number() || !number || !std::isfinite(*number))
        fail_type(entry, "a number, a string, true or false");
    const std::string text = fmt::format("{}", *number);
    return {text, {name + "=" + text}, number};
}

/// The elements of an array.
std::vector<Entry> elements(const Entry& entry, std::string_view allowed) {
    if (!entry.node.is_array())
        fail_type(entry, allowed);
    std::vector<Entry> all;
    for (const toml::node& node : *entry.node.as_array())
        all.push_back({node, fmt::format("{}[{}]", entry.path, all.size())});
    return all;
}

/// A value between the ends of a range, in six digits, or in as many more as a narrow range has.
SweepValue value_between(const SweepParameter& parameter, double share) {
    const auto [least, greatest] = *parameter.range;
    const double narrowness = std::max(-least, greatest) / (greatest - least);
    const int digits =
        6 + static_cast<int>(dem::logarithm_to_base_10(std::clamp(narrowness, 1.0, 1e11)));
    const std::string text = fmt::format("{:.{}g}", std::lerp(least, greatest, share), digits);
    return {text, {parameter.name + "=" + text}, parse_number(text)};
}

/// Refuses a parameter that the plan itself sets for every run.
void check_parameter(const Entry& entry, const SweepPlan& plan, const std::string& name) {
    const Entry place{*entry.node.as_table()->get("parameter"), entry.path + ".parameter"};
    if (name == "seed")
        fail(place, "the seed varies by the plan's seeds and first_seed; give those");
    if (name == "accuracy" && !plan.accuracy.empty())
        fail(place, fmt::format("beside accuracy = \"{}\", which holds for every run; leave out "
                                "one of the two",
                                plan.accuracy));
}

/// The scene of a point. Throws SceneError if there is none, or too large a one.
Scene try_point(const SweepPlan& plan, const SweepPoint& point) {
    Scene scene = scene_at(plan, point, plan.first_seed);
    if (const auto oversize = oversize_of(scene, program_effects(), room_for(".")))
        throw SceneError(fmt::format("{}: {}", oversize->parameter, oversize->message));
    return scene;
}

/// Refuses a value that the scene refuses. Returns the scene as it is with that value.
std::string try_value(const SweepPlan& plan, const Entry& entry, const SweepParameter& parameter,
                      const SweepValue& value, std::string_view cure = "") {
    SweepPlan alone = plan;
    alone.parameters = {parameter};
    try {
        return to_toml(try_point(alone, {value}));
    } catch (const SceneError& error) {
        fail(entry, fmt::format("{}{}", error.what(), cure));
    }
}

/// Takes what each value of a parameter changes from `sets`; the parameter is then a word of the
/// plan's.
void take_changes(const Entry& sets, SweepParameter& parameter) {
    const std::vector<Entry> given = elements(sets, "an array of texts, changes for each value");
    if (given.size() != parameter.values.size())
        fail(sets, fmt::format("needs as many texts as there are values, {}; it has {}",
                               parameter.values.size(), given.size()));
    for (std::size_t k = 0; k < given.size(); ++k) {
        const auto* const text = given[k].node.as_string();
        if (!text)
            fail_type(given[k], "a text, changes such as \"detachment.friction=0.2\"");
        parameter.values[k].changes = words(text->get());
        for (const std::string& word : parameter.values[k].changes)
            if (word.starts_with("seed="))
                fail(given[k], fmt::format("{}: every run has a seed of the plan's; give seeds and "
                                           "first_seed",
                                           word));
    }
}

SweepParameter read_parameter(const Entry& entry, const SweepPlan& plan) {
    SweepParameter parameter = varied_table().read(entry);
    check_parameter(entry, plan, parameter.name);
    const toml::table& table = *entry.node.as_table();
    const bool is_range = table.contains("range");
    if (is_range == table.contains("values"))
        fail(entry, "needs either values or range");
    if (is_range && table.contains("sets"))
        fail({*table.get("sets"), entry.path + ".sets"}, "is for values; a range needs none");
    const char* const key = is_range ? "range" : "values";
    const Entry list{*table.get(key), fmt::format("{}.{}", entry.path, key)};
    if (is_range && plan.design != SweepDesign::latin_hypercube)
        fail(list, "is for design = \"latin-hypercube\"; a grid or a list needs values");
    const std::vector<Entry> given =
        elements(list, is_range ? "[least, greatest]" : "an array of values");
    if (is_range && given.size() != 2)
        fail(list, "needs two numbers, [least, greatest]");
    if (given.empty())
        fail(list, "is empty, needs at least one value");
    for (const Entry& value : given)
        parameter.values.push_back(value_of(value, parameter.name));
    if (const toml::node* const sets = table.get("sets"))
        take_changes({*sets, entry.path + ".sets"}, parameter);
    if (is_range) {
        const auto least = parameter.values[0].number, greatest = parameter.values[1].number;
        if (!least || !greatest || !(*least < *greatest))
            fail(list, "needs two numbers, the first less than the second");
        parameter.range = {*least, *greatest};
    }
    std::map<std::string, std::string> known; // by the scene that they make; of a list none need do
    for (std::size_t k = 0; k < given.size() && plan.design != SweepDesign::list; ++k) {
        const std::string& text = parameter.values[k].text;
        const auto [earlier, is_new] =
            known.emplace(try_value(plan, given[k], parameter, parameter.values[k]), text);
        if (!is_new)
            fail(given[k], earlier->second == text
                               ? std::string("stands twice; leave one out")
                               : fmt::format("makes the same run as {}: {} has no effect in this "
                                             "scene; leave one out",
                                             earlier->second, parameter.name));
    }
    if (is_range) {
        try_value(plan, list, parameter, value_between(parameter, 1.0 / std::numbers::pi),
                  "; a range takes values between its ends, values = [...] only those listed");
        parameter.values.clear();
    }
    return parameter;
}

/// The moment of a measure, m: a length with its unit or, as the keys of a plan, in metres. What
/// varies may be the clock: then nobody knows the snapshots yet.
double read_moment(const Entry& entry, const SweepMeasure& measure, std::string_view moment,
                   const std::optional<Scene>& scene) {
    const Length length = read_length(moment);
    const auto metres = length.objection.empty() ? std::optional(length.metres)
                                                 : parse_number(moment); // as plans of before
    const auto example = [&](const char* text) { return fmt::format("{}@{}", measure.name, text); };
    if (!metres || !(*metres >= 0.0))
        fail(entry, fmt::format("after @ comes an extension in metres or with its unit, such as "
                                "{} or {}",
                                example("5000"), example("5km")));
    if (!scene)
        return *metres;
    const double interval = scene->output.interval, end = scene->extension.distance;
    const double near = 0.005 * interval;
    if (*metres > end + near)
        fail(entry, fmt::format("@{}: {:g} m is beyond the runs, which end at {:g} m", moment,
                                *metres, end));
    if (std::abs(std::remainder(*metres, interval)) > near && *metres < end - near)
        warn(fmt::format("{}: there is no snapshot at {:g} m, the nearest is taken: they come "
                         "every {:g} m (output.interval_m) and at the end, {:g} m",
                         measure.text, *metres, interval, end));
    return *metres;
}

/// @param scene  of all runs; none if its clock varies
SweepMeasure read_measure(const Entry& entry, const std::vector<std::string>& on,
                          const std::optional<Scene>& scene) {
    const auto* text = entry.node.as_string();
    if (!text)
        fail_type(entry, "the name of a measure, NAME or NAME@5km");
    SweepMeasure measure{text->get(), text->get(), std::nullopt};
    const std::size_t sign = measure.text.find('@');
    if (measure.text.empty() || measure.text.find_first_of(", \"") != std::string::npos ||
        shown(measure.text) != measure.text)
        fail(entry, "is no name of a measure (docs/reference/measures.md)");
    if (sign != std::string::npos) {
        measure.name = measure.text.substr(0, sign);
        measure.at = read_moment(entry, measure, measure.text.substr(sign + 1), scene);
    }
    const std::string objection =
        archive::objection_to_measure(measure.name, measure.at.has_value(), on, program_effects());
    if (!objection.empty())
        fail(entry, fmt::format("{} {}", measure.name, objection));
    return measure;
}

/// Refuses what cannot be combined.
void check_design(const Entry& top, const SweepPlan& plan) {
    const auto key = [&](const char* name) {
        const toml::node* node = top.node.as_table()->get(name);
        return node ? Entry{*node, name} : top;
    };
    if (plan.design == SweepDesign::latin_hypercube && plan.samples < 2)
        fail(key("design"), "a Latin hypercube needs samples, at least 2");
    if (plan.design != SweepDesign::latin_hypercube && plan.samples > 0)
        fail(key("samples"), "is for design = \"latin-hypercube\" alone");
    if (plan.design == SweepDesign::list)
        for (const SweepParameter& parameter : plan.parameters)
            if (parameter.values.size() != plan.parameters[0].values.size())
                fail(key("vary"),
                     fmt::format("a list needs as many values of each parameter: {} has {}, {} {}",
                                 plan.parameters[0].name, plan.parameters[0].values.size(),
                                 parameter.name, parameter.values.size()));
    if (plan.design != SweepDesign::list)
        return;
    std::map<std::string, std::size_t> known; // points by the scene that they make
    const std::vector<SweepPoint> points = sweep_points(plan);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Entry place = key("vary");
        const std::string name = name_of_point(plan, k, points[k]);
        std::string made;
        try {
            made = to_toml(try_point(plan, points[k]));
        } catch (const SceneError& error) {
            fail(place, fmt::format("{}: {}", name, error.what()));
        }
        if (const auto [earlier, is_new] = known.emplace(std::move(made), k); !is_new)
            fail(place, fmt::format("{} makes the same run as {}; leave one out", name,
                                    name_of_point(plan, earlier->second, points[earlier->second])));
    }
}

/// How many values an entry of [[vary]] lists; one where it lists none.
double values_listed(const Entry& entry) {
    const toml::table* const table = entry.node.as_table();
    const toml::node* const values = table ? table->get("values") : nullptr;
    return values && values->is_array()
               ? std::max(1.0, static_cast<double>(values->as_array()->size()))
               : 1.0;
}

/// Refuses more runs than anybody makes, before one of them takes memory.
void check_number(const Entry& top, const SweepPlan& plan, const std::vector<Entry>& varied) {
    double points = plan.design == SweepDesign::latin_hypercube ? plan.samples : 1.0;
    for (const Entry& entry : varied)
        if (plan.design == SweepDesign::grid)
            points *= values_listed(entry);
        else
            points = std::max(points, values_listed(entry));
    constexpr auto most = static_cast<double>(most_runs);
    const double runs = points * plan.seeds;
    if (runs <= most)
        return;
    const char* const cause = plan.design == SweepDesign::latin_hypercube ? "samples"
                              : points > most                             ? "vary"
                                                                          : "seeds";
    const toml::node* const node = top.node.as_table()->get(cause);
    fail(node ? Entry{*node, cause} : top,
         fmt::format("makes {:.10g} runs, {:.10g} points with {} seeds each; allowed: at most {}",
                     runs, points, plan.seeds, most_runs));
}

/// Places of a Latin hypercube's samples along one parameter: each of 0 .. samples - 1 once.
std::vector<std::size_t> shuffled(std::size_t samples, std::size_t parameter) {
    std::vector<std::size_t> order(samples);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](std::size_t k) {
        return dem::random_bits(0, dem::Purpose::sweep_order, parameter, k);
    });
    return order;
}

} // namespace

bool SweepPlan::needs_moments() const {
    return makes_dataset ||
           std::ranges::any_of(measures, [](const SweepMeasure& m) { return m.at.has_value(); });
}

std::filesystem::path plan_file(const std::filesystem::path& name_or_path) {
    const std::string given = name_or_path.string();
    return is_path(given) || std::filesystem::exists(name_or_path) ? name_or_path
                                                                   : shelf.find(given);
}

SweepPlan load_sweep_plan(const std::filesystem::path& name_or_path) {
    const std::filesystem::path file = plan_file(name_or_path);
    const toml::table document = read_document(shelf, file);
    const Entry top{document, ""};
    SweepPlanText text = plan_table().read(top);
    SweepPlan& plan = text.plan;
    plan.name = file.stem().string();
    if (const std::string why = objection_to_name("sweep-" + plan.name); !why.empty())
        fail(fmt::format("{}:1: the plan's file name {}; rename it", file.string(), why));
    plan.set = words(text.set);
    plan.without = words(text.without);
    for (const std::string& word : plan.set)
        if (word.starts_with("seed="))
            fail({*document.get("set"), "set"},
                 fmt::format("{}: every run has a seed of the plan's; give seeds and first_seed",
                             word));
    need(top, "scene", !plan.scene.empty());
    if (is_path(plan.scene))
        plan.scene = (file.parent_path() / plan.scene).string();
    std::optional<Scene> scene = scene_at(plan, {}, plan.first_seed);
    std::vector<std::string> on = effect_names(*scene);
    for (const Entry& entry : tables(top, "vary")) { // "table.key" switches an effect on
        const std::string name = entry.node.as_table()->get_as<std::string>("parameter")
                                     ? **entry.node.as_table()->get_as<std::string>("parameter")
                                     : std::string();
        on.push_back(name.substr(0, name.find('.')));
        if (on.back() == "output" || on.back() == "extension" || on.back().starts_with("stage"))
            scene.reset();
    }
    const toml::node* const measures = document.get("measures");
    need(top, "measures", measures);
    for (const Entry& element : elements({*measures, "measures"}, "an array of names of measures"))
        plan.measures.push_back(read_measure(element, on, scene));
    const std::vector<Entry> varied = tables(top, "vary");
    need(top, "[[vary]]", !varied.empty());
    check_number(top, plan, varied);
    for (const Entry& entry : varied) {
        const SweepParameter parameter = read_parameter(entry, plan);
        if (std::ranges::find(plan.parameters, parameter.name, &SweepParameter::name) !=
            plan.parameters.end())
            fail(entry, fmt::format("{} is varied already", parameter.name));
        plan.parameters.push_back(parameter);
    }
    check_design(top, plan);
    plan.makes_dataset = document.contains(dataset_table);
    return plan;
}

std::vector<SweepPoint> sweep_points(const SweepPlan& plan) {
    std::vector<SweepPoint> points;
    if (plan.design == SweepDesign::grid) {
        points.emplace_back();
        for (const SweepParameter& parameter : plan.parameters) {
            std::vector<SweepPoint> longer;
            for (const SweepPoint& point : points)
                for (const SweepValue& value : parameter.values) {
                    longer.push_back(point);
                    longer.back().push_back(value);
                }
            points = std::move(longer);
        }
        return points;
    }
    if (plan.design == SweepDesign::list) {
        points.resize(plan.parameters[0].values.size());
        for (std::size_t k = 0; k < points.size(); ++k)
            for (const SweepParameter& parameter : plan.parameters)
                points[k].push_back(parameter.values[k]);
        return points;
    }
    // Centred in their parts of the range (McKay, Beckman & Conover 1979 draw them within).
    points.resize(static_cast<std::size_t>(plan.samples));
    for (std::size_t p = 0; p < plan.parameters.size(); ++p) {
        const SweepParameter& parameter = plan.parameters[p];
        const std::vector<std::size_t> place = shuffled(points.size(), p);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const double share =
                (static_cast<double>(place[k]) + 0.5) / static_cast<double>(points.size());
            points[k].push_back(parameter.range
                                    ? value_between(parameter, share)
                                    : parameter.values[static_cast<std::size_t>(
                                          share * static_cast<double>(parameter.values.size()))]);
        }
    }
    return points;
}

std::string name_of_point(const SweepPlan& plan, std::size_t k, const SweepPoint& point,
                          std::string_view seed) {
    std::string text = fmt::format("run {}{}", k + 1, seed);
    for (std::size_t p = 0; p < plan.parameters.size(); ++p)
        text += fmt::format(", {}={}", plan.parameters[p].name, point[p].text);
    return text;
}

std::vector<std::string> check_points(const SweepPlan& plan, std::span<const SweepPoint> points,
                                      const std::filesystem::path& file) {
    std::vector<std::string> warnings;
    std::set<std::string> known; // a point tells what no point before it did
    for (std::size_t k = 0; k < points.size(); ++k)
        try {
            for (const std::string& warning : try_point(plan, points[k]).warnings)
                if (known.insert(warning).second)
                    warnings.push_back(
                        fmt::format("{}: {}", name_of_point(plan, k, points[k]), warning));
        } catch (const SceneError& error) {
            fail(fmt::format("{}: {}: {}", file.string(), name_of_point(plan, k, points[k]),
                             error.what()));
        }
    return warnings;
}

Scene scene_at(const SweepPlan& plan, const SweepPoint& point, std::int64_t seed) {
    SceneRequest request{plan.scene, plan.set, plan.without, {}, seed};
    if (!plan.accuracy.empty())
        request.accuracy = plan.accuracy;
    for (std::size_t k = 0; k < point.size(); ++k)
        request.set.insert(request.set.end(), point[k].changes.begin(), point[k].changes.end());
    return load_scene(request);
}

std::string sweep_schema() {
    using Json = nlohmann::ordered_json;
    const auto at_least = [](Json array, int least) {
        array["minItems"] = least;
        return array;
    };
    Json varied = varied_table().schema();
    Json& properties = varied["properties"];
    properties["values"] =
        at_least(array_of("values to try", {{"type", {"number", "string", "boolean"}}}), 1);
    properties["range"] =
        at_least(array_of("least and greatest, for a Latin hypercube", {{"type", "number"}}), 2);
    properties["range"]["maxItems"] = 2;
    properties["sets"] = array_of("changes of the scene that each value stands for, as in set",
                                  {{"type", "string"}});
    varied["oneOf"] = Json::array({{{"required", {"values"}}}, {{"required", {"range"}}}});

    Json schema = plan_table().schema();
    schema["properties"]["measures"] =
        at_least(array_of("measures of every run", measure_schema(MeasuredAt::end_or_snapshot)), 0);
    schema["properties"][dataset_table] = dataset_schema();
    schema["properties"]["vary"] = at_least(array_of(varied_table().doc, varied), 1);
    schema["required"] = {"scene", "measures", "vary"};
    return finished_schema("A sweep plan of Listric", schema);
}

} // namespace listric
