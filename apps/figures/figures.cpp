#include "apps/figures/figures.hpp"

#include "apps/archive/setting.hpp"
#include "apps/archive/snapshot.hpp"
#include "apps/measures/kinematics.hpp"
#include "apps/measures/measures.hpp"
#include "apps/measures/profile.hpp"
#include "apps/model/effects.hpp"
#include "apps/support/npy.hpp"
#include "apps/support/python.hpp"
#include "dem/base_place.hpp"
#include "dem/contacts.hpp"
#include "dem/events/strain.hpp"
#include "dem/power_cell.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace listric {

using namespace dem;
using namespace measures;
using namespace coupling;

namespace {

namespace fs = std::filesystem;

template <class T, class Range>
void put(const fs::path& folder, const char* name, const Range& values, std::size_t columns = 0) {
    write_npy<T>(folder / (std::string(name) + ".npy"), std::span<const T>(values), columns);
}

/// Plain arrays that the drawing script reads; names and units are in its head.
void export_frame(const Scene& scene, const State& state, const RigidBase& base,
                  std::span<const std::unique_ptr<Event>> events, const FaultReport& faults,
                  const fs::path& folder) {
    const ConstDiscColumns d = disc_columns(state);
    put<double>(folder, "discs_x", d.x);
    put<double>(folder, "discs_y", d.y);
    put<double>(folder, "discs_radius", rock_radii(state));
    put<std::int32_t>(folder, "discs_stratum", d.stratum);
    std::vector<double> depth;
    for (double y : d.start_y)
        depth.push_back(-y);
    put<double>(folder, "discs_start_depth", depth);
    const bool first_window = std::ranges::none_of(
        events, [](const auto& e) { return e->name() == "strain" && e->applied > 0; });
    if (first_window)
        put<double>(folder, "discs_shear_strain", shear_strain(state));
    else
        put<double>(folder, "discs_shear_strain", state.discs.get<double>("window_strain"));
    put<double>(folder, "discs_total_shear_strain", state.discs.get<double>("total_strain"));
    if (scene.fault_weakening) {
        std::vector<std::uint8_t> is_weak;
        for (std::uint8_t material : d.material)
            is_weak.push_back(material == weak);
        put<std::uint8_t>(folder, "discs_weak", is_weak);
    }
    if (scene.bonds) {
        const ConstContactColumns c = contact_columns(state);
        const std::vector<bool> touches = touching(state);
        std::vector<double> broken, bonded;
        std::vector<double> all(d.x.size(), 0.0), unbonded(d.x.size(), 0.0);
        for (std::size_t k = 0; k < touches.size(); ++k) {
            const auto i = static_cast<std::size_t>(c.first[k]);
            const auto j = static_cast<std::size_t>(c.second[k]);
            if (touches[k] || c.bonded[k]) {
                auto& lines = c.bonded[k] ? bonded : broken;
                const bool in_sediment = d.stratum[i] > 0 && d.stratum[j] > 0;
                lines.insert(lines.end(),
                             {d.x[i], d.y[i], d.x[j], d.y[j], in_sediment ? 1.0 : 0.0});
                for (std::size_t disc : {i, j}) {
                    all[disc] += 1.0;
                    unbonded[disc] += !c.bonded[k];
                }
            }
        }
        put<double>(folder, "broken", broken, 5);
        put<double>(folder, "bonded", bonded, 5);
        for (std::size_t i = 0; i < all.size(); ++i)
            unbonded[i] = all[i] > 0.0 ? unbonded[i] / all[i] : 1.0;
        put<double>(folder, "discs_unbonded_share", unbonded);
    }
    const Chain& detachment = base.surfaces.front().chain;
    const Chain standing = standing_base(base, state).surfaces.front().chain;
    const double wall = scene.hanging_wall->length + state.clock.extension;
    std::vector<double> line;
    double length = 0.0;
    for (const Segment& s : standing)
        length += s.length;
    for (int k = 0; k <= 2000; ++k) {
        const Point p = point_at(standing, length * k / 2000);
        if (p.x <= wall)
            line.insert(line.end(), {p.x, p.y});
    }
    put<double>(folder, "detachment", line, 2);

    std::vector<double> rows;
    if (scene.basin_water) {
        const double width = water_column_width(scene.hanging_wall->mean_radius);
        const double level = scene.basin_water->level;
        rows = {0.0, level, level}; // the shore at the breakaway
        double x = 0.5 * width;
        for (const double water : water_depths(state, level, width)) {
            rows.insert(rows.end(), {x, level - water, level});
            x += width;
        }
        put<double>(folder, "water", rows, 3);
        rows.clear();
    }
    const Setting setting = make_setting(scene);
    const Profile profile = measure_profile(setting, state, base);
    for (std::size_t k = 0; k < profile.x.size(); ++k)
        rows.insert(rows.end(),
                    {profile.x[k], profile.pre_rift_top[k], profile.sediment_thickness[k]});
    put<double>(folder, "profile", rows, 3);

    const Measures m = measure(setting, state, base, events);
    if (m.inclined_shear_angle) {
        const auto put_curve = [&](const char* name, const std::vector<Point>& curve) {
            rows.clear();
            for (Point p : curve)
                rows.insert(rows.end(), {p.x, p.y});
            put<double>(folder, name, rows, 2);
        };
        const double extension = state.clock.extension;
        put_curve("predicted_shear",
                  inclined_shear_top(detachment, extension, *m.inclined_shear_angle, wall));
        put_curve("predicted_normals", normals_top(detachment, extension, wall));
    }
    if (m.depocentres) {
        rows.clear();
        for (const Depocentre& c : *m.depocentres)
            rows.insert(rows.end(), {c.x, c.thickness, c.prominence});
        put<double>(folder, "depocentres", rows, 3);
    }
    rows.clear();
    for (std::size_t k = 0; k < faults.faults.size(); ++k) {
        const Fault& f = faults.faults[k];
        for (Point p : f.trace.points)
            rows.insert(rows.end(), {static_cast<double>(k), p.x, p.y, f.rate});
    }
    put<double>(folder, "faults", rows, 4);

    nlohmann::json frame = {
        {"scene", scene.name},
        {"title", scene.description},
        {"extension_m", state.clock.extension},
        {"time_a", state.clock.extension / scene.extension.rate},
        {"level_m", scene.sedimentation ? scene.sedimentation->level : 0.0},
        {"mean_radius_m", state.mean_radius},
        {"right_wall_x_m", wall},
        {"strata", d.stratum.empty() ? 0 : *std::ranges::max_element(d.stratum)},
        {"layer_m", 1000.0},
        {"seed", scene.seed},
        {"accuracy", scene.accuracy},
        {"effects", effect_names(scene)},
        {"strain_window_m", strain_window},
        {"thickness_m", scene.hanging_wall->thickness},
    };
    const auto add = [&](const char* name, const std::optional<double>& value) {
        if (value)
            frame[name] = *value;
    };
    add("inclined_shear_angle_deg", m.inclined_shear_angle);
    add("area_balance", m.area_balance);
    add("halfgraben_area_share", m.halfgraben_area_share);
    add("predicted_halfgraben_area_share", m.predicted_halfgraben_area_share);
    add("rollover_tilt_deg", m.rollover_tilt);
    add("predicted_tilt_deg", m.predicted_tilt);
    std::ofstream(folder / "frame.json") << frame.dump(1);
}

} // namespace

FigureFrames::FigureFrames(const fs::path& folder) : folder_(folder), data_(folder) {}

void FigureFrames::add(const Scene& scene, const State& state, const RigidBase& base,
                       std::span<const std::unique_ptr<Event>> events, const FaultReport& faults) {
    const fs::path frame = data_.path / fmt::format("{:06d}", frames_++);
    fs::create_directories(frame);
    export_frame(scene, state, base, events, faults, frame);
}

void FigureFrames::draw(const std::string& kind) const {
    const std::string problem =
        run_drawing_script("figures.py", {kind, data_.path.string(), folder_.string()});
    if (!problem.empty())
        throw StorageError(problem);
}

std::string draw_figures(const Scene& scene, const State& state, const RigidBase& base,
                         std::span<const std::unique_ptr<Event>> events, const FaultReport& faults,
                         const fs::path& folder) {
    try {
        FigureFrames frames(folder);
        frames.add(scene, state, base, events, faults);
        frames.draw("sections");
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

} // namespace listric
