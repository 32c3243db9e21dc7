#pragma once

namespace listric::dem {

/// Shares of the time of a cycle, in proportion: a contact between discs (1.9 ns on a Zen 5), a
/// disc, a contact with the base.
inline constexpr int contact_work = 2, disc_work = 3, base_contact_work = 21;

} // namespace listric::dem
