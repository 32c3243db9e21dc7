#include "apps/measures/faults/offset/fault_offset.hpp"

#include "apps/measures/faults/fault_trace.hpp"
#include "apps/measures/rigid_motion.hpp"
#include "dem/base/place.hpp"
#include "dem/contacts/cells.hpp"
#include "dem/threads/shared_loop.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

constexpr std::size_t fewest_discs = 4;   ///< of a block beside a point
constexpr std::size_t shortest_piece = 4; ///< points of a line that others leave

/// The blocks beside a point of a line: ids of their discs, m.
struct Beside {
    std::vector<std::int64_t> hanging, footwall;
};

std::vector<std::int64_t> discs_around(Point centre, double reach, const DiscPlaces& discs,
                                       const Cells& cells) {
    std::vector<std::int64_t> ids;
    cells.for_each_near(centre.x, centre.y, [&](std::int32_t row) {
        const auto i = static_cast<std::size_t>(row);
        const Point away = Point{discs.x[i], discs.y[i]} - centre;
        if (dot(away, away) < reach * reach)
            ids.push_back(discs.id[i]);
    });
    return ids;
}

/// Discs 1.5 to 5.5 units off the line: nearer ones are in the zone itself.
Beside beside(const Polyline& line, std::size_t k, const DiscPlaces& discs, const Cells& cells,
              double unit) {
    const Point into = 3.5 * unit * footwall_normal(line, k);
    return {discs_around(line[k] - into, 2.0 * unit, discs, cells),
            discs_around(line[k] + into, 2.0 * unit, discs, cells)};
}

/// Where a point of a block was or will be; none where too few of its discs are there.
std::optional<Point> moved(Point p, const std::vector<std::int64_t>& ids, const DiscPlaces& from,
                           const DiscPlaces& to) {
    RigidMotion motion;
    for (const std::int64_t number : ids) {
        const auto id = static_cast<std::size_t>(number);
        if (id >= to.row_of.size() || to.row_of[id] < 0)
            continue;
        const auto i = static_cast<std::size_t>(from.row_of[id]);
        const auto j = static_cast<std::size_t>(to.row_of[id]);
        motion.add({from.x[i], from.y[i]}, {to.x[j], to.y[j]});
    }
    if (motion.size() < fewest_discs)
        return std::nullopt;
    motion.fit();
    return motion.move(p);
}

/// A line as its footwall carries it from one moment to another.
Polyline carried(const Polyline& line, const DiscPlaces& from, const DiscPlaces& to, double unit) {
    if (&from == &to)
        return line;
    const Cells cells(from.x, from.y, 3.0 * unit);
    Polyline points;
    for (std::size_t k = 0; k < line.size(); ++k)
        if (const auto p = moved(line[k], beside(line, k, from, cells, unit).footwall, from, to))
            points.push_back(*p);
    return points;
}

/// Pieces of a line that fall by 30 degrees or more and are no nearer to others than `spacing`, m;
/// nearer where they go on beyond an end.
std::vector<Polyline> pieces_off(const Polyline& line, const std::vector<OffsetFault>& others,
                                 double spacing) {
    std::vector<Polyline> pieces(1);
    for (std::size_t k = 0; k < line.size(); ++k) {
        const Point p = line[k];
        const bool is_off = std::ranges::none_of(others, [&](const OffsetFault& other) {
            const PolylinePlace place = place_on(other.points, p);
            return std::abs(place.distance) < (place.beyond ? 0.3 : 1.0) * spacing;
        });
        if (is_off && !is_low_angle({0.0, 0.0}, chord_at(line, k)))
            pieces.back().push_back(p);
        else if (!pieces.back().empty())
            pieces.emplace_back();
    }
    std::erase_if(pieces, [](const Polyline& piece) { return piece.size() < shortest_piece; });
    return pieces;
}

/// Offset at every point, each the mean with its neighbours.
std::vector<double> offsets_along(const Polyline& line, const DiscPlaces& now, const Cells& cells,
                                  std::span<const DiscPlaces> older, double unit) {
    std::vector<double> raw(line.size(), 0.0), smooth;
    for_each_shared(line.size(), [&](std::size_t k) {
        const Beside sides = beside(line, k, now, cells, unit);
        for (const DiscPlaces& then : older) {
            const auto hanging = moved(line[k], sides.hanging, now, then);
            const auto footwall = moved(line[k], sides.footwall, now, then);
            if (!hanging || !footwall)
                continue;
            raw[k] = hanging->y - footwall->y;
            break;
        }
    });
    for (std::size_t k = 0; k < raw.size(); ++k) {
        const std::size_t from = k - std::min<std::size_t>(k, 2), to = std::min(k + 3, raw.size());
        double sum = 0.0;
        for (std::size_t n = from; n < to; ++n)
            sum += raw[n];
        smooth.push_back(sum / static_cast<double>(to - from));
    }
    return smooth;
}

} // namespace

std::vector<OffsetFault> offset_faults(const Setting& setting, const RigidBase& base,
                                       const State& now, std::span<const DiscPlaces> older) {
    std::vector<OffsetFault> faults;
    if (older.empty())
        return faults;
    const Chain detachment = standing_base(base, now).surfaces.front().chain;
    const DiscPlaces discs(now);
    const double unit = unit_of_faults(2.0 * now.mean_radius, setting.thickness);
    const double spacing = FaultTraceOptions{}.spacing * unit;
    const Cells cells(discs.x, discs.y, 3.0 * unit);
    const auto add = [&](ShearField field, const DiscPlaces& end, bool is_active,
                         const FaultTraceOptions& options) {
        coarsen(field, unit);
        for (const FaultTrace& trace : trace_faults(field, detachment, options))
            for (Polyline& piece :
                 pieces_off(carried(trace.points, end, discs, unit), faults, spacing)) {
                std::vector<double> offset = offsets_along(piece, discs, cells, older, unit);
                faults.push_back({std::move(piece), std::move(offset), is_active});
            }
    };
    for (std::size_t k = older.size(); k-- > 0;) {
        const DiscPlaces& end = k + 1 < older.size() ? older[k + 1] : discs;
        add(shear_field(older[k], end, setting.way_of_loose_sediment(end.travel), setting.motion),
            end, &end == &discs, {});
    }
    // Faults of many small slips: strain of the whole run, with limits as of one window.
    ShearField whole = shear_field(older.front(), discs, {}, setting.motion);
    whole.window = Extension(strain_window);
    FaultTraceOptions options;
    options.least_length = 8.0;
    options.least_contrast = 2.5;
    add(std::move(whole), discs, false, options);
    return faults;
}

} // namespace listric::measures
