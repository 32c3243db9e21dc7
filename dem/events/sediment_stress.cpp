#include "dem/events/sediment_stress.hpp"

#include "dem/base/rest.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/law.hpp"
#include "dem/numbers/units.hpp"
#include "dem/pushes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace listric::dem {

namespace {

constexpr double samples = 16.0;         ///< of a kind in a window, about
constexpr double just_after_event = 0.5; ///< m of travel
constexpr double least_cover = 0.5;      ///< of a layer by sediment discs; a packing covers 0.83

/// Middles of the eighths of an interval in the order of bits reversed, which covers it soon.
constexpr std::array phases{0.0625, 0.5625, 0.3125, 0.8125, 0.1875, 0.6875, 0.4375, 0.9375};

/// Number of compactions from sample to sample; 1 where there are none.
std::int64_t stride(double window, std::optional<double> compaction) {
    return compaction ? std::max<std::int64_t>(1, std::llround(window / samples / *compaction)) : 1;
}

/// A disc of the column, all that is needed of it.
struct ColumnDisc {
    std::size_t row;
    double share; ///< of its width that is in the column
};

std::vector<ColumnDisc> column_discs(const ConstDiscColumns& d) {
    std::vector<ColumnDisc> discs;
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double inside =
            std::min(d.x[i] + d.radius[i], column_to) - std::max(d.x[i] - d.radius[i], column_from);
        if (inside > 0.0)
            discs.push_back({i, std::min(inside / (2.0 * d.radius[i]), 1.0)});
    }
    return discs;
}

/// Mean height of the highest discs of cells one mean diameter wide, m.
double mean_surface(const ConstDiscColumns& d, std::span<const ColumnDisc> discs, double cell) {
    const auto cells = static_cast<std::size_t>(std::ceil((column_to - column_from) / cell));
    std::vector<double> top(cells, -std::numeric_limits<double>::infinity());
    for (const ColumnDisc& disc : discs) {
        const double place = (d.x[disc.row] - column_from) / cell;
        if (place >= 0.0 && place < static_cast<double>(cells)) {
            double& highest = top[static_cast<std::size_t>(place)];
            highest = std::max(highest, d.y[disc.row] + d.radius[disc.row]);
        }
    }
    double sum = 0.0, known = 0.0;
    for (const double height : top)
        if (std::isfinite(height)) {
            sum += height;
            known += 1.0;
        }
    return sum / known;
}

/// Vertical force of local damping, N.
double vertical_damping(double force, double departs, double damping) {
    return damped(force, departs, damping) - force;
}

} // namespace

std::vector<LayerLoad> layer_loads(const State& state, const RigidBase& base,
                                   const CyclePhysics& physics) {
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<ColumnDisc> discs = column_discs(d);
    if (discs.empty())
        return std::vector<LayerLoad>(layers);
    double reach = 0.0;
    std::vector<double> share(d.x.size(), 0.0);
    for (const ColumnDisc& disc : discs) {
        share[disc.row] = disc.share;
        reach = std::max(reach, d.radius[disc.row]);
    }
    const ContactForces contacts =
        contact_forces(state, base, {column_from - reach, column_to + reach});
    const std::vector<Point> net = net_forces(contacts, d.x.size());
    const bool relative = physics.averaging_time > 0.0 && !stops(base.motion, state.clock.travel);
    const auto mean_vy = relative ? state.discs.get(columns::mean_vy) : std::span<const float>();
    const double speed = base.motion.at(state.clock.time(), state.clock.travel).speed;
    const Stretching thins = stretching(base, state.clock.extension.m, speed);
    const auto undamped = [&](std::size_t i) { // as in the cycle, m/s
        return relative ? static_cast<double>(mean_vy[i]) : -thins.rate * (d.y[i] - thins.floor);
    };
    const double surface = mean_surface(d, discs, 2.0 * state.mean_radius);

    const Pushes pushes(state);
    std::vector<LayerLoad> loads(layers);
    for (std::size_t k = 0; k < loads.size(); ++k) {
        LayerLoad& load = loads[k];
        const double top = surface - (static_cast<double>(k) + 0.5) * layer_height;
        const auto below = [&](double y) {
            return std::clamp((y - top) / layer_height + 1.0, 0.0, 1.0);
        };
        double cover = 0.0; // m^2
        for (const auto& [i, part] : discs) {
            const double w = part * below(d.y[i]);
            const double weight = d.mass[i] * physics.gravity - pushes[i].y;
            load.weight += w * weight;
            load.damping +=
                w * vertical_damping(net[i].y - weight, d.vy[i] - undamped(i), physics.damping);
            if (d.stratum[i] > 0 && d.y[i] <= top && d.y[i] > top - layer_height)
                cover += part * pi * d.radius[i] * d.radius[i];
        }
        load.is_sediment = cover > least_cover * (column_to - column_from) * layer_height;
        for (const auto& [i, j, force] : contacts.pairs)
            load.contacts +=
                0.5 * (share[i] + share[j]) * force.y * (below(d.y[j]) - below(d.y[i]));
        for (const BaseForce& c : contacts.base)
            load.contacts += share[c.disc] * c.force.y * (below(d.y[c.disc]) - below(c.foot.y));
    }
    return loads;
}

SedimentStress::SedimentStress(double window, std::optional<double> compaction,
                               double extension_rate, const CyclePhysics& physics)
    : Observer("sediment_stress", Schedule::every(static_cast<double>(stride(window, compaction)) *
                                                      compaction.value_or(window / samples),
                                                  extension_rate)),
      window_(window), compaction_(compaction), physics_(physics) {
    memory.add<double>("window", "1", -1.0);
    for (const char* name : {"weight", "contacts", "damping", "weight_after", "contacts_after"})
        memory.add<double>(name, "N/m", 0.0);
    memory.resize(layers);
}

/// In every period first just after its first compaction, then in one interval of it.
Travel SedimentStress::next_due() const {
    const std::int64_t period = compaction_ ? applied / 2 : applied;
    const double phase = phases[static_cast<std::size_t>(period) % phases.size()];
    const double start = static_cast<double>(period) * schedule().spacing();
    if (!compaction_)
        return Travel(start + phase * schedule().spacing());
    if (is_after_event())
        return Travel(start + phase * std::min(just_after_event, *compaction_));
    const auto interval = static_cast<double>(period % stride(window_, compaction_));
    return Travel(start + (interval + phase) * *compaction_);
}

bool SedimentStress::apply(State& state, const RigidBase& base) {
    const auto window = memory.get<double>("window");
    const auto weight = memory.get<double>("weight"), contacts = memory.get<double>("contacts");
    const auto damping = memory.get<double>("damping");
    const auto weight_after = memory.get<double>("weight_after");
    const auto contacts_after = memory.get<double>("contacts_after");
    const double now = std::floor(state.clock.travel.m / window_);
    const std::vector<LayerLoad> loads = layer_loads(state, base, physics_);
    for (std::size_t k = 0; k < loads.size(); ++k) {
        if (window[k] != now) {
            window[k] = now;
            weight[k] = contacts[k] = damping[k] = weight_after[k] = contacts_after[k] = 0.0;
        }
        if (!loads[k].is_sediment)
            continue;
        if (is_after_event()) {
            weight_after[k] += loads[k].weight;
            contacts_after[k] += loads[k].contacts;
        } else {
            weight[k] += loads[k].weight;
            contacts[k] += loads[k].contacts;
            damping[k] += loads[k].damping;
        }
    }
    return false;
}

std::vector<LayerStress> SedimentStress::profile() const {
    const auto weight = memory.get<double>("weight"), contacts = memory.get<double>("contacts");
    const auto damping = memory.get<double>("damping");
    const auto weight_after = memory.get<double>("weight_after");
    const auto contacts_after = memory.get<double>("contacts_after");
    std::vector<LayerStress> profile;
    for (std::size_t k = 0; k < weight.size(); ++k) {
        if (weight[k] <= 0.0)
            continue;
        LayerStress layer{static_cast<double>(k + 1) * layer_height, contacts[k] / weight[k],
                          std::nullopt, damping[k] / weight[k]};
        if (weight_after[k] > 0.0)
            layer.after_event_ratio = contacts_after[k] / weight_after[k];
        profile.push_back(layer);
    }
    return profile;
}

} // namespace listric::dem
