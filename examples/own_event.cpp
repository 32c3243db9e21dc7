// An event of one's own: an old fault, along which rock never heals. Prints how many bonds it has
// broken in 500 m of extension. Its `memory` is saved, resumed and hashed as all else.

#include <listric/dem.hpp>

#include <cstdio>
#include <utility>

using namespace listric::dem;

/// Breaks the bonds that cross a line of the rock that dips by 60 degrees from 16 km.
class OldFault : public Event {
public:
    explicit OldFault(double rate) : Event("old_fault", {2.5e3, rate}, Stage::weaken) {
        memory.add<double>("broken", "1", 0.0);
        memory.resize(1);
    }

    bool apply(State& state, const RigidBase&) override {
        const auto d = disc_columns(state);
        const auto c = contact_columns(state);
        const auto above = [&](auto k) { return d.start_x[k] > 16e3 - d.start_y[k] / 1.73; };
        for (std::size_t k = 0; k < c.bonded.size(); ++k)
            if (above(c.first[k]) != above(c.second[k]))
                memory.get<double>("broken")[0] += std::exchange(c.bonded[k], 0);
        return false; // no disc has moved
    }
};

int main() {
    Model model{.hanging_wall = {.mean_radius = 250.0},
                .detachment = {.segments = {arc_to_dip(0.0, 15e3), straight(60e3)}}};
    model.bond_healing.emplace();
    Simulation sandbox = make_simulation(model);
    const auto& fault = sandbox.add<OldFault>(model.rate);
    sandbox.begin(make_hanging_wall(model));
    sandbox.extend_to(500.0);
    std::printf("%.0f bonds broken\n", fault.memory.get<double>("broken")[0]);
}
