#include "coupling/lower_crust_thinning.hpp"

#include "coupling/footwall_loads.hpp"

#include <algorithm>

namespace listric::coupling {

using namespace dem;

namespace {

/// Steps so short that each moves the base by metres at most.
constexpr double interval = 2500.0; // a

} // namespace

double lower_crust_thinning(const LowerCrustThinningParameters& p, double extension) {
    return p.thickness * extension / (p.width + extension);
}

fem::Load lower_crust_load(const LowerCrustThinningParameters& p, double contrast,
                           double extension) {
    const double pressure = contrast * lower_crust_thinning(p, extension);
    const double left = p.centre - 0.5 * p.width, right = left + p.width + extension;
    fem::Load load;
    load.traction = [=](fem::Vector place, fem::Vector, fem::Boundary boundary) {
        const bool is_loaded = boundary == fem::Boundary::base && place.x > left && place.x < right;
        return fem::Vector{0.0, is_loaded ? -pressure : 0.0};
    };
    load.jumps = {left, right};
    return load;
}

std::vector<fem::Load> lower_crust_loads(const LowerCrustThinningParameters& parameters,
                                         double contrast, double distance, std::size_t steps) {
    std::vector<fem::Load> loads;
    for (std::size_t k = 0; k <= steps; ++k)
        loads.push_back(lower_crust_load(
            parameters, contrast, distance * static_cast<double>(k) / static_cast<double>(steps)));
    return loads;
}

std::vector<double> LowerCrustResponse::at(std::span<const double> rows, std::size_t steps,
                                           double share) {
    const std::size_t columns = rows.size() / (steps + 1);
    const double row = std::clamp(share, 0.0, 1.0) * static_cast<double>(steps);
    const std::size_t before = std::min(static_cast<std::size_t>(row), steps - 1);
    const double beyond = row - static_cast<double>(before);
    std::vector<double> result(columns);
    for (std::size_t i = 0; i < columns; ++i)
        result[i] =
            (1.0 - beyond) * rows[before * columns + i] + beyond * rows[(before + 1) * columns + i];
    return result;
}

LowerCrustThinning::LowerCrustThinning(const LowerCrustResponse& response,
                                       std::vector<double> forces, double extension_rate)
    : Event("lower_crust_thinning", {interval, extension_rate}), distance_(response.distance),
      steps_(response.steps), forces_(std::move(forces)) {}

void LowerCrustThinning::begin(State& state) {
    footwall_load(state, name(), forces_.size() / (steps_ + 1));
}

bool LowerCrustThinning::apply(State& state, const RigidBase&) {
    const std::vector<double> now =
        LowerCrustResponse::at(forces_, steps_, state.clock.extension / distance_);
    std::ranges::copy(now, footwall_load(state, name(), now.size()).begin());
    return false;
}

} // namespace listric::coupling
