#include "apps/commands/command.hpp"
#include "apps/commands/underlay.hpp"
#include "apps/figures/report_run.hpp"
#include "apps/support/log.hpp"

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
        program.add_subcommand("report", "A run, or two side by side, as one file for a browser");
    command->add_option("DIR", call->request.outputs, "The folders of one or two runs")
        ->required()
        ->expected(1, 2);
    command->add_option("--output", call->request.file, "The file (default: DIR/report.html)");
    command
        ->add_option("--most-mb", call->request.most_mb,
                     "Size of the file, MB, that is kept by leaving out detail")
        ->check(CLI::Range(0.1, 1000.0))
        ->capture_default_str();
    command->add_flag("--every-line", call->request.every_line,
                      "Horizons and the past of faults at all moments; takes longer");
    add_underlay(*command, call->underlay);
    return {command, [call] {
                call->request.underlay = underlay_of(call->underlay);
                const WrittenReport report = report_run(call->request);
                std::cout << report.file.string() << '\n';
                for (const std::string& lack : report.lacks)
                    warn("the page is not whole: " + lack);
                return report.lacks.empty() ? ExitCode::done : ExitCode::storage_failed;
            }};
}

} // namespace listric
