#include "dem/pushes.hpp"

namespace listric::dem {

void add_pushes(State& state) {
    for (const char* name : {"push_x", "push_y"})
        state.discs.add<double>(name, "N", 0.0);
}

} // namespace listric::dem
