#include "apps/model/footwall_coupling.hpp"

#include "apps/scene/footwall_request.hpp"
#include "apps/support/error.hpp"
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

/// Of mantle and crust, times gravity, Pa/m.
double mantle_contrast(const Scene& scene) {
    const ElasticBaseParameters& base = *scene.elastic_base;
    return (base.mantle_density - base.crust_density) * scene.gravity->acceleration;
}

FootwallErosionParameters erosion_parameters(const Scene& scene) {
    FootwallErosionParameters erosion = *scene.footwall_erosion;
    erosion.rock_density = scene.elastic_base->crust_density;
    return erosion;
}

/// Forces on the interface that displace it as each of the rows, by rows.
std::vector<double> equivalent_forces(const ElasticBase& base, std::span<const double> rows) {
    const std::size_t unknowns = base.interface().unknowns();
    std::vector<double> forces;
    for (std::size_t first = 0; first < rows.size(); first += unknowns)
        std::ranges::move(base.forces_for(rows.subspan(first, unknowns)),
                          std::back_inserter(forces));
    return forces;
}

/// The largest size of a value; windows without one do not count.
double largest(std::span<const double> values) {
    double most = 0.0;
    for (const double value : values)
        if (std::abs(value) > most)
            most = std::abs(value);
    return most;
}

/// Name of the table of the mean forces and displacements of the window that ended last.
constexpr const char* last_window = "last_window";

std::string moment_name(double extension) { return fmt::format("footwall-{:08.2f}m", extension); }

} // namespace

FootwallCoupling::FootwallCoupling(const Scene& scene) : scene_(scene) {
    try {
        footwall_ = fem::make_footwall(make_footwall_request(scene));
        Interface interface = condense(*footwall_, scene.elastic_base->degree);
        const std::size_t last = interface.x.size() - 1;
        const double spacing = std::hypot(interface.x[last] - interface.x[last - 1],
                                          interface.y[last] - interface.y[last - 1]);
        const std::size_t unknowns = interface.unknowns();
        base_ = std::make_unique<ElasticBase>(std::move(interface),
                                              make_coupling_parameters(scene, spacing));
        const auto& erosion = scene.footwall_erosion;
        const auto& thinning = scene.lower_crust_thinning;
        responses_ = solve_footwall_loads(*footwall_, unknowns, erosion ? &*erosion : nullptr,
                                          scene.elastic_base->left, thinning ? &*thinning : nullptr,
                                          mantle_contrast(scene), scene.extension.distance);
    } catch (const fem::FootwallError& error) {
        throw UsageError(fmt::format("elastic_base: {}", error.what()));
    }
    // Long intervals in which the discs come to rest are the one way in which it was seen to work.
    constexpr int long_enough = 1000;
    if (scene.elastic_base->scheme == CouplingScheme::staggered &&
        base_->staggered_growth() >= 1.0 && scene.elastic_base->update_interval < long_enough)
        throw UsageError(fmt::format(
            "elastic_base.scheme: staggered would blow up: the base gives way {:.3g} times as far "
            "as a contact that pushes it is pressed, allowed: below 1; scheme modal is stable, or "
            "let discs rest in between with elastic_base.update_interval_cycles of {} or more",
            base_->staggered_growth(), long_enough));
}

std::vector<std::string> FootwallCoupling::description() const {
    const fem::MeshFacts mesh = footwall_->mesh();
    return {fmt::format("elastic base: {} elements, {} unknowns, condensed to {} nodes of the "
                        "detachment",
                        mesh.cells, mesh.unknowns, base_->interface().x.size())};
}

double FootwallCoupling::share_of_extension(const State& state) const {
    return state.clock.extension / responses_.crust.distance;
}

std::vector<std::unique_ptr<Event>> FootwallCoupling::make_events() {
    std::vector<std::unique_ptr<Event>> events;
    const double rate = scene_.extension.rate;
    const LowerCrustResponse& crust = responses_.crust;
    if (scene_.lower_crust_thinning)
        events.push_back(std::make_unique<LowerCrustThinning>(
            crust, equivalent_forces(*base_, crust.interface), rate));
    if (scene_.basin_water)
        events.push_back(std::make_unique<BasinWater>(
            base_->interface(), *scene_.basin_water, scene_.gravity->acceleration,
            water_column_width(scene_.hanging_wall->mean_radius), rate));
    if (scene_.footwall_erosion) {
        const SurfaceResponse& surface = responses_.surface;
        const auto uplift = [this, &surface, &crust](const State& state) {
            std::vector<double> result = surface.uplift_by(interface_forces(*base_, state));
            if (scene_.lower_crust_thinning) {
                const auto sinks =
                    LowerCrustResponse::at(crust.uplift, crust.steps, share_of_extension(state));
                std::ranges::transform(result, sinks, result.begin(), std::plus());
            }
            return result;
        };
        auto erosion = std::make_unique<FootwallErosion>(
            surface, equivalent_forces(*base_, surface.interface), uplift,
            erosion_parameters(scene_), scene_.gravity->acceleration, rate);
        erosion_ = erosion.get();
        events.push_back(std::move(erosion));
    }
    return events;
}

/// What acts on the footwall elsewhere than on the interface.
fem::Load FootwallCoupling::other_loads(const State& state) const {
    std::vector<fem::Load> loads;
    if (scene_.lower_crust_thinning)
        loads.push_back(lower_crust_load(*scene_.lower_crust_thinning, mantle_contrast(scene_),
                                         state.clock.extension));
    if (erosion_)
        loads.push_back(erosion_->load());
    fem::Load sum;
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
    for (const fem::Load& load : loads)
        sum.jumps.insert(sum.jumps.end(), load.jumps.begin(), load.jumps.end());
    return sum;
}

const fem::Footwall& FootwallCoupling::recover(const State& state) {
    fem::Load load = other_loads(state);
    load.interface = interface_forces(*base_, state);
    load.interface.resize(2 * footwall_->interface().size(), 0.0);
    footwall_->solve(load);
    return *footwall_;
}

std::optional<FootwallCoupling::Check> FootwallCoupling::check(const State& state) const {
    const auto means = state.base_memory.find(last_window);
    if (means == state.base_memory.end())
        return std::nullopt;
    const auto force = means->second.get<double>("force");
    const auto displacement = means->second.get<double>("displacement");
    std::vector<double> all(force.begin(), force.end());
    add_footwall_loads(state, all);
    // The effects' loads are solved for as they are now; through the window they have grown.
    std::vector<double> grown(all.size(), 0.0);
    if (means->second.has("effects")) {
        add_footwall_loads(state, grown);
        std::ranges::transform(grown, means->second.get<double>("effects"), grown.begin(),
                               std::minus());
    }
    std::vector<double> now = base_->displacement(grown);
    std::ranges::transform(now, displacement, now.begin(), std::plus());
    std::vector<double> on_interface(force.begin(), force.end());
    const std::vector<double> water = interface_loads(state);
    for (std::size_t k = 0; k < water.size(); ++k)
        on_interface[k] += water[k];
    try {
        const IndependentSolution fine = solve_independently(
            make_footwall_request(scene_), base_->interface(), on_interface, other_loads(state));
        return Check{fine.unknowns,
                     relative_difference(base_->displacement(all), fine.displacement),
                     relative_difference(now, fine.displacement)};
    } catch (const fem::FootwallError& error) {
        throw UsageError(fmt::format("elastic_base: {}", error.what()));
    }
}

std::vector<std::pair<std::string, double>> FootwallCoupling::end_window(State& state,
                                                                         const RigidBase& rigid) {
    const ConstBaseNodeColumns nodes = base_node_columns(std::as_const(state));
    const WindowBalance window = base_->window(state);
    const InterfaceBalance balance = interface_balance(state, rigid);
    recover(state);
    const fem::Guard guard =
        footwall_->guard(scene_.elastic_base->crust_density * scene_.gravity->acceleration);
    if (window.cycles > 0.0)
        state.base_memory[last_window] = base_->window_means(state);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const bool loaded = std::abs(window.weight_change) > 0.0;
    std::vector<std::pair<std::string, double>> row = {
        {"footwall_uplift_m", nodes.uy[0]},
        {"breakaway_shift_m", nodes.ux[0]},
        {"base_deflection_max_m", largest(nodes.uy)},
        {"interface_force_error", balance.force_error},
        {"interface_moment_error", balance.moment_error},
        {"interface_work_error", balance.work_error},
        {"base_reaction_error", window.cycles > 0.0 ? window.reaction_error : nan},
        {"net_wall_load_n_per_m", window.cycles > 0.0 ? window.net_load : nan},
        {"weight_change_n_per_m", window.cycles > 0.0 ? window.weight_change : nan},
        {"net_wall_load_error", loaded ? window.net_load / window.weight_change - 1.0 : nan},
        {"strong_rock_strain_max", guard.strong_strain},
        {"relaxed_rock_strain_max", guard.relaxed_strain},
        {"rock_rotation_max_deg", guard.rotation * 180.0 / pi},
        {"beyond_byerlee_m2", guard.beyond_byerlee},
    };
    if (scene_.lower_crust_thinning)
        row.emplace_back("lower_crust_thinning_m",
                         lower_crust_thinning(*scene_.lower_crust_thinning, state.clock.extension));
    if (scene_.basin_water)
        row.emplace_back("basin_water_n_per_m", water_weight(state));
    if (erosion_) {
        const auto [eroded, deposited] = erosion_->areas();
        row.emplace_back("footwall_eroded_m2", eroded);
        row.emplace_back("footwall_deposited_m2", deposited);
    }
    base_->begin_window(state);
    const double strain = std::max(guard.strong_strain, guard.relaxed_strain);
    if (strain > strain_allowed || guard.rotation > rotation_allowed)
        throw BeyondElasticity(fmt::format(
            "the footwall is strained by {:.1f} % and turned by {:.1f} degrees at {:.0f} m of "
            "extension; linear elasticity means up to {:.0f} % and {:.1f} degrees. A greater "
            "elastic_base.young_modulus_pa, elastic_thickness_m or skin_thickness_m, or a smaller "
            "relaxation, stiffens it",
            100.0 * strain, guard.rotation * 180.0 / pi, state.clock.extension,
            100.0 * strain_allowed, rotation_allowed * 180.0 / pi));
    return row;
}

void FootwallCoupling::write(const fs::path& output, const State& state) const {
    const fs::path folder = output / "paraview";
    std::error_code error;
    fs::create_directories(folder, error);
    const std::string name = moment_name(state.clock.extension);
    footwall_->write(folder.string(), name);
    std::vector<std::pair<double, std::string>> moments;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string file = entry.path().filename().string();
        if (file.starts_with("footwall-") && file.ends_with("m.vtu"))
            moments.emplace_back(std::strtod(file.c_str() + 9, nullptr) / scene_.extension.rate /
                                     1e6,
                                 "paraview/" + file);
    }
    std::ranges::sort(moments);
    try {
        fem::write_series((output / "footwall.pvd").string(), moments);
    } catch (const fem::FootwallError& failure) {
        throw StorageError(failure.what());
    }
}

std::vector<std::pair<std::string, double>> footwall_summary(const Table& history,
                                                             const State& state) {
    if (!history.has("footwall_uplift_m"))
        return {};
    const auto column = [&](const char* name) { return history.get<double>(name); };
    double sum = 0.0, windows = 0.0;
    for (const double error : column("base_reaction_error"))
        if (!std::isnan(error)) {
            sum += error;
            ++windows;
        }
    // Where the base is now: the run may have been ended within a window.
    const ConstBaseNodeColumns nodes = base_node_columns(state);
    std::vector<std::pair<std::string, double>> measures = {
        {"footwall_uplift_m", nodes.uy[0]},
        {"breakaway_shift_m", nodes.ux[0]},
        {"base_deflection_max_m", largest(nodes.uy)},
    };
    for (const char* name :
         {"interface_force_error", "interface_moment_error", "interface_work_error"})
        measures.emplace_back(name, largest(column(name)));
    measures.emplace_back("base_reaction_error", windows > 0.0 ? sum / windows : 0.0);
    for (const char* name : {"net_wall_load_n_per_m", "net_wall_load_error"})
        measures.emplace_back(name, column(name).back());
    for (const char* name : {"strong_rock_strain_max", "relaxed_rock_strain_max",
                             "rock_rotation_max_deg", "beyond_byerlee_m2"})
        measures.emplace_back(name, largest(column(name)));
    for (const char* name : {"lower_crust_thinning_m", "basin_water_n_per_m", "footwall_eroded_m2",
                             "footwall_deposited_m2"})
        if (history.has(name))
            measures.emplace_back(name, column(name).back());
    return measures;
}

} // namespace listric
