#pragma once

#include "apps/scene/scene.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <string_view>
#include <variant>

namespace listric {

/// The numbers that a parameter may take, in the unit of its key: {.above = 0, .to = 10}.
struct Range {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    double from = -infinity, above = -infinity; ///< from: included; above: excluded
    double to = infinity, below = infinity;     ///< to: included; below: excluded
    std::string_view reason = {};               ///< why not elsewhere, where that is not plain

    bool contains(double x) const {
        return std::isfinite(x) && x >= from && x > above && x <= to && x < below;
    }
};

/// An enumeration or a string with few allowed values, seen as one of its names.
struct Choice {
    std::vector<std::string_view> names;
    std::function<std::string_view()> get;
    std::function<void(std::string_view)> set;
};

/// The variable behind a parameter.
using Variable = std::variant<double*, std::optional<double>*, int*, std::uint64_t*, std::string*,
                              Choice, std::vector<double>*, std::vector<dem::DetachmentSegment>*,
                              std::vector<dem::TargetStage>*, std::vector<fem::Layer>*>;

/// The one declaration of a parameter: reading, writing and the reference follow from it.
/// A default outside the range means that the parameter must be given.
struct Parameter {
    std::string_view key; ///< in the scene file, ends with the unit
    Variable variable;    ///< in SI units
    std::string_view unit;
    Range range;
    std::string_view symbol; ///< in the paper
    std::string_view doc;
    double per_si = 1.0; ///< units of the key in one SI unit
};

/// A table of the scene file, bound to the part of a scene that it describes.
struct SceneTable {
    std::string_view name;
    std::string_view doc;
    bool is_effect;
    bool in_scene;
    std::vector<Parameter> parameters;
    std::function<void()> drop; ///< takes the part out of the scene; empty if it cannot be missing
};

struct AccuracyLevel {
    std::string_view name;
    double mean_radius; ///< of the hanging wall's discs, m
    double cell_size;   ///< of an elastic base at the detachment, m
    double speed;       ///< of extension, m/s: unbalanced forces stay below 4e-3 of contact forces
};
std::span<const AccuracyLevel> accuracy_levels();

/// The parameters above the first table.
std::vector<Parameter> top_level(Scene& scene);

/// All tables that a scene can have. Parts that the scene lacks are put in with their defaults, so
/// that they can be read into, and have `in_scene` false: drop() them or keep them.
std::vector<SceneTable> scene_tables(Scene& scene);

/// The parameters of one arc or line of the detachment.
std::vector<Parameter> parameters(dem::DetachmentSegment& segment);

/// The parameters of one layer of the elastic base.
std::vector<Parameter> parameters(fem::Layer& layer);

/// Microproperties, [material]: of a scene's basement or of a material file.
std::vector<Parameter> parameters(dem::Material& material);

/// Strengths of contact bonds, [bonds].
std::vector<Parameter> parameters(dem::BondStrength& bonds);

/// "above 0, at most 10"; empty if every number is allowed.
std::string text(const Range& range);

/// The shortest text that reads back as the same number.
std::string text(double number);

/// "number", "integer", "string", "one of ..."
std::string type_of(const Parameter& parameter);

/// The candidate that a misspelt name most probably means, if any is close.
std::optional<std::string_view> nearest(std::string_view name,
                                        std::span<const std::string_view> candidates);

} // namespace listric
