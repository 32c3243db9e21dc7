#include "apps/archive/summary.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <map>

namespace listric::archive {

using namespace dem;

namespace {

/// Visits every measure that is a number: name and value, if it has one.
template <class Visit> void for_each_measure(const Measures& m, Visit&& visit) {
    visit("basin_area_m2", std::optional(m.basin_area));
    visit("area_balance", m.area_balance);
    visit("cutoff_x_m", m.cutoff ? std::optional(m.cutoff->x) : std::nullopt);
    visit("cutoff_z_m", m.cutoff ? std::optional(m.cutoff->y) : std::nullopt);
    visit("rollover_tilt_deg", m.rollover_tilt);
    visit("breakaway_rotation_deg", m.breakaway_rotation);
    visit("toe_rotation_deg", m.toe_rotation);
    visit("lower_block_rotation_deg", m.lower_block_rotation);
    const auto visit_point = [&](const char* x, const char* z, const std::optional<Point>& p) {
        visit(x, p ? std::optional(p->x) : std::nullopt);
        visit(z, p ? std::optional(p->y) : std::nullopt);
    };
    visit_point("intervening_high_x_m", "intervening_high_z_m", m.intervening_high);
    visit("halfgraben_area_share", m.halfgraben_area_share);
    visit("dilation_area_m2", m.dilation_area);
    visit("depth_to_detachment_m", m.depth_to_detachment);
    visit("inclined_shear_angle_deg", m.inclined_shear_angle);
    visit("inclined_shear_misfit_m", m.inclined_shear_misfit);
    visit("normals_misfit_m", m.normals_misfit);
    visit("predicted_tilt_deg", m.predicted_tilt);
    visit_point("predicted_cutoff_x_m", "predicted_cutoff_z_m", m.predicted_cutoff);
    visit("predicted_halfgraben_area_share", m.predicted_halfgraben_area_share);
    visit("strain_top10", m.strain_top10);
    visit("strain_top10_cumulative", m.strain_top10_cumulative);
    visit("strain_gini", m.strain_gini);
    visit("basement_unbonded_fraction", m.basement_unbonded_fraction);
    visit("old_sediment_bonded_fraction", m.old_sediment_bonded_fraction);
    visit("weak_fraction", m.weak_fraction);
    visit("volume_error_fraction", m.volume_error_fraction);
    visit("deposited_fraction", m.deposited_fraction);
    visit("eroded_fraction", m.eroded_fraction);
    visit("mass_error_fraction", std::optional(m.mass_error_fraction));
    visit("unbalanced_ratio_mean", std::optional(m.unbalanced_ratio_mean));
    visit("unbalanced_ratio_max", std::optional(m.unbalanced_ratio_max));
    visit("inertial_number", std::optional(m.inertial_number));
    if (!m.energy)
        return;
    const EnergyBalance& e = *m.energy;
    const double work = e.boundary_work + e.gravity_work;
    for (const auto& [name, value] : std::initializer_list<std::pair<const char*, double>>{
             {"energy_boundary_work_j_per_m", e.boundary_work},
             {"energy_gravity_work_j_per_m", e.gravity_work},
             {"energy_events_j_per_m", e.events},
             {"energy_kinetic_j_per_m", e.stored.kinetic},
             {"energy_strain_normal_j_per_m", e.stored.normal_strain},
             {"energy_strain_shear_j_per_m", e.stored.shear_strain},
             {"energy_stored_change_j_per_m", e.stored_change},
             {"energy_friction_j_per_m", e.friction},
             {"energy_damping_j_per_m", e.damping},
             {"energy_bond_breaking_j_per_m", e.bond_breaking},
             {"energy_stepping_j_per_m", e.stepping}})
        visit(name, std::optional(value));
    visit("energy_base_work_j_per_m", e.base_work);
    visit("energy_residual", work != 0.0 ? std::optional(e.residual() / work) : std::nullopt);
}

using Json = nlohmann::ordered_json;

void put(Json& json, const std::string& name, std::optional<double> value) {
    if (value && std::isfinite(*value))
        json[name] = *value;
}

Json object(const NamedNumbers& numbers) {
    Json json = Json::object();
    for (const auto& [name, value] : numbers)
        json[name] = value;
    return json;
}

Json list(const std::vector<NamedNumbers>& objects) {
    Json json = Json::array();
    for (const NamedNumbers& numbers : objects)
        json.push_back(object(numbers));
    return json;
}

Json summary_head(const SummaryContent& content) {
    const RunRecord& record = content.record;
    return {
        {"scene", content.scene},
        {"accuracy", content.accuracy},
        {"seed", content.seed},
        {"threads", content.threads},
        {"discs", content.state.discs.rows()},
        {"cycles", content.state.clock.cycle},
        {"wall_s", content.wall_seconds},
        {"predicted_wall_s", record.predicted_seconds},
        {"disc_steps_per_s", record.disc_steps / content.wall_seconds},
        {"finished", true},
        {"state_hash", fmt::format("{:016x}", content.state_hash)},
        {"extension_m", content.state.clock.extension},
    };
}

void add_numbers(Json& json, const SummaryContent& content) {
    const Measures& m = content.measures;
    for_each_measure(
        m, [&](const char* name, std::optional<double> value) { put(json, name, value); });
    for (const auto& [name, value] : content.numbers)
        put(json, name, value);
    if (m.quasi_static)
        json["quasi_static"] = *m.quasi_static;
    if (m.energy)
        json["energy_by_event_j_per_m"] =
            object({m.energy->by_event.begin(), m.energy->by_event.end()});
    for (const auto& [name, numbers] : content.objects)
        json[name] = object(numbers);
}

/// Wall time by part, s; what no part has counted is `other`.
Json seconds_by_part(const std::map<std::string, double>& parts, double wall_seconds) {
    Json json = Json::object();
    double named = 0.0;
    for (const auto& [part, seconds] : parts) {
        json[part] = seconds;
        named += seconds;
    }
    json["other"] = std::max(0.0, wall_seconds - named);
    return json;
}

Json depocentre_list(const std::vector<Depocentre>& depocentres) {
    std::vector<NamedNumbers> rows;
    for (const Depocentre& d : depocentres)
        rows.push_back(
            {{"x_m", d.x}, {"thickness_m", d.thickness}, {"prominence_m", d.prominence}});
    return list(rows);
}

Json fault_object(const Fault& f) {
    const Point top = f.trace.points.front(), bottom = f.trace.points.back();
    Json throws = Json::object();
    for (const auto& [stratum, value] : f.throws)
        throws[fmt::format("{}", stratum)] = value;
    Json points = Json::array();
    for (Point p : f.trace.points)
        points.push_back({std::round(p.x), std::round(-p.y)});
    Json json = {{"x_top_m", top.x},
                 {"z_top_m", -top.y},
                 {"x_bottom_m", bottom.x},
                 {"z_bottom_m", -bottom.y},
                 {"length_m", f.trace.length()},
                 {"dip_deg", f.dip},
                 {"sense", f.normal ? "normal" : "reverse"},
                 {"attitude", f.synthetic ? "synthetic" : "antithetic"},
                 {"rate_mm_per_a", f.rate},
                 {"width_diameters", f.width},
                 {"curvature_per_m", f.curvature},
                 {"born_at_m", f.born_at},
                 {"dip_at_birth_deg", f.dip_at_birth},
                 {"traced_since_m", f.traced_since},
                 {"footwall_turn_deg", f.footwall_turn},
                 {"foot_x_m", f.foot.x},
                 {"foot_z_m", -f.foot.y},
                 {"throw_m", throws},
                 {"points_m", points}};
    if (f.pre_rift_throw)
        json["pre_rift_throw_m"] = *f.pre_rift_throw;
    return json;
}

/// The faults, and what they have in common.
void add_faults(Json& json, const FaultReport& report) {
    put(json, "fault_width_diameters", report.width);
    put(json, "antithetic_foot_x_m", report.antithetic_foot);
    if (report.main_antithetic)
        json["main_antithetic_fault"] = *report.main_antithetic;
    if (report.main_synthetic)
        json["main_synthetic_fault"] = *report.main_synthetic;
    put(json, "sediment_weak_off_fault_fraction", report.sediment_weak_off_fault_fraction);
    Json& faults = json["faults"] = Json::array();
    for (const Fault& f : report.faults)
        faults.push_back(fault_object(f));
}

} // namespace

NamedNumbers history_row(const State& state, const Measures& m) {
    NamedNumbers row = {
        {"extension_m", state.clock.extension},
        {"cycle", static_cast<double>(state.clock.cycle)},
        {"discs", static_cast<double>(state.discs.rows())},
    };
    for_each_measure(m, [&](const char* name, std::optional<double> value) {
        row.emplace_back(name, value.value_or(std::nan("")));
    });
    return row;
}

std::string to_csv(const Table& table) {
    std::string text;
    for (const Column& column : table.columns())
        text.append(text.empty() ? "" : ",").append(column.name);
    text += '\n';
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const char* separator = "";
        for (const Column& column : table.columns()) {
            const double value = std::get<std::vector<double>>(column.values)[row];
            text += separator;
            text += std::isnan(value) ? std::string() : fmt::format("{}", value);
            separator = ",";
        }
        text += '\n';
    }
    return text;
}

std::string summary_json(const SummaryContent& content) {
    Json json = summary_head(content);
    add_numbers(json, content);
    json["effects"] = content.effects;
    json["time_by_part_s"] = seconds_by_part(content.record.seconds_by_part, content.wall_seconds);
    if (content.measures.depocentres)
        json["depocentres"] = depocentre_list(*content.measures.depocentres);
    for (const auto& [name, objects] : content.lists)
        json[name] = list(objects);
    add_faults(json, content.faults);
    return json.dump(2) + "\n";
}

std::optional<double> summary_extension(const std::filesystem::path& summary) {
    std::ifstream in(summary);
    const auto json = nlohmann::json::parse(in, nullptr, false);
    if (!json.is_object() || !json.value("finished", false) || !json.contains("extension_m") ||
        !json["extension_m"].is_number())
        return std::nullopt;
    return json["extension_m"].get<double>();
}

} // namespace listric::archive
