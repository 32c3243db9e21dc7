#include "apps/laboratory/sample.hpp"

#include "dem/contacts/contacts.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/genesis/packing.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <cmath>

namespace listric {

using namespace dem;

namespace {

/// Mean normal stress on the four walls, Pa.
double wall_stress(const Specimen& s, const SampleParameters& p) {
    const std::vector<SurfaceLoad> loads = surface_loads(s.state, s.base);
    return 0.25 * ((loads[walls::bottom].force.y - loads[walls::top].force.y) / p.width +
                   (loads[walls::left].force.x - loads[walls::right].force.x) / p.height);
}

/// Scales all radii until the walls feel the wanted stress at rest, within five percent. Where
/// loose discs go on knocking at their cages it ends after a while. Returns the relative error.
double adjust_stress(Specimen& s, const SampleParameters& p) {
    // A packing yields by about a contact's stiffness per unit of radial strain.
    const double modulus = 0.5 * s.state.materials[basement].normal_stiffness;
    // Near the stress at which it falls apart it is much softer: then strains grow.
    double gain = 0.3, before = 0.0;
    for (int round = 0; round < 400; ++round) {
        s.advance(100);
        const double missing = p.stress - wall_stress(s, p);
        if (std::abs(missing) < 0.05 * p.stress &&
            force_balance(s.state, s.base, 0.0).mean_ratio() < 0.02)
            break;
        if (missing * before < 0.0)
            gain = std::max(0.1, 0.5 * gain);
        else if (std::abs(missing) > 0.8 * std::abs(before))
            gain = std::min(10.0, 1.3 * gain);
        before = missing;
        const double strain = std::clamp(gain * missing / modulus, -1e-3, 1e-3);
        for (double& radius : disc_columns(s.state).radius)
            radius *= 1.0 + strain;
        s.state.displacement_bound += std::abs(strain) * 2.0 * s.state.mean_radius;
        if (round % 20 == 0) // the lists know the radii that discs had
            find_contacts(s.state, s.base);
    }
    return std::abs(wall_stress(s, p) / p.stress - 1.0);
}

/// Lets discs with fewer than three contacts grow toward their third nearest neighbour, but no
/// larger than the largest disc. Returns how many grew.
std::size_t grow_floaters(Specimen& s, double overlap) {
    const std::vector<int> contacts = coordination(s.state, s.base);
    const DiscColumns d = disc_columns(s.state);
    const ConstContactColumns c = contact_columns(std::as_const(s.state));
    const ConstBaseContactColumns b = base_contact_columns(std::as_const(s.state));
    std::vector<std::vector<double>> gaps(d.x.size());
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]);
        const auto j = static_cast<std::size_t>(c.second[k]);
        if (contacts[i] >= 3 && contacts[j] >= 3)
            continue;
        const double gap = hypotenuse(d.x[j] - d.x[i], d.y[j] - d.y[i]) - d.radius[i] - d.radius[j];
        gaps[i].push_back(gap);
        gaps[j].push_back(gap);
    }
    for (std::size_t k = 0; k < b.disc.size(); ++k) {
        const auto i = static_cast<std::size_t>(b.disc[k]);
        if (const auto foot = nearest(s.base.surfaces[static_cast<std::size_t>(b.surface[k])],
                                      s.time(), {d.x[i], d.y[i]}))
            gaps[i].push_back(foot->distance - d.radius[i]);
    }
    const double largest = *std::ranges::max_element(d.radius);
    std::size_t floaters = 0;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        if (contacts[i] >= 3 || d.radius[i] >= largest)
            continue;
        ++floaters;
        std::ranges::sort(gaps[i]);
        const double third = gaps[i].size() < 3 ? 1e300 : std::max(0.0, gaps[i][2]);
        d.radius[i] =
            std::min(largest, d.radius[i] + std::min(0.01 * d.radius[i], third + overlap));
    }
    find_contacts(s.state, s.base);
    return floaters;
}

/// Walls and as many discs as shall fill them, at random, unbonded and without friction.
Specimen scattered_sample(const SampleParameters& p, const Material& material, StopToken stop) {
    Specimen s;
    s.stop = stop;
    constexpr double far = 1e6;
    s.base.surfaces = {{"bottom", {line({-far, 0.0}, {far, 0.0})}},
                       {"top", {line({far, p.height}, {-far, p.height})}},
                       {"left", {line({0.0, far}, {0.0, -far})}},
                       {"right", {line({p.width, -far}, {p.width, far})}}};
    s.base.material = material;
    s.base.motion = {1.0, 0.0};
    s.physics = {p.damping, 0.0};

    State& state = s.state = empty_state();
    state.seed = p.seed;
    state.mean_radius = mean_radius(p);
    state.skin = p.skin * state.mean_radius;
    state.materials.assign(3, material);
    for (Material& m : state.materials)
        m.friction = 0.0;
    const RadiusRange range = radius_range(state.mean_radius, p.radius_ratio);
    const double density = p.rock_density / (1.0 - p.porosity);
    state.clock.time_step = stable_time_step(density * pi * range.smallest * range.smallest,
                                             material, p.damping, p.time_step_safety);
    add_discs(state, p.discs);
    const std::vector<double> radius = draw_radii(range, p.discs, p.seed);
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < p.discs; ++i)
        d.mass[i] = density * pi * radius[i] * radius[i];
    scatter_and_expand(state, s.base, radius, p.width, 0.0, p.height, p.damping,
                       [&](std::string_view, double) { stop.check(); });
    sort_discs(state);
    find_contacts(state, s.base);
    return s;
}

/// Gives the discs the wanted rock's mass and lets their displacements count from here.
void finish(Specimen& s, const SampleParameters& p) {
    const DiscColumns d = disc_columns(s.state);
    double solid = 0.0;
    for (double r : d.radius)
        solid += pi * r * r;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        d.mass[i] = p.rock_density * p.width * p.height / solid * pi * d.radius[i] * d.radius[i];
        d.rotation[i] = 0.0;
        d.start_x[i] = d.x[i];
        d.start_y[i] = d.y[i];
    }
    stop_discs(s.state);
    find_contacts(s.state, s.base);
}

} // namespace

double mean_radius(const SampleParameters& p) {
    const double area = (1.0 - p.porosity) * p.width * p.height / static_cast<double>(p.discs);
    return std::sqrt(area / (pi * radius_range(1.0, p.radius_ratio).mean_square()));
}

std::size_t disc_count(const SampleParameters& p, double mean_radius) {
    return static_cast<std::size_t>((1.0 - p.porosity) * p.width * p.height /
                                    (pi * radius_range(mean_radius, p.radius_ratio).mean_square()));
}

Specimen make_sample(const SampleParameters& p, const Material& material, StopToken stop) {
    Specimen s = scattered_sample(p, material, stop);
    double error = adjust_stress(s, p);
    const double overlap = p.stress * 2.0 * s.state.mean_radius / (0.5 * material.normal_stiffness);
    for (int round = 0; p.floaters_grow && round < 60; ++round) {
        if (grow_floaters(s, overlap) <= p.floater_share * static_cast<double>(p.discs))
            break;
        s.advance(100);
        error = adjust_stress(s, p);
    }
    if (error > 0.5)
        throw NumericalFailure("a sample of " + std::to_string(p.discs) + " discs, seed " +
                               std::to_string(p.seed) + ", does not settle at " +
                               std::to_string(p.stress) + " Pa");
    finish(s, p);
    return s;
}

void Specimen::steer(std::size_t surface, Point velocity) {
    Surface& s = base.surfaces[surface];
    place(s, moved(s.chain, {s.translation.x * time(), s.translation.y * time()}), velocity,
          time());
}

void Specimen::reshape(std::size_t surface, const Chain& chain, Point velocity) {
    place(base.surfaces[surface], chain, velocity, time());
}

Point Specimen::place_of(std::size_t surface) const {
    const Surface& s = base.surfaces[surface];
    const Point start = s.chain.front().start;
    return {start.x + s.translation.x * time(), start.y + s.translation.y * time()};
}

void Specimen::advance(std::int64_t cycles) {
    stop.check();
    // Between searches the lists know surfaces by their present motion, traced back to the last
    // search. Steered surfaces were elsewhere then, but no further than this.
    surface_travel_ += greatest_translation(base) * static_cast<double>(cycles) *
                       state.clock.time_step * base.motion.speed;
    if (surface_travel_ > 0.1 * state.skin) {
        find_surface_contacts(state, base);
        surface_travel_ = 0.0;
    }
    dem::advance(state, base, physics, cycles, {1, cycle});
}

} // namespace listric
