#include "apps/commands/asked_accuracy.hpp"

#include "apps/archive/tables/dictionary.hpp"
#include "apps/commands/explain.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/accuracy.hpp"
#include "apps/studies/sweep/student.hpp"
#include "apps/studies/sweep/sweep_effects.hpp"
#include "apps/support/error.hpp"
#include "apps/support/machine/shell.hpp"
#include "apps/support/words/number.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace listric {

using archive::HeadlineMeasure;
using archive::KnownError;
using archive::RecordedRun;

namespace {

constexpr int most_seeds = 10;
constexpr double confidence = 0.9;
/// Measures of which a percentage alone is asked.
constexpr std::string_view geometry[] = {"tilt", "cutoff", "balance"};
constexpr std::string_view levels_asked[] = {"draft", "standard", "fine"};

struct Unit {
    std::string_view name;
    double factor;
};

/// A number above 0 with its unit; none: the text is no such number.
std::optional<double> with_unit(std::string_view text, std::span<const Unit> units) {
    for (const Unit& unit : units)
        if (text.size() > unit.name.size() && text.ends_with(unit.name))
            if (const auto number = parse_number(text.substr(0, text.size() - unit.name.size()));
                number && *number > 0.0 && *number * unit.factor < 1e15)
                return *number * unit.factor;
    return std::nullopt;
}

/// Units in which a measure's error may be asked; the first that ends the text counts.
std::vector<Unit> units_of(const std::string& key) {
    if (key.ends_with("_deg"))
        return {{"deg", 1.0}, {"°", 1.0}, {"", 1.0}};
    if (key.ends_with("_m2"))
        return {{"km2", 1e6}, {"m2", 1.0}};
    if (key.ends_with("_m"))
        return {{"km", 1e3}, {"m", 1.0}};
    return {{"", 1.0}};
}

std::string allowed_units(const std::string& key) {
    std::vector<std::string> names{"%"};
    for (const Unit& unit : units_of(key))
        names.push_back(unit.name.empty() ? "no unit" : std::string(unit.name));
    return fmt::format("{}", fmt::join(names, ", "));
}

std::vector<std::string_view> words_of_measures() {
    std::vector<std::string_view> words;
    for (const HeadlineMeasure& measure : archive::headline_measures())
        if (std::ranges::count(words, measure.word) == 0)
            words.push_back(measure.word);
    return words;
}

void add_targets(std::vector<ErrorTarget>& targets, const std::string& word,
                 const std::string& bound) {
    bool is_known = false;
    for (const HeadlineMeasure& measure : archive::headline_measures()) {
        if (measure.word != word && measure.key != word)
            continue;
        is_known = true;
        const bool is_share = bound.ends_with('%');
        const auto most =
            with_unit(bound, is_share ? std::vector<Unit>{{"%", 0.01}} : units_of(measure.key));
        if (!most)
            throw UsageError(
                fmt::format("--error {}={}: a number above 0 with one of these units: {}",
                            shown_start(word), shown_start(bound), allowed_units(measure.key)));
        targets.push_back({measure.key, *most, is_share});
    }
    if (is_known)
        return;
    const auto words = words_of_measures();
    const auto meant = nearest(word, words);
    throw UsageError(fmt::format("--error {}: no such measure; {}there are {}", shown_start(word),
                                 meant ? fmt::format("did you mean {}? ", *meant) : "",
                                 fmt::join(words, ", ")));
}

const KnownError& error_of(const AccuracyChoice& choice, const std::string& key) {
    return *std::ranges::find(choice.errors, key, &KnownError::key);
}

bool meets(const AccuracyChoice& choice, const ErrorTarget& target, int seeds) {
    const KnownError& error = error_of(choice, target.key);
    const auto promised = promised_error(error, seeds);
    const double scale = target.is_share ? std::abs(error.mean) : 1.0; // 0: the mean is not known
    return promised && scale > 0.0 && *promised <= target.most * scale;
}

AccuracyChoice with_seeds(AccuracyChoice choice, int seeds) {
    choice.seconds *= static_cast<double>(seeds) / choice.seeds;
    choice.seeds = seeds;
    return choice;
}

/// Level and pace of a choice.
std::string way_of(const AccuracyChoice& choice) {
    return fmt::format("{}, {:g} m/s, softness {:g}", choice.level, choice.pace.speed,
                       choice.pace.softness);
}

std::string name_of(const AccuracyChoice& choice) {
    return fmt::format("{}, {} seed{}: {}", way_of(choice), choice.seeds,
                       choice.seeds == 1 ? "" : "s", duration(choice.seconds));
}

/// Changes of a scene at the choice's level that make its runs as the choice's.
std::vector<std::string> changes_of(const AccuracyChoice& choice) {
    std::vector<std::string> changes{
        fmt::format("extension.speed_m_per_s={:g}", choice.pace.speed)};
    const AccuracyLevel& level = accuracy_level(choice.level);
    if (choice.pace.ramp != level.ramp)
        changes.push_back(fmt::format("extension.ramp_s={:g}", choice.pace.ramp));
    if (choice.pace.softness != level.softness)
        changes.push_back(fmt::format("cycle.softness={:g}", choice.pace.softness));
    return changes;
}

SceneRequest request_of(SceneRequest request, const AccuracyChoice& choice) {
    request.accuracy = choice.level;
    for (const std::string& change : changes_of(choice))
        request.set.push_back(change);
    return request;
}

/// A word of a call, in quotes where a shell would take it apart.
std::string shell_word(const std::string& word) {
    const bool is_plain = std::ranges::all_of(word, [](unsigned char letter) {
        return std::isalnum(letter) ||
               std::string_view("/._-+=,@%:").find(static_cast<char>(letter)) !=
                   std::string_view::npos;
    });
    return is_plain ? word : shell_quoted(word);
}

/// The call that makes such a run of the request.
std::string call_of(const AccuracyChoice& choice, const SceneRequest& request) {
    std::string call =
        fmt::format("listric run {} --accuracy {}", shell_word(request.scene), choice.level);
    for (const std::string& table : request.without)
        call += fmt::format(" --without {}", shell_word(table));
    for (const std::string& change : request.set)
        call += fmt::format(" --set {}", shell_word(change));
    for (const std::string& change : changes_of(choice))
        call += fmt::format(" --set {}", change);
    return request.seed ? fmt::format("{} --seed {}", call, *request.seed) : call;
}

/// Errors of a choice, a line for each measure, and where they come from.
std::string error_table(const AccuracyChoice& choice) {
    std::string text = fmt::format("  {:<50} {:>9} {:>12} {:>12} {:>12}\n", "error of", "below",
                                   "resolution", "speed", "seeds, ±");
    std::vector<std::string> sources;
    for (const HeadlineMeasure& measure : archive::headline_measures()) {
        const KnownError& error = error_of(choice, measure.key);
        const auto promised = promised_error(error, choice.seeds);
        text += fmt::format("  {:<50} {:>9}", archive::label_of(measure.key),
                            promised ? archive::error_text(measure.key, *promised) : "unknown");
        for (const auto& part : {error.resolution, error.speed, error.spread}) {
            text += fmt::format(" {:>12}",
                                part ? archive::error_text(measure.key, part->value) : "unknown");
            if (const auto source = part ? fmt::format("{}: {}", part->record, part->against) : "";
                part && std::ranges::count(sources, source) == 0)
                sources.push_back(source);
        }
        text += '\n';
    }
    text += fmt::format("  below: with a probability of {:.0f} %, for the mean over the seeds\n",
                        100.0 * confidence);
    for (const std::string& source : sources)
        text += fmt::format("  record: {}\n", source);
    return text;
}

/// The targets that a choice with most seeds misses, each with what it may promise.
std::string missed(const AccuracyChoice& choice, std::span<const ErrorTarget> targets) {
    std::vector<std::string> parts;
    for (const ErrorTarget& target : targets) {
        if (meets(choice, target, most_seeds))
            continue;
        const KnownError& error = error_of(choice, target.key);
        const auto promised = promised_error(error, most_seeds);
        std::vector<std::string> unknown;
        for (const auto& [part, name] :
             {std::pair(&error.resolution, "resolution"), std::pair(&error.speed, "speed"),
              std::pair(&error.spread, "spread")})
            if (!*part)
                unknown.emplace_back(name);
        parts.push_back(promised ? fmt::format("{} below {}", archive::label_of(target.key),
                                               archive::error_text(target.key, *promised))
                                 : fmt::format("{} unknown ({})", archive::label_of(target.key),
                                               fmt::join(unknown, ", ")));
    }
    return fmt::format("{}", fmt::join(parts, "; "));
}

/// Nothing recorded supports an answer; what() says why.
struct NoAnswer : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The choices of a call. Throws NoAnswer.
std::vector<AccuracyChoice> recorded_ways(const SceneRequest& request, int threads) {
    const Scene scene = load_scene(request);
    const std::string parameter = archive::departs_from_record(scene);
    if (parameter == "name")
        throw NoAnswer(fmt::format("runs of {} are not recorded", scene.name));
    if (!parameter.empty())
        throw NoAnswer(
            fmt::format("its {} is not the one of the recorded runs of {}", parameter, scene.name));
    const bool accounted = make_parts(scene).accounts_energy;
    const auto seconds = [&](const Scene& one) {
        // A tenth of a second each: sizes differ by far more than what that misses.
        return predict(one, measure_speed(estimated_discs(one), threads, 0.1, accounted)).seconds;
    };
    auto choices = recorded_choices(archive::recorded_runs(), request, seconds);
    if (choices.empty())
        throw NoAnswer(fmt::format("no run of {} to {:g} km of extension is recorded", scene.name,
                                   scene.extension.distance / 1e3));
    return choices;
}

/// Another choice that more time brings, if it lowers what is asked for, and of all errors more
/// than it raises: by a twentieth or more, less is chance.
/// @param targets  measures that count; none: all
std::string bought(const AccuracyChoice& now, const std::optional<AccuracyChoice>& more,
                   std::span<const ErrorTarget> targets) {
    constexpr const char* nothing = " buys no smaller errors by what is recorded\n";
    if (!more)
        return nothing;
    std::size_t lower = 0;
    int lower_of_asked = 0; // less those that are higher
    std::vector<std::string_view> higher;
    for (const KnownError& error : now.errors) {
        const auto before = promised_error(error, now.seeds);
        const auto after = promised_error(error_of(*more, error.key), more->seeds);
        if (!before || !after)
            continue;
        const bool is_asked =
            targets.empty() || std::ranges::count(targets, error.key, &ErrorTarget::key) > 0;
        if (*after < 0.95 * *before) {
            ++lower;
            lower_of_asked += is_asked;
        } else if (*after > 1.05 * *before) {
            higher.push_back(archive::label_of(error.key));
            lower_of_asked -= is_asked;
        }
    }
    if (lower_of_asked <= 0 || lower <= higher.size())
        return nothing;
    const std::string but =
        higher.empty() ? "" : fmt::format("  larger: {}\n", fmt::join(higher, "; "));
    return fmt::format(" buys\n  {}\n{}{}", name_of(*more), error_table(*more), but);
}

/// The choice that a call asks for. Throws NoAnswer.
AccuracyChoice answer_to(const AskedAccuracy& asked, std::span<const AccuracyChoice> choices,
                         int seeds_of_time) {
    const double time = asked.within.empty() ? 0.0 : parse_duration("--within", asked.within);
    if (asked.error.empty()) {
        const auto best = best_choice(choices, time);
        if (!best)
            throw NoAnswer(fmt::format("the quickest recorded way takes {}",
                                       duration(choices.front().seconds)));
        return with_seeds(*best, std::min(best->seeds, seeds_of_time));
    }
    const std::vector<ErrorTarget> targets = parse_error_targets(asked.error);
    const auto cheapest = cheapest_choice(choices, targets);
    if (!cheapest) {
        std::string text = "what is recorded stays short of it:\n";
        for (const AccuracyChoice& choice : choices)
            text += fmt::format("  {}, up to {} seeds: {}\n", way_of(choice), most_seeds,
                                missed(choice, targets));
        throw NoAnswer(text);
    }
    if (time > 0.0 && cheapest->seconds > time)
        throw NoAnswer(fmt::format("it takes {}", name_of(*cheapest)));
    return *cheapest;
}

void refuse_level(const SceneRequest& request) {
    if (request.accuracy)
        throw UsageError(fmt::format("--accuracy {}: --within and --error choose the level; leave "
                                     "one of them out",
                                     *request.accuracy));
    for (const std::string& change : request.set)
        for (const std::string_view chosen : {"extension.speed_m_per_s", "extension.ramp_s",
                                              "cycle.softness", "hanging_wall.mean_radius_m"})
            if (change.substr(0, change.find('=')) == chosen)
                throw UsageError(fmt::format("--set {}: --within and --error choose {}; leave one "
                                             "of them out",
                                             shown_start(change), chosen));
}

/// Lines as one.
std::string one_line(const std::string& text) {
    std::string line;
    for (const char letter : text)
        if (letter != '\n')
            line += letter;
        else if (!line.ends_with(':'))
            line += ';';
    while (line.ends_with(';'))
        line.pop_back();
    return line;
}

std::string asked_text(const AskedAccuracy& asked) {
    return asked.within.empty()  ? "--error " + shown_start(asked.error)
           : asked.error.empty() ? "--within " + shown_start(asked.within)
                                 : fmt::format("--within {} --error {}", shown_start(asked.within),
                                               shown_start(asked.error));
}

} // namespace

void add_asked_accuracy(CLI::App& command, AskedAccuracy& asked) {
    command
        .add_option("--within", asked.within,
                    "choose the level that recorded runs support and that ends within this time, "
                    "such as 10min")
        ->type_name("TIME")
        ->default_str("none");
    command
        .add_option("--error", asked.error,
                    fmt::format("choose the cheapest level whose recorded errors are below these: "
                                "tilt=0.1deg,cutoff=0.2km, or a percentage, alone of {}; measures "
                                "are {}",
                                fmt::join(geometry, ", "), fmt::join(words_of_measures(), ", ")))
        ->type_name("ERRORS")
        ->default_str("none");
}

double parse_duration(const std::string& option, const std::string& text) {
    static constexpr Unit units[] = {{"min", 60.0}, {"s", 1.0}, {"h", 3600.0}, {"d", 86400.0}};
    if (const auto seconds = with_unit(text, units))
        return *seconds;
    throw UsageError(
        fmt::format("{} {}: a time above 0 with its unit, such as 90s, 10min, 2h or 1d", option,
                    shown_start(text)));
}

std::vector<ErrorTarget> parse_error_targets(const std::string& text) {
    std::vector<ErrorTarget> targets;
    std::istringstream parts(text);
    for (std::string item; std::getline(parts, item, ',');) {
        const std::size_t equals = item.find('=');
        if (equals != item.npos) {
            add_targets(targets, item.substr(0, equals), item.substr(equals + 1));
            continue;
        }
        if (!item.ends_with('%'))
            throw UsageError(fmt::format("--error {}: tilt=0.1deg,cutoff=0.2km, or a percentage "
                                         "such as 2%",
                                         shown_start(item)));
        for (const std::string_view word : geometry)
            add_targets(targets, std::string(word), item);
    }
    if (targets.empty()) // an empty text has no parts
        throw UsageError(
            "--error needs errors: tilt=0.1deg,cutoff=0.2km, or a percentage such as 2%");
    return targets;
}

std::optional<double> promised_error(const KnownError& error, int seeds) {
    if (!error.resolution || !error.speed || !error.spread)
        return std::nullopt;
    const double recorded = error.spread->runs;
    return std::abs(error.resolution->value) + std::abs(error.speed->value) +
           student_quantile(confidence, recorded - 1.0) * error.spread->value *
               std::sqrt(1.0 / seeds + 1.0 / recorded);
}

std::vector<AccuracyChoice> recorded_choices(std::span<const RecordedRun> runs,
                                             const SceneRequest& request,
                                             const std::function<double(const Scene&)>& seconds) {
    std::vector<AccuracyChoice> choices;
    const std::string name = scene_name(request);
    for (const std::string_view level_name : levels_asked) {
        const AccuracyLevel& level = accuracy_level(level_name);
        std::vector<archive::Pace> paces;
        for (const RecordedRun& run : runs)
            if (run.scene == name && std::abs(run.mean_radius / level.mean_radius - 1.0) < 1e-3 &&
                std::ranges::none_of(paces,
                                     [&](const auto& pace) { return are_near(pace, run.pace); }))
                paces.push_back(run.pace);
        for (const archive::Pace& pace : paces) {
            AccuracyChoice choice{.level = std::string(level_name), .pace = pace};
            const Scene scene = load_scene(request_of(request, choice));
            choice.errors = archive::known_errors(runs, archive::error_question(scene));
            if (std::ranges::all_of(choice.errors,
                                    [](const KnownError& error) { return error.mean == 0.0; }))
                continue;
            choice.seconds = seconds(scene);
            choices.push_back(std::move(choice));
        }
    }
    std::ranges::stable_sort(choices, {}, &AccuracyChoice::seconds);
    return choices;
}

std::optional<AccuracyChoice> cheapest_choice(std::span<const AccuracyChoice> choices,
                                              std::span<const ErrorTarget> targets) {
    std::optional<AccuracyChoice> cheapest;
    for (const AccuracyChoice& choice : choices)
        for (int seeds = 1; seeds <= most_seeds; ++seeds) {
            if (!std::ranges::all_of(targets, [&](const ErrorTarget& target) {
                    return meets(choice, target, seeds);
                }))
                continue;
            AccuracyChoice met = with_seeds(choice, seeds);
            if (!cheapest || met.seconds < cheapest->seconds)
                cheapest = std::move(met);
            break;
        }
    return cheapest;
}

std::optional<AccuracyChoice> best_choice(std::span<const AccuracyChoice> choices, double seconds) {
    const auto rank = [](const AccuracyChoice& choice) {
        const bool promises = std::ranges::any_of(choice.errors, [](const KnownError& error) {
            return promised_error(error, 1).has_value();
        });
        return std::tuple(std::ranges::find(levels_asked, choice.level) - std::begin(levels_asked),
                          promises, -choice.pace.speed * std::sqrt(choice.pace.softness));
    };
    const AccuracyChoice* best = nullptr;
    for (const AccuracyChoice& choice : choices)
        if (choice.seconds <= seconds && (!best || rank(choice) > rank(*best)))
            best = &choice;
    if (!best)
        return std::nullopt;
    const int fit = static_cast<int>(std::min<double>(most_seeds, seconds / best->seconds));
    return with_seeds(*best, std::max(1, fit));
}

std::string explain_asked(const AskedAccuracy& asked, const SceneRequest& request,
                          int threads) try {
    refuse_level(request);
    // Whatever is recorded, a call that says nothing is refused.
    const auto targets =
        asked.error.empty() ? std::vector<ErrorTarget>() : parse_error_targets(asked.error);
    const double time = asked.within.empty() ? 0.0 : parse_duration("--within", asked.within);
    const std::vector<AccuracyChoice> choices = recorded_ways(request, threads);
    const AccuracyChoice choice = answer_to(asked, choices, most_seeds);
    const double twice = 2.0 * (asked.error.empty() ? time : choice.seconds);
    return fmt::format("{} of {}, by recorded runs\n  {} on this machine, {} thread{}\n  {}\n{}"
                       "\ntwice the time ({}){}",
                       asked_text(asked), request.scene, name_of(choice), threads,
                       threads == 1 ? "" : "s", call_of(choice, request), error_table(choice),
                       duration(twice), bought(choice, best_choice(choices, twice), targets));
} catch (const NoAnswer& none) {
    return fmt::format("{} of {}: nothing recorded supports an answer: {}\n", asked_text(asked),
                       request.scene, none.what());
}

std::string apply_asked(const AskedAccuracy& asked, SceneRequest& request, int threads) try {
    refuse_level(request);
    const AccuracyChoice choice = answer_to(asked, recorded_ways(request, threads), 1);
    std::string text = fmt::format("{}: {}", asked_text(asked), name_of(choice));
    if (choice.seeds > 1) {
        SceneRequest others = request;
        others.seed.reset();
        text += fmt::format("; this run is one of them: {} --seed N -o DIR makes the others",
                            call_of(choice, others));
    }
    request = request_of(std::move(request), choice);
    return text;
} catch (const NoAnswer& none) {
    throw UsageError(fmt::format("{}: nothing recorded supports an answer: {}", asked_text(asked),
                                 one_line(none.what())));
}

} // namespace listric
