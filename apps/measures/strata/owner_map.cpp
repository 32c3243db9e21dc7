#include "apps/measures/strata/owner_map.hpp"

#include "dem/base/place.hpp"
#include "dem/contacts/power_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace listric::measures {

using namespace dem;

RockSpace::RockSpace(const Setting& setting, const RigidBase& base, const State& state)
    : floor(standing_base(base, state).surfaces.front().chain),
      // The backstop follows the breakaway; a box's floor goes on beyond its walls.
      left(setting.has_detachment ? floor.front().start.x : 0.0),
      right(setting.length + wall_way(base, state.clock.extension.m)) {}

double RockSpace::inside(Point p) const {
    return std::min({p.y - height_at(floor, p.x), p.x - left, right - p.x});
}

namespace {

/// Calls visit(index, dx, dy) for the places of a map within `reach` of a point.
template <class Visit>
void for_each_place(const OwnerMap& map, Point centre, double reach, Visit&& visit) {
    const auto first = [&](double low, double corner) {
        return static_cast<std::size_t>(std::max(0.0, std::ceil((low - corner) / map.spacing)));
    };
    for (std::size_t row = first(centre.y - reach, map.corner.y); row < map.rows; ++row) {
        const double dy = map.place(0, row).y - centre.y;
        if (dy > reach)
            break;
        for (std::size_t column = first(centre.x - reach, map.corner.x); column < map.columns;
             ++column) {
            const double dx = map.place(column, row).x - centre.x;
            if (dx > reach)
                break;
            if (dx * dx + dy * dy <= reach * reach)
                visit(row * map.columns + column, dx * dx + dy * dy);
        }
    }
}

/// Gives every place to the disc of least power that is within `reach` of its rim.
void give_to_discs(OwnerMap& map, const State& state, double reach) {
    const ConstDiscColumns d = disc_columns(state);
    const std::vector<double> radius = rock_radii(state);
    std::vector<double> least(map.owner.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < d.x.size(); ++i)
        for_each_place(map, {d.x[i], d.y[i]}, radius[i] + reach,
                       [&](std::size_t at, double square) {
                           const double power = square - radius[i] * radius[i];
                           if (map.owner[at] != OwnerMap::outside && power < least[at]) {
                               least[at] = power;
                               map.owner[at] = static_cast<std::int32_t>(i);
                           }
                       });
}

/// The places of the air that can be reached from above; all other air becomes `outside`.
std::vector<std::size_t> open_air(OwnerMap& map) {
    std::vector<bool> seen(map.owner.size(), false);
    std::vector<std::size_t> found;
    const auto see = [&](std::size_t at) {
        if (map.owner[at] == OwnerMap::air && !seen[at]) {
            seen[at] = true;
            found.push_back(at);
        }
    };
    for (std::size_t column = 0; column < map.columns; ++column)
        see((map.rows - 1) * map.columns + column);
    for (std::size_t next = 0; next < found.size(); ++next) {
        const std::size_t at = found[next], column = at % map.columns, row = at / map.columns;
        if (column > 0)
            see(at - 1);
        if (column + 1 < map.columns)
            see(at + 1);
        if (row > 0)
            see(at - map.columns);
        if (row + 1 < map.rows)
            see(at + map.columns);
    }
    for (std::size_t at = 0; at < seen.size(); ++at)
        if (map.owner[at] == OwnerMap::air && !seen[at])
            map.owner[at] = OwnerMap::outside;
    return found;
}

/// Moves the free surface, which is `reach` above the discs, down by as much.
void lower_surface(OwnerMap& map, const std::vector<std::size_t>& air, double reach) {
    const auto is_rock = [&](std::size_t at) { return map.owner[at] >= 0; };
    std::vector<std::size_t> shore;
    for (const std::size_t at : air) {
        const std::size_t column = at % map.columns;
        if ((column > 0 && is_rock(at - 1)) || (column + 1 < map.columns && is_rock(at + 1)) ||
            (at >= map.columns && is_rock(at - map.columns)) ||
            (at + map.columns < map.owner.size() && is_rock(at + map.columns)))
            shore.push_back(at);
    }
    for (const std::size_t at : shore)
        for_each_place(map, map.place(at % map.columns, at / map.columns), reach,
                       [&](std::size_t near, double) {
                           if (is_rock(near))
                               map.owner[near] = OwnerMap::air;
                       });
}

} // namespace

OwnerMap::OwnerMap(const State& state, const RockSpace& room, double fineness) : spacing(fineness) {
    const ConstDiscColumns d = disc_columns(state);
    const double margin = 6.0 * state.mean_radius;
    const auto [bottom, top] = std::ranges::minmax(d.y);
    corner = {room.left - margin, bottom - margin};
    columns = static_cast<std::size_t>((room.right + margin - corner.x) / spacing) + 1;
    rows = static_cast<std::size_t>((top + margin - corner.y) / spacing) + 1;
    owner.assign(columns * rows, air);
    for (std::size_t column = 0; column < columns; ++column) {
        const double x = place(column, 0).x;
        const double ground = x < room.left || x > room.right ? std::numeric_limits<double>::max()
                                                              : height_at(room.floor, x);
        for (std::size_t row = 0; row < rows && place(column, row).y < ground; ++row)
            owner[row * columns + column] = outside;
    }
    // A reach of half a mean radius keeps the area of the topmost stratum, by its solid
    // share, within 2 %; the whole adds 3 %.
    const double reach = 0.5 * state.mean_radius;
    give_to_discs(*this, state, reach);
    lower_surface(*this, open_air(*this), reach);
}

} // namespace listric::measures
