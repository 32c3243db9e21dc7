#pragma once

#include "apps/scene/parameters/parameter.hpp"
#include "dem/material.hpp"
#include "fluid/pore_law.hpp"

// Parameters of what several tables have, or what stands inside a table.

namespace listric {

/// Parameters of one arc or line of the detachment.
const std::vector<Parameter>& segment_parameters(dem::DetachmentSegment::Kind kind);

/// Parameters of one layer of rock below the hanging wall.
const std::vector<Parameter>& layer_parameters();

/// Parameters of a horizon or fault that was picked.
const std::vector<Parameter>& picked_line_parameters();

/// How sediment compacts and lets water through, [pores], of SedimentPores.
const std::vector<Parameter>& pore_parameters();

/// Microproperties, [material], of the Material at a path of members; no path: of a Material.
template <auto... Path> std::vector<Parameter> material_parameters() {
    using dem::Material;
    return {
        {"normal_stiffness_pa", at<Path..., &Material::normal_stiffness>, "Pa", ranges::stiffness,
         "k_n", "normal stiffness of one disc",
         "Raising it stiffens the rock (Young's modulus) and shortens the time step.",
         between(8.5e10, 1.9e11)},
        {"shear_stiffness_pa", at<Path..., &Material::shear_stiffness>, "Pa", ranges::stiffness,
         "k_s", "shear stiffness of one disc",
         "Raising it toward the normal stiffness lowers Poisson's ratio of the rock.",
         between(1.4e10, 6.4e10)},
        {"friction", at<Path..., &Material::friction>, "", ranges::friction, "mu_d",
         "friction of a disc; a contact has the smaller of its two discs'",
         "Raising it makes rock stronger under pressure, and lets it dilate where it shears.",
         between(0.05, 2.8)},
        {"rolling_friction", at<Path..., &Material::rolling_friction>, "", ranges::friction, "mu_r",
         "resistance to rolling of unbonded contacts: tangent of the slope on which a disc rests; "
         "the smaller of two discs', and no more than friction",
         "Raising it makes sand stronger than the 34 degrees that round discs reach; 0 costs "
         "nothing.",
         between(0, 0.5)},
    };
}

/// Strengths of contact bonds, [bonds], of the BondStrength at a path of members.
template <auto... Path> std::vector<Parameter> bond_parameters() {
    using dem::BondStrength;
    return {
        {"tensile_strength_pa", at<Path..., &BondStrength::tensile_mean>, "Pa", ranges::strength,
         "F_c^n", "mean tensile strength",
         "Raising it raises cohesion: fewer bonds break, and deformation is more localised.",
         between(2e4, 2.5e7)},
        {"tensile_strength_sd_pa", at<Path..., &BondStrength::tensile_deviation>, "Pa",
         ranges::strength, "", "standard deviation of the tensile strength",
         "Raising it scatters the first cracks over the rock.", between(5e3, 6.2e6)},
        {"shear_strength_pa", at<Path..., &BondStrength::shear_mean>, "Pa", ranges::strength,
         "F_c^s", "mean shear strength",
         "Far above the tensile strength it lets bonds break in tension only, so that strength "
         "grows with pressure.",
         between(2e8, 2e9)},
        {"shear_strength_sd_pa", at<Path..., &BondStrength::shear_deviation>, "Pa",
         ranges::strength, "", "standard deviation of the shear strength",
         "Matters only where bonds break in shear, which is rare.", between(5e7, 5e8)},
        {"strength_is", one_of<Path..., &BondStrength::reading>({"stress", "force"}), "",
         ranges::any, "", "strengths are stresses on the mean disc section, or forces in N",
         "With \"force\" and the paper's numbers bonds fail under the weight of the rock."},
    };
}

/// Porosity of fresh sediment, at a path of members.
template <auto... Path> Parameter surface_porosity_parameter() {
    return {"surface_porosity",
            at<Path...>,
            "",
            between(0, 0.9),
            "Phi_ini",
            "porosity of fresh sediment",
            "Raising it makes fresh sediment lighter, and lets it compact more."};
}

/// Decay of porosity with depth, 1/m, at a path of members.
template <auto... Path> Parameter porosity_decay_parameter() {
    return {"coefficient_per_km",
            at<Path...>,
            "1/km",
            between(0, 10),
            "c",
            "decay of porosity with depth",
            "Raising it compacts sediment more, so that the basin takes more of it.",
            {},
            1e3};
}

/// How sediment lets water through, of the Permeability at a path of members.
template <auto... Path> std::vector<Parameter> permeability_parameters() {
    using fluid::Permeability;
    return {
        {"permeability_m2",
         at<Path..., &Permeability::at_fifth>,
         "m2",
         {.from = 1e-22, .to = 1e-12, .reason = "1e-18 is mud, 1e-15 silt; 1 darcy is 1e-12"},
         "",
         "permeability of sediment at a porosity of 0.2; of law mudstone not used",
         "Lowering it keeps water in the pores: pressure rises, sediment stays porous and light.",
         between(1e-20, 1e-13)},
        {"permeability_law",
         one_of<Path..., &Permeability::law>({"kozeny_carman", "constant", "mudstone"}), "",
         ranges::any, "",
         "how permeability falls with porosity: kozeny_carman, constant, or mudstone [Yang and "
         "Aplin 2010], which follows from the clay fraction",
         "\"constant\" lets fresh mud drain too slowly: pressure is greatest near the ground."},
        {"clay_fraction", at<Path..., &Permeability::clay_fraction>, "", between(0.12, 0.97), "",
         "clay of law mudstone: mass below 2 micrometres, over all",
         "Raising it lowers permeability by some orders of magnitude."},
    };
}

} // namespace listric
