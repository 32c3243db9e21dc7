#include "apps/laboratory/shear_box.hpp"

#include "apps/laboratory/servo.hpp"
#include "dem/contacts/bond.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/law.hpp"

#include <algorithm>
#include <cmath>

namespace listric {

using namespace dem;

namespace {

constexpr int box_servo_cycles = 5; ///< between adjustments of the walls
constexpr double far = 1e6;         ///< m

/// Walls of the shear box, as surfaces. The first two are a sample's.
enum BoxWall : std::size_t {
    bottom_platen,
    top_platen,
    lower_left,
    lower_right,
    upper_left,
    upper_right,
    zone_left,
    zone_right
};

/// The box: moves its walls and measures what they feel.
class ShearBox {
public:
    ShearBox(Specimen& sample, const ShearBoxParameters& p) : s_(sample), p_(p) {
        height_ = s_.place_of(walls::top).y;
        length_ = s_.place_of(walls::right).x;
        // Rough platens: they hold the discs that they press.
        constexpr double rough = 10.0;
        const double low = 0.5 * (height_ - p.zone_width), high = low + p.zone_width;
        s_.base.surfaces = {{"bottom", {line({-far, 0.0}, {far, 0.0})}, rough},
                            {"top", {line({far, height_}, {-far, height_})}, rough},
                            {"lower left", {line({0.0, low}, {0.0, -far})}},
                            {"lower right", {line({length_, -far}, {length_, low})}},
                            {"upper left", {line({0.0, far}, {0.0, high})}},
                            {"upper right", {line({length_, high}, {length_, far})}},
                            {"zone left", {line({0.0, high}, {0.0, low})}},
                            {"zone right", {line({length_, low}, {length_, high})}}};
        for (Surface& s : s_.base.surfaces)
            place(s, Chain(s.chain), {}, s_.time());
        find_contacts_anew();
        start_ = s_.place_of(top_platen);
    }

    /// Adjusts the top's descent and lets the halves go on past each other with a speed, m/s.
    void advance(double speed) {
        const auto loads = surface_loads(s_.state, s_.base);
        const double dt = s_.state.clock.time_step;
        const double one = contact_parameters(s_.base.material, s_.state.materials[basement], 1.0)
                               .normal_stiffness;
        const double missing = p_.normal_stress * length_ + loads[top_platen].force.y;
        const double descent = servo_.speed(missing, one * std::max(1, loads[top_platen].contacts),
                                            box_servo_cycles * dt);
        for (std::size_t wall : {bottom_platen, lower_left, lower_right})
            s_.steer(wall, {-0.5 * speed, 0.0});
        for (std::size_t wall : {top_platen, upper_left, upper_right})
            s_.steer(wall, {0.5 * speed, -descent});
        // The zone's ends follow the halves'.
        for (const auto& [zone, lower, upper] :
             {std::tuple(zone_left, lower_left, upper_left),
              std::tuple(zone_right, lower_right, upper_right)}) {
            const Point a = end_of(lower), b = end_of(upper);
            s_.reshape(zone, {zone == zone_left ? line(b, a) : line(a, b)}, {0.0, -0.5 * descent});
        }
        s_.advance(box_servo_cycles);
    }

    ShearPoint point() const {
        const auto loads = surface_loads(s_.state, s_.base);
        double upper = 0.0, lower = 0.0;
        for (std::size_t wall : {bottom_platen, lower_left, lower_right})
            lower += loads[wall].force.x;
        for (std::size_t wall : {top_platen, upper_left, upper_right})
            upper += loads[wall].force.x;
        return {slip() / p_.zone_width, 0.5 * (upper - lower) / length_,
                0.5 * (loads[bottom_platen].force.y - loads[top_platen].force.y) / length_,
                end_of(upper_left).y - end_of(lower_left).y, 0.0};
    }

    double slip() const {
        const Point low = s_.place_of(bottom_platen), high = s_.place_of(top_platen);
        return high.x - low.x - start_slip_;
    }
    double descent() const { return start_.y - s_.place_of(top_platen).y; }
    void set_servo_speed(double fastest) { servo_.fastest = fastest; }
    void set_zero() { start_slip_ = s_.place_of(top_platen).x - s_.place_of(bottom_platen).x; }

private:
    /// The end at the zone of a half's end wall.
    Point end_of(std::size_t wall) const {
        const Surface& s = s_.base.surfaces[wall];
        const bool ends_there = wall == lower_right || wall == upper_left;
        const Point p = ends_there ? s.chain.front().end : s.chain.front().start;
        return {p.x + s.translation.x * s_.time(), p.y + s.translation.y * s_.time()};
    }

    void find_contacts_anew() {
        s_.state.base_contacts.resize(0);
        find_contacts(s_.state, s_.base);
    }

    Specimen& s_;
    const ShearBoxParameters& p_;
    double height_, length_, start_slip_ = 0.0;
    Point start_;
    Servo servo_;
};

/// Bonds between discs outside the zone.
std::size_t vice_bonds(const State& state, const std::vector<bool>& in_zone) {
    const ConstContactColumns c = contact_columns(state);
    std::size_t count = 0;
    for (std::size_t k = 0; k < c.first.size(); ++k)
        count += c.bonded[k] && !in_zone[static_cast<std::size_t>(c.first[k])] &&
                 !in_zone[static_cast<std::size_t>(c.second[k])];
    return count;
}

/// Gives a sample the rocks of zone and vice and bonds what touches. Returns which discs are the
/// zone's.
std::vector<bool> fill(Specimen& sample, const ShearBoxFilling& filling, double middle,
                       double zone_width) {
    State& state = sample.state;
    const RockMaterial& vice = filling.vice.value_or(filling.zone);
    const DiscColumns d = disc_columns(state);
    std::vector<bool> in_zone(d.y.size());
    for (std::size_t i = 0; i < in_zone.size(); ++i) {
        in_zone[i] = std::abs(d.y[i] - middle) < 0.5 * zone_width;
        d.material[i] = in_zone[i] ? weak : basement;
    }
    const auto vice_strength = filling.elastic_vice ? std::optional(unbreakable) : vice.bonds;
    const std::vector<bool> touches = touching(state);
    for (std::size_t k = 0; k < touches.size(); ++k) {
        const ConstContactColumns c = contact_columns(std::as_const(state));
        const bool is_vice = !in_zone[static_cast<std::size_t>(c.first[k])] &&
                             !in_zone[static_cast<std::size_t>(c.second[k])];
        const auto& strength = is_vice ? vice_strength : filling.zone.bonds;
        if (touches[k] && strength)
            install_bond(state, k, *strength, 0);
    }
    state.materials = {vice.material, vice.material, filling.zone.material};
    sample.base.material = vice.material;
    return in_zone;
}

/// Presses the top down until the normal stress stays within two percent for a while.
void load(ShearBox& box, const ShearBoxParameters& p) {
    box.set_servo_speed(0.5);
    int calm = 0;
    for (int step = 0; calm < 200 && step < 100000; ++step) {
        box.advance(0.0);
        const bool is_calm =
            std::abs(box.point().normal_stress - p.normal_stress) < 0.02 * p.normal_stress;
        calm = is_calm ? calm + 1 : 0;
    }
    if (calm < 200)
        throw NumericalFailure("the servo does not reach a normal stress of " +
                               std::to_string(p.normal_stress) + " Pa");
}

/// Slides the halves past each other to the largest strain. A point of the curve is the mean on
/// the way to it; broken() is asked for at each.
template <class Broken>
std::vector<ShearPoint> slide(const Specimen& sample, ShearBox& box, const ShearBoxParameters& p,
                              Broken&& broken) {
    std::vector<ShearPoint> curve;
    const double start = sample.time(), ramp = 5.0; // s
    const double spacing = 2e-3;                    // of points, strain
    for (double next = spacing; next < p.largest_strain + 0.5 * spacing; next += spacing) {
        ShearPoint mean = {};
        int samples = 0;
        ShearPoint now;
        while ((now = box.point()).strain < next) {
            const double speed = p.speed * std::min(1.0, (sample.time() - start + 0.05) / ramp);
            for (int k = 0; k < 4; ++k)
                box.advance(speed);
            now = box.point();
            mean.shear_stress += now.shear_stress;
            mean.normal_stress += now.normal_stress;
            ++samples;
        }
        if (samples)
            curve.push_back({now.strain, mean.shear_stress / samples, mean.normal_stress / samples,
                             now.zone_width, broken()});
    }
    return curve;
}

std::vector<Point> places(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    std::vector<Point> result;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        result.push_back({d.x[i], d.y[i]});
    return result;
}

/// Displacement since `start` by height there, in bins of a hundred metres; the ends of the box of
/// this length are left out.
std::vector<ShearProfilePoint> displacement_profile(const State& state,
                                                    const std::vector<Point>& start, double middle,
                                                    double length) {
    constexpr double bin = 100.0;
    const ConstDiscColumns d = disc_columns(state);
    std::vector<double> sum(static_cast<std::size_t>(2.0 * middle / bin) + 1), count(sum.size());
    for (std::size_t i = 0; i < start.size(); ++i) {
        if (start[i].x < 0.1 * length || start[i].x > 0.9 * length || start[i].y < 0.0)
            continue;
        const auto k = std::min(sum.size() - 1, static_cast<std::size_t>(start[i].y / bin));
        sum[k] += d.x[i] - start[i].x;
        count[k] += 1.0;
    }
    std::vector<ShearProfilePoint> profile;
    for (std::size_t k = 0; k < sum.size(); ++k)
        if (count[k] > 0.0)
            profile.push_back({(static_cast<double>(k) + 0.5) * bin - middle, sum[k] / count[k]});
    return profile;
}

} // namespace

double ShearTest::bulk_friction(double from, double to) const {
    double sum = 0.0;
    int count = 0;
    for (const ShearPoint& p : curve)
        if (p.strain >= from && p.strain <= to) {
            sum += p.shear_stress / p.normal_stress;
            ++count;
        }
    return count ? sum / count : 0.0;
}

double ShearTest::peak_friction() const {
    double peak = 0.0;
    for (double strain = 0.01; strain <= curve.back().strain; strain += 0.005)
        peak = std::max(peak, bulk_friction(strain - 0.01, strain));
    return peak;
}

double ShearTest::share_in_zone(double zone_width) const {
    // The profile's mean just beyond the zone, on either side.
    double low = 0.0, high = 0.0;
    int lows = 0, highs = 0;
    for (const ShearProfilePoint& p : profile) {
        const double beyond = std::abs(p.y) - 0.5 * zone_width;
        if (beyond < 0.0 || beyond > 0.25 * zone_width)
            continue;
        (p.y > 0.0 ? high : low) += p.displacement;
        ++(p.y > 0.0 ? highs : lows);
    }
    const double whole = profile.back().displacement - profile.front().displacement;
    return lows && highs && whole > 0.0 ? (high / highs - low / lows) / whole : 0.0;
}

ShearTest shear(Specimen sample, const ShearBoxFilling& filling, const ShearBoxParameters& p) {
    const State& state = sample.state;
    const double middle = 0.5 * sample.place_of(walls::top).y;
    const std::vector<bool> in_zone = fill(sample, filling, middle, p.zone_width);
    ShearBox box(sample, p);
    const auto bonds_at_first = static_cast<double>(vice_bonds(state, in_zone));
    const auto broken = [&] {
        return bonds_at_first > 0.0
                   ? 1.0 - static_cast<double>(vice_bonds(state, in_zone)) / bonds_at_first
                   : 0.0;
    };
    load(box, p);
    ShearTest test;
    test.collapse = box.descent();
    test.broken_by_loading = broken();
    box.set_zero();
    box.set_servo_speed(0.25);
    const std::vector<Point> start = places(state);
    test.curve = slide(sample, box, p, broken);
    const double length = sample.place_of(lower_right).x - sample.place_of(lower_left).x;
    test.profile = displacement_profile(state, start, middle, length);
    return test;
}

} // namespace listric
