#include "apps/archive/folder/known_errors.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/scene_lines.hpp"
#include "apps/model/effects.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/reading.hpp"
#include "apps/support/machine/resources.hpp"
#include "apps/support/statistics.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace listric::archive {

namespace {

constexpr const char* unknown = "unknown";

bool is_near(double one, double other) { return std::abs(one - other) <= 1e-3 * std::abs(other); }

/// Values of one measure at one resolution, speed and softness.
struct Group {
    double mean_radius = 0.0;
    Pace pace = {};
    std::vector<double> values = {};
    std::set<std::string> records = {};

    double mean() const { return spread(values).mean; }
    /// A run's cycles go with its reciprocal.
    double quickness() const { return pace.speed * std::sqrt(pace.softness); }
    /// Neither faster nor softer.
    bool is_within(const Pace& most) const {
        return pace.speed < 1.001 * most.speed && pace.softness < 1.001 * most.softness;
    }
    std::string record() const { return fmt::format("{}", fmt::join(records, ", ")); }
    int runs() const { return static_cast<int>(values.size()); }
};

std::vector<Group> groups_of(std::span<const RecordedRun> runs, const ErrorQuestion& question,
                             const std::string& key) {
    std::vector<Group> groups;
    for (const RecordedRun& run : runs) {
        const auto value = run.measures.find(key);
        if (run.scene != question.scene || !is_near(run.extension, question.extension) ||
            value == run.measures.end())
            continue;
        auto group = std::ranges::find_if(groups, [&](const Group& g) {
            return is_near(run.mean_radius, g.mean_radius) && are_near(run.pace, g.pace);
        });
        if (group == groups.end())
            group = groups.insert(group, {run.mean_radius, run.pace});
        group->values.push_back(value->second);
        group->records.insert(run.record);
    }
    return groups;
}

/// The best group by an order, among those that fit.
const Group* best(const std::vector<Group>& groups, auto fits, auto order) {
    const Group* found = nullptr;
    for (const Group& group : groups)
        if (fits(group) && (!found || order(group) < order(*found)))
            found = &group;
    return found;
}

ErrorPart difference(const Group& level, const Group& reference, std::string against) {
    std::set<std::string> records = level.records;
    records.insert(reference.records.begin(), reference.records.end());
    return {level.mean() - reference.mean(), level.runs(), level.mean_radius,
            fmt::format("{}", fmt::join(records, ", ")), std::move(against)};
}

std::optional<ErrorPart> error_of_speed(const std::vector<Group>& groups,
                                        const ErrorQuestion& question) {
    const auto slowest_at = [&](const Group& at) {
        return best(
            groups,
            [&](const Group& g) {
                return is_near(g.mean_radius, at.mean_radius) && g.is_within(question.pace) &&
                       !are_near(g.pace, question.pace);
            },
            [](const Group& g) { return g.quickness(); });
    };
    const Group* const level = best(
        groups,
        [&](const Group& g) {
            return g.mean_radius > 0.999 * question.mean_radius &&
                   g.pace.speed > 0.999 * question.pace.speed &&
                   g.pace.softness > 0.999 * question.pace.softness && slowest_at(g);
        },
        [](const Group& g) { return std::pair(g.mean_radius, g.quickness()); });
    if (!level)
        return std::nullopt;
    const Group& slowest = *slowest_at(*level);
    const std::string softness = is_near(level->pace.softness, slowest.pace.softness)
                                     ? ""
                                     : fmt::format("softness {:.4g} against {:.4g}, ",
                                                   level->pace.softness, slowest.pace.softness);
    return difference(*level, slowest,
                      fmt::format("{}{:.4g} against {:.4g} m/s, mean radius {:.4g} m", softness,
                                  level->pace.speed, slowest.pace.speed, level->mean_radius));
}

KnownError known_error(std::span<const RecordedRun> runs, const ErrorQuestion& question,
                       const std::string& key) {
    KnownError known{.key = key, .resolution = {}, .speed = {}, .spread = {}};
    const std::vector<Group> groups = groups_of(runs, question, key);
    known.speed = error_of_speed(groups, question);
    const Group* const level = best(
        groups,
        [&](const Group& g) {
            return is_near(g.mean_radius, question.mean_radius) && are_near(g.pace, question.pace);
        },
        [](const Group&) { return 0; });
    if (!level)
        return known;
    known.mean = level->mean();
    if (level->runs() > 1)
        known.spread = ErrorPart{spread(level->values).deviation, level->runs(), level->mean_radius,
                                 level->record(), fmt::format("{} seeds", level->runs())};
    const Group* const finest = best(
        groups, [&](const Group& g) { return g.mean_radius < 0.999 * question.mean_radius; },
        [&](const Group& g) {
            return std::tuple(g.mean_radius, std::abs(g.pace.softness - question.pace.softness),
                              std::abs(g.pace.speed - question.pace.speed));
        });
    if (finest)
        known.resolution =
            difference(*level, *finest, fmt::format("mean radius {:.4g} m", finest->mean_radius));
    return known;
}

/// Parameters by which a record does not tell scenes apart: levels of accuracy set them, or records
/// name them.
constexpr std::string_view left_open[] = {"seed",
                                          "accuracy",
                                          "hanging_wall.mean_radius_m",
                                          "extension.speed_m_per_s",
                                          "extension.ramp_s",
                                          "cycle.softness",
                                          "extension.distance_m"};

std::map<std::string, std::string> compared_values(const Scene& scene) {
    std::map<std::string, std::string> values = scene_values(to_toml(scene));
    for (const std::string_view key : left_open)
        values.erase(std::string(key));
    return values;
}

} // namespace

const Quantity known_errors_quantity{
    "known_errors", "", "errors by recorded runs",
    "errors of twelve headline measures at the run's resolution, speed and softness, by recorded "
    "runs"};

std::span<const Quantity> error_fields() {
    static constexpr Quantity fields[] = {
        {"measure", "", "measure", "name of the measure"},
        {"resolution", "", "of resolution",
         "mean of the recorded runs less that of the finest, in the measure's unit; `unknown` "
         "without such runs, as in the fields that follow"},
        {"resolution_against", "", "resolution, compared with",
         "the runs that it is compared with"},
        {"resolution_record", "", "resolution, source", "source of these numbers"},
        {"speed", "", "of speed",
         "mean at the run's speed and softness less the mean of the slowest recorded runs with the "
         "stiffest discs; from coarser, faster or softer runs where this level has none"},
        {"speed_against", "", "speed, compared with", "the runs that it is compared with"},
        {"speed_record", "", "speed, source", "source of these numbers"},
        {"spread", "", "between seeds", "standard deviation between seeds"},
        {"spread_against", "", "seeds", "number of seeds"},
        {"spread_record", "", "seeds, source", "source of these numbers"}};
    return fields;
}

std::vector<KnownError> known_errors(std::span<const RecordedRun> runs,
                                     const ErrorQuestion& question) {
    std::vector<KnownError> all;
    for (const HeadlineMeasure& measure : headline_measures())
        all.push_back(known_error(runs, question, measure.key));
    return all;
}

Pace pace_of(const Scene& scene) {
    return {scene.extension.speed, scene.extension.ramp, scene.cycle.softness};
}

bool are_near(const Pace& one, const Pace& other) {
    return is_near(one.speed, other.speed) && is_near(one.ramp, other.ramp) &&
           is_near(one.softness, other.softness);
}

ErrorQuestion error_question(const Scene& scene) {
    return {scene.name, scene.hanging_wall.mean_radius, pace_of(scene), scene.extension.distance};
}

std::string departs_from_record(const Scene& scene) {
    const auto file = resource_folder() / "scenes" / (scene.name + ".toml");
    if (!is_file(file))
        return "name";
    SceneRequest request{.scene = file.string()};
    request.accuracy = scene.accuracy;
    request.seed = static_cast<std::int64_t>(scene.seed);
    const auto difference = scene_difference(
        compared_values(scene), compared_values(load_scene(request)), SceneScope::results);
    return difference ? difference->parameter : "";
}

nlohmann::ordered_json known_errors_json(const Scene& scene, double extension) {
    std::vector<RecordedRun> runs;
    try {
        runs = recorded_runs();
        if (!std::ranges::count(runs, scene.name, &RecordedRun::scene) ||
            !departs_from_record(scene).empty())
            runs.clear();
    } catch (const std::exception&) { // a run is worth more than what is known of its errors
        runs.clear();
    }
    JsonObject list = JsonObject::array();
    ErrorQuestion question = error_question(scene);
    question.extension = extension; // a run may end early
    for (const KnownError& known : known_errors(runs, question)) {
        JsonObject& json = list.emplace_back(JsonObject{{"measure", known.key}});
        const auto add = [&](const std::string& name, const std::optional<ErrorPart>& part) {
            if (!part) {
                json[name] = unknown;
                return;
            }
            json[name] = part->value;
            json[name + "_against"] = part->against;
            json[name + "_record"] = part->record;
        };
        add("resolution", known.resolution);
        add("speed", known.speed);
        add("spread", known.spread);
    }
    return list;
}

std::string error_text(const std::string& key, double value) {
    if (key.ends_with("_deg"))
        return fmt::format("{:.2g}°", value);
    if (key.ends_with("_m2"))
        return fmt::format("{:.2g} km²", value / 1e6);
    if (key.ends_with("_m"))
        return fmt::format("{:.2g} km", value / 1e3);
    return fmt::format("{:.2g}{}", value, key.ends_with("_diameters") ? " discs" : "");
}

} // namespace listric::archive
