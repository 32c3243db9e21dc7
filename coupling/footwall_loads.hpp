#pragma once

#include "coupling/elastic_base.hpp"
#include "dem/event.hpp"
#include "fem/footwall.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace listric::coupling {

// An effect that loads the footwall is an event that puts forces on the interface's nodes (see
// interface_loads.hpp). What it puts there may follow from unit loads elsewhere on the footwall,
// which are solved for once, those of all effects together, and superposed in amounts that change.

/// Responses to the unit loads of one effect, by rows a number per load.
struct LoadResponse {
    std::vector<double> interface; ///< displacement of the base's unknowns: a row per load, m
    std::vector<fem::Vector> sums; ///< of the loads, N/m
    /// Work of the unit loads of each effect on the displacement by this one's, by number of the
    /// effect: a row per load of that effect, a column per load of this one, J/m. (Betti: the same
    /// as of this one's on the displacement by that one's.)
    std::vector<std::vector<double>> work;
};

/// Solves for the unit loads of several effects. Throws fem::FootwallError.
/// @param unknowns  of the interface that is kept, which may end before the footwall's
std::vector<LoadResponse> solve_unit_loads(fem::Footwall& footwall,
                                           std::span<const std::vector<fem::Load>> effects,
                                           std::size_t unknowns);

/// Pressures at knots that ascend, m, linear in between and nowhere else, toward a boundary from
/// above: downward, Pa.
fem::Load pressure_load(fem::Boundary boundary, std::vector<double> knots,
                        std::vector<double> pressure);

/// A pressure of 1 Pa at each knot.
std::vector<fem::Load> pressure_loads(fem::Boundary boundary, const std::vector<double>& knots);

/// Sum of rows, each times its amount: a number per column.
std::vector<double> superpose(std::span<const double> amounts, std::span<const double> rows);

/// The unit loads of another effect.
struct OtherLoad {
    std::vector<double> work; ///< on the displacement by this effect's: see LoadResponse::work
    std::function<std::vector<double>(const dem::State&)> amounts; ///< that act now
    std::function<double(double x)> cover; ///< as of LoadingEvent; 0 without
};

/// Parts of an effect's event: the rows are those of its unit loads.
struct LoadSolution {
    const ElasticBase& base;       ///< lives as long as the event
    std::vector<double> interface; ///< displacement of the base's unknowns: a row per load, m
    std::vector<double> forces;    ///< on the unknowns that displace them so: a row per load, N
    std::vector<fem::Vector> sums; ///< of the loads, N/m
    std::vector<double> work;      ///< of the loads on each other's displacement: square, J/m
    std::vector<OtherLoad> others; ///< of the other effects that have unit loads
};

/// Names and values, for columns of history.csv.
using NamedValues = std::vector<std::pair<std::string, double>>;

/// An effect's event and what is asked of it. The functions refer to the event.
struct LoadingEvent {
    std::unique_ptr<dem::Event> event;
    /// How much of each unit load acts now; none without unit loads.
    std::function<std::vector<double>(const dem::State&)> amounts = {};
    /// Load elsewhere than on the interface now; none: no load.
    std::function<fem::Load(const dem::State&)> load_elsewhere = {};
    /// Height that the effect has added to the footwall's surface left of the breakaway by now, m;
    /// none: nothing.
    std::function<double(double x)> cover = {};
    std::function<double(double x)> sediment = {}; ///< thickness of what is sediment there, m
    std::function<NamedValues(const dem::State&)> measures = {};
    /// Takes the solution for the unit loads on a footwall of another stiffness; none: there are
    /// no unit loads.
    std::function<void(const LoadSolution&)> take_solution = {};
    /// Gives discs what they settle on the base with; none: nothing.
    std::function<void(dem::State&)> prepare = {};
};

/// An effect that loads the footwall, before its unit loads are solved for.
struct FootwallLoad {
    std::vector<fem::Load> unit_loads = {};
    std::function<LoadingEvent(const LoadSolution&)> make_event;
};

/// The effects that load a footwall, in the order in which they are applied at the same moment.
/// Their events belong to whoever runs them, and must live as long as this.
class FootwallLoads {
public:
    /// Solves for the unit loads, makes the events and appends them to `events`. They refer to the
    /// base. Throws fem::FootwallError.
    FootwallLoads(fem::Footwall& footwall, const ElasticBase& base,
                  std::span<const FootwallLoad> effects,
                  std::vector<std::unique_ptr<dem::Event>>& events);

    /// Before the discs settle on the base, which has its nodes.
    void prepare(dem::State& state) const;

    /// Solves for the unit loads again, on a footwall of another stiffness. Throws
    /// fem::FootwallError.
    void solve_anew(fem::Footwall& footwall);

    /// Puts what acts of the unit loads, by their present solution.
    void put(dem::State& state) const;

    std::size_t unit_loads() const; ///< number of them

    /// Height that the effects have added to the footwall's surface left of the breakaway, m.
    double cover(double x) const;
    double sediment(double x) const; ///< thickness of what is sediment there, m

    /// Load on the footwall elsewhere than on the interface.
    fem::Load elsewhere(const dem::State& state) const;

    NamedValues measures(const dem::State& state) const; ///< of all effects

private:
    std::vector<LoadSolution> solutions(fem::Footwall& footwall);

    const ElasticBase* base_;
    std::vector<std::vector<fem::Load>> unit_loads_; ///< by number of the effect
    std::vector<std::vector<double>> forces_;        ///< equivalent to them, by rows
    std::vector<std::string> names_;                 ///< of the events
    /// By number of the effect; events find each other's amounts here.
    std::shared_ptr<std::vector<LoadingEvent>> effects_;
};

/// Gives base and loads the stiffness that the footwall has taken. Throws fem::FootwallError.
void take_stiffness(fem::Footwall& footwall, ElasticBase& base, FootwallLoads& loads);

/// Puts stress that is left in the footwall's rock as the load of the event of a name, and
/// remembers it. Throws fem::FootwallError.
/// @param step  that rock relaxes in, s; 0 where it does not
void put_stress_left(fem::Footwall& footwall, const ElasticBase& base, dem::State& state,
                     const std::string& name, fem::Load left, double step);

/// Solves for the field that displaces the interface as it is, under the loads elsewhere. Throws
/// fem::FootwallError.
void solve_for_field(fem::Footwall& footwall, const ElasticBase& base, const FootwallLoads& loads,
                     const dem::State& state);

/// In pauses that go by steps, takes the base at once to where the effects' loads and the weight of
/// discs that came and went move it, and discs along with what is below them. Years of cooling, and
/// the sediment and water that follow, load it in a step of some 200 m of travel; left to its modes
/// it needs 400 m to go three quarters of the way, so that it would be late by two or three steps.
/// What else discs do to the base moves it by its modes, as everywhere.
///
/// Applied behind the loads, as often as the most frequent of them; its memory are their forces
/// then. For a base whose stiffness stays: one that relaxes has other forces for the same place.
class PromptBase : public dem::Event {
public:
    PromptBase(const ElasticBase& base, const dem::Calendar& calendar);

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

private:
    const ElasticBase* base_;
};

} // namespace listric::coupling
