#include "fluid/pore_fluid.hpp"

#include "dem/columns.hpp"
#include "dem/contacts/grain_columns.hpp"
#include "dem/cycle_physics.hpp"
#include "dem/pushes.hpp"
#include "fluid/base_pressure.hpp"
#include "fluid/columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

namespace listric::fluid {

using namespace dem;

namespace {

constexpr double greatest_lift = 0.99; ///< of a disc's weight: without any it would fly

/// The columns by cell.
std::vector<double> gathered(const State& state, std::string_view column, const PoreCells& cells) {
    const auto all = state.discs.get<double>(column);
    std::vector<double> values;
    values.reserve(cells.count());
    for (const std::int32_t row : cells.rows)
        values.push_back(all[static_cast<std::size_t>(row)]);
    return values;
}

void scatter(std::span<const double> values, const PoreCells& cells, State& state,
             std::string_view column) {
    const auto all = state.discs.get<double>(column);
    for (std::size_t k = 0; k < values.size(); ++k)
        all[static_cast<std::size_t>(cells.rows[k])] = values[k];
}

[[noreturn]] void refuse(const State& state, const PoreCells& cells, std::size_t cell,
                         double excess_pressure, double highest) {
    const ConstDiscColumns d = disc_columns(state);
    const auto i = static_cast<std::size_t>(cells.rows[cell]);
    char text[400];
    std::snprintf(text, sizeof text,
                  "pore fluid: the pressure does not converge at disc %lld (x %.0f m, y %.0f m, "
                  "excess pressure %.3g Pa, at most %.3g); a smaller pore_fluid.interval_a or a "
                  "pore_fluid.permeability_m2 nearer to that of mud, 1e-18, may help",
                  static_cast<long long>(d.id[i]), d.x[i], d.y[i], excess_pressure, highest);
    throw NumericalFailure(text);
}

double sum(std::span<const double> values) {
    double all = 0.0;
    for (const double value : values)
        all += value;
    return all;
}

} // namespace

double buoyant_share(double fluid_density, double grain_density) {
    return 1.0 - fluid_density / grain_density;
}

PoreLaw pore_law(const PoreFluidParameters& fluid, const WetSediment& sediment, double gravity,
                 std::int32_t stratum) {
    const PorosityLaw pores = sediment.pores_of(stratum);
    return {pores.surface_porosity, pores.coefficient,
            (sediment.grain_density - fluid.density) * gravity, fluid.compressibility,
            fluid.rebound};
}

PoreFluid::PoreFluid(const PoreFluidParameters& fluid, const WetSediment& sediment, double gravity,
                     const dem::Calendar& calendar, const WaterSurface& surface)
    : Event("pore_fluid", {fluid.interval, calendar}), fluid_(fluid), sediment_(sediment),
      surface_(surface), flows_(sediment.flows), fluid_weight_(fluid.density * gravity) {
    if (flows_.empty())
        flows_ = {fluid.flow};
    laws_.assign(flows_.size(), pore_law(fluid, sediment, gravity, 0));
    for (std::size_t k = 0; k < sediment.beds.list.size(); ++k) {
        laws_[k].surface_porosity = sediment.beds.list[k].pores.surface_porosity;
        laws_[k].decay = sediment.beds.list[k].pores.coefficient;
    }
    for (const char* name : {Sums::came, Sums::surface, Sums::vented, Sums::eroded, Sums::left})
        memory.add<double>(name, "m^2", 0.0);
    for (const char* name : {Sums::newton, Sums::capped, Sums::enclosed})
        memory.add<double>(name, "1", 0.0);
    memory.add<double>(Sums::fill, "1", 1.0);
    if (surface_.loads_base)
        memory.add<double>(Sums::closure, "1", 0.0);
    memory.resize(1);
}

void PoreFluid::begin(State& state) {
    state.discs.add(dem::columns::excess_pressure);
    state.discs.add(columns::pore_water);
    state.discs.add(columns::burial);
    if (sediment_.has_rock())
        state.discs.add(columns::start_grains);
    state.discs.add(dem::columns::wanted_porosity, laws_.front().surface_porosity);
    state.discs.add(columns::overpressure_ratio);
    state.discs.add(columns::darcy_x);
    state.discs.add(columns::darcy_y);
    if (fluid_.pushes)
        add_pushes(state);
    if (surface_.loads_base)
        add_base_pressure(state);
}

/// Books the water that has come with sediment and gone with it since the last solution; at the
/// first one that of porous rock, too.
void PoreFluid::take_stock(State& state, const PoreCells& cells) {
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    const auto water = state.discs.get(columns::pore_water);
    double known = 0.0, came = 0.0;
    for (const std::int32_t row : cells.rows) {
        const auto i = static_cast<std::size_t>(row);
        if (water[i] >= 0.0) {
            known += water[i];
            continue;
        }
        const double porosity = law(d.stratum[i]).surface_porosity;
        const PorousRock* const rock = cells.rock[static_cast<std::size_t>(cells.cell_of[i])];
        water[i] = (rock ? rock->porosity : porosity / (1.0 - porosity)) * d.mass[i] /
                   sediment_.grain_density;
        came += water[i];
    }
    memory.get<double>(Sums::eroded)[0] += remembered(Sums::left) - known;
    memory.get<double>(Sums::came)[0] += came;
}

/// Height of the grains above a place as they would weigh in water, m: those above the level weigh
/// more.
double PoreFluid::grains_of(const WetGround& ground, Point p, double of_discs, double level) const {
    const double grains = ground.grains(p, of_discs), depth = ground.depth(p);
    if (!surface_.ends || !(depth > 0.0))
        return grains;
    const double dry = std::clamp((p.y + depth - level) / depth, 0.0, 1.0);
    return grains * (1.0 + dry * fluid_weight_ / grain_weight());
}

/// Sediment and porous rock by cell.
struct PoreFluid::Mud {
    std::vector<const PoreLaw*> laws;    ///< of sediment
    std::vector<const PorousRock*> rock; ///< null: sediment
    /// Of what is kept, m^2: grains of sediment, all of rock, whose porosity counts as 0.
    std::vector<double> solid;
    std::vector<double> grains, conductivity, ratios, burial, porosity;
    std::vector<double> start_grains; ///< of rock; empty: there is none
    std::vector<FaultFactors> faults; ///< empty: none matter
    PressureBounds bounds;
};

PoreFluid::Mud PoreFluid::mud_of(const State& state, const WetGround& ground,
                                 const PoreCells& cells) const {
    const double level = surface_.level.at(state);
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<double> of_discs =
        grains_above(state, state.discs.get(dem::columns::porosity));
    const auto matter = [](const SedimentFlow& f) { return f.faults.matter(); };
    const bool has_faults =
        std::ranges::any_of(flows_, matter) ||
        std::ranges::any_of(sediment_.rocks, [&](const auto& r) { return r && matter(r->flow); });
    Mud mud;
    mud.rock = cells.rock;
    mud.burial = gathered(state, columns::burial, cells);
    mud.porosity = gathered(state, dem::columns::wanted_porosity, cells);
    if (sediment_.has_rock())
        mud.start_grains = gathered(state, columns::start_grains, cells);
    for (std::size_t k = 0; k < cells.count(); ++k) {
        const auto i = static_cast<std::size_t>(cells.rows[k]);
        const SedimentFlow& flow = cells.rock[k] ? cells.rock[k]->flow : flow_of(d.stratum[i]);
        if (cells.rock[k])
            mud.porosity[k] = 0.0;
        mud.laws.push_back(&law(d.stratum[i]));
        mud.grains.push_back(grains_of(ground, {d.x[i], d.y[i]}, of_discs[i], level));
        mud.solid.push_back(d.mass[i] / sediment_.grain_density);
        mud.conductivity.push_back(permeability(flow.permeability, mud.porosity[k]));
        mud.ratios.push_back(flow.ratio);
        if (has_faults)
            mud.faults.push_back(flow.faults);
        mud.bounds.highest.push_back(fluid_.fracture_ratio * grain_weight() * mud.grains[k]);
        // Nearer than what it drains through: there is next to nothing that could fracture.
        mud.bounds.at_ground.push_back(cells.depths[k] + cells.pending[k] <
                                       cells.ground_distances[k]);
        mud.bounds.lowest.push_back(-fluid_weight_ * std::max(0.0, level - d.y[i]));
        if (cells.rock[k] && mud.start_grains[k] < 0.0)
            mud.start_grains[k] = mud.grains[k];
    }
    return mud;
}

VoidRatio PoreFluid::pores(const Mud& mud, std::size_t k, double u) const {
    if (mud.rock[k])
        return rock_pores(*mud.rock[k], grain_weight() * (mud.grains[k] - mud.start_grains[k]), u);
    return void_ratio(*mud.laws[k], mud.grains[k], mud.burial[k], u);
}

/// Water leaves through the stratum that is to come as through more of the cell's own mud; where it
/// is of another bed, or the cell is rock, by as much more as that conducts less when fresh.
void PoreFluid::cover(const State& state, std::int32_t next_stratum, PoreCells& cells) const {
    const auto fresh = [&](std::int32_t stratum) {
        return permeability(flow_of(stratum).permeability, law(stratum).surface_porosity);
    };
    const ConstDiscColumns d = disc_columns(state);
    const double next = fresh(next_stratum);
    for (std::size_t k = 0; k < cells.count(); ++k)
        if (const double pending = cells.pending[k]; pending > 0.0) {
            const double own = cells.rock[k]
                                   ? permeability(cells.rock[k]->flow.permeability, 0.0)
                                   : fresh(d.stratum[static_cast<std::size_t>(cells.rows[k])]);
            cells.ground_distances[k] += pending * (own / next - 1.0);
        }
}

bool PoreFluid::apply(State& state, const RigidBase& base) {
    PoreCells cells = pore_cells(state, base, sediment_);
    take_stock(state, cells);
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    const WetGround ground(state, base.motion, sediment_);
    Mud mud = mud_of(state, ground, cells);
    if (!sediment_.beds.empty() || sediment_.has_rock())
        cover(state, ground.next_stratum(), cells);
    if (sediment_.has_rock())
        cells.permeability = mud.conductivity;
    const Storage storage = [&](std::size_t k, double u) {
        const VoidRatio e = pores(mud, k, u);
        const double swelling = 1.0 + fluid_.compressibility * u;
        return Stored{mud.solid[k] * e.value * swelling,
                      mud.solid[k] * (e.slope * swelling + e.value * fluid_.compressibility)};
    };
    const Bedding beds = bedding(state, cells, std::move(mud.ratios));
    const FlowNetwork network =
        flow_network(state, cells, mud.conductivity, fluid_.viscosity, mud.faults, beds);
    std::vector<double> u = gathered(state, dem::columns::excess_pressure, cells);
    std::vector<double> water = gathered(state, columns::pore_water, cells);
    const FlowOutcome outcome =
        flow(network, storage, mud.bounds, schedule().seconds(applied + 1), water, u);
    if (outcome.stuck)
        refuse(state, cells, *outcome.stuck, u[*outcome.stuck], mud.bounds.highest[*outcome.stuck]);
    std::vector<double> ratio;
    for (std::size_t k = 0; k < cells.count(); ++k) {
        if (!mud.rock[k]) {
            const PoreLaw& law = *mud.laws[k];
            mud.burial[k] = std::max(mud.burial[k], burial_under(law, mud.grains[k], u[k]));
            mud.porosity[k] = porosity_at(law, mud.burial[k]);
        }
        // At the ground both are next to nothing.
        const double least =
            d.radius[static_cast<std::size_t>(cells.rows[k])] * (1.0 - mud.porosity[k]);
        ratio.push_back(u[k] / (grain_weight() * std::max(mud.grains[k], least)));
    }
    std::vector<double> darcy_x, darcy_y;
    const std::vector<Point> gradients = pressure_gradients(cells, u);
    for (std::size_t k = 0; k < cells.count(); ++k) {
        const Point drives = beds.flow_of(k, gradients[k]);
        darcy_x.push_back(-mud.conductivity[k] / fluid_.viscosity * drives.x);
        darcy_y.push_back(-mud.conductivity[k] / fluid_.viscosity * drives.y);
    }
    scatter(darcy_x, cells, state, columns::darcy_x);
    scatter(darcy_y, cells, state, columns::darcy_y);
    scatter(u, cells, state, dem::columns::excess_pressure);
    scatter(water, cells, state, columns::pore_water);
    scatter(mud.burial, cells, state, columns::burial);
    if (!mud.start_grains.empty())
        scatter(mud.start_grains, cells, state, columns::start_grains);
    scatter(mud.porosity, cells, state, dem::columns::wanted_porosity);
    scatter(ratio, cells, state, columns::overpressure_ratio);
    memory.get<double>(Sums::surface)[0] += outcome.surface;
    memory.get<double>(Sums::vented)[0] += outcome.vented;
    memory.get<double>(Sums::left)[0] = sum(water);
    double& newton = memory.get<double>(Sums::newton)[0];
    newton = std::max(newton, static_cast<double>(outcome.steps));
    memory.get<double>(Sums::enclosed)[0] =
        cells.count() == 0
            ? 0.0
            : static_cast<double>(enclosed_cells(network)) / static_cast<double>(cells.count());
    push(state, base, cells);
    return false;
}

/// Weight in water of what is pending on a cell at the ground, N: it presses on the disc, too, or
/// the water that it has loaded would lift what it does not yet hold down. Where the stratum comes
/// at this very moment, its discs press.
double PoreFluid::pending_load(const PoreCells& cells, std::size_t cell) const {
    const Travel due = next_due();
    const Travel stratum = sediment_.deposition.due(sediment_.deposition.nearest(due));
    constexpr double almost = 1e-6; // of the time between solutions: round-off
    if (std::abs((due - stratum).m) <= almost * schedule().gap(applied + 1).m)
        return 0.0;
    const std::int64_t next = sediment_.deposition.nearest(stratum);
    const double fresh = 1.0 - law(static_cast<std::int32_t>(next)).surface_porosity;
    return fresh * grain_weight() * std::max(0.0, cells.pending[cell]) *
           cells.surface_lengths[cell];
}

/// Hands the pressures to the discs as forces.
void PoreFluid::push(State& state, const RigidBase& base, const PoreCells& cells) {
    const ConstDiscColumns d = disc_columns(std::as_const(state));
    const std::vector<double> porosity = gathered(state, dem::columns::wanted_porosity, cells);
    std::vector<double> volume; // of the mud, m^2
    double cell_area = 0.0;
    for (std::size_t k = 0; k < cells.count(); ++k) {
        const auto i = static_cast<std::size_t>(cells.rows[k]);
        volume.push_back(d.mass[i] / sediment_.grain_density / (1.0 - porosity[k]));
        cell_area += cells.faceted.cells[k].area;
    }
    memory.get<double>(Sums::fill)[0] = cell_area > 0.0 ? sum(volume) / cell_area : 1.0;
    if (!fluid_.pushes)
        return;
    const std::vector<double> u = gathered(state, dem::columns::excess_pressure, cells);
    std::vector<Point> force = pore_forces(state, cells, volume, u);
    if (surface_.loads_base)
        lift_what_comes(cells, u, force);
    const auto push_x = state.discs.get(dem::columns::push_x);
    const auto push_y = state.discs.get(dem::columns::push_y);
    double capped = 0.0;
    for (std::size_t i = 0; i < force.size(); ++i) {
        push_x[i] = force[i].x;
        push_y[i] = force[i].y;
        if (cells.cell_of[i] < 0)
            continue;
        const double load = pending_load(cells, static_cast<std::size_t>(cells.cell_of[i]));
        const double most = greatest_lift * d.mass[i] / sediment_.grain_density * grain_weight();
        const bool flies = force[i].y - load > most;
        capped += flies;
        push_y[i] = flies ? most : force[i].y - load;
        force[i].y = push_y[i] + load;
    }
    memory.get<double>(Sums::capped)[0] =
        cells.count() > 0 ? capped / static_cast<double>(cells.count()) : 0.0;
    if (!surface_.loads_base)
        return;
    // What the lift of single discs was cut by is missing below, too.
    memory.get<double>(Sums::closure)[0] = press_base(state, base, cells, u, force);
    const auto lift = state.discs.get(dem::columns::lift);
    for (std::size_t i = 0; i < force.size(); ++i) {
        lift[i] = force[i].y;
        push_x[i] = force[i].x;
        if (cells.cell_of[i] < 0)
            push_y[i] = force[i].y;
    }
}

} // namespace listric::fluid
