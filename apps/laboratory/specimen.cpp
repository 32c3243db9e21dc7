#include "apps/laboratory/specimen.hpp"

#include "dem/contacts/contacts.hpp"

namespace listric {

using namespace dem;

void Specimen::steer(std::size_t surface, Point velocity) {
    Surface& s = base.surfaces[surface];
    place(s, moved(s.chain, {s.translation.x * time(), s.translation.y * time()}), velocity,
          time());
}

void Specimen::reshape(std::size_t surface, const Chain& chain, Point velocity) {
    place(base.surfaces[surface], chain, velocity, time());
}

Point Specimen::place_of(std::size_t surface) const {
    const Surface& s = base.surfaces[surface];
    const Point start = s.chain.front().start;
    return {start.x + s.translation.x * time(), start.y + s.translation.y * time()};
}

void Specimen::advance(std::int64_t cycles) {
    stop.check();
    // Between searches the lists know surfaces by their present motion, traced back to the last
    // search. Steered surfaces were elsewhere then, but no further than this.
    surface_travel_ += greatest_translation(base) * static_cast<double>(cycles) *
                       state.clock.time_step * base.motion.speed;
    if (surface_travel_ > 0.1 * state.skin) {
        find_surface_contacts(state, base);
        surface_travel_ = 0.0;
    }
    dem::advance(state, base, physics, cycles, {1, cycle});
}

} // namespace listric
