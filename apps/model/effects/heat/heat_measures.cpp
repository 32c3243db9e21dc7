#include "apps/model/effects/heat/heat_measures.hpp"

#include "apps/model/measure_names.hpp"
#include "apps/model/measured_well.hpp"
#include "apps/model/model.hpp"
#include "coupling/thermal_load.hpp"
#include "dem/columns.hpp"
#include "thermal/columns.hpp"
#include "thermal/heat.hpp"
#include "thermal/temperature_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace listric::effects::heat {

namespace {

using thermal::Heat;
using V = std::optional<double>;

const Heat* heat_in(const Observation& now) { return dem::find<const Heat>(now.events); }

/// Disc of sediment, as a well meets it.
struct WarmDisc {
    std::size_t row;
    double x, y, depth, volume, porosity, age, temperature, highest, reflectance;
};

std::vector<WarmDisc> warm_discs(const Observation& now) {
    std::vector<WarmDisc> warm;
    const Heat* const heat = heat_in(now);
    if (!heat)
        return warm;
    const dem::State& state = now.state;
    const dem::ConstDiscColumns d = dem::disc_columns(state);
    const auto temperature = state.discs.get(thermal::columns::temperature);
    const auto highest = state.discs.get(thermal::columns::max_temperature);
    const auto reflectance = state.discs.get(thermal::columns::vitrinite);
    const thermal::GroundLine ground = ground_line(state, now.parts.base, heat->setting().beside);
    const dem::Calendar calendar = make_calendar(now.scene);
    const bool compacts = state.discs.has(dem::columns::porosity);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] == 0 || !(reflectance[i] > 0.0)) // rock, or came since the last solution
            continue;
        const double porosity = compacts ? state.discs.get(dem::columns::porosity)[i]
                                         : heat->setting().pores.surface_porosity;
        warm.push_back({i, d.x[i], d.y[i], std::max(0.0, ground.depth({d.x[i], d.y[i]})),
                        d.mass[i] / heat->setting().grain_density / (1.0 - porosity), porosity,
                        calendar.years(dem::Travel(d.start_travel[i]), state.clock.travel),
                        temperature[i], highest[i], reflectance[i]});
    }
    return warm;
}

V depocentre(const std::vector<WarmDisc>& warm) {
    const WarmDisc* const deepest = deepest_of(warm);
    return deepest ? V(deepest->x) : V();
}

V subsidence_by_cooling(const Observation& now) {
    const dem::Motion& motion = now.parts.base.motion;
    if (!coupling::post_rift_subsidence(now.state, motion, 0.0))
        return std::nullopt;
    const V x = depocentre(warm_discs(now));
    return x ? coupling::post_rift_subsidence(now.state, motion, *x) : std::nan("");
}

V depth_of_300(const Observation& now) {
    if (!heat_in(now))
        return std::nullopt;
    const V x = depocentre(warm_discs(now));
    if (!x)
        return std::nan("");
    const thermal::TemperatureColumns columns(*heat_in(now), now.state, now.parts.base);
    const auto crossing = columns.crossing(*x, 300.0);
    return crossing ? columns.depth(*crossing) : std::nan("");
}

/// Mean of discs and points close to the base where it is deepest below the hanging wall.
V detachment_temperature(const Observation& now) {
    const Heat* const heat = heat_in(now);
    if (!heat)
        return std::nullopt;
    const double near = 4.0 * now.state.mean_radius;
    std::vector<dem::Point> base = thermal::base_points(now.state, now.parts.base, near);
    std::erase_if(base, [&](dem::Point p) { return p.x > now.right_end(); });
    const double lowest = std::ranges::min(base, {}, &dem::Point::y).y;
    std::erase_if(base, [&](dem::Point p) { return p.y > lowest + near; });
    const thermal::HeatCells cells = heat->cells(now.state);
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < cells.sites.count(); ++i) {
        const double x = cells.sites.x[i];
        const auto place = std::ranges::lower_bound(base, x, {}, &dem::Point::x);
        if (place == base.begin() || place == base.end() ||
            std::abs(cells.sites.y[i] - place->y) > near)
            continue;
        sum += cells.temperature[i];
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : std::nan("");
}

/// x of windows of 2 km over the hanging wall, and the heat flow through the ground, mW/m^2.
std::vector<dem::Point> heat_flows(const Observation& now) {
    std::vector<dem::Point> flows;
    const thermal::SurfaceHeatFlow flow(*heat_in(now), now.state, now.parts.base);
    for (double x = 1e3; x < now.right_end(); x += 1e3)
        flows.push_back({x, flow.at(x)});
    return flows;
}

V flow_at_depocentre(const Observation& now) {
    if (!heat_in(now))
        return std::nullopt;
    const V x = depocentre(warm_discs(now));
    return x ? thermal::SurfaceHeatFlow(*heat_in(now), now.state, now.parts.base).at(*x)
             : std::nan("");
}

V film_at_depocentre(const Observation& now) {
    if (!heat_in(now) || !now.parts.film)
        return std::nullopt;
    const V x = depocentre(warm_discs(now));
    const auto film = now.parts.film->now(now.state, now.parts.base);
    if (!x || !film)
        return x ? 0.0 : std::nan("");
    constexpr double half = 1e3; // m
    constexpr int samples = 20;
    const thermal::GroundLine ground =
        ground_line(now.state, now.parts.base, heat_in(now)->setting().beside);
    double sum = 0.0;
    for (int k = 0; k < samples; ++k) {
        const double at = *x + half * ((2.0 * k + 1.0) / samples - 1.0);
        sum += film->thickness(at, ground.height(at));
    }
    return sum / samples;
}

/// The least or greatest heat flow over the hanging wall.
template <auto choose> V flow_of(const Observation& now) {
    if (!heat_in(now))
        return std::nullopt;
    const std::vector<dem::Point> flows = heat_flows(now);
    return flows.empty() ? std::nan("") : choose(flows, {}, &dem::Point::y)->y;
}

template <auto take> V of_discs(const Observation& now) {
    return heat_in(now) ? take(warm_discs(now)) : std::nullopt;
}

V greatest_reflectance(const std::vector<WarmDisc>& warm) {
    const auto most = std::ranges::max_element(warm, {}, &WarmDisc::reflectance);
    return most == warm.end() ? std::nan("") : most->reflectance;
}

V oil_window(const std::vector<WarmDisc>& warm) {
    double area = 0.0;
    for (const WarmDisc& disc : warm)
        if (disc.reflectance >= 0.6 && disc.reflectance <= 1.3)
            area += disc.volume;
    return area;
}

V balance_error(const Observation& now) {
    const Heat* const heat = heat_in(now);
    return heat ? V(heat->balance_error()) : std::nullopt;
}

std::optional<std::vector<NamedNumbers>> flow_profile(const Observation& now) {
    if (!heat_in(now))
        return std::nullopt;
    std::vector<NamedNumbers> rows;
    for (const dem::Point& p : heat_flows(now))
        rows.push_back({{"x_m", p.x}, {"heat_flow_mw_per_m2", p.y}});
    return rows;
}

/// Means of sediment about x in bins of depth.
std::vector<WarmDisc> well_at(const Observation& now, double x) {
    constexpr double half = 1000.0; // m to either side
    const double step = std::max(250.0, 4.0 * now.state.mean_radius);
    std::vector<WarmDisc> bins;
    for (const WarmDisc& disc : warm_discs(now)) {
        if (std::abs(disc.x - x) > half)
            continue;
        const auto bin = static_cast<std::size_t>(disc.depth / step);
        if (bin >= bins.size())
            bins.resize(bin + 1, {});
        WarmDisc& sum = bins[bin];
        sum.volume += disc.volume;
        for (double WarmDisc::*const number :
             {&WarmDisc::y, &WarmDisc::depth, &WarmDisc::porosity, &WarmDisc::age,
              &WarmDisc::temperature, &WarmDisc::highest, &WarmDisc::reflectance})
            sum.*number += disc.volume * disc.*number;
    }
    std::erase_if(bins, [](const WarmDisc& sum) { return sum.volume == 0.0; });
    for (WarmDisc& mean : bins) {
        for (double WarmDisc::*const number :
             {&WarmDisc::y, &WarmDisc::depth, &WarmDisc::porosity, &WarmDisc::age,
              &WarmDisc::temperature, &WarmDisc::highest, &WarmDisc::reflectance})
            mean.*number /= mean.volume;
        mean.x = x;
    }
    return bins;
}

constexpr Measure<WarmDisc> of_point[] = {
    {"depth_m", "m", "depth", "mean depth below the ground", taken<&WarmDisc::depth>},
    {"temperature_c", "degC", "temperature", "temperature", taken<&WarmDisc::temperature>},
    {"max_temperature_c", "degC", "highest temperature",
     "highest temperature since the sediment was laid down", taken<&WarmDisc::highest>},
    {"vitrinite_percent", "%", "vitrinite reflectance",
     "vitrinite reflectance %Ro by EASY%Ro, from the sediment's temperatures since it was laid "
     "down",
     taken<&WarmDisc::reflectance>},
    {"porosity", "1", "porosity", "porosity", taken<&WarmDisc::porosity>},
    {"age_a", "a", "age", "time since the sediment was laid down", taken<&WarmDisc::age>},
};

std::vector<WellPlace> places(const Observation& now) {
    return places_of_wells(warm_discs(now), now.right_end());
}

/// Isotherms to and fro, so that they are one line: its turns are at the section's ends.
std::vector<double> isotherms(const Observation& now) {
    std::vector<double> rows;
    const Heat* const heat = heat_in(now);
    if (!heat)
        return rows;
    const thermal::TemperatureColumns columns(*heat_in(now), now.state, now.parts.base);
    const auto ends = section_ends(heat->parameters(), heat->setting());
    std::vector<double> places{ends.left + 5e3};
    for (double x = -20e3; x <= now.right_end() + 20e3; x += 500.0)
        places.push_back(x);
    places.push_back(ends.right - 5e3);
    for (double temperature = 50.0; temperature <= 400.0; temperature += 50.0) {
        for (const double x : places)
            if (const auto p = columns.crossing(x, temperature))
                rows.insert(rows.end(), {p->x, p->y});
        std::ranges::reverse(places);
    }
    return rows;
}

std::vector<double> reflectance_ink(const Observation& now) {
    std::vector<double> rows(now.state.discs.rows(), 0.0);
    for (const WarmDisc& disc : warm_discs(now))
        rows[disc.row] = std::clamp(0.5 * disc.reflectance, 0.0, 1.0);
    return rows;
}

} // namespace

std::vector<Measure<Observation>> heat_measures() {
    using enum OverTime;
    return {
        {"surface_heat_flow_mw_per_m2", "mW/m2", "heat flow at the depocentre",
         "heat flow through the ground at the depocentre, by the temperatures of the uppermost "
         "kilometre; mean over 1 km to either side",
         flow_at_depocentre},
        {"least_heat_flow_mw_per_m2", "mW/m2", "least heat flow",
         "least heat flow through the ground of the hanging wall, means over 2 km",
         flow_of<std::ranges::min_element>},
        {"greatest_heat_flow_mw_per_m2", "mW/m2", "greatest heat flow",
         "greatest heat flow through the ground of the hanging wall, means over 2 km",
         flow_of<std::ranges::max_element>},
        {"detachment_temperature_c", "degC", "temperature of the detachment",
         "mean temperature of discs and rock within two disc diameters of the base where it is "
         "deepest below the hanging wall",
         detachment_temperature},
        {"isotherm_300_depth_m", "m", "depth of 300 °C", "depth of 300 °C at the depocentre",
         depth_of_300},
        {"vitrinite_max_percent", "%", "greatest vitrinite reflectance",
         "greatest vitrinite reflectance %Ro of sediment", of_discs<greatest_reflectance>},
        {"oil_window_area_m2", "m2", "sediment in the oil window",
         "area of sediment with a vitrinite reflectance of 0.6 to 1.3 %", of_discs<oil_window>},
        {coupling::thermal_load_name, "N/m", "weight of cold rock",
         "weight that rock of the section has by its temperatures, less that at the start: below 0 "
         "where it is hotter, and the base that bends is lifted"},
        {coupling::film_load_name, "N/m", "weight of sediment without discs",
         "weight on the base of the sediment that fills the room between ground and target which "
         "no disc fits in; without the water in its pores, and less what it displaces where pore "
         "water presses on the base"},
        {"film_thickness_m", "m", "sediment without discs at the depocentre",
         "thickness of the sediment that fills the room between ground and target which no disc "
         "fits in, at the depocentre; mean over 1 km to either side",
         film_at_depocentre},
        {"post_rift_subsidence_m", "m", "subsidence since the wall stopped",
         "by how much a base that bends has sunk below the depocentre since the wall last moved; 0 "
         "while it moves",
         subsidence_by_cooling},
        {heat_balance_error, "1", "error of the heat's balance",
         "heat that came less heat that went and is there, over the sum of both. Round-off",
         balance_error, largest, "below 1e-10"},
    };
}

std::vector<MeasuredObjects> heat_objects() {
    MeasuredObjects list{
        "heat_flow_profile",
        "",
        "heat flow along the section",
        "heat flow through the ground every kilometre, means over 2 km",
        {{"x_m", "m", "x", "place along the section"},
         {"heat_flow_mw_per_m2", "mW/m2", "heat flow", "heat flow through the ground"}},
        flow_profile};
    return {list};
}

std::vector<FigureLayer> heat_layers() {
    return {{"isotherms", LayerKind::line, "isotherms, every 50 °C", "#c2410c", isotherms},
            {"vitrinite", LayerKind::discs, "vitrinite reflectance, %", "#3f2204", reflectance_ink,
             2.0}};
}

MeasuredWell heat_well() { return measured_well<WarmDisc, of_point, well_at>(places); }

} // namespace listric::effects::heat
