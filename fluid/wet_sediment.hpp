#pragma once

#include "dem/base/ground_level.hpp"
#include "dem/base/target_line.hpp"
#include "dem/beds.hpp"
#include "dem/event.hpp"
#include "fluid/pore_law.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace listric::fluid {

/// Facts of sediment that the fluid needs, and of rock that it flows through.
struct WetSediment {
    double surface_porosity = 0.5;
    double porosity_decay = 4e-4;          ///< with depth, 1/m
    double grain_density = 2600.0;         ///< kg/m^3
    dem::Target surface{0.0};              ///< line that the ground is filled up and eroded down to
    dem::Schedule deposition = dem::never; ///< from stratum to stratum
    dem::Beds beds = {};                   ///< with pores of their own; none: as above
    std::vector<SedimentFlow> flows = {};  ///< by bed
    /// By layer of rock, the column `layer` from 1 on; none: it is impermeable.
    std::vector<std::optional<PorousRock>> rocks = {};

    dem::PorosityLaw pores_of(std::int32_t stratum) const {
        return beds.law(stratum, {surface_porosity, porosity_decay});
    }
    /// The rock of a layer if water flows through it, else null.
    const PorousRock* rock_of(std::uint8_t layer) const {
        return layer > 0 && layer <= rocks.size() && rocks[layer - 1u] ? &*rocks[layer - 1u]
                                                                       : nullptr;
    }
    bool has_rock() const {
        return std::ranges::any_of(rocks, [](const auto& rock) { return rock.has_value(); });
    }
};

/// The ground as the water feels it. Strata come in steps; sediment settles all the time. So what
/// the ground has sunk below the target line since the last stratum, and the next will fill, weighs
/// on the water at once, and what erosion will take does not: pressure then follows burial and does
/// not depend on the time from stratum to stratum.
class WetGround {
public:
    WetGround(const dem::State& state, const dem::Motion& motion, const WetSediment& sediment);

    /// Height that is to be laid down at a place, m; below 0: to be taken away.
    double pending(double x) const;

    const dem::GroundLevel& of_discs() const { return ground_; }

    /// Depth below the smooth ground of the discs and what is pending, m; negative above.
    double depth(dem::Point p) const { return ground_.depth(p) + pending(p.x); }

    /// The stratum that is to come.
    std::int32_t next_stratum() const { return next_; }

    /// Height of the grains above a place, m, from those of the discs above it.
    double grains(dem::Point p, double of_discs) const;

    /// Depth of the smooth ground below the line that sedimentation has filled it up to, in mean
    /// radii: .17 to .29 in a basin at draft and at standard, with strata every 2,500 and 10,000 a.
    static constexpr double left_free = 0.22;

private:
    dem::GroundLevel ground_;
    dem::TargetLine line_;
    std::int32_t next_;
    dem::SurfaceWork work_; ///< of the deposition that ends the present interval
    double left_free_;      ///< m
    double fresh_solid_;    ///< share of grains in what is laid down
};

} // namespace listric::fluid
