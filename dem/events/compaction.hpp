#pragma once

namespace listric {

/// Loss of sediment volume with burial, Phi = Phi_ini exp(-c depth) [paper; Baldwin & Butler 1985].
struct CompactionParameters {
    double interval = 2.5e3;   ///< time between compactions, Delta t_d, a
    double coefficient = 4e-4; ///< c, 1/m (Table 1 prints 0.4 with unit 1/m; it is 1/km)
};

} // namespace listric
