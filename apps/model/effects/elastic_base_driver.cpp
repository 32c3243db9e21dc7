#include "apps/model/effects/elastic_base_driver.hpp"

#include "apps/model/base_driver.hpp"
#include "apps/model/effects/elastic_base_parameters.hpp"
#include "apps/model/effects/elastic_base_request.hpp"
#include "apps/model/effects/stage/pauses.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/model/model.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "coupling/base_memory.hpp"
#include "coupling/creep.hpp"
#include "coupling/elastic_base.hpp"
#include "coupling/footwall_loads.hpp"
#include "coupling/independent_solution.hpp"
#include "coupling/interface_loads.hpp"
#include "coupling/moving_isotherm.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/numbers/hash.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/units.hpp"
#include "thermal/heat.hpp"
#include "thermal/temperature_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace listric {

using namespace dem;
using namespace coupling;

namespace {

// Where linear elasticity ends: rock that carries bending breaks beyond 2 %; what is relaxed flows,
// and only its bulk is still meant. A rotation by r is a strain of r^2 / 2 that is overlooked.
constexpr double strain_allowed = 0.10;
constexpr double rotation_allowed = 0.20;

/// A refusal of the footwall is a mistake of the scene.
auto refusing(auto&& make) {
    try {
        return make();
    } catch (const fem::FootwallError& error) {
        throw UsageError(fmt::format("elastic_base: {}", error.what()));
    }
}

std::unique_ptr<ElasticBase> make_elastic_base(const Scene& scene, const ModelParts& parts,
                                               fem::Footwall& footwall) {
    const ElasticBaseParameters& p = *elastic_base(scene);
    Interface interface = condense(footwall, p.bending.degree);
    const double reach = scene.hanging_wall.length + greatest_extension(scene);
    if (interface.x.back() < reach)
        throw fem::FootwallError(
            fmt::format("mesh_file: the edges on the detachment that {} has up to x = {:.0f} m, "
                        "three cell_size_m beyond the right wall's last position, end at {:.0f} m, "
                        "allowed: at least {:.0f}; make its edges there shorter, or raise "
                        "elastic_base.refinements",
                        p.mesh_file.empty() ? "the mesh" : p.mesh_file, reach + 3.0 * p.cell_size,
                        interface.x.back(), reach));
    const std::size_t last = interface.x.size() - 1;
    const double spacing = hypotenuse(interface.x[last] - interface.x[last - 1],
                                      interface.y[last] - interface.y[last - 1]);
    return std::make_unique<ElasticBase>(std::move(interface),
                                         make_coupling_parameters(scene, parts, spacing));
}

/// Sum over the mesh file's content; 0 without such a file.
std::uint64_t checksum_of(const fem::FootwallRequest& request) {
    return request.mesh_file.empty() ? 0 : fnv1a(read_text_if_there(request.mesh_file));
}

/// Why a field is not one of linear elasticity, if so.
/// @param moment  when, as "500 m of extension"
std::optional<std::string> beyond_elasticity(const fem::Guard& guard, const std::string& moment) {
    const double strain = std::max(guard.strong_strain, guard.relaxed_strain);
    if (!(strain > strain_allowed || guard.rotation > rotation_allowed))
        return std::nullopt;
    return fmt::format(
        "the footwall is strained by {:.1f} % and turned by {:.1f} degrees at {}; linear "
        "elasticity means up to {:.0f} % and {:.1f} degrees. A greater "
        "elastic_base.young_modulus_pa, elastic_thickness_m or skin_thickness_m, or a smaller "
        "relaxation, stiffens it",
        100.0 * strain, guard.rotation * 180.0 / pi, moment, 100.0 * strain_allowed,
        rotation_allowed * 180.0 / pi);
}

std::string moment_text(const Clock& clock, const Motion& motion) {
    return motion.stages.empty()
               ? fmt::format("{:.0f} m of extension", clock.extension.m)
               : fmt::format("{:.0f} m of net extension after {:.0f} m of {}", clock.extension.m,
                             clock.travel.m, effects::stage::name_of_way(motion, clock.travel));
}

class ElasticBaseDriver final : public BaseDriver {
public:
    ElasticBaseDriver(const Scene& scene, const ModelParts& parts,
                      std::span<const std::unique_ptr<Event>> events,
                      std::vector<std::unique_ptr<Event>>& loads)
        : request_(make_footwall_request(scene, parts)), mesh_checksum_(checksum_of(request_)),
          rock_weight_(elastic_base(scene)->bending.crust_density * parts.gravity),
          footwall_(refusing([&] { return fem::make_footwall(request_); })),
          base_(refusing([&] { return make_elastic_base(scene, parts, *footwall_); })),
          loads_(refusing([&] {
              return FootwallLoads(*footwall_, *base_, make_footwall_loads(scene, parts, events),
                                   loads);
          })) {
        if (auto* const heat = find<thermal::Heat>(events))
            heat->cover_by([this](double x) {
                return thermal::Cover{loads_.cover(x), loads_.sediment(x)};
            });
        if (footwall_->stress_points().empty()) {
            if (const Calendar calendar = make_calendar(scene); !calendar.pauses().empty())
                loads.push_back(std::make_unique<PromptBase>(*base_, calendar));
            return;
        }
        if (const auto& temperature = elastic_base(scene)->isotherm) {
            auto moving = make_isotherm(scene, *temperature, events);
            isotherm_ = moving.get();
            loads.insert(loads.begin(), std::move(moving));
            return;
        }
        auto creep = std::make_unique<Creep>(*footwall_, *base_, loads_, make_calendar(scene),
                                             Travel(scene.extension.distance));
        creep_ = creep.get();
        // Before the loads: the base has moved under what they have been.
        loads.insert(loads.begin(), std::move(creep));
    }

    std::vector<std::string> description() const override {
        const fem::MeshFacts mesh = footwall_->mesh();
        return {fmt::format("elastic base: {} elements, {} unknowns, condensed to {} nodes of the "
                            "detachment",
                            mesh.cells, mesh.unknowns, base_->interface().x.size())};
    }

    BaseResponse& response() override { return *base_; }
    double take_seconds() override { return std::exchange(base_->seconds, 0.0); }

    void settle(State& state, const RigidBase& base, const CyclePhysics& physics,
                const Execution& execution, const Progress& progress) const override {
        base_->attach(state);
        if (!request_.mesh_file.empty())
            set_mesh_checksum(state, mesh_checksum_);
        loads_.prepare(state);
        find_contacts(state, base);
        base_->settle(state, base, physics, execution, progress);
    }

    void require_own(const State& state) override;

    BaseWindow end_window(State& state, const RigidBase& rigid) override;

    const fem::Footwall* recover(const State& state) override {
        require_own(state);
        solve_for_field(*footwall_, *base_, loads_, state);
        return footwall_.get();
    }

    std::optional<BaseCheck> check(const State& state) const override;

private:
    std::unique_ptr<MovingIsotherm> make_isotherm(const Scene& scene, double temperature,
                                                  std::span<const std::unique_ptr<Event>> events);
    IndependentSolution solve_on_finer_mesh(const State& state,
                                            std::span<const double> on_interface) const;

    fem::FootwallRequest request_;
    std::uint64_t mesh_checksum_;
    double rock_weight_; ///< N/m^3
    std::unique_ptr<fem::Footwall> footwall_;
    std::unique_ptr<ElasticBase> base_;
    FootwallLoads loads_;
    Creep* creep_ = nullptr;             ///< one of the run's events, where rock relaxes
    MovingIsotherm* isotherm_ = nullptr; ///< likewise, where strength ends at one
};

/// At places 10 km apart, where rock of the footwall has temperatures.
std::unique_ptr<MovingIsotherm>
ElasticBaseDriver::make_isotherm(const Scene& scene, double temperature,
                                 std::span<const std::unique_ptr<Event>> events) {
    constexpr double spacing = 10e3; // m
    std::vector<Point> line;
    for (const fem::Vector& p : request_.isotherm)
        line.push_back({p.x, p.y});
    const auto* const heat = dem::find<const thermal::Heat>(events);
    const double left = std::max(request_.left, heat ? heat->ends().left + spacing : 0.0);
    const double right = std::min(request_.right, heat ? heat->ends().right - spacing : 0.0);
    std::vector<double> places;
    for (double x = left; heat && x <= right; x += spacing)
        places.push_back(x);
    const IsothermNow now = [heat, temperature, places](const State& state, const RigidBase& base) {
        return thermal::isotherm(*heat, state, base, temperature, places);
    };
    return std::make_unique<MovingIsotherm>(
        *footwall_, *base_, loads_, std::move(line), now, std::max(500.0, request_.cell_size),
        heat ? heat->schedule() : Schedule(1e9, make_calendar(scene)));
}

void ElasticBaseDriver::require_own(const State& state) {
    const std::string& file = request_.mesh_file;
    const bool fits = base_->fits(state);
    if (fits && (file.empty() || mesh_checksum(state).value_or(mesh_checksum_) == mesh_checksum_)) {
        if (creep_)
            refusing([&] { creep_->go_on_with(state); });
        if (isotherm_)
            refusing([&] { isotherm_->go_on_with(state); });
        return;
    }
    if (!file.empty())
        throw UsageError(fmt::format("elastic_base.mesh_file: {} has changed since the run began, "
                                     "whose state belongs to the mesh of before; give the file "
                                     "back what it held, or begin again with --force",
                                     file));
    throw UsageError(fmt::format("elastic_base: the run was begun on another footwall, of {} nodes "
                                 "on the detachment and {} modes, now {} and {}; go on with the "
                                 "version that began it, or begin again with --force",
                                 state.base_nodes.rows(), mode_count(state),
                                 base_->interface().x.size(), base_->modes().count()));
}

/// Throws fem::FootwallError, also where the mesh's file is another by now.
IndependentSolution
ElasticBaseDriver::solve_on_finer_mesh(const State& state,
                                       std::span<const double> on_interface) const {
    if (checksum_of(request_) != mesh_checksum_)
        throw fem::FootwallError(request_.mesh_file + ": has changed since the run began");
    fem::FootwallRequest request = request_;
    request.step = creep_step(state).value_or(0.0);
    if (const auto known = isotherm(state))
        request.isotherm = isotherm_of(known->line);
    return solve_independently(request, base_->interface(), on_interface, loads_.elsewhere(state),
                               footwall_->stress_points());
}

/// A finer mesh that cannot be made costs the run these measures alone.
std::optional<BaseCheck> ElasticBaseDriver::check(const State& state) const {
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
    IndependentSolution fine;
    try {
        fine = solve_on_finer_mesh(state, on_interface);
    } catch (const fem::FootwallError& error) {
        return BaseCheck{{},
                         fmt::format("warning: elastic_base: the base cannot be solved for on a "
                                     "finer mesh, so that {} and {} are not known: {}",
                                     effects::base_elements_difference,
                                     effects::base_resolved_difference, error.what())};
    }
    const double elements = relative_difference(base_->displacement(all), fine.displacement);
    const double base = relative_difference(now, fine.displacement);
    return BaseCheck{
        {{effects::base_elements_difference, elements}, {effects::base_resolved_difference, base}},
        fmt::format("the base under the last window's mean forces, solved again with {} unknowns: "
                    "the run's elements are {:.2f} % off, its base {:.2f} %",
                    fine.unknowns, 100.0 * elements, 100.0 * base)};
}

BaseWindow ElasticBaseDriver::end_window(State& state, const RigidBase& rigid) {
    const WindowBalance window = base_->window(state);
    const InterfaceBalance balance = interface_balance(state, rigid);
    const fem::Guard guard = recover(state)->guard(rock_weight_);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const bool moved = window.cycles > 0.0, loaded = std::abs(window.weight_change) > 0.0;
    BaseWindow end;
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
    end.beyond_elasticity = beyond_elasticity(guard, moment_text(state.clock, rigid.motion));
    base_->end_window(state);
    return end;
}

} // namespace

std::unique_ptr<BaseDriver> make_elastic_base_driver(const Scene& scene, const ModelParts& parts,
                                                     std::span<const std::unique_ptr<Event>> events,
                                                     std::vector<std::unique_ptr<Event>>& loads) {
    return std::make_unique<ElasticBaseDriver>(scene, parts, events, loads);
}

} // namespace listric
