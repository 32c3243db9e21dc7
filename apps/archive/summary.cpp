#include "apps/archive/summary.hpp"

#include "apps/archive/json_file.hpp"
#include "apps/archive/traced_faults.hpp"
#include "apps/support/fineness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>

namespace listric::archive {

using namespace dem;
using namespace measures;

namespace {

/// Every measure that is a number; NaN: no meaning in this run.
NamedNumbers numbers_of(const Measures& m) {
    NamedNumbers numbers;
    for (const MeasureName& measure : measure_names())
        numbers.emplace_back(measure.name, measure.value(m).value_or(std::nan("")));
    return numbers;
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
        {"ranks", content.ranks},
        {"cycle_level", content.cycle},
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
    for (const auto& [name, value] : numbers_of(m))
        put(json, name, value);
    for (const auto& [name, value] : content.numbers)
        put(json, name, value);
    if (m.quasi_static)
        json["quasi_static"] = *m.quasi_static;
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

Json bonded_list(const std::vector<BondedLayer>& layers) {
    std::vector<NamedNumbers> rows;
    for (const BondedLayer& layer : layers)
        rows.push_back({{"depth_m", layer.depth}, {"bonded_fraction", layer.share}});
    return list(rows);
}

/// @param steps  in a metre, of the trace's points
Json fault_object(const Fault& f, double steps) {
    Json throws = Json::object();
    for (const auto& [stratum, value] : f.throws)
        throws[fmt::format("{}", stratum)] = value;
    Json points = Json::array();
    for (Point p : f.trace.points)
        points.push_back({std::round(steps * p.x) / steps, std::round(-steps * p.y) / steps});
    Json json = trace_object(f.trace, f.dip, f.normal);
    json.update({{"attitude", f.synthetic ? "synthetic" : "antithetic"},
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
        json["pre_rift_throw_m"] = *f.pre_rift_throw;
    return json;
}

/// The faults, and what they have in common.
void add_faults(Json& json, const FaultReport& report, double steps) {
    put(json, "fault_width_diameters", report.width);
    put(json, "antithetic_foot_x_m", report.antithetic_foot);
    if (report.main_antithetic)
        json["main_antithetic_fault"] = *report.main_antithetic;
    if (report.main_synthetic)
        json["main_synthetic_fault"] = *report.main_synthetic;
    put(json, "sediment_weak_off_fault_fraction", report.sediment_weak_off_fault_fraction);
    Json& faults = json["faults"] = Json::array();
    for (const Fault& f : report.faults)
        faults.push_back(fault_object(f, steps));
}

/// Picked horizons; those that are compared with nothing say why.
Json observed_list(const std::vector<ObservedHorizon>& rows) {
    Json all = Json::array();
    for (const ObservedHorizon& row : rows) {
        Json& json = all.emplace_back(Json{{"name", row.name}});
        if (!row.objection.empty())
            json["outside"] = row.objection;
        if (!row.misfit)
            continue;
        json.update({{"stratum", *row.stratum},
                     {"mean_m", row.misfit->mean},
                     {"largest_m", row.misfit->largest},
                     {"largest_at_x_m", row.misfit->worst.x},
                     {"points", row.points},
                     {"points_compared", row.misfit->compared}});
    }
    return all;
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

std::string summary_json(const SummaryContent& content) {
    Json json = summary_head(content);
    add_numbers(json, content);
    json["provenance"] = content.provenance;
    json["effects"] = content.effects;
    json["time_by_part_s"] = seconds_by_part(content.record.seconds_by_part, content.wall_seconds);
    if (content.measures.depocentres)
        json["depocentres"] = depocentre_list(*content.measures.depocentres);
    if (content.measures.old_sediment_bonded_profile)
        json["old_sediment_bonded_profile"] =
            bonded_list(*content.measures.old_sediment_bonded_profile);
    for (const auto& [name, objects] : content.lists)
        json[name] = list(objects);
    if (!content.observed.empty())
        json["observed"] = observed_list(content.observed);
    add_faults(json, content.faults, fineness(content.state.mean_radius));
    return to_text(json, 2) + "\n";
}

std::optional<double> summary_extension(const std::filesystem::path& summary) {
    const JsonObject json = object_in(summary);
    return is_true_at(json, "finished") ? number_at(json, "extension_m") : std::nullopt;
}

} // namespace listric::archive
