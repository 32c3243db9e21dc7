#include "apps/model/footwall_coupling.hpp"

#include "apps/model/effects/elastic_base_parameters.hpp"
#include "apps/model/footwall_request.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/model/model.hpp"
#include "apps/support/error.hpp"
#include "coupling/base_memory.hpp"
#include "coupling/independent_solution.hpp"
#include "coupling/interface_loads.hpp"
#include "dem/hypotenuse.hpp"
#include "dem/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace listric {

using namespace dem;
using namespace coupling;

namespace fs = std::filesystem;

namespace {

// Where linear elasticity ends: rock that carries bending breaks beyond 2 %; what is relaxed flows,
// and only its bulk is still meant. A rotation by r is a strain of r^2 / 2 that is overlooked.
constexpr double strain_allowed = 0.10;
constexpr double rotation_allowed = 0.20;

/// What the footwall refuses is a scene's mistake.
auto refusing(auto&& make) {
    try {
        return make();
    } catch (const fem::FootwallError& error) {
        throw UsageError(fmt::format("elastic_base: {}", error.what()));
    }
}

std::unique_ptr<ElasticBase> make_elastic_base(const Scene& scene, const ModelParts& parts,
                                               fem::Footwall& footwall) {
    const auto& parameters = *elastic_base(scene);
    Interface interface = condense(footwall, parameters.degree);
    const std::size_t last = interface.x.size() - 1;
    const double spacing = hypotenuse(interface.x[last] - interface.x[last - 1],
                                      interface.y[last] - interface.y[last - 1]);
    auto base = std::make_unique<ElasticBase>(std::move(interface),
                                              make_coupling_parameters(scene, parts, spacing));
    // Long intervals in which the discs come to rest are the one way in which it was seen to work.
    constexpr int long_enough = 1000;
    if (parameters.scheme == CouplingScheme::staggered && base->staggered_growth() >= 1.0 &&
        parameters.update_interval < long_enough)
        throw UsageError(fmt::format(
            "elastic_base.scheme: staggered would blow up: the base gives way {:.3g} times as far "
            "as a contact that pushes it is pressed, allowed: below 1; scheme modal is stable, or "
            "let discs rest in between with elastic_base.update_interval_cycles of {} or more",
            base->staggered_growth(), long_enough));
    return base;
}

/// Why a field is not one of linear elasticity, if so.
std::optional<std::string> beyond_elasticity(const fem::Guard& guard, double extension) {
    const double strain = std::max(guard.strong_strain, guard.relaxed_strain);
    if (!(strain > strain_allowed || guard.rotation > rotation_allowed))
        return std::nullopt;
    return fmt::format(
        "the footwall is strained by {:.1f} % and turned by {:.1f} degrees at {:.0f} m of "
        "extension; linear elasticity means up to {:.0f} % and {:.1f} degrees. A greater "
        "elastic_base.young_modulus_pa, elastic_thickness_m or skin_thickness_m, or a smaller "
        "relaxation, stiffens it",
        100.0 * strain, guard.rotation * 180.0 / pi, extension, 100.0 * strain_allowed,
        rotation_allowed * 180.0 / pi);
}

} // namespace

FootwallCoupling::FootwallCoupling(const Scene& scene, const ModelParts& parts,
                                   std::vector<std::unique_ptr<Event>>& events)
    : request_(make_footwall_request(scene, parts)),
      rock_weight_(elastic_base(scene)->crust_density * parts.physics.gravity),
      extension_rate_(scene.extension.rate),
      footwall_(refusing([&] { return fem::make_footwall(request_); })),
      base_(refusing([&] { return make_elastic_base(scene, parts, *footwall_); })),
      loads_(refusing([&] {
          return FootwallLoads(*footwall_, *base_, make_footwall_loads(scene, parts), events);
      })) {}

std::vector<std::string> FootwallCoupling::description() const {
    const fem::MeshFacts mesh = footwall_->mesh();
    return {fmt::format("elastic base: {} elements, {} unknowns, condensed to {} nodes of the "
                        "detachment",
                        mesh.cells, mesh.unknowns, base_->interface().x.size())};
}

RecoveredField FootwallCoupling::recover(const State& state) {
    fem::Load load = loads_.elsewhere(state);
    load.interface = base_->interface_forces(state);
    load.interface.resize(2 * footwall_->interface().size(), 0.0);
    footwall_->solve(load);
    return RecoveredField(*this, ++solutions_, state.clock.extension);
}

std::optional<FootwallCoupling::Check> FootwallCoupling::check(const State& state) const {
    const std::optional<ConstInterfaceMeans> means = last_window_means(state);
    if (!means)
        return std::nullopt;
    std::vector<double> all(means->force.begin(), means->force.end());
    std::vector<double> on_interface = all;
    add_footwall_loads(state, all);
    // The effects' loads are solved for as they are now; through the window they have grown.
    std::vector<double> grown(all.size(), 0.0);
    if (!means->effects.empty()) {
        add_footwall_loads(state, grown);
        std::ranges::transform(grown, means->effects, grown.begin(), std::minus());
    }
    std::vector<double> now = base_->displacement(grown);
    std::ranges::transform(now, means->displacement, now.begin(), std::plus());
    const std::vector<double> water = interface_loads(state);
    for (std::size_t k = 0; k < water.size(); ++k)
        on_interface[k] += water[k];
    const IndependentSolution fine = refusing([&] {
        return solve_independently(request_, base_->interface(), on_interface,
                                   loads_.elsewhere(state));
    });
    return Check{fine.unknowns, relative_difference(base_->displacement(all), fine.displacement),
                 relative_difference(now, fine.displacement)};
}

FootwallCoupling::WindowEnd FootwallCoupling::end_window(State& state, const RigidBase& rigid) {
    const WindowBalance window = base_->window(state);
    const InterfaceBalance balance = interface_balance(state, rigid);
    const fem::Guard guard = recover(state).guard(rock_weight_);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const bool moved = window.cycles > 0.0, loaded = std::abs(window.weight_change) > 0.0;
    WindowEnd end;
    end.measures = {
        {effects::interface_force_error, balance.force_error},
        {effects::interface_moment_error, balance.moment_error},
        {effects::interface_work_error, balance.work_error},
        {effects::base_reaction_error, moved ? window.reaction_error : nan},
        {effects::net_wall_load, moved ? window.net_load : nan},
        {effects::weight_change, moved ? window.weight_change : nan},
        {effects::net_wall_load_error, loaded ? window.net_load / window.weight_change - 1.0 : nan},
        {effects::strong_rock_strain, guard.strong_strain},
        {effects::relaxed_rock_strain, guard.relaxed_strain},
        {effects::rock_rotation, guard.rotation * 180.0 / pi},
        {effects::beyond_byerlee, guard.beyond_byerlee},
    };
    std::ranges::move(loads_.measures(state), std::back_inserter(end.measures));
    end.beyond_elasticity = beyond_elasticity(guard, state.clock.extension);
    base_->end_window(state);
    return end;
}

void FootwallCoupling::write(const fs::path& output, const RecoveredField& field,
                             const MomentNames& names) const {
    const fs::path folder = output / "paraview";
    std::error_code error;
    fs::create_directories(folder, error);
    const std::string begin = "footwall-", end = "m.vtu", present = names.metres(field.extension());
    field.current().write(folder.string(), begin + present + "m");
    std::vector<std::pair<double, std::string>> moments;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string file = entry.path().filename().string();
        if (!file.starts_with(begin) || !file.ends_with(end))
            continue;
        const std::string moment =
            file.substr(begin.size(), file.size() - begin.size() - end.size());
        const std::optional<double> extension =
            moment == present ? std::optional(field.extension()) : names.window_end(moment);
        if (extension)
            moments.emplace_back(*extension / extension_rate_ / 1e6, "paraview/" + file);
    }
    std::ranges::sort(moments);
    try {
        fem::write_series((output / "footwall.pvd").string(), moments);
    } catch (const fem::FootwallError& failure) {
        throw StorageError(failure.what());
    }
}

} // namespace listric
