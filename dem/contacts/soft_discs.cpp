#include "dem/contacts/soft_discs.hpp"

#include "dem/columns.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace listric::dem {

std::vector<std::int32_t> weak_rows(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::int32_t> rows;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (is_weak(state.materials, d.material[i]))
            rows.push_back(static_cast<std::int32_t>(i));
    return rows;
}

std::vector<std::int32_t> soft_rows(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::int32_t> rows;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (is_soft(state.materials, d.material[i]))
            rows.push_back(static_cast<std::int32_t>(i));
    return rows;
}

void add_enlarged_columns(State& state) {
    state.discs.add(columns::rock_radius);
    state.discs.add(columns::rock_area);
    state.discs.add<double>("correction", "1", 1.0);
}

EnlargedColumns enlarged_columns(State& state) {
    Table& t = state.discs;
    return {t.get(columns::rock_radius), t.get(columns::rock_area), t.get<double>("correction")};
}

void enlarge(State& state, const RigidBase& base, std::span<const std::int32_t> rows,
             double mean_stress_ratio, double gravity) {
    const DiscColumns d = disc_columns(state);
    const EnlargedColumns e = enlarged_columns(state);
    const std::vector<PowerCell> before = power_cells(state, base, rows);
    const std::vector<double> weight = overburden(state, rows, gravity);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto i = static_cast<std::size_t>(rows[k]);
        if (e.rock_radius[i] == 0.0) {
            e.rock_radius[i] = d.radius[i];
            e.rock_area[i] = before[k].closed ? before[k].area : 0.0;
        }
        d.radius[i] = e.rock_radius[i] * e.correction[i] *
                      enlargement(mean_stress_ratio * weight[k], state.materials[d.material[i]]);
    }
}

void weaken(State& state, const RigidBase& base, std::span<const std::int32_t> rows,
            double mean_stress_ratio, double gravity) {
    const DiscColumns d = disc_columns(state);
    for (const std::int32_t row : rows) {
        std::uint8_t& material = d.material[static_cast<std::size_t>(row)];
        material = weakened(state.materials, material);
    }
    enlarge(state, base, rows, mean_stress_ratio, gravity);
    const ContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (is_weak(state.materials, d.material[static_cast<std::size_t>(c.first[k])]) ||
            is_weak(state.materials, d.material[static_cast<std::size_t>(c.second[k])]))
            c.bonded[k] = 0;
}

double enlargement(double mean_stress, const Material& weak_material) {
    const double q = std::max(0.0, mean_stress) / (0.5 * weak_material.normal_stiffness);
    return 1.0 + q / (1.0 + 0.42 * q);
}

std::vector<double> overburden(const State& state, std::span<const std::int32_t> rows,
                               double gravity) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<double> weight(rows.size());
    if (rows.empty())
        return weight;
    const double fade = 5.0 * state.mean_radius;
    std::vector<std::size_t> by_x(d.x.size());
    std::iota(by_x.begin(), by_x.end(), std::size_t{0});
    sort_shared(std::span(by_x), [&](std::size_t a, std::size_t b) {
        return d.x[a] != d.x[b] ? d.x[a] < d.x[b] : a < b;
    });
    const bool wet = state.discs.has(columns::excess_pressure);
    const auto pressure =
        wet ? state.discs.get(columns::excess_pressure) : std::span<const double>{};
    const double left = d.x[by_x.front()] - state.mean_radius;
    const double right = d.x[by_x.back()] + state.mean_radius;
    // Width of the column on one side, if it ends at that distance.
    const auto half_width = [&](double end) {
        const double w = std::min(end, fade);
        return w - 0.5 * w * w / fade;
    };
    in_pieces(rows.size(), 64, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k) {
            const auto i = static_cast<std::size_t>(rows[k]);
            double mass = 0.0;
            for (auto at = std::ranges::lower_bound(by_x, d.x[i] - fade, {},
                                                    [&](std::size_t disc) { return d.x[disc]; });
                 at != by_x.end() && d.x[*at] < d.x[i] + fade; ++at) {
                const double above =
                    std::clamp(0.5 + 0.5 * (d.y[*at] - d.y[i]) / d.radius[*at], 0.0, 1.0);
                mass += above * d.mass[*at] * (1.0 - std::abs(d.x[*at] - d.x[i]) / fade);
            }
            weight[k] = gravity * mass / (half_width(d.x[i] - left) + half_width(right - d.x[i]));
            if (wet)
                weight[k] -= pressure[i];
        }
    });
    return weight;
}

double weakened_volume_change(const State& state, const RigidBase& base) {
    const std::vector<std::int32_t> rows = weak_rows(state);
    const std::vector<PowerCell> cells = power_cells(state, base, rows);
    const auto rock_area = state.discs.get(columns::rock_area);
    double change = 0.0;
    for (std::size_t k = 0; k < rows.size(); ++k)
        if (const double before = rock_area[static_cast<std::size_t>(rows[k])];
            before > 0.0 && cells[k].closed)
            change += cells[k].area - before;
    return change;
}

namespace {

/// Change of the volume of all enlarged discs together over their volume before enlargement.
double relative_volume_change(const EnlargedColumns& w, std::span<const std::int32_t> rows,
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

std::optional<double> keep_volume(State& state, const RigidBase& base, const VolumeKeeping& how,
                                  double gravity) {
    const std::vector<std::int32_t> rows = soft_rows(state);
    if (rows.empty())
        return std::nullopt;
    const DiscColumns d = disc_columns(state);
    const EnlargedColumns w = enlarged_columns(state);
    const std::vector<PowerCell> cells = power_cells(state, base, rows);
    const std::vector<double> weight = overburden(state, rows, gravity);
    const double common_error = relative_volume_change(w, rows, cells);

    // Volume is conserved by zones, not by disc: the error is averaged over a fault's width.
    std::vector<double> x, y;
    for (std::int32_t row : rows) {
        x.push_back(d.x[static_cast<std::size_t>(row)]);
        y.push_back(d.y[static_cast<std::size_t>(row)]);
    }
    const double zone = how.zone;
    const Cells near(x, y, zone);
    constexpr double gain = 0.3, common_gain = 0.5;
    in_pieces(rows.size(), 64, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k) {
            const auto i = static_cast<std::size_t>(rows[k]);
            const double factor =
                enlargement(how.mean_stress_ratio * weight[k], state.materials[d.material[i]]);
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
            if (how.corrects && before > 0.0) {
                // At constant stress a spacing follows twice the radius: dA / A = 2 factor dr / r.
                const double error = gain * (now / before - 1.0) + common_gain * common_error;
                w.correction[i] =
                    std::clamp(w.correction[i] * (1.0 - error / (2.0 * factor)), 1.0 / factor, 1.5);
            }
            const double target = w.rock_radius[i] * factor * w.correction[i];
            d.radius[i] = std::clamp(target, d.radius[i] * (1.0 - how.largest_change),
                                     d.radius[i] * (1.0 + how.largest_change));
        }
    });
    return common_error;
}

} // namespace listric::dem
