#include "apps/archive/tables/exports.hpp"

#include "apps/archive/folder/setting.hpp"
#include "apps/archive/tables/fault_fields.hpp"
#include "apps/measures/strata/cohesion.hpp"
#include "apps/measures/strata/horizons.hpp"
#include "apps/measures/strata/rock.hpp"
#include "apps/measures/strata/rock_layers.hpp"
#include "apps/support/fineness.hpp"
#include "apps/support/words/spelling.hpp"
#include "dem/base/place.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/monitor.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace listric::archive {

using namespace dem;
using namespace measures;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// To a millimetre, in small models less.
Point rounded(const ExportedMoment& at, Point p) {
    const double steps = 1e3 * fineness(at.now.state.mean_radius); // in a metre
    return {std::round(steps * p.x) / steps, std::round(steps * p.y) / steps};
}

std::vector<Point> rounded(const ExportedMoment& at, const Polyline& points) {
    std::vector<Point> result;
    for (const Point p : points)
        result.push_back(rounded(at, p));
    return result;
}

Setting setting_of(const ExportedMoment& at) { return make_setting(at.now.scene, at.now.parts); }

/// Points of a chain up to x = right: corners, and on what bends points one `spacing` apart.
Polyline points_of(const Chain& chain, double right, double spacing) {
    Polyline points{chain.front().start};
    double before = 0.0;
    for (const Segment& segment : chain) {
        const int steps =
            segment.curvature == 0.0 ? 1 : static_cast<int>(std::ceil(segment.length / spacing));
        for (int k = 1; k <= steps; ++k) {
            const Point p =
                k == steps ? segment.end : point_at(chain, before + segment.length * k / steps);
            if (p.x > right) {
                points.push_back({right, height_at(chain, right)});
                return points;
            }
            points.push_back(p);
        }
        before += segment.length;
    }
    return points;
}

Line fault_line(const ExportedMoment& at, std::size_t k, const std::set<int>& thrown) {
    const Fault& f = at.faults.faults[k];
    Line line{{}, rounded(at, f.trace.points)};
    for (const FaultField* field : exported_fault_fields()) {
        const nlohmann::ordered_json value = field->value({at.faults, k});
        line.values.push_back(value.is_string()   ? LineValue(value.get<std::string>())
                              : value.is_number() ? value.get<double>()
                                                  : none);
    }
    for (const int horizon : thrown) {
        const auto found = f.cutoffs.find(horizon);
        const bool is_known = found != f.cutoffs.end() && found->second.is_resolved;
        line.values.emplace_back(is_known ? found->second.height() : none);
        line.values.emplace_back(is_known ? found->second.error : none);
    }
    for (std::size_t p = 0; p < f.trace.points.size(); ++p)
        line.at_points.insert(line.at_points.end(), {f.trace.slip[p], f.trace.width[p]});
    return line;
}

} // namespace

std::vector<Horizon> horizons_of(const ExportedMoment& at) {
    return trace_horizons(setting_of(at), at.now.parts.base, at.now.state, at.faults.faults,
                          HorizonOptions());
}

LineTable horizons_table(const ExportedMoment& at) { return horizons_table(at, horizons_of(at)); }

LineTable horizons_table(const ExportedMoment& at, std::span<const Horizon> horizons) {
    LineTable table{"horizons", "stratum", {"name", "stratum", "deposited_at_a", "start_depth_m"}};
    const HorizonOptions options;
    const std::vector<LayerBoundary> boundaries = setting_of(at).boundaries;
    for (const Horizon& h : horizons) {
        const bool is_of_layer = h.stratum < 0 && !boundaries.empty();
        const double start_depth =
            h.stratum > 0 || is_of_layer ? none : -h.stratum * options.pre_rift_layer;
        const std::string name = h.stratum > 0    ? fmt::format("stratum {}", h.stratum)
                                 : h.stratum == 0 ? "pre-rift top"
                                 : is_of_layer
                                     ? boundaries[static_cast<std::size_t>(-h.stratum - 1)].name
                                     : fmt::format("pre-rift {} m", start_depth);
        for (const Polyline& piece : h.pieces)
            table.lines.push_back(
                {{name, static_cast<double>(h.stratum), h.deposited_at.value_or(none), start_depth},
                 rounded(at, piece)});
    }
    return table;
}

LineTable faults_table(const ExportedMoment& at) {
    LineTable table{"faults", std::string(field_rate), {}, {std::string(field_slip), "width_m"}};
    for (const FaultField* field : exported_fault_fields())
        table.columns.emplace_back(field->name);
    const FaultReport& report = at.faults;
    std::set<int> thrown;
    for (const Fault& f : report.faults)
        for (const auto& [horizon, value] : throws_of(f.cutoffs))
            thrown.insert(horizon);
    for (const int horizon : thrown)
        for (const char* column : {"throw_{}_m", "throw_{}_error_m"})
            table.columns.push_back(fmt::format(fmt::runtime(column), horizon));
    for (std::size_t k = 0; k < report.faults.size(); ++k)
        table.lines.push_back(fault_line(at, k, thrown));
    return table;
}

LineTable reference_surfaces_table(const ExportedMoment& at) {
    const State& state = at.now.state;
    const Setting setting = setting_of(at);
    LineTable table{"surfaces", "", {"name"}};
    const auto add = [&](const std::string& name, const Polyline& points) {
        table.lines.push_back({{name}, rounded(at, points)});
    };
    const double right = at.now.right_end();
    const Chain floor = standing_base(at.now.parts.base, state).surfaces.front().chain;
    add(setting.has_detachment ? "detachment" : "floor",
        points_of(floor, right, 2.0 * state.mean_radius));
    add("original surface", {{0.0, 0.0}, {right, 0.0}});
    if (setting.sediment) {
        const TargetLine target =
            setting.sediment->target.at(setting.calendar.age(state.clock.travel));
        Polyline points{{0.0, target.height(0.0)}};
        for (const Point p : target.points())
            if (p.x > 0.0 && p.x < right)
                points.push_back(p);
        points.push_back({right, target.height(right)});
        add("target line", points);
    }
    return table;
}

LineTable surfaces_table(const ExportedMoment& at) {
    LineTable table = reference_surfaces_table(at);
    for (const Polyline& piece : free_surface(setting_of(at), at.now.parts.base, at.now.state))
        table.lines.push_back({{"free surface"}, rounded(at, piece)});
    return table;
}

LineTable base_table(const ExportedMoment& at) {
    const ConstBaseNodeColumns nodes = base_node_columns(at.now.state);
    LineTable table{"base", "", {"name"}, {"start_x_m", "start_depth_m", "dx_m", "ddepth_m"}};
    if (nodes.x.empty())
        return table;
    Line line{{"detachment"}};
    for (std::size_t k = 0; k < nodes.x.size(); ++k) {
        line.points.push_back(rounded(at, {nodes.x[k] + nodes.ux[k], nodes.y[k] + nodes.uy[k]}));
        line.at_points.insert(line.at_points.end(),
                              {nodes.x[k], -nodes.y[k], nodes.ux[k], -nodes.uy[k]});
    }
    table.lines.push_back(std::move(line));
    return table;
}

WellPlace well_place(double x) { return {fmt::format("x {} m", text(x)), x}; }

namespace {

/// Numbers of a well by name, from the ground down.
using WellColumns = std::map<std::string, std::vector<double>, std::less<>>;

WellColumns columns_of(const Observation& now, const MeasuredWell& well, double x) {
    WellColumns columns;
    for (const NamedNumbers& numbers : well.numbers(now, x))
        for (const auto& [name, value] : numbers)
            columns[name].push_back(value);
    return columns;
}

/// A number at a depth, straight between those of a well and level beyond; NaN without any.
double at_depth(const WellColumns& well, std::string_view name, double depth) {
    const auto values = well.find(name);
    if (values == well.end() || values->second.empty())
        return std::nan("");
    const std::vector<double>& depths = well.at("depth_m");
    const auto after =
        static_cast<std::size_t>(std::ranges::upper_bound(depths, depth) - depths.begin());
    if (after == 0 || after == depths.size())
        return values->second[after == 0 ? 0 : after - 1];
    const double share = (depth - depths[after - 1]) / (depths[after] - depths[after - 1]);
    return std::lerp(values->second[after - 1], values->second[after], share);
}

/// The parts of wells that the wells before do not have.
std::vector<std::vector<Quantity>> new_parts(std::span<const MeasuredWell* const> wells) {
    std::set<std::string_view> known;
    std::vector<std::vector<Quantity>> parts;
    for (const MeasuredWell* const well : wells) {
        std::vector<Quantity>& its = parts.emplace_back();
        for (const Quantity& part : well->parts)
            if (known.insert(part.name).second)
                its.push_back(part);
    }
    return parts;
}

} // namespace

LineTable wells_table(const ExportedMoment& at) {
    LineTable table{"wells", "", {"name"}};
    const std::vector<const MeasuredWell*> wells = measured_wells(at.now.scene);
    if (wells.empty())
        return table;
    const std::vector<std::vector<Quantity>> parts = new_parts(wells);
    for (const std::vector<Quantity>& its : parts)
        for (const Quantity& part : its) // a line's depth is that below the original surface
            table.point_columns.emplace_back(part.name == "depth_m" ? "ground_depth_m" : part.name);
    std::vector<WellPlace> places;
    for (const double x : at.wells)
        places.push_back(well_place(x));
    // The first well's depths are those of all.
    for (const WellPlace& place : places.empty() ? wells.front()->places(at.now) : places) {
        Line line{{place.name}, rounded(at, wells.front()->points(at.now, place.x))};
        std::vector<WellColumns> others;
        for (const MeasuredWell* const well : std::span(wells).subspan(1))
            others.push_back(columns_of(at.now, *well, place.x));
        for (const NamedNumbers& numbers : wells.front()->numbers(at.now, place.x)) {
            for (const auto& [name, value] : numbers)
                line.at_points.push_back(value);
            for (std::size_t k = 0; k < others.size(); ++k)
                for (const Quantity& part : parts[k + 1])
                    line.at_points.push_back(
                        at_depth(others[k], part.name, numbers.front().second));
        }
        if (!line.points.empty())
            table.lines.push_back(std::move(line));
    }
    return table;
}

LineTable layers_table(const ExportedMoment& at) {
    LineTable table{"layers", "", {"name", "area_m2"}, {"thickness_m"}};
    const std::vector<LayerFacts>& layers = at.now.parts.layers;
    if (layers.empty() || !at.now.state.discs.has(dem::columns::layer))
        return table;
    const std::vector<LayerThickness> all =
        layer_thickness(at.now.state, at.now.parts.base, layers.size());
    for (std::size_t n = 0; n < layers.size(); ++n) {
        Line line{{"layer " + layers[n].name, all[n].area}};
        for (std::size_t k = 0; k < all[n].x.size(); ++k) {
            line.points.push_back(rounded(at, {all[n].x[k], -all[n].depth[k]}));
            line.at_points.push_back(all[n].thickness[k]);
        }
        table.lines.push_back(std::move(line));
    }
    return table;
}

std::vector<DiscColumn> exported_columns(const ExportedMoment& at) {
    const State& state = at.now.state;
    const ConstDiscColumns d = disc_columns(state);
    const auto numbers = [](const auto& values) {
        return std::vector<double>(values.begin(), values.end());
    };
    const std::vector<Stress> stress = disc_stresses(state, at.now.parts.base);
    const auto component = [&](double Stress::*part) {
        std::vector<double> values;
        for (const Stress& s : stress)
            values.push_back(s.*part);
        return values;
    };
    const Motion& motion = at.now.parts.base.motion;
    std::vector<double> start_depth, start_extension;
    for (const double y : d.start_y)
        start_depth.push_back(-y);
    for (const double travel : d.start_travel)
        start_extension.push_back(motion.position(Travel(travel)).m);
    std::vector<DiscColumn> columns{
        {"id", numbers(d.id)},
        {"radius_m", numbers(d.radius)},
        {"stratum", numbers(d.stratum)},
        {"mass_kg_per_m", numbers(d.mass)},
        {"start_x_m", numbers(d.start_x)},
        {"start_depth_m", std::move(start_depth)},
        {"start_extension_m", std::move(start_extension)},
        {"rotation_rad", numbers(d.rotation)},
        {"coordination", numbers(coordination(state, at.now.parts.base))},
        {"bonds", numbers(bonds_per_disc(state))},
        {"stress_xx_pa", component(&Stress::xx)},
        {"stress_yy_pa", component(&Stress::yy)},
        {"stress_xy_pa", component(&Stress::xy)},
    };
    if (!motion.stages.empty())
        columns.push_back({"start_travel_m", numbers(d.start_travel)});
    if (state.discs.has(dem::columns::layer))
        columns.push_back({"layer", numbers(state.discs.get(dem::columns::layer))});
    for (const auto& column : exported_disc_columns)
        if (state.discs.has(column))
            columns.push_back({std::string(column.name), numbers(state.discs.get(column))});
    return columns;
}

LineTable discs_table(const ExportedMoment& at) {
    const ConstDiscColumns d = disc_columns(at.now.state);
    const std::vector<std::uint32_t> rock = rocks(at.now.state);
    const std::vector<DiscColumn> columns = exported_columns(at);
    LineTable table{"discs", "", {"rock"}};
    for (const DiscColumn& column : columns)
        table.point_columns.push_back(column.name);
    const State& state = at.now.state;
    const auto layers = state.discs.has(dem::columns::layer) ? state.discs.get(dem::columns::layer)
                                                             : std::span<const std::uint8_t>{};
    const auto layer_of = [&](std::size_t i) { return layers.empty() ? 0 : layers[i]; };
    const auto name_of = [&](std::size_t i) -> std::string {
        const std::size_t layer = layer_of(i);
        if (layer == 0 || layer > at.now.parts.layers.size())
            return rock_names[rock[i]];
        const bool is_weakened = is_weak(state.materials, d.material[i]);
        return (is_weakened ? "weak layer " : "layer ") + at.now.parts.layers[layer - 1].name;
    };
    std::vector<std::size_t> order(d.x.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {},
                      [&](std::size_t i) { return std::tuple(layer_of(i), rock[i], d.id[i]); });
    for (const std::size_t i : order) {
        const std::string name = name_of(i);
        if (table.lines.empty() || std::get<std::string>(table.lines.back().values.front()) != name)
            table.lines.push_back({{name}});
        Line& line = table.lines.back();
        line.points.push_back(rounded(at, {d.x[i], d.y[i]}));
        for (const DiscColumn& column : columns)
            line.at_points.push_back(column.values[i]);
    }
    return table;
}

} // namespace listric::archive
