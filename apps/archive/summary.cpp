#include "apps/archive/summary.hpp"

#include "apps/measures/of_effects.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/footwall_coupling.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace listric {

using namespace dem;
using namespace measures;

namespace {

/// Every measure that is a number; NaN: no meaning in this run.
NamedNumbers numbers_of(const Measures& m) {
    NamedNumbers numbers;
    for (const MeasureName& measure : measure_names())
        numbers.emplace_back(measure.name, measure.value(m).value_or(std::nan("")));
    if (m.energy)
        append(numbers, energy_numbers(*m.energy));
    return numbers;
}

/// The faults, and what they have in common.
void add_faults(nlohmann::ordered_json& json, const FaultReport& report) {
    const auto put = [&](const char* name, std::optional<double> value) {
        if (value && std::isfinite(*value))
            json[name] = *value;
    };
    put("fault_width_diameters", report.width);
    put("antithetic_foot_x_m", report.antithetic_foot);
    if (report.main_antithetic)
        json["main_antithetic_fault"] = *report.main_antithetic;
    if (report.main_synthetic)
        json["main_synthetic_fault"] = *report.main_synthetic;
    put("sediment_weak_off_fault_fraction", report.sediment_weak_off_fault_fraction);
    auto& list = json["faults"] = nlohmann::ordered_json::array();
    for (const Fault& f : report.faults) {
        const Point top = f.trace.points.front(), bottom = f.trace.points.back();
        auto throws = nlohmann::ordered_json::object();
        for (const auto& [stratum, value] : f.throws)
            throws[fmt::format("{}", stratum)] = value;
        auto points = nlohmann::ordered_json::array();
        for (Point p : f.trace.points)
            points.push_back({std::round(p.x), std::round(-p.y)});
        list.push_back({{"x_top_m", top.x},
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
                        {"points_m", points}});
        if (f.pre_rift_throw)
            list.back()["pre_rift_throw_m"] = *f.pre_rift_throw;
    }
}

} // namespace

NamedNumbers history_row(const State& state, const Measures& m) {
    NamedNumbers row = {
        {"extension_m", state.clock.extension},
        {"cycle", static_cast<double>(state.clock.cycle)},
        {"discs", static_cast<double>(state.discs.rows())},
    };
    append(row, numbers_of(m));
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

std::string summary_json(const Scene& scene, int threads, const State& state,
                         const RunRecord& record, const Measures& m, const FaultReport& faults,
                         double wall_seconds, std::uint64_t state_hash) {
    nlohmann::ordered_json json = {
        {"scene", scene.name},
        {"accuracy", scene.accuracy},
        {"seed", scene.seed},
        {"threads", threads},
        {"discs", state.discs.rows()},
        {"cycles", state.clock.cycle},
        {"wall_s", wall_seconds},
        {"predicted_wall_s", record.predicted_seconds},
        {"disc_steps_per_s", record.disc_steps / wall_seconds},
        {"finished", true},
        {"state_hash", fmt::format("{:016x}", state_hash)},
        {"extension_m", state.clock.extension},
    };
    for (const auto& [name, value] : numbers_of(m))
        if (std::isfinite(value))
            json[name] = value;
    for (const auto& [name, value] : footwall_summary(record.history, state))
        if (std::isfinite(value))
            json[name] = value;
    if (record.base_elements_difference)
        json["base_elements_difference"] = *record.base_elements_difference;
    if (record.base_resolved_difference)
        json["base_resolved_difference"] = *record.base_resolved_difference;
    if (m.quasi_static)
        json["quasi_static"] = *m.quasi_static;
    if (m.energy) {
        auto& list = json["energy_by_event_j_per_m"] = nlohmann::ordered_json::object();
        for (const auto& [event, work] : m.energy->by_event)
            list[event] = work;
    }
    json["effects"] = effect_names(scene);
    double named = 0.0;
    auto& parts = json["time_by_part_s"] = nlohmann::ordered_json::object();
    for (const auto& [part, seconds] : record.seconds_by_part) {
        parts[part] = seconds;
        named += seconds;
    }
    parts["other"] = std::max(0.0, wall_seconds - named);
    if (m.depocentres) {
        auto& list = json["depocentres"] = nlohmann::ordered_json::array();
        for (const Depocentre& d : *m.depocentres)
            list.push_back(
                {{"x_m", d.x}, {"thickness_m", d.thickness}, {"prominence_m", d.prominence}});
    }
    add_faults(json, faults);
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

} // namespace listric
