#include "apps/studies/flexure_plan.hpp"

#include "apps/model/effects.hpp"
#include "apps/scene/scene_checks.hpp"
#include "apps/scene/toml/document.hpp"
#include "apps/scene/toml/schema_parts.hpp"
#include "apps/scene/toml/tables.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace listric {

namespace fs = std::filesystem;

namespace {

constexpr Shelf flexure_shelf{"flexure plan", "it needs [flexure]", "", "studies"};

constexpr std::string_view flexure_doc = "a load on the base alone, without discs";

/// A table of a plan, and the object whose parameters it has.
struct FlexureTable {
    std::string_view name, doc;
    std::vector<Parameter> parameters;
    void* object;
};

std::vector<FlexureTable> tables_of(FlexurePlan& plan) {
    const Effect& bender = *plan.base.effect;
    return {
        {"flexure", flexure_doc, flexure_parameters(), &plan.flexure},
        {"gravity",
         "of the rock that is displaced",
         {{"acceleration_m_per_s2",
           at<&FlexurePlan::gravity>,
           "m/s2",
           {.from = 1e-6, .to = 100},
           "g",
           "gravitational acceleration"}},
         &plan},
        {bender.name, bender.doc, bender.parameters, bender.address.reach(plan.base.parameters)}};
}

FlexurePlan default_plan() {
    const Effect& bender = base_bender(program_effects());
    FlexurePlan plan;
    plan.base = {&bender, bender.defaults()};
    return plan;
}

[[noreturn]] void fail_unknown(const Entry& entry, const std::vector<FlexureTable>& tables) {
    const std::vector<SceneTable> of_scenes = scene_tables(program_effects());
    if (entry.path == "materials" ||
        std::ranges::find(of_scenes, entry.path, &SceneTable::name) != of_scenes.end())
        fail(entry, "needs discs, which a plan with [flexure] does not have; leave out one of the "
                    "two");
    std::vector<std::string_view> allowed = keys(top_level());
    std::ranges::transform(tables, std::back_inserter(allowed), &FlexureTable::name);
    fail(entry, fmt::format("unknown {}, {}", entry.node.is_table() ? "table" : "key",
                            advice(entry.path, allowed)));
}

/// That the plate floats, and that the load bends it: waves shorter than it is thick do not, and
/// cells would be flat.
void check(const FlexurePlan& plan, const toml::table& document) {
    const BendingBase& base = plan.bending();
    const auto refuse = [&](std::string_view table, const char* key, const std::string& message) {
        fail(entry_at(document, fmt::format("{}.{}", table, key)), message);
    };
    if (!(base.floats_on() > base.infill_density))
        refuse(plan.base.effect->name, "mantle_density_kg_per_m3",
               fmt::format("is {}, allowed: above infill_density_kg_per_m3 = {}",
                           text(base.floats_on()), text(base.infill_density)));
    if (const std::string why = objection_to_densities(base); !why.empty())
        refuse(plan.base.effect->name, "crust_density_kg_per_m3", why);
    const auto refuse_short = [&](const char* key, double length) {
        const double least = 0.1 * base.elastic_thickness;
        if (length < least)
            refuse("flexure", key,
                   fmt::format("too short ({}), allowed: at least {}, a tenth of the elastic "
                               "thickness",
                               text(length), text(least)));
    };
    if (plan.flexure.load == FlexureLoad::sinusoid)
        refuse_short("wavelength_m", plan.flexure.wavelength);
    if (plan.flexure.load == FlexureLoad::strip)
        refuse_short("half_width_m", plan.flexure.half_width);
}

} // namespace

const std::vector<Parameter>& flexure_parameters() {
    using P = FlexureParameters;
    static const std::vector<Parameter> parameters{
        {"load", one_of<&P::load>({"line", "broken", "strip", "sinusoid"}), "", ranges::any, "",
         "line load on a continuous plate or on the end of a broken one, strip load, sinusoidal "
         "load",
         "A broken plate sinks twice as far at its end as a continuous one under the line load."},
        {"line_load_n_per_m", at<&P::line_load>, "N/m", between(1, 1e15), "V",
         "line load, downward; the end of a broken plate carries half of it",
         "Deflection is proportional to it."},
        {"pressure_pa", at<&P::pressure>, "Pa", between(1, 1e10), "",
         "pressure of the strip, downward; amplitude of the sinusoid",
         "Deflection is proportional to it."},
        {"half_width_m", at<&P::half_width>, "m", between(1, 1e6), "",
         "half the width of the strip",
         "Raising it brings the middle of the strip toward local isostasy."},
        {"wavelength_m", at<&P::wavelength>, "m", between(100, 1e7), "lambda",
         "wavelength of the sinusoid",
         "Raising it brings the deflection toward local isostasy; short waves hardly bend the "
         "base."},
    };
    return parameters;
}

fs::path find_scene_or_plan(const std::string& name_or_path) {
    const fs::path shipped = flexure_shelf.path() / "flexure.toml";
    std::error_code error;
    const bool is_scene =
        is_path(name_or_path) || fs::exists(scenes.path() / (name_or_path + ".toml"), error);
    return name_or_path == shipped.stem() && !is_scene ? shipped : scenes.find(name_or_path);
}

bool is_flexure_plan(const std::string& name_or_path) {
    try {
        return read_document(flexure_shelf, find_scene_or_plan(name_or_path)).contains("flexure");
    } catch (const SceneError&) {
        return false; // load_scene() says why
    }
}

FlexurePlan load_flexure_plan(const SceneRequest& request) {
    FlexurePlan plan = default_plan();
    plan.file = find_scene_or_plan(request.scene);
    plan.name = plan.file.stem().string();
    if (!request.without.empty())
        fail(fmt::format("--without {}: a plan of flexure has no effects", request.without[0]));
    toml::table document = merged_document(request, plan.file);
    take_out_former_keys(document, program_effects());
    if (!document.contains("flexure"))
        fail({document, "flexure"}, fmt::format("is missing; {}", flexure_shelf.contents));
    const std::vector<FlexureTable> tables = tables_of(plan);
    for (const auto& [key, node] : document) {
        const Entry entry{node, std::string(key.str())};
        const auto parameter = std::ranges::find(top_level(), key.str(), &Parameter::key);
        const auto table = std::ranges::find(tables, key.str(), &FlexureTable::name);
        if (parameter != top_level().end())
            read(entry, *parameter, static_cast<Heading*>(&plan));
        else if (table != tables.end())
            read_table(entry, table->parameters, table->object);
        else
            fail_unknown(entry, tables);
    }
    check_name(plan, document, plan.file);
    check(plan, document);
    return plan;
}

std::string to_toml(const FlexurePlan& plan) {
    FlexurePlan shown = plan;
    std::string lines = fmt::format("# All parameters in force.\n\n{}",
                                    write(top_level(), static_cast<const Heading*>(&plan)));
    for (const FlexureTable& table : tables_of(shown))
        lines += fmt::format("\n[{}]  # {}\n{}", table.name, table.doc,
                             write(table.parameters, table.object));
    return lines;
}

std::string flexure_schema() {
    FlexurePlan plan = default_plan();
    const Heading heading;
    auto schema = table_schema("", top_level(), &heading);
    for (const FlexureTable& table : tables_of(plan))
        schema["properties"][std::string(table.name)] =
            table_schema(table.doc, table.parameters, table.object);
    return finished_schema("A plan of flexure of Listric", schema);
}

std::string flexure_reference() {
    const FlexureParameters defaults;
    std::string lines =
        fmt::format("\n[flexure] of a plan of its own (listric flexure), with [gravity] and [{}] "
                    "if need be: {}\n",
                    base_bender(program_effects()).name, flexure_doc);
    for (const Parameter& parameter : flexure_parameters())
        lines += explain(parameter, &defaults);
    return lines;
}

} // namespace listric
