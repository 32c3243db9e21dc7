#pragma once

#include "dem/base/target_line.hpp"
#include "dem/beds.hpp"
#include "dem/calendar.hpp"
#include "dem/clocks.hpp"
#include "dem/motion.hpp"

#include <optional>
#include <string>
#include <vector>

namespace listric::measures {

/// Sediment that comes and goes at the surface.
struct Sediment {
    dem::Target target{0.0};              ///< line that the surface is adapted to
    double surface_porosity = 0.0;        ///< as deposited
    double disc_density = 0.0;            ///< as deposited, kg/m3
    std::optional<double> porosity_decay; ///< with depth, 1/m; none: porosity stays
    dem::Beds beds = {};                  ///< with pores of their own

    dem::PorosityLaw pores_of(std::int32_t stratum) const {
        return beds.law(stratum, {surface_porosity, porosity_decay.value_or(0.0)});
    }
};

/// A top or bottom of a layer of rock before extension.
struct LayerBoundary {
    std::string name; ///< "layer mica", "base of layer mica"
    dem::TargetLine line;
};

/// Facts of a run that measures need beside its states.
struct Setting {
    double length = 0.0;         ///< of the hanging wall at the start, m
    double thickness = 0.0;      ///< of the hanging wall, m
    bool has_detachment = false; ///< else the hanging wall is a box that stretches
    bool has_bonds = false;      ///< contacts of rock can be bonded
    double gravity = 0.0;        ///< m/s^2; 0: none
    dem::Calendar calendar = 0.01;
    double extension_speed = 1.0; ///< in the model, m/s
    double output_interval = 0.0; ///< travel between states that are kept, m
    dem::Motion motion = {};      ///< of the wall
    /// Sediment younger than this is too loose for a fault: it creeps all over. Of travel at the
    /// rate of extension.
    dem::Travel youngest_sediment = {};
    /// Diameter of the circle that fault detection (AFD) measures with, mean disc diameters; none:
    /// faults are not looked for and do not weaken.
    std::optional<double> detection_circle = {};
    std::optional<Sediment> sediment = {}; ///< none: nothing is deposited
    /// Tops and bottoms of layers of rock before extension, from the highest down.
    std::vector<LayerBoundary> boundaries = {};

    /// Travel in which what is too loose at a moment was laid down.
    dem::Travel way_of_loose_sediment(dem::Travel now) const {
        return calendar.pauses().empty()
                   ? youngest_sediment
                   : calendar.way_back(now, youngest_sediment.m / calendar.rate());
    }

    /// Whether strain between states is of a whole window, by the wall's way between them: an extra
    /// state of a run that was stopped is too near to the one before, and one of a pause adds none.
    bool is_window(dem::Travel from, dem::Travel to) const {
        return motion.way(from, to).m >= 0.75 * output_interval;
    }
};

} // namespace listric::measures
