#include "dem/events/property_update.hpp"

#include "dem/contacts/cells.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/hypotenuse.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>

namespace listric::dem {

namespace {

/// Change of the volume of all weakened discs together over their volume before weakening.
double relative_volume_change(const WeakenedColumns& w, std::span<const std::int32_t> rows,
                              std::span<const PowerCell> cells) {
    double now = 0.0, before = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (const double rock_area = w.rock_area[static_cast<std::size_t>(rows[k])];
            cells[k].closed && rock_area > 0.0) {
            now += cells[k].area;
            before += rock_area;
        }
    return before > 0.0 ? now / before - 1.0 : 0.0;
}

} // namespace

PropertyUpdate::PropertyUpdate(const FaultWeakeningParameters& parameters, double extension_rate,
                               double gravity)
    : Event("property_update", {parameters.update_interval, extension_rate}),
      parameters_(parameters), gravity_(gravity) {}

bool PropertyUpdate::apply(State& state, const RigidBase& base) {
    const std::vector<std::int32_t> rows = weak_rows(state);
    if (rows.empty())
        return false;
    const DiscColumns d = disc_columns(state);
    const WeakenedColumns w = weakened_columns(state);
    const std::vector<PowerCell> cells = power_cells(state, base, rows);
    const std::vector<double> weight = overburden(state, rows, gravity_);
    const double stress_ratio = mean_stress_ratio(parameters_, state, base);
    const double common_error = relative_volume_change(w, rows, cells);

    // Volume is conserved by zones, not by disc: the error is averaged over a fault's width.
    std::vector<double> x, y;
    for (std::int32_t row : rows) {
        x.push_back(d.x[static_cast<std::size_t>(row)]);
        y.push_back(d.y[static_cast<std::size_t>(row)]);
    }
    const double zone = parameters_.band_diameters * state.mean_radius;
    const Cells near(x, y, zone);
    constexpr double gain = 0.3, common_gain = 0.5;
    in_pieces(rows.size(), 64, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k) {
            const auto i = static_cast<std::size_t>(rows[k]);
            const double factor = enlargement(stress_ratio * weight[k], state.materials[weak]);
            double now = 0.0, before = 0.0;
            near.for_each_near(x[k], y[k], [&](std::int32_t other) {
                const auto o = static_cast<std::size_t>(other);
                const double rock_area = w.rock_area[static_cast<std::size_t>(rows[o])];
                if (cells[o].closed && rock_area > 0.0 &&
                    hypotenuse(x[o] - x[k], y[o] - y[k]) < zone) {
                    now += cells[o].area;
                    before += rock_area;
                }
            });
            if (before > 0.0) {
                // At constant stress a spacing follows twice the radius: dA / A = 2 factor dr / r.
                const double error = gain * (now / before - 1.0) + common_gain * common_error;
                w.correction[i] =
                    std::clamp(w.correction[i] * (1.0 - error / (2.0 * factor)), 1.0 / factor, 1.5);
            }
            const double target = w.rock_radius[i] * factor * w.correction[i];
            d.radius[i] = std::clamp(target, d.radius[i] * (1.0 - parameters_.largest_change),
                                     d.radius[i] * (1.0 + parameters_.largest_change));
        }
    });
    return true;
}

} // namespace listric::dem
