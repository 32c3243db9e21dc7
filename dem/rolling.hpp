#pragma once

#include "dem/columns.hpp"
#include "dem/state.hpp"

#include <algorithm>
#include <span>

namespace listric::dem {

/// Whether contacts remember how discs have rolled. Cycles are compiled with and without it.
inline bool resists_rolling(const State& state) {
    return state.contacts.has(columns::rolling_moment);
}

/// Gives contacts that memory, where a material resists rolling: column `rolling_moment`. Returns
/// whether it is new.
inline bool add_rolling(State& state) {
    if (resists_rolling(state) || std::ranges::none_of(state.materials, [](const Material& m) {
            return m.rolling_friction > 0.0 && m.friction > 0.0;
        }))
        return false;
    state.contacts.add(columns::rolling_moment);
    state.base_contacts.add(columns::rolling_moment);
    return true;
}

/// The moments of a table of contacts; an empty span where nothing resists rolling.
template <class AnyTable> auto rolling_moments(AnyTable& contacts) {
    return contacts.has(columns::rolling_moment)
               ? contacts.get(columns::rolling_moment)
               : decltype(contacts.get(columns::rolling_moment))();
}

} // namespace listric::dem
