#pragma once

#include "apps/run/exit_code.hpp"
#include "apps/scene/scene_file.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace listric {

/// A call of the program: what reads its options, and what it does once they are read.
struct Command {
    CLI::App* parser;
    std::function<ExitCode()> call; ///< throws what ending_of() knows
    std::string after_stop = {};    ///< what to do after an interruption, if that is to be said
};

// Each adds a call and its options to the program's.
Command add_run(CLI::App& program);
Command add_scenes(CLI::App& program);
Command add_explain(CLI::App& program);
Command add_export(CLI::App& program);
Command add_figures(CLI::App& program);
Command add_flexure(CLI::App& program);
Command add_report(CLI::App& program);
Command add_check(CLI::App& program);
Command add_bench(CLI::App& program);
Command add_laboratory(CLI::App& program);
Command add_calibrate(CLI::App& program);
Command add_study(CLI::App& program);
Command add_sweep(CLI::App& program);
Command add_schema(CLI::App& program);
Command add_completion(CLI::App& program);
Command add_manual(CLI::App& program);
Command add_trace(CLI::App& program);
Command add_validate(CLI::App& program);

// Options that several calls share.

/// Cores that this process may use.
int all_threads();

/// Names of the accuracy levels.
std::vector<std::string> accuracy_names();

/// --threads; more than all_threads() are told and not started.
CLI::Option* add_threads(CLI::App& command, int& threads);

/// An option that may be given several times, with one word each time.
void add_words(CLI::App& command, const char* option, std::vector<std::string>& words,
               const char* what);

/// An option of numbers, separated by commas or given several times.
CLI::Option* add_numbers(CLI::App& command, const char* option, std::vector<double>& numbers,
                         const std::string& what);

/// SCENE and what changes it.
void add_scene(CLI::App& command, SceneRequest& request);

} // namespace listric
