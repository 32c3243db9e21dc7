#pragma once

#include "apps/run/forecast/prediction.hpp"
#include "apps/scene/parameters/effect.hpp"

#include <string>

namespace listric {

/// "40 s", "3.1 min", "2.0 h"
std::string duration(double seconds);

/// "30 MB", "1.2 GB"
std::string size_text(double bytes);

/// "21 snapshots, 130 MB of disk"
std::string output_text(const Prediction& prediction);

/// The model and its cost on this machine, as text.
/// @param speed    with that many threads
/// @param effects  all that there are
std::string explain(const Scene& scene, const CycleSpeed& speed, int threads, EffectList effects);

/// The model and its cost at the speed that is measured now.
std::string explain(const Scene& scene, int threads, EffectList effects);

} // namespace listric
