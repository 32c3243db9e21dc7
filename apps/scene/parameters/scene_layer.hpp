#pragma once

#include "dem/material.hpp"
#include "dem/numbers/point.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// A layer of rock before extension, [[layer]].
struct SceneLayer {
    std::string name;
    std::optional<double> top, bottom, thickness;  ///< depths where they are level, m
    std::vector<dem::Point> top_line, bottom_line; ///< x, depth, m
    std::optional<double> density; ///< of the bulk, kg/m^3; none: the hanging wall's
    bool is_welded = true;

    /// Of water through it; none: it is impermeable.
    std::optional<double> permeability, permeability_ratio, porosity, compressibility;

    // Properties of its rock: of its material's file, where the table does not say them.
    std::optional<double> normal_stiffness, shear_stiffness, friction, rolling_friction;
    std::array<std::optional<double>, 4> strength = {}; ///< of bonds; none: it has no bonds
    dem::StrengthReading strength_is = dem::StrengthReading::stress;

    bool weakens = true; ///< by fault weakening
    /// As what; none: as the hanging wall does.
    std::optional<double> weakened_normal_stiffness, weakened_shear_stiffness, weakened_friction,
        weakened_rolling_friction;

    /// Places where its top or bottom may bend, by ascending x, m; none: it is level.
    std::vector<double> bends() const;
    double top_at(double x) const;    ///< depth, m
    double bottom_at(double x) const; ///< depth, m
};

/// The layers of a scene.
using SceneLayers = std::vector<SceneLayer>;

} // namespace listric
