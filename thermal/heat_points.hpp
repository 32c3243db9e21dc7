#pragma once

#include "dem/base/target_line.hpp"
#include "dem/beds.hpp"
#include "dem/event.hpp"
#include "thermal/geotherm.hpp"
#include "thermal/ground_line.hpp"
#include "thermal/site_cells.hpp"

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace listric::thermal {

/// Pure shear of the rock below the detachment, with the extension: crust and mantle stretch from
/// the left end on.
struct PureShear {
    double left = 0.0;                            ///< x of the end that stays, m
    double crust_width = 0.0, mantle_width = 0.0; ///< before extension, m
    /// By which they stretch, of the extension: more than 1 where faults outside of the section
    /// take part.
    double share = 1.0;
};

/// What heat needs to know of a scene.
struct HeatSetting {
    GroundBeside beside = {};
    /// Of the start's temperatures.
    dem::TargetLine ground = dem::TargetLine(std::vector<dem::Point>{{0.0, 0.0}});
    double greatest_extension = 0.0;         ///< of the run, m
    std::optional<PureShear> shear = {};     ///< none: what is below the detachment rests
    std::vector<double> rock_densities = {}; ///< bulk: of rock without layer, then of layers
    double grain_density = 2600.0;           ///< of sediment, kg/m^3
    dem::PorosityLaw pores = {.surface_porosity = 0.5, .coefficient = 0.0}; ///< of sediment
    double crust_density = 2700.0, mantle_density = 3300.0; ///< of rock without discs, kg/m^3
};

/// The section that has temperatures: 150 km beyond what moves, which is three times as far as
/// heat diffuses in 100 million years.
SectionEnds section_ends(const HeatParameters& p, const HeatSetting& setting);

/// How many points a section takes, about. @param edge  length of base and wall, m
double estimated_points(const SectionEnds& ends, double edge, double mean_radius);

/// Points in the rock without discs, as a table: heat moves between them and the discs. They are
/// material, and move with it:
///  - up and down with the base's node above them,
///  - beside the right wall, above the detachment's depth, with the wall,
///  - below that depth in pure shear, where the scene has such.
/// A point that has become twice as wide becomes two. What leaves the section or is eroded beside
/// the hanging wall is taken away, what has room at its floor comes with the temperature there.
/// Memory: a row per point.
class HeatPoints : public dem::Event {
public:
    HeatPoints(const HeatParameters& p, const HeatSetting& setting, const dem::Schedule& schedule);

    /// Lays them out: spacing of 1.5 mean disc diameters at base and wall, growing by 6 % of the
    /// distance to at most 6 km; with the temperature of the steady column.
    bool start(dem::State& state, const dem::RigidBase& base) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    struct Columns {
        static constexpr const char *x = "x", *y = "y", *height = "height", *area = "area",
                                    *uplift = "uplift", *temperature = "temperature",
                                    *crust = "crust", *with_wall = "with_wall", *reach = "reach";
    };
    template <class T> std::span<const T> get(const char* column) const {
        return std::as_const(memory).get<T>(column);
    }
    std::span<double> temperature() { return memory.get<double>(Columns::temperature); }

    /// Gives the points the area of their cells at the start. @param first  number of the first
    void set_areas(std::span<const dem::PowerCell> cells, std::size_t first);

    /// Heat that came and went with points in the last application, J/m.
    double carried_in() const { return carried_in_; }
    double carried_out() const { return carried_out_; }

    /// See GroundBeside.
    void cover_by(std::function<Cover(double x)> cover) {
        setting_.beside.cover = std::move(cover);
    }

    const SectionEnds& ends() const { return ends_; }

private:
    void lay_out(const dem::State& state, const dem::RigidBase& base);
    void move(const dem::State& state, double depth, double before, double now, double way);
    void split(const dem::State& state);
    void drop(const dem::State& state, const dem::RigidBase& base);
    void fill_floor(const dem::State& state, double stretch);
    std::vector<double> lowest_rock(std::size_t columns, double width, std::size_t reach) const;
    struct Point;
    void add(const dem::State& state, const Point& point);

    HeatParameters p_;
    HeatSetting setting_;
    SectionEnds ends_;
    double carried_in_ = 0.0, carried_out_ = 0.0;
};

} // namespace listric::thermal
