#include "apps/archive/tables/rock_record.hpp"
#include "apps/commands/command.hpp"
#include "apps/commands/explain.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/model.hpp"
#include "apps/run/forecast/oversize.hpp"
#include "apps/scene/parameters/material_file.hpp"
#include "apps/scene/toml/document.hpp"
#include "apps/studies/dataset/dataset_plan.hpp"
#include "apps/studies/flexure_plan.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"
#include "apps/studies/validation/validation_plan.hpp"
#include "apps/support/words/text.hpp"
#include "dem/numbers/elementary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>
#include <span>
#include <utility>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// Time that runs take on this machine, whose speed is measured once for scenes of about the same
/// size.
class Times {
public:
    Prediction of(const Scene& scene) {
        constexpr int largest = 17; // packings of 130,000 discs are as slow as larger ones
        const double discs = static_cast<double>(estimated_discs(scene));
        const int size = std::min(largest, static_cast<int>(dem::logarithm_to_base_2(discs)));
        const bool accounted = make_parts(scene).accounts_energy;
        const auto [speed, is_new] = speeds_.try_emplace({size, accounted});
        if (is_new)
            speed->second = measure_speed(std::size_t{1} << size, threads_, 0.1, accounted);
        return predict(scene, speed->second);
    }

private:
    int threads_ = all_threads();
    std::map<std::pair<int, bool>, CycleSpeed> speeds_; ///< by power of two, and with the account
};

/// "about 16,700": three digits, thousands apart.
std::string about(double number) {
    const double unit =
        dem::power(10.0, std::max(0.0, std::floor(dem::logarithm_to_base_10(number)) - 2.0));
    std::string digits = fmt::format("{:.0f}", unit * std::round(number / unit));
    for (std::size_t at = digits.size(); at > 3;)
        digits.insert(at -= 3, 1, ',');
    return "about " + digits;
}

/// Warnings, a line each.
std::string lines_of(const std::vector<std::string>& warnings) {
    std::string lines;
    for (const std::string& warning : warnings)
        lines += "\nwarning: " + warning;
    return lines;
}

std::string check_scene_file(const std::string& file, const toml::table& document, Times& times) {
    const SceneRequest request{.scene = file};
    const auto tables =
        std::ranges::count_if(document, [](const auto& entry) { return entry.second.is_table(); });
    if (document.contains("flexure")) {
        load_flexure_plan(request);
        return fmt::format("{} tables, no discs, a few seconds", tables);
    }
    const Scene scene = load_scene(request);
    if (const auto oversize = oversize_of(scene, program_effects(), room_for(".")))
        refuse_scene(request, oversize->parameter, oversize->message);
    const Prediction p = times.of(scene);
    const auto discs = static_cast<double>(p.discs_at_start);
    const auto at_end = static_cast<double>(p.discs_at_end);
    return fmt::format(
        "{} tables, {} discs{}, {}, {}; {}{}{}", tables, about(discs),
        at_end > 3.0 * discs ? fmt::format(" and {} at the end", about(at_end)) : "",
        duration(p.seconds), output_text(p), rock_line(scene, archive::known_rocks(scene)),
        scene.picked_fault ? "; " + describe(*scene.picked_fault, *scene.detachment) : "",
        lines_of(scene.warnings));
}

std::string check_sweep(const fs::path& file, Times& times) {
    const SweepPlan plan = load_sweep_plan(file);
    constexpr std::size_t most_tried = 5000; // half a minute
    const std::vector<SweepPoint> points = sweep_points(plan);
    const std::size_t tried = std::min(points.size(), most_tried);
    const std::vector<std::string> warnings =
        check_points(plan, std::span(points).first(tried), file);
    if (plan.makes_dataset)
        load_dataset_plan(file);
    const Scene scene = scene_at(plan, points.front(), plan.first_seed);
    const auto runs = points.size() * static_cast<std::size_t>(plan.seeds);
    std::string text = fmt::format("a sweep of {} runs", runs);
    if (tried < points.size() && plan.design != SweepDesign::list) // whose points it read
        text += fmt::format(", of whose {} points the first {} were tried", points.size(), tried);
    const Prediction p = times.of(scene);
    const auto all = static_cast<double>(runs);
    text += fmt::format(", {} and {} of disk if each takes as much as {}",
                        duration(all * p.seconds), size_text(all * p.disk), scene.name);
    return text + lines_of(warnings);
}

std::string check_validation(const fs::path& file) {
    const ValidationPlan plan = load_validation_plan(file);
    std::vector<std::string> warnings;
    for (const ValidationRun& run : plan.runs) {
        SceneRequest request{.scene = run.scene, .set = run.set, .without = run.without};
        if (!run.accuracy.empty())
            request.accuracy = run.accuracy;
        try {
            for (const std::string& warning : load_scene(request).warnings)
                warnings.push_back(fmt::format("run {}: {}", run.name, warning));
        } catch (const SceneError& error) {
            fail(fmt::format("run {}: {}", run.name, error.what()));
        }
    }
    return fmt::format("a validation of {} experiments, {} runs a seed{}", plan.experiments.size(),
                       plan.runs.size(), lines_of(warnings));
}

/// Good news of a file, whose keys show its purpose. Throws SceneError.
std::string check(const std::string& name, const fs::path& file, Times& times) {
    const toml::table document = read_document(scenes, file);
    const auto has = [&](std::initializer_list<std::string_view> keys) {
        return std::ranges::any_of(keys, [&](auto key) { return document.contains(key); });
    };
    if (has({"scene", "measures", "vary"}))
        return check_sweep(file, times);
    if (has({"experiment", "run"}))
        return check_validation(file);
    const auto is_of_material = [](const auto& entry) {
        const std::string_view key = entry.first;
        return key == "description" || key == "material" || key == "bonds" || key == "pores";
    };
    if (document.contains("material") && std::ranges::all_of(document, is_of_material))
        return fmt::format("a material{}", read_material(file).bonds ? " that is bonded" : "");
    return check_scene_file(name, document, times);
}

/// Prints a line on the file. What is wrong is told as `run` tells it.
ExitCode report(const std::string& name, Times& times) {
    Ending ending{ExitCode::done, {}};
    fs::path file = name;
    std::string line;
    try {
        file = find_scene_or_plan(name);
        line = fmt::format("{}: correct: {}", shown(name), shown_lines(check(name, file, times)));
    } catch (const std::exception&) {
        ending = ending_of(std::current_exception());
        const bool tells_file = name.empty() || ending.message.starts_with(name + ":") ||
                                ending.message.starts_with(file.string() + ":");
        line = shown(tells_file ? ending.message : fmt::format("{}: {}", name, ending.message));
    }
    std::cout << line << std::endl;
    return ending.code;
}

} // namespace

Command add_check(CLI::App& program) {
    const auto files = std::make_shared<std::vector<std::string>>();
    CLI::App* command =
        add_call(program, {"Run",
                           "check",
                           "check scenes, plans and materials",
                           "docs/guides/editors.md",
                           {{{"check my-scene.toml", "errors, with line and cure"},
                             {"check plan.toml", "a plan of a sweep or of a validation"},
                             {"check lis1 my-rock.toml", "several files at once"}}}});
    command->add_option("FILE", *files, "scenes, by name or file, plans or materials")
        ->type_name("SCENE")
        ->required()
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    return {command, [files] {
                Times times;
                ExitCode worst = ExitCode::done;
                for (const std::string& file : *files)
                    worst = std::max(worst, report(file, times));
                return worst;
            }};
}

} // namespace listric
