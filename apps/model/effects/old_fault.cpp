#include "dem/events/old_faults.hpp"

#include "apps/model/effect_list.hpp"
#include "apps/scene/picks/old_fault.hpp"
#include "apps/scene/picks/picked_pieces.hpp"
#include "apps/scene/scene.hpp"
#include "apps/support/error.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"
#include "dem/numbers/hypotenuse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace listric::effects::old_fault {

namespace {

using F = OldFault;

std::vector<Parameter> parameters() {
    return {
        {"name", at<&F::name>, "", ranges::any, "", "name in messages", "Changes no run."},
        {"points", at<&F::points>, "", ranges::height, "",
         "points [x, depth] of the fault, straight between them",
         "Puts weak rock where the old fault is; new faults take other places."},
        {"band_width_diameters", at<&F::width>, "", between(0.01, 100), "",
         "width of its band, in mean disc diameters", "Raising it widens the fault.",
         between(2, 4)},
        {"lines", at<&F::lines>, "", ranges::any, "",
         "content of the file of csv, written by the program",
         "Puts weak rock where the old faults are."},
    };
}

std::string path_of(std::size_t item, std::string_view key) {
    return fmt::format("old_fault[{}].{}", item, key);
}

void take_csv(Scene& scene, std::size_t item, const std::string& file, const Refuse& refuse) {
    F& fault = (*scene.find<OldFaultList>())[item];
    if (!fault.points.empty())
        refuse(path_of(item, "csv"), "beside points; give one of them");
    const PickedFile picked = read_picked_lines(file, 0.0);
    fault.lines = picked.lines;
    std::ranges::copy(turns_back(picked), std::back_inserter(scene.warnings));
}

double width_of(const Scene& scene, const F& fault) {
    return fault.width * 2.0 * scene.hanging_wall.mean_radius;
}

/// Its lines, x and depth.
std::vector<std::pair<std::string, std::vector<dem::Point>>> lines_of(const F& fault) {
    std::vector<std::pair<std::string, std::vector<dem::Point>>> lines;
    if (!fault.points.empty())
        lines.emplace_back(fault.name, fault.points);
    for (const PickedLine& line : fault.lines) {
        std::vector<dem::Point> points;
        for (std::size_t k = 0; k < line.x.size() && k < line.depth.size(); ++k)
            points.push_back({line.x[k], line.depth[k]});
        lines.emplace_back(line.name, std::move(points));
    }
    return lines;
}

void check(const Scene& scene, const Refuse& refuse) {
    constexpr int samples = 100; // of a line between two points
    const OldFaultList& faults = *scene.find<OldFaultList>();
    const double right = scene.hanging_wall.length;
    const dem::Chain base = base_line(make_rigid_base(scene), 0.0);
    for (std::size_t k = 0; k < faults.size(); ++k) {
        const std::string table = fmt::format("old_fault[{}]", k);
        const auto lines = lines_of(faults[k]);
        if (lines.empty())
            refuse(table, "needs points, for example points = [[12000.0, 1000.0], [17000.0, "
                          "9000.0]], or csv");
        const double width = width_of(scene, faults[k]);
        for (const auto& [name, points] : lines) {
            const std::string what = name.empty() ? "the fault" : shown_start(name);
            if (points.size() < 2)
                refuse(table, fmt::format("{} has one point, needs at least two", what));
            double length = 0.0;
            bool is_inside = false;
            for (std::size_t p = 0; p < points.size(); ++p) {
                const dem::Point from = points[p > 0 ? p - 1 : 0], to = points[p];
                length += dem::hypotenuse(to.x - from.x, to.y - from.y);
                for (int s = 0; s <= samples; ++s) { // it may cross the wall, and end outside
                    const double share = static_cast<double>(s) / samples;
                    const dem::Point at{from.x + share * (to.x - from.x),
                                        from.y + share * (to.y - from.y)};
                    is_inside |= at.x >= 0.0 && at.x <= right && at.y >= 0.0 &&
                                 at.y <= -dem::height_at(base, at.x);
                }
            }
            if (!is_inside)
                refuse(table, fmt::format("{} is outside of the hanging wall, allowed: points from "
                                          "x = 0 to {}, between the original surface (depth 0) and "
                                          "the detachment",
                                          what, text(right)));
            if (length < width)
                refuse(table, fmt::format("{} is {:.4g} m long, shorter than its band is wide ({} "
                                          "m); lengthen it, or lower band_width_diameters",
                                          what, length, text(width)));
        }
    }
}

void add_events(const Scene& scene, const ModelParts& parts, dem::Events& events) {
    dem::OldFaultsParameters p;
    p.on_empty = [](const dem::OldFaultsParameters::Fault& fault) {
        throw SceneError(fmt::format(
            "{}: no disc of rock that faults can weaken has its centre in its band, {} m wide; "
            "raise band_width_diameters, move it out of layers with weakens_to = \"none\", or "
            "leave it out",
            fault.name, text(fault.width)));
    };
    const OldFaultList& faults = *scene.find<OldFaultList>();
    for (std::size_t k = 0; k < faults.size(); ++k)
        for (const auto& [name, points] : lines_of(faults[k])) {
            dem::OldFaultsParameters::Fault& line = p.faults.emplace_back();
            line.name = fmt::format("old_fault[{}]{}{}", k, name.empty() ? "" : ", ",
                                    name.empty() ? "" : shown_start(name));
            line.width = width_of(scene, faults[k]);
            for (const dem::Point& point : points)
                line.points.push_back({point.x, -point.y});
        }
    dem::add(events, std::make_unique<dem::OldFaults>(std::move(p), parts.physics.gravity));
}

std::string explain(const Scene& scene, EffectList) {
    std::size_t count = 0;
    for (const F& fault : *scene.find<OldFaultList>())
        count += lines_of(fault).size();
    return fmt::format("old faults\n  {} {} from the start\n", count,
                       count == 1 ? "is weak" : "are weak");
}

} // namespace

Works works() { return {}; }

const Effect& effect() {
    static const Effect effect{
        .name = "old_fault",
        .doc = "a fault of before extension: rock along it is weak from the start",
        .defaults = make_defaults<OldFaultList>,
        .address = address_of<OldFaultList>,
        .parameters = parameters(),
        .items = items_of<F>,
        .files = {{"csv",
                   "file with faults, as `listric export` writes it, in place of points: columns "
                   "name, x_m, depth_m and, of a fault in pieces, line",
                   "Stands in place of points.", nullptr, take_csv}},
        .needs = {"fault_weakening"},
        .check = check,
        .add_events = add_events,
        .explain = explain,
    };
    return effect;
}

} // namespace listric::effects::old_fault
