#include "coupling/footwall_erosion.hpp"

#include "coupling/interface_loads.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <iterator>

namespace listric::coupling {

using namespace dem;

SurfaceResponse::SurfaceResponse(std::vector<double> knots, std::vector<double> displacement,
                                 std::span<const fem::Vector> sums, std::span<const double> work)
    : x(std::move(knots)), interface(std::move(displacement)) {
    assert(sums.size() == x.size() && work.size() == x.size() * x.size());
    for (const fem::Vector& sum : sums)
        width.push_back(-sum.y);
    uplift = uplift_by_work(work);
}

std::vector<double> SurfaceResponse::uplift_by_work(std::span<const double> work) const {
    assert(work.size() % x.size() == 0);
    std::vector<double> rows;
    for (std::size_t k = 0; k < work.size(); ++k)
        rows.push_back(-work[k] / width[k % x.size()]);
    return rows;
}

std::vector<double> SurfaceResponse::uplift_by(std::span<const double> forces) const {
    std::vector<double> result;
    for (std::size_t k = 0; k < x.size(); ++k) {
        double work = 0.0;
        for (std::size_t i = 0; i < forces.size(); ++i)
            work += interface[k * forces.size() + i] * forces[i];
        result.push_back(-work / width[k]);
    }
    return result;
}

std::function<std::vector<double>(const State&)> surface_uplift(const SurfaceResponse& surface,
                                                                const LoadSolution& solution) {
    std::vector<OtherLoad> others = solution.others;
    for (OtherLoad& other : others)
        other.work = surface.uplift_by_work(other.work);
    return [surface, others, &base = solution.base](const State& state) {
        std::vector<double> uplift = surface.uplift_by(base.interface_forces(state));
        for (const OtherLoad& other : others)
            std::ranges::transform(uplift, superpose(other.amounts(state), other.work),
                                   uplift.begin(), std::plus());
        return uplift;
    };
}

std::vector<double> surface_knots(double width, double left) {
    assert(width > 0.0 && left < 0.0);
    constexpr double closest = 2e3, growth = 0.25;
    const double end = std::min(width, -left);
    std::vector<double> knots{0.0};
    do
        knots.push_back(std::min(end, knots.back() + std::max(closest, growth * knots.back())));
    while (knots.back() < end - closest);
    std::ranges::reverse(knots);
    for (double& x : knots)
        x = -x;
    return knots;
}

std::vector<fem::Load> surface_loads(const std::vector<double>& knots) {
    return pressure_loads(fem::Boundary::surface, knots);
}

fem::Load surface_load(std::vector<double> knots, std::vector<double> pressure) {
    return pressure_load(fem::Boundary::surface, std::move(knots), std::move(pressure));
}

std::vector<double> cover_pressure(const FootwallErosionParameters& p, double gravity,
                                   const ConstFootwallCover& cover) {
    std::vector<double> pressure;
    for (std::size_t k = 0; k < cover.eroded.size(); ++k)
        pressure.push_back(
            gravity * (p.sediment_density * cover.deposited[k] - p.rock_density * cover.eroded[k]));
    return pressure;
}

int adapt_footwall(const SurfaceResponse& response, const FootwallErosionParameters& parameters,
                   double gravity, std::span<const double> uplift, std::span<const double> target,
                   const FootwallCover& cover) {
    // Rebound is at most the density of rock over that of mantle of what was eroded.
    constexpr double close = 0.01; // m
    constexpr int most = 200;
    const std::size_t n = response.x.size();
    assert(uplift.size() == n && target.size() == n && cover.eroded.size() == n);
    for (int round = 1; round <= most; ++round) {
        const std::vector<double> pressure = cover_pressure(parameters, gravity, cover);
        double change = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            double height = uplift[k] + cover.deposited[k] - cover.eroded[k];
            for (std::size_t j = 0; j < n; ++j)
                height += pressure[j] * response.uplift[j * n + k];
            const double excess = height - target[k];
            change = std::max(change, std::abs(excess));
            if (excess > 0.0) {
                const double sediment = std::min(excess, cover.deposited[k]);
                cover.deposited[k] -= sediment;
                cover.eroded[k] += excess - sediment;
            } else {
                cover.deposited[k] -= excess;
            }
        }
        if (change < close)
            return round;
    }
    return most;
}

FootwallErosion::FootwallErosion(SurfaceResponse response, std::vector<double> forces,
                                 Uplift uplift, const FootwallErosionParameters& parameters,
                                 double gravity, const Calendar& calendar)
    : Event("footwall_erosion", {parameters.interval, calendar}, dem::Stage::load),
      response_(std::move(response)), forces_(std::move(forces)), uplift_(std::move(uplift)),
      parameters_(parameters), target_(parameters.level, parameters.target), gravity_(gravity) {
    memory.resize(response_.x.size());
    std::ranges::copy(response_.x, memory.add<double>("x", "m", 0.0).begin());
    memory.add<double>("eroded", "m", 0.0);
    memory.add<double>("deposited", "m", 0.0);
}

void FootwallErosion::take_response(SurfaceResponse response, std::vector<double> forces,
                                    Uplift uplift) {
    assert(response.x == response_.x);
    response_ = std::move(response);
    forces_ = std::move(forces);
    uplift_ = std::move(uplift);
}

void FootwallErosion::begin(State& state) {
    footwall_load(state, name(), forces_.size() / response_.x.size());
}

std::vector<double> FootwallErosion::pressure() const {
    return cover_pressure(parameters_, gravity_,
                          {memory.get<double>("eroded"), memory.get<double>("deposited")});
}

fem::Load FootwallErosion::load() const { return surface_load(response_.x, pressure()); }

FootwallErosion::Areas FootwallErosion::areas() const {
    Areas areas{};
    for (std::size_t k = 0; k < response_.x.size(); ++k) {
        areas.eroded += response_.width[k] * memory.get<double>("eroded")[k];
        areas.deposited += response_.width[k] * memory.get<double>("deposited")[k];
    }
    return areas;
}

double FootwallErosion::at(double x, std::span<const double> by_knot) const {
    std::vector<Point> line;
    for (std::size_t k = 0; k < response_.x.size(); ++k)
        line.push_back({response_.x[k], by_knot[k]});
    return x < response_.x.front() ? 0.0 : TargetLine(line).height(x);
}

double FootwallErosion::cover(double x) const {
    std::vector<double> height;
    std::ranges::transform(memory.get<double>("deposited"), memory.get<double>("eroded"),
                           std::back_inserter(height), std::minus());
    return at(x, height);
}

double FootwallErosion::sediment(double x) const { return at(x, memory.get<double>("deposited")); }

bool FootwallErosion::apply(State& state, const RigidBase&) {
    const FootwallCover cover{memory.get<double>("eroded"), memory.get<double>("deposited")};
    const TargetLine line = target_.at(schedule().calendar().age(state.clock.travel));
    std::vector<double> heights;
    for (double x : response_.x)
        heights.push_back(line.height(x));
    adapt_footwall(response_, parameters_, gravity_, uplift_(state), heights, cover);
    const std::vector<double> now = superpose(pressure(), forces_);
    std::ranges::copy(now, footwall_load(state, name(), now.size()).begin());
    return false;
}

FootwallLoad footwall_erosion_load(const FootwallErosionParameters& parameters, double gravity,
                                   double left, const Calendar& calendar) {
    const std::vector<double> knots = surface_knots(parameters.width, left);
    const auto make_event = [=](const LoadSolution& solution) {
        const SurfaceResponse surface(knots, solution.interface, solution.sums, solution.work);
        auto event = std::make_unique<FootwallErosion>(surface, solution.forces,
                                                       surface_uplift(surface, solution),
                                                       parameters, gravity, calendar);
        FootwallErosion& erosion = *event;
        const auto take_solution = [knots, &erosion](const LoadSolution& anew) {
            const SurfaceResponse now(knots, anew.interface, anew.sums, anew.work);
            erosion.take_response(now, anew.forces, surface_uplift(now, anew));
        };
        return LoadingEvent{.event = std::move(event),
                            .amounts = [&erosion](const State&) { return erosion.pressure(); },
                            .load_elsewhere = [&erosion](const State&) { return erosion.load(); },
                            .cover = [&erosion](double x) { return erosion.cover(x); },
                            .sediment = [&erosion](double x) { return erosion.sediment(x); },
                            .measures =
                                [&erosion](const State&) {
                                    const auto [eroded, deposited] = erosion.areas();
                                    return NamedValues{{footwall_eroded_name, eroded},
                                                       {footwall_deposited_name, deposited}};
                                },
                            .take_solution = take_solution};
    };
    return {surface_loads(knots), make_event};
}

} // namespace listric::coupling
