#pragma once

#include "apps/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace listric {

/// How the values of several parameters are combined.
enum class SweepDesign {
    grid,           ///< every value with every other
    list,           ///< the first values of all, the second of all, ...
    latin_hypercube ///< samples in which every parameter takes each part of its range once
};

/// A value of a parameter.
struct SweepValue {
    std::string text;                 ///< in tables
    std::vector<std::string> changes; ///< of a scene, "table.key=value"
    std::optional<double> number;     ///< if it is one
};

/// A parameter that varies.
struct SweepParameter {
    std::string name; ///< table.key, or a word of the plan's for values that are several changes
    std::vector<SweepValue> values = {};            ///< or else
    std::optional<std::pair<double, double>> range; ///< least and greatest
};

/// A measure of every run.
struct SweepMeasure {
    std::string text;         ///< as the plan has it: NAME or NAME@METRES
    std::string name;         ///< of docs/reference/measures.md
    std::optional<double> at; ///< extension, m; none: the run's end
};

struct SweepPlan {
    std::string name; ///< of its file
    std::string scene, accuracy;
    std::vector<std::string> set, without; ///< for every run
    int first_seed = 1, seeds = 1;         ///< of every point
    bool own_seeds = false; ///< each point goes on with the seeds behind the last one's
    SweepDesign design = SweepDesign::grid;
    int samples = 0; ///< of a Latin hypercube
    std::vector<SweepParameter> parameters;
    std::vector<SweepMeasure> measures;
    bool makes_dataset = false; ///< it has [dataset], which looks at the faults of all windows

    /// Whether something is of a moment before the end, for which all snapshots are read.
    bool needs_moments() const;
};

/// The file of a plan, by its path or, of a shipped one, its name. Throws SceneError.
std::filesystem::path plan_file(const std::filesystem::path& name_or_path);

/// Reads a plan and tries every value in the scene, of a list every point. Throws SceneError.
SweepPlan load_sweep_plan(const std::filesystem::path& name_or_path);

/// The values of every run, seeds apart, in the order of the parameters.
using SweepPoint = std::vector<SweepValue>;
std::vector<SweepPoint> sweep_points(const SweepPlan& plan);

/// "run 3, material.friction=0.5": point k, from 0; `seed` stands behind its number.
std::string name_of_point(const SweepPlan& plan, std::size_t k, const SweepPoint& point,
                          std::string_view seed = "");

/// Tries points: values may each make a scene alone, but none together. Throws SceneError with the
/// point and the plan's file. Returns the scenes' warnings, each with the first point that has it.
std::vector<std::string> check_points(const SweepPlan& plan, std::span<const SweepPoint> points,
                                      const std::filesystem::path& file);

/// The scene of a point. Throws SceneError.
Scene scene_at(const SweepPlan& plan, const SweepPoint& point, std::int64_t seed);

/// JSON schema of a plan's file.
std::string sweep_schema();

} // namespace listric
