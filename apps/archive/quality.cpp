#include "apps/archive/quality.hpp"

#include "apps/archive/folder/summary.hpp"
#include "apps/archive/tables/fault_fields.hpp"
#include "apps/measures/basin/dilation.hpp"
#include "apps/measures/dictionary.hpp"
#include "apps/measures/measures.hpp"
#include "apps/model/effects/stage/pauses.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "coupling/water_load.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace listric::archive {

using namespace measures;

namespace {

using M = Measures;

QualityVerdict verdict_of(bool good) {
    return good ? QualityVerdict::good : QualityVerdict::doubtful;
}

/// 1e-16, 0.0003
std::string small_text(double value) {
    return value == 0.0 || value >= 1e-4 ? fmt::format("{:.2g}", value)
                                         : fmt::format("{:.0e}", value);
}

/// Two digits: "1.9 km", "930 m", "0.028 m".
std::string length_words(double metres) {
    if (metres >= 995.0)
        return fmt::format("{:.2g} km", metres / 1e3);
    return metres >= 99.5 ? fmt::format("{:.0f} m", 10.0 * std::round(metres / 10.0))
                          : fmt::format("{:.2g} m", metres);
}

void add_quasi_static(std::vector<QualityCheck>& all, const JsonObject& summary) {
    const auto found = summary.find(quasi_static.name);
    if (found == summary.end() || !found->is_boolean())
        return;
    const bool good = found->get<bool>();
    std::vector<std::string> values;
    if (const auto ratio =
            number_at(summary, measures::name_of<&M::unbalanced_ratio_mean>().c_str()))
        values.push_back(fmt::format("unbalanced {:.2g}", *ratio));
    if (const auto inertia = number_at(summary, measures::name_of<&M::inertial_number>().c_str()))
        values.push_back(fmt::format("inertial {:.2g}", *inertia));
    if (values.empty())
        values.emplace_back(good ? "yes" : "no");
    all.push_back(
        {std::string(quasi_static.name), "Quasi-static", fmt::format("{}", fmt::join(values, ", ")),
         fmt::format("at most {:g}, {:g}", greatest_unbalanced_ratio, greatest_inertial_number),
         verdict_of(good),
         good ? "Inertia is small enough: the run is not too fast."
              : "The run is too fast: halve extension.speed_m_per_s.",
         good ? "quasi-static" : "not quasi-static"});
}

void add_mass(std::vector<QualityCheck>& all, const JsonObject& summary) {
    const std::string key = measures::name_of<&M::mass_error_fraction>();
    const auto error = number_at(summary, key.c_str());
    if (!error)
        return;
    const bool good = *error < most_mass_error;
    all.push_back({key, "Mass", "error " + small_text(*error),
                   "below " + small_text(most_mass_error), verdict_of(good),
                   good ? "All rock is accounted for." : "Mass is lost: please report it.",
                   "mass error " + small_text(*error)});
}

void add_volume(std::vector<QualityCheck>& all, const JsonObject& summary) {
    const auto error = number_at(summary, std::string(effects::volume_error_fraction).c_str());
    if (!error)
        return;
    const bool good = *error < most_volume_error;
    all.push_back({std::string(effects::volume_error_fraction), "Volume",
                   fmt::format("error {:.2g} %", 100.0 * *error),
                   fmt::format("below {:g} %", 100.0 * most_volume_error), verdict_of(good),
                   good ? "Fault zones keep their volume when they weaken."
                        : "Weak zones change their volume: try a smaller "
                          "update_interval_a of the weakening. Faults of calibrated rock "
                          "dilate, however small that is.",
                   fmt::format("volume error {:.2g} %", 100.0 * *error)});
}

void add_balance(std::vector<QualityCheck>& all, const JsonObject& summary,
                 const QualityContext& context) {
    const std::string key = measures::name_of<&M::area_balance>();
    const auto balance = number_at(summary, key.c_str());
    if (!balance)
        return;
    QualityCheck check{key, "Balance of areas", fmt::format("{:.3f}", *balance),
                       fmt::format("{:g} to {:g}", least_area_balance, most_area_balance)};
    if (context.base_moves) {
        check.words = "Not judged: the base moves, so that the basin has another area.";
        check.brief = "balance of areas not judged on a moving base";
    } else if (!dem::has_come_to(dem::Extension(number_at(summary, "extension_m").value_or(0.0)),
                                 area_balance_from, dem::Extension(cycle_of(summary)))) {
        const std::string where = fmt::format(
            "{} {:g} km of extension", number_at(summary, travel_column) ? "below" : "before",
            area_balance_from.m / 1e3);
        check.words = fmt::format("Not judged {}.", where);
        check.brief = fmt::format("balance of areas not judged {}", where);
    } else {
        const double elastic =
            number_at(summary, std::string(measures::elastic_area_fraction).c_str()).value_or(0.0);
        const double judged = *balance + elastic;
        const bool good = least_area_balance <= judged && judged <= most_area_balance;
        if (std::abs(elastic) >= 0.0005)
            check.value += fmt::format(", {:.3f} as if rock were rigid", judged);
        check.verdict = verdict_of(good);
        check.words =
            good ? "The basin is as large as extension × thickness."
                 : "The basin is not as large as extension × thickness: rock dilates "
                   "(rock_dilation_fraction), calibrated rock by 7 to 12 %, or was eroded.";
        check.brief = good ? "areas balance" : "areas do not balance";
    }
    all.push_back(std::move(check));
}

void add_still_ground(std::vector<QualityCheck>& all, const JsonObject& summary,
                      const QualityContext& context) {
    const std::string key = measures::name_of<&M::still_ground>();
    const auto rise = number_at(summary, key.c_str());
    if (!rise || context.mean_radius == 0.0)
        return;
    const double most = 0.5 * context.mean_radius;
    QualityCheck check{key, "Still ground", fmt::format("{:+.0f} m", *rise),
                       fmt::format("within {}", length_words(most))};
    if (context.base_moves) {
        check.words = "Not judged: the base moves, and the ground with it.";
    } else {
        const bool good = std::abs(*rise) <= most;
        check.verdict = verdict_of(good);
        check.words = good ? "Ground that nothing moves keeps its level."
                           : "Ground that nothing moves leaves its level, and basin and fill with "
                             "it: discs are too soft (cycle.softness).";
        check.brief = good ? "" : "still ground moves";
    }
    all.push_back(std::move(check));
}

/// How much of the base's friction the discs need, and so whether another friction would matter.
void add_base_friction(std::vector<QualityCheck>& all, const JsonObject& summary,
                       const QualityContext& context) {
    using F = BaseForces;
    using P = BasePart;
    constexpr double little = 0.05; // of the length
    if (!context.base_friction)
        return;
    const auto number = [&](const std::string& key) { return number_at(summary, key.c_str()); };
    std::vector<std::string> values;
    double most_sliding = 0.0;
    const auto add_part = [&](const char* part, const std::string& friction,
                              const std::string& sliding) {
        const auto mobilised = number(friction), slides = number(sliding);
        if (!mobilised || !slides)
            return;
        values.push_back(
            fmt::format("{} {:.2f}, {:.0f} % slides", part, std::abs(*mobilised), 100.0 * *slides));
        most_sliding = std::max(most_sliding, *slides);
    };
    add_part("ramp", measures::name_of<&M::base, &F::ramp, &P::mobilised_friction>(),
             measures::name_of<&M::base, &F::ramp, &P::sliding_share>());
    add_part("flat", measures::name_of<&M::base, &F::flat, &P::mobilised_friction>(),
             measures::name_of<&M::base, &F::flat, &P::sliding_share>());
    if (values.empty())
        return;
    const std::string value = fmt::format("{}", fmt::join(values, "; "));
    const bool idle = most_sliding < little;
    all.push_back({measures::name_of<&M::base, &F::flat, &P::mobilised_friction>(),
                   "Mobilised friction of the base", value,
                   fmt::format("at most {:g}", *context.base_friction), QualityVerdict::note,
                   idle
                       ? "A higher friction of the base changes nothing here: what there is is not "
                         "mobilised, and the discs go with the base."
                       : "Where discs slide on the base, its friction matters.",
                   idle ? fmt::format("the base's friction of {:g} is not mobilised ({})",
                                      *context.base_friction, value)
                        : ""});
}

/// How wide faults are in discs, and so what may be interpreted.
void add_discs_per_fault(std::vector<QualityCheck>& all, const JsonObject& summary,
                         const QualityContext& context) {
    const auto faults = summary.find("faults");
    if (faults == summary.end() || !faults->is_array() || faults->empty())
        return;
    double least = 0.0, most = 0.0;
    for (const JsonObject& fault : *faults)
        if (const auto width = number_at(fault, std::string(field_width).c_str())) {
            least = least == 0.0 ? *width : std::min(least, *width);
            most = std::max(most, *width);
        }
    if (most == 0.0)
        return;
    const double narrowest = fewest_discs_across * 2.0 * context.mean_radius;
    all.push_back({std::string(field_width), "Discs across a fault",
                   most - least < 0.05 ? fmt::format("{:.1f}", most)
                                       : fmt::format("{:.1f} to {:.1f}", least, most),
                   fmt::format("{:g} to interpret", fewest_discs_across), QualityVerdict::note,
                   fmt::format("The width of faults is the grain's. Do not interpret what is "
                               "narrower than {:g} discs, {}.",
                               fewest_discs_across, length_words(narrowest))});
}

void add_sediment(std::vector<QualityCheck>& all, const JsonObject& summary) {
    constexpr double least = 0.96, most = 1.12; // lis1 at standard (docs/reference/measures.md)
    const auto ratio = number_at(summary, effects::sediment_stress_ratio);
    if (!ratio)
        return;
    const bool usual = least <= *ratio && *ratio <= most;
    all.push_back({effects::sediment_stress_ratio, "Weight of the sediment",
                   fmt::format("{:.2f}", *ratio), fmt::format("lis1: {:g} to {:g}", least, most),
                   usual ? QualityVerdict::good : QualityVerdict::note,
                   usual ? "The sediment carries its own weight."
                         : "Stress in the sediment over the weight above: 1 if it carries its own "
                           "weight. The range is that of lis1 at standard."});
}

/// Balances of the water, which are round-off, and of its pressure on a base that bends.
void add_water(std::vector<QualityCheck>& all, const JsonObject& summary) {
    struct Balance {
        const char *key, *label, *good, *doubtful;
        double most;
    };
    for (const Balance& b :
         {Balance{effects::water_error, "Pore water", "All pore water is accounted for.",
                  "Pore water is lost: please report it.", 1e-11},
          Balance{coupling::water_force_error_name, "Weight of rock and water on the base",
                  "The base bears the weight of rock and water.",
                  "The base does not bear the weight of rock and water: please report it.", 1e-9},
          Balance{effects::fluid_closure, "Excess pressure on the base",
                  "Lift of the sediment and pressure below it balance.",
                  "Lift of the sediment and pressure below it do not balance: the sediment is few "
                  "discs thick, or has gaps.",
                  0.02}})
        if (const auto value = number_at(summary, b.key)) {
            const bool good = std::abs(*value) < b.most;
            all.push_back({b.key, b.label, small_text(*value), "below " + small_text(b.most),
                           verdict_of(good), good ? b.good : b.doubtful});
        }
}

void add_rest(std::vector<QualityCheck>& all, const JsonObject& summary) {
    constexpr double most = 0.15; // of a window's strain (docs/guides/inversion.md)
    const auto windows = number_at(summary, effects::stage::rest_strain_windows);
    if (!windows)
        return;
    const bool good = *windows <= most;
    all.push_back({effects::stage::rest_strain_windows, "Rest in pauses",
                   fmt::format("strain of {:.2g} windows", *windows),
                   fmt::format("at most {:g}", most), verdict_of(good),
                   good ? "Rock rests while base and wall do."
                        : "Rock goes on to move in a pause (rest_moved_discs, rest_farthest_m): "
                          "strain of the pause is no rest's.",
                   good ? "rest in pauses" : "no rest in pauses"});
}

void add_steps(std::vector<QualityCheck>& all, const JsonObject& summary) {
    using namespace effects::stage;
    const auto unsettled = number_at(summary, unsettled_steps), steps = number_at(summary, "steps");
    if (!unsettled || !steps || *steps == 0.0)
        return;
    const bool good = *unsettled == 0.0;
    all.push_back({unsettled_steps, "Rest of a pause's steps",
                   fmt::format("{:.0f} of {:.0f} steps without rest", *unsettled, *steps), "0",
                   verdict_of(good),
                   good ? "Discs and base come to rest in every step."
                        : "Discs or base still move when the next step comes (step_unrest_m): what "
                          "they show lags behind; raise settle_m, or lower speed_m_per_s of the "
                          "pause.",
                   fmt::format("{:.0f} of {:.0f} steps without rest", *unsettled, *steps)});
}

} // namespace

std::vector<QualityCheck> quality_checks(const JsonObject& summary, const QualityContext& context) {
    std::vector<QualityCheck> all;
    if (!summary.is_object())
        return all;
    add_quasi_static(all, summary);
    add_mass(all, summary);
    add_volume(all, summary);
    add_balance(all, summary, context);
    add_still_ground(all, summary, context);
    add_base_friction(all, summary, context);
    add_discs_per_fault(all, summary, context);
    add_sediment(all, summary);
    add_rest(all, summary);
    add_steps(all, summary);
    add_water(all, summary);
    return all;
}

QualityVerdict verdict_of(const std::vector<QualityCheck>& checks) {
    QualityVerdict verdict = QualityVerdict::note;
    for (const QualityCheck& check : checks)
        if (check.verdict != QualityVerdict::note && verdict != QualityVerdict::doubtful)
            verdict = check.verdict;
    return verdict;
}

std::vector<std::string> verdict_lines(const std::vector<QualityCheck>& checks) {
    const QualityVerdict verdict = verdict_of(checks);
    if (verdict == QualityVerdict::note)
        return {};
    std::vector<std::string> briefs, lines;
    for (const QualityCheck& check : checks) {
        if (!check.brief.empty())
            briefs.push_back(check.brief);
        if (check.verdict == QualityVerdict::doubtful)
            lines.push_back(check.words);
    }
    lines.insert(lines.begin(), fmt::format("{}: {}", name_of(verdict), fmt::join(briefs, ", ")));
    return lines;
}

const char* name_of(QualityVerdict verdict) {
    constexpr const char* names[] = {"good", "doubtful", "note"};
    return names[static_cast<int>(verdict)];
}

} // namespace listric::archive
