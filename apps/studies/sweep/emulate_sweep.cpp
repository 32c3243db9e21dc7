#include "apps/archive/folder/output_folder.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/studies/sweep/sweep.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/python.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>

namespace listric {

namespace {

namespace fs = std::filesystem;

/// Ends of a parameter's values. Throws UsageError where they are words.
std::pair<double, double> ends_of(const SweepParameter& parameter, const fs::path& plan) {
    if (parameter.range)
        return *parameter.range;
    std::vector<double> numbers;
    for (const SweepValue& value : parameter.values)
        if (value.number)
            numbers.push_back(*value.number);
    if (numbers.size() < parameter.values.size())
        throw UsageError(fmt::format("{}: {} has words: an emulator goes between numbers",
                                     plan.string(), parameter.name));
    const auto [least, greatest] = std::ranges::minmax(numbers);
    if (!(least < greatest))
        throw UsageError(fmt::format("{}: {} has one value", plan.string(), parameter.name));
    return {least, greatest};
}

} // namespace

void emulate_sweep(const SweepRequest& request, int suggest) {
    const SweepPlan plan = load_sweep_plan(request.plan);
    const fs::path folder = sweep_folder(request, plan), table = folder / "sweep.csv";
    if (!fs::exists(table))
        throw UsageError(table.string() + ": there is no such table; make the runs first, or "
                                          "--merge what there is");
    archive::require_own(
        std::vector<archive::OwnFile>{{folder / "emulator.csv", "measure,use,points"},
                                      {folder / "emulator.png", "Listric"}},
        {});
    nlohmann::ordered_json order{{"parameters", nlohmann::ordered_json::array()},
                                 {"measures", nlohmann::ordered_json::array()}};
    for (const SweepParameter& parameter : plan.parameters) {
        const auto [least, greatest] = ends_of(parameter, request.plan);
        order["parameters"].push_back({parameter.name, least, greatest});
    }
    for (const SweepMeasure& measure : plan.measures)
        order["measures"].push_back(measure.text);
    const TemporaryFolder place(folder);
    write_text(place.path / "order.json", to_text(order));
    run_script_with("sklearn", "python3-sklearn", "emulator.py",
                    {fs::absolute(table).string(), (place.path / "order.json").string(),
                     fs::absolute(folder).string(), std::to_string(suggest)});
    std::cout << read_text(place.path / "said.txt");
}

} // namespace listric
