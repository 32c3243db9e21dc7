#include "apps/laboratory/compression.hpp"

#include "apps/laboratory/servo.hpp"
#include "apps/support/statistics.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/genesis/packing.hpp"
#include "dem/law.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace listric {

using namespace dem;

namespace {

constexpr int servo_cycles = 5; ///< between adjustments of the walls

std::size_t bonds(const State& state) {
    return static_cast<std::size_t>(
        std::ranges::count(contact_columns(state).bonded, std::uint8_t{1}));
}

/// A sample under test: its walls, and the strain of the discs in its inner part.
class Press {
public:
    explicit Press(Specimen& sample) : s_(sample), has_sides_(s_.base.surfaces.size() > 2) {
        set_zero();
    }

    /// Strains count from here.
    void set_zero() {
        height_ = height();
        width_ = width();
        bonds_ = bonds(s_.state);
        const ConstDiscColumns d = disc_columns(std::as_const(s_.state));
        x_.assign(d.x.begin(), d.x.end());
        y_.assign(d.y.begin(), d.y.end());
        const double left = *std::ranges::min_element(x_), right = *std::ranges::max_element(x_);
        const double low = *std::ranges::min_element(y_), high = *std::ranges::max_element(y_);
        inner_.clear();
        for (std::size_t i = 0; i < x_.size(); ++i)
            if (std::abs(x_[i] - 0.5 * (left + right)) < 0.4 * (right - left) &&
                std::abs(y_[i] - 0.5 * (low + high)) < 0.4 * (high - low))
                inner_.push_back(i);
    }

    double height() const { return s_.place_of(walls::top).y - s_.place_of(walls::bottom).y; }
    double width() const {
        if (has_sides_)
            return s_.place_of(walls::right).x - s_.place_of(walls::left).x;
        const ConstDiscColumns d = disc_columns(std::as_const(s_.state));
        double left = 1e300, right = -1e300;
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            left = std::min(left, d.x[i] - d.radius[i]);
            right = std::max(right, d.x[i] + d.radius[i]);
        }
        return right - left;
    }

    /// Stress between a pair of opposite walls, Pa, and the stiffness of the contacts of one.
    struct Load {
        double stress, stiffness;
    };
    Load axial() const {
        const auto loads = surface_loads(s_.state, s_.base);
        return {0.5 * (loads[walls::bottom].force.y - loads[walls::top].force.y) / width(),
                stiffness(loads[walls::bottom], loads[walls::top])};
    }
    Load lateral() const {
        if (!has_sides_)
            return {0.0, 0.0};
        const auto loads = surface_loads(s_.state, s_.base);
        return {0.5 * (loads[walls::left].force.x - loads[walls::right].force.x) / height(),
                stiffness(loads[walls::left], loads[walls::right])};
    }

    /// Both walls of a pair move toward the sample, m/s.
    void press_axially(double speed) {
        s_.steer(walls::bottom, {0.0, speed});
        s_.steer(walls::top, {0.0, -speed});
    }
    void press_laterally(double speed) {
        s_.steer(walls::left, {speed, 0.0});
        s_.steer(walls::right, {-speed, 0.0});
    }

    CompressionPoint point() const {
        const ConstDiscColumns d = disc_columns(std::as_const(s_.state));
        const double present = static_cast<double>(bonds(s_.state));
        return {(height_ - height()) / height_,
                axial().stress,
                (width_ - width()) / width_,
                lateral().stress,
                -gradient(y_, d.y),
                -gradient(x_, d.x),
                bonds_ ? 1.0 - present / static_cast<double>(bonds_) : 0.0};
    }

private:
    double stiffness(const SurfaceLoad& a, const SurfaceLoad& b) const {
        const double one = contact_parameters(s_.base.material, s_.state.materials[basement], 1.0)
                               .normal_stiffness;
        return one * std::max(1.0, 0.5 * (a.contacts + b.contacts));
    }

    /// Least-squares gradient of displacement over position of the inner discs.
    double gradient(const std::vector<double>& start, std::span<const double> now) const {
        double mean_start = 0.0, mean_moved = 0.0;
        for (std::size_t i : inner_) {
            mean_start += start[i];
            mean_moved += now[i] - start[i];
        }
        mean_start /= static_cast<double>(inner_.size());
        mean_moved /= static_cast<double>(inner_.size());
        double square = 0.0, product = 0.0;
        for (std::size_t i : inner_) {
            const double a = start[i] - mean_start;
            square += a * a;
            product += a * (now[i] - start[i] - mean_moved);
        }
        return square > 0.0 ? product / square : 0.0;
    }

    Specimen& s_;
    bool has_sides_;
    double height_ = 0.0, width_ = 0.0;
    std::size_t bonds_ = 0;
    std::vector<double> x_, y_; ///< of the discs at zero strain, m
    std::vector<std::size_t> inner_;
};

/// Moves the side walls toward the confining stress.
void hold_sides(const Specimen& sample, Press& press, Servo& servo,
                const CompressionParameters& p) {
    const Press::Load load = press.lateral();
    press.press_laterally(servo.speed((p.confining - load.stress) * press.height(), load.stiffness,
                                      servo_cycles * sample.state.clock.time_step));
}

/// Loads from all sides until both stresses stay within two percent for a while.
void load_isotropically(Specimen& sample, Press& press, Servo& sides,
                        const CompressionParameters& p) {
    Servo axial;
    const double interval = servo_cycles * sample.state.clock.time_step;
    int calm = 0;
    for (int step = 0; calm < 100 && step < 40000; ++step) {
        const Press::Load load = press.axial();
        press.press_axially(
            axial.speed((p.confining - load.stress) * press.width(), load.stiffness, interval));
        hold_sides(sample, press, sides, p);
        sample.advance(servo_cycles);
        const bool is_calm = std::abs(press.axial().stress - p.confining) < 0.02 * p.confining &&
                             std::abs(press.lateral().stress - p.confining) < 0.02 * p.confining;
        calm = is_calm ? calm + 1 : 0;
    }
    if (calm < 100)
        throw NumericalFailure("the servo does not reach a confining stress of " +
                               std::to_string(p.confining) + " Pa");
}

/// Compresses to an axial strain, with the platens' speed() at each moment, m/s. The stresses of
/// the point are means on the way.
template <class Speed>
CompressionPoint compress_to(double axial_strain, Specimen& sample, Press& press, Servo& sides,
                             const CompressionParameters& p, Speed&& speed) {
    CompressionPoint point = {};
    double axial = 0.0, lateral = 0.0;
    int samples = 0;
    while ((point = press.point()).axial_strain < axial_strain) {
        press.press_axially(speed());
        for (int k = 0; k < 4; ++k) {
            hold_sides(sample, press, sides, p);
            sample.advance(servo_cycles);
        }
        axial += press.axial().stress;
        lateral += press.lateral().stress;
        ++samples;
    }
    if (samples) {
        point.axial_stress = axial / samples;
        point.lateral_stress = lateral / samples;
    }
    return point;
}

} // namespace

void consolidate(Specimen& sample, const RockMaterial& rock, bool unbreakably) {
    if (const auto strength = unbreakably ? std::optional(unbreakable) : rock.bonds)
        bond_touching(sample.state, *strength, 0);
    sample.state.materials.assign(3, rock.material);
}

std::vector<CompressionPoint> compress_elastically(Specimen sample,
                                                   const CompressionParameters& p) {
    constexpr double last_strain = 5e-4;
    sample.base.surfaces.resize(2); // the sides are free
    sample.state.base_contacts.resize(0);
    find_contacts(sample.state, sample.base);
    const double dt = sample.state.clock.time_step;
    sample.advance(2000); // rock that the sides held in comes to rest
    Press press(sample);
    const double height = press.height(), full_speed = 0.5 * p.strain_rate * height;
    const double duration = last_strain / p.strain_rate;
    const double ramp = 0.1 * duration; // s
    std::vector<CompressionPoint> curve{press.point()};
    const double start = sample.time();
    const auto cycles =
        std::max<std::int64_t>(servo_cycles, static_cast<std::int64_t>(duration / (100.0 * dt)));
    while (curve.back().axial_strain < last_strain) {
        press.press_axially(full_speed * std::min(1.0, (sample.time() - start + dt) / ramp));
        sample.advance(cycles);
        curve.push_back(press.point());
    }
    return curve;
}

std::vector<CompressionPoint> compress_to_failure(Specimen sample, const CompressionParameters& p) {
    Press press(sample);
    Servo sides;
    load_isotropically(sample, press, sides, p);
    press.set_zero();
    const double dt = sample.state.clock.time_step, start = sample.time(), ramp = 200.0 * dt;
    const double full_speed = 0.5 * p.strain_rate * press.height();
    std::vector<CompressionPoint> curve{press.point()};
    const double spacing = 1e-4; // of points, strain
    double peak = 0.0, strain_at_peak = 0.0;
    for (double next = spacing; curve.back().axial_strain < p.largest_strain; next += spacing) {
        curve.push_back(compress_to(next, sample, press, sides, p, [&] {
            return full_speed * std::min(1.0, (sample.time() - start + dt) / ramp);
        }));
        const CompressionPoint& now = curve.back();
        if (now.axial_stress > peak) {
            peak = now.axial_stress;
            strain_at_peak = now.axial_strain;
        }
        // Past the peak: well below it, or no higher for as long again.
        if (now.axial_strain > 1.25 * strain_at_peak + 2e-3 && now.axial_stress < 0.85 * peak)
            break;
        if (now.axial_strain > 2.0 * strain_at_peak + 5e-3)
            break;
    }
    return curve;
}

Elasticity elasticity(const std::vector<CompressionPoint>& curve) {
    std::vector<double> axial, lateral, stress;
    for (const CompressionPoint& p : curve)
        if (p.axial_strain >= 0.2 * curve.back().axial_strain) {
            axial.push_back(p.gauge_axial);
            lateral.push_back(p.gauge_lateral);
            stress.push_back(p.axial_stress);
        }
    return {least_squares_slope(axial, stress), -least_squares_slope(axial, lateral)};
}

double peak_stress(const std::vector<CompressionPoint>& curve) {
    constexpr std::size_t width = 10;
    double peak = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < curve.size(); ++k) {
        sum += curve[k].axial_stress;
        if (k >= width)
            sum -= curve[k - width].axial_stress;
        peak = std::max(peak, sum / static_cast<double>(std::min(k + 1, width)));
    }
    return peak;
}

} // namespace listric
