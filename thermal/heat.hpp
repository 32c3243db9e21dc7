#pragma once

#include "thermal/conduction.hpp"
#include "thermal/geotherm.hpp"
#include "thermal/heat_points.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace listric::thermal {

/// What conducts heat: the discs by row, then the points.
struct HeatCells {
    Sites sites;
    std::vector<bool> is_new;                 ///< came since the last solution
    std::vector<double> conductivity;         ///< W/m/K
    std::vector<double> density;              ///< of rock, or of sediment's grains, kg/m^3 of cell
    std::vector<double> capacity, production; ///< J/m/K; W/m
    std::vector<double> temperature;          ///< degrees Celsius
};

/// Temperature of discs and rock through geological time, and the maturity of sediment.
///
/// Discs and points carry their temperature along, so there is no term of advection and no
/// numerical diffusion; heat flows between neighbours of whatever motion (HeatNetwork). Sediment
/// comes with the ground's temperature; what is eroded, and the water that compaction expels, takes
/// its heat along.
///
/// Columns of discs: `temperature`, `max_temperature`, `heat_capacity`, `vitrinite` and, of the
/// reactions behind it, `kerogen_1` on. Memory: one row, see Sums.
class Heat : public dem::Event {
public:
    /// @param points  lives as long, and is applied just before
    Heat(const HeatParameters& p, const HeatSetting& setting, HeatPoints& points,
         const dem::Schedule& schedule);

    void begin(dem::State& state) override;
    bool start(dem::State& state, const dem::RigidBase& base) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    /// Heat over that at 0 degrees, J/m: at the start and now; that came with sediment and new
    /// points; went with eroded discs, expelled water and points; was produced; came through the
    /// floor; and left through the ground.
    struct Sums {
        static constexpr const char *initial = "initial", *stored = "stored", *discs = "in_discs",
                                    *came = "came", *eroded = "eroded", *expelled = "expelled",
                                    *rose = "rose", *sank = "sank", *produced = "produced",
                                    *floor = "floor", *ground = "ground";
    };
    double remembered(std::string_view name) const { return memory.get<double>(name)[0]; }
    /// What is missing in that balance, over the sum of its terms.
    double balance_error() const;

    /// Tells heat and its points what comes and goes beside the hanging wall; see GroundBeside.
    void cover_by(const std::function<Cover(double x)>& cover) {
        setting_.beside.cover = cover;
        points_.cover_by(cover);
    }

    const HeatParameters& parameters() const { return p_; }
    const HeatSetting& setting() const { return setting_; }
    const Geotherm& geotherm() const { return geotherm_; }
    const SectionEnds& ends() const { return points_.ends(); }

    /// All that conducts now.
    HeatCells cells(const dem::State& state) const;

    /// The ground of the last solution, below the sediment that has come since.
    GroundLine solved_ground(const dem::State& state, const dem::RigidBase& base) const;

    /// Resistance of sediment that no disc stands for between cells and a ground, by cell, m^2 K/W:
    /// of the film, and by how much more than rock's is that of what lies on rock without discs,
    /// whose cells reach up through it.
    std::vector<double> blanket(const dem::State& state, const dem::RigidBase& base,
                                const GroundLine& ground, const Sites& sites) const;

    /// Temperature of the start at a place: above the ground of then, that of the ground.
    double start_temperature(dem::Point p) const;

    /// Mass that thermal expansion has taken from the columns since the start, kg/m^2; below 0
    /// where they are colder: the integral over depth of expansion times density times what a place
    /// is warmer than it was at the start. At each knot the mean weighted with the line that is 1
    /// there and 0 at the knots beside it: what lies between the outermost knots counts once.
    ///
    /// Density is that of what is there now, without expansion: its difference from what was there
    /// is load by itself, and with discs counted as their weight. Sediment above the ground of the
    /// start has the density that it weighs with at the ground's temperature.
    /// @param knots  ascending, m; at least two
    std::vector<double> mass_lost(const dem::State& state, const dem::RigidBase& base,
                                  std::span<const double> knots) const;

    /// The same as of the last solution, at knots that solutions are told before: that costs
    /// little. Empty: there was none since.
    void weigh_at(std::vector<double> knots) { knots_ = std::move(knots); }
    const std::vector<double>& mass_lost() const { return mass_lost_; }

private:
    void book_discs(dem::State& state, const HeatCells& cells);
    std::vector<double> mass_lost(const HeatCells& cells, std::span<const CellPart> parts,
                                  std::span<const double> knots) const;
    void ripen(dem::State& state, std::span<const double> before, double seconds) const;

    HeatParameters p_;
    HeatSetting setting_;
    HeatPoints& points_;
    Geotherm geotherm_;
    std::vector<double> knots_, mass_lost_;
};

/// Heat flow through the ground by the temperatures of its uppermost kilometre, mW/m^2.
class SurfaceHeatFlow {
public:
    SurfaceHeatFlow(const Heat& heat, const dem::State& state, const dem::RigidBase& base);

    /// Mean over 1 km to either side.
    double at(double x) const;

private:
    struct Site {
        double x, depth, temperature, resistivity, blanket;
        bool is_covered; ///< by sediment alone: its column is its own
    };
    std::vector<Site> sites_; ///< by ascending x
    double ground_temperature_;
};

} // namespace listric::thermal
