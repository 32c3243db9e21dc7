#include "apps/figures/well_figure.hpp"

#include "apps/model/model.hpp"
#include "apps/scene/parameters/effect.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/python.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/moment_names.hpp"
#include "apps/support/words/option_names.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

#include <set>
#include <string>

namespace listric {

using namespace archive;

namespace fs = std::filesystem;

namespace {

/// Numbers of the wells for the drawing script, by name a list from the ground down. Each effect
/// has depths, and so an object, of its own.
nlohmann::ordered_json wells_json(const Observation& now,
                                  const std::vector<const MeasuredWell*>& wells,
                                  const std::vector<double>& places) {
    std::vector<WellPlace> chosen;
    for (const double x : places)
        chosen.push_back({"well", x});
    auto list = nlohmann::ordered_json::array();
    for (const WellPlace& place : places.empty() ? wells.front()->places(now) : chosen)
        for (const MeasuredWell* const well : wells) {
            nlohmann::ordered_json columns = nlohmann::ordered_json::object();
            const std::vector<NamedNumbers> rows = well->numbers(now, place.x);
            for (const NamedNumbers& numbers : rows)
                for (const auto& [name, value] : numbers)
                    columns[name].push_back(value);
            if (!rows.empty())
                list.push_back({{"name", place.name}, {"x_m", place.x}, {"columns", columns}});
        }
    return list;
}

/// What effects measure along the section: lists of objects that begin with x_m.
nlohmann::ordered_json profiles_json(const Observation& now) {
    auto list = nlohmann::ordered_json::array();
    for (const EffectPart& part : now.scene.effects)
        for (const MeasuredObjects& objects : part.effect->objects) {
            if (objects.parts.size() != 2 || objects.parts[0].name != "x_m")
                continue;
            nlohmann::ordered_json profile{{"label", objects.parts[1].label},
                                           {"unit", objects.parts[1].unit}};
            for (const NamedNumbers& numbers :
                 objects.value(now).value_or(std::vector<NamedNumbers>())) {
                profile["x_m"].push_back(numbers[0].second);
                profile["values"].push_back(numbers[1].second);
            }
            if (profile.contains("x_m"))
                list.push_back(std::move(profile));
        }
    return list;
}

} // namespace

bool draw_wells(const RunFolder& run, std::span<const fs::path> snapshots,
                const std::vector<double>& wells, const fs::path& pictures,
                const PictureOrder& order) {
    const std::vector<const MeasuredWell*> measured = measured_wells(run.scene);
    if (measured.empty())
        return false;
    auto frames = nlohmann::ordered_json::array();
    std::set<double> dry(wells.begin(), wells.end());
    for (const fs::path& path : snapshots) {
        const Moment moment = run.read(path);
        const Observation now{run.scene, run.parts, moment.state, moment.events};
        const nlohmann::ordered_json list = wells_json(now, measured, wells);
        for (const auto& found : list)
            dry.erase(found["x_m"].get<double>());
        if (list.empty())
            continue;
        nlohmann::ordered_json frame{
            {"scene", run.scene.name},
            {"extension_km", run.names.kilometres(snapshot_extension(path))},
            {"options", wells.empty() ? "" : fmt::format("-x-{}m", listed(wells))},
            {"extension_m", moment.state.clock.extension.m},
            {"time_a", make_calendar(run.scene).age(moment.state.clock.travel)},
            {"wells", list},
            {"profiles", profiles_json(now)}};
        for (const auto& [name, way] : ways(run.parts.base.motion, moment.state.clock.travel))
            frame[name] = way;
        frames.push_back(std::move(frame));
    }
    if (frames.empty())
        return false;
    for (const double x : dry)
        warn(fmt::format("--well {}: nothing that is measured in wells is there", text(x)));
    const fs::path figures = fs::absolute(pictures);
    const TemporaryFolder data(figures);
    write_text(data.path / "wells.json", to_text(nlohmann::ordered_json{{"frames", frames}}));
    run_drawing_script("wells.py", {data.path.string(), figures.string(), order.text()});
    return true;
}

} // namespace listric
