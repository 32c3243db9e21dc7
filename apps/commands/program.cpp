#include "apps/commands/program.hpp"

#include "apps/commands/command.hpp"
#include "apps/commands/signals.hpp"
#include "apps/run/ranks/join_ranks.hpp"
#include "apps/support/error.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/number.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"
#include "dem/cycle/cycle_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fcntl.h>
#include <iostream>
#include <poll.h>
#include <unistd.h>

namespace listric {

namespace {

void require_known(std::string_view kind, std::string_view word,
                   const std::vector<std::string>& known) {
    if (std::ranges::find(known, word) != known.end())
        return;
    const auto meant = nearest(word, std::vector<std::string_view>(known.begin(), known.end()));
    throw UsageError(fmt::format("no {} {}; {}there are {}", kind, word,
                                 meant ? fmt::format("did you mean {}? ", *meant) : "",
                                 fmt::join(known, ", ")));
}

/// Says of a call that could not be understood which word is not known, and what it may mean.
void refuse_unknown_words(const CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App* call = &app;
    if (!words.empty() && !words[0].starts_with("-")) {
        require_call(app, words[0]);
        call = app.get_subcommand(words[0]);
    }
    std::vector<std::string> options;
    for (const CLI::Option* option : call->get_options())
        for (const std::string& name : option->get_lnames())
            options.push_back("--" + name);
    for (const std::string& word : words)
        if (word.starts_with("--"))
            require_known("option", word.substr(0, word.find('=')), options);
}

/// Carries out a call; if it is interrupted, says how to go on.
ExitCode call_or_advise(const Command& command) {
    try {
        return command.call();
    } catch (const Interrupted&) {
        Log(false).say("listric: interrupted; " + command.after_stop);
        return ExitCode::interrupted;
    }
}

/// Refuses a LISTRIC_CYCLE that cannot be run before anything is done.
void require_cycle() {
    try {
        dem::best_cycle();
    } catch (const std::invalid_argument& error) {
        throw UsageError(error.what());
    }
}

/// Refuses a word that is no UTF-8: names of files and texts end in scenes, summaries and figures.
void require_sound(const std::vector<std::string>& words) {
    for (const std::string& word : words)
        if (const auto place = unsound_byte(word))
            throw UsageError(
                fmt::format("{}: {}; give texts in UTF-8, and rename files and folders "
                            "whose names are not (convmv does)",
                            shown(word), objection_to_byte(word, *place)));
}

/// The fault of a call, and where its help is.
std::string failure_of(const CLI::App* app, const CLI::Error& error) {
    const auto calls = app->get_subcommands();
    const std::string call = calls.empty() ? "" : " " + calls.back()->get_name();
    return fmt::format("listric: {}; listric help{} shows the options\n", error.what(), call);
}

ExitCode dispatch(int argc, char** argv) {
    require_sound({argv + std::min(argc, 1), argv + argc});
    CLI::App app{"listric: a numerical sandbox for halfgrabens", "listric"};
    const std::vector<Command> commands = add_calls(app);
    if (argc < 2) { // a script whose variable is empty has to notice
        std::cerr << app.help();
        return ExitCode::bad_call;
    }
    if (std::string_view(argv[1]) == "complete") { // words of a call that is not yet whole
        print_offers(app, {argv + 2, argv + argc});
        return ExitCode::done;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) {
            refuse_unknown_words(app, {argv + 1, argv + argc});
            exit_on_signals(); // mpirun's, once the root has told
            let_root_tell(argc, argv);
        }
        return app.exit(error) == 0 ? ExitCode::done : ExitCode::bad_call; // help and version, too
    }
    const auto called = std::ranges::find_if(
        commands, [](const Command& command) { return command.parser->parsed(); });
    require_cycle();
    return call_or_advise(*called);
}

/// Whether whoever read the standard output has left.
bool reader_has_left() {
    pollfd look{STDOUT_FILENO, 0, 0};
    return poll(&look, 1, 0) == 1 && (look.revents & POLLERR) != 0;
}

/// The call, and what it has printed. A reader that has enough, such as `head`, is no error: it
/// decides how much it reads, and a script that stops at errors (pipefail) goes on.
ExitCode call_and_print(int argc, char** argv) {
    const ExitCode code = dispatch(argc, argv);
    if (!std::cout.flush() && !reader_has_left())
        throw StorageError("standard output cannot be written");
    return code;
}

/// A file that the run opens must not become its standard error, if that was closed.
void keep_standard_files_open() {
    for (int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(descriptor, F_GETFD) < 0 && open("/dev/null", O_RDWR) < 0)
            return;
}

} // namespace

void require_call(const CLI::App& program, const std::string& name) {
    std::vector<std::string> calls;
    for (const CLI::App* command : program.get_subcommands({}))
        calls.push_back(command->get_name());
    require_known("call", name, calls);
}

std::vector<Command> add_calls(CLI::App& program) {
    program.set_help_flag("-h,--help", "print this text");
    program.set_version_flag("--version", fmt::format("listric {}", version), "print the version");
    program.require_subcommand(1);
    program.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    program.formatter_fn([](const CLI::App* call, const std::string&, CLI::AppFormatMode) {
        return help_of(*call, help_width());
    });
    program.failure_message(failure_of);
    program.footer("Examples\n"
                   "  a quick look at the first experiment\n"
                   "    listric run lis1 --accuracy draft\n"
                   "  arguments, options and examples of a call\n"
                   "    listric help run\n"
                   "\nDocuments: README.md, docs/index.md\n");
    return {add_new(program),      add_draw(program),       add_run(program),
            add_check(program),    add_explain(program),    add_scenes(program),
            add_flexure(program),  add_view(program),       add_report(program),
            add_figures(program),  add_export(program),     add_diff(program),
            add_cite(program),     add_trace(program),      add_sweep(program),
            add_dataset(program),  add_fit(program),        add_study(program),
            add_validate(program), add_laboratory(program), add_calibrate(program),
            add_help(program),     add_completion(program), add_manual(program),
            add_schema(program),   add_bench(program)};
}

int program(int argc, char** argv) {
    keep_standard_files_open();
    guard_threads();
    exit_on_signals();
    return run_guarded([&] {
        try {
            return call_and_print(argc, argv);
        } catch (...) {
            exit_on_signals(); // mpirun's, once the root has told
            let_root_tell(argc, argv);
            throw;
        }
    });
}

} // namespace listric
