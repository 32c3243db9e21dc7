#include "coupling/lower_crust_thinning.hpp"

#include "coupling/interface_loads.hpp"

#include <algorithm>
#include <cassert>

namespace listric::coupling {

using namespace dem;

namespace {

// Steps so short that each moves the base by metres at most.
constexpr double step_of_travel = 25.0; // m

constexpr const char* applied_extension = "applied_extension_m";

constexpr std::size_t steps = 10; // of lower_crust_loads()

} // namespace

double lower_crust_thinning(const LowerCrustThinningParameters& p, double extension) {
    const double stretch = p.share * extension;
    return p.thickness * stretch / (p.width + stretch);
}

fem::Load lower_crust_load(const LowerCrustThinningParameters& p, double contrast,
                           double extension) {
    const double pressure = contrast * lower_crust_thinning(p, extension);
    const double left = p.centre - 0.5 * p.width, right = left + p.width + p.share * extension;
    fem::Load load;
    load.traction = [=](fem::Vector place, fem::Vector, fem::Boundary boundary) {
        const bool is_loaded = boundary == fem::Boundary::base && place.x > left && place.x < right;
        return fem::Vector{0.0, is_loaded ? -pressure : 0.0};
    };
    load.jumps = {left, right};
    return load;
}

std::vector<fem::Load> lower_crust_loads(const LowerCrustThinningParameters& parameters,
                                         double contrast, double greatest, double least) {
    std::vector<fem::Load> loads;
    for (std::size_t k = 0; k <= steps; ++k)
        loads.push_back(lower_crust_load(parameters, contrast,
                                         least + (greatest - least) * static_cast<double>(k) /
                                                     static_cast<double>(steps)));
    return loads;
}

std::vector<double> lower_crust_amounts(double share) {
    const double row = std::clamp(share, 0.0, 1.0) * static_cast<double>(steps);
    const std::size_t before = std::min(static_cast<std::size_t>(row), steps - 1);
    const double beyond = row - static_cast<double>(before);
    std::vector<double> amounts(steps + 1, 0.0);
    amounts[before] = 1.0 - beyond;
    amounts[before + 1] = beyond;
    return amounts;
}

LowerCrustThinning::LowerCrustThinning(std::vector<double> forces, double greatest, double least,
                                       double extension_rate)
    : Event("lower_crust_thinning", dem::Schedule::every(step_of_travel, extension_rate),
            dem::Stage::load),
      forces_(std::move(forces)), greatest_(greatest), least_(least) {
    assert(forces_.size() % (steps + 1) == 0 && greatest >= least);
    memory.add<double>(applied_extension, "m", 0.0);
}

void LowerCrustThinning::begin(State& state) {
    footwall_load(state, name(), forces_.size() / (steps + 1));
    memory.resize(1);
}

double LowerCrustThinning::extension(const State& state) const {
    return memory.rows() > 0 && memory.has(applied_extension)
               ? memory.get<double>(applied_extension)[0]
               : state.clock.extension.m; // an older version has begun the run
}

std::vector<double> LowerCrustThinning::amounts(const State& state) const {
    const double way = greatest_ - least_; // 0 where the wall only rests
    return lower_crust_amounts(way > 0.0 ? (extension(state) - least_) / way : 0.0);
}

bool LowerCrustThinning::apply(State& state, const RigidBase&) {
    memory.resize(1);
    memory.add<double>(applied_extension, "m", 0.0)[0] = state.clock.extension.m;
    const std::vector<double> now = superpose(amounts(state), forces_);
    std::ranges::copy(now, footwall_load(state, name(), now.size()).begin());
    return false;
}

FootwallLoad lower_crust_thinning_load(const LowerCrustThinningParameters& parameters,
                                       double contrast, double greatest, double least,
                                       double extension_rate) {
    const auto make_event = [=](const LoadSolution& solution) {
        auto event =
            std::make_unique<LowerCrustThinning>(solution.forces, greatest, least, extension_rate);
        LowerCrustThinning& thinning = *event;
        return LoadingEvent{
            .event = std::move(event),
            .amounts = [&thinning](const State& state) { return thinning.amounts(state); },
            .load_elsewhere =
                [=, &thinning](const State& state) {
                    return lower_crust_load(parameters, contrast, thinning.extension(state));
                },
            .measures =
                [=, &thinning](const State& state) {
                    return NamedValues{
                        {lower_crust_thinning_name,
                         lower_crust_thinning(parameters, thinning.extension(state))}};
                },
            .take_solution =
                [&thinning](const LoadSolution& anew) { thinning.take_forces(anew.forces); }};
    };
    return {lower_crust_loads(parameters, contrast, greatest, least), make_event};
}

} // namespace listric::coupling
