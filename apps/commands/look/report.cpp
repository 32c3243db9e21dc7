#include "apps/commands/command.hpp"
#include "apps/commands/underlay.hpp"
#include "apps/figures/report_run.hpp"
#include "apps/studies/ensemble/ensemble.hpp"
#include "apps/support/words/log.hpp"

#include <iostream>
#include <memory>

namespace listric {

Command add_report(CLI::App& program) {
    struct Call {
        ReportRequest request;
        UnderlayOptions underlay;
    };
    const auto call = std::make_shared<Call>();
    CLI::App* command =
        add_call(program, {"Look",
                           "report",
                           "write one or two runs as a page for a browser",
                           "docs/guides/report.md",
                           {{{"report out/lis1", "write out/lis1/report.html"},
                             {"report out/lis1 out/lis2", "two runs on one page"},
                             {"report out/lis1 --most-mb 5", "a smaller file, to send"}}}});
    command
        ->add_option("DIR", call->request.outputs,
                     "folders of one or two runs, or one of many: of all its seeds")
        ->type_name("DIR")
        ->required()
        ->expected(1, 2);
    command->add_option("-o,--output", call->request.file, "file of the page")
        ->type_name("FILE")
        ->default_str("DIR/report.html");
    add_number(*command, "--most-mb", call->request.most_mb,
               "largest size of the page, MB; detail is left out to keep it")
        ->check(CLI::Range(0.1, 1000.0).description(""));
    command->add_flag("--every-line", call->request.every_line,
                      "compute horizons and the past of faults at all moments; takes longer");
    add_underlay(*command, call->underlay);
    return {command, [call] {
                if (const auto& folder = call->request.outputs.front();
                    call->request.outputs.size() == 1 && holds_runs(folder)) {
                    std::cout << draw_ensembles(folder, true).back().string() << '\n';
                    return ExitCode::done;
                }
                call->request.underlay = underlay_of(
                    call->underlay, {call->request.outputs.begin(), call->request.outputs.end()});
                const WrittenReport report = report_run(call->request);
                std::cout << report.file.string() << '\n';
                for (const std::string& lack : report.lacks)
                    warn("the page is not whole: " + lack);
                return report.lacks.empty() ? ExitCode::done : ExitCode::storage_failed;
            }};
}

} // namespace listric
