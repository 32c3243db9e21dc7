#pragma once

#include "coupling/footwall_loads.hpp"
#include "dem/event.hpp"
#include "fem/footwall.hpp"

#include <functional>
#include <vector>

namespace listric::coupling {

/// Places of an isotherm now, as rock lay before the base moved: x ascends, m.
using IsothermNow =
    std::function<std::vector<dem::Point>(const dem::State& state, const dem::RigidBase& base)>;

/// Lets the strength of the footwall end at an isotherm that moves: what gets hotter sheds its
/// stress to the rest, what cools begins with the stress that it has (Watts et al. 1982). To
/// another stiffness footwall, modes and unit loads are made anew, where the isotherm has moved by
/// a row of elements and the wall by half a kilometre; stress from before is one more load
/// elsewhere, as of rock that creeps.
class MovingIsotherm : public dem::Event {
public:
    /// @param line  that the footwall was made with
    /// @param now   none: it stays
    /// @param row   height of a row of elements, m
    MovingIsotherm(fem::Footwall& footwall, ElasticBase& base, FootwallLoads& loads,
                   std::vector<dem::Point> line, IsothermNow now, double row,
                   const dem::Schedule& schedule);

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    /// Takes the isotherm of a state. Throws fem::FootwallError.
    void go_on_with(const dem::State& state);

private:
    void take(const std::vector<dem::Point>& line);
    bool has_moved(const std::vector<dem::Point>& now) const;

    fem::Footwall* footwall_;
    ElasticBase* base_;
    FootwallLoads* loads_;
    std::vector<dem::Point> line_; ///< that the footwall has
    IsothermNow now_;
    double row_;
};

/// As the footwall takes it.
std::vector<fem::Vector> isotherm_of(const std::vector<dem::Point>& line);

} // namespace listric::coupling
