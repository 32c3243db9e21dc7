#pragma once

#include "dem/base.hpp"
#include "dem/state.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace listric::measures {

/// Thickness of a layer of rock in columns along the section: power cells of its discs over the
/// columns' width, whatever lies between them.
struct LayerThickness {
    double area = 0.0;             ///< of all its power cells, m^2
    std::vector<double> x;         ///< middles of the columns that have some of it, m
    std::vector<double> depth;     ///< of the layer's middle in them, m
    std::vector<double> thickness; ///< m
};

/// Thickness of every layer in the order of the scene; the state has the column `layer`.
/// @param layers  how many there are
std::vector<LayerThickness> layer_thickness(const dem::State& state, const dem::RigidBase& base,
                                            std::size_t layers);

/// Mean shear along the bedding since the start, its sign left out.
struct BeddingShear {
    double in_layers = 0.0;
    double between = 0.0; ///< in rock of no layer between the highest and the lowest layer
};

/// Bedding was level at the start: with F the deformation gradient of what was within one and a
/// half mean diameters of a disc, t the direction of F e_x and n its normal, the shear is
/// (F e_y t) / (F e_y n), the tangent of the angle by which a line across the bedding has turned
/// against it. Counted up to 3, where rock is torn apart. None without layers, or without rock
/// between two of them.
std::optional<BeddingShear> bedding_shear(const dem::State& state);

} // namespace listric::measures
