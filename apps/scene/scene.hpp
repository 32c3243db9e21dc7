#pragma once

#include "apps/support/error.hpp"
#include "coupling/basin_water.hpp"
#include "coupling/elastic_base.hpp"
#include "coupling/footwall_erosion.hpp"
#include "coupling/lower_crust_thinning.hpp"
#include "dem/base_motion.hpp"
#include "dem/detachment.hpp"
#include "dem/events/bond_healing.hpp"
#include "dem/events/compaction.hpp"
#include "dem/events/energy_account.hpp"
#include "dem/events/fault_weakening.hpp"
#include "dem/events/sedimentation.hpp"
#include "dem/genesis.hpp"
#include "dem/material.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace listric {

/// Motion of base and right wall.
struct ExtensionParameters {
    double distance = 10e3; ///< total extension, m
    double rate = 0.01;     ///< geological extension rate, m/a
    double speed = 1.0;     ///< speed in the model, metres per model second
    double ramp = 24.0;     ///< model time over which the speed grows from rest, s
};

/// Parameters of the cycle.
struct CycleParameters {
    double damping = 0.7;              ///< local non-viscous damping coefficient
    double time_step_safety = 0.95;    ///< time step over the stability limit
    double inertial_mass_floor = 0.75; ///< least inertial mass, mean basement disc masses
    double skin = 0.25;                ///< neighbour-list margin, mean radii
};

struct GravityParameters {
    double acceleration = 9.81; ///< m/s^2
};

/// Footwall and basement that bend and float.
struct ElasticBaseParameters {
    double elastic_thickness = 10e3; ///< effective elastic thickness Te, m
    double young_modulus = 70e9;     ///< Pa
    double poisson_ratio = 0.25;
    double crust_density = 2700.0;  ///< kg/m^3
    double mantle_density = 3300.0; ///< kg/m^3
    double infill_density = 0.0;    ///< of what fills the deflection, kg/m^3
    int cells = 8;                  ///< elements through the elastic thickness, without discs
    int degree = 2;                 ///< of the elements

    // Under discs.
    double left = -300e3, right = 350e3; ///< x of the far sides, m
    double depth = 30e3;                 ///< of the base's lower boundary, m
    double relaxation = 100.0;           ///< shear modulus over that below the elastic thickness
    double skin_thickness = 3e3;         ///< rock along the detachment that is not relaxed, m
    double cell_size = 1000.0;           ///< elements at the detachment, m
    std::vector<fem::Layer> layers;      ///< rock by depth; none: one of the values above
    std::string mesh_file;               ///< Gmsh .msh instead of elements made from the scene
    fem::Side left_side = fem::Side::roller, right_side = fem::Side::roller;
    fem::Solver solver = fem::Solver::mumps;
    int refinements = 0; ///< times that all elements are halved
    coupling::CouplingScheme scheme = coupling::CouplingScheme::modal;
    int update_interval = 5;       ///< cycles
    int modes = 100;               ///< 0: all
    double mass_factor = 0.6;      ///< of the modes
    double swing_damping = 0.1;    ///< of the modes with the discs, over critical
    bool relative_damping = true;  ///< of the discs, against their mean motion
    double averaging_time = 150.0; ///< of that mean, model s
};

enum class FlexureLoad { line, broken, strip, sinusoid };

/// A load on the elastic base alone: no discs. Loads are positive downward.
struct FlexureParameters {
    FlexureLoad load = FlexureLoad::line;
    double line_load = 1e12;   ///< V, N/m; a broken plate has V/2 at its end
    double pressure = 5e7;     ///< of the strip; amplitude of the sinusoid, Pa
    double half_width = 10e3;  ///< of the strip, m
    double wavelength = 200e3; ///< of the sinusoid, m
};

enum class SeriesFormat { paraview, none };

struct OutputParameters {
    double interval = 500.0;                   ///< extension between snapshots, m
    std::vector<double> figures = {5e3, 10e3}; ///< extensions at which figures are drawn, m
    SeriesFormat series = SeriesFormat::paraview;
};

/// Everything that determines a simulation. An effect is on exactly when its table is there.
struct Scene {
    std::string name;
    std::string description;
    std::string accuracy = "standard";
    std::uint64_t seed = 1;

    std::optional<dem::HangingWallParameters> hanging_wall;
    std::optional<dem::DetachmentParameters> detachment;
    std::optional<dem::StretchingParameters> stretching;
    ExtensionParameters extension;
    dem::Material basement; ///< table [material]
    CycleParameters cycle;
    OutputParameters output;

    std::optional<GravityParameters> gravity;
    std::optional<dem::BondStrength> bonds;
    std::optional<dem::FaultWeakeningParameters> fault_weakening;
    std::optional<dem::BondHealingParameters> bond_healing;
    std::optional<dem::SedimentationParameters> sedimentation;
    std::optional<dem::CompactionParameters> compaction;
    std::optional<dem::EnergyParameters> energy;
    std::optional<ElasticBaseParameters> elastic_base;
    std::optional<coupling::LowerCrustThinningParameters> lower_crust_thinning;
    std::optional<coupling::BasinWaterParameters> basin_water;
    std::optional<coupling::FootwallErosionParameters> footwall_erosion;
    std::optional<dem::BaseMotionParameters> base_motion;
    std::optional<FlexureParameters> flexure;

    /// Parameters of [sedimentation], [footwall_erosion] and [base_motion]; load_scene reads the
    /// files into what they stand for and empties the names, so that what a run writes stands
    /// alone.
    std::string target_csv, footwall_target_csv, base_motion_csv;
};

/// How a call modifies a scene.
struct SceneRequest {
    std::string scene = {};                   ///< name in the scenes folder, or a path
    std::vector<std::string> set = {};        ///< "table.key=value"
    std::vector<std::string> without = {};    ///< tables to drop
    std::optional<std::string> accuracy = {}; ///< draft, standard, fine, sandbox
    std::optional<std::int64_t> seed = {};
};

/// Reads, merges (default < accuracy level < scene file < set) and checks a scene. Its name is the
/// file's without folder and ending. Throws SceneError.
Scene load_scene(const SceneRequest& request);

/// All parameters in force as TOML that load_scene reads back to the same scene.
std::string to_toml(const Scene& scene);

/// Reference of every parameter: table, key, type, default, unit, range, symbol, doc.
std::string parameter_reference();

/// Materials of a scene, by MaterialIndex.
std::vector<dem::Material> make_materials(const Scene& scene);

/// Detachment, backstop above the breakaway and right wall of a scene.
dem::RigidBase make_base(const Scene& scene);

/// Area between the base and the original surface, up to the moving wall, m^2.
double hanging_wall_area(const Scene& scene);

/// Number of discs that fill the hanging wall, from its area, porosity and disc sizes.
std::size_t estimated_discs(const Scene& scene);

/// Scenes shipped with the program (or in the folder LISTRIC_SCENES): name and description, sorted
/// by name.
std::vector<std::pair<std::string, std::string>> list_scenes();

} // namespace listric
