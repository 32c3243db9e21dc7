#include "apps/scene/parameters/stages.hpp"

#include "apps/model/effect_list.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/effects/stage/measures.hpp"
#include "apps/model/effects/stage/pauses.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/base_words.hpp"
#include "apps/support/words/spelling.hpp"
#include "dem/base/just_before.hpp"
#include "dem/columns.hpp"
#include "dem/events/stage_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace listric::effects::stage {

namespace {

dem::TargetLine regional_in(const Scene& scene, const ModelParts& parts) {
    return regional_of(parts.base.motion,
                       parts.sediment ? parts.sediment->surface : dem::Target(0.0),
                       make_calendar(scene));
}

/// Remembers what the way back is compared with: the column `turn_strain`, and rows at the turn and
/// a kilometre after it.
class TurnRecord final : public dem::Observer {
public:
    static constexpr dem::Travel start_of_balance{1e3}; ///< after the turn

    TurnRecord(dem::Travel turn, dem::TargetLine regional)
        : Observer("turn", dem::never, dem::Stage::load), turn_(turn),
          regional_(std::move(regional)) {}

    dem::Travel next_due() const override {
        return applied == 0   ? turn_
               : applied == 1 ? turn_ + start_of_balance
                              : dem::Travel(std::numeric_limits<double>::infinity());
    }

    void begin(dem::State& state) override {
        state.discs.add(turn_strain);
        memory.add<double>("extension_m", "m", 0.0);
        memory.add<double>("uplift_area_m2", "m2", 0.0);
        memory.add<double>("relief_m", "m", 0.0);
        memory.add<double>("removed_mass", "kg/m", 0.0);
    }

    bool apply(dem::State& state, const dem::RigidBase&) override {
        if (applied == 0)
            std::ranges::copy(std::as_const(state).discs.get(dem::columns::total_strain),
                              state.discs.get(turn_strain).begin());
        memory.resize(memory.rows() + 1);
        memory.get<double>("extension_m").back() = state.clock.extension.m;
        memory.get<double>("uplift_area_m2").back() = area_above_regional(state, regional_);
        memory.get<double>("relief_m").back() = graben_relief(state);
        memory.get<double>("removed_mass").back() = state.ledger.removed;
        return false;
    }

private:
    dem::Travel turn_;
    dem::TargetLine regional_;
};

void add_events(const Scene& scene, const ModelParts& parts, dem::Events& events) {
    const dem::Motion& motion = parts.base.motion;
    if (dem::StageChange::is_needed(motion))
        dem::add(events, std::make_unique<dem::StageChange>(motion));
    if (PauseRecord::is_needed(motion))
        dem::add(events, std::make_unique<PauseRecord>(motion));
    if (const dem::Calendar calendar = make_calendar(scene); !calendar.pauses().empty())
        dem::add(events,
                 std::make_unique<StepRecord>(calendar, parts.base_moves && !bending_base(scene)));
    if (const auto turn = turn_of(motion))
        dem::add(events, std::make_unique<TurnRecord>(*turn, regional_in(scene, parts)));
}

/// Number of a row of the record; none before.
std::optional<double> recorded(const Observation& now, const char* name, std::size_t row) {
    const auto* record = dem::find<const TurnRecord>(now.events);
    if (!record || record->memory.rows() <= row)
        return std::nullopt;
    return record->memory.get<double>(name)[row];
}

bool has_turned(const Observation& now) {
    return recorded(now, "extension_m", 0) &&
           now.parts.base.motion.shortens(just_before(now.parts.base.motion, now.state.clock));
}

/// Growth of the area above the regional since a row, m^2, with what was eroded meanwhile: its mass
/// at the hanging wall's density, since nothing keeps which rock it was.
std::optional<double> uplift_since(const Observation& now, std::size_t row) {
    const auto before = recorded(now, "uplift_area_m2", row);
    if (!before || !has_turned(now))
        return std::nullopt;
    const double eroded = (now.state.ledger.removed - *recorded(now, "removed_mass", row)) /
                          now.scene.hanging_wall.rock_density;
    return area_above_regional(now.state, regional_in(now.scene, now.parts)) - *before + eroded;
}

std::optional<double> uplift_balance(const Observation& now) {
    const auto uplift = uplift_since(now, 1);
    if (!uplift)
        return std::nullopt;
    const double shortening = *recorded(now, "extension_m", 1) - now.state.clock.extension.m;
    return shortening > 0.0
               ? std::optional(*uplift / (shortening * now.scene.hanging_wall.thickness))
               : std::nullopt;
}

std::optional<double> pop_up(const Observation& now) {
    const auto before = recorded(now, "relief_m", 0);
    return before && has_turned(now) ? std::optional(*before - graben_relief(now.state))
                                     : std::nullopt;
}

std::optional<double> null_deposited_at(const Observation& now, bool decompacted) {
    if (!has_turned(now) || !now.parts.sediment)
        return std::nullopt;
    std::optional<Decompaction> pores;
    if (const auto& s = *now.parts.sediment; decompacted) {
        if (!s.porosity_decay)
            return std::nullopt;
        pores = {s.surface_porosity, *s.porosity_decay};
    }
    const dem::Motion& motion = now.parts.base.motion;
    return stage::null_point(now.state, motion, regional_in(now.scene, now.parts), *turn_of(motion),
                             pores);
}

/// Shortening over extension that the null point tells.
std::optional<double> inversion_ratio(const Observation& now, bool decompacted) {
    const auto null = null_deposited_at(now, decompacted);
    const auto extended = recorded(now, "extension_m", 0);
    return null && *extended > 0.0 ? std::optional(1.0 - *null / *extended) : std::nullopt;
}

/// A column is there from the first row on; nothing is not a number.
std::optional<double> or_nan(std::optional<double> value) {
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Number of what goes on in the newest pause; none in scenes without one.
std::optional<double> in_pause(const Observation& now, double Unrest::*value) {
    const auto* record = dem::find<const PauseRecord>(now.events);
    if (!record)
        return std::nullopt;
    const auto all = record->unrest(now.state);
    return or_nan(all ? std::optional((*all).*value) : std::nullopt);
}

std::optional<double> rest_strain(const Observation& now) {
    const auto strain = in_pause(now, &Unrest::strain);
    if (!strain)
        return std::nullopt;
    const double before = dem::find<const PauseRecord>(now.events)->strain_before();
    return or_nan(before > 0.0 ? std::optional(*strain / before) : std::nullopt);
}

/// Number of the steps' record; none in scenes without steps.
std::optional<double> of_steps(const Observation& now, double (StepRecord::*value)() const) {
    const auto* record = dem::find<const StepRecord>(now.events);
    return record ? std::optional((record->*value)()) : std::nullopt;
}

/// What a pause costs, and how it would cost less.
std::string price_of_pause(const Scene& scene, std::size_t stage) {
    constexpr double dear = 20e3; // m of travel
    const StageParameters& pause = (*scene.find<Stages>())[stage];
    const dem::Motion motion = make_motion(scene);
    const dem::MotionStage& one = motion.stages[stage];
    const double way = (one.end - one.start).m;
    const double seconds = motion.time_at(one.end) - motion.time_at(one.start);
    const double share = seconds / motion.time_at(motion.stages.back().end);
    std::string text =
        fmt::format(", {:g} km of travel, {:.0f} % of the run's cycles", way / 1e3, 100.0 * share);
    if (!pause.step)
        return way <= dear
                   ? text
                   : text + fmt::format("; with step_a = 1e6 it takes {:g} km",
                                        std::ceil(*pause.pause / 1e6) * usual_settling / 1e3);
    const double settle = pause.settle.value_or(usual_settling), steps = std::round(way / settle);
    return text + fmt::format("; {:g} step{} of {:g} Myr, {:g} m or {:.0f} s of the model each",
                              steps, steps == 1.0 ? "" : "s", *pause.pause / steps / 1e6, settle,
                              settle / one.speed);
}

void check(const Scene& scene, const Refuse& refuse) {
    const Stages& stages = *scene.find<Stages>();
    const bool has_water = make_parts(scene).water.has_value();
    for (std::size_t k = 0; k < stages.size(); ++k)
        if (stages[k].water_level && !has_water)
            refuse(fmt::format("stage[{}].water_level_m", k),
                   fmt::format("is {}, but no water acts on the discs; add [{}], or leave it out",
                               text(*stages[k].water_level), pore_filler(program_effects()).name));
}

std::string explain(const Scene& scene, EffectList) {
    std::string text = "stages\n";
    const dem::Motion motion = make_motion(scene);
    const dem::Calendar calendar = make_calendar(scene);
    const Stages& stages = *scene.find<Stages>();
    for (std::size_t k = 0; k < stages.size(); ++k) {
        const dem::MotionStage& one = motion.stages[k];
        const double years = calendar.years(one.start, one.end);
        const double way = one.slope * (one.end - one.start).m;
        text += fmt::format("  to {:g} km of travel: {}, {:g} Myr{}\n", one.end.m / 1e3,
                            way == 0.0  ? std::string("pause")
                            : way > 0.0 ? fmt::format("{:g} km of extension", way / 1e3)
                                        : fmt::format("{:g} km of shortening", -way / 1e3),
                            years / 1e6,
                            way == 0.0       ? price_of_pause(scene, k)
                            : stages[k].base ? ", base: " + base_name(*stages[k].base)
                                             : "");
    }
    return text;
}

std::vector<Measure<Observation>> measures_of_stages() {
    return {
        {travel_column, "m", "way of the wall, back and forth",
         "way of base and right wall, back and forth, at extension.rate_m_per_a, and in pauses: "
         "the run's clock, by which files are named",
         [](const Observation& now) -> std::optional<double> { return now.state.clock.travel.m; }},
        {"elapsed_a", "a", "time since the start",
         "travel over extension.rate_m_per_a; in pauses with step_a the years of their steps",
         [](const Observation& now) -> std::optional<double> {
             return make_calendar(now.scene).age(now.state.clock.travel);
         }},
        {"stage", "1", "stage", "number of the [[stage]], counted from 0",
         [](const Observation& now) -> std::optional<double> {
             return static_cast<double>(
                 now.parts.base.motion.stage(just_before(now.parts.base.motion, now.state.clock)));
         }},
        {rest_strain_windows, "1", "strain in the pause, in windows of extension",
         "shear strain of rock in the newest pause (mean of discs) over that of the last window of "
         "500 m of travel before: what goes on while base and wall rest; in summary.json the "
         "greatest",
         rest_strain, OverTime::largest, "at most 0.15"},
        {"rest_moved_discs", "1", "discs moved in the pause",
         "discs of rock that the newest pause has moved by more than 100 m; in summary.json the "
         "greatest number",
         [](const Observation& now) { return in_pause(now, &Unrest::moved); }, OverTime::largest},
        {"rest_farthest_m", "m", "farthest motion in the pause",
         "greatest displacement of a disc of rock in the newest pause; in summary.json the "
         "greatest",
         [](const Observation& now) { return in_pause(now, &Unrest::farthest); },
         OverTime::largest},
        {"uplift_area_m2", "m2", "area uplifted above the regional",
         "growth since the turn of the area above the regional, over the footwall, too, with what "
         "was eroded, its mass at the hanging wall's density (sediment counts by half): thickness "
         "times shortening, less what rock and pores take up",
         [](const Observation& now) { return or_nan(uplift_since(now, 0)); }},
        {"uplift_balance", "1", "area uplifted over shortening × thickness",
         "growth of the area above the regional since 1 km after the turn, over shortening since × "
         "thickness: the first kilometre closes what extension opened",
         [](const Observation& now) { return or_nan(uplift_balance(now)); }},
        {"pop_up_m", "m", "pop-up of the graben",
         "fall of the pre-rift top (means over 2.5 km) from the rollover's crest into the graben, "
         "at "
         "the turn less now: above 0, the graben pops up",
         [](const Observation& now) { return or_nan(pop_up(now)); }},
        {"reactivated_share", "1", "shortening on former faults",
         "share of the shortening's shear strain in the tenth of the pre-rift area that extension "
         "had strained most",
         [](const Observation& now) {
             return or_nan(has_turned(now) ? reactivated_share(now.state) : std::nullopt);
         }},
        {"null_deposited_at_m", "m", "null point: laid down at",
         "extension at which the stratum was laid down whose top, 0.2 to 1.5 km from the "
         "breakaway, "
         "is at the regional now: the null point; extension less shortening where no pores close",
         [](const Observation& now) { return or_nan(null_deposited_at(now, false)); },
         OverTime::last, "", "null point: laid down at {} of extension"},
        {"null_deposited_at_decompacted_m", "m", "null point, decompacted: laid down at",
         "the null point with the thickness that strata below it have lost since, as their pores "
         "closed",
         [](const Observation& now) { return or_nan(null_deposited_at(now, true)); },
         OverTime::last, "", "decompacted: {}"},
        {"inversion_ratio", "1", "inversion ratio",
         "shortening over extension from the null point: 1 less its extension over that at the "
         "turn",
         [](const Observation& now) { return or_nan(inversion_ratio(now, false)); }},
        {"inversion_ratio_decompacted", "1", "inversion ratio, decompacted",
         "the inversion ratio from the decompacted null point",
         [](const Observation& now) { return or_nan(inversion_ratio(now, true)); }},
    };
}

std::vector<Measure<Observation>> measures_of_steps() {
    return {
        {unsettled_steps, "1", "steps of pauses without rest",
         "steps of pauses (step_a) in whose last quarter rock moves on by more than a hundredth of "
         "the mean radius, mean of discs",
         [](const Observation& now) { return of_steps(now, &StepRecord::unsettled); },
         OverTime::last, "0"},
        {"steps", "1", "steps of pauses", "steps of pauses (step_a) that have ended",
         [](const Observation& now) { return of_steps(now, &StepRecord::steps); }},
        {step_unrest, "m", "motion at a step's end",
         "way of rock in the last quarter of the newest step, mean of discs, less that of a base "
         "that moves as prescribed",
         [](const Observation& now) { return of_steps(now, &StepRecord::last); },
         OverTime::largest},
    };
}

std::vector<Measure<Observation>> measures() {
    std::vector<Measure<Observation>> all = measures_of_stages();
    std::ranges::move(measures_of_steps(), std::back_inserter(all));
    return all;
}

} // namespace

Works works() { return {}; }

const Effect& effect() {
    static const Effect effect{
        .name = "stage",
        .doc = "motion in stages: extension, pauses, shortening, one after the other",
        .defaults = make_defaults<Stages>,
        .address = address_of<Stages>,
        .parameters = stage_parameters(),
        .items = items_of<StageParameters>,
        .complete = complete_stages,
        .check = check,
        .add_events = add_events,
        .explain = explain,
        .measures = measures(),
    };
    return effect;
}

} // namespace listric::effects::stage
