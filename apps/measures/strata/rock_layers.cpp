#include "apps/measures/strata/rock_layers.hpp"

#include "dem/columns.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/numbers/gradient.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/point.hpp"
#include "dem/numbers/units.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace listric::measures {

using namespace dem;

std::vector<LayerThickness> layer_thickness(const State& state, const RigidBase& base,
                                            std::size_t layers) {
    const ConstDiscColumns d = disc_columns(state);
    const auto layer = state.discs.get(dem::columns::layer);
    const double width = 4.0 * state.mean_radius;
    std::vector<std::int32_t> rows;
    for (std::size_t i = 0; i < layer.size(); ++i)
        if (layer[i] > 0)
            rows.push_back(static_cast<std::int32_t>(i));
    const std::vector<PowerCell> cells = power_cells(state, base, rows);
    struct Column {
        double area = 0.0, moment = 0.0;
    };
    std::vector<std::map<int, Column>> columns(layers);
    std::vector<LayerThickness> result(layers);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto i = static_cast<std::size_t>(rows[k]);
        const std::size_t n = layer[i] - 1u;
        if (n >= layers)
            continue;
        // A cell at the free surface is open: then the disc and its share of pores stand for it.
        const double area =
            cells[k].closed ? cells[k].area
                            : dem::pi * d.radius[i] * d.radius[i] / (1.0 - dem::packing_porosity);
        Column& column = columns[n][static_cast<int>(std::floor(d.x[i] / width))];
        column.area += area;
        column.moment -= area * d.y[i];
        result[n].area += area;
    }
    for (std::size_t n = 0; n < layers; ++n)
        for (const auto& [number, column] : columns[n]) {
            result[n].x.push_back((number + 0.5) * width);
            result[n].depth.push_back(column.moment / column.area);
            result[n].thickness.push_back(column.area / width);
        }
    return result;
}

namespace {

constexpr double reach = 1.5; ///< mean diameters
constexpr double torn = 3.0;

/// Not a number where rock is torn apart such that its bedding stands on its head.
double shear_of(const Gradient& g) {
    const Point along = unit({1.0 + g.xx, g.yx}), across{g.xy, 1.0 + g.yy};
    const double normal = along.x * across.y - along.y * across.x;
    return normal > 0.0 ? std::min(torn, std::abs(dot(along, across)) / normal)
                        : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

std::optional<BeddingShear> bedding_shear(const State& state) {
    if (!state.discs.has(dem::columns::layer))
        return std::nullopt;
    const ConstDiscColumns d = disc_columns(state);
    const auto layer = state.discs.get(dem::columns::layer);
    const double radius = 2.0 * reach * state.mean_radius;
    std::vector<std::size_t> rock;
    std::vector<double> x, y;
    double lowest = 1e300, highest = -1e300;
    for (std::size_t i = 0; i < layer.size(); ++i) {
        if (d.stratum[i] > 0)
            continue;
        rock.push_back(i);
        x.push_back(d.start_x[i]);
        y.push_back(d.start_y[i]);
        if (layer[i] > 0) {
            lowest = std::min(lowest, d.start_y[i]);
            highest = std::max(highest, d.start_y[i]);
        }
    }
    const Cells near(x, y, radius);
    std::vector<double> shear(rock.size(), std::numeric_limits<double>::quiet_NaN());
    in_pieces(rock.size(), 64, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k) {
            GradientFit fit;
            const std::size_t i = rock[k];
            near.for_each_near(x[k], y[k], [&](std::int32_t other) {
                const auto o = static_cast<std::size_t>(other);
                const double dx = x[o] - x[k], dy = y[o] - y[k];
                const std::size_t j = rock[o];
                if (hypotenuse(dx, dy) < radius)
                    fit.add(dx, dy, d.x[j] - d.x[i] - dx, d.y[j] - d.y[i] - dy);
            });
            if (const auto gradient = fit.gradient(1e-3))
                shear[k] = shear_of(*gradient);
        }
    });
    double sum[2] = {}, count[2] = {};
    for (std::size_t k = 0; k < rock.size(); ++k) {
        const bool in_layer = layer[rock[k]] > 0;
        if (std::isnan(shear[k]) || (!in_layer && (y[k] < lowest || y[k] > highest)))
            continue;
        sum[in_layer] += shear[k];
        count[in_layer] += 1.0;
    }
    if (count[0] == 0.0 || count[1] == 0.0)
        return std::nullopt;
    return BeddingShear{sum[1] / count[1], sum[0] / count[0]};
}

} // namespace listric::measures
