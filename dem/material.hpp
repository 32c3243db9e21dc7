#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace listric::dem {

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

/// Index of a disc's material in State::materials. The order is fixed; materials of layers follow.
enum MaterialIndex : std::uint8_t { basement = 0, sediment = 1, weak = 2 };

/// Index of no material.
inline constexpr std::uint8_t no_material = 255;

/// Microproperties of the discs of one material [paper, Table 1]. What stands after `bondable` is
/// for materials that follow those of MaterialIndex, whose behaviour is fixed.
struct Material {
    double normal_stiffness = 1.7e11; ///< k_n of one disc, N/m per metre of thickness
    double shear_stiffness = 6.38e10; ///< k_s of one disc, N/m per metre of thickness
    double friction = 0.05;           ///< mu_d; a contact has the smaller of its two discs'
    bool bondable = true;             ///< whether contacts of this material may be bonded
    bool is_soft = false;  ///< its discs are enlarged, such that they keep their volume under load
    bool is_welded = true; ///< bonds may join it to other rock
    std::uint8_t weak_of = no_material;     ///< of weakened rock: the rock that it was
    std::optional<BondStrength> bonds = {}; ///< none: as strong as the hanging wall's
    double rolling_friction = 0.0; ///< mu_r, of any material; a contact has the smaller of two
};

/// Whether a material is weakened rock.
inline bool is_weak(std::span<const Material> materials, std::uint8_t m) {
    return m == weak || (m > weak && materials[m].weak_of != no_material);
}

/// Whether discs of a material are enlarged, such that they keep their volume under load.
inline bool is_soft(std::span<const Material> materials, std::uint8_t m) {
    return is_weak(materials, m) || (m > weak && materials[m].is_soft);
}

/// Weakened rock that a material becomes; `no_material` if it cannot be, or is weak already.
inline std::uint8_t weakened(std::span<const Material> materials, std::uint8_t m) {
    if (is_weak(materials, m))
        return no_material;
    if (m < weak)
        return weak;
    for (std::size_t k = weak + 1; k < materials.size(); ++k)
        if (materials[k].weak_of == m)
            return static_cast<std::uint8_t>(k);
    return no_material;
}

/// Whether a contact of discs of these materials may be bonded.
inline bool may_bond(std::span<const Material> materials, std::uint8_t a, std::uint8_t b) {
    return materials[a].bondable && materials[b].bondable &&
           (a == b || (materials[a].is_welded && materials[b].is_welded));
}

} // namespace listric::dem
