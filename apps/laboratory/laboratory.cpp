#include "apps/laboratory/laboratory.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/output_folder.hpp"
#include "apps/archive/folder/run_files.hpp"
#include "apps/laboratory/report.hpp"
#include "apps/laboratory/request.hpp"
#include "apps/laboratory/slab_sweep.hpp"
#include "apps/laboratory/tests.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/python.hpp"
#include "apps/support/words/log.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace listric {

namespace {

namespace fs = std::filesystem;

enum class Test { uniaxial, biaxial, shear_box, pure_shear };

const std::vector<std::string_view> test_names = {"uniaxial", "biaxial", "shear-box", "pure-shear"};

Test test_of(const LaboratoryRequest& request) {
    const auto found = std::ranges::find(test_names, request.test);
    if (found == test_names.end())
        throw UsageError(
            fmt::format("no test {}, {}", request.test, advice(request.test, test_names)));
    return static_cast<Test>(found - test_names.begin());
}

/// Walls of the zone: the call's wish, or the basement rock that goes with it.
ShearBoxFilling make_filling(const LaboratoryRequest& request, const RockMaterial& zone) {
    const bool calibrated = zone.name.ends_with("-calibrated");
    const std::string wish = request.vice.value_or(zone.bonds   ? "none"
                                                   : calibrated ? "mat18-b-calibrated"
                                                                : "mat18-b");
    ShearBoxFilling filling{zone, std::nullopt, false};
    if (wish == "none")
        return filling;
    constexpr std::string_view elastic = "elastic";
    if (wish == elastic) {
        filling.vice =
            zone.bonds ? zone : load_material(calibrated ? "mat18-b-calibrated" : "mat18-b");
        filling.elastic_vice = true;
        return filling;
    }
    filling.vice = load_material(wish);
    if (!filling.vice->bonds)
        throw UsageError(fmt::format("--vice {}: the rock around the zone needs bonds; allowed: a "
                                     "material with [bonds], elastic, none",
                                     wish));
    return filling;
}

std::string describe_vice(const ShearBoxFilling& filling) {
    if (!filling.vice)
        return "none";
    return filling.elastic_vice ? "elastic (" + filling.vice->name + ")" : filling.vice->name;
}

/// The stresses of a call, or the standard ones of its test, Pa, ascending.
std::vector<double> stresses(const LaboratoryRequest& request, Test test) {
    const bool in_box = test == Test::shear_box;
    const std::vector<double> standard =
        in_box ? std::vector{10.0, 50.0, 100.0, 200.0}
        : test == Test::pure_shear // on the sides of a slab of 10 km that yields
            ? std::vector{10.0, 25.0, 50.0, 100.0}
            : std::vector{10.0, 25.0, 50.0, 100.0, 200.0};
    std::vector<double> result;
    for (double s : request.stresses.empty() ? standard : request.stresses) {
        if (!(s >= 0.5 && s <= 2000.0))
            throw UsageError(fmt::format("--{} {}: allowed: 0.5 to 2000 MPa",
                                         in_box ? "normal" : "confining", s));
        result.push_back(s * 1e6);
    }
    std::ranges::sort(result);
    return result;
}

/// Refuses options of another test, and rock that the test cannot take.
void check(const LaboratoryRequest& request, Test test, const RockMaterial& rock) {
    const bool in_slab = test == Test::pure_shear;
    if (in_slab && !rock.bonds)
        throw UsageError(
            fmt::format("{}: this test needs a rock with [bonds]; the biaxial test and "
                        "the shear box take materials without (listric laboratory biaxial {})",
                        rock.name, request.material));
    if (!in_slab && (request.weakened || !request.weakening_rates.empty() ||
                     !request.healing_rates.empty() || request.accuracy != "draft"))
        throw UsageError("--weakened, --weakening-rates, --healing-rates, --accuracy: only the "
                         "pure-shear test has them");
    if (test != Test::shear_box && request.vice)
        throw UsageError("--vice: only the shear box has one");
    stresses(request, test);
    if (test == Test::shear_box)
        make_filling(request, rock);
    if (in_slab)
        sweep_rates(request, {});
}

Laboratory make_laboratory(const LaboratoryRequest& request, Test test) {
    const auto discs = static_cast<std::size_t>(request.discs);
    Laboratory lab;
    lab.sample = test == Test::shear_box ? shear_box_sample(discs) : compression_sample(discs);
    lab.sample.floaters_grow = request.floaters == "grown";
    lab.seed = static_cast<std::uint64_t>(request.seed);
    lab.seeds = request.seeds;
    lab.threads = request.threads;
    lab.speed = request.speed;
    lab.stop = request.stop;
    return lab;
}

void carry_out(LaboratoryReport& report, const LaboratoryRequest& request, Test test) {
    switch (test) {
    case Test::uniaxial:
        return report_uniaxial(report);
    case Test::biaxial:
        return report_biaxial(report, stresses(request, test));
    case Test::pure_shear:
        return report_pure_shear(report, request, stresses(request, test));
    case Test::shear_box:
        const ShearBoxFilling filling = make_filling(request, report.rock);
        return report_shear_box(report, filling, describe_vice(filling), stresses(request, test));
    }
}

/// Files of a test, beside its material.toml.
std::vector<std::string_view> files_of(Test test) {
    switch (test) {
    case Test::uniaxial:
        return {"summary.json", "curves.csv", "uniaxial.png"};
    case Test::biaxial:
        return {"summary.json", "curves.csv", "envelopes.csv", "biaxial.png"};
    case Test::shear_box:
        return {"summary.json", "curves.csv", "profiles.csv", "shear-box.png"};
    case Test::pure_shear:
        return {"summary.json", "slabs.csv", "faults.csv", "pure-shear.png"};
    }
    return {};
}

/// Refuses a folder in which the test would replace a file that no earlier test has left. Only a
/// summary tells that one has: before it there is the material, which begins a test.
void require_own_folder(const fs::path& output, Test test, const std::string& material,
                        const fs::path& read) {
    const fs::path earlier = output / "summary.json";
    const bool is_known = fs::exists(earlier) && archive::holds(earlier, "\"test\"", 1 << 16);
    const std::string mark = is_known ? "" : material;
    std::vector<archive::OwnFile> written = {{output / "material.toml", mark}};
    for (const std::string_view name : files_of(test))
        written.push_back({output / name, mark});
    archive::require_own(written, std::array{read});
}

/// All of a call that its results depend on.
JsonObject request_json(const LaboratoryRequest& request, const std::vector<std::string>& changes) {
    return {{"test", request.test},
            {"material", request.material},
            {"set", changes},
            {"discs", request.discs},
            {"seed", request.seed},
            {"seeds", request.seeds},
            {"floaters", request.floaters},
            {"speed", request.speed},
            {"stresses", request.stresses},
            {"vice", request.vice.value_or("")},
            {"weakened", request.weakened.value_or("")},
            {"accuracy", request.accuracy},
            {"weakening_rates", request.weakening_rates},
            {"healing_rates", request.healing_rates}};
}

} // namespace

std::span<const std::string_view> laboratory_tests() { return test_names; }

void run_laboratory(const LaboratoryRequest& request) {
    const auto started = SteadyClock::now();
    const Test test = test_of(request);
    check_sample(request.discs, request.seed, request.seeds);
    if (!(request.speed > 0.0 && request.speed <= 100.0))
        throw UsageError(fmt::format("--speed {}: allowed: above 0, at most 100", request.speed));
    std::vector<std::string> changes = request.set;
    if (request.reading)
        changes.push_back("bonds.strength_is=" + *request.reading);
    const RockMaterial rock = load_material(request.material, changes);
    check(request, test, rock);

    const fs::path output = request.output.empty()
                                ? fs::path("out") / (request.test + "-" + rock.name)
                                : request.output;
    archive::require_no_run(output);
    make_folder(output);
    const std::string text = to_toml(rock);
    require_own_folder(output, test, text, materials.find(request.material));
    const JsonObject asked = request_json(request, changes);
    require_same_request(output, asked);
    require_same_material(output / "material.toml", text);
    write_text(output / "material.toml", text);
    Laboratory lab = make_laboratory(request, test);
    Log log(request.quiet);
    lab.report = [&](std::string_view stage, std::size_t done, std::size_t all) {
        log.progress(fmt::format("{}: {} of {}", stage, done, all));
    };
    LaboratoryReport report{lab, rock, output, {}};
    report.summary = {
        {"test", request.test},         {"material", rock.name},  {"discs", request.discs},
        {"seed", request.seed},         {"seeds", request.seeds}, {"threads", request.threads},
        {"floaters", request.floaters}, {"set", changes},         {"request", asked},
        {"version", summary_version()}};
    carry_out(report, request, test);
    report.summary["wall_s"] = seconds_since(started);
    write_object(output / "summary.json", report.summary);
    draw_or_warn("laboratory.py", {std::filesystem::absolute(output).string()});
}

} // namespace listric
