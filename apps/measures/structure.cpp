#include "apps/measures/structure.hpp"

#include "apps/measures/fault_history.hpp"
#include "apps/measures/fault_throw.hpp"
#include "apps/measures/kinematics.hpp"
#include "apps/measures/rigid_motion.hpp"
#include "apps/support/statistics.hpp"
#include "dem/cells.hpp"
#include "dem/contacts.hpp"
#include "dem/events/strain.hpp"
#include "dem/power_cell.hpp"
#include "dem/target_line.hpp"
#include "dem/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace listric {

using namespace dem;

namespace {

/// The trace's points below the pre-rift top.
std::vector<Point> in_basement(const std::vector<Point>& trace, const Profile& profile) {
    std::vector<Point> points;
    for (Point p : trace) {
        const auto next = std::ranges::lower_bound(profile.x, p.x);
        const auto k =
            static_cast<std::size_t>(std::min(next - profile.x.begin(), std::ssize(profile.x) - 1));
        if (p.y < profile.pre_rift_top[k])
            points.push_back(p);
    }
    return points;
}

/// Where a trace is at a height; none if it does not reach it.
std::optional<double> x_at(const std::vector<Point>& trace, double y) {
    for (std::size_t k = 0; k + 1 < trace.size(); ++k)
        if (const Point a = trace[k], b = trace[k + 1]; a.y >= y && b.y < y)
            return a.x + (b.x - a.x) * (a.y - y) / (a.y - b.y);
    return std::nullopt;
}

/// The trace with its scarp, which sediment has buried: the pre-rift top from the trace's upper
/// end up the footwall to where it is less than 250 m deep.
std::vector<Point> with_scarp(const std::vector<Point>& trace, const Profile& profile) {
    std::vector<Point> points = trace;
    const double side = trace.front().x > trace.back().x ? 1.0 : -1.0;
    const auto count = std::ssize(profile.x);
    std::ptrdiff_t k = std::ranges::lower_bound(profile.x, trace.front().x) - profile.x.begin();
    for (; k >= 0 && k < count && points.front().y<-250.0; k += side> 0.0 ? 1 : -1) {
        const auto column = static_cast<std::size_t>(k);
        // A trace ends short of the surface by some diameters.
        if (const Point p{profile.x[column], profile.pre_rift_top[column]}; p.y > points.front().y)
            points.insert(points.begin(), p);
    }
    return points;
}

/// Sediment younger than this, m of extension, is too loose for a fault.
double least_age(const Scene& scene) {
    return (scene.fault_weakening ? *scene.fault_weakening : FaultWeakeningParameters{})
               .youngest_sediment *
           scene.extension.rate;
}

class Structure {
public:
    Structure(const Scene& scene, const RigidBase& base, const State& now,
              std::span<const std::unique_ptr<Event>> events, const FaultReport& faults,
              const Measures& measures, std::span<const Past> past)
        : scene_(scene), base_(base), now_(now), events_(events), faults_(faults),
          measures_(measures), past_(past), detachment_(base.surfaces.front().chain), places_(now),
          d_(disc_columns(now)), diameter_(2.0 * now.mean_radius), extension_(now.clock.extension),
          profile_(measure_profile(scene, now, base)) {
        if (!past.empty())
            window_ = shear_field(past.back().places, places_, least_age(scene));
    }

    NamedNumbers numbers() {
        measure_faults();
        measure_material();
        measure_basins();
        measure_hinge();
        measure_ramp_flat_ramp();
        return std::move(numbers_);
    }

private:
    void put(const std::string& name, std::optional<double> value) {
        if (value && std::isfinite(*value))
            numbers_.emplace_back(name, *value);
    }

    void measure_faults() {
        put("faults", static_cast<double>(faults_.faults.size()));
        put("fault_width_diameters", faults_.width);
        put("sediment_weak_off_fault_fraction", faults_.sediment_weak_off_fault_fraction);
        put("antithetic_foot_x_m", faults_.antithetic_foot);
        if (faults_.antithetic_foot)
            put("antithetic_foot_beyond_sole_m",
                *faults_.antithetic_foot - detachment_.back().start.x);
        put_main("antithetic", faults_.main_antithetic);
        put_main("synthetic", faults_.main_synthetic);
        if (faults_.main_antithetic && faults_.main_synthetic) {
            const auto& a = faults_.faults[*faults_.main_antithetic].pre_rift_throw;
            const auto& s = faults_.faults[*faults_.main_synthetic].pre_rift_throw;
            if (a && s && *s > 0.0)
                put("antithetic_over_synthetic_throw", *a / *s);
        }
        put("inner_fault_step_m", inner_fault_step(faults_.faults));
        std::vector<double> correlations;
        for (const Past& p : past_)
            correlations.insert(correlations.end(), p.throw_correlations.begin(),
                                p.throw_correlations.end());
        if (!past_.empty()) {
            const auto last = throw_age_correlations(scene_, base_, now_, past_.back().places);
            correlations.insert(correlations.end(), last.begin(), last.end());
        }
        put("throw_age_faults", static_cast<double>(correlations.size()));
        if (!correlations.empty())
            put("throw_age_correlation", median(correlations));
    }

    void put_main(const std::string& name, std::optional<std::size_t> index) {
        if (!index)
            return;
        const Fault& f = faults_.faults[*index];
        const std::vector<Point> basement = in_basement(f.trace.points, profile_);
        put(name + "_born_at_m", f.born_at);
        put(name + "_dip_at_birth_deg", f.dip_at_birth);
        put(name + "_turn_deg", f.footwall_turn);
        put(name + "_throw_m", f.pre_rift_throw);
        put(name + "_rate_mm_per_a", f.rate);
        put(name + "_x_at_half_depth_m", x_at(f.trace.points, 0.5 * detachment_.back().end.y));
        const auto bow = [](const std::vector<Point>& line) {
            const Point a = line.front(), b = line.back();
            return curvature_of(line) * std::hypot(b.x - a.x, b.y - a.y) / 8.0;
        };
        put(name + "_bow", bow(with_scarp(f.trace.points, profile_)));
        if (basement.size() >= 8) {
            put(name + "_dip_deg", dip_of(basement));
            put(name + "_bow_in_basement", bow(basement));
        }
        if (measures_.rollover_tilt && f.born_at < extension_)
            if (const double turned =
                    *measures_.rollover_tilt - normals_tilt(detachment_, f.born_at);
                turned > 1.0)
                put(name + "_turn_over_head_block", f.footwall_turn / turned);
    }

    void measure_material() {
        const std::vector<double> rock = rock_radii(now_);
        double area[2] = {}, weak_area[2] = {}; // basement, sediment
        for (std::size_t i = 0; i < d_.x.size(); ++i) {
            const std::size_t kind = d_.stratum[i] == 0 ? 0 : 1;
            area[kind] += rock[i] * rock[i];
            weak_area[kind] += d_.material[i] == weak ? rock[i] * rock[i] : 0.0;
        }
        if (scene_.fault_weakening) {
            put("basement_weak_fraction", weak_area[0] / area[0]);
            put("sediment_weak_fraction",
                weak_area[1] / area[1]); // not finite without sediment
        }
        if (scene_.sedimentation && scene_.compaction)
            measure_compaction();
        if (scene_.sedimentation) {
            put("superposition_fraction", superposition());
            const TargetLine surface = target_line();
            double above = 0.0;
            for (std::size_t i = 0; i < d_.x.size(); ++i)
                above += surface.above({d_.x[i], d_.y[i]}) > d_.radius[i];
            put("discs_above_target", above);
        }
    }

    /// That sediment and erosion adapt the surface to.
    TargetLine target_line() const {
        return Target(scene_.sedimentation->level, scene_.sedimentation->target)
            .at(extension_ / scene_.extension.rate);
    }

    /// Porosity of sediment beside Phi(depth). Discs that have risen since keep what they had.
    void measure_compaction() {
        const auto porosity = now_.discs.get<double>("porosity");
        const TargetLine surface = target_line();
        double all = 0.0, error = 0.0, beyond = 0.0;
        for (std::size_t i = 0; i < d_.x.size(); ++i) {
            if (d_.stratum[i] == 0)
                continue;
            const double depth = std::max(0.0, surface.height(d_.x[i]) - d_.y[i]);
            const double expected = scene_.sedimentation->surface_porosity *
                                    std::exp(-scene_.compaction->coefficient * depth);
            const double off = std::abs(porosity[i] / expected - 1.0);
            all += d_.mass[i];
            error += d_.mass[i] * off;
            beyond += off > 0.02 ? d_.mass[i] : 0.0;
        }
        if (all > 0.0) {
            put("porosity_error", error / all);
            put("porosity_off_fraction", beyond / all);
        }
    }

    /// Share of the touching pairs of discs of different strata, one above the other within 45
    /// degrees, whose younger disc is on top.
    std::optional<double> superposition() const {
        const ConstContactColumns c = contact_columns(now_);
        const std::vector<bool> touches = touching(now_);
        double all = 0.0, right = 0.0;
        for (std::size_t k = 0; k < touches.size(); ++k) {
            const auto i = static_cast<std::size_t>(c.first[k]);
            const auto j = static_cast<std::size_t>(c.second[k]);
            const double dx = d_.x[j] - d_.x[i], dy = d_.y[j] - d_.y[i];
            if (!touches[k] || d_.stratum[i] == d_.stratum[j] || std::abs(dx) > std::abs(dy))
                continue;
            all += 1.0;
            right += (d_.stratum[j] > d_.stratum[i]) == (dy > 0.0);
        }
        return all > 0.0 ? std::optional(right / all) : std::nullopt;
    }

    void measure_basins() {
        const std::vector<Depocentre> basins = find_basins(profile_);
        put("basins", static_cast<double>(basins.size()));
        // All but the one at the breakaway are collapse grabens.
        const auto first_x = [](const std::vector<Depocentre>& all) {
            return all.empty() ? 0.0 : std::ranges::min(all, {}, &Depocentre::x).x;
        };
        double most = 0.0;
        int grabens = 0;
        for (const Depocentre& b : basins)
            if (b.x > first_x(basins)) {
                ++grabens;
                most = std::max(most, b.prominence);
            }
        if (measures_.intervening_high) {
            // Relief across the deepest collapse graben: its outer rim is the original surface.
            double deepest = 0.0;
            for (const Depocentre& b : basins)
                if (b.x > measures_.intervening_high->x)
                    deepest = std::max(deepest, b.thickness);
            if (const double inner = deepest - measures_.intervening_high->y; inner > 0.0)
                put("antithetic_over_synthetic_relief", deepest / inner);
        }
        put("collapse_grabens", grabens);
        put("collapse_graben_prominence_m", most);
        measure_order_of_grabens(first_x);
    }

    /// When a collapse graben first appears, when there first are two, and whether the one
    /// before is then the outer one.
    template <class FirstX> void measure_order_of_grabens(FirstX&& first_x) {
        constexpr double apart = 2e3; // what is nearer together is one graben
        std::optional<double> alone;  // place of the only one, less the extension
        for (const Past& p : past_) {
            const double e = p.places.extension;
            std::vector<double> grabens;
            for (const Depocentre& b : p.basins)
                if (b.x > first_x(p.basins) && e > 0.0)
                    grabens.push_back(b.x - e);
            if (grabens.empty())
                continue;
            const auto [inner, outer] = std::ranges::minmax(grabens);
            if (!alone)
                put("first_graben_at_m", e);
            if (outer - inner >= apart) {
                put("second_graben_at_m", e);
                if (alone)
                    put("outer_graben_first", std::abs(outer - *alone) < std::abs(inner - *alone));
                return;
            }
            alone = outer;
        }
    }

    /// How far the deformation has moved into the hanging wall: the tenth percentile, by
    /// strain, of the start x of discs that started 5 to 10 km deep and are strained as much as
    /// a fault is.
    std::optional<double> hinge(const ShearField& field) const {
        std::vector<std::pair<double, double>> strained; // start x, strain
        double all = 0.0;
        const double least = FaultTraceOptions{}.least_strain * field.window / strain_window;
        for (std::size_t k = 0; k < field.x.size(); ++k) {
            const auto i =
                static_cast<std::size_t>(places_.row_of[static_cast<std::size_t>(field.id[k])]);
            if (const double depth = -d_.start_y[i], shear = field.shear(k);
                d_.stratum[i] == 0 && depth > 5e3 && depth < 10e3 && shear >= least) {
                strained.emplace_back(d_.start_x[i], shear);
                all += shear;
            }
        }
        std::ranges::sort(strained);
        double sum = 0.0;
        for (const auto& [x, shear] : strained)
            if ((sum += shear) >= 0.1 * all)
                return x;
        return std::nullopt;
    }

    /// Where the last window's deformation is, beside the early ones'.
    void measure_hinge() {
        if (past_.empty())
            return;
        std::vector<double> early;
        for (std::size_t k = 0; k + 1 < past_.size(); ++k) {
            const double end = past_[k + 1].places.extension;
            if (end < 0.1 * extension_ || end > 0.42 * extension_)
                continue;
            if (const auto x = hinge(only_present(
                    shear_field(past_[k].places, past_[k + 1].places, least_age(scene_)))))
                early.push_back(*x);
        }
        const auto late = hinge(window_);
        if (early.empty() || !late)
            return;
        put("hinge_start_x_m", late);
        put("hinge_step_m", median(early) - *late);
    }

    /// Discs of an earlier field that are still there.
    ShearField only_present(ShearField field) const {
        std::size_t kept = 0;
        for (std::size_t k = 0; k < field.x.size(); ++k) {
            if (places_.row_of[static_cast<std::size_t>(field.id[k])] < 0)
                continue;
            field.id[kept] = field.id[k];
            for (auto* values : {&field.x, &field.y, &field.xx, &field.xy, &field.yx, &field.yy})
                (*values)[kept] = (*values)[k];
            ++kept;
        }
        for (auto* values : {&field.x, &field.y, &field.xx, &field.xy, &field.yx, &field.yy})
            values->resize(kept);
        field.id.resize(kept);
        return field;
    }

    /// Centres of the segments that fault detection found from one extension to another and
    /// that slid as reverse faults dipping to the breakaway by 20 to 80 degrees.
    std::vector<Point> reverse_segments(double from, double to) const {
        std::vector<Point> centres;
        const Event* detection = find_event(events_, "fault_weakening");
        if (!detection)
            return centres;
        const Table& found = detection->memory;
        const auto at = found.get<double>("found_at_m"), slip = found.get<double>("slip_m"),
                   angle = found.get<double>("angle_rad"), x = found.get<double>("x_m"),
                   y = found.get<double>("y_m");
        for (std::size_t k = 0; k < at.size(); ++k)
            if (const double dip = angle[k] * 180.0 / pi;
                at[k] > from + 1.0 && at[k] < to + 1.0 && slip[k] > 0.0 && dip > 20.0 && dip < 80.0)
                centres.push_back({x[k], y[k]});
        return centres;
    }

    /// Of the rock and sediment above the kink in one window, times areas.
    struct AboveKink {
        double strain = 0.0, reverse = 0.0, on_faults = 0.0, sediment = 0.0, stretch = 0.0;
    };

    AboveKink sum_above_kink(const ShearField& field, const std::vector<Point>& segments,
                             double kink, double flat_depth) const {
        const double reach = scene_.fault_weakening
                                 ? 0.5 * scene_.fault_weakening->circle_diameters * diameter_
                                 : 0.0;
        AboveKink sum;
        for (std::size_t k = 0; k < field.x.size(); ++k) {
            const Point p{field.x[k], field.y[k]};
            if (p.y < -flat_depth || p.x < kink - 3e3 || p.x > kink + 6e3)
                continue;
            const auto i =
                static_cast<std::size_t>(places_.row_of[static_cast<std::size_t>(field.id[k])]);
            const double area = d_.radius[i] * d_.radius[i];
            if (d_.stratum[i] > 0) {
                sum.sediment += area;
                sum.stretch += area * field.xx[k];
            }
            const ShearPlane plane = shear_plane(field, k);
            sum.strain += area * plane.strain;
            if (!plane.reverse || plane.falls_right || plane.dip < 20.0 || plane.dip > 80.0)
                continue;
            sum.reverse += area * plane.strain;
            if (std::ranges::any_of(
                    segments, [&](Point s) { return std::hypot(s.x - p.x, s.y - p.y) < reach; }))
                sum.on_faults += area * plane.strain;
        }
        return sum;
    }

    /// Since half of the extension: by then the upper block's toe turns back.
    void measure_above_kink(double kink, double flat_depth) {
        double strain = 0.0, reverse = 0.0, on_faults = 0.0, shortening = 0.0;
        for (std::size_t k = 0; k < past_.size(); ++k) {
            const DiscPlaces& start = past_[k].places;
            const DiscPlaces& end = k + 1 < past_.size() ? past_[k + 1].places : places_;
            if (end.extension < 0.5 * extension_ + 1.0)
                continue;
            const AboveKink sum =
                sum_above_kink(only_present(shear_field(start, end, least_age(scene_))),
                               reverse_segments(start.extension, end.extension), kink, flat_depth);
            strain += sum.strain;
            reverse += sum.reverse;
            on_faults += sum.on_faults;
            if (sum.sediment > 0.0)
                shortening -= sum.stretch / sum.sediment;
        }
        if (!(strain > 0.0))
            return;
        put("kink_reverse_strain_share", reverse / strain);
        put("kink_reverse_fault_share", on_faults / strain);
        put("kink_synrift_shortening", shortening);
    }

    void measure_ramp_flat_ramp() {
        const auto parts = find_ramp_flat_ramp(detachment_);
        if (!parts || past_.empty())
            return;
        const double kink = point_at(detachment_, parts->flat_end).x;
        measure_above_kink(kink, parts->flat_depth);
        double traced = 0.0;
        for (const Fault& f : faults_.faults)
            if (const Point middle = f.trace.points[f.trace.points.size() / 2];
                !f.normal && middle.x > kink - 3e3 && middle.x < kink + 6e3)
                traced += f.trace.length();
        put("kink_reverse_trace_m", traced);

        // Beyond the kink the most prominent basin is the syncline's, the next a collapse
        // graben.
        double upper = 0.0, syncline = 0.0, lower = 0.0;
        const std::vector<Depocentre> basins = find_basins(profile_);
        for (const Depocentre& b : basins) {
            if (b.x <= std::ranges::min(basins, {}, &Depocentre::x).x)
                continue;
            if (b.x < kink + 3e3)
                upper = std::max(upper, b.prominence);
            else if (b.prominence > syncline)
                lower = std::exchange(syncline, b.prominence);
            else
                lower = std::max(lower, b.prominence);
        }
        put("upper_graben_prominence_m", upper);
        put("syncline_basin_prominence_m", syncline);
        put("lower_graben_prominence_m", lower);
        measure_rollovers();
        measure_lower_block(*parts);
    }

    /// Rotation of the uppermost 4 km of pre-rift rock along x. A rollover turns toward the
    /// detachment; a syncline lies where between two of them it turns back.
    void measure_rollovers() {
        constexpr double column = 1e3, thickness = 4e3, least = 10.0;
        std::map<std::int64_t, RigidMotion> columns;
        for (std::size_t i = 0; i < d_.x.size(); ++i)
            if (d_.stratum[i] == 0 && d_.start_y[i] > -thickness)
                columns[static_cast<std::int64_t>(std::floor(d_.x[i] / column))].add(
                    {d_.start_x[i], d_.start_y[i]}, {d_.x[i], d_.y[i]});
        std::vector<double> x, turn;
        for (auto& [number, motion] : columns)
            if (motion.size() >= 20) {
                motion.fit();
                x.push_back((static_cast<double>(number) + 0.5) * column);
                turn.push_back(motion.angle() * 180.0 / pi);
            }
        std::vector<double> smooth = turn;
        for (std::size_t k = 1; k + 1 < turn.size(); ++k)
            smooth[k] = (turn[k - 1] + turn[k] + turn[k + 1]) / 3.0;
        std::vector<Depocentre> maxima = find_depocentres(x, smooth, least);
        put("rollovers", static_cast<double>(maxima.size()));
        if (maxima.size() < 2)
            return;
        maxima.resize(2); // the two that turned most
        const auto [left, right] = std::minmax(maxima[0].x, maxima[1].x);
        double lowest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < x.size(); ++k)
            if (x[k] > left && x[k] < right)
                lowest = std::min(lowest, smooth[k]);
        put("syncline_turn_deg", lowest);
    }

    /// Whether faults surround the block on the lower ramp: the share of directions, seen from
    /// its middle, in which strain of a fault or the detachment comes before 12 km of other
    /// rock.
    void measure_lower_block(const RampFlatRamp& parts) {
        const std::vector<std::size_t> block = lower_block(now_, detachment_, parts);
        if (block.size() < 20)
            return;
        Point middle;
        for (std::size_t i : block)
            middle = {middle.x + d_.x[i] / static_cast<double>(block.size()),
                      middle.y + d_.y[i] / static_cast<double>(block.size())};
        const Cells cells(window_.x, window_.y, 1.5 * diameter_);
        const double least = FaultTraceOptions{}.least_strain * window_.window / strain_window;
        const auto is_fault = [&](Point p) {
            double sum = 0.0, count = 0.0;
            cells.for_each_near(p.x, p.y, [&](std::int32_t row) {
                const auto k = static_cast<std::size_t>(row);
                if (std::hypot(window_.x[k] - p.x, window_.y[k] - p.y) < 1.5 * diameter_) {
                    sum += window_.shear(k);
                    count += 1.0;
                }
            });
            return count > 0.0 && sum >= least * count;
        };
        constexpr int directions = 72;
        constexpr double farthest = 12e3;
        int bounded = 0;
        for (int n = 0; n < directions; ++n) {
            const double a = 2.0 * pi * n / directions;
            for (double s = 5.0 * diameter_; s < farthest; s += 0.5 * diameter_) {
                const Point p{middle.x + s * std::cos(a), middle.y + s * std::sin(a)};
                const auto foot = foot_point(detachment_, p);
                if ((foot && foot->distance < 0.0) || is_fault(p)) {
                    ++bounded;
                    break;
                }
            }
        }
        put("lower_block_bounded_share", static_cast<double>(bounded) / directions);
        double low_angle = 0.0;
        for (const Fault& f : faults_.faults)
            for (std::size_t k = 0; k + 1 < f.trace.points.size() && f.normal; ++k) {
                const Point a = f.trace.points[k], b = f.trace.points[k + 1];
                if (a.y - b.y < 0.5 * std::hypot(b.x - a.x, b.y - a.y) &&
                    std::ranges::any_of(block, [&](std::size_t i) {
                        return std::hypot(d_.x[i] - a.x, d_.y[i] - a.y) < 3e3;
                    }))
                    low_angle += std::hypot(b.x - a.x, b.y - a.y);
            }
        put("lower_block_low_angle_fault_m", low_angle);
    }

    const Scene& scene_;
    const RigidBase& base_;
    const State& now_;
    std::span<const std::unique_ptr<Event>> events_;
    const FaultReport& faults_;
    const Measures& measures_;
    std::span<const Past> past_;
    const Chain& detachment_;
    DiscPlaces places_; ///< now
    ConstDiscColumns d_;
    double diameter_, extension_;
    Profile profile_;
    ShearField window_; ///< the last
    NamedNumbers numbers_;
};

} // namespace

std::vector<Depocentre> find_basins(const Profile& profile) {
    return find_depocentres(profile.x, smoothed_depth(profile), 250.0);
}

NamedNumbers measure_structure(const Scene& scene, const RigidBase& base, const State& now,
                               std::span<const std::unique_ptr<Event>> events,
                               const FaultReport& faults, const Measures& measures,
                               std::span<const Past> past) {
    return Structure(scene, base, now, events, faults, measures, past).numbers();
}

double inner_fault_step(const std::vector<Fault>& faults) {
    constexpr double steep = 45.0, younger = 2e3;
    double step = 0.0;
    for (const Fault& inner : faults) {
        if (!inner.normal || inner.dip < steep)
            continue;
        const Point middle = inner.trace.points[inner.trace.points.size() / 2];
        std::optional<double> nearest;
        for (const Fault& older : faults) {
            if (!older.normal || older.dip < steep || older.born_at > inner.born_at - younger)
                continue;
            const Point beside = *std::ranges::min_element(
                older.trace.points, {}, [&](Point p) { return std::abs(p.y - middle.y); });
            nearest = std::min(nearest.value_or(beside.x - middle.x), beside.x - middle.x);
        }
        step = std::max(step, nearest.value_or(0.0));
    }
    return step;
}

std::optional<double> throw_age_correlation(const std::map<int, double>& throws) {
    const auto n = static_cast<double>(throws.size());
    if (throws.size() < 5)
        return std::nullopt;
    std::vector<double> values;
    for (const auto& [stratum, value] : throws)
        values.push_back(value);
    // Throws do not tie; strata are in order.
    double squares = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto rank = std::ranges::count_if(values, [&](double v) { return v < values[k]; });
        const double difference = static_cast<double>(rank) - static_cast<double>(k);
        squares += difference * difference;
    }
    return 1.0 - 6.0 * squares / (n * (n * n - 1.0));
}

std::vector<double> throw_age_correlations(const Scene& scene, const RigidBase& base,
                                           const State& now, const DiscPlaces& before) {
    std::vector<double> correlations;
    const ShearField field = shear_field(before, DiscPlaces(now), least_age(scene));
    for (const FaultTrace& trace : trace_faults(field, base.surfaces.front().chain)) {
        const bool falls_right = trace.points.back().x > trace.points.front().x;
        if ((median(trace.slip) > 0.0) != falls_right || dip_of(trace.points) < 30.0)
            continue;
        if (const auto r = throw_age_correlation(fault_throws(now, trace.points)))
            correlations.push_back(*r);
    }
    return correlations;
}

ShearPlane shear_plane(const ShearField& field, std::size_t k) {
    // Simple shear g on a plane of direction t: grad u = g t n, so that u_xx - u_yy = -g sin
    // 2a, u_xy + u_yx = g cos 2a and u_xy - u_yx = g for t = (cos a, sin a).
    const double stretch = field.xx[k] - field.yy[k], turn = field.xy[k] + field.yx[k];
    const double sign = field.xy[k] >= field.yx[k] ? 1.0 : -1.0;
    double a = 0.5 * std::atan2(-sign * stretch, sign * turn);
    if (a > 0.0)
        a -= pi; // downward
    ShearPlane plane;
    plane.strain = std::hypot(stretch, turn);
    plane.falls_right = std::cos(a) > 0.0;
    plane.dip = (plane.falls_right ? -a : a + pi) * 180.0 / pi;
    // g > 0: the left of the downward direction moves down; that is the side above a plane that
    // falls right.
    plane.reverse = (sign > 0.0) != plane.falls_right;
    return plane;
}

} // namespace listric
