#include "apps/measures/run_so_far.hpp"

#include <cassert>

namespace listric::measures {

using namespace dem;

namespace {

/// Discs of an earlier field that are still there.
ShearField only_present(ShearField field, const DiscPlaces& now) {
    const auto columns = {&field.x,  &field.y,  &field.xx, &field.xy,
                          &field.yx, &field.yy, &field.dx, &field.dy};
    std::size_t kept = 0;
    for (std::size_t k = 0; k < field.x.size(); ++k) {
        if (now.row_of[static_cast<std::size_t>(field.id[k])] < 0)
            continue;
        field.id[kept] = field.id[k];
        for (auto* values : columns)
            (*values)[kept] = (*values)[k];
        ++kept;
    }
    for (auto* values : columns)
        values->resize(kept);
    field.id.resize(kept);
    return field;
}

} // namespace

RunSoFar::RunSoFar(const Setting& the_setting, const RigidBase& the_base, const State& state,
                   std::span<const Past> before)
    : setting(the_setting), base(the_base), detachment(base_line(the_base, 0.0)), now(state),
      past(before), discs(disc_columns(state)), places(state),
      profile(measure_profile(the_setting, state, the_base)), diameter(2.0 * state.mean_radius),
      travel(state.clock.travel), extension(state.clock.extension),
      cycle(the_base.motion.greatest_wall_speed() * state.clock.time_step) {
    if (!past.empty())
        last_window = shear_field(past.back().places, places,
                                  setting.way_of_loose_sediment(places.travel), base.motion);
}

ShearField RunSoFar::window(std::size_t k) const {
    assert(k < past.size());
    return k + 1 < past.size()
               ? only_present(shear_field(past[k].places, past[k + 1].places,
                                          setting.way_of_loose_sediment(past[k + 1].places.travel),
                                          base.motion),
                              places)
               : last_window;
}

const DiscPlaces& RunSoFar::end_of_window(std::size_t k) const {
    return k + 1 < past.size() ? past[k + 1].places : places;
}

std::size_t RunSoFar::row(const ShearField& field, std::size_t k) const {
    const std::int32_t row = places.row_of[static_cast<std::size_t>(field.id[k])];
    assert(row >= 0);
    return static_cast<std::size_t>(row);
}

} // namespace listric::measures
