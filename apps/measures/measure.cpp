#include "apps/measures/measure.hpp"

#include "apps/measures/kinematics.hpp"
#include "dem/base_place.hpp"
#include "dem/contacts.hpp"
#include "dem/events/property_update.hpp"
#include "dem/events/strain.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace listric {

using namespace dem;

namespace {

constexpr double none = -std::numeric_limits<double>::infinity();

/// Moving average over `width` samples on either side, fewer at the ends.
std::vector<double> smooth(std::span<const double> values, std::ptrdiff_t width) {
    const auto n = static_cast<std::ptrdiff_t>(values.size());
    std::vector<double> result(values.size());
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const std::ptrdiff_t low = std::max<std::ptrdiff_t>(k - width, 0);
        const std::ptrdiff_t high = std::min(k + width, n - 1);
        result[static_cast<std::size_t>(k)] =
            std::accumulate(values.begin() + low, values.begin() + high + 1, 0.0) /
            static_cast<double>(high - low + 1);
    }
    return result;
}

/// Height of the detachment below x, m.
double detachment_height(const Chain& detachment, double x) {
    double low = 0.0, high = 0.0;
    for (const Segment& s : detachment)
        high += s.length;
    for (int n = 0; n < 60; ++n) {
        const double middle = 0.5 * (low + high);
        (point_at(detachment, middle).x < x ? low : high) = middle;
    }
    return point_at(detachment, low).y;
}

/// Where the pre-rift top meets the detachment: the shallowest pre-rift discs that lie on it.
std::optional<Point> find_cutoff(const State& state, const Chain& detachment) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::pair<double, double>> on_detachment; // arc length, radius
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (d.stratum[i] != 0)
            continue;
        if (const auto foot = foot_point(detachment, {d.x[i], d.y[i]});
            foot && foot->distance < d.radius[i] + 0.25 * state.mean_radius)
            on_detachment.emplace_back(foot->arc_length, d.radius[i]);
    }
    if (on_detachment.empty())
        return std::nullopt;
    const auto [arc_length, radius] = *std::ranges::min_element(on_detachment);
    const Point p = point_at(detachment, arc_length - radius);
    return Point{p.x, -p.y};
}

/// Rotation, degrees, of the least-squares rigid motion of a block of discs.
std::optional<double> rotation_of(const State& state, std::span<const std::size_t> block) {
    const ConstDiscColumns d = disc_columns(state);
    if (block.size() < 3)
        return std::nullopt;
    Point before, after;
    for (std::size_t i : block) {
        before = {before.x + d.start_x[i], before.y + d.start_y[i]};
        after = {after.x + d.x[i], after.y + d.y[i]};
    }
    const auto n = static_cast<double>(block.size());
    before = {before.x / n, before.y / n};
    after = {after.x / n, after.y / n};
    double sine = 0.0, cosine = 0.0;
    for (std::size_t i : block) {
        const double ax = d.start_x[i] - before.x, ay = d.start_y[i] - before.y;
        const double bx = d.x[i] - after.x, by = d.y[i] - after.y;
        sine += ax * by - ay * bx;
        cosine += ax * bx + ay * by;
    }
    return std::atan2(sine, cosine) * 180.0 / pi;
}

/// Mean rotation, degrees, of the square patches of a block that deforms.
std::optional<double> mean_rotation(const State& state, std::span<const std::size_t> block,
                                    double patch) {
    const ConstDiscColumns d = disc_columns(state);
    std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> patches;
    for (std::size_t i : block)
        patches[{std::llround(d.start_x[i] / patch), std::llround(d.start_y[i] / patch)}].push_back(
            i);
    double sum = 0.0, discs = 0.0;
    for (const auto& [place, members] : patches) {
        constexpr std::size_t fewest = 4; // slivers at the block's edge tell nothing
        if (members.size() < fewest)
            continue;
        sum += *rotation_of(state, members) * static_cast<double>(members.size());
        discs += static_cast<double>(members.size());
    }
    return discs > 0.0 ? std::optional(sum / discs) : std::nullopt;
}

/// Rows of the pre-rift discs of whose start `chosen(start, foot on the detachment)` is true.
template <class Chosen>
std::vector<std::size_t> block_of(const State& state, const Chain& detachment, Chosen&& chosen) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<std::size_t> block;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0)
            if (const Point start{d.start_x[i], d.start_y[i]};
                chosen(start, foot_point(detachment, start)))
                block.push_back(i);
    return block;
}

/// Rotation of the block that started next to the detachment in its upper half.
std::optional<double> head_block_tilt(const Scene& scene, const State& state,
                                      const Chain& detachment) {
    constexpr double block_width = 5e3;
    return rotation_of(state, block_of(state, detachment, [&](Point start, const auto& foot) {
                           return -start.y <= 0.5 * scene.hanging_wall->thickness &&
                                  (foot ? foot->distance : start.x) < block_width;
                       }));
}

/// Rotations of three parts of the hanging wall of a ramp-flat-ramp detachment.
void measure_ramp_flat_ramp(Measures& m, const State& state, const Chain& detachment) {
    const auto parts = find_ramp_flat_ramp(detachment);
    if (!parts)
        return;
    constexpr double block_size = 1.5e3, toe_dip = 15.0 * pi / 180.0;
    m.breakaway_rotation =
        rotation_of(state, block_of(state, detachment, [&](Point start, const auto&) {
                        return std::hypot(start.x, start.y) < block_size;
                    }));
    m.toe_rotation = rotation_of(state, block_of(state, detachment, [&](Point, const auto& foot) {
                                     return foot && foot->arc_length < parts->flat_start &&
                                            std::atan2(foot->normal.x, foot->normal.y) < toe_dip &&
                                            foot->distance < block_size;
                                 }));
    m.lower_block_rotation =
        mean_rotation(state, lower_block(state, detachment, *parts), block_size);
}

/// The basin beside what kinematic constructions predict.
void measure_kinematics(const Scene& scene, const Chain& detachment, double extension,
                        const Profile& profile, double column, Measures& m) {
    const double right = profile.x.back();
    m.dilation_area = extension * scene.hanging_wall->thickness - m.basin_area;
    m.depth_to_detachment = m.basin_area / extension;
    const InclinedShearFit shear =
        fit_inclined_shear(detachment, extension, profile.x, profile.pre_rift_top);
    m.inclined_shear_angle = shear.angle;
    m.inclined_shear_misfit = shear.misfit;
    const std::vector<Point> normals = normals_top(detachment, extension, right);
    const Point cutoff = point_at(detachment, extension);
    m.predicted_tilt = normals_tilt(detachment, extension);
    m.predicted_cutoff = Point{cutoff.x, -cutoff.y};
    if (const double share = normals_halfgraben_share(detachment, extension, right); share > 0.0)
        m.predicted_halfgraben_area_share = share;
    if (!normals.empty()) {
        // Beyond the block that rotates, the hanging wall collapses.
        const double last = cutoff.x + 0.5 * (detachment.front().end.x - cutoff.x);
        m.normals_misfit = misfit(detachment, normals, profile.x, profile.pre_rift_top, last);
    }

    const std::vector<double> depth = smoothed_depth(profile);
    if (const auto high = find_intervening_high(profile.x, depth, 250.0)) {
        m.intervening_high = Point{profile.x[*high], depth[*high]};
        double left = 0.0;
        for (std::size_t k = 0; k <= *high; ++k)
            left -= profile.pre_rift_top[k] * column;
        m.halfgraben_area_share = left / m.basin_area;
    }
}

} // namespace

const Event* find_event(std::span<const std::unique_ptr<Event>> events, std::string_view name) {
    for (const auto& event : events)
        if (event->name() == name)
            return event.get();
    return nullptr;
}

double share_of_densest(std::span<const double> density, std::span<const double> area,
                        double area_share) {
    std::vector<std::size_t> order(density.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return density[a] > density[b]; });
    double total = 0.0;
    for (std::size_t k : order)
        total += density[k] * area[k];
    const double wanted = area_share * std::accumulate(area.begin(), area.end(), 0.0);
    double taken = 0.0, held = 0.0;
    for (std::size_t k : order) {
        const double part = std::min(area[k], wanted - taken);
        if (part <= 0.0)
            break;
        taken += part;
        held += density[k] * part;
    }
    return total > 0.0 ? held / total : 0.0;
}

double gini(std::span<const double> density, std::span<const double> area) {
    std::vector<std::size_t> order(density.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return density[a] < density[b]; });
    double all_area = 0.0, amount = 0.0, under_curve = 0.0;
    for (std::size_t k : order) {
        const double next = amount + density[k] * area[k];
        under_curve += 0.5 * (amount + next) * area[k];
        amount = next;
        all_area += area[k];
    }
    return amount > 0.0 ? 1.0 - 2.0 * under_curve / (amount * all_area) : 0.0;
}

std::vector<Depocentre> find_depocentres(std::span<const double> x, std::span<const double> t,
                                         double least_prominence) {
    std::vector<Depocentre> found;
    for (std::size_t k = 0; k < t.size(); ++k) {
        // A plateau counts once, at its first sample.
        if (t[k] <= 0.0 || (k > 0 && t[k - 1] >= t[k]))
            continue;
        std::size_t next = k;
        while (next + 1 < t.size() && t[next + 1] == t[k])
            ++next;
        if (next + 1 < t.size() && t[next + 1] > t[k])
            continue;
        // Prominence: down to the higher of the two lowest passes to something thicker.
        double left = t[k], right = t[k];
        bool left_higher = false, right_higher = false;
        for (std::size_t m = k; m-- > 0 && !left_higher;) {
            left_higher = t[m] > t[k];
            left = std::min(left, t[m]);
        }
        for (std::size_t m = next + 1; m < t.size() && !right_higher; ++m) {
            right_higher = t[m] > t[k];
            right = std::min(right, t[m]);
        }
        const double base = left_higher && right_higher ? std::max(left, right)
                            : left_higher               ? left
                            : right_higher              ? right
                                                        : 0.0;
        if (t[k] - base >= least_prominence)
            found.push_back({x[k], t[k], t[k] - base});
    }
    std::ranges::sort(found, std::ranges::greater{}, &Depocentre::thickness);
    return found;
}

std::optional<RampFlatRamp> find_ramp_flat_ramp(const Chain& detachment) {
    constexpr double level = 1e-6; // of a unit tangent's y
    constexpr double least_depth = 1.0;
    const auto flat = [](Point tangent) { return std::abs(tangent.y) < level; };
    RampFlatRamp found;
    double at = 0.0;
    bool on_flat = false, in_kink = false;
    for (const Segment& s : detachment) {
        if (in_kink && s.curvature >= 0.0)
            break;
        if (on_flat && !in_kink && !(flat(s.start_tangent) && flat(s.end_tangent))) {
            in_kink = true;
            found.flat_end = at;
            if (s.curvature >= 0.0) { // a corner
                found.lower_start = at;
                break;
            }
        }
        if (in_kink)
            found.lower_start = at + s.length;
        if (!on_flat && flat(s.end_tangent) && s.end.y < -least_depth) {
            on_flat = true;
            found.flat_depth = -s.end.y;
            found.flat_start = flat(s.start_tangent) ? at : at + s.length;
        }
        at += s.length;
    }
    return in_kink ? std::optional(found) : std::nullopt;
}

std::vector<std::size_t> lower_block(const State& state, const Chain& detachment,
                                     const RampFlatRamp& parts) {
    const double height = -detachment.back().end.y - parts.flat_depth;
    return block_of(state, detachment, [&](Point start, const auto& foot) {
        return -start.y > parts.flat_depth && foot && foot->arc_length > parts.lower_start &&
               foot->normal.x > 1e-6 && foot->distance < 0.5 * height;
    });
}

std::vector<double> smoothed_depth(const Profile& profile) {
    std::vector<double> depth;
    for (double top : profile.pre_rift_top)
        depth.push_back(-top);
    const double column = profile.x.size() > 1 ? profile.x[1] - profile.x[0] : 1e3;
    return smooth(depth, static_cast<std::ptrdiff_t>(std::lround(0.5 * 1e3 / column)));
}

Profile measure_profile(const Scene& scene, const State& state, const RigidBase& base) {
    const ConstDiscColumns d = disc_columns(state);
    const Chain detachment = standing_base(base, state).surfaces.front().chain;
    const double width = 2.0 * state.mean_radius;
    const auto columns =
        static_cast<std::size_t>((scene.hanging_wall->length + state.clock.extension) / width);
    Profile p;
    p.x.resize(columns);
    p.pre_rift_top.assign(columns, none);
    std::vector<double> surface(columns, none);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double column = d.x[i] / width;
        if (column < 0.0 || column >= static_cast<double>(columns))
            continue;
        const auto k = static_cast<std::size_t>(column);
        const double top = d.y[i] + d.radius[i];
        surface[k] = std::max(surface[k], top);
        if (d.stratum[i] == 0)
            p.pre_rift_top[k] = std::max(p.pre_rift_top[k], top);
    }
    std::vector<double> thickness(columns);
    for (std::size_t k = 0; k < columns; ++k) {
        p.x[k] = (static_cast<double>(k) + 0.5) * width;
        p.pre_rift_top[k] = std::max(p.pre_rift_top[k], detachment_height(detachment, p.x[k]));
        thickness[k] = std::max(0.0, surface[k] - p.pre_rift_top[k]);
    }
    p.sediment_thickness =
        smooth(thickness, static_cast<std::ptrdiff_t>(std::lround(0.5 * 1e3 / width)));
    return p;
}

std::optional<std::size_t> find_intervening_high(std::span<const double> x,
                                                 std::span<const double> depth,
                                                 double least_prominence) {
    const std::vector<Depocentre> all = find_depocentres(x, depth, least_prominence);
    if (all.size() < 2)
        return std::nullopt;
    const double first = std::ranges::min(all, {}, &Depocentre::x).x;
    double second = first, most = 0.0;
    for (const Depocentre& d : all)
        if (d.x > first && d.prominence > most) {
            second = d.x;
            most = d.prominence;
        }
    std::optional<std::size_t> high;
    for (std::size_t k = 0; k < x.size(); ++k)
        if (x[k] > first && x[k] < second && (!high || depth[k] < depth[*high]))
            high = k;
    return high;
}

std::optional<double> bonded_share_of_old_sediment(const State& state, double level, double depth,
                                                   double age) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const std::vector<bool> touches = touching(state);
    const auto counts = [&](std::int32_t row) {
        const auto i = static_cast<std::size_t>(row);
        return d.stratum[i] > 0 && level - d.y[i] > depth &&
               state.clock.extension - d.start_extension[i] > age;
    };
    std::int64_t all = 0, bonded = 0;
    for (std::size_t k = 0; k < touches.size(); ++k)
        if (touches[k] && counts(c.first[k]) && counts(c.second[k])) {
            ++all;
            bonded += c.bonded[k];
        }
    return all ? std::optional(static_cast<double>(bonded) / static_cast<double>(all))
               : std::nullopt;
}

Measures measure(const Scene& scene, const State& state, const RigidBase& base,
                 std::span<const std::unique_ptr<Event>> events) {
    const ConstDiscColumns d = disc_columns(state);
    const Chain& detachment = base.surfaces.front().chain;
    const double extension = state.clock.extension;
    Measures m;
    m.inertial_number = 0.0;

    const Profile profile = measure_profile(scene, state, base);
    for (double top : profile.pre_rift_top)
        m.basin_area -= top * 2.0 * state.mean_radius;
    if (extension > 0.0)
        m.area_balance = m.basin_area / (extension * scene.hanging_wall->thickness);
    if (extension > 0.0 && scene.detachment) {
        m.cutoff = find_cutoff(state, standing_base(base, state).surfaces.front().chain);
        m.rollover_tilt = head_block_tilt(scene, state, detachment);
        measure_ramp_flat_ramp(m, state, detachment);
        measure_kinematics(scene, detachment, extension, profile, 2.0 * state.mean_radius, m);
    }
    if (scene.sedimentation && scene.bonds)
        m.old_sediment_bonded_fraction = bonded_share_of_old_sediment(
            state, scene.sedimentation->level, 1500.0, 2e5 * scene.extension.rate);
    if (scene.sedimentation)
        m.depocentres = find_depocentres(profile.x, profile.sediment_thickness, 250.0);

    if (const Event* strain = find_event(events, "strain"); strain && extension > 0.0) {
        // Before the first window is over, it is what there is of it.
        const bool whole = strain->applied > 0;
        const std::vector<double> so_far = whole ? std::vector<double>() : shear_strain(state);
        const std::span<const double> window =
            whole ? state.discs.get<double>("window_strain") : std::span<const double>(so_far);
        const std::span<const double> total =
            whole ? state.discs.get<double>("total_strain") : std::span<const double>(so_far);
        std::vector<double> last, sum, area, inertial;
        const double rate =
            scene.extension.speed / (whole ? strain->schedule().spacing() : extension);
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            if (d.stratum[i] != 0)
                continue;
            last.push_back(window[i]);
            sum.push_back(total[i]);
            area.push_back(pi * d.radius[i] * d.radius[i]);
            // I = strain rate * diameter * sqrt(density / pressure).
            const double gravity = scene.gravity ? scene.gravity->acceleration : 0.0;
            const double depth = std::max(2.0 * state.mean_radius, -d.y[i]);
            if (gravity > 0.0)
                inertial.push_back(window[i] * rate * 2.0 * d.radius[i] /
                                   std::sqrt(gravity * depth));
        }
        m.strain_top10 = share_of_densest(last, area, 0.1);
        m.strain_top10_cumulative = share_of_densest(sum, area, 0.1);
        m.strain_gini = gini(last, area);
        if (!inertial.empty()) {
            const double mean =
                std::inner_product(inertial.begin(), inertial.end(), area.begin(), 0.0) /
                std::accumulate(area.begin(), area.end(), 0.0);
            m.inertial_number = 10.0 * mean * share_of_densest(inertial, area, 0.1);
        }
    }

    if (scene.bonds) {
        const ConstContactColumns c = contact_columns(state);
        const std::vector<bool> touches = touching(state);
        std::int64_t all = 0, unbonded = 0;
        for (std::size_t k = 0; k < touches.size(); ++k)
            if (touches[k] && d.stratum[static_cast<std::size_t>(c.first[k])] == 0 &&
                d.stratum[static_cast<std::size_t>(c.second[k])] == 0) {
                ++all;
                unbonded += !c.bonded[k];
            }
        if (all)
            m.basement_unbonded_fraction = static_cast<double>(unbonded) / static_cast<double>(all);
    }
    if (find_event(events, "fault_weakening")) {
        m.weak_fraction = static_cast<double>(std::ranges::count(d.material, weak)) /
                          static_cast<double>(d.x.size());
        m.volume_error_fraction = std::abs(weakened_volume_change(state, base)) /
                                  hanging_wall_area(*scene.hanging_wall, detachment);
    }
    const Ledger& ledger = state.ledger;
    const double mass = std::accumulate(d.mass.begin(), d.mass.end(), 0.0);
    if (scene.sedimentation) {
        m.deposited_fraction = ledger.deposited / ledger.initial;
        m.eroded_fraction = ledger.removed / ledger.initial;
    }
    m.mass_error_fraction =
        std::abs(mass - (ledger.initial + ledger.deposited - ledger.removed)) / ledger.initial;

    if (const Event* equilibrium = find_event(events, "equilibrium");
        equilibrium && equilibrium->applied > 0) {
        const Table& t = equilibrium->memory;
        m.unbalanced_ratio_mean = t.get<double>("mean_ratio_sum")[0] / t.get<double>("samples")[0];
        m.unbalanced_ratio_max = t.get<double>("max_ratio")[0];
    }
    if (scene.gravity)
        m.quasi_static = m.unbalanced_ratio_mean <= greatest_unbalanced_ratio &&
                         m.inertial_number <= greatest_inertial_number;
    if (const auto* account = dynamic_cast<const EnergyAccount*>(find_event(events, "energy")))
        m.energy = account->balance(state, base);
    return m;
}

} // namespace listric
