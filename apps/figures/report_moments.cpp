#include "apps/figures/report_moments.hpp"

#include "apps/archive/folder/setting.hpp"
#include "apps/archive/tables/exports.hpp"
#include "apps/archive/tables/fault_fields.hpp"
#include "apps/figures/predicted_tops.hpp"
#include "apps/figures/sections/seismic_section.hpp"
#include "apps/figures/vocabulary.hpp"
#include "apps/figures/window_strain.hpp"
#include "apps/measures/faults/rock_behaviour.hpp"
#include "apps/measures/measures.hpp"
#include "apps/measures/strata/cohesion.hpp"
#include "apps/measures/strata/horizons.hpp"
#include "apps/measures/strata/rock.hpp"
#include "apps/model/effects/stage/pauses.hpp"
#include "apps/scene/parameters/stage.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/support/files/encoding.hpp"
#include "apps/support/fineness.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/monitor.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/threads/shared_loop.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace listric {

using namespace archive;
using namespace dem;
using namespace measures;

using nlohmann::json;

namespace {

constexpr int compression = 6; ///< of zlib: 9 takes four times as long for 2 %

/// How a number becomes a whole one.
struct Scale {
    double step = 1.0;     ///< in its unit, or the unit's root
    bool root = false;     ///< the whole number is of the square root, with the number's sign
    std::int32_t none = 0; ///< stands for a number that is not defined; 0: there is none

    std::int32_t code(double value) const {
        if (std::isnan(value))
            return none;
        const double size = root ? std::sqrt(std::abs(value)) : std::abs(value);
        const double whole = std::min(std::round(size / step), 1e9);
        return static_cast<std::int32_t>(std::copysign(whole, value));
    }
};

/// Lengths are followed by a sixty-fourth of the mean radius: 1 m at standard.
std::map<std::string, Scale> scales(double mean_radius) {
    const Scale length{mean_radius / 64.0}, strain{1.0 / 128.0, true, -1}, stress{25.0, true};
    return {{"x_m", length},
            {"depth_m", length},
            {"radius_m", {mean_radius / 1024.0}},
            {"start_x_m", length},
            {"start_depth_m", length},
            {"start_travel_m", {1.0 / fineness(mean_radius)}},
            {"window_strain", strain},
            {"total_strain", strain},
            {"window_tectonic_strain", strain},
            {"total_tectonic_strain", strain},
            {"mean_stress_pa", stress},
            {"shear_stress_pa", stress}};
}

/// zlib's format of the planes of bytes of differences, 0 -1 1 -2 2 as 0 1 2 3 4, and how many
/// planes there are: [planes, "base64"].
std::string packed(std::span<const std::int32_t> differences) {
    std::uint32_t all = 0;
    std::vector<std::uint32_t> folded;
    folded.reserve(differences.size());
    for (const std::int32_t d : differences) {
        const auto bits = static_cast<std::uint32_t>(d);
        folded.push_back(bits << 1 ^ (d < 0 ? ~0u : 0u));
        all |= folded.back();
    }
    int planes = 1;
    while (planes < 4 && all >> 8 * planes != 0)
        ++planes;
    std::vector<unsigned char> bytes;
    bytes.reserve(folded.size() * static_cast<std::size_t>(planes));
    for (int plane = 0; plane < planes; ++plane)
        for (const std::uint32_t value : folded)
            bytes.push_back(static_cast<unsigned char>(value >> 8 * plane & 255u));
    return fmt::format("[{},\"{}\"]", planes, base64(deflated(bytes, compression)));
}

json finite(double value) { return std::isfinite(value) ? json(value) : json(); }

/// To a tenth.
json short_number(double value, double steps = 10.0) { return std::round(steps * value) / steps; }

/// Steps in a metre that the points of lines are told by: decimetres, in small models less.
double steps_of(const Observation& now) { return 10.0 * fineness(now.state.mean_radius); }

json points_of(std::span<const Point> points, double steps) {
    json list = json::array();
    for (const Point p : points)
        list.push_back({short_number(p.x, steps), short_number(-p.y, steps)});
    return list;
}

/// Rows of a table as objects by its columns, each with its "points".
json lines_of(const LineTable& table, double steps) {
    json lines = json::array();
    for (const Line& line : table.lines) {
        json row;
        for (std::size_t c = 0; c < table.columns.size(); ++c)
            row[table.columns[c]] = std::holds_alternative<double>(line.values[c])
                                        ? finite(std::get<double>(line.values[c]))
                                        : json(std::get<std::string>(line.values[c]));
        row["points"] = points_of(line.points, steps);
        for (std::size_t c = 0; c < table.point_columns.size(); ++c) {
            json& list = row[table.point_columns[c]] = json::array();
            for (std::size_t k = c; k < line.at_points.size(); k += table.point_columns.size())
                list.push_back(short_number(line.at_points[k], steps));
        }
        lines.push_back(std::move(row));
    }
    return lines;
}

/// "name":[...] of what whole numbers are less what they were in the moment before, which they then
/// become.
std::string stream(const std::string& name, std::vector<std::int32_t> now,
                   std::vector<std::int32_t>& before) {
    before.resize(now.size());
    std::vector<std::int32_t> differences(now.size());
    for (std::size_t k = 0; k < now.size(); ++k)
        differences[k] = now[k] - before[k];
    before = std::move(now);
    return fmt::format("\"{}\":{}", name, packed(differences));
}

/// Faults that have not been followed back are without what is known of their past.
json faults_of(const ExportedMoment& at, bool followed) {
    json faults = lines_of(faults_table(at), steps_of(at.now));
    if (!followed)
        for (json& fault : faults)
            for (const archive::FaultField& field : archive::fault_fields())
                if (field.of_past)
                    fault[field.name] = nullptr;
    return faults;
}

/// Cutoffs of each fault, by horizon: depth of the horizon above the fault and below it, m, whether
/// it is known well enough for a throw, and the throw's error, m.
json cutoffs_of(const FaultReport& report, double steps) {
    json list = json::array();
    for (const Fault& fault : report.faults) {
        json cutoffs = json::array();
        for (const auto& [horizon, at] : fault.cutoffs)
            cutoffs.push_back({horizon, short_number(0.0 - at.hanging.y, steps),
                               short_number(0.0 - at.footwall.y, steps), at.is_resolved,
                               short_number(at.error, steps)});
        list.push_back(std::move(cutoffs));
    }
    return list;
}

/// The section as seismics would see it, in depth: amplitudes from -127 to 127 trace by trace, in
/// base64, at a trace per 150th and a sample per 750th of the hanging wall's thickness.
json seismic_of(const Observation& now, std::span<const Horizon> horizons) {
    const double thickness = now.scene.hanging_wall.thickness;
    const SeismicSection section = seismic_section(now, {}, horizons,
                                                   {.in_depth = true,
                                                    .trace_spacing = thickness / 150.0,
                                                    .sample_interval = thickness / 750.0});
    std::vector<double> sizes;
    for (const float value : section.amplitude)
        if (value != 0.0f)
            sizes.push_back(std::abs(static_cast<double>(value)));
    const double end = scale_end(std::move(sizes));
    std::vector<unsigned char> bytes;
    bytes.reserve(section.amplitude.size());
    for (const float value : section.amplitude)
        bytes.push_back(static_cast<unsigned char>(
            std::lround(127.0 * std::clamp(static_cast<double>(value) / end, -1.0, 1.0)) & 255));
    return {{"traces", section.traces},
            {"samples", section.samples},
            {"left_m", section.first_x - 0.5 * section.options.trace_spacing},
            {"top_m", section.first_sample - 0.5 * section.options.sample_interval},
            {"across_m", section.options.trace_spacing},
            {"down_m", section.options.sample_interval},
            {"frequency_hz", section.options.frequency},
            {"end", end},
            {"values", base64(bytes)}};
}

json predictions_of(const Observation& now) {
    const auto tops = predict_tops(
        now, measure(make_setting(now.scene, now.parts), now.state, now.parts.base, now.events));
    if (!tops)
        return json::array();
    return {{{"name", fmt::format("inclined shear, {:.0f} degrees", tops->angle)},
             {"points", points_of(tops->inclined_shear, steps_of(now))}},
            {{"name", "normals stay normal"}, {"points", points_of(tops->normals, steps_of(now))}}};
}

/// Corners (m) and change of largest shear stress (MPa) of the patches near the section, as they
/// stand.
json footwall_of(std::span<const fem::StressPatch> patches, double right) {
    json corners = json::array(), shear = json::array();
    for (const fem::StressPatch& patch : patches) {
        if (!is_near(patch, right))
            continue;
        for (std::size_t k = 0; k < 4; ++k) {
            corners.push_back(std::round(patch.corner[k].x + patch.displacement[k].x));
            corners.push_back(-std::round(patch.corner[k].y + patch.displacement[k].y));
        }
        shear.push_back(short_number(largest_shear(patch)));
    }
    return {{"corners", std::move(corners)},
            {"shear_mpa", std::move(shear)},
            {"end_mpa", shear_end(patches, right)}};
}

} // namespace

SectionLines section_lines(const Observation& now, const FaultReport& faults, bool followed,
                           std::span<const fem::StressPatch> footwall) {
    const ExportedMoment at{now, faults};
    json lines{{"followed", followed},
               {"faults", faults_of(at, followed)},
               {"cutoffs", cutoffs_of(faults, steps_of(now))},
               {"surfaces", lines_of(reference_surfaces_table(at), steps_of(now))},
               {"base", lines_of(base_table(at), steps_of(now))}};
    if (followed) {
        std::vector<Horizon> horizons = horizons_of(at);
        lines["horizons"] = lines_of(horizons_table(at, horizons), steps_of(now));
        lines["predictions"] = predictions_of(now);
        if (has_seismics(now.scene))
            lines["seismic"] = seismic_of(now, seismic_horizons(now, std::move(horizons)));
    }
    if (!footwall.empty())
        lines["footwall"] = footwall_of(footwall, now.right_end());
    for (const FigureLayer& layer : figure_layers(now.scene))
        if (layer.kind != LayerKind::discs)
            lines["layers"][data_name(layer)] = layer.rows(now);
    const std::string text = to_text(lines);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(text.data());
    SectionLines packed{base64(deflated({bytes, text.size()}, compression)), followed};
    if (now.parts.bonds)
        for (const RockBehaviour one : rock_behaviour(now.state, faults.faults))
            packed.behaviour.push_back(static_cast<std::uint8_t>(one));
    return packed;
}

std::string report_scales(double mean_radius) {
    json list;
    for (const auto& [name, scale] : scales(mean_radius))
        list[name] = {{"step", scale.step}, {"root", scale.root}, {"none", scale.none}};
    return to_text(list);
}

/// Which of the bonds of the moment before are left, in their order, and the new ones: the lower
/// id, less that of the bond before, and how much higher the other one is.
std::string ReportMoments::bonds(const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const auto pair_of = [](std::int64_t low, std::int64_t high) { return low << 32 | high; };
    std::vector<std::int64_t> now;
    for (std::size_t k = 0; k < c.first.size(); ++k)
        if (c.bonded[k]) {
            const std::int64_t a = d.id[static_cast<std::size_t>(c.first[k])];
            const std::int64_t b = d.id[static_cast<std::size_t>(c.second[k])];
            now.push_back(pair_of(std::min(a, b), std::max(a, b)));
        }
    std::ranges::sort(now);
    std::vector<bool> is_old(now.size(), false);
    std::vector<std::int32_t> left;
    std::vector<std::int64_t> bonded;
    for (const std::int64_t pair : bonded_) {
        const auto found = std::ranges::lower_bound(now, pair);
        left.push_back(found != now.end() && *found == pair);
        if (left.back()) {
            is_old[static_cast<std::size_t>(found - now.begin())] = true;
            bonded.push_back(pair);
        }
    }
    std::vector<std::int32_t> low, further;
    std::int64_t last = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
        if (is_old[k])
            continue;
        const std::int64_t a = now[k] >> 32, b = now[k] & 0xffffffff;
        low.push_back(static_cast<std::int32_t>(a - last));
        further.push_back(static_cast<std::int32_t>(b - a));
        last = a;
        bonded.push_back(now[k]);
    }
    bonded_ = std::move(bonded);
    return fmt::format("\"bonds_left\":{},\"bonds_new\":{},\"bonds_to\":{}", packed(left),
                       packed(low), packed(further));
}

/// None reads what another one changes.
/// @param ends  gets where the scales of their colours end
std::vector<ReportMoments::Stream> ReportMoments::streams(const Observation& now,
                                                          std::span<const std::uint8_t> behaviour,
                                                          std::map<std::string, double>& ends) {
    const State& state = now.state;
    const ConstDiscColumns d = disc_columns(state);
    const std::map<std::string, Scale> all_scales = scales(state.mean_radius);
    std::vector<Stream> streams;
    const auto add = [&](const std::string& name, auto value) {
        const auto found = all_scales.find(name);
        const Scale scale = found == all_scales.end() ? Scale() : found->second;
        streams.push_back([&state, ids = d.id, name, value, scale, &before = before_[name]] {
            std::vector<std::int32_t> codes = before; // those of discs that are gone stay
            codes.resize(static_cast<std::size_t>(state.next_id));
            for (std::size_t i = 0; i < ids.size(); ++i)
                codes[static_cast<std::size_t>(ids[i])] = scale.code(static_cast<double>(value(i)));
            return stream(name, std::move(codes), before);
        });
    };
    const auto add_scaled = [&](const std::string& name, std::vector<double> values,
                                double (*end)(std::vector<double>) = scale_end) {
        ends[name] = end(values);
        add(name, [values = std::move(values)](std::size_t i) { return values[i]; });
    };
    const auto by_disc = [&](auto value) {
        std::vector<double> values;
        for (std::size_t i = 0; i < d.x.size(); ++i)
            values.push_back(value(i));
        return values;
    };
    streams.push_back([&state, d, &before = before_["present"]] {
        std::vector<std::int32_t> present(static_cast<std::size_t>(state.next_id));
        for (const std::int64_t id : d.id)
            present[static_cast<std::size_t>(id)] = 1;
        return stream("present", std::move(present), before);
    });
    const std::vector<double> radius = rock_radii(state);
    const std::vector<std::uint32_t> rock = rocks(state);
    add("x_m", [d](std::size_t i) { return d.x[i]; });
    add("depth_m", [d](std::size_t i) { return -d.y[i]; });
    add("radius_m", [radius](std::size_t i) { return radius[i]; });
    add("stratum", [d](std::size_t i) { return d.stratum[i]; });
    add("start_x_m", [d](std::size_t i) { return d.start_x[i]; });
    add("start_depth_m", [d](std::size_t i) { return -d.start_y[i]; });
    add("start_travel_m", [d](std::size_t i) { return d.start_travel[i]; });
    add("rock", [rock](std::size_t i) { return rock[i]; });
    ends["displacement_m"] = scale_end(by_disc(
        [d](std::size_t i) { return hypotenuse(d.x[i] - d.start_x[i], d.y[i] - d.start_y[i]); }));
    for (auto& [name, values] : strains_of(now))
        add_scaled(name, std::move(values), strain_scale_end);
    if (state.discs.has(dem::columns::layer)) {
        const auto layer = state.discs.get(dem::columns::layer);
        add("layer", [layer](std::size_t i) { return layer[i]; });
    }
    for (const FigureLayer& layer : figure_layers(now.scene))
        if (layer.kind == LayerKind::discs)
            add(data_name(layer), [shares = layer.rows(now)](std::size_t i) {
                return 255.0 * std::clamp(shares[i], 0.0, 1.0);
            });
    if (now.parts.bonds) {
        const std::vector<std::int32_t> count = bonds_per_disc(state);
        add("behaviour", [behaviour](std::size_t i) { return static_cast<int>(behaviour[i]); });
        add("bonds", [count](std::size_t i) { return count[i]; });
        if (detail_.bonds)
            streams.push_back([this, &state] { return bonds(state); });
    }
    if (detail_.stress) {
        const std::vector<Stress> stress = disc_stresses(state, now.parts.base);
        add_scaled("mean_stress_pa",
                   by_disc([&](std::size_t i) { return -0.5 * (stress[i].xx + stress[i].yy); }));
        add_scaled("shear_stress_pa", by_disc([&](std::size_t i) {
                       return hypotenuse(0.5 * (stress[i].xx - stress[i].yy), stress[i].xy);
                   }));
    }
    return streams;
}

void ReportMoments::add(const Observation& now, const SectionLines& lines) {
    const Clock& clock = now.state.clock;
    if (at_ != clock.travel) {
        std::map<std::string, double> ends;
        const std::vector<Stream> to_pack = streams(now, lines.behaviour, ends);
        std::vector<std::string> packed(to_pack.size());
        for_each_shared(to_pack.size(), [&](std::size_t k) { packed[k] = to_pack[k](); });
        const dem::Motion& motion = now.parts.base.motion;
        std::string travel;
        if (!motion.stages.empty())
            travel = fmt::format("\"{}\":{},", travel_column, clock.travel.m);
        if (const auto way = effects::stage::wall_way(motion, clock.travel))
            travel += fmt::format("\"wall_m\":{},", way->m);
        moments_.push_back(
            {fmt::format("\"extension_m\":{},{}\"time_a\":{},\"discs\":{},"
                         "\"ends\":{},\"streams\":{{{}}}",
                         clock.extension.m, travel, make_calendar(now.scene).age(clock.travel),
                         now.state.discs.rows(), to_text(nlohmann::json(ends)),
                         fmt::join(packed, ",")),
             ""});
    }
    at_ = clock.travel;
    moments_.back().lines = lines.packed;
    followed_ = lines.followed;
}

std::size_t ReportMoments::bytes() const {
    std::size_t sum = 0;
    for (const Text& moment : moments_)
        sum += moment.discs.size() + moment.lines.size();
    return sum;
}

std::string ReportMoments::json() const {
    std::string text = "[";
    for (const Text& moment : moments_)
        text += fmt::format("{}{{{},\"lines\":\"{}\"}}", text.size() > 1 ? ",\n" : "", moment.discs,
                            moment.lines);
    return text + "]";
}

} // namespace listric
