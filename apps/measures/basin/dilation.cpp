#include "apps/measures/basin/dilation.hpp"

#include "dem/base/just_before.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

constexpr Quantity dilation{
    "rock_dilation_m2", "m2", "dilation of rock",
    "growth of the pre-rift discs' power cells (the part of the plane that is nearer to a disc "
    "than to any other) since the start, of those that are closed then and now, scaled to all: "
    "dilation of the rock, measured without its surface. Shortening lifts its area less by what "
    "this falls by"};
constexpr Quantity dilation_fraction{"rock_dilation_fraction", "1",
                                     "dilation of rock over extension × thickness",
                                     "`rock_dilation_m2` over extension × thickness, to compare "
                                     "with 1 - `area_balance`; none once a "
                                     "stage has shortened"};

constexpr Quantity elastic_area{
    "elastic_area_m2", "m2", "elastic part of rock's dilation",
    "part of `rock_dilation_m2` that is elastic: area that sound pre-rift discs regain as their "
    "contacts press less than at the start. It grows with `cycle.softness`"};
constexpr Quantity elastic_fraction{
    elastic_area_fraction, "1", "elastic part over extension × thickness",
    "`elastic_area_m2` over extension × thickness. *Is my run good?* judges `area_balance` plus "
    "this, so that stiff and soft discs are compared alike"};

/// Fills in what presses the pre-rift discs, but soft and weakened ones: those are enlarged to keep
/// their volume.
void add_contacts(RockPacking& rock, const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    rock.overlap.assign(static_cast<std::size_t>(state.next_id), 0.0);
    rock.reach = rock.overlap;
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]),
                   j = static_cast<std::size_t>(c.second[k]);
        const double length = d.radius[i] + d.radius[j];
        const double overlap = length - hypotenuse(d.x[j] - d.x[i], d.y[j] - d.y[i]);
        if (overlap <= 0.0)
            continue;
        for (const auto& [disc, neighbour] : {std::pair(i, j), std::pair(j, i)})
            if (d.stratum[disc] == 0 && !is_soft(state.materials, d.material[disc])) {
                const double own = state.materials[d.material[disc]].normal_stiffness;
                const double others = state.materials[d.material[neighbour]].normal_stiffness;
                // Springs in series: beside soft rock the disc's own is pressed by less than half.
                const double share = 2.0 * others / (own + others);
                rock.overlap[static_cast<std::size_t>(d.id[disc])] += share * overlap * length;
                rock.reach[static_cast<std::size_t>(d.id[disc])] += length * length;
            }
    }
}

} // namespace

RockPacking rock_packing(const State& state, const RigidBase& base) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::int32_t> rock;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0)
            rock.push_back(static_cast<std::int32_t>(i));
    const std::vector<PowerCell> cells = power_cells(state, base, rock);
    std::vector<double> areas(static_cast<std::size_t>(state.next_id), 0.0);
    for (std::size_t k = 0; k < rock.size(); ++k)
        if (cells[k].closed)
            areas[static_cast<std::size_t>(d.id[static_cast<std::size_t>(rock[k])])] =
                cells[k].area;
    RockPacking packing{std::move(areas), {}, {}};
    add_contacts(packing, state);
    return packing;
}

NamedNumbers measure_dilation(const RunSoFar& run) {
    if (run.past.empty() || !(run.extension > run.past.front().places.extension))
        return {};
    const RockPacking& before = run.past.front().rock;
    const RockPacking now = rock_packing(run.now, run.base);
    // A cell that is open, at a surface or beside a gap, says nothing; it is taken to have grown as
    // the others on average.
    double closed = 0.0, growth = 0.0, elastic = 0.0, all = 0.0;
    for (std::size_t id = 0; id < before.cells.size(); ++id) {
        all += before.cells[id];
        if (before.cells[id] > 0.0 && now.cells[id] > 0.0) {
            closed += before.cells[id];
            growth += now.cells[id] - before.cells[id];
            // What has weakened keeps the volume that it had.
            if (before.overlap[id] > 0.0 && now.overlap[id] > 0.0)
                elastic += before.cells[id] * 2.0 * (before.overlap[id] - now.overlap[id]) /
                           before.reach[id];
        }
    }
    const double scale = all / closed, moved = run.extension.m * run.setting.thickness;
    NamedNumbers numbers; // not finite without closed cells
    const bool shortens = run.base.motion.shortens(just_before(run.base.motion, run.now.clock));
    const auto add_area = [&](const Quantity& area, const Quantity& fraction, double value) {
        add(numbers, area, value);
        if (!shortens && !find_basement_block(run.base))
            add(numbers, fraction, value / moved);
    };
    add_area(dilation, dilation_fraction, growth * scale);
    add_area(elastic_area, elastic_fraction, elastic * scale);
    return numbers;
}

std::span<const Quantity> dilation_quantities() {
    static constexpr Quantity all[] = {dilation, dilation_fraction, elastic_area, elastic_fraction};
    return all;
}

} // namespace listric::measures
