#pragma once

#include "apps/commands/help/help.hpp"
#include "apps/run/batch.hpp"
#include "apps/run/exit_code.hpp"
#include "apps/scene/scene_file.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace listric {

/// A call of the program: what reads its options, and what it does once they are read.
struct Command {
    CLI::App* parser;
    std::function<ExitCode()> call; ///< throws what ending_of() knows
    std::string after_stop = {};    ///< what to do after an interruption, if that is to be said
};

/// All calls of the program, in the order of the overview. They own what is parsed.
[[nodiscard]] std::vector<Command> add_calls(CLI::App& program);

// Each adds a call and its options to the program's.
Command add_run(CLI::App& program);
Command add_new(CLI::App& program);
Command add_draw(CLI::App& program);
Command add_scenes(CLI::App& program);
Command add_explain(CLI::App& program);
Command add_export(CLI::App& program);
Command add_figures(CLI::App& program);
Command add_flexure(CLI::App& program);
Command add_report(CLI::App& program);
Command add_cite(CLI::App& program);
Command add_view(CLI::App& program);
Command add_diff(CLI::App& program);
Command add_check(CLI::App& program);
Command add_bench(CLI::App& program);
Command add_laboratory(CLI::App& program);
Command add_calibrate(CLI::App& program);
Command add_study(CLI::App& program);
Command add_sweep(CLI::App& program);
Command add_dataset(CLI::App& program);
Command add_fit(CLI::App& program);
Command add_schema(CLI::App& program);
Command add_help(CLI::App& program);
Command add_completion(CLI::App& program);
Command add_manual(CLI::App& program);
Command add_trace(CLI::App& program);
Command add_validate(CLI::App& program);

/// Prints what a shell may offer in place of the last word of a call, a line each, for `listric
/// complete WORDS`: a word, or with a tab its purpose. The line `/` stands for files.
void print_offers(const CLI::App& program, std::vector<std::string> words);

/// Refuses a call that there is none of, with the one that may be meant. Throws UsageError.
void require_call(const CLI::App& program, const std::string& name);

// Options that several calls share. Each shows the value that it has as its default.

/// "5km" or "5000m" in metres. Throws UsageError.
double parse_length(const std::string& option, const std::string& text);

/// Cores that this process may use.
int all_threads();

/// Names of the accuracy levels.
std::vector<std::string> accuracy_names();

/// --threads; more than all_threads() are told and not started.
CLI::Option* add_threads(CLI::App& command, int& threads);

/// A whole number.
template <class Integer>
CLI::Option* add_count(CLI::App& command, const char* option, Integer& count, const char* what,
                       Integer least = std::numeric_limits<Integer>::lowest(),
                       Integer most = std::numeric_limits<Integer>::max()) {
    CLI::Option* added =
        command.add_option(option, count, what)->type_name("N")->default_str(std::to_string(count));
    return most == std::numeric_limits<Integer>::max()
               ? added
               : added->check(CLI::Range(least, most).description(""));
}

/// A number, read as those of files are: in every locale, and by the same rules.
CLI::Option* add_number(CLI::App& command, const char* option, double& number, const char* what);
CLI::Option* add_number(CLI::App& command, const char* option, std::optional<double>& number,
                        const char* what);

/// An option of numbers, separated by commas or given several times.
CLI::Option* add_numbers(CLI::App& command, const char* option, std::vector<double>& numbers,
                         const std::string& what);

/// Lengths with commas between, such as 5km or 500m.
CLI::Option* add_lengths(CLI::App& command, const char* option, std::vector<double>& metres,
                         const std::string& what);

/// An option that may be given several times, with one word each time.
void add_words(CLI::App& command, const char* option, const char* kind,
               std::vector<std::string>& words, const char* what);

/// -o, --output; without it results go to `otherwise`.
template <class Path>
void add_output(CLI::App& command, Path& output, const char* otherwise,
                const char* what = "folder of results") {
    command.add_option("-o,--output", output, what)->type_name("DIR")->default_str(otherwise);
}

/// -q, --quiet
void add_quiet(CLI::App& command, bool& quiet);

/// --jobs, --threads and --output of a call that makes many runs: as many as there are cores.
void add_many_runs(CLI::App& command, ManyRuns& request, const char* otherwise);

/// SCENE and what changes it.
void add_scene(CLI::App& command, SceneRequest& request);

} // namespace listric
