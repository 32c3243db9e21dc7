#include "apps/commands/command.hpp"
#include "apps/commands/underlay.hpp"
#include "apps/figures/draw_run.hpp"
#include "apps/run/run.hpp"
#include "apps/support/error.hpp"

#include <memory>
#include <optional>
#include <string>

namespace listric {

namespace {

struct FiguresCall {
    std::string folder;
    bool animation = false;
    UnderlayOptions underlay;
};

} // namespace

Command add_figures(CLI::App& program) {
    const auto call = std::make_shared<FiguresCall>();
    CLI::App* command = program.add_subcommand("figures", "Draw the figures of a run");
    command->add_option("DIR", call->folder, "The run's output folder")->required();
    command->add_flag("--animation", call->animation,
                      "An animation of all snapshots instead of the figures");
    add_underlay(*command, call->underlay);
    return {command, [call] {
                const std::optional<Underlay> underlay = underlay_of(call->underlay);
                if (underlay && call->animation)
                    throw UsageError("--underlay: is not drawn in an animation");
                call->animation ? animate_run(call->folder) : draw_run(call->folder, underlay);
                return ExitCode::done;
            }};
}

} // namespace listric
