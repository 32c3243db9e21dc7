#include "thermal/heat.hpp"

#include "dem/columns.hpp"
#include "dem/numbers/elementary.hpp"
#include "thermal/columns.hpp"
#include "thermal/maturity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace listric::thermal {

using namespace dem;

namespace {

constexpr std::array<const char*, reactions> kerogen{
    "kerogen_1",  "kerogen_2",  "kerogen_3",  "kerogen_4",  "kerogen_5",
    "kerogen_6",  "kerogen_7",  "kerogen_8",  "kerogen_9",  "kerogen_10",
    "kerogen_11", "kerogen_12", "kerogen_13", "kerogen_14", "kerogen_15",
    "kerogen_16", "kerogen_17", "kerogen_18", "kerogen_19", "kerogen_20"};

double sum_of_products(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

} // namespace

Heat::Heat(const HeatParameters& p, const HeatSetting& setting, HeatPoints& points,
           const Schedule& schedule)
    : Event("heat", schedule), p_(p), setting_(setting), points_(points), geotherm_(p) {
    for (const char* name :
         {Sums::initial, Sums::stored, Sums::discs, Sums::came, Sums::eroded, Sums::expelled,
          Sums::rose, Sums::sank, Sums::produced, Sums::floor, Sums::ground})
        memory.add<double>(name, "J/m", 0.0);
    memory.resize(1);
}

void Heat::begin(State& state) {
    state.discs.add(columns::temperature, p_.surface_temperature);
    state.discs.add(columns::max_temperature);
    state.discs.add(columns::heat_capacity);
    state.discs.add(columns::vitrinite);
    for (const char* name : kerogen)
        state.discs.add<double>(name, "1", 0.0);
}

HeatCells Heat::cells(const State& state) const {
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<double> radius = rock_radii(state);
    const bool compacts = state.discs.has(dem::columns::porosity);
    const bool layered = state.discs.has(dem::columns::layer);
    const auto temperature = state.discs.get(columns::temperature);
    const auto known = state.discs.get(columns::heat_capacity);
    HeatCells all;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        all.sites.add({d.x[i], d.y[i]}, radius[i], 5.0 * state.mean_radius);
        all.temperature.push_back(temperature[i]);
        all.is_new.push_back(known[i] < 0.0);
        if (d.stratum[i] > 0) {
            const double porosity = compacts ? state.discs.get(dem::columns::porosity)[i]
                                             : setting_.pores.surface_porosity;
            const double grains = d.mass[i] / setting_.grain_density;
            all.conductivity.push_back(sediment_conductivity(p_.grain_conductivity, porosity));
            all.capacity.push_back(grains *
                                   (grain_capacity + water_capacity * porosity / (1.0 - porosity)));
            all.production.push_back(grains * p_.heat_production);
            all.density.push_back((1.0 - porosity) * setting_.grain_density);
        } else {
            const std::size_t layer = layered ? state.discs.get(dem::columns::layer)[i] : 0;
            const double area = d.mass[i] / setting_.rock_densities[layer];
            all.conductivity.push_back(p_.conductivity);
            all.capacity.push_back(area * crust_capacity);
            all.production.push_back(area * p_.heat_production);
            all.density.push_back(setting_.rock_densities[layer]);
        }
    }
    using C = HeatPoints::Columns;
    const auto x = points_.get<double>(C::x), y = points_.get<double>(C::y);
    const auto area = points_.get<double>(C::area), reach = points_.get<double>(C::reach);
    const auto its_temperature = points_.get<double>(C::temperature);
    const auto crust = points_.get<std::uint8_t>(C::crust);
    for (std::size_t k = 0; k < x.size(); ++k) {
        all.sites.add({x[k], y[k]}, state.mean_radius, reach[k]);
        all.temperature.push_back(its_temperature[k]);
        all.is_new.push_back(false);
        all.conductivity.push_back(crust[k] ? p_.conductivity : p_.mantle_conductivity);
        all.capacity.push_back(area[k] * (crust[k] ? crust_capacity : mantle_capacity));
        all.production.push_back(crust[k] ? area[k] * p_.heat_production : 0.0);
        all.density.push_back(crust[k] ? setting_.crust_density : setting_.mantle_density);
    }
    return all;
}

GroundLine Heat::solved_ground(const State& state, const RigidBase& base) const {
    constexpr double almost = 0.01; // of the time between solutions: a moment is a cycle early
    const double since = state.clock.travel.m - schedule().due(applied).m;
    return ground_line(state, base, setting_.beside,
                       std::max(0.0, since) + almost * schedule().gap(applied + 1).m);
}

std::vector<double> Heat::blanket(const State& state, const RigidBase& base,
                                  const GroundLine& ground, const Sites& sites) const {
    const auto& fill = setting_.beside.film;
    const auto film = fill ? fill->now(state, base) : std::nullopt;
    const double of_film =
        film ? sediment_conductivity(p_.grain_conductivity, film->porosity) : 1.0;
    std::vector<double> resistance;
    for (std::size_t i = 0; i < sites.count(); ++i) {
        const double x = sites.x[i], sediment = ground.sediment(x);
        resistance.push_back(film ? film->thickness(x, ground.height(x)) / of_film : 0.0);
        if (i < state.discs.rows() || sediment <= 0.0)
            continue;
        // No more than lies on the cell's way to the ground, which may be a cliff.
        const Point place{x, sites.y[i]};
        const auto foot = ground.nearest(place, std::abs(ground.depth(place)));
        const double porosity = setting_.pores.surface_porosity *
                                exponential(-setting_.pores.coefficient * 0.5 * sediment);
        resistance.back() +=
            std::clamp(foot->distance, 0.0, sediment) *
            (1.0 / sediment_conductivity(p_.grain_conductivity, porosity) - 1.0 / p_.conductivity);
    }
    return resistance;
}

bool Heat::start(State& state, const RigidBase& base) {
    const GroundLine ground = ground_line(state, base, setting_.beside);
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    const auto temperature = state.discs.get(columns::temperature);
    for (std::size_t i = 0; i < d.x.size(); ++i)
        temperature[i] = geotherm_.at(ground.depth({d.x[i], d.y[i]}));
    const CutCells cut = cut_cells(cells(state).sites, ends(), ground, knots_);
    points_.set_areas(cut.faceted.cells, d.x.size());
    const HeatCells all = cells(state);
    mass_lost_ = mass_lost(all, cut.parts, knots_);
    const std::size_t discs = d.x.size();
    std::copy_n(all.capacity.begin(), discs, state.discs.get(columns::heat_capacity).begin());
    std::copy_n(all.temperature.begin(), discs, state.discs.get(columns::max_temperature).begin());
    const double in_all = sum_of_products(all.capacity, all.temperature);
    memory.get<double>(Sums::initial)[0] = memory.get<double>(Sums::stored)[0] = in_all;
    memory.get<double>(Sums::discs)[0] =
        sum_of_products(std::span(all.capacity).first(discs), all.temperature);
    return false;
}

/// Books what came, went and was expelled since the last application.
void Heat::book_discs(State& state, const HeatCells& cells) {
    const auto capacity = state.discs.get(columns::heat_capacity);
    double known = 0.0;
    for (std::size_t i = 0; i < capacity.size(); ++i) {
        const double temperature = cells.temperature[i];
        if (capacity[i] < 0.0) {
            memory.get<double>(Sums::came)[0] += cells.capacity[i] * temperature;
        } else {
            known += capacity[i] * temperature;
            memory.get<double>(Sums::expelled)[0] +=
                (capacity[i] - cells.capacity[i]) * temperature;
        }
        capacity[i] = cells.capacity[i];
    }
    memory.get<double>(Sums::eroded)[0] += remembered(Sums::discs) - known;
    memory.get<double>(Sums::rose)[0] += points_.carried_in();
    memory.get<double>(Sums::sank)[0] += points_.carried_out();
}

/// Maturity of sediment after a time in which its temperature has come to that of now.
void Heat::ripen(State& state, std::span<const double> before, double seconds) const {
    const auto temperature = std::as_const(state).discs.get(columns::temperature);
    const auto stratum = disc_columns(std::as_const(state)).stratum;
    const auto highest = state.discs.get(columns::max_temperature);
    const auto vitrinite = state.discs.get(columns::vitrinite);
    std::array<std::span<double>, reactions> integrals;
    for (std::size_t r = 0; r < reactions; ++r)
        integrals[r] = state.discs.get<double>(kerogen[r]);
    for (std::size_t i = 0; i < temperature.size(); ++i) {
        highest[i] = std::max(highest[i], temperature[i]);
        if (stratum[i] == 0)
            continue;
        Maturity maturity;
        for (std::size_t r = 0; r < reactions; ++r)
            maturity[r] = integrals[r][i];
        mature(maturity, before[i], temperature[i], seconds);
        for (std::size_t r = 0; r < reactions; ++r)
            integrals[r][i] = maturity[r];
        vitrinite[i] = vitrinite_reflectance(maturity);
    }
}

bool Heat::apply(State& state, const RigidBase& base) {
    HeatCells all = cells(state);
    book_discs(state, all);
    const GroundLine ground = ground_line(state, base, setting_.beside);
    const CutCells cut = cut_cells(all.sites, ends(), ground, knots_);
    const HeatNetwork network = heat_network(all.sites, cut.faceted, all.conductivity,
                                             blanket(state, base, ground, all.sites));
    const double seconds = schedule().seconds(applied + 1);
    const std::vector<double> before = all.temperature;
    const HeatFlows flows =
        conduct(network, all.capacity, all.production,
                {p_.surface_temperature, p_.base_temperature}, seconds, all.temperature);
    memory.get<double>(Sums::produced)[0] += flows.produced;
    memory.get<double>(Sums::floor)[0] += flows.through_floor;
    memory.get<double>(Sums::ground)[0] += flows.through_ground;
    const std::size_t discs = state.discs.rows();
    memory.get<double>(Sums::stored)[0] = sum_of_products(all.capacity, all.temperature);
    memory.get<double>(Sums::discs)[0] =
        sum_of_products(std::span(all.capacity).first(discs), all.temperature);
    std::copy_n(all.temperature.begin(), discs, state.discs.get(columns::temperature).begin());
    std::ranges::copy(std::span(all.temperature).subspan(discs), points_.temperature().begin());
    mass_lost_ = mass_lost(all, cut.parts, knots_);
    ripen(state, before, seconds);
    return false;
}

double Heat::balance_error() const {
    double missing = remembered(Sums::stored), terms = std::abs(missing);
    const auto count = [&](const char* name, double sign) {
        missing += sign * remembered(name);
        terms += std::abs(remembered(name));
    };
    for (const char* name : {Sums::initial, Sums::came, Sums::rose, Sums::produced, Sums::floor})
        count(name, -1.0);
    for (const char* name : {Sums::eroded, Sums::expelled, Sums::sank, Sums::ground})
        count(name, 1.0);
    return terms > 0.0 ? missing / terms : 0.0;
}

double Heat::start_temperature(Point p) const {
    return geotherm_.at(setting_.ground.height(p.x) - p.y);
}

std::vector<double> Heat::mass_lost(const State& state, const RigidBase& base,
                                    std::span<const double> knots) const {
    const HeatCells all = cells(state);
    const GroundLine ground = ground_line(state, base, setting_.beside);
    return mass_lost(all, cut_cells(all.sites, ends(), ground, knots).parts, knots);
}

std::vector<double> Heat::mass_lost(const HeatCells& cells, std::span<const CellPart> parts,
                                    std::span<const double> knots) const {
    std::vector<double> sums(knots.size(), 0.0);
    for (const CellPart& part : parts) {
        const std::size_t i = part.cell, k = part.strip;
        const double warmer =
            cells.temperature[i] - start_temperature({cells.sites.x[i], cells.sites.y[i]});
        const double mass = p_.expansion * cells.density[i] * warmer * part.area;
        const double right = (part.x - knots[k]) / (knots[k + 1] - knots[k]);
        sums[k] += (1.0 - right) * mass;
        sums[k + 1] += right * mass;
    }
    for (std::size_t k = 0; k < sums.size(); ++k)
        sums[k] /= 0.5 * (knots[std::min(k + 1, knots.size() - 1)] - knots[k > 0 ? k - 1 : 0]);
    return sums;
}

SurfaceHeatFlow::SurfaceHeatFlow(const Heat& heat, const State& state, const RigidBase& base)
    : ground_temperature_(heat.parameters().surface_temperature) {
    constexpr double deepest = 6e3; // m: where points are coarse none is nearer
    const GroundLine ground = heat.solved_ground(state, base);
    const HeatCells all = heat.cells(state);
    const std::vector<double> blanket = heat.blanket(state, base, ground, all.sites);
    for (std::size_t i = 0; i < all.sites.count(); ++i) {
        if (all.is_new[i])
            continue;
        const double x = all.sites.x[i], depth = ground.depth({x, all.sites.y[i]});
        if (depth > 0.0 && depth <= deepest)
            sites_.push_back({x, depth, all.temperature[i], 1.0 / all.conductivity[i], blanket[i],
                              i >= state.discs.rows() && ground.sediment(x) > 0.0});
    }
    std::ranges::sort(sites_, [](const Site& a, const Site& b) {
        return a.x != b.x ? a.x < b.x : a.depth < b.depth;
    });
}

double SurfaceHeatFlow::at(double x) const {
    constexpr double deep = 1e3; // m
    double half = 1e3;
    std::vector<Site> window;
    for (double depth = deep; window.empty() && half < 1e5; half *= 2.0, depth = 3.0 * half) {
        const auto first = std::ranges::lower_bound(sites_, x - half, {}, &Site::x);
        for (auto site = first; site != sites_.end() && site->x <= x + half; ++site)
            if (site->depth <= depth)
                window.push_back(*site);
    }
    std::ranges::sort(window, {}, &Site::depth);
    double resistivities = 0.0, count = 0.0, flow = 0.0, square = 0.0;
    for (const Site& site : window) {
        if (!site.is_covered) {
            resistivities += site.resistivity;
            ++count;
        }
        const double mean = site.is_covered ? site.resistivity : resistivities / count;
        const double resistance = site.blanket + site.depth * mean;
        flow += resistance * (site.temperature - ground_temperature_);
        square += resistance * resistance;
    }
    return square > 0.0 ? 1e3 * flow / square : std::numeric_limits<double>::quiet_NaN();
}

} // namespace listric::thermal
