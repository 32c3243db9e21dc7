#include "dem/events/strain.hpp"

#include "dem/columns.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/numbers/gradient.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

namespace listric::dem {

namespace {

/// The circle holds some twenty discs, so only those of a few that lie on a line are left out.
constexpr double flattest = 1e-6;

void remember(State& state) {
    const DiscColumns d = disc_columns(state);
    std::ranges::copy(d.x, state.discs.get<double>("window_x").begin());
    std::ranges::copy(d.y, state.discs.get<double>("window_y").begin());
    std::ranges::fill(state.discs.get<std::uint8_t>("in_window"), std::uint8_t{1});
    if (!state.discs.has(columns::porosity))
        return;
    state.discs.add_like<double>("window_porosity", "1", columns::porosity);
    state.discs.mark_note("window_porosity");
    std::ranges::copy(std::as_const(state).discs.get(columns::porosity),
                      state.discs.get<double>("window_porosity").begin());
}

/// Vertical strain of discs by compaction since the window began, below 0, of the height that they
/// had: a height goes as 1 / (1 - porosity). Empty where nothing compacts.
std::vector<double> compaction_since(const State& state) {
    if (!state.discs.has(columns::porosity))
        return {};
    const auto now = state.discs.get(columns::porosity);
    const auto then = state.discs.get<double>("window_porosity");
    std::vector<double> strain(now.size());
    for (std::size_t i = 0; i < strain.size(); ++i)
        strain[i] = (now[i] - then[i]) / (1.0 - now[i]);
    return strain;
}

/// Largest shear strain since the window began, of displacements less a vertical strain of discs.
/// @param vertical  may be empty
std::vector<double> shear_without(const State& state, std::span<const double> vertical) {
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
                const double dy = old_y[j] - old_y[i];
                const double given =
                    vertical.empty() ? 0.0 : 0.5 * (vertical[i] + vertical[j]) * dy;
                fit.add(old_x[j] - old_x[i], dy, d.x[j] - old_x[j] - ux_i,
                        d.y[j] - old_y[j] - uy_i - given);
            });
            if (const auto gradient = fit.gradient(flattest))
                strain[i] = gradient->shear();
        }
    });
    return strain;
}

/// Fills the column of the last window and adds to the column of all windows.
void book(State& state, const std::vector<double>& strain, std::string_view window,
          std::string_view total) {
    std::ranges::copy(strain, state.discs.get<double>(window).begin());
    if (!state.discs.has(total)) // an older program began the run
        return;
    const auto sum = state.discs.get<double>(total);
    for (std::size_t i = 0; i < strain.size(); ++i)
        sum[i] += strain[i];
}

} // namespace

Strain::Strain(double window, double extension_rate)
    : Observer("strain", Schedule::every(window, extension_rate), Stage::strain) {}

void Strain::begin(State& state) {
    state.discs.add<double>("window_x", "m", 0.0);
    state.discs.add<double>("window_y", "m", 0.0);
    // 0 for discs deposited since the window began
    state.discs.add<std::uint8_t>("in_window", "1", 0);
    state.discs.add(columns::window_strain);
    state.discs.add(columns::total_strain);
    state.discs.add_note(columns::window_tectonic_strain);
    state.discs.add_note(columns::total_tectonic_strain);
    remember(state);
}

std::vector<double> shear_strain(const State& state) { return shear_without(state, {}); }

std::optional<std::vector<double>> tectonic_strain(const State& state) {
    if (state.discs.has(columns::porosity) && !state.discs.has("window_porosity"))
        return std::nullopt;
    return shear_without(state, compaction_since(state));
}

bool Strain::apply(State& state, const RigidBase&) {
    const std::vector<double> shear = shear_strain(state);
    book(state, shear, columns::window_strain, columns::total_strain);
    if (!state.discs.has(columns::porosity) || state.discs.has("window_porosity")) {
        state.discs.add_note(columns::window_tectonic_strain);
        book(state, state.discs.has(columns::porosity) ? *tectonic_strain(state) : shear,
             columns::window_tectonic_strain, columns::total_tectonic_strain);
    }
    remember(state);
    return false;
}

} // namespace listric::dem
