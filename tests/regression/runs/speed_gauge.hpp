#pragma once

// An effect that the program does not have, described as its own are: what stands here and its line
// in effects_and_gauge() are all that there is of it.

#include "apps/model/effects.hpp"
#include "dem/event.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace listric {

struct SpeedGaugeParameters {
    double interval = 1000.0; ///< between looks, a
};

/// Remembers of each disc the greatest speed that it was seen at.
class SpeedGauge : public dem::Observer {
public:
    SpeedGauge(const SpeedGaugeParameters& parameters, double extension_rate)
        : Observer("speed_gauge", {parameters.interval, extension_rate}) {}

    void begin(dem::State& state) override {
        state.discs.add<double>("greatest_speed", "m/s", 0.0);
        memory.add<double>("extension", "m", 0.0); // a row per look
        memory.add<double>("greatest_speed", "m/s", 0.0);
    }

    bool apply(dem::State& state, const dem::RigidBase&) override {
        const dem::DiscColumns d = disc_columns(state);
        const auto greatest = state.discs.get<double>("greatest_speed");
        double now = 0.0;
        for (std::size_t i = 0; i < d.x.size(); ++i) {
            const double speed = std::hypot(d.vx[i], d.vy[i]);
            greatest[i] = std::max(greatest[i], speed);
            now = std::max(now, speed);
        }
        memory.resize(memory.rows() + 1);
        memory.get<double>("extension").back() = state.clock.extension.m;
        memory.get<double>("greatest_speed").back() = now;
        return false;
    }

    /// Greatest speed of all looks so far, m/s; 0 before the first.
    double greatest() const {
        double greatest = 0.0;
        if (memory.has("greatest_speed"))
            for (const double speed : memory.get<double>("greatest_speed"))
                greatest = std::max(greatest, speed);
        return greatest;
    }
};

inline const Effect& speed_gauge() {
    using P = SpeedGaugeParameters;
    static const Effect effect{
        .name = "speed_gauge",
        .doc = "remembers the greatest speed of each disc",
        .defaults = make_defaults<P>,
        .address = address_of<P>,
        .parameters =
            {
                {"interval_a", at<&P::interval>, "a", ranges::duration, "Delta t_g",
                 "time between looks at speeds"},
            },
        .add_events =
            [](const Scene& scene, const ModelParts&, dem::Events& events) {
                dem::add(events,
                         std::make_unique<SpeedGauge>(*scene.find<P>(), scene.extension.rate));
            },
        .explain =
            [](const Scene& scene, EffectList) {
                return fmt::format("speed gauge: looks every {:g} a\n", scene.find<P>()->interval);
            },
        .price =
            [](const Scene& scene, const Workload& work) {
                return work.applications(scene.find<P>()->interval) * work.discs;
            },
        .measures = {{"greatest_speed_m_per_s", "m/s", "greatest speed",
                      "greatest speed that a disc was seen at",
                      [](const Observation& now) -> std::optional<double> {
                          return dem::find<const SpeedGauge>(now.events)->greatest();
                      }}},
        .objects =
            {{"speed_gauge",
              "",
              "speed gauge",
              "what the gauge has done",
              {{"looks", "1", "looks", "at speeds"}},
              [](const Observation& now) -> std::optional<std::vector<NamedNumbers>> {
                  const auto& gauge = *dem::find<const SpeedGauge>(now.events);
                  return std::vector<NamedNumbers>{{{"looks", static_cast<double>(gauge.applied)}}};
              },
              false}},
        .layers =
            {
                {"fast_discs", LayerKind::discs, "greatest speed", "#8e24aa",
                 [](const Observation& now) {
                     const auto speeds = now.state.discs.get<double>("greatest_speed");
                     std::vector<double> shares(speeds.begin(), speeds.end());
                     for (double& share : shares)
                         share /= std::max(std::ranges::max(speeds), 1e-300);
                     return shares;
                 }},
                {"gauge_level", LayerKind::line, "level of the gauge", "#00695c",
                 [](const Observation& now) {
                     return std::vector<double>{0.0, -250.0, now.right_end(), -250.0};
                 }},
            },
    };
    return effect;
}

/// The program's effects and this one.
inline EffectList effects_and_gauge() {
    static const std::vector<const Effect*> list = [] {
        std::vector<const Effect*> all(program_effects().begin(), program_effects().end());
        all.push_back(&speed_gauge());
        return all;
    }();
    return list;
}

} // namespace listric
