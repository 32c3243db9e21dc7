// The model for a page: texts come in, texts and numbers go out. A call returns whether it has done
// what it should; result() is then what it found, as JSON, and otherwise why not, in the words of
// the program.

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/quality.hpp"
#include "apps/model/effects.hpp"
#include "apps/run/drawing.hpp"
#include "apps/run/driven_run.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/scene/toml/json_document.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/reading.hpp"
#include "apps/support/stopwatch.hpp"
#include "apps/support/version.hpp"
#include "dem/columns.hpp"
#include "dem/contacts/power_cell.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace listric {

namespace {

using Json = nlohmann::ordered_json;

GivenTexts files;
std::string input, result;
std::vector<float> discs;
std::optional<Scene> scene;
std::optional<Run> run;

/// Does what may fail.
template <class Work> bool done(Work&& work) {
    try {
        result = work();
        return true;
    } catch (const std::bad_alloc&) {
        run.reset();
        result =
            "there is no memory left for a page: take larger discs, or run it with the program";
    } catch (const std::exception& error) {
        result = error.what();
    } catch (...) {
        result = "stopped";
    }
    return false;
}

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

SceneRequest request_of(const Json& asked) {
    SceneRequest request;
    request.scene = asked.at("scene");
    if (asked.contains("accuracy"))
        request.accuracy = asked["accuracy"];
    if (asked.contains("seed"))
        request.seed = asked["seed"].get<std::int64_t>();
    for (const std::string assignment : asked.value("set", Json::array()))
        request.set.push_back(assignment);
    return request;
}

Json moment() {
    return {{"travel", run->state().clock.travel.m},
            {"extension", run->extension()},
            {"discs", run->state().discs.rows()},
            {"state_hash", fmt::format("{:016x}", run->hash())}};
}

} // namespace

} // namespace listric

using namespace listric;

#define LISTRIC_EXPORT(name) extern "C" __attribute__((export_name(#name)))

/// Room for the next call's input.
LISTRIC_EXPORT(input) char* page_input(std::size_t bytes) {
    input.resize(bytes);
    return input.data();
}
LISTRIC_EXPORT(result) const char* page_result() { return result.data(); }
LISTRIC_EXPORT(result_size) std::size_t page_result_size() { return result.size(); }

/// Gives a file: the input is its path, of so many bytes, and its text.
LISTRIC_EXPORT(give) void page_give(std::size_t path_bytes) {
    files.give(input.substr(0, path_bytes), input.substr(path_bytes));
}

LISTRIC_EXPORT(program) bool page_program() {
    return done([] {
        return text_of({{"version", version},
                        {"sources", fmt::format("{} {}", source_hash, measures_hash)},
                        {"compiler", compiler}});
    });
}

/// Reads a scene: the input is {scene, accuracy, seed, set}.
LISTRIC_EXPORT(read) bool page_read() {
    return done([] {
        scene.reset();
        scene = load_scene(request_of(Json::parse(input)), program_effects());
        return text_of(scene_facts(*scene));
    });
}

// Of a page in which a scene is drawn: apps/run/drawing.hpp.

/// The input is {scene, set}, a scene as `read` takes it.
LISTRIC_EXPORT(document) bool page_document() {
    return done(
        [] { return text_of(scene_document(request_of(Json::parse(input)), program_effects())); });
}

/// A document as the text of a scene.
LISTRIC_EXPORT(text) bool page_text() {
    return done([] { return text_of(Json(toml_text(Json::parse(input), program_effects()))); });
}

/// The input is {scene, set, path}.
LISTRIC_EXPORT(value) bool page_value() {
    return done([] {
        const Json asked = Json::parse(input);
        return text_of(value_facts(request_of(asked), asked.at("path"), program_effects()));
    });
}

/// Picked lines of the file {file, shift_m}.
LISTRIC_EXPORT(lines) bool page_lines() {
    return done([] {
        const Json asked = Json::parse(input);
        const std::string file = asked.at("file");
        return text_of(lines_json(read_picked_lines(file, asked.at("shift_m")).lines));
    });
}

/// The fault that a [detachment] names.
LISTRIC_EXPORT(fault) bool page_fault() {
    return done([] { return text_of(fitted_fault(Json::parse(input), program_effects())); });
}

/// Whether start and pieces of a [detachment] are good.
LISTRIC_EXPORT(pieces) bool page_pieces() {
    return done([] {
        check_pieces(Json::parse(input), program_effects());
        return text_of(Json(true));
    });
}

LISTRIC_EXPORT(kinematics) bool page_kinematics() {
    return done([] { return text_of(kinematics_json(Json::parse(input), program_effects())); });
}

/// Makes the hanging wall of the scene that was read.
LISTRIC_EXPORT(begin) bool page_begin() {
    return done([] {
        run.reset();
        if (bending_base(scene.value()))
            throw UsageError("a base that bends needs finite elements, which a page does not have: "
                             "run this scene with the program");
        run.emplace(Run::without_files(scene.value()));
        return text_of(moment());
    });
}

/// Extends to a goal, m, but for some seconds at most, and tells whether it has arrived.
LISTRIC_EXPORT(extend) bool page_extend(double goal, double seconds) {
    return done([&] {
        const auto begun = SteadyClock::now();
        const bool arrived =
            run.value().extend_to(goal, [&](const Run&) { return seconds_since(begun) < seconds; });
        Json json = moment();
        json["arrived"] = arrived;
        return text_of(json);
    });
}

/// x, y, radius, stratum, total strain and depth at the start of each disc.
LISTRIC_EXPORT(discs) const float* page_discs() {
    const dem::State& state = run->state();
    const auto of = dem::disc_columns(state);
    const auto start_y = state.discs.get(dem::columns::start_y);
    std::span<const double> strain;
    for (const auto& column : {dem::columns::total_strain, dem::columns::total_tectonic_strain})
        if (state.discs.has(column.name)) // tectonic strain, where that is known
            strain = state.discs.get(column);
    const std::vector<double> radius = dem::rock_radii(state); // weakened discs are enlarged
    discs.clear();
    for (std::size_t i = 0; i < of.x.size(); ++i)
        for (const double value : {of.x[i], of.y[i], radius[i], static_cast<double>(of.stratum[i]),
                                   strain.empty() ? 0.0 : strain[i], -start_y[i]})
            discs.push_back(static_cast<float>(value));
    return discs.data();
}

// ---------------------------------------------------------------------------- the files of a run

extern "C" __attribute__((import_module("listric"), import_name("keep"))) void
keep_in_page(const char* path, std::size_t path_bytes, const void* data, std::size_t bytes);

namespace listric {

namespace {

std::string kept_snapshot; // that was handed over last

void keep(const std::string& path, std::span<const std::byte> bytes) {
    keep_in_page(path.data(), path.size(), bytes.data(), bytes.size());
}
void keep(const std::string& path, const std::string& text) {
    keep(path, std::as_bytes(std::span(text)));
}

void keep_moment(const Run& now) {
    keep("history.csv", now.history());
    kept_snapshot = now.snapshot_name();
    keep("snapshots/" + kept_snapshot, now.snapshot());
}

} // namespace

} // namespace listric

/// Hands the files of the run's folder to the page, here and wherever a window ends.
LISTRIC_EXPORT(keep_files) bool page_keep_files() {
    return done([] {
        keep("scene.toml", to_toml(run.value().scene()));
        keep_moment(*run);
        run->at_windows(keep_moment);
        return text_of({{"mean_radius_m", run->state().mean_radius}});
    });
}

/// Ends the run: its last files, its summary, and whether it is good.
LISTRIC_EXPORT(close) bool page_close() {
    return done([] {
        if (kept_snapshot != run.value().snapshot_name())
            keep_moment(*run);
        const std::string summary = run->summary();
        keep("summary.json", summary);
        const auto checks = archive::quality_checks(
            parse_json(summary), {.base_moves = false, .mean_radius = run->state().mean_radius});
        return text_of(
            {{"summary", Json::parse(summary)}, {"verdict", archive::verdict_lines(checks)}});
    });
}
