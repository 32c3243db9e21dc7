#pragma once

#include "apps/scene/parameter.hpp"
#include "dem/material.hpp"

// Parameters of what several tables have, or what stands inside a table.

namespace listric {

/// Of one arc or line of the detachment.
const std::vector<Parameter>& segment_parameters(dem::DetachmentSegment::Kind kind);

/// Of one layer of rock below the hanging wall.
const std::vector<Parameter>& layer_parameters();

/// Of a horizon or fault that was picked.
const std::vector<Parameter>& picked_line_parameters();

/// Microproperties, [material], of the Material at a path of members; no path: of a Material.
template <auto... Path> std::vector<Parameter> material_parameters() {
    using dem::Material;
    return {
        {"normal_stiffness_pa", at<Path..., &Material::normal_stiffness>, "Pa", ranges::stiffness,
         "k_n", "normal stiffness of one disc"},
        {"shear_stiffness_pa", at<Path..., &Material::shear_stiffness>, "Pa", ranges::stiffness,
         "k_s", "shear stiffness of one disc"},
        {"friction", at<Path..., &Material::friction>, "", ranges::friction, "mu_d",
         "of a disc; a contact has the smaller of its two discs'"},
    };
}

/// Strengths of contact bonds, [bonds], of the BondStrength at a path of members.
template <auto... Path> std::vector<Parameter> bond_parameters() {
    using dem::BondStrength;
    return {
        {"tensile_strength_pa", at<Path..., &BondStrength::tensile_mean>, "Pa", ranges::strength,
         "F_c^n", "mean tensile strength"},
        {"tensile_strength_sd_pa", at<Path..., &BondStrength::tensile_deviation>, "Pa",
         ranges::strength, "", "standard deviation of the tensile strength"},
        {"shear_strength_pa", at<Path..., &BondStrength::shear_mean>, "Pa", ranges::strength,
         "F_c^s", "mean shear strength"},
        {"shear_strength_sd_pa", at<Path..., &BondStrength::shear_deviation>, "Pa",
         ranges::strength, "", "standard deviation of the shear strength"},
        {"strength_is",
         one_of<Path..., &BondStrength::reading>({"stress", "force"}),
         "",
         {},
         "",
         "strengths are stresses on the mean disc section, or forces in N"},
    };
}

} // namespace listric
