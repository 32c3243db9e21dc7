#pragma once

#include "dem/event.hpp"
#include "dem/target_line.hpp"

namespace listric::dem {

/// Loss of sediment volume with burial, Phi = Phi_ini exp(-c depth) [paper; Baldwin & Butler 1985].
struct CompactionParameters {
    /// Time between compactions, a. The paper's 2,500 a shrink shallow discs by more than they
    /// overlap: all contacts open and bonds of cemented sediment break.
    double interval = 500.0;
    double coefficient = 4e-4; ///< c, 1/m (Table 1 prints 0.4 with unit 1/m; it is 1/km)
};

/// Shrinks sediment discs as they are buried; mass is kept and uplift restores nothing.
class Compaction : public Event {
public:
    /// @param surface  that sediment is buried under
    Compaction(const CompactionParameters& parameters, double surface_porosity, Target surface,
               double extension_rate);

    void begin(State& state) override;
    bool apply(State& state, const RigidBase& base) override;

private:
    CompactionParameters parameters_;
    double surface_porosity_;
    Target surface_;
};

} // namespace listric::dem
