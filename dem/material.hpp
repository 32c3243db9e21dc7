#pragma once

#include <cstdint>
#include <vector>

namespace listric::dem {

/// Microproperties of the discs of one material [paper, Table 1].
struct Material {
    double normal_stiffness = 1.7e11; ///< k_n of one disc, N/m per metre of thickness
    double shear_stiffness = 6.38e10; ///< k_s of one disc, N/m per metre of thickness
    double friction = 0.05;           ///< mu_d; a contact has the smaller of its two discs'
    bool bondable = true;             ///< whether bond healing may bond contacts of this material
};

/// Reading of the bond strengths in Table 1: a stress on the discs' mean section, or a force.
enum class StrengthReading { stress, force };

/// Contact-bond strengths, normally distributed over contacts [paper, Table 1: F_c^n, F_c^s].
struct BondStrength {
    double tensile_mean = 2.0e4;
    double tensile_deviation = 0.5e4;
    double shear_mean = 2.0e8;
    double shear_deviation = 0.5e8;
    StrengthReading reading = StrengthReading::stress;
};

/// Strength of bonds that never fail.
inline constexpr BondStrength unbreakable{1e30, 0.0, 1e30, 0.0, StrengthReading::force};

/// Index of a disc's material in State::materials. The order is fixed.
enum MaterialIndex : std::uint8_t { basement = 0, sediment = 1, weak = 2 };

} // namespace listric::dem
