#include "apps/studies/dataset/dataset_plan.hpp"

#include "apps/scene/toml/document.hpp"
#include "apps/studies/plan_file.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace listric {

namespace {

constexpr Shelf dataset_shelf{"plan of a data set",
                              "it needs scene, measures, [[vary]] and [dataset]", "", "studies"};

/// Refuses what is no pair of a least and a greatest value.
void check_drawn(const Entry& table, const char* key, const Drawn& drawn) {
    const toml::node* const node = table.node.as_table()->get(key);
    if (node && (drawn.size() != 2 || drawn[0] > drawn[1]))
        fail({*node, table.path + "." + key},
             "needs two numbers, [least, greatest]; equal ones leave no choice");
}

/// Values of the parameter that make a split.
std::vector<std::string> values_of_split(const Entry& table, const char* key,
                                         const std::string& text, const SweepParameter& parameter) {
    std::vector<std::string> values = words(text), known;
    for (const SweepValue& value : parameter.values)
        known.push_back(value.text);
    for (const std::string& value : values)
        if (std::ranges::find(known, value) == known.end())
            fail({*table.node.as_table()->get(key), table.path + "." + key},
                 fmt::format("{} has no value {}; {}", parameter.name, value,
                             advice(value, {known.begin(), known.end()})));
    return values;
}

} // namespace

std::string_view DatasetPlan::split_of(const SweepPoint& point) const {
    const std::string& value = point[split_parameter].text;
    const auto is_in = [&](const std::vector<std::string>& values) {
        return std::ranges::find(values, value) != values.end();
    };
    return is_in(test) ? "test" : is_in(validation) ? "validation" : "train";
}

DatasetPlan load_dataset_plan(const std::filesystem::path& name_or_path) {
    const std::filesystem::path file = plan_file(name_or_path);
    const toml::table document = read_document(dataset_shelf, file);
    const Entry top{document, ""};
    need(top, "[dataset], how sections are made (docs/guides/dataset.md)",
         document.contains(dataset_table));
    DatasetPlan plan{.sweep = load_sweep_plan(file)};
    const Entry table{*document.get(dataset_table), dataset_table};
    plan.settings = dataset_settings().read(table);
    const DatasetSettings& s = plan.settings;
    check_drawn(table, "frequency_hz", s.frequency);
    check_drawn(table, "quality", s.quality);
    check_drawn(table, "noise", s.noise);
    check_drawn(table, "lateral_m", s.lateral);
    check_drawn(table, "layer_m", s.layer);
    const auto& parameters = plan.sweep.parameters;
    const auto split = std::ranges::find(parameters, s.split_by, &SweepParameter::name);
    const Entry by{*table.node.as_table()->get("split_by"), "dataset.split_by"};
    if (split == parameters.end())
        fail(by, fmt::format("{}: no [[vary]] has this parameter", s.split_by));
    if (split->range)
        fail(by, fmt::format("{} has a range; a split needs values", s.split_by));
    plan.split_parameter = static_cast<std::size_t>(split - parameters.begin());
    plan.validation = values_of_split(table, "validation", s.validation, *split);
    plan.test = values_of_split(table, "test", s.test, *split);
    for (const std::string& value : plan.validation)
        if (std::ranges::find(plan.test, value) != plan.test.end())
            fail({*table.node.as_table()->get("test"), "dataset.test"},
                 fmt::format("{} is in validation, too; a split shares no value with another",
                             value));
    plan.text = write(dataset_settings().parameters, &plan.settings);
    return plan;
}

} // namespace listric
