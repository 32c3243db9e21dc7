#pragma once

#include "apps/scene/effect.hpp"
#include "apps/support/moment_names.hpp"
#include "coupling/elastic_base.hpp"
#include "coupling/footwall_loads.hpp"
#include "dem/base.hpp"
#include "dem/cycle/cycle.hpp"
#include "dem/event.hpp"
#include "dem/state.hpp"
#include "fem/footwall.hpp"

#include <cassert>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace listric {

/// The footwall is strained or turned by more than linear elasticity can mean.
struct BeyondElasticity : dem::NumericalFailure {
    using dem::NumericalFailure::NumericalFailure;
};

class FootwallCoupling;

/// The field of the whole footwall at a moment. The footwall holds one: this is valid until
/// another moment's is recovered.
class RecoveredField {
public:
    double extension() const { return extension_; } ///< of the moment, m

    fem::Field field() const { return current().field(); }
    std::vector<fem::StressPatch> stress() const { return current().stress(); }
    fem::Guard guard(double rock_weight) const { return current().guard(rock_weight); } ///< N/m^3

private:
    friend FootwallCoupling;
    RecoveredField(const FootwallCoupling& source, int number, double extension)
        : source_(&source), number_(number), extension_(extension) {}
    const fem::Footwall& current() const;

    const FootwallCoupling* source_;
    int number_;
    double extension_;
};

/// The elastic footwall of a run: made from the scene when the run starts or resumes. All that it
/// remembers is in the state and in the events of its loads.
class FootwallCoupling {
public:
    /// Loads the plug-in. Appends the events of the loads, for the run to apply, to `events`: they
    /// and this refer to each other. Throws UsageError where no footwall can be made, StorageError.
    FootwallCoupling(const Scene& scene, const ModelParts& parts,
                     std::vector<std::unique_ptr<dem::Event>>& events);
    FootwallCoupling(const FootwallCoupling&) = delete;
    FootwallCoupling& operator=(const FootwallCoupling&) = delete;

    coupling::ElasticBase& base() { return *base_; }

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

    struct WindowEnd {
        coupling::NamedValues measures; ///< of the window, as columns of history.csv
        /// Why the run must not go on: the field is beyond linear elasticity.
        std::optional<std::string> beyond_elasticity;
    };

    /// Ends a window of extension and begins the next. Recovers the field of the whole footwall
    /// for the strains.
    WindowEnd end_window(dem::State& state, const dem::RigidBase& rigid);

    /// The field of the whole footwall at that moment.
    RecoveredField recover(const dem::State& state);

    /// Writes the field below the discs for ParaView: a file per moment in `output`/paraview and
    /// footwall.pvd, which has this moment and the ends of windows. Throws StorageError.
    void write(const std::filesystem::path& output, const RecoveredField& field,
               const MomentNames& names) const;

private:
    friend RecoveredField;

    fem::FootwallRequest request_;
    double rock_weight_;    ///< N/m^3
    double extension_rate_; ///< m/a
    std::unique_ptr<fem::Footwall> footwall_;
    std::unique_ptr<coupling::ElasticBase> base_;
    coupling::FootwallLoads loads_;
    int solutions_ = 0; ///< number of the field that the footwall holds
};

inline const fem::Footwall& RecoveredField::current() const {
    assert(number_ == source_->solutions_ && "another field was recovered since");
    return *source_->footwall_;
}

} // namespace listric
