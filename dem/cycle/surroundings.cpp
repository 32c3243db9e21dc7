#include "dem/cycle/surroundings.hpp"

#include "dem/contacts/contacts.hpp"

namespace listric::dem {

ListUpdate Surroundings::update_lists(State& state, const RigidBase& base) {
    refuse_runaways(state);
    return update_contacts(state, base) ? ListUpdate::changed : ListUpdate::unchanged;
}

void Surroundings::respond(State& state, const Clock& clock, BaseResponse* response) {
    if (response && is_response_due(response->interval, clock))
        response->respond(state, clock);
}

} // namespace listric::dem
