#pragma once

#include "apps/scene/parameters/effect.hpp"
#include "fem/footwall.hpp"

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace listric {

// Vocabulary of all painters, in C++, Python and JavaScript: classes of rock, colours, palettes,
// steps of scales and layers, of figures/vocabulary.json. Layers of effects stand in their
// descriptions.

/// The file. Throws StorageError.
nlohmann::ordered_json vocabulary();

/// Where the colours of a scale from 0 end: 99 of 100 values are below it, rounded up to a plain
/// number. Values that are not finite do not count.
double scale_end(std::vector<double> values);

/// Where that of shear strain ends: not below twice what a fault has somewhere, so that grains
/// which slide past each other in sediment that compacts have no fault's colours.
double strain_scale_end(std::vector<double> values);

/// Whether a patch of the footwall is within 60 km of the section, as deep and beside its ends, m.
bool is_near(const fem::StressPatch& patch, double right);

/// Its largest shear stress, MPa.
double largest_shear(const fem::StressPatch& patch);

/// Where the scale of the largest shear stress ends, MPa, by the patches near the section.
double shear_end(std::span<const fem::StressPatch> patches, double right);

/// The name of a layer's numbers, which no others have.
std::string data_name(const FigureLayer& layer);

/// Name of the data, kind, label and ink of the layers of a scene's effects.
nlohmann::json declared_layers(const Scene& scene);

} // namespace listric
