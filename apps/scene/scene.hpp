#pragma once

#include "apps/scene/picks/observed.hpp"
#include "apps/scene/picks/picked_fault.hpp"
#include "dem/calendar.hpp"
#include "dem/genesis/detachment.hpp"
#include "dem/genesis/genesis.hpp"
#include "dem/material.hpp"

#include <any>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace listric {

struct AccuracyLevel;
struct Effect;

/// Motion of base and right wall.
struct ExtensionParameters {
    double distance = 10e3;     ///< total extension, m
    double rate = 0.01;         ///< geological extension rate, m/a
    double speed = 1.0;         ///< speed in the model, metres per model second
    double ramp = 24.0;         ///< model time over which the speed grows from rest, s
    double wall_friction = 0.0; ///< between discs and the walls
};

/// Parameters of the cycle.
struct CycleParameters {
    double damping = 0.7;              ///< local non-viscous damping coefficient
    double averaging_time = 150.0;     ///< of the motion that is not damped, model s; 0: none
    double time_step_safety = 0.95;    ///< time step over the stability limit
    double inertial_mass_floor = 0.75; ///< least inertial mass, mean basement disc masses
    double skin = 0.25;                ///< neighbour-list margin, mean radii
    double softness = 1.0;             ///< divides the discs' stiffnesses, but of soft rock
};

enum class SeriesFormat { paraview, none };

struct OutputParameters {
    double interval = 500.0;                   ///< extension between snapshots, m
    std::vector<double> figures = {5e3, 10e3}; ///< extensions at which figures are drawn, m
    SeriesFormat series = SeriesFormat::paraview;
    bool report = true; ///< report.html is written
};

/// An effect that is on, and its parameters: an object of the type that its description is for.
struct EffectPart {
    const Effect* effect;
    std::any parameters;
};

/// Values above the tables of a file.
struct Heading {
    std::string name;
    std::string description;
    std::string accuracy = "standard";
    std::uint64_t seed = 1;
};

/// Everything that determines a simulation. An effect is on exactly when it is listed.
struct Scene : Heading {
    dem::HangingWallParameters hanging_wall;
    std::optional<dem::DetachmentParameters> detachment;
    std::optional<PickedFault> picked_fault;
    std::optional<dem::StretchingParameters> stretching;
    std::optional<Observed> observed;
    ExtensionParameters extension;
    dem::Material basement; ///< table [material]
    CycleParameters cycle;
    OutputParameters output;

    std::vector<EffectPart> effects; ///< in the order of the program's list

    std::vector<std::string> warnings;        ///< oddities of its files; no part of the run
    std::vector<std::filesystem::path> files; ///< that were read for it; none of them may be lost
    std::map<std::string, std::filesystem::path, std::less<>>
        rocks; ///< files by key of [materials], and of layers by path, "layer[0].material"

    /// The parameters of an effect, by their type; null where it is off.
    template <class Parameters> const Parameters* find() const {
        return find_in<const Parameters>(effects);
    }
    template <class Parameters> Parameters* find() { return find_in<Parameters>(effects); }

private:
    template <class Parameters> static Parameters* find_in(auto& parts) {
        for (auto& part : parts)
            if (auto* found = std::any_cast<Parameters>(&part.parameters))
                return found;
        return nullptr;
    }
};

/// Gives a scene the level's resolution, speed and softness; its effects keep theirs.
void set_level(Scene& scene, const AccuracyLevel& level);

/// The scene at another level; it keeps a speed, slow start or softness that is not its own
/// level's.
Scene at_level(const Scene& scene, const AccuracyLevel& level);

/// Whether a scene wants pictures at this extension (m), to half a window.
bool is_drawn_at(const Scene& scene, double extension);

/// Age over travel: all that a scene does or tells by years goes by it.
dem::Calendar make_calendar(const Scene& scene);

/// Years of a scene from start to end.
double end_age(const Scene& scene);

/// Detachment or flat base, backstop or left wall, and right wall, where nothing deforms.
dem::RigidBase make_rigid_base(const Scene& scene);

/// Friction of the detachment or of the flat base.
double base_friction(const Scene& scene);

/// Area between the base and the original surface, up to the moving wall, m^2; 0 without a base.
double hanging_wall_area(const Scene& scene);

/// Number of discs that fill the hanging wall, from its area, porosity and disc sizes.
std::size_t estimated_discs(const Scene& scene);

} // namespace listric
