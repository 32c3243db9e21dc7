#include "apps/archive/tables/burial_history.hpp"

#include "apps/archive/folder/setting.hpp"
#include "apps/archive/tables/exports.hpp"
#include "apps/measures/basin/profile.hpp"
#include "apps/measures/strata/backstripping.hpp"
#include "apps/measures/strata/burial.hpp"
#include "apps/model/bending_base.hpp"
#include "apps/support/fineness.hpp"
#include "thermal/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace listric::archive {

using namespace dem;
using namespace measures;

namespace {

std::vector<WellPlace> places_by_thickness(const Observation& now) {
    const Profile profile =
        measure_profile(make_setting(now.scene, now.parts), now.state, now.parts.base);
    const auto& thickness = profile.sediment_thickness;
    const auto deepest = std::ranges::max_element(thickness);
    if (deepest == thickness.end() || *deepest <= 0.0)
        return {};
    const auto x_of = [&](auto place) {
        return profile.x[static_cast<std::size_t>(place - thickness.begin())];
    };
    std::vector<WellPlace> places{{"depocentre", x_of(deepest)}};
    const auto flank =
        std::find_if(deepest, thickness.end(), [&](double m) { return m <= 0.5 * *deepest; });
    if (flank != thickness.end() && *flank > 0.0)
        places.push_back({"flank", x_of(flank)});
    return places;
}

/// A number to a millimetre, in small models less.
double to_millimetre(const State& state, double metres) {
    const double steps = 1e3 * fineness(state.mean_radius);
    return std::round(steps * metres) / steps;
}

/// Lines of one well by stratum.
struct WellLines {
    WellPlace place;
    WellRock rock;
    std::map<int, Line> lines;
};

/// Tectonic subsidence when each stratum had been laid down, by Athy's law and the grains that the
/// well meets now: sediment was up to the target line, and water, if any, to its level.
std::map<int, double> backstripped(const Observation& drilled, const WellRock& rock, double x) {
    const Setting setting = make_setting(drilled.scene, drilled.parts);
    const SedimentFacts& sediment = *drilled.parts.sediment;
    BackstrippingDensities densities{.grains = sediment.grain_density};
    if (const BendingBase* base = bending_base(drilled.scene))
        densities.mantle = base->mantle_density;
    const auto& water = drilled.parts.water;
    if (water)
        densities.water = water->density;
    const auto sea = [&](dem::Travel travel) {
        return water ? water->level.heights.at(water->level.calendar.age(travel)).height(0.0) : 0.0;
    };
    std::vector<DrilledStratum> strata;
    std::map<int, double> found;
    for (const BuriedStratum& b :
         buried_strata(setting, drilled.parts.base, drilled.state, sediment.grain_density, rock)) {
        strata.push_back(
            {(b.base - b.top) * (1.0 - b.porosity), setting.sediment->pores_of(b.stratum)});
        const dem::Travel then = rock.at(b.stratum).deposited_at;
        const double ground = setting.sediment->target.at(setting.calendar.age(then)).height(x);
        found[b.stratum] = tectonic_subsidence(decompacted(strata, densities), densities,
                                               sea(then) - ground, sea(then) - sea({}));
    }
    return found;
}

WellLines begin_well(const WellPlace& place, const Observation& drilled, double grain_density) {
    const Setting setting = make_setting(drilled.scene, drilled.parts);
    WellLines well{place, rock_of_well(setting, drilled.state, grain_density, place.x), {}};
    const std::map<int, double> tectonic = backstripped(drilled, well.rock, place.x);
    for (const auto& [number, stratum] : well.rock)
        well.lines[number].values = {place.name,
                                     static_cast<double>(number),
                                     setting.calendar.age(stratum.deposited_at),
                                     to_millimetre(drilled.state, stratum.deposited_thickness),
                                     setting.sediment->pores_of(number).surface_porosity,
                                     static_cast<double>(stratum.ids.size()),
                                     tectonic.contains(number)
                                         ? to_millimetre(drilled.state, tectonic.at(number))
                                         : std::nan("")};
    return well;
}

/// Whether sediment has a temperature.
bool is_warm(const Observation& now) { return now.state.discs.has(thermal::columns::temperature); }

/// Mean of a column over a stratum's discs of the well; NaN where there is no such column.
double mean_of(const State& state, std::string_view column, const WellStratum& stratum) {
    if (!state.discs.has(column))
        return std::nan("");
    const auto id = disc_columns(state).id;
    const auto values = state.discs.get<double>(column);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < id.size(); ++i)
        if (std::ranges::binary_search(stratum.ids, id[i])) {
            sum += values[i];
            count += 1.0;
        }
    return sum / count;
}

void add_moment(WellLines& well, const Observation& now, dem::Travel drilled_at,
                double grain_density) {
    const Setting setting = make_setting(now.scene, now.parts);
    const dem::Clock& clock = now.state.clock;
    for (const BuriedStratum& b :
         buried_strata(setting, now.parts.base, now.state, grain_density, well.rock)) {
        Line& line = well.lines.at(b.stratum);
        const auto metres = [&](double x) { return to_millimetre(now.state, x); };
        line.points.push_back({metres(b.x), -metres(b.top)});
        line.at_points.insert(line.at_points.end(),
                              {metres(b.base), metres(b.top - b.ground), metres(b.base - b.top),
                               b.porosity, clock.extension.m, setting.calendar.age(clock.travel),
                               setting.calendar.years(clock.travel, drilled_at)});
        if (!is_warm(now))
            continue;
        const WellStratum& stratum = well.rock.at(b.stratum);
        line.at_points.push_back(mean_of(now.state, thermal::columns::temperature, stratum));
        line.at_points.push_back(mean_of(now.state, thermal::columns::vitrinite, stratum));
    }
}

} // namespace

std::vector<WellPlace> well_places(const Observation& now, const std::vector<double>& wells) {
    std::vector<WellPlace> places;
    for (const double x : wells)
        places.push_back(well_place(x));
    if (!places.empty())
        return places;
    for (const MeasuredWell* const well : measured_wells(now.scene))
        if (places.empty())
            places = well->places(now);
    return places.empty() && now.parts.sediment ? places_by_thickness(now) : places;
}

LineTable burial_table(const RunFolder& run, const std::filesystem::path& drilled,
                       const std::vector<double>& wells) {
    LineTable table{"burial",
                    "stratum",
                    {"name", "stratum", "deposited_at_a", "deposited_thickness_m",
                     "deposited_porosity", "discs", "tectonic_subsidence_m"},
                    {"base_depth_m", "ground_depth_m", "thickness_m", "porosity", "extension_m",
                     "time_a", "age_a"}};
    if (!run.parts.sediment)
        return table;
    const double grain_density = run.parts.sediment->grain_density;
    std::vector<WellLines> all;
    dem::Travel drilled_at;
    {
        const Moment moment = run.read(drilled);
        const Observation now{run.scene, run.parts, moment.state, moment.events};
        drilled_at = moment.state.clock.travel;
        if (is_warm(now)) // the path of temperature through time
            table.point_columns.insert(table.point_columns.end(),
                                       {"temperature_c", "vitrinite_percent"});
        for (const WellPlace& place : well_places(now, wells))
            all.push_back(begin_well(place, now, grain_density));
    }
    if (std::ranges::all_of(all, [](const WellLines& well) { return well.rock.empty(); }))
        return table;
    for (const std::filesystem::path& snapshot : run.snapshots) {
        const Moment moment = run.read(snapshot);
        for (WellLines& well : all)
            add_moment(well, {run.scene, run.parts, moment.state, moment.events}, drilled_at,
                       grain_density);
        if (snapshot == drilled)
            break;
    }
    for (WellLines& well : all)
        for (auto& [stratum, line] : well.lines)
            if (!line.points.empty())
                table.lines.push_back(std::move(line));
    return table;
}

} // namespace listric::archive
