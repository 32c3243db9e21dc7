#include "apps/run/closing.hpp"

#include "apps/archive/folder/known_errors.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/archive/folder/summary.hpp"
#include "apps/archive/tables/observed_misfit.hpp"
#include "apps/archive/tables/rock_record.hpp"
#include "apps/measures/basin/dilation.hpp"
#include "apps/model/model.hpp"
#include "apps/run/run_view.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace listric {

namespace {

/// Numbers of summary.json besides the measures of the last moment.
NamedNumbers numbers_of(const RunView& run, const NamedNumbers& of_effects) {
    NamedNumbers numbers = of_effects;
    append(numbers, summarise_effects(run.scene, run.record.history));
    append(numbers, run.numbers);
    if (run.scene.picked_fault)
        add(numbers, archive::detachment_misfit, run.scene.picked_fault->misfit);
    return numbers;
}

} // namespace

void add_dilation(RunView& run, const measures::Past& start) {
    const std::vector<measures::Past> past{start};
    append(run.numbers, measures::measure_dilation(
                            measures::RunSoFar(run.setting, run.parts.base, run.state(), past)));
}

void compare_picks(RunView& run) {
    if (run.scene.observed)
        run.observed = archive::compare_horizons(
            run.scene, run.state(),
            trace_horizons(run.setting, run.parts.base, run.state(), run.faults().faults));
}

std::string summary_of(RunView& run) {
    const measures::Measures& measures = run.measured();
    const measures::FaultReport& faults = run.faults();
    const EffectMeasures of_effects = measure_effects(run.now());
    run.options.stop.check(); // all is kept: resumed, the run ends from here
    run.record.seconds_by_part.try_emplace(name(Part::figures)); // also where none are drawn
    const auto rocks = run.rocks ? archive::rocks_json(*run.rocks) : nlohmann::ordered_json();
    const auto provenance = archive::provenance(run.scene, run.record);
    const auto known_errors = archive::known_errors_json(run.scene, run.state().clock.extension.m);
    return archive::summary_json(
        {.scene = run.scene.name,
         .accuracy = run.scene.accuracy,
         .seed = run.scene.seed,
         .threads = run.options.threads,
         .ranks = run.ranks(),
         .cycle = std::string(name(run.options.execution().cycle)),
         .state = run.state(),
         .record = run.record,
         .measures = measures,
         .faults = faults,
         .effects = effect_names(run.scene),
         .warnings = run.scene.warnings,
         .numbers = numbers_of(run, of_effects.numbers),
         .objects = of_effects.groups,
         .lists = of_effects.lists,
         .observed = run.observed,
         .wall_seconds = run.wall_seconds(),
         .state_hash = run.simulation.hash(),
         .rocks = run.rocks ? &rocks : nullptr,
         .provenance = &provenance,
         .known_errors = known_errors.is_null() ? nullptr : &known_errors});
}

} // namespace listric
