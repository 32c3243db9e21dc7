#include "apps/measures/measures.hpp"

#include "apps/measures/basin/kinematics.hpp"
#include "apps/measures/basin/profile.hpp"
#include "apps/measures/faults/localisation.hpp"
#include "apps/measures/paper/blocks.hpp"
#include "apps/measures/strata/cohesion.hpp"
#include "dem/base/just_before.hpp"
#include "dem/base/place.hpp"
#include "dem/events/equilibrium.hpp"
#include "dem/events/strain.hpp"

#include <cassert>
#include <cmath>
#include <numeric>

namespace listric::measures {

using namespace dem;

namespace {

/// Eroded rock, over extension x thickness, that the balance of areas may be wrong by.
constexpr double most_eroded = 0.01;

/// Whether so much of the rock that was there before the rift is gone.
bool rock_is_eroded(const Setting& setting, const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    double rock = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0)
            rock += d.mass[i];
    const double share = 1.0 - rock / state.ledger.initial; // of the hanging wall
    return share * setting.length > most_eroded * state.clock.extension.m;
}

using Events = std::span<const std::unique_ptr<Event>>;

/// @param base  of walls that no basement fault moves the area is balanced
void add_area(Measures& m, const Setting& setting, const State& state, const RigidBase& base,
              const Profile& profile) {
    const double extension = state.clock.extension.m;
    m.basin_area = area_above(profile, profile.x.size(), 2.0 * state.mean_radius) -
                   area_above_start(setting, state);
    if (extension > 0.0 && wall_way(base, extension) == extension && !find_basement_block(base) &&
        !rock_is_eroded(setting, state))
        m.area_balance = m.basin_area / (extension * setting.thickness);
}

void add_rotations(Measures& m, const Setting& setting, const State& state,
                   const Chain& detachment) {
    if (head_block_turns(detachment, state.clock.extension.m))
        m.rollover_tilt = head_block_tilt(state, detachment, setting.thickness);
    if (const auto parts = find_ramp_flat_ramp(detachment)) {
        const auto rotations = measure_ramp_flat_ramp(state, detachment, *parts);
        m.breakaway_rotation = rotations.breakaway;
        m.toe_rotation = rotations.toe;
        m.lower_block_rotation = rotations.lower_block;
    }
}

void add_prediction(Measures& m, const Setting& setting, const Chain& detachment, double extension,
                    const Profile& profile) {
    const KinematicPrediction predicted = predict_kinematics(detachment, extension, profile);
    if (m.area_balance) { // else the pre-rift top is not what deformation made it
        m.dilation_area = extension * setting.thickness - m.basin_area;
        m.depth_to_detachment = m.basin_area / extension;
        m.normals_misfit = predicted.normals_misfit;
        if (predicted.shear) {
            m.inclined_shear_angle = predicted.shear->angle;
            m.inclined_shear_misfit = predicted.shear->misfit;
        }
    }
    m.predicted_tilt = predicted.tilt;
    m.predicted_cutoff = predicted.cutoff;
    m.predicted_halfgraben_area_share = predicted.halfgraben_share;
}

void add_intervening_high(Measures& m, const Profile& profile, double column) {
    const std::vector<double> depth = smoothed_depth(profile);
    if (const auto high = find_intervening_high(profile.x, depth, depocentre_prominence)) {
        m.intervening_high = Point{profile.x[*high], depth[*high]};
        m.halfgraben_area_share =
            area_above(profile, *high + 1, column) / area_above(profile, profile.x.size(), column);
    }
}

void add_sediment(Measures& m, const Setting& setting, const State& state, const Profile& profile) {
    if (!setting.sediment)
        return;
    if (setting.has_bonds) {
        const TargetLine surface =
            setting.sediment->target.at(setting.calendar.age(state.clock.travel));
        const double age = old_sediment_age + travel_of_cycle(setting.motion, state.clock).m;
        m.old_sediment_bonded_fraction =
            bonded_share_of_old_sediment(state, surface, old_sediment_depth, age);
        m.old_sediment_bonded_profile = bonded_profile_of_old_sediment(state, surface, age);
    }
    m.depocentres = find_depocentres(profile.x, profile.sediment_thickness, depocentre_prominence);
}

void add_localisation(Measures& m, const Setting& setting, const State& state, Events events) {
    const auto* strain = find<Strain>(events);
    if (!strain || state.clock.travel.m <= 0.0)
        return;
    const Localisation found = measure_localisation(setting, state, *strain);
    m.strain_top10 = found.top10;
    m.strain_top10_cumulative = found.top10_cumulative;
    m.strain_gini = found.gini;
    m.inertial_number = found.inertial_number;
}

/// After the localisation.
void add_quietness(Measures& m, const Setting& setting, Events events) {
    if (const auto* equilibrium = find<Equilibrium>(events);
        equilibrium && equilibrium->applied > 0) {
        const Table& t = equilibrium->memory;
        m.unbalanced_ratio_mean = t.get<double>("mean_ratio_sum")[0] / t.get<double>("samples")[0];
        m.unbalanced_ratio_max = t.get<double>("max_ratio")[0];
    }
    if (setting.gravity > 0.0 && m.unbalanced_ratio_mean)
        m.quasi_static = *m.unbalanced_ratio_mean <= greatest_unbalanced_ratio &&
                         m.inertial_number <= greatest_inertial_number;
}

/// Rock near the moving wall, where a rigid detachment is flat.
void add_still_ground(Measures& m, const Setting& setting, const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    double rise = 0.0, count = 0.0;
    for (std::size_t i = 0; i < d.x.size(); ++i)
        if (d.stratum[i] == 0 && d.start_y[i] > -0.1 * setting.thickness &&
            d.start_x[i] > 0.9 * setting.length &&
            d.start_x[i] < setting.length - 4.0 * state.mean_radius) {
            rise += d.y[i] - d.start_y[i];
            count += 1.0;
        }
    if (count > 0.0)
        m.still_ground = rise / count;
}

void add_conservation(Measures& m, const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const Ledger& ledger = state.ledger;
    const double mass = std::accumulate(d.mass.begin(), d.mass.end(), 0.0);
    m.mass_error_fraction =
        std::abs(mass - (ledger.initial + ledger.deposited - ledger.removed)) / ledger.initial;
}

} // namespace

Measures measure(const Setting& setting, const State& state, const RigidBase& base, Events events) {
    assert(!base.surfaces.empty());
    const Chain& detachment = base.surfaces.front().chain;
    const double extension = state.clock.extension.m;
    const Profile profile = measure_profile(setting, state, base);
    Measures m;
    add_area(m, setting, state, base, profile);
    if (extension > 0.0 && setting.has_detachment) {
        m.cutoff = find_cutoff(state, standing_base(base, state).surfaces.front().chain);
        add_rotations(m, setting, state, detachment);
        add_prediction(m, setting, detachment, extension, profile);
        add_intervening_high(m, profile, 2.0 * state.mean_radius);
    }
    add_sediment(m, setting, state, profile);
    add_localisation(m, setting, state, events);
    if (setting.has_bonds) {
        m.basement_unbonded_fraction = unbonded_share_of_basement(state);
        m.broken = measure_broken_rock(state);
    }
    if (extension > 0.0 && setting.has_detachment &&
        !setting.motion.shortens(just_before(setting.motion, state.clock)))
        add_still_ground(m, setting, state);
    m.base = measure_base_forces(state, base);
    m.wall_wedge = measure_wall_wedge(setting, state, profile);
    add_conservation(m, state);
    add_quietness(m, setting, events);
    return m;
}

} // namespace listric::measures
