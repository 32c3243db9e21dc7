#pragma once

#include "apps/laboratory/sample.hpp"
#include "apps/scene/parameters/material_file.hpp"

#include <optional>
#include <vector>

namespace listric {

/// The modified shear box [paper, Fig. 4e-h]: a long box of two halves that slide past each other;
/// between them the end walls tilt, so that shear is imposed on a zone.
struct ShearBoxParameters {
    double normal_stress = 50e6; ///< on the top, Pa, kept by a servo
    double zone_width = 600.0;   ///< m [paper]
    double speed = 0.25;         ///< of the halves past each other, m/s
    double largest_strain = 0.5; ///< displacement over zone width
};

/// Filling of the box.
struct ShearBoxFilling {
    RockMaterial zone;
    std::optional<RockMaterial> vice; ///< none: the zone's rock everywhere
    bool elastic_vice = false;        ///< its bonds never break
};

/// A moment of a shear-box test.
struct ShearPoint {
    double strain;        ///< displacement of the halves over the zone's nominal width
    double shear_stress;  ///< from the forces on the walls of the halves, Pa
    double normal_stress; ///< Pa
    double zone_width;    ///< of what the loaded zone is now, m
    double broken;        ///< share of the bonds between discs outside the zone
};

/// Mean horizontal displacement of the discs that started at a height.
struct ShearProfilePoint {
    double y, displacement; ///< m; y from the middle of the zone
};

struct ShearTest {
    std::vector<ShearPoint> curve;
    std::vector<ShearProfilePoint> profile; ///< at the end
    double broken_by_loading = 0.0;         ///< share of the bonds outside the zone
    double collapse = 0.0;                  ///< of the sample under the normal stress, m

    /// Shear stress over normal stress, mean between two strains.
    double bulk_friction(double from, double to) const;
    /// The greatest, of means over a hundredth of strain.
    double peak_friction() const;
    /// Share of the displacement that happens within the zone.
    double share_in_zone(double zone_width) const;
};

/// Shears a settled sample.
ShearTest shear(Specimen sample, const ShearBoxFilling& filling, const ShearBoxParameters& p);

} // namespace listric
