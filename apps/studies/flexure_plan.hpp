#pragma once

#include "apps/model/bending_base.hpp"
#include "apps/scene/scene_file.hpp"
#include "dem/numbers/units.hpp"

#include <filesystem>
#include <string>

namespace listric {

struct RunOptions;

enum class FlexureLoad { line, broken, strip, sinusoid };

/// A load on the base alone. Loads are positive downward.
struct FlexureParameters {
    FlexureLoad load = FlexureLoad::line;
    double line_load = 1e12;   ///< V, N/m; a broken plate has V/2 at its end
    double pressure = 5e7;     ///< of the strip; amplitude of the sinusoid, Pa
    double half_width = 10e3;  ///< of the strip, m
    double wavelength = 200e3; ///< of the sinusoid, m
};

/// A base that bends under a load, without discs.
struct FlexurePlan : Heading {
    FlexureParameters flexure;
    double gravity = dem::standard_gravity; ///< m/s^2
    EffectPart
        base; ///< the effect that bends the base; of its parameters those of BendingBase count
    std::filesystem::path file;

    const BendingBase& bending() const { return base.effect->bending_base(base.parameters); }
};

/// The file that a call means by the name of a scene, or of the plan that the program ships.
/// Throws SceneError.
std::filesystem::path find_scene_or_plan(const std::string& name_or_path);

/// Whether that file is a plan of flexure; no, too, where it cannot be read.
bool is_flexure_plan(const std::string& name_or_path);

/// Reads, merges and checks a plan, as load_scene() does. Throws SceneError.
FlexurePlan load_flexure_plan(const SceneRequest& request);

/// All parameters in force as TOML that load_flexure_plan() reads back to the same plan.
std::string to_toml(const FlexurePlan& plan);

/// Parameters of [flexure].
const std::vector<Parameter>& flexure_parameters();

/// Their reference, as parameter_reference() has it.
std::string flexure_reference();

/// JSON schema of its file.
std::string flexure_schema();

/// Bends the base of a plan and leaves summary.json, deflection.csv, footwall.pvd (displacement and
/// stress for ParaView) and figures/flexure.png in the output folder. Throws UsageError where no
/// footwall can be made, StorageError.
void run_flexure(const FlexurePlan& plan, const RunOptions& options);

/// The plate and its load, as text.
std::string explain(const FlexurePlan& plan);

} // namespace listric
