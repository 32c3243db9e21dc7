#include "apps/figures/frame.hpp"

#include "apps/archive/folder/setting.hpp"
#include "apps/archive/tables/observed_misfit.hpp"
#include "apps/figures/predicted_tops.hpp"
#include "apps/figures/vocabulary.hpp"
#include "apps/figures/window_strain.hpp"
#include "apps/measures/basin/profile.hpp"
#include "apps/measures/dictionary.hpp"
#include "apps/measures/faults/rock_behaviour.hpp"
#include "apps/measures/measures.hpp"
#include "apps/measures/strata/horizons.hpp"
#include "apps/model/effects/stage/measures.hpp"
#include "apps/model/effects/stage/pauses.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/files/npy.hpp"
#include "apps/support/files/picture.hpp"
#include "apps/support/words/option_names.hpp"
#include "dem/base/just_before.hpp"
#include "dem/base/place.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/contacts/power_cell.hpp"
#include "dem/events/strain.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>

namespace listric {

using namespace dem;
using namespace measures;

namespace {

namespace fs = std::filesystem;

/// Writes into the folder of one frame.
class FrameWriter {
public:
    /// Makes the folder. Throws StorageError.
    explicit FrameWriter(const fs::path& folder) : folder_(folder) {
        std::error_code error;
        fs::create_directories(folder, error);
        if (error)
            throw StorageError(folder.string() + ": cannot be made: " + error.message());
    }

    /// @param columns  0: one dimension
    template <class T>
    void array(const std::string& name, std::span<const T> values, std::size_t columns = 0) const {
        write_npy<T>(folder_ / (name + ".npy"), values, columns);
    }
    void array(const std::string& name, const std::vector<double>& values,
               std::size_t columns = 0) const {
        array(name, std::span(values), columns);
    }
    void points(const std::string& name, const std::vector<Point>& line) const {
        std::vector<double> rows;
        for (const Point p : line)
            rows.insert(rows.end(), {p.x, p.y});
        array(name, rows, 2);
    }

    void json(const nlohmann::json& frame) const {
        write_text(folder_ / "frame.json", to_text(frame, 1));
    }

private:
    fs::path folder_;
};

void write_discs(const FrameWriter& writer, const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    writer.array("discs_x", d.x);
    writer.array("discs_y", d.y);
    writer.array("discs_radius", rock_radii(state));
    writer.array("discs_stratum", d.stratum);
    std::vector<double> depth;
    for (const double y : d.start_y)
        depth.push_back(-y);
    writer.array("discs_start_depth", depth);
    if (state.discs.has(dem::columns::layer)) {
        const auto layer = state.discs.get(dem::columns::layer);
        const std::vector<std::int32_t> numbers(layer.begin(), layer.end());
        writer.array("discs_layer", std::span<const std::int32_t>(numbers));
    }
}

/// Bonded contacts as lines: x and y of both discs, and 1 where both are sediment.
void write_bonds(const FrameWriter& writer, const State& state) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    std::vector<double> bonded;
    for (std::size_t k = 0; k < c.first.size(); ++k) {
        if (!c.bonded[k])
            continue;
        const auto i = static_cast<std::size_t>(c.first[k]);
        const auto j = static_cast<std::size_t>(c.second[k]);
        const bool in_sediment = d.stratum[i] > 0 && d.stratum[j] > 0;
        bonded.insert(bonded.end(), {d.x[i], d.y[i], d.x[j], d.y[j], in_sediment ? 1.0 : 0.0});
    }
    writer.array("bonded", bonded, 5);
}

void write_behaviour(const FrameWriter& writer, const State& state,
                     const std::vector<Fault>& faults) {
    std::vector<std::int32_t> classes;
    for (const auto behaviour : measures::rock_behaviour(state, faults))
        classes.push_back(static_cast<std::int32_t>(behaviour));
    writer.array("discs_behaviour", std::span<const std::int32_t>(classes));
}

/// The detachment where it stands now, up to the wall.
void write_base(const FrameWriter& writer, const Observation& now) {
    const Chain standing = standing_base(now.parts.base, now.state).surfaces.front().chain;
    double length = 0.0;
    for (const Segment& segment : standing)
        length += segment.length;
    std::vector<Point> line;
    constexpr int steps = 2000;
    for (int k = 0; k <= steps; ++k) {
        const Point p = point_at(standing, length * k / steps);
        if (p.x <= now.right_end())
            line.push_back(p);
    }
    writer.points("detachment", line);
}

void write_profile(const FrameWriter& writer, const Observation& now) {
    const Profile profile =
        measure_profile(archive::make_setting(now.scene, now.parts), now.state, now.parts.base);
    std::vector<double> rows;
    for (std::size_t k = 0; k < profile.x.size(); ++k)
        rows.insert(rows.end(),
                    {profile.x[k], profile.pre_rift_top[k], profile.sediment_thickness[k]});
    writer.array("profile", rows, 3);
}

void write_depocentres(const FrameWriter& writer, const std::vector<Depocentre>& depocentres) {
    std::vector<double> rows;
    for (const Depocentre& c : depocentres)
        rows.insert(rows.end(), {c.x, c.thickness, c.prominence});
    writer.array("depocentres", rows, 3);
}

/// Part of the names of figures over a picture: another picture, or place, has another one.
std::string name_of(const Underlay& underlay) {
    const std::string corners =
        fmt::format("{} {} {} {}", underlay.left, underlay.top, underlay.right, underlay.bottom);
    return named_after(fs::path(underlay.image).stem().string(),
                       read_picture(underlay.image).bytes + corners);
}

/// Points of the traces: number of the fault, x, y and the fault's slip rate.
void write_faults(const FrameWriter& writer, const std::vector<Fault>& faults) {
    std::vector<double> rows;
    for (std::size_t k = 0; k < faults.size(); ++k)
        for (const Point p : faults[k].trace.points)
            rows.insert(rows.end(), {static_cast<double>(k), p.x, p.y, faults[k].rate});
    writer.array("faults", rows, 4);
}

/// Pieces of horizons: number of the piece, x, y.
template <class Wanted>
void write_horizons(const FrameWriter& writer, const std::string& name,
                    const std::vector<Horizon>& horizons, Wanted&& wanted) {
    std::vector<double> rows;
    double number = 0.0;
    for (const Horizon& h : horizons)
        if (wanted(h.stratum))
            for (const Polyline& piece : h.pieces) {
                for (const Point p : piece)
                    rows.insert(rows.end(), {number, p.x, p.y});
                number += 1.0;
            }
    writer.array(name, rows, 3);
}

/// Tops of strata and of layers of rock: stratum (0: pre-rift top, below 0: layers), number of the
/// piece, x, height above the regional.
void write_tops(const FrameWriter& writer, const Observation& now) {
    const TargetLine regional = effects::stage::regional_of(
        now.parts.base.motion, now.parts.sediment ? now.parts.sediment->surface : Target(0.0),
        make_calendar(now.scene));
    std::vector<double> rows;
    double number = 0.0;
    for (const Horizon& h : trace_horizons(archive::make_setting(now.scene, now.parts),
                                           now.parts.base, now.state, {}, {.pre_rift_layer = 0.0}))
        for (const Polyline& piece : h.pieces) {
            for (const Point p : piece)
                rows.insert(rows.end(), {static_cast<double>(h.stratum), number, p.x,
                                         p.y - regional.height(p.x)});
            number += 1.0;
        }
    writer.array("tops", rows, 4);
}

/// Picks, and the model's tops that go with them: number of the line, x, y.
void write_observed(const FrameWriter& writer, const Observation& now,
                    const std::vector<Horizon>& horizons) {
    const auto picks = [&](const std::vector<PickedLine>& lines) {
        std::vector<double> rows;
        for (std::size_t n = 0; n < lines.size(); ++n)
            for (std::size_t k = 0; k < lines[n].x.size(); ++k)
                rows.insert(rows.end(),
                            {static_cast<double>(n), lines[n].x[k], -lines[n].depth[k]});
        return rows;
    };
    writer.array("picked_horizons", picks(now.scene.observed->horizons), 3);
    writer.array("picked_faults", picks(now.scene.observed->faults), 3);
    std::set<int> strata;
    for (const auto& row : archive::compare_horizons(now.scene, now.state, horizons))
        if (row.stratum)
            strata.insert(*row.stratum);
    write_horizons(writer, "compared_horizons", horizons,
                   [&](int stratum) { return strata.contains(stratum); });
}

/// Geological rate of the wall, m/a; in a pause that of the run's clock.
double rate_of_motion(const Observation& now) {
    const dem::Motion& motion = now.parts.base.motion;
    const double slope =
        motion.stages.empty() ? 1.0 : motion.stages[motion.stage(now.state.clock.travel)].slope;
    return make_calendar(now.scene).metres_per_year(now.state.clock.travel) *
           (slope == 0.0 ? 1.0 : std::abs(slope));
}

nlohmann::json frame_json(const Observation& now, const Measures& m) {
    const Scene& scene = now.scene;
    const State& state = now.state;
    const ConstDiscColumns d = disc_columns(state);
    const Calendar calendar = make_calendar(scene);
    nlohmann::json frame = {
        {"scene", scene.name},
        {"title", scene.description},
        {"extension_m", state.clock.extension.m},
        {"time_a", calendar.age(state.clock.travel)},
        {"end_a", end_age(scene)},
        {"interval_a", scene.output.interval / scene.extension.rate},
        {"rate_m_per_a", rate_of_motion(now)},
        {"extension_rate_m_per_a", scene.extension.rate},
        {"mean_radius_m", state.mean_radius},
        {"right_wall_x_m", now.right_end()},
        {"strata", d.stratum.empty() ? 0 : *std::ranges::max_element(d.stratum)},
        {"seed", scene.seed},
        {"accuracy", scene.accuracy},
        {"effects", effect_names(scene)},
        {"has_detachment", scene.detachment.has_value()},
        {"strain_window_m", strain_window},
    };
    for (const MeasureTable& table : measure_tables())
        for (const Measure<Measures>& measure : table.measures)
            if (const auto value = measure.value(m))
                frame[measure.name] = *value;
    std::map<int, double> laid_down; // strata by their numbers, if none is gone, a
    for (std::size_t i = 0; i < d.stratum.size(); ++i)
        if (d.stratum[i] > 0)
            laid_down[d.stratum[i]] = calendar.age(Travel(d.start_travel[i]));
    if (!laid_down.empty() && laid_down.rbegin()->first == static_cast<int>(laid_down.size()))
        for (const auto& [stratum, age] : laid_down)
            frame["strata_a"].push_back(age);
    for (const LayerFacts& layer : now.parts.layers)
        frame["rock_layers"].push_back(layer.name);
    for (const auto& [name, way] : ways(now.parts.base.motion, state.clock.travel))
        frame[name] = way;
    if (now.parts.sediment)
        frame["level_m"] =
            now.parts.sediment->surface.at(calendar.age(state.clock.travel)).height(0.0);
    // The stage behind it counts: the next one begins where a snapshot is of the end of one.
    const Travel travel = state.clock.travel;
    frame["surface_rests"] =
        now.parts.base.motion.surface_work(travel - Travel(1.0), travel) == SurfaceWork::none;
    return frame;
}

/// Words of the measures that figures of tops against the regional say now.
nlohmann::json said_in_figures(const Observation& now) {
    nlohmann::json said = nlohmann::json::array();
    for (const EffectPart& part : now.scene.effects)
        for (const Measure<Observation>& measure : part.effect->measures) {
            if (measure.said.empty())
                continue;
            if (const auto value = measure.value(now); value && std::isfinite(*value))
                said.push_back(fmt::format(fmt::runtime(measure.said),
                                           fmt::format("{:.2f} km", *value / 1e3)));
        }
    return said;
}

} // namespace

std::map<std::string, double> ways(const dem::Motion& motion, Travel travel) {
    std::map<std::string, double> all;
    if (!motion.stages.empty())
        all["way_m"] = travel.m;
    if (const auto way = effects::stage::wall_way(motion, travel))
        all["wall_m"] = way->m;
    return all;
}

void write_frame(const Observation& now, const FaultReport& faults, const fs::path& folder,
                 const std::optional<Underlay>& underlay, const std::optional<MomentNames>& names) {
    const FrameWriter writer(folder);
    write_discs(writer, now.state);
    const auto tectonic = window_tectonic_strain(now);
    const std::vector<double> strain = tectonic ? *tectonic : window_strain(now);
    writer.array("discs_shear_strain", strain);
    if (now.parts.bonds) {
        write_bonds(writer, now.state);
        write_behaviour(writer, now.state, faults.faults);
    }
    write_base(writer, now);
    write_profile(writer, now);
    const Measures m =
        measure(archive::make_setting(now.scene, now.parts), now.state, now.parts.base, now.events);
    if (const auto predicted = predict_tops(now, m)) {
        writer.points("predicted_shear", predicted->inclined_shear);
        writer.points("predicted_normals", predicted->normals);
    }
    if (m.depocentres)
        write_depocentres(writer, *m.depocentres);
    write_faults(writer, faults.faults);
    if (const auto& picked = now.scene.picked_fault) {
        std::vector<Point> points;
        for (std::size_t k = 0; k < picked->x.size(); ++k)
            points.push_back({picked->x[k], -picked->depth[k]});
        writer.points("picked_fault", points);
    }
    if (const auto& sediment = now.parts.sediment) {
        const TargetLine line =
            sediment->surface.at(make_calendar(now.scene).age(now.state.clock.travel));
        if (line.points().size() > 1)
            writer.points("target_line", line.points());
    }
    constexpr std::size_t columns[] = {3, 2, 0}; // by LayerKind
    for (const FigureLayer& layer : figure_layers(now.scene)) {
        writer.array(data_name(layer), layer.rows(now), columns[static_cast<int>(layer.kind)]);
        if (layer.arrows)
            writer.array(data_name(layer) + "_arrows", layer.arrows->rows(now), 2);
    }
    nlohmann::json frame = frame_json(now, m);
    frame["strain_end"] = strain_scale_end(strain);
    frame["strain_remark"] = strain_remark(now, tectonic.has_value());
    frame["layers"] = declared_layers(now.scene);
    if (now.parts.base.motion.shortens(just_before(now.parts.base.motion, now.state.clock))) {
        write_tops(writer, now);
        frame["said"] = said_in_figures(now);
    }
    const double travel = now.state.clock.travel.m;
    frame["extension_km"] =
        names.value_or(MomentNames(now.scene.output.interval, {&travel, 1})).kilometres(travel);
    // Picks are of the section as it is at the end of extension.
    const bool observed = now.scene.observed &&
                          has_come_to(now.state.clock.travel, Travel(now.scene.extension.distance),
                                      travel_of_cycle(now.parts.base.motion, now.state.clock));
    std::vector<Horizon> horizons;
    if (observed || underlay)
        horizons = trace_horizons(archive::make_setting(now.scene, now.parts), now.parts.base,
                                  now.state, faults.faults);
    if (observed)
        write_observed(writer, now, horizons);
    if (underlay) {
        write_horizons(writer, "horizons", horizons, [](int) { return true; });
        frame["underlay"] = {
            {"image", fs::absolute(underlay->image).string()},
            {"name", name_of(*underlay)},
            {"corners_m", {underlay->left, underlay->top, underlay->right, underlay->bottom}}};
    }
    writer.json(frame);
}

} // namespace listric
