#include "coupling/footwall_loads.hpp"

#include "coupling/base_memory.hpp"
#include "coupling/interface_loads.hpp"
#include "dem/base/rest.hpp"
#include "dem/base/target_line.hpp"
#include "dem/columns.hpp"
#include "dem/pushes.hpp"

#include <algorithm>
#include <cassert>
#include <functional>
#include <iterator>

namespace listric::coupling {

using namespace dem;

namespace {

/// Forces on the interface that displace it as each of the rows does, by rows, N.
std::vector<double> equivalent_forces(const ElasticBase& base, std::span<const double> rows) {
    const std::size_t unknowns = base.interface().unknowns();
    std::vector<double> forces;
    for (std::size_t first = 0; first < rows.size(); first += unknowns)
        std::ranges::move(base.forces_for(rows.subspan(first, unknowns)),
                          std::back_inserter(forces));
    return forces;
}

} // namespace

std::vector<LoadResponse> solve_unit_loads(fem::Footwall& footwall,
                                           std::span<const std::vector<fem::Load>> effects,
                                           std::size_t unknowns) {
    std::vector<fem::Load> loads;
    std::vector<std::size_t> first = {0}; // of each effect, and the end
    for (const std::vector<fem::Load>& effect : effects) {
        loads.insert(loads.end(), effect.begin(), effect.end());
        first.push_back(loads.size());
    }
    const fem::Responses solved = loads.empty() ? fem::Responses{} : footwall.responses(loads);
    const std::size_t all = 2 * footwall.interface().size();
    assert(unknowns <= all);
    std::vector<LoadResponse> result(effects.size());
    for (std::size_t e = 0; e < effects.size(); ++e) {
        LoadResponse& response = result[e];
        for (std::size_t k = first[e]; k < first[e + 1]; ++k) {
            for (std::size_t i = 0; i < unknowns; ++i)
                response.interface.push_back(solved.interface[k * all + i]);
            response.sums.push_back(solved.sums[k]);
        }
        for (std::size_t other = 0; other < effects.size(); ++other) {
            std::vector<double>& work = response.work.emplace_back();
            for (std::size_t row = first[other]; row < first[other + 1]; ++row)
                for (std::size_t k = first[e]; k < first[e + 1]; ++k)
                    work.push_back(solved.work[row * loads.size() + k]);
        }
    }
    return result;
}

fem::Load pressure_load(fem::Boundary boundary, std::vector<double> knots,
                        std::vector<double> pressure) {
    std::vector<Point> points;
    for (std::size_t k = 0; k < knots.size(); ++k)
        points.push_back({knots[k], pressure[k]});
    fem::Load load;
    load.traction = [boundary, line = TargetLine(points), points](fem::Vector p, fem::Vector,
                                                                  fem::Boundary at) {
        const bool is_loaded = at == boundary && p.x >= points.front().x && p.x <= points.back().x;
        return fem::Vector{0.0, is_loaded ? -line.height(p.x) : 0.0};
    };
    load.jumps = std::move(knots); // bends there
    return load;
}

std::vector<fem::Load> pressure_loads(fem::Boundary boundary, const std::vector<double>& knots) {
    std::vector<fem::Load> loads;
    for (std::size_t k = 0; k < knots.size(); ++k) {
        std::vector<double> pressure(knots.size(), 0.0);
        pressure[k] = 1.0;
        loads.push_back(pressure_load(boundary, knots, pressure));
    }
    return loads;
}

std::vector<double> superpose(std::span<const double> amounts, std::span<const double> rows) {
    assert(!amounts.empty() && rows.size() % amounts.size() == 0);
    std::vector<double> sum(rows.size() / amounts.size(), 0.0);
    for (std::size_t k = 0; k < amounts.size(); ++k)
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += amounts[k] * rows[k * sum.size() + i];
    return sum;
}

namespace {

/// Stress that relaxes in the footwall, as an effect with unit loads sees it: how much of each of
/// them its work on that displacement is.
/// @param first  of the effect's unit loads among those of all
OtherLoad stress_left(std::size_t first, std::size_t count) {
    OtherLoad stress{.work = std::vector<double>(count * count, 0.0),
                     .amounts =
                         [first, count](const State& state) {
                             const std::span<const double> all = creep_work(state);
                             std::vector<double> work(count, 0.0);
                             if (!all.empty())
                                 std::ranges::copy(all.subspan(first, count), work.begin());
                             return work;
                         },
                     .cover = [](double) { return 0.0; }};
    for (std::size_t k = 0; k < count; ++k)
        stress.work[k * count + k] = 1.0;
    return stress;
}

} // namespace

FootwallLoads::FootwallLoads(fem::Footwall& footwall, const ElasticBase& base,
                             std::span<const FootwallLoad> effects,
                             std::vector<std::unique_ptr<Event>>& events)
    : base_(&base), effects_(std::make_shared<std::vector<LoadingEvent>>()) {
    for (const FootwallLoad& effect : effects)
        unit_loads_.push_back(effect.unit_loads);
    const std::vector<LoadSolution> all = solutions(footwall);
    for (std::size_t e = 0; e < effects.size(); ++e) {
        effects_->push_back(effects[e].make_event(all[e]));
        assert(unit_loads_[e].empty() || effects_->back().amounts);
    }
    for (LoadingEvent& effect : *effects_) {
        names_.push_back(effect.event->name());
        events.push_back(std::move(effect.event));
    }
}

std::vector<LoadSolution> FootwallLoads::solutions(fem::Footwall& footwall) {
    std::vector<LoadResponse> responses =
        solve_unit_loads(footwall, unit_loads_, base_->interface().unknowns());
    std::vector<LoadSolution> result;
    std::size_t first = 0;
    forces_.clear();
    for (std::size_t e = 0; e < responses.size(); ++e) {
        LoadResponse& response = responses[e];
        LoadSolution solution{*base_,
                              std::move(response.interface),
                              {},
                              std::move(response.sums),
                              std::move(response.work[e]),
                              {}};
        solution.forces = equivalent_forces(*base_, solution.interface);
        forces_.push_back(solution.forces);
        for (std::size_t other = 0; other < responses.size(); ++other)
            if (other != e && !unit_loads_[other].empty())
                solution.others.push_back(
                    {.work = std::move(response.work[other]),
                     .amounts = [all = effects_, other](
                                    const State& state) { return (*all)[other].amounts(state); },
                     .cover =
                         [all = effects_, other](double x) {
                             const LoadingEvent& effect = (*all)[other];
                             return effect.cover ? effect.cover(x) : 0.0;
                         }});
        if (!footwall.stress_points().empty() && !unit_loads_[e].empty())
            solution.others.push_back(stress_left(first, unit_loads_[e].size()));
        first += unit_loads_[e].size();
        result.push_back(std::move(solution));
    }
    return result;
}

void FootwallLoads::solve_anew(fem::Footwall& footwall) {
    const std::vector<LoadSolution> all = solutions(footwall);
    for (std::size_t e = 0; e < all.size(); ++e)
        if ((*effects_)[e].take_solution)
            (*effects_)[e].take_solution(all[e]);
}

void FootwallLoads::put(State& state) const {
    for (std::size_t e = 0; e < effects_->size(); ++e) {
        if (unit_loads_[e].empty())
            continue;
        const std::vector<double> now = superpose((*effects_)[e].amounts(state), forces_[e]);
        std::ranges::copy(now, footwall_load(state, names_[e], now.size()).begin());
    }
}

std::size_t FootwallLoads::unit_loads() const {
    std::size_t count = 0;
    for (const std::vector<fem::Load>& effect : unit_loads_)
        count += effect.size();
    return count;
}

void FootwallLoads::prepare(State& state) const {
    for (const LoadingEvent& effect : *effects_)
        if (effect.prepare)
            effect.prepare(state);
}

double FootwallLoads::cover(double x) const {
    double height = 0.0;
    for (const LoadingEvent& effect : *effects_)
        if (effect.cover)
            height += effect.cover(x);
    return height;
}

double FootwallLoads::sediment(double x) const {
    double thickness = 0.0;
    for (const LoadingEvent& effect : *effects_)
        if (effect.sediment)
            thickness += effect.sediment(x);
    return thickness;
}

fem::Load FootwallLoads::elsewhere(const State& state) const {
    std::vector<fem::Load> loads;
    for (const LoadingEvent& effect : *effects_)
        if (effect.load_elsewhere)
            loads.push_back(effect.load_elsewhere(state));
    fem::Load sum;
    sum.stress = creep_stress(state);
    for (const fem::Load& load : loads)
        sum.jumps.insert(sum.jumps.end(), load.jumps.begin(), load.jumps.end());
    if (!loads.empty())
        sum.traction = [loads](fem::Vector place, fem::Vector normal, fem::Boundary boundary) {
            fem::Vector traction;
            for (const fem::Load& load : loads) {
                const fem::Vector t = load.traction(place, normal, boundary);
                traction.x += t.x;
                traction.y += t.y;
            }
            return traction;
        };
    return sum;
}

NamedValues FootwallLoads::measures(const State& state) const {
    NamedValues columns;
    for (const LoadingEvent& effect : *effects_)
        if (effect.measures)
            std::ranges::move(effect.measures(state), std::back_inserter(columns));
    return columns;
}

void solve_for_field(fem::Footwall& footwall, const ElasticBase& base, const FootwallLoads& loads,
                     const State& state) {
    fem::Load load = loads.elsewhere(state);
    load.interface = base.interface_forces(state);
    load.interface.resize(2 * footwall.interface().size(), 0.0);
    footwall.solve(load);
}

void take_stiffness(fem::Footwall& footwall, ElasticBase& base, FootwallLoads& loads) {
    base.take_compliance(condense(footwall, base.interface().degree).compliance);
    loads.solve_anew(footwall);
}

void put_stress_left(fem::Footwall& footwall, const ElasticBase& base, State& state,
                     const std::string& name, fem::Load left, double step) {
    footwall.solve(left);
    std::vector<double> moved = footwall.interface_displacement();
    moved.resize(base.interface().unknowns());
    std::ranges::copy(base.forces_for(moved), footwall_load(state, name, moved.size()).begin());
    set_creep(state, {.step = step, .stress = std::move(left.stress), .work = footwall.work()});
}

namespace {

constexpr double between = 25.0; // m of travel: as the loads
constexpr const char* forces_name = "forces";

/// Adds the discs' weight to the nodes on both sides of each, N.
void add_weight(const State& state, double gravity, std::span<double> forces) {
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    const ConstDiscColumns d = disc_columns(state);
    const Pushes pushes(state);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const auto next = std::ranges::upper_bound(nodes.x, d.x[i]) - nodes.x.begin();
        const auto right =
            static_cast<std::size_t>(std::clamp(next, std::ptrdiff_t{1}, std::ssize(nodes.x) - 1));
        const double from = nodes.x[right - 1], to = nodes.x[right];
        const double share = std::clamp((d.x[i] - from) / (to - from), 0.0, 1.0);
        const double weight = gravity * d.mass[i] - pushes[i].y;
        forces[2 * right + 1] -= share * weight;
        forces[2 * right - 1] -= (1.0 - share) * weight;
    }
}

/// Moves discs by the displacement of the nodes below them. @param moved  x and y by node, m
void take_along(State& state, std::span<const double> moved) {
    const ConstBaseNodeColumns nodes = base_node_columns(std::as_const(state));
    std::vector<Point> aside, up;
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        const double x = nodes.x[k] + nodes.ux[k];
        if (!up.empty() && x <= up.back().x)
            continue;
        aside.push_back({x, moved[2 * k]});
        up.push_back({x, moved[2 * k + 1]});
    }
    const TargetLine by_x(std::move(aside)), by_y(std::move(up));
    const DiscColumns d = disc_columns(state);
    for (std::size_t i = 0; i < d.x.size(); ++i) {
        const double x = d.x[i];
        d.x[i] += by_x.height(x);
        d.y[i] += by_y.height(x);
    }
}

} // namespace

PromptBase::PromptBase(const ElasticBase& base, const Calendar& calendar)
    : Event("prompt_base", {between / calendar.rate(), calendar}, dem::Stage::load), base_(&base) {}

void PromptBase::begin(State&) {
    memory.resize(base_->interface().unknowns());
    memory.add<double>(forces_name, "N", 0.0);
}

bool PromptBase::apply(State& state, const RigidBase& base) {
    std::vector<double> now(base_->interface().unknowns(), 0.0), change(now.size());
    add_footwall_loads(state, now);
    add_weight(state, base_->parameters().gravity, now);
    const auto before = memory.get<double>(forces_name);
    std::ranges::transform(now, before, change.begin(), std::minus());
    std::ranges::copy(now, before.begin());
    if (!rests(base.motion, schedule().due(applied + 1)))
        return false;
    take_along(state, base_->displace(state, change));
    return true;
}

} // namespace listric::coupling
