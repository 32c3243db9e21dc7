#include "apps/summary.hpp"

#include "apps/effects.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace listric {

namespace {

/// Visits every measure that is a number: name and value, if it has one.
template <class Visit> void for_each_measure(const Measures& m, Visit&& visit) {
    visit("basin_area_m2", std::optional(m.basin_area));
    visit("area_balance", m.area_balance);
    visit("cutoff_x_m", m.cutoff ? std::optional(m.cutoff->x) : std::nullopt);
    visit("cutoff_z_m", m.cutoff ? std::optional(m.cutoff->y) : std::nullopt);
    visit("rollover_tilt_deg", m.rollover_tilt);
    visit("strain_top10", m.strain_top10);
    visit("strain_top10_cumulative", m.strain_top10_cumulative);
    visit("strain_gini", m.strain_gini);
    visit("basement_unbonded_fraction", m.basement_unbonded_fraction);
    visit("weak_fraction", m.weak_fraction);
    visit("volume_error_fraction", m.volume_error_fraction);
    visit("mass_error_fraction", std::optional(m.mass_error_fraction));
    visit("unbalanced_ratio_mean", std::optional(m.unbalanced_ratio_mean));
    visit("unbalanced_ratio_max", std::optional(m.unbalanced_ratio_max));
    visit("inertial_number", std::optional(m.inertial_number));
}

} // namespace

std::vector<std::pair<std::string, double>> history_row(const State& state, const Measures& m) {
    std::vector<std::pair<std::string, double>> row = {
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
        text += (text.empty() ? "" : ",") + column.name;
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
                         const RunRecord& record, const Measures& m, double wall_seconds,
                         std::uint64_t state_hash) {
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
    for_each_measure(m, [&](const char* name, std::optional<double> value) {
        if (value && std::isfinite(*value))
            json[name] = *value;
    });
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
    if (m.faults) {
        auto& list = json["faults"] = nlohmann::ordered_json::array();
        for (const Fault& f : *m.faults)
            list.push_back({{"x_top_m", f.top.x},
                            {"z_top_m", -f.top.y},
                            {"x_bottom_m", f.bottom.x},
                            {"z_bottom_m", -f.bottom.y},
                            {"dip_deg", f.dip},
                            {"sense", f.normal ? "normal" : "reverse"},
                            {"rate_mm_per_a", f.rate},
                            {"born_at_m", f.born_at}});
    }
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
