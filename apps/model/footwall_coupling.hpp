#pragma once

#include "apps/scene/scene.hpp"
#include "coupling/elastic_base.hpp"
#include "coupling/footwall_loads.hpp"
#include "coupling/independent_solution.hpp"
#include "dem/base.hpp"
#include "dem/cycle.hpp"
#include "dem/state.hpp"
#include "fem/footwall.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace listric {

/// The footwall is strained or turned by more than linear elasticity can mean.
struct BeyondElasticity : dem::NumericalFailure {
    using dem::NumericalFailure::NumericalFailure;
};

/// The elastic footwall of a run: made from the scene when the run starts or resumes. All that it
/// remembers is in the state.
class FootwallCoupling {
public:
    /// Loads the plug-in. Throws UsageError where no footwall can be made, StorageError.
    explicit FootwallCoupling(const Scene& scene);

    coupling::ElasticBase& base() { return *base_; }

    /// Effects that load the footwall, for the run to apply: to be called once.
    std::vector<std::unique_ptr<dem::Event>> make_events();

    /// Solves for the base under the mean forces of the last window on a mesh twice as fine; none
    /// before a window has ended.
    struct Check {
        std::size_t unknowns; ///< of that mesh
        double elements;      ///< from the run's own elements under the same forces
        double base;          ///< from the base's mean displacement in that window
    };
    std::optional<Check> check(const dem::State& state) const;

    /// What is said in the log about it, a line each.
    std::vector<std::string> description() const;

    /// The measures of the window that ends, as columns of history.csv, and begins the next window.
    /// Recovers the field of the whole footwall for the strains. Throws BeyondElasticity.
    std::vector<std::pair<std::string, double>> end_window(dem::State& state,
                                                           const dem::RigidBase& rigid);

    /// The field of the whole footwall at that moment.
    const fem::Footwall& recover(const dem::State& state);

    /// Writes the field below the discs, as it was recovered last, for ParaView: a file per moment
    /// in `output`/paraview and footwall.pvd.
    void write(const std::filesystem::path& output, const dem::State& state) const;

private:
    double share_of_extension(const dem::State& state) const;
    fem::Load other_loads(const dem::State& state) const;

    const Scene& scene_;
    coupling::FootwallResponses responses_;
    const coupling::FootwallErosion* erosion_ = nullptr; ///< of the run's events
    std::unique_ptr<fem::Footwall> footwall_;
    std::unique_ptr<coupling::ElasticBase> base_;
};

/// The footwall's measures over a run for summary.json, from its history and its end.
std::vector<std::pair<std::string, double>> footwall_summary(const dem::Table& history,
                                                             const dem::State& state);

} // namespace listric
