// Studies of the cycle: what time step, density scaling, precision and neighbour lists cost and
// give, on problems whose answer is known and on a short run.

#include "apps/studies/study.hpp"

#include "apps/measures/dictionary.hpp"
#include "apps/support/stopwatch.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/material.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace listric {

using namespace dem;

namespace {

constexpr double radius = 93.1, density = 2600.0;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct DiscAt {
    double x, y; ///< m
};

/// Discs of one size at rest, bonded for good to those that they touch.
State bonded_discs(const std::vector<DiscAt>& places, const Material& material,
                   const RigidBase& base) {
    State state = empty_state();
    state.materials.assign(3, material);
    state.mean_radius = radius;
    state.skin = 0.25 * radius;
    add_discs(state, places.size());
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < places.size(); ++i) {
        d.x[i] = d.start_x[i] = places[i].x;
        d.y[i] = d.start_y[i] = places[i].y;
        d.radius[i] = radius;
        d.mass[i] = density * pi * radius * radius;
    }
    find_contacts(state, base);
    const ContactColumns c = contact_columns(state);
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        const auto i = static_cast<std::size_t>(c.first[k]);
        const auto j = static_cast<std::size_t>(c.second[k]);
        if (hypotenuse(d.x[j] - d.x[i], d.y[j] - d.y[i]) < 2.001 * radius) {
            c.bonded[k] = 1;
            c.tensile_strength[k] = c.shear_strength[k] = 1e30f;
        }
    }
    return state;
}

/// A standing wave in a chain with free ends, of which every place is known at all times.
struct Wave {
    static constexpr std::size_t discs = 60;
    static constexpr int mode = 10;
    static constexpr double amplitude = 1e-3; // m
    static constexpr double periods = 20.25;
    Material material;
    double left = 0.0; ///< x of the first disc, m

    double wave_number() const { return pi * mode / static_cast<double>(discs); }
    double shape(std::size_t j) const {
        return dem::cosine(wave_number() * (static_cast<double>(j) + 0.5));
    }
    double rest(std::size_t j) const { return left + 2.0 * radius * static_cast<double>(j); }
    /// Fastest oscillation of two neighbours, 1/s; the stability limit is 2 / greatest().
    double greatest() const {
        return 2.0 * std::sqrt(0.5 * material.normal_stiffness / (density * pi * radius * radius));
    }
    double frequency() const { return greatest() * dem::sine(0.5 * wave_number()); }
};

/// Swings for some periods. `after_cycle` may disturb the state. Error: greatest difference from
/// the exact displacement at the end, over the amplitude.
StudyPoint swing(const Wave& wave, double safety, const std::function<void(State&)>& after_cycle) {
    std::vector<DiscAt> places;
    for (std::size_t j = 0; j < Wave::discs; ++j)
        places.push_back({wave.rest(j), 0.0});
    State state = bonded_discs(places, wave.material, {});
    const double limit = 2.0 / wave.greatest(), omega = wave.frequency();
    const double end = Wave::periods * 2.0 * pi / omega;
    const auto cycles = static_cast<std::int64_t>(std::ceil(end / (safety * limit) - 1e-9));
    // Just above the limit the step stays what it is; below, whole steps reach the end.
    const double dt = safety < 1.0 ? end / static_cast<double>(cycles) : safety * limit;
    state.clock.time_step = dt;
    const DiscColumns d = disc_columns(state);
    for (std::size_t j = 0; j < Wave::discs; ++j) {
        d.x[j] += Wave::amplitude * wave.shape(j);
        // Velocities are half a step behind.
        d.vx[j] = Wave::amplitude * omega * dem::sine(0.5 * omega * dt) * wave.shape(j);
    }
    const auto start = SteadyClock::now();
    try {
        if (after_cycle)
            for (std::int64_t n = 0; n < cycles; ++n) {
                advance(state, {}, {0.0, 0.0}, 1);
                after_cycle(state);
            }
        else
            advance(state, {}, {0.0, 0.0}, cycles);
    } catch (const NumericalFailure&) {
    }
    const double now = dem::cosine(omega * dt * static_cast<double>(cycles));
    double worst = 0.0;
    for (std::size_t j = 0; j < Wave::discs; ++j) {
        const double error = d.x[j] - wave.rest(j) - Wave::amplitude * wave.shape(j) * now;
        worst =
            std::max(worst, std::isfinite(error) ? std::abs(error) / Wave::amplitude : infinity);
    }
    return {"",
            "",
            "displacement",
            worst < 10.0 ? worst : infinity,
            seconds_since(start),
            static_cast<double>(cycles) * Wave::discs};
}

/// A hexagonal bonded block that a slow platen shortens, damped as in runs; the axial stiffness
/// that the other platen feels, over that of the same block at rest.
struct Squeeze {
    static constexpr std::size_t columns = 21, rows = 9;
    static constexpr double shortening = 2e-5; // of the length
    static constexpr double time = 60.0;       // s of the slow platen
    Material material;

    double length() const { return radius * static_cast<double>(2 * columns + 1); }

    RigidBase base(bool moves) const {
        const double high = 2.0 * radius * rows, push = shortening * length();
        const double right = length() - radius - (moves ? 0.0 : push);
        RigidBase b;
        b.material = material;
        b.surfaces = {{"left", {line({-radius, high}, {-radius, -high})}, 0.0, 0.0, {}},
                      {"right", {line({right, -high}, {right, high})}, 0.0, 0.0, {}}};
        if (moves) {
            b.surfaces[1].translation = {-1.0, 0.0};
            b.motion = {push / time, 0.0};
        }
        return b;
    }

    State block(const RigidBase& b) const {
        std::vector<DiscAt> places;
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t c = 0; c < columns; ++c)
                places.push_back({radius * static_cast<double>(2 * c + r % 2),
                                  radius * std::sqrt(3.0) * static_cast<double>(r)});
        return bonded_discs(places, material, b);
    }

    /// Force on the left platen, N/m.
    double reaction(const State& state) const {
        const ConstDiscColumns d = disc_columns(state);
        double force = 0.0;
        for (std::size_t i = 0; i < d.x.size(); ++i)
            force += 0.5 * material.normal_stiffness * std::max(0.0, -d.x[i]);
        return force;
    }
};

/// `safety` of the time step's limit and `mass` over the discs' own.
StudyPoint squeeze(const Squeeze& s, double at_rest, double safety, double mass) {
    const RigidBase base = s.base(true);
    State state = s.block(base);
    const double own = disc_columns(state).mass[0];
    state.inertial_mass_floor = mass * own;
    for (double& m : state.discs.get(dem::columns::mass))
        m = std::min(m, mass * own); // lighter discs have no weight here that would be lost
    const double limit = stable_time_step(mass * own, s.material, 0.7, 1.0);
    const auto cycles = static_cast<std::int64_t>(std::ceil(Squeeze::time / (safety * limit)));
    state.clock.time_step = Squeeze::time / static_cast<double>(cycles);
    const auto start = SteadyClock::now();
    try {
        advance(state, base, {0.7, 0.0}, cycles);
    } catch (const NumericalFailure&) {
    }
    const double error = std::abs(s.reaction(state) / at_rest - 1.0);
    return {"",
            "",
            "reaction",
            error < 10.0 ? error : infinity,
            seconds_since(start),
            static_cast<double>(cycles) * Squeeze::columns * Squeeze::rows};
}

/// Adds what `measure` gives, with the least time of a few repeats: these take milliseconds.
void add(StudyResult& result, StopToken stop, std::string method, std::string parameter,
         const std::function<StudyPoint()>& measure) {
    stop.check();
    StudyPoint point = measure();
    for (int repeat = 0; repeat < 4; ++repeat)
        point.wall = std::min(point.wall, measure().wall);
    point.method = std::move(method);
    point.parameter = std::move(parameter);
    result.points.push_back(std::move(point));
}

/// Rounds numbers to single precision.
void round_to_float(std::span<double> values) {
    for (double& v : values)
        v = static_cast<double>(static_cast<float>(v));
}

} // namespace

StudyResult study_time_step(const StudyRequest& request) {
    StudyResult result;
    result.title = "Time step and density scaling";
    for (double safety : {1.01, 0.95, 0.8, 0.5, 0.25, 0.125, 0.0625, 0.03125})
        add(result, request.stop, "wave in a chain: time step", fmt::format("safety={:g}", safety),
            [&] { return swing({}, safety, {}); });

    const Squeeze s;
    const RigidBase fixed = s.base(false);
    State rest = s.block(fixed);
    rest.clock.time_step = stable_time_step(disc_columns(rest).mass[0], s.material, 0.7, 0.9);
    advance(rest, fixed, {0.7, 0.0}, 40000);
    const double at_rest = s.reaction(rest);
    for (double safety : {1.5, 0.95, 0.5, 0.25, 0.125})
        add(result, request.stop, "bonded lattice: time step", fmt::format("safety={:g}", safety),
            [&] { return squeeze(s, at_rest, safety, 1.0); });
    for (double mass : {1024.0, 256.0, 64.0, 16.0, 4.0, 1.0, 0.25})
        add(result, request.stop, "bonded lattice: density scaling", fmt::format("mass={:g}", mass),
            [&] { return squeeze(s, at_rest, 0.95, mass); });

    const StudyRequest runs = with_scene(request, "lis1");
    const std::vector<std::string> short_run{"extension.distance_m=3000.0"};
    const std::vector<StudyQuantity> quantities{
        {measures::name_of<&measures::Measures::rollover_tilt>()},
        {measures::name_of<&measures::Measures::area_balance>()},
        {measures::name_of<&measures::Measures::strain_top10>()},
        {measures::name_of<&measures::Measures::unbalanced_ratio_mean>(), 0.0, true}};
    sweep_runs(
        runs, runs.scene + " 3 km time step: runs",
        runs_along("safety", "cycle.time_step_safety", {1.5, 0.95, 0.7, 0.5, 0.25}, short_run),
        quantities, result);
    sweep_runs(runs, runs.scene + " 3 km density scaling: runs",
               runs_along("mass_floor", "cycle.inertial_mass_floor",
                          {48.0, 12.0, 3.0, 0.75, 0.1875}, short_run),
               quantities, result);
    return result;
}

StudyResult study_precision(const StudyRequest& request) {
    StudyResult result;
    result.title = "Single precision and neighbour lists";
    // Rounding is put on after every cycle; it costs time here and would save some where the cycle
    // itself is in single precision: at most half, since half the bytes move.
    struct Rounding {
        const char* name;
        std::function<void(State&)> apply;
    };
    for (double left : {0.0, 25e3}) {
        Wave wave;
        wave.left = left;
        const Rounding roundings[] = {
            {"double", [](State&) {}},
            {"velocities single",
             [](State& state) { round_to_float(state.discs.get(dem::columns::vx)); }},
            {"displacements single",
             [](State& state) {
                 const DiscColumns d = disc_columns(state);
                 for (std::size_t i = 0; i < d.x.size(); ++i)
                     d.x[i] = d.start_x[i] +
                              static_cast<double>(static_cast<float>(d.x[i] - d.start_x[i]));
             }},
            {"places single",
             [](State& state) { round_to_float(state.discs.get(dem::columns::x)); }},
        };
        for (const Rounding& rounding : roundings)
            for (double safety : {0.8, 0.4, 0.2, 0.1, 0.05})
                add(result, request.stop,
                    fmt::format("wave at x = {:g} km: {}", left / 1e3, rounding.name),
                    fmt::format("safety={:g}", safety),
                    [&] { return swing(wave, safety, rounding.apply); });
    }

    const StudyRequest runs = with_scene(request, "lis1");
    sweep_runs(runs, runs.scene + " 2 km neighbour lists: runs",
               runs_along("skin", "cycle.skin", {0.15, 0.4, 0.7, 1.0, 0.25},
                          {"extension.distance_m=2000.0"}),
               {{measures::name_of<&measures::Measures::rollover_tilt>()},
                {measures::name_of<&measures::Measures::area_balance>()},
                {measures::name_of<&measures::Measures::strain_top10>()}},
               result);
    return result;
}

} // namespace listric
