#include "apps/commands/command.hpp"
#include "apps/figures/draw_run.hpp"
#include "apps/run/run.hpp"

#include <memory>

namespace listric {

namespace {

struct FiguresCall {
    std::string folder;
    bool animation = false;
};

} // namespace

Command add_figures(CLI::App& program) {
    const auto call = std::make_shared<FiguresCall>();
    CLI::App* command = program.add_subcommand("figures", "Draw the figures of a run");
    command->add_option("DIR", call->folder, "The run's output folder")->required();
    command->add_flag("--animation", call->animation,
                      "An animation of all snapshots instead of the figures");
    return {command, [call] {
                call->animation ? animate_run(call->folder) : draw_run(call->folder);
                return ExitCode::done;
            }};
}

} // namespace listric
