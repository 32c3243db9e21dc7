#pragma once

#include "apps/scene/parameters/accuracy.hpp"
#include "apps/scene/parameters/material_file.hpp"
#include "apps/scene/parameters/parameter.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/measure.hpp"
#include "dem/base/sediment_film.hpp"
#include "dem/base/target_line.hpp"
#include "dem/base/water_level.hpp"
#include "dem/beds.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/event.hpp"
#include "dem/genesis/genesis.hpp"
#include "dem/numbers/units.hpp"
#include "fluid/pore_law.hpp"

#include <any>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Description of an effect, in one object: everything that the program does with effects is a
// loop over such descriptions, so that no other place knows one by name.

namespace listric::coupling {
struct FootwallLoad;
}

namespace listric {

class BaseDriver;
struct BendingBase;

/// Refuses a scene because of the value at a path of keys ("table.key"). Throws SceneError.
using Refuse = std::function<void(const std::string& path, const std::string& message)>;

/// Whether a scene's file or call gives a value at a path of keys.
using IsGiven = std::function<bool(const std::string& path)>;

/// Why a scene cannot be, as Refuse takes it.
struct Objection {
    std::string path, message;
};

/// A parameter that names a file, which is read into what it stands for when the scene is loaded,
/// so that what a run writes stands alone.
struct FileParameter {
    std::string_view key;
    std::string_view doc, changes; ///< as those of a Parameter
    /// @param refuse  takes the parameter's path
    void (*read)(Scene& scene, const std::string& file, const Refuse& refuse);
    /// In its place for an effect of several tables. @param item  number of the table
    void (*read_item)(Scene& scene, std::size_t item, const std::string& file,
                      const Refuse& refuse) = nullptr;
    /// How the file is named: by its path; as a material, by name or path; or as that or "none",
    /// which is then what is read.
    enum Naming { path, material, material_or_none } naming = path;
};

/// A key that an effect had once. A scene that has it is refused, unless its value is what is done
/// now: that is passed over, so that older runs can be read and go on.
struct FormerKey {
    std::string_view key;
    std::string_view instead = {}; ///< "least_slip_m, the slip itself"
    std::string_view stays = {};   ///< the only word of the key that still has a meaning
};

/// A rock whose file, named in [materials], holds defaults of the effect's parameters.
struct RockSource {
    std::string_view key;          ///< in [materials]
    std::string_view file;         ///< default: name on the shelf of materials
    std::string_view doc, changes; ///< as those of a Parameter
    void (*take)(Scene& scene, const RockMaterial& rock);
    /// Why the effect cannot be on with that rock; none: it always can.
    std::string (*objection)(const RockMaterial& rock) = nullptr;
    /// Default of older versions, with which a run that one of them began goes on; none: `file`.
    std::string_view former = {};
    std::string_view plural = {};                  ///< for people, where the key says too little
    std::string (*remark)(const Scene&) = nullptr; ///< what matters most about the rock
};

/// The rock of sediment, for an effect that takes further defaults from its file.
constexpr RockSource rock_of_sediment(void (*take)(Scene& scene, const RockMaterial& rock)) {
    return {.key = "sediment", .file = "sediment", .doc = {}, .changes = {}, .take = take};
}

/// Sediment as effects describe it to each other and to measures.
struct SedimentFacts {
    double level = 0.0;                          ///< m, y up
    dem::Target surface{0.0};                    ///< line that the surface is adapted to
    double surface_porosity = 0.0;               ///< as deposited
    double grain_density = 0.0;                  ///< kg/m3
    double disc_density = 0.0;                   ///< as deposited, kg/m3
    std::optional<double> porosity_decay;        ///< with depth, 1/m; none: porosity stays
    double porosity_interval = 0.0;              ///< from change to change of porosity, a
    double deposition_interval = 0.0;            ///< from stratum to stratum, a
    fluid::SedimentFlow flow = {};               ///< of water through it
    dem::Beds beds = {};                         ///< with pores of their own
    std::vector<fluid::SedimentFlow> flows = {}; ///< by bed
};

/// Water in the pores of all discs, sediment and rock, as effects describe it to each other.
struct WaterFacts {
    dem::WaterLevel level = {};
    double density = 0.0; ///< kg/m^3
    bool moves = false;   ///< the level, in stages
};

/// Crust that stretches below the detachment, as effects describe it to each other.
struct StretchedCrust {
    double left, width; ///< before extension, m
};

/// A layer of rock as effects describe it to genesis and to measures.
struct LayerFacts {
    std::string name;
    std::uint8_t material = 0;                   ///< of its sound rock
    dem::RockLayer rock;                         ///< its place before extension
    std::optional<fluid::PorousRock> pores = {}; ///< that water flows through; none: impermeable
};

/// Parts that effects put into a model besides events: each adds its share in the order of the
/// list.
struct ModelParts {
    dem::RigidBase base;
    dem::CyclePhysics physics;
    double gravity = 0.0; ///< of the planet, m/s^2; discs in water weigh less: see physics
    std::vector<dem::Material> materials; ///< by MaterialIndex
    std::optional<dem::BondStrength> bonds;
    std::vector<LayerFacts> layers; ///< by the column `layer`, from 1
    std::optional<SedimentFacts> sediment;
    std::optional<dem::SedimentFilm> film; ///< none: what no disc stands for is not there
    std::optional<WaterFacts>
        water; ///< none: pores are empty, or what fills them weighs on no disc
    std::optional<StretchedCrust> stretched_crust; ///< none: what is below the detachment rests
    /// Depth of a temperature, degrees Celsius, in the rock before extension, m; none: it is not
    /// that hot. Null: rock has no temperatures.
    std::function<std::optional<double>(double temperature)> depth_of_temperature;
    double stretch_share = 1.0; ///< of the extension by which crust and mantle stretch there
    /// Sediment younger than this is too loose for a fault: it creeps all over, m of travel.
    double youngest_sediment = 2.0e3;
    /// Diameter of the circle that faults are looked for with, mean disc diameters; none: they are
    /// not looked for.
    std::optional<double> detection_circle;
    bool base_moves = false;      ///< the detachment deforms
    bool accounts_energy = false; ///< the cycle is the plain one, on one thread
};

/// A moment of a run, for what is measured and drawn of it.
struct Observation {
    const Scene& scene;
    const ModelParts& parts;
    const dem::State& state;
    std::span<const std::unique_ptr<dem::Event>> events;

    /// Place of the hanging wall's right end, m.
    double right_end() const {
        return scene.hanging_wall.length + dem::wall_way(parts.base, state.clock.extension.m);
    }
};

/// An object of summary.json, or a list of such objects.
struct MeasuredObjects {
    std::string_view name, unit, label, doc;
    std::vector<Quantity> parts = {}; ///< of an object; none: named by what is measured
    /// None: it has no meaning there.
    std::optional<std::vector<NamedNumbers>> (*value)(const Observation& now) = nullptr;
    bool is_list = true; ///< else the one object itself
};

/// A place where a well is worth a look.
struct WellPlace {
    std::string name;
    double x; ///< m
};

/// Numbers along vertical lines through a section.
struct MeasuredWell {
    std::vector<Quantity> parts = {}; ///< of a point
    std::vector<WellPlace> (*places)(const Observation& now) = nullptr;
    /// From the ground down; empty: there is nothing to measure.
    std::vector<NamedNumbers> (*numbers)(const Observation& now, double x) = nullptr;
    std::vector<dem::Point> (*points)(const Observation& now, double x) = nullptr; ///< their places
};

/// How a figure draws a layer.
enum class LayerKind {
    band, ///< an area behind the discs; rows x, bottom, top (m, y up)
    line, ///< over the discs; rows x, y (m, y up)
    discs ///< ink on the discs; a row per disc, the ink's share from 0 to 1
};

/// A velocity of discs, drawn as arrows over them: means of what lies close together.
struct LayerArrows {
    std::string_view label;                              ///< in legends
    std::vector<double> (*rows)(const Observation& now); ///< x and y by disc, m/s; empty: none yet
};

/// Layer that an effect adds to figures and the report.
struct FigureLayer {
    std::string_view name; ///< no other layer's
    LayerKind kind;
    std::string_view label;                              ///< in legends
    std::string_view ink;                                ///< "#rrggbb"
    std::vector<double> (*rows)(const Observation& now); ///< one after the other
    double full = 1.0; ///< number that full ink on discs stands for, where ink has shades
    std::optional<LayerArrows> arrows = {};
};

/// Factors of the prices in a prediction.
struct Workload {
    double discs = 0.0; ///< mean over the run
    double at_start = 0.0;
    double cycles = 0.0;
    dem::Calendar calendar = 1.0;
    dem::Travel travel = {}; ///< at the end
    double area_ratio = 0.0; ///< of the largest disc to the smallest

    /// How often something happens that does so in an interval, a.
    double applications(double interval,
                        dem::InSteps in_steps = dem::InSteps::as_travel_asks) const {
        return calendar.pauses().empty()
                   ? calendar.age(travel) / interval
                   : static_cast<double>(
                         dem::Schedule(interval, calendar, in_steps).nearest(travel));
    }
};

/// Where an effect's parameters are in the std::any that holds them.
struct PartAddress {
    const void* (*get)(const std::any& parameters);
    void* (*reach)(std::any& parameters);
};

/// Where the items of an effect of several tables, [[name]], are in the std::any that holds them.
struct ItemAddress {
    std::size_t (*count)(const std::any& parameters);
    const void* (*get)(const std::any& parameters, std::size_t item);
    void* (*reach)(std::any& parameters, std::size_t item);
    void (*append)(std::any& parameters); ///< one with defaults
};

/// Something that a model with a base that bends lacks.
struct Lack {
    std::string_view what = {};
    std::string_view size = {}; ///< what it does to the uplift of the flank, as measured
    bool (*is_there)(const ModelParts& parts) = nullptr; ///< in spite of all; null: it is not
};

struct Effect;
using EffectList = std::span<const Effect* const>;

/// An effect: a table of the scene file and all that follows from its being there. What is null
/// does not concern the effect.
struct Effect {
    std::string_view name; ///< of the table
    std::string_view doc;
    std::any (*defaults)(); ///< parameters; see make_defaults
    PartAddress address;
    std::vector<Parameter> parameters = {}; ///< of an item, where there are several
    std::optional<ItemAddress> items = {};  ///< none: one table; else a table [[name]] for each
    std::vector<FormerKey> former = {};     ///< see FormerKey
    std::vector<FileParameter> files = {};
    std::optional<RockSource> rock = {};
    std::vector<std::string_view> needs = {}; ///< tables that must be there, too
    bool brings_base = false; ///< a scene with it needs no detachment and no base that stretches
    bool fills_pores = false; ///< with water, those of all discs: see ModelParts
    /// Words for why its sediment gets lower where nothing shears: pictures of strain are without
    /// that strain, and say so.
    std::string_view settling = {};
    bool in_genesis = false; ///< the hanging wall before extension depends on it
    /// Sets to defaults what of its parameters the hanging wall does not depend on; null: on all.
    void (*as_in_genesis)(std::any& parameters) = nullptr;

    void (*scale)(Scene& scene, const AccuracyLevel& level) = nullptr; ///< defaults by accuracy
    /// Sets what follows from its parameters in other tables, once all are read.
    void (*complete)(Scene& scene, const IsGiven& is_given, const Refuse& refuse) = nullptr;
    void (*check)(const Scene& scene, const Refuse& refuse) = nullptr;
    /// Oddity of a scene that is allowed all the same; empty: none.
    std::string (*warning)(const Scene& scene) = nullptr;
    /// Why several processes cannot make it; none: they can.
    std::optional<Objection> (*on_ranks)(const Scene& scene) = nullptr;

    void (*contribute)(const Scene& scene, ModelParts& parts) = nullptr;
    /// Adds the effect's events to those of the effects before.
    void (*add_events)(const Scene& scene, const ModelParts& parts, dem::Events& events) = nullptr;
    /// It needs a base that bends.
    coupling::FootwallLoad (*load_footwall)(const Scene& scene, const ModelParts& parts) = nullptr;
    /// The same of an effect that does not need one, where there is one.
    /// @param events  of the run; none where only its states are looked at
    std::vector<coupling::FootwallLoad> (*load_bending_base)(
        const Scene& scene, const ModelParts& parts,
        std::span<const std::unique_ptr<dem::Event>> events) = nullptr;
    /// The base, of the effect that bends it.
    const BendingBase& (*bending_base)(const std::any& parameters) = nullptr;
    /// Moves the base's nodes; of a scene's effects at most one does.
    /// @param events  of the run; none where only its states are looked at
    /// @param loads   to which the events of the loads on the base are appended, for the run to
    ///                apply
    std::unique_ptr<BaseDriver> (*drive_base)(const Scene& scene, const ModelParts& parts,
                                              std::span<const std::unique_ptr<dem::Event>> events,
                                              std::vector<std::unique_ptr<dem::Event>>& loads) =
        nullptr;

    /// Lines for `explain`. @param list  all effects that there are
    std::string (*explain)(const Scene& scene, EffectList list) = nullptr;
    Lack absence = {};            ///< of a model without it, where the base bends; none: no text
    std::vector<Lack> lacks = {}; ///< of a model with it, likewise

    /// Time that it takes, disc-steps of the bare cycle.
    double (*price)(const Scene& scene, const Workload& work) = nullptr;
    /// Memory that it takes beside the discs, bytes.
    double (*memory)(const Scene& scene) = nullptr;
    /// Area that comes as discs, m^2 of the packing at the start.
    double (*new_area)(const Scene& scene) = nullptr;

    /// Columns of history.csv and numbers of summary.json. One without a function is taken
    /// elsewhere: by the loads on the footwall, in the order in which they stand here, or by the
    /// run.
    std::vector<Measure<Observation>> measures = {};
    std::vector<MeasuredObjects> objects = {};
    std::vector<FigureLayer> layers = {};
    std::optional<MeasuredWell> well = {};
};

/// Whether the effect of that name is on.
bool has_effect(const Scene& scene, std::string_view name);

/// The base of a scene; null where it does not bend.
const BendingBase* bending_base(const Scene& scene);

/// The effect that bends the base.
const Effect& base_bender(EffectList effects);

/// The effect that fills the pores of all discs with water.
const Effect& pore_filler(EffectList effects);

/// Tables that must be there, too, where an effect is on.
std::vector<std::string_view> needed_tables(const Effect& effect, EffectList effects);

/// Names of the effects that are on.
std::vector<std::string> effect_names(const Scene& scene);

/// Words for what pictures of a scene's strain are without; empty: nothing.
std::string settling_of(const Scene& scene);

/// Layers of the effects that are on.
std::vector<FigureLayer> figure_layers(const Scene& scene);

/// Wells of the effects that are on and have some.
std::vector<const MeasuredWell*> measured_wells(const Scene& scene);

/// Default parameters of a type, and where an object of it is in a std::any.
template <class Parameters> std::any make_defaults() { return Parameters{}; }
template <class Parameters>
constexpr PartAddress address_of{
    [](const std::any& parameters) -> const void* {
        return std::any_cast<Parameters>(&parameters);
    },
    [](std::any& parameters) -> void* { return std::any_cast<Parameters>(&parameters); }};

/// Where the items are in a std::any that holds a std::vector of them.
template <class Item>
constexpr ItemAddress items_of{
    [](const std::any& parameters) {
        return std::any_cast<const std::vector<Item>&>(parameters).size();
    },
    [](const std::any& parameters, std::size_t item) -> const void* {
        return &std::any_cast<const std::vector<Item>&>(parameters)[item];
    },
    [](std::any& parameters, std::size_t item) -> void* {
        return &std::any_cast<std::vector<Item>&>(parameters)[item];
    },
    [](std::any& parameters) { std::any_cast<std::vector<Item>&>(parameters).emplace_back(); }};

/// Parameters of an effect as they are by default: of one item, where there are several.
inline std::any defaults_of(const Effect& effect) {
    std::any parameters = effect.defaults();
    if (effect.items)
        effect.items->append(parameters);
    return parameters;
}

/// The object that the effect's parameters belong to: the first item, where there are several.
inline void* object_of(const Effect& effect, std::any& parameters) {
    return effect.items ? effect.items->reach(parameters, 0) : effect.address.reach(parameters);
}

} // namespace listric
