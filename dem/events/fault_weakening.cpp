#include "dem/events/fault_weakening.hpp"

#include "dem/cells.hpp"
#include "dem/contacts.hpp"
#include "dem/events/weakened_discs.hpp"
#include "dem/power_cell.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace listric::dem {

namespace {

/// A plane through a sampling point along which the two halves of the measure circle slid.
struct FaultSegment {
    Point centre;
    double angle = 0.0; ///< of the plane against the x axis, rad, in [0, pi)
    double slip = 0.0;  ///< displacement of the left half less the right half's, along it, m
};

/// Discs that the scan looks at, with their displacement since the last scan.
struct Sample {
    std::vector<std::int32_t> row;
    std::vector<double> x, y, ux, uy; ///< m
};

/// Whether a disc is part of a rock: bonded to at least half of the discs that it touches.
std::vector<bool> cemented(State& state) {
    const ConstContactColumns c = contact_columns(std::as_const(state));
    const std::vector<bool> touches = touching(state);
    std::vector<int> bonded(state.discs.rows(), 0), unbonded(state.discs.rows(), 0);
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (touches[k])
            for (const std::int32_t disc : {c.first[k], c.second[k]})
                ++(c.bonded[k] ? bonded : unbonded)[static_cast<std::size_t>(disc)];
    std::vector<bool> result(bonded.size());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = bonded[i] > 0 && bonded[i] >= unbonded[i];
    return result;
}

Sample displacements(State& state, double youngest) {
    const DiscColumns d = disc_columns(state);
    const WeakenedColumns w = weakened_columns(state);
    const std::vector<bool> rock = cemented(state);
    Sample s;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] > 0 && d.material[i] != weak &&
            (!rock[i] || state.clock.extension - d.start_extension[i] < youngest))
            continue;
        s.row.push_back(static_cast<std::int32_t>(i));
        s.x.push_back(d.x[i]);
        s.y.push_back(d.y[i]);
        s.ux.push_back(d.x[i] - w.scanned_x[i]);
        s.uy.push_back(d.y[i] - w.scanned_y[i]);
    }
    return s;
}

/// The most active plane through a point, from the discs of the circle around it.
FaultSegment most_active_plane(const Sample& s, std::span<const std::int32_t> circle, Point centre,
                               int angles) {
    constexpr int fewest = 3; // discs on a side
    FaultSegment best{centre};
    for (int a = 0; a < angles; ++a) {
        const double angle = pi * a / angles;
        const double tx = std::cos(angle), ty = std::sin(angle);
        double sum[2] = {0.0, 0.0};
        int count[2] = {0, 0};
        for (std::int32_t member : circle) {
            const auto k = static_cast<std::size_t>(member);
            const bool left = (s.y[k] - centre.y) * tx - (s.x[k] - centre.x) * ty > 0.0;
            sum[left] += s.ux[k] * tx + s.uy[k] * ty;
            ++count[left];
        }
        if (count[0] < fewest || count[1] < fewest)
            continue;
        const double slip = sum[1] / count[1] - sum[0] / count[0];
        if (std::abs(slip) > std::abs(best.slip)) {
            best.angle = angle;
            best.slip = slip;
        }
    }
    return best;
}

/// All planes more active than the threshold, the most active first.
std::vector<FaultSegment> scan(const Sample& s, const Cells& cells, double circle_radius,
                               double spacing, double threshold, int angles) {
    std::vector<FaultSegment> found;
    if (s.x.empty())
        return found;
    const auto [left, right] = std::ranges::minmax(s.x);
    const auto [bottom, top] = std::ranges::minmax(s.y);
    std::vector<std::int32_t> circle;
    for (double x = left; x <= right; x += spacing)
        for (double y = bottom; y <= top; y += spacing) {
            circle.clear();
            constexpr double infinity = std::numeric_limits<double>::infinity();
            double low_x = infinity, high_x = -infinity, low_y = infinity, high_y = -infinity;
            cells.for_each_near(x, y, [&](std::int32_t member) {
                const auto k = static_cast<std::size_t>(member);
                if (std::hypot(s.x[k] - x, s.y[k] - y) > circle_radius)
                    return;
                circle.push_back(member);
                low_x = std::min(low_x, s.ux[k]);
                high_x = std::max(high_x, s.ux[k]);
                low_y = std::min(low_y, s.uy[k]);
                high_y = std::max(high_y, s.uy[k]);
            });
            // The two halves cannot slide further than the discs differ.
            if (circle.empty() || std::hypot(high_x - low_x, high_y - low_y) < threshold)
                continue;
            const FaultSegment segment = most_active_plane(s, circle, {x, y}, angles);
            if (std::abs(segment.slip) > threshold)
                found.push_back(segment);
        }
    std::ranges::stable_sort(found, std::ranges::greater{},
                             [](const FaultSegment& f) { return std::abs(f.slip); });
    return found;
}

/// Drops segments that are closer than `distance` to a more active one.
std::vector<FaultSegment> thin_out(const std::vector<FaultSegment>& found, double distance) {
    std::vector<FaultSegment> kept;
    for (const FaultSegment& f : found)
        if (std::ranges::none_of(kept, [&](const FaultSegment& k) {
                return std::hypot(k.centre.x - f.centre.x, k.centre.y - f.centre.y) < distance;
            }))
            kept.push_back(f);
    return kept;
}

} // namespace

FaultWeakening::FaultWeakening(const FaultWeakeningParameters& parameters, double extension_rate,
                               double gravity, double density)
    : Event("fault_weakening", {parameters.interval, extension_rate}), parameters_(parameters),
      overburden_(gravity * density) {
    for (const char* name : {"x_m", "y_m", "angle_rad", "slip_m", "found_at_m"})
        memory.add<double>(name, "", 0.0);
}

void FaultWeakening::begin(State& state) { add_weakened_columns(state); }

bool FaultWeakening::apply(State& state, const RigidBase& base) {
    const FaultWeakeningParameters& p = parameters_;
    const double diameter = 2.0 * state.mean_radius;
    const double circle_radius = 0.5 * p.circle_diameters * diameter;
    const double threshold =
        p.strain_rate * schedule().seconds() * p.strained_width * p.circle_diameters * diameter;

    // Discs that the last scan did not see have no displacement.
    const Sample sample = displacements(state, std::max(p.youngest_sediment, 0.99 * p.interval) *
                                                   schedule().extension_rate);
    const Cells cells(sample.x, sample.y, circle_radius);
    const std::vector<FaultSegment> faults =
        thin_out(scan(sample, cells, circle_radius, 0.5 * diameter, threshold, p.angles),
                 p.spacing_diameters * diameter);

    const DiscColumns d = disc_columns(state);
    const WeakenedColumns w = weakened_columns(state);
    std::vector<std::int32_t> converted;
    std::vector<std::int32_t> sound;
    for (const FaultSegment& f : faults) {
        const double tx = std::cos(f.angle), ty = std::sin(f.angle);
        std::size_t band = 0;
        sound.clear();
        cells.for_each_near(f.centre.x, f.centre.y, [&](std::int32_t member) {
            const auto k = static_cast<std::size_t>(member);
            const double dx = sample.x[k] - f.centre.x, dy = sample.y[k] - f.centre.y;
            if (std::hypot(dx, dy) >= circle_radius ||
                std::abs(dy * tx - dx * ty) >= 0.5 * p.band_diameters * diameter)
                return;
            ++band;
            if (d.material[static_cast<std::size_t>(sample.row[k])] != weak)
                sound.push_back(sample.row[k]);
        });
        // Where most of the band is weak already, the slip is that of a fault known before. It
        // would widen with every scan if the rest were weakened.
        if (static_cast<double>(sound.size()) < p.sound_share * static_cast<double>(band))
            continue;
        for (std::int32_t row : sound)
            d.material[static_cast<std::size_t>(row)] = weak;
        converted.insert(converted.end(), sound.begin(), sound.end());
    }
    const std::vector<PowerCell> before = power_cells(state, base, converted);
    for (std::size_t k = 0; k < converted.size(); ++k) {
        const auto i = static_cast<std::size_t>(converted[k]);
        w.rock_radius[i] = d.radius[i];
        w.rock_area[i] = before[k].closed ? before[k].area : 0.0;
        // Enlarged at once, a soft disc carries the load that the stiff one carried.
        d.radius[i] *= enlargement(p.mean_stress_ratio * overburden_ * std::max(0.0, -d.y[i]),
                                   state.materials[weak]);
    }
    const ContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (d.material[static_cast<std::size_t>(c.first[k])] == weak ||
            d.material[static_cast<std::size_t>(c.second[k])] == weak)
            c.bonded[k] = 0;

    const std::size_t old = memory.rows();
    memory.resize(old + faults.size());
    const auto put = [&](std::string_view column, auto value_of) {
        const auto values = memory.get<double>(column);
        for (std::size_t k = 0; k < faults.size(); ++k)
            values[old + k] = value_of(faults[k]);
    };
    put("x_m", [](const FaultSegment& f) { return f.centre.x; });
    put("y_m", [](const FaultSegment& f) { return f.centre.y; });
    put("angle_rad", [](const FaultSegment& f) { return f.angle; });
    put("slip_m", [](const FaultSegment& f) { return f.slip; });
    put("found_at_m", [&](const FaultSegment&) { return state.clock.extension; });

    std::ranges::copy(d.x, w.scanned_x.begin());
    std::ranges::copy(d.y, w.scanned_y.begin());
    return true;
}

} // namespace listric::dem
