#include "apps/measures/basin/dilation.hpp"

#include "dem/base/just_before.hpp"
#include "dem/contacts/power_cell.hpp"

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

} // namespace

std::vector<double> rock_cells(const State& state, const RigidBase& base) {
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
    return areas;
}

NamedNumbers measure_dilation(const RunSoFar& run) {
    if (run.past.empty() || !(run.extension > run.past.front().places.extension))
        return {};
    const std::vector<double>& before = run.past.front().rock_cells;
    const std::vector<double> now = rock_cells(run.now, run.base);
    // A cell that is open, at a surface or beside a gap, says nothing; it is taken to have grown as
    // the others on average.
    double closed = 0.0, growth = 0.0, all = 0.0;
    for (std::size_t id = 0; id < before.size(); ++id) {
        all += before[id];
        if (before[id] > 0.0 && now[id] > 0.0) {
            closed += before[id];
            growth += now[id] - before[id];
        }
    }
    NamedNumbers numbers; // not finite without closed cells
    const double grown = growth * all / closed;
    add(numbers, dilation, grown);
    if (!run.base.motion.shortens(just_before(run.base.motion, run.now.clock)))
        add(numbers, dilation_fraction, grown / (run.extension.m * run.setting.thickness));
    return numbers;
}

std::span<const Quantity> dilation_quantities() {
    static constexpr Quantity all[] = {dilation, dilation_fraction};
    return all;
}

} // namespace listric::measures
