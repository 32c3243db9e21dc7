#include "apps/measures/faults/shear_field.hpp"

#include "dem/contacts/cells.hpp"
#include "dem/numbers/gradient.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <limits>

namespace listric::measures {

using namespace dem;

namespace {

/// The circle holds some twelve discs, at a surface half of them; where those left lie within two
/// degrees of a line, as in a thin sheet of sediment, the gradient across it would be noise, and
/// noise of that kind would be traced as a fault.
constexpr double flattest = 1e-3;

} // namespace

DiscPlaces::DiscPlaces(const State& state)
    : travel(state.clock.travel), extension(state.clock.extension),
      time_step(state.clock.time_step), diameter(2.0 * state.mean_radius),
      row_of(static_cast<std::size_t>(state.next_id), -1) {
    const ConstDiscColumns d = disc_columns(state);
    x.assign(d.x.begin(), d.x.end());
    y.assign(d.y.begin(), d.y.end());
    id.assign(d.id.begin(), d.id.end());
    for (std::size_t i = 0; i < id.size(); ++i) {
        row_of[static_cast<std::size_t>(id[i])] = static_cast<std::int32_t>(i);
        age.push_back(d.stratum[i] > 0 ? travel.m - d.start_travel[i]
                                       : std::numeric_limits<double>::infinity());
    }
}

void fit_gradients(ShearField& field, std::span<const double> old_x,
                   std::span<const double> old_y) {
    const std::size_t count = field.x.size();
    for (auto* values : {&field.xx, &field.xy, &field.yx, &field.yy})
        values->assign(count, 0.0);
    field.dx.resize(count);
    field.dy.resize(count);
    // Neighbours and gradient refer to the places half way: where two sides slid past each other, a
    // disc's neighbours across the fault then lie as much ahead of it as behind.
    std::vector<double> half_x(count), half_y(count);
    for (std::size_t i = 0; i < count; ++i) {
        field.dx[i] = field.x[i] - old_x[i];
        field.dy[i] = field.y[i] - old_y[i];
        half_x[i] = 0.5 * (old_x[i] + field.x[i]);
        half_y[i] = 0.5 * (old_y[i] + field.y[i]);
    }
    const double reach = 1.9 * field.diameter;
    const Cells cells(half_x, half_y, reach);
    const auto fit_one = [&](std::size_t i) {
        GradientFit fit;
        cells.for_each_near(half_x[i], half_y[i], [&](std::int32_t row) {
            const auto j = static_cast<std::size_t>(row);
            const double dx = half_x[j] - half_x[i], dy = half_y[j] - half_y[i];
            if (dx * dx + dy * dy > reach * reach)
                return;
            fit.add(dx, dy, field.dx[j] - field.dx[i], field.dy[j] - field.dy[i]);
        });
        if (const auto gradient = fit.gradient(flattest)) {
            field.xx[i] = gradient->xx;
            field.xy[i] = gradient->xy;
            field.yx[i] = gradient->yx;
            field.yy[i] = gradient->yy;
        }
    };
    in_pieces(count, 512, [&](std::size_t i, std::size_t end) {
        for (; i < end; ++i)
            fit_one(i);
    });
}

double unit_of_faults(double diameter, double thickness) {
    constexpr double coarsest = 0.0124; // of the thickness: a standard disc of 15 km
    return std::max(diameter, coarsest * thickness);
}

void coarsen(ShearField& field, double unit) {
    if (unit <= field.diameter)
        return;
    field.discs_across *= unit / field.diameter;
    field.diameter = unit;
}

ShearField shear_field(const DiscPlaces& before, const DiscPlaces& now, Travel least_age,
                       const Motion& motion) {
    ShearField field;
    field.diameter = now.diameter;
    field.window = motion.way(before.travel, now.travel);
    const Travel cycle(motion.greatest_speed() * now.time_step);
    std::vector<double> old_x, old_y;
    for (std::size_t i = 0; i < now.id.size(); ++i) {
        const auto id = static_cast<std::size_t>(now.id[i]);
        if (id >= before.row_of.size() || before.row_of[id] < 0 ||
            !has_come_to(Travel(now.age[i]), least_age, cycle))
            continue;
        const auto old = static_cast<std::size_t>(before.row_of[id]);
        field.x.push_back(now.x[i]);
        field.y.push_back(now.y[i]);
        field.id.push_back(now.id[i]);
        old_x.push_back(before.x[old]);
        old_y.push_back(before.y[old]);
    }
    fit_gradients(field, old_x, old_y);
    return field;
}

} // namespace listric::measures
