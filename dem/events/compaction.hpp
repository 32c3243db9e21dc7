#pragma once

#include "dem/beds.hpp"
#include "dem/event.hpp"

namespace listric::dem {

/// Loss of sediment volume with burial, Phi = Phi_ini exp(-c depth) [paper; Baldwin & Butler 1985].
struct CompactionParameters {
    double interval = 2.5e3;   ///< time between looks at the depth of burial, a
    double coefficient = 4e-4; ///< c, 1/m (Table 1 prints 0.4 with unit 1/m; it is 1/km)
};

/// Lets sediment discs shrink as they are buried; mass is kept and uplift restores nothing.
///
/// At once, discs would shrink by more than they overlap: contacts open, bonds break, and the
/// column is held up by damping while it rings. So a disc shrinks a little in every cycle, toward
/// what its depth asks for.
///
/// A layer that is laid down at once buries discs by more than when it has compacted, and all above
/// them with it. Nothing restores porosity, so it follows from the depth that a disc will have
/// then: from the top down, its depth times the share of the discs above that compaction leaves.
///
/// Columns of discs: `porosity`, what it will be at the next application; radius_rate,
/// inertial_radius. Where there is a column `wanted_porosity`, discs shrink toward it instead.
class Compaction : public Event {
public:
    /// No disc shrinks faster than by this share of its radius, 1/s: overlaps of fresh sediment,
    /// which is buried by up to a layer when it is laid down, then last for some hundred cycles.
    static constexpr double fastest = 1e-3;
    /// Share of what it has to lose that a disc loses by the next application. Nothing gives it
    /// back, so neither a layer that is loose because it was just laid down nor a rough surface may
    /// count at once; but the slower it is, the more do stiff columns carry of what is around them.
    static constexpr double approach = 0.5;

    Compaction(const CompactionParameters& parameters, double surface_porosity,
               const Calendar& calendar, Beds beds = {});

    void begin(State& state) override;
    bool apply(State& state, const RigidBase& base) override;

private:
    CompactionParameters parameters_;
    double surface_porosity_;
    Beds beds_; ///< with laws of their own
};

} // namespace listric::dem
