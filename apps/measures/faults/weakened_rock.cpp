#include "apps/measures/faults/weakened_rock.hpp"

#include "apps/measures/polyline.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

using Rows = std::vector<std::int32_t>;

std::vector<bool> weakened(const State& state) {
    std::vector<bool> weak;
    for (const std::uint8_t material : disc_columns(state).material)
        weak.push_back(is_weak(state.materials, material));
    return weak;
}

/// Bands of weakened discs that touch one another.
std::vector<Rows> bands(const State& state, const std::vector<bool>& weak) {
    const ConstContactColumns c = contact_columns(state);
    const std::vector<bool> touches = touching(state);
    Rows first(weak.size()); // of the band, or one on the way to it
    std::iota(first.begin(), first.end(), 0);
    const auto first_of = [&](std::int32_t row) {
        while (first[static_cast<std::size_t>(row)] != row)
            row = first[static_cast<std::size_t>(row)] =
                first[static_cast<std::size_t>(first[static_cast<std::size_t>(row)])];
        return row;
    };
    for (std::size_t k = 0; k < touches.size(); ++k)
        if (touches[k] && weak[static_cast<std::size_t>(c.first[k])] &&
            weak[static_cast<std::size_t>(c.second[k])]) {
            const auto [low, high] = std::minmax({first_of(c.first[k]), first_of(c.second[k])});
            first[static_cast<std::size_t>(high)] = low;
        }
    std::vector<Rows> found(weak.size());
    for (std::size_t i = 0; i < weak.size(); ++i)
        if (weak[i])
            found[static_cast<std::size_t>(first_of(static_cast<std::int32_t>(i)))].push_back(
                static_cast<std::int32_t>(i));
    std::erase_if(found, [](const Rows& band) { return band.empty(); });
    return found;
}

/// Greatest extent in any of twelve directions, m: at least 0.99 of the true one.
double band_length(const Rows& band, const ConstDiscColumns& d) {
    constexpr int directions = 12;
    double length = 0.0;
    for (int k = 0; k < directions; ++k) {
        const double angle = pi * k / directions;
        const double cosine = dem::cosine(angle), sine = dem::sine(angle);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const std::int32_t row : band) {
            const auto i = static_cast<std::size_t>(row);
            const double along = d.x[i] * cosine + d.y[i] * sine;
            low = std::min(low, along - d.radius[i]);
            high = std::max(high, along + d.radius[i]);
        }
        length = std::max(length, high - low);
    }
    return length;
}

} // namespace

std::vector<bool> weakened_by_faults(const State& state, std::span<const Fault> faults) {
    const ConstDiscColumns d = disc_columns(state);
    const double diameter = 2.0 * state.mean_radius;
    const std::vector<bool> weak = weakened(state);
    std::vector<bool> of_one(weak.size(), false);
    for (const Rows& band : bands(state, weak))
        if (band_length(band, d) >= FaultTraceOptions{}.least_length * diameter)
            for (const std::int32_t row : band)
                of_one[static_cast<std::size_t>(row)] = true;
    for (std::size_t i = 0; i < weak.size(); ++i)
        if (weak[i] && !of_one[i])
            of_one[i] = std::ranges::any_of(faults, [&](const Fault& f) {
                return std::abs(place_on(f.trace.points, {d.x[i], d.y[i]}).distance) <=
                       of_fault * diameter;
            });
    return of_one;
}

std::optional<double> weak_off_fault(const State& state, std::span<const Fault> faults) {
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<bool> weak = weakened(state), of_one = weakened_by_faults(state, faults);
    double all = 0.0, off = 0.0;
    for (std::size_t i = 0; i < weak.size(); ++i) {
        const double area = weak[i] ? d.radius[i] * d.radius[i] : 0.0;
        all += area;
        off += of_one[i] ? 0.0 : area;
    }
    return all > 0.0 ? std::optional(off / all) : std::nullopt;
}

} // namespace listric::measures
