#include "apps/run/driven_run.hpp"

#include "apps/archive/folder/summary.hpp"
#include "apps/measures/evolution.hpp"
#include "apps/measures/faults/main_faults.hpp"
#include "apps/run/build.hpp"
#include "apps/run/closing.hpp"
#include "dem/threads/shared_loop.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace listric {

struct Run::Parts {
    Scene scene;
    RunOptions options;
    Log log{/*quiet=*/true};
    RunView view;
    dem::Simulation simulation;
    std::optional<measures::Past> beginning; ///< once there is a hanging wall
    std::function<void(const Run&)> at_windows;

    Parts(Scene s, int threads, HangingWallSource* hanging_wall)
        : scene(std::move(s)), view(scene, options, log, simulation),
          simulation(view.parts.base, view.parts.physics) {
        options.threads = threads;
        const dem::Team team(threads);
        add_events(simulation, view);
        view.begin_record();
        start(simulation, view, hanging_wall);
        beginning = measures::remember(view.setting, view.parts.base, view.state(), {});
        end_window();
    }

    void end_window() {
        listric::end_window(simulation, view, [this] { view.add_row(); });
        view.require_elasticity();
    }
};

Run::Run(Scene scene, int threads)
    : parts_(std::make_unique<Parts>(std::move(scene), threads, kept_hanging_wall)) {}
Run::Run(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Run::~Run() = default;
Run::Run(Run&&) noexcept = default;

Run Run::without_files(Scene scene, int threads) {
    return Run(std::make_unique<Parts>(std::move(scene), threads, own_hanging_wall));
}

bool Run::extend_to(double goal, const Report& report) {
    if (const double most = scene().extension.distance; goal > most)
        throw UsageError(fmt::format("a run to {:g} m, but extension.distance_m of {} is {:g}",
                                     goal, scene().name, most));
    const dem::Team team(parts_->options.threads);
    return extend_by_windows(
        parts_->simulation, parts_->view, dem::Travel(goal),
        [&](const dem::Simulation&) { return !report || report(*this); },
        [&] {
            parts_->end_window();
            if (parts_->at_windows)
                parts_->at_windows(*this);
            return true;
        });
}

const Scene& Run::scene() const { return parts_->scene; }
const dem::State& Run::state() const { return parts_->view.state(); }
double Run::extension() const { return parts_->view.extension().m; }
std::uint64_t Run::hash() const { return parts_->simulation.hash(); }

NamedNumbers Run::measures() {
    const dem::Team team(parts_->options.threads);
    NamedNumbers numbers = parts_->view.row();
    for (const auto& measure : measures::fault_report_measures())
        numbers.emplace_back(measure.name, measure.value(faults()).value_or(std::nan("")));
    std::erase_if(numbers, [](const auto& number) { return std::isnan(number.second); });
    return numbers;
}

const measures::FaultReport& Run::faults() {
    const dem::Team team(parts_->options.threads);
    return parts_->view.faults();
}

void Run::save(const std::filesystem::path& path) const {
    archive::write_snapshot(path, state(), parts_->simulation.events(), parts_->view.record);
}

void Run::at_windows(std::function<void(const Run&)> told) { parts_->at_windows = std::move(told); }

std::vector<std::byte> Run::snapshot() const {
    return archive::snapshot_bytes(state(), parts_->simulation.events(), parts_->view.record);
}

std::string Run::snapshot_name() const { return parts_->view.snapshot().filename().string(); }

std::string Run::history() const { return archive::to_csv(parts_->view.record.history); }

std::string Run::summary() {
    const dem::Team team(parts_->options.threads);
    RunView& view = parts_->view;
    view.numbers.clear();
    add_dilation(view, *parts_->beginning);
    compare_picks(view);
    return summary_of(view);
}

} // namespace listric
