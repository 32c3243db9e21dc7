#include "dem/events/strain.hpp"

#include "dem/contacts/cells.hpp"
#include "dem/gradient.hpp"
#include "dem/hypotenuse.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>

namespace listric::dem {

namespace {

/// The circle holds some twenty discs, so only those of a few that lie on a line are left out.
constexpr double flattest = 1e-6;

void remember(State& state) {
    const DiscColumns d = disc_columns(state);
    std::ranges::copy(d.x, state.discs.get<double>("window_x").begin());
    std::ranges::copy(d.y, state.discs.get<double>("window_y").begin());
    std::ranges::fill(state.discs.get<std::uint8_t>("in_window"), std::uint8_t{1});
}

} // namespace

Strain::Strain(double window, double extension_rate)
    : Observer("strain", Schedule::every(window, extension_rate), Stage::strain) {}

void Strain::begin(State& state) {
    state.discs.add<double>("window_x", "m", 0.0);
    state.discs.add<double>("window_y", "m", 0.0);
    // 0 for discs deposited since the window began
    state.discs.add<std::uint8_t>("in_window", "1", 0);
    state.discs.add<double>("window_strain", "1", 0.0);
    state.discs.add<double>("total_strain", "1", 0.0);
    remember(state);
}

std::vector<double> shear_strain(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const auto old_x = state.discs.get<double>("window_x");
    const auto old_y = state.discs.get<double>("window_y");
    const auto in_window = state.discs.get<std::uint8_t>("in_window");
    const double reach = 2.6 * 2.0 * state.mean_radius;
    const Cells cells(d.x, d.y, reach);
    std::vector<double> strain(d.x.size(), 0.0);
    in_pieces(d.x.size(), 512, [&](std::size_t i, std::size_t end) {
        for (; i < end; ++i) {
            if (!in_window[i])
                continue;
            // Neighbours now; gradient with respect to where they were.
            GradientFit fit;
            const double ux_i = d.x[i] - old_x[i], uy_i = d.y[i] - old_y[i];
            cells.for_each_near(d.x[i], d.y[i], [&](std::int32_t row) {
                const auto j = static_cast<std::size_t>(row);
                if (!in_window[j] || hypotenuse(d.x[j] - d.x[i], d.y[j] - d.y[i]) > reach)
                    return;
                fit.add(old_x[j] - old_x[i], old_y[j] - old_y[i], d.x[j] - old_x[j] - ux_i,
                        d.y[j] - old_y[j] - uy_i);
            });
            if (const auto gradient = fit.gradient(flattest))
                strain[i] = gradient->shear();
        }
    });
    return strain;
}

bool Strain::apply(State& state, const RigidBase&) {
    const std::vector<double> strain = shear_strain(state);
    std::ranges::copy(strain, state.discs.get<double>("window_strain").begin());
    const auto total = state.discs.get<double>("total_strain");
    for (std::size_t i = 0; i < strain.size(); ++i)
        total[i] += strain[i];
    remember(state);
    return false;
}

} // namespace listric::dem
