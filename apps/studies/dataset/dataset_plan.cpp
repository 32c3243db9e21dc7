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

PlanTable<DatasetSettings> settings_table() {
    using S = DatasetSettings;
    constexpr Range size{.from = 16, .to = 8192};
    return {
        "labelled seismic sections, one of each run (listric dataset)",
        {plan_key("split_by", at<&S::split_by>, "parameter whose values are in one split each"),
         plan_key("validation", at<&S::validation>, "its values of the split for validation"),
         plan_key("test", at<&S::test>, "its values of the split for tests"),
         plan_key("licence", at<&S::licence>, "of the data set, for its card"),
         plan_key("author", at<&S::author>, "of the data set, for its card"),
         plan_key("traces", at<&S::traces>, "of a section, from the breakaway on", size),
         plan_key("samples", at<&S::samples>, "of a trace", size),
         plan_key("trace_spacing_m", at<&S::trace_spacing>, "between traces", between(1, 1e3), "m"),
         plan_key("in_depth", at<&S::in_depth>, "samples by depth instead of two-way time"),
         plan_key("sample_interval_s", at<&S::sample_interval>, "of time", between(5e-4, 0.1), "s"),
         plan_key("sample_interval_m", at<&S::depth_interval>, "of depth", between(0.5, 100), "m"),
         plan_key("frequency_hz", at<&S::frequency>, "least and greatest of the wavelet",
                  between(1, 1e3), "Hz"),
         plan_key("quality", at<&S::quality>, "least and greatest Q of rock", between(5, 1e6)),
         plan_key("noise", at<&S::noise>, "least and greatest noise over reflections, both as rms",
                  between(0, 10)),
         plan_key("lateral_m", at<&S::lateral>, "least and greatest width of the point spread",
                  between(0, 1e4), "m"),
         plan_key("layer_m", at<&S::layer>, "least and greatest thickness of pre-rift layers",
                  between(20, 1e4), "m"),
         plan_key("contrast", at<&S::contrast>, "standard deviation of layers' velocities",
                  between(0, 0.3)),
         plan_key("fault_width_samples", at<&S::fault_width>, "of a line in the mask",
                  between(1, 100)),
         plan_key("least_throw_m", at<&S::least_throw>, "of a fault that is marked",
                  between(0, 1e4), "m"),
         plan_key("least_height_m", at<&S::least_height>, "of what is marked of a fault",
                  between(0, 1e5), "m")},
        {"split_by"}};
}

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
    plan.settings = settings_table().read(table);
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
    plan.text = write(settings_table().parameters, &plan.settings);
    return plan;
}

nlohmann::ordered_json dataset_schema() { return settings_table().schema(); }

} // namespace listric
