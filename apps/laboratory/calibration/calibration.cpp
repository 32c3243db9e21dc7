#include "apps/laboratory/laboratory.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/output_folder.hpp"
#include "apps/laboratory/calibration/calibration_fit.hpp"
#include "apps/laboratory/envelope.hpp"
#include "apps/laboratory/request.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace listric {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double steepest = 0.9; ///< envelope that no disc friction reaches: 0.83 at 10

/// The rocks that were found; `weak` if one was wanted.
struct Rocks {
    RockMaterial sound;
    std::optional<RockMaterial> weak;
};

std::string name_of_weak(const std::string& name) { return name + "-weak"; }

Rocks find_rocks(Calibration& c, const std::string& name) {
    Rocks rocks;
    RockMaterial& rock = rocks.sound;
    rock.name = name;
    rock.bonds.emplace();
    rock.material.friction = 1.0;
    rock.material.normal_stiffness *= c.targets.young / 50e9; // the paper's rock, scaled
    fit_stiffness(c, rock);
    fit_strength(c, rock);
    if (c.targets.bulk_friction)
        rocks.weak = fit_weak(c, rock, name_of_weak(name), *c.targets.bulk_friction);
    return rocks;
}

void validate_stiffness(Calibration& c, RockMaterial& rock, Json& summary) {
    const CalibrationTargets& t = c.targets;
    const auto [young, poisson] = c.elastic(rock);
    summary["young_modulus_pa"] = {{"target", t.young}, {"validation", young}};
    summary["poisson_ratio"] = {{"target", t.poisson}, {"validation", poisson}};
    std::cout << fmt::format("{:>24} {:>10} {:>10}\n{:>24} {:>10.2f} {:>10.2f}\n{:>24} {:>10.3f} "
                             "{:>10.3f}\n",
                             "", "target", "validation", "E (GPa)", t.young / 1e9, young / 1e9,
                             "nu", t.poisson, poisson);
    if (std::abs(young / t.young - 1.0) > 0.1)
        c.misses.push_back(fmt::format("E on other seeds: {:.2f} GPa", young / 1e9));
    if (std::abs(poisson - t.poisson) > 0.05)
        c.misses.push_back(fmt::format("nu on other seeds: {:.3f}", poisson));
    rock.description =
        fmt::format("Calibrated: plane-strain E {:.3g} GPa, nu {:.2f}", young / 1e9, poisson);
}

void validate_strength(Calibration& c, RockMaterial& rock, Json& summary) {
    const std::vector<double>& confining = Calibration::confining;
    const std::vector<double> peaks = c.strength(rock);
    Json& points = summary["points"] = Json::array();
    for (std::size_t k = 0; k < confining.size(); ++k) {
        const double target = c.target_axial(confining[k]);
        points.push_back({{"confining_pa", confining[k]},
                          {"target_axial_pa", target},
                          {"peak_axial_pa", peaks[k]}});
        std::cout << fmt::format("{:>24} {:>10.0f} {:>10.0f}\n",
                                 fmt::format("peak at {:.0f} MPa (MPa)", confining[k] / 1e6),
                                 target / 1e6, peaks[k] / 1e6);
        if (std::abs(peaks[k] / target - 1.0) > 0.15)
            c.misses.push_back(fmt::format("strength at {:.0f} MPa on other seeds: {:+.0f} % off",
                                           confining[k] / 1e6, 100.0 * (peaks[k] / target - 1.0)));
    }
    const fem::CoulombLine line = fit_envelope(confining, peaks);
    summary["friction"] = line.friction;
    summary["cohesion_pa"] = line.cohesion;
    std::cout << fmt::format("envelope: friction {:.3f}, cohesion {:.1f} MPa\n", line.friction,
                             line.cohesion / 1e6);
    rock.description +=
        fmt::format(", friction {:.2f}, cohesion {:.3g} MPa", line.friction, line.cohesion / 1e6);
}

void validate_weak(Calibration& c, RockMaterial& weak, const RockMaterial& rock, Json& summary) {
    const std::vector<double>& normal = Calibration::normal;
    const double target = *c.targets.bulk_friction;
    const auto mu = c.bulk_friction(weak, rock);
    const double mean = 0.5 * (mu[0] + mu[1]);
    summary["bulk_friction"] = {{"target", target}, {"validation", mu}};
    for (std::size_t k = 0; k < normal.size(); ++k)
        std::cout << fmt::format("{:>24} {:>10.3f} {:>10.3f}\n",
                                 fmt::format("bulk fr. at {:.0f} MPa", normal[k] / 1e6), target,
                                 mu[k]);
    if (std::abs(mean - target) > 0.05)
        c.misses.push_back(fmt::format("bulk friction on other seeds: {:.3f}", mean));
    if (std::max(mu[0], mu[1]) > 1.25 * std::min(mu[0], mu[1]))
        c.misses.push_back(fmt::format(
            "bulk friction at any stress: {:.2f} at {:.0f} MPa, {:.2f} at {:.0f} MPa, where "
            "discs are pressed into each other",
            mu[0], normal[0] / 1e6, mu[1], normal[1] / 1e6));
    weak.description = fmt::format("Weakened rock of {}: bulk friction {:.2f}", rock.name, mean);
}

/// Measures the rocks on seeds that the fit has not seen, prints a table and describes the rocks.
/// Returns the summary.
Json validate(Calibration& c, Rocks& rocks, const CalibrationRequest& request) {
    c.log.say("validation on other seeds");
    c.lab.seed += static_cast<std::uint64_t>(request.seeds);
    Json summary = {{"test", "calibrate"},
                    {"material", request.name},
                    {"discs", request.discs},
                    {"fitted_seeds", {request.seed, request.seed + request.seeds - 1}},
                    {"validation_seeds", {c.lab.seed, c.lab.seed + c.lab.seeds - 1u}},
                    {"evaluations", 0}};
    validate_stiffness(c, rocks.sound, summary);
    validate_strength(c, rocks.sound, summary);
    summary["evaluations"] = c.history.size();
    if (rocks.weak)
        validate_weak(c, *rocks.weak, rocks.sound, summary);
    summary["not_reached"] = c.misses;
    return summary;
}

/// All of a call that its results depend on.
Json request_of(const CalibrationRequest& request) {
    const CalibrationTargets& t = request.targets;
    Json json = {{"young", t.young},       {"poisson", t.poisson},  {"friction", t.friction},
                 {"cohesion", t.cohesion}, {"byerlee", t.byerlee},  {"discs", request.discs},
                 {"seed", request.seed},   {"seeds", request.seeds}};
    json["bulk_friction"] = t.bulk_friction ? Json(*t.bulk_friction) : Json("none");
    return json;
}

} // namespace

void CalibrationTargets::check() const {
    const auto refuse = [](const char* option, double value, const char* allowed) {
        throw UsageError(fmt::format("{} {}: allowed: {}", option, value, allowed));
    };
    if (!(young >= 1e6 && young <= 1e13))
        refuse("--young", young, "1e6 to 1e13 Pa");
    if (!(poisson > 0.0 && poisson < 0.5))
        refuse("--poisson", poisson, "above 0, below 0.5 (plane strain)");
    // nu_2D = nu / (1 - nu): a two-dimensional material reaches 0.5 when the rock has 1/3.
    if (poisson >= 1.0 / 3.0)
        refuse("--poisson", poisson,
               "below 1/3, which is 0.5 in 2D terms: contacts give less, however soft in shear");
    if (!byerlee && !(friction > 0.0 && friction <= steepest))
        refuse("--friction", friction,
               "above 0, at most 0.9: round discs roll, whatever their own friction");
    if (!byerlee && !(cohesion >= 0.0 && cohesion <= 1e9))
        refuse("--cohesion", cohesion, "0 to 1e9 Pa");
    if (bulk_friction && !(*bulk_friction > 0.0 && *bulk_friction <= 1.0))
        refuse("--bulk-friction", *bulk_friction, "above 0, at most 1");
}

void run_calibration(const CalibrationRequest& request) {
    request.targets.check();
    if (const std::string why = objection_to_name(request.name); !why.empty())
        throw UsageError(fmt::format("--name \"{}\": {}, allowed: the name of one file",
                                     shown(request.name), why));
    check_sample(request.discs, request.seed, request.seeds);
    const fs::path output =
        request.output.empty() ? fs::path("out") / ("calibrate-" + request.name) : request.output;
    const fs::path history = output / "history.json";
    make_folder(output);
    if (fs::exists(history) && !request.resume)
        throw UsageError(output.string() +
                         " holds a calibration: --resume continues it, --output writes elsewhere");
    archive::require_no_run(output);
    const fs::path material = output / (request.name + ".toml");
    std::vector<fs::path> written = {material, output / "summary.json"};
    if (request.targets.bulk_friction)
        written.push_back(output / (name_of_weak(request.name) + ".toml"));
    const bool has_begun = fs::exists(history); // else no file here is a calibration's
    for (const fs::path& file : written)
        if (!has_begun && fs::exists(file))
            throw UsageError(file.string() + ": is there already, and would be written over; "
                                             "--output writes elsewhere");

    const Json asked = request_of(request);
    require_same_request(output, asked);
    Laboratory lab;
    lab.sample = compression_sample(static_cast<std::size_t>(request.discs));
    lab.seed = static_cast<std::uint64_t>(request.seed);
    lab.seeds = request.seeds;
    lab.threads = request.threads;
    lab.stop = request.stop;
    Log log(request.quiet);
    Calibration c{request.targets, lab, CalibrationHistory(history, request.resume), log};
    if (const std::size_t others = c.history.of_other_versions())
        log.say(fmt::format("warning: {}: {} measurements are of another version, and made again",
                            history.string(), others));
    Rocks rocks = find_rocks(c, request.name);
    Json summary = validate(c, rocks, request);
    summary["request"] = asked;
    summary["version"] = summary_version();

    if (rocks.weak)
        write_text(output / (rocks.weak->name + ".toml"), to_toml(*rocks.weak));
    write_text(material, to_toml(rocks.sound));
    write_object(output / "summary.json", summary);
    for (const std::string& miss : c.misses)
        std::cout << "not reached: " << miss << '\n';
    std::cout << "written: " << material.string() << '\n';
}

} // namespace listric
