#pragma once

#include "dem/base.hpp"
#include "dem/base/target_line.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/state.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace listric::dem {

/// The hanging wall before extension [paper, Table 1].
struct HangingWallParameters {
    double length = 40e3;         ///< from the breakaway to the moving wall, m
    double thickness = 15e3;      ///< greatest thickness = depth to the flat detachment, m
    double mean_radius = 93.1;    ///< mean disc radius, m
    double radius_ratio = 1.66;   ///< largest over smallest radius
    double porosity = 0.175;      ///< of the closed packing before gravity is applied
    double rock_density = 2600.0; ///< bulk density of the packing, kg/m^3
    /// Ground before extension: x and depth, m; none: it slopes, or is level.
    std::vector<Point> ground = {};
    double ground_slope = 0.0;      ///< degrees; above 0 it falls to the right, below 0 to the left
    double ground_slope_from = 0.0; ///< x of the point from which it falls, m

    bool has_ground() const { return !ground.empty() || ground_slope != 0.0; }
};

/// The ground before extension: y over x.
TargetLine ground_of(const HangingWallParameters& p);

/// Share of its height that rock between fixed sides loses under a weight per area, Pa; also the
/// mean overlap of its discs over their radius. A packing's modulus of confined compression is some
/// 0.6 of a contact's stiffness: overlaps of 0.72 % at the floor of 15 km of the shipped rock, 2.8
/// % with a quarter of its stiffness.
double compression_at_depth(const Material& rock, double weight);

/// Area between ground, detachment and right wall, m^2.
double hanging_wall_area(const HangingWallParameters& p, const Chain& detachment);

/// Number of discs that fill an area, m^2, at the parameters' porosity.
std::size_t disc_count(const HangingWallParameters& p, double area);

/// Largest stable time step, s, of discs of any of the materials whose inertial mass is `mass`, kg.
double stable_time_step(double mass, std::span<const Material> materials, double damping,
                        double safety);

/// A layer of rock in the hanging wall: what lies between two lines before extension. A line at or
/// above the original surface bounds nothing.
struct RockLayer {
    TargetLine top, bottom; ///< y over x, m; y up
    std::uint8_t material = basement;
    double density = 2600.0; ///< bulk density of the packing, kg/m^3

    bool contains(Point p) const {
        const double upper = top.height(p.x);
        return p.y > bottom.height(p.x) && (p.y <= upper || upper >= 0.0);
    }
};

/// Inputs of genesis besides the hanging wall itself.
struct GenesisRequest {
    HangingWallParameters hanging_wall;
    RigidBase base; ///< surfaces as in the run; the last one closes the right side
    std::vector<Material> materials;
    std::optional<BondStrength> bonds;
    std::vector<RockLayer> layers = {}; ///< the first one has what several contain
    /// Density of the discs that will be laid down, kg/m^3; without a mass floor they may be the
    /// lightest, which set the time step.
    std::optional<double> sediment_density = {};
    CyclePhysics physics;
    double time_step_safety = 0.95;
    double inertial_mass_floor = 0.75; ///< mean basement disc masses
    double skin = 0.25;                ///< mean radii
    std::uint64_t seed = 1;
    Execution execution = {};
};

/// Makes a settled, bonded hanging wall [paper, Fig. 2b]: random small discs in its shape, expanded
/// under a lid to the wanted porosity, frictionless equilibrium, gravity without the lid,
/// equilibrium, floaters grown until they carry load, the surface trimmed to its level, bonds at
/// every contact that may be bonded. Where the ground slopes, discs have friction from the trim on,
/// so that the slope stands.
///
/// With layers, discs have a column `layer`: 0 for rock of none, n for the n-th. Discs are of a
/// layer by their centre where the trimmed packing has come to rest. Soft layers are made of stiff
/// rock first, and then enlarged, as weakened discs are, until the packing rests again with their
/// volume as it was. `report(stage, share done)` is called now and then.
State make_hanging_wall(const GenesisRequest& request,
                        const std::function<void(std::string_view, double)>& report);

} // namespace listric::dem
