#include "dem/events/fault_weakening.hpp"

#include "dem/base/rest.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/contacts/soft_discs.hpp"
#include "dem/events/measure_circle.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/gradient.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/round_off.hpp"
#include "dem/numbers/units.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace listric::dem {

namespace {

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

/// Moves of rock, weak discs and sediment laid down at least `youngest` metres of extension ago.
/// @param loose  whether sediment is looked at that is not cemented, too
Displacements displacements(State& state, double youngest, bool loose) {
    const DiscColumns d = disc_columns(state);
    const auto scanned_x = state.discs.get<double>("scanned_x");
    const auto scanned_y = state.discs.get<double>("scanned_y");
    const std::vector<bool> rock = cemented(state);
    const bool compacts = state.discs.has("scanned_porosity");
    const auto porosity = compacts ? state.discs.get(columns::porosity) : std::span<double>();
    const auto before = compacts ? state.discs.get<double>("scanned_porosity") : porosity;
    Displacements s;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] > 0 && !is_weak(state.materials, d.material[i]) &&
            (!(loose || rock[i]) || state.clock.travel.m - d.start_travel[i] < youngest))
            continue;
        s.row.push_back(static_cast<std::int32_t>(i));
        s.x.push_back(d.x[i]);
        s.y.push_back(d.y[i]);
        s.ux.push_back(d.x[i] - scanned_x[i]);
        s.uy.push_back(d.y[i] - scanned_y[i]);
        if (compacts)
            s.compaction.push_back((porosity[i] - before[i]) / (1.0 - porosity[i]));
    }
    return s;
}

/// All planes more active than the threshold, the most active first.
std::vector<FaultSegment> scan(const Displacements& s, const Cells& cells, double diameter,
                               double spacing, double threshold, int angles) {
    if (s.x.empty())
        return {};
    const auto [left, right] = std::ranges::minmax(s.x);
    const auto height = std::ranges::minmax(s.y);
    std::vector<double> columns;
    for (double x = left; x <= right; x += spacing)
        columns.push_back(x);
    const std::vector<Point> planes = plane_directions(angles);
    std::vector<FaultSegment> found =
        joined(by_piece(columns.size(), 1, [&](std::size_t column, std::size_t end) {
            std::vector<FaultSegment> in_columns;
            std::vector<std::int32_t> circle;
            for (; column < end; ++column)
                for (double y = height.min; y <= height.max; y += spacing) {
                    const double x = columns[column];
                    circle.clear();
                    cells.for_each_near(x, y, [&](std::int32_t member) {
                        const auto k = static_cast<std::size_t>(member);
                        if (hypotenuse(s.x[k] - x, s.y[k] - y) <= 0.5 * diameter)
                            circle.push_back(member);
                    });
                    if (slip_bound(s, circle, {x, y}) <= threshold)
                        continue;
                    const FaultSegment segment =
                        most_active_plane(s, circle, {x, y}, diameter, planes);
                    if (std::abs(segment.slip) > threshold)
                        in_columns.push_back(along_fault(s, circle, segment, planes));
                }
            return in_columns;
        }));
    std::ranges::stable_sort(found, std::ranges::greater{},
                             [](const FaultSegment& f) { return std::abs(f.slip); });
    return found;
}

/// Drops segments that are closer than `distance` to a more active one.
std::vector<FaultSegment> thin_out(const std::vector<FaultSegment>& found, double distance) {
    std::vector<FaultSegment> kept;
    for (const FaultSegment& f : found)
        if (std::ranges::none_of(
                kept, [&](const FaultSegment& k) { return norm(k.centre - f.centre) < distance; }))
            kept.push_back(f);
    return kept;
}

/// A stretch of a fault, to be weakened.
struct Band {
    Point from, to;
};

Band band_of(const FaultSegment& f, double length) {
    const Point half{0.5 * length * cosine(f.angle), 0.5 * length * sine(f.angle)};
    return {f.centre - half, f.centre + half};
}

/// Lengths of scan and weakening, m.
struct Lengths {
    double disc;   ///< mean diameter
    double circle; ///< diameter
    double gap;    ///< the widest that is closed
    double width;  ///< of a band
};

/// Gaps between the bands of segments that lie on one line, to the step of the angles that were
/// tried, where a plane of that line was found in the middle, too. Gaps shorter than a disc are
/// none.
std::vector<Band> gaps(const std::vector<FaultSegment>& kept,
                       const std::vector<FaultSegment>& found, const Lengths& l, double step) {
    std::vector<Band> result;
    for (std::size_t a = 0; a < kept.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const Point from = kept[a].centre, between = kept[b].centre - from;
            const double gap = norm(between) - l.circle;
            if (gap < l.disc || gap > l.gap)
                continue;
            const Point along = unit(between), middle = from + 0.5 * between;
            const auto on_line = [&](const FaultSegment& f) {
                return std::abs(cross(along, {cosine(f.angle), sine(f.angle)})) < sine(1.01 * step);
            };
            if (on_line(kept[a]) && on_line(kept[b]) &&
                std::ranges::any_of(found, [&](const FaultSegment& f) {
                    return norm(f.centre - middle) < 0.5 * l.width && on_line(f);
                }))
                result.push_back({middle - 0.5 * gap * along, middle + 0.5 * gap * along});
        }
    return result;
}

/// Rows of the sound discs in a band; none where most of it is weak already: the slip is that of a
/// fault known before, which would widen with every scan if the rest were weakened. Rock that is
/// never weakened does not count.
std::vector<std::int32_t> sound_discs(const Displacements& s, const State& state, const Band& band,
                                      double width, double least_share) {
    const auto material = disc_columns(state).material;
    const Point along = unit(band.to - band.from);
    const double length = norm(band.to - band.from);
    double all = 0.0;
    std::vector<std::int32_t> sound;
    for (std::size_t k = 0; k < s.x.size(); ++k) {
        const Point at = Point{s.x[k], s.y[k]} - band.from;
        if (dot(along, at) < 0.0 || dot(along, at) > length ||
            std::abs(cross(along, at)) >= 0.5 * width)
            continue;
        const std::uint8_t m = material[static_cast<std::size_t>(s.row[k])];
        const bool can_weaken = weakened(state.materials, m) != no_material;
        all += can_weaken || is_weak(state.materials, m) ? 1.0 : 0.0;
        if (can_weaken)
            sound.push_back(s.row[k]);
    }
    if (static_cast<double>(sound.size()) < least_share * all)
        sound.clear();
    return sound;
}

/// Weak discs of the sample that have rested for long enough by now, and counts the years of rest.
/// Strain: of the discs within half a measure circle, since the last scan.
std::vector<std::int32_t> rested_discs(State& state, const Displacements& s, const Cells& cells,
                                       double reach, const FaultWeakeningParameters& p,
                                       double resting_strain) {
    const auto material = disc_columns(state).material;
    const auto rested = state.discs.get<double>("rested_a");
    in_pieces(s.row.size(), 64, [&](std::size_t k, std::size_t end) {
        for (; k < end; ++k) {
            const auto i = static_cast<std::size_t>(s.row[k]);
            if (!is_weak(state.materials, material[i]))
                continue;
            GradientFit fit;
            cells.for_each_near(s.x[k], s.y[k], [&](std::int32_t member) {
                const auto m = static_cast<std::size_t>(member);
                const double dx = s.x[m] - s.x[k], dy = s.y[m] - s.y[k];
                const double dux = s.ux[m] - s.ux[k], duy = s.uy[m] - s.uy[k];
                if (hypotenuse(dx, dy) <= reach)
                    fit.add(dx - dux, dy - duy, dux, duy);
            });
            const auto gradient = fit.gradient(1e-6);
            const bool rests = gradient && gradient->shear() < resting_strain;
            rested[i] = rests ? rested[i] + p.interval : 0.0;
        }
    });
    std::vector<std::int32_t> rows;
    for (const std::int32_t row : s.row)
        if (const auto i = static_cast<std::size_t>(row);
            is_weak(state.materials, material[i]) && rested[i] >= p.heal_after)
            rows.push_back(row);
    return rows;
}

/// Keeps discs that are found at rest for the next scan in motion, and gives them to that.
void postpone(State& state, std::vector<std::int32_t>& rows, bool at_rest) {
    constexpr std::string_view column = "found_at_rest";
    if (!state.discs.has(column)) {
        if (!at_rest)
            return;
        state.discs.add<std::uint8_t>(column, "1", 0);
    }
    const auto waits = state.discs.get<std::uint8_t>(column);
    if (at_rest) {
        for (const std::int32_t row : rows)
            waits[static_cast<std::size_t>(row)] = 1;
        rows.clear();
        return;
    }
    for (std::size_t i = 0; i < waits.size(); ++i)
        if (std::exchange(waits[i], 0) != 0)
            rows.push_back(static_cast<std::int32_t>(i));
}

/// Makes weak discs rock, or sediment, again: what weakening did, undone under the present load.
void heal(State& state, const std::vector<std::int32_t>& rows, double stress_ratio,
          double gravity) {
    const DiscColumns d = disc_columns(state);
    const EnlargedColumns w = enlarged_columns(state);
    const auto rested = state.discs.get<double>("rested_a");
    const std::vector<double> weight = overburden(state, rows, gravity);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto i = static_cast<std::size_t>(rows[k]);
        const Material& from = state.materials[d.material[i]];
        const std::uint8_t of_layer = from.weak_of;
        d.radius[i] /= enlargement(stress_ratio * weight[k], from);
        const std::uint8_t otherwise = d.stratum[i] > 0 ? sediment : basement;
        d.material[i] = of_layer != no_material ? of_layer : otherwise;
        rested[i] = 0.0;
        if (is_soft(state.materials, d.material[i])) {
            d.radius[i] *= enlargement(stress_ratio * weight[k], state.materials[d.material[i]]);
            continue;
        }
        w.rock_radius[i] = w.rock_area[i] = 0.0;
        w.correction[i] = 1.0;
    }
}

/// Distance of the halves' centroids, m.
double halves_apart(const FaultWeakeningParameters& p, double mean_diameter) {
    return half_distance * p.circle_diameters * mean_diameter;
}

} // namespace

double critical_slip(const FaultWeakeningParameters& p, double mean_diameter) {
    return p.strain_rate > 0.0
               ? p.strain_rate * p.interval * seconds_per_year * halves_apart(p, mean_diameter)
               : p.least_slip;
}

double critical_rate(const FaultWeakeningParameters& p, double mean_diameter) {
    return p.strain_rate > 0.0
               ? p.strain_rate
               : p.least_slip / (p.interval * seconds_per_year * halves_apart(p, mean_diameter));
}

FaultWeakening::FaultWeakening(const FaultWeakeningParameters& parameters, const Calendar& calendar,
                               double gravity)
    : Event("fault_weakening", {parameters.interval, calendar}, Stage::weaken),
      parameters_(parameters), gravity_(gravity) {
    for (const char* name : {"x_m", "y_m", "angle_rad", "slip_m", "found_at_m"})
        memory.add<double>(name, "", 0.0);
}

void FaultWeakening::begin(State& state) {
    state.discs.add_like<double>("scanned_x", "m", columns::x);
    state.discs.add_like<double>("scanned_y", "m", columns::y);
    add_enlarged_columns(state);
    if (parameters_.heal_after > 0.0)
        state.discs.add<double>("rested_a", "a", 0.0);
    if (state.discs.has(columns::porosity))
        state.discs.add_like<double>("scanned_porosity", "1", columns::porosity);
}

bool FaultWeakening::apply(State& state, const RigidBase& base) {
    FaultWeakeningParameters p = parameters_;
    p.interval = schedule().years(applied + 1);
    const double diameter = 2.0 * state.mean_radius;
    const Lengths l{diameter, p.circle_diameters * diameter,
                    p.sound_share * p.circle_diameters * diameter, p.band_diameters * diameter};
    // A disc laid down since the last scan (but for half a cycle) has moved for less time than
    // others.
    const double loose = schedule().calendar().way_back(state.clock.travel, p.youngest_sediment).m;
    const double youngest =
        std::max(p.whole_domain ? 0.0 : loose, 0.99 * schedule().gap(applied + 1).m);
    const Displacements sample = displacements(state, youngest, p.whole_domain);
    const Cells cells(sample.x, sample.y, 0.5 * l.circle);
    const std::vector<FaultSegment> found =
        scan(sample, cells, l.circle, 0.5 * diameter, critical_slip(p, diameter), p.angles);
    const std::vector<FaultSegment> faults = thin_out(found, p.spacing_diameters * diameter);
    std::vector<Band> bands = gaps(faults, found, l, pi / p.angles);
    for (const FaultSegment& f : faults)
        bands.push_back(band_of(f, l.circle));

    if (p.heal_after > 0.0)
        heal(state,
             rested_discs(state, sample, cells, 0.5 * l.circle, p,
                          schedule().strain(p.resting_rate, applied + 1)),
             mean_stress_ratio(p, state, base), gravity_);
    std::vector<std::int32_t> converted =
        joined(by_piece(bands.size(), 4, [&](std::size_t k, std::size_t end) {
            std::vector<std::int32_t> rows;
            for (; k < end; ++k)
                std::ranges::copy(sound_discs(sample, state, bands[k], l.width, p.sound_share),
                                  std::back_inserter(rows));
            return rows;
        }));
    postpone(state, converted, rests_from_now(base, state.clock));
    std::ranges::sort(converted);
    converted.erase(std::unique(converted.begin(), converted.end()), converted.end());
    weaken(state, base, converted, mean_stress_ratio(p, state, base), gravity_);

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
    put("found_at_m", [&](const FaultSegment&) { return state.clock.travel.m; });

    const DiscColumns d = disc_columns(state);
    std::ranges::copy(d.x, state.discs.get<double>("scanned_x").begin());
    std::ranges::copy(d.y, state.discs.get<double>("scanned_y").begin());
    if (state.discs.has("scanned_porosity"))
        std::ranges::copy(state.discs.get(columns::porosity),
                          state.discs.get<double>("scanned_porosity").begin());
    return true;
}

} // namespace listric::dem
