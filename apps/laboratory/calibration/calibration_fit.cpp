#include "apps/laboratory/calibration/calibration_fit.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/laboratory/calibration/gauss_newton.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/statistics.hpp"
#include "apps/support/version.hpp"
#include "dem/numbers/elementary.hpp"
#include "fem/byerlee.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace listric {

using namespace dem;

namespace {

// Where the search stays.
constexpr double least_ratio = 0.5, greatest_ratio = 8.0;       // of stiffnesses
constexpr double least_friction = 0.0, greatest_friction = 3.0; // of a disc
constexpr double least_tension = 1e3, greatest_tension = 1e9;   // Pa

/// Key of a measurement: all that it depends on.
nlohmann::json key(const Laboratory& lab, const RockMaterial& rock, bool strengths) {
    nlohmann::json k = {{"normal_stiffness_pa", rock.material.normal_stiffness},
                        {"shear_stiffness_pa", rock.material.shear_stiffness},
                        {"friction", rock.material.friction},
                        {"discs", lab.sample.discs},
                        {"seed", lab.seed},
                        {"seeds", lab.seeds},
                        {"version", version}};
    if (strengths && rock.bonds) {
        k["tensile_strength_pa"] = rock.bonds->tensile_mean;
        k["shear_strength_pa"] = rock.bonds->shear_mean;
    }
    return k;
}

/// Whether an entry of a file is as CalibrationHistory writes it.
bool is_measurement(const JsonObject& entry) {
    if (!entry.is_object() || !entry.contains("what") || !entry.contains("of") ||
        !entry.contains("result"))
        return false;
    const JsonObject& result = entry["result"];
    return result.is_array() &&
           std::ranges::all_of(result, [](const JsonObject& value) { return value.is_number(); });
}

} // namespace

const std::vector<double> Calibration::confining = {25e6, 100e6, 200e6};
const std::vector<double> Calibration::normal = {50e6, 200e6};

CalibrationHistory::CalibrationHistory(std::filesystem::path file, bool resume)
    : file_(std::move(file)) {
    std::error_code error;
    if (!resume || !std::filesystem::exists(file_, error))
        return;
    const JsonObject found = parse_json(read_text(file_));
    if (!found.is_array() || !std::ranges::all_of(found, is_measurement))
        throw StorageError(file_.string() + ": is not the history of a calibration; without it "
                                            "the measurements are made again");
    entries_ = nlohmann::json(found); // which compares objects whatever their keys' order
}

std::size_t CalibrationHistory::of_other_versions() const {
    return static_cast<std::size_t>(std::ranges::count_if(entries_, [](const auto& entry) {
        const auto made_by = entry["of"].find("version");
        return made_by == entry["of"].end() || *made_by != version;
    }));
}

std::vector<double> CalibrationHistory::measure(const std::string& what, const nlohmann::json& key,
                                                std::size_t count,
                                                const std::function<std::vector<double>()>& work) {
    for (const nlohmann::json& entry : entries_)
        if (entry["what"] == what && entry["of"] == key && entry["result"].size() == count)
            return entry["result"].get<std::vector<double>>();
    std::vector<double> result = work();
    assert(result.size() == count);
    entries_.push_back({{"what", what}, {"of", key}, {"result", result}});
    write_text(file_, to_text(entries_, 1) + "\n");
    return result;
}

Calibration::PlaneStrain Calibration::elastic(const RockMaterial& rock) {
    const auto r = history.measure("elasticity", key(lab, rock, false), 2, [&] {
        const auto curves = lab.uniaxial(rock, lab.make_samples(rock.material));
        std::vector<double> e, nu;
        for (const auto& curve : curves) {
            const Elasticity one = elasticity(curve);
            e.push_back(one.young());
            nu.push_back(one.poisson());
        }
        return std::vector<double>{spread(e).mean, spread(nu).mean};
    });
    log.say(fmt::format(
        "  k_n {:.4g}, k_n/k_s {:.3f}: E {:.2f} GPa, nu {:.3f}", rock.material.normal_stiffness,
        rock.material.normal_stiffness / rock.material.shear_stiffness, r[0] / 1e9, r[1]));
    return {r[0], r[1]};
}

std::vector<double> Calibration::strength(const RockMaterial& rock) {
    const auto r = history.measure("strength", key(lab, rock, true), confining.size(), [&] {
        const auto curves = lab.biaxial(rock, lab.make_samples(rock.material), confining);
        std::vector<double> means;
        for (const auto& by_seed : curves) {
            std::vector<double> peaks;
            for (const auto& curve : by_seed)
                peaks.push_back(peak_stress(curve));
            means.push_back(spread(peaks).mean);
        }
        return means;
    });
    log.say(fmt::format("  friction {:.3f}, tension {:.3g} Pa: peak {:.0f}, {:.0f}, {:.0f} MPa",
                        rock.material.friction, rock.bonds->tensile_mean, r[0] / 1e6, r[1] / 1e6,
                        r[2] / 1e6));
    return r;
}

std::vector<double> Calibration::bulk_friction(const RockMaterial& weak, const RockMaterial& vice) {
    nlohmann::json k = key(lab, weak, false);
    k["vice"] = key(lab, vice, true);
    const auto r = history.measure("bulk friction", k, normal.size(), [&] {
        Laboratory box = lab;
        box.sample = shear_box_sample(lab.sample.discs);
        const auto sheared =
            box.shear_box({weak, vice, true}, box.make_samples(vice.material), normal);
        std::vector<double> means;
        for (const auto& by_seed : sheared) {
            std::vector<double> mu;
            for (const ShearTest& t : by_seed)
                mu.push_back(t.bulk_friction(0.1, 0.3));
            means.push_back(spread(mu).mean);
        }
        return means;
    });
    log.say(fmt::format("  weak k_n {:.3g}, friction {:.3f}: bulk friction {:.3f}, {:.3f}",
                        weak.material.normal_stiffness, weak.material.friction, r[0], r[1]));
    return r;
}

double Calibration::target_axial(double stress) const {
    return targets.byerlee ? fem::byerlee_axial(stress)
                           : fem::CoulombLine{targets.friction, targets.cohesion}.axial(stress);
}

void fit_stiffness(Calibration& c, RockMaterial& rock) {
    c.log.say("stiffness and stiffness ratio");
    const CalibrationTargets& t = c.targets;
    double ratio = 2.66;
    double last_log = 0.0, last_poisson = 0.0;
    for (int round = 0; round < 8; ++round) {
        rock.material.shear_stiffness = rock.material.normal_stiffness / ratio;
        const auto [young, poisson] = c.elastic(rock);
        const bool fits = std::abs(young / t.young - 1.0) < 0.02;
        rock.material.normal_stiffness *= t.young / young;
        rock.material.shear_stiffness = rock.material.normal_stiffness / ratio;
        if (std::abs(poisson - t.poisson) < 0.007) {
            if (fits || round > 0)
                break;
            continue;
        }
        const double now = dem::logarithm(ratio);
        // From 1 to 4, nu rises by about 0.09 per e-fold; later the secant knows better.
        double slope = 0.09;
        if (round > 0 && std::abs(now - last_log) > 1e-3)
            slope = std::clamp((poisson - last_poisson) / (now - last_log), 0.03, 0.3);
        last_log = now;
        last_poisson = poisson;
        const double next = std::clamp(dem::exponential(now + (t.poisson - poisson) / slope),
                                       least_ratio, greatest_ratio);
        if (next == ratio) {
            c.misses.push_back(fmt::format(
                "Poisson's ratio {:.3f}: {:.3f} is reached at the limit k_n/k_s = {}; contacts "
                "between discs give no {}",
                t.poisson, poisson, ratio, t.poisson > poisson ? "more" : "less"));
            break;
        }
        ratio = next;
        rock.material.shear_stiffness = rock.material.normal_stiffness / ratio;
    }
}

void fit_strength(Calibration& c, RockMaterial& rock) {
    c.log.say("bond strength and disc friction");
    const std::vector<double>& confining = Calibration::confining;
    // Shear strength must not limit: a multiple of the greatest stress tested (calibration of the
    // paper's rock: ten times Table 1's).
    rock.bonds->shear_mean = std::max(2e9, 2.0 * c.target_axial(confining.back()));
    rock.bonds->shear_deviation = 0.25 * rock.bonds->shear_mean;
    // Parameters: disc friction and the logarithm of tensile strength.
    const auto errors = [&](const TwoParameters& x) {
        rock.material.friction = std::clamp(x[0], least_friction, greatest_friction);
        rock.bonds->tensile_mean =
            std::clamp(dem::exponential(x[1]), least_tension, greatest_tension);
        rock.bonds->tensile_deviation = 0.25 * rock.bonds->tensile_mean;
        std::vector<double> e = c.strength(rock);
        for (std::size_t k = 0; k < e.size(); ++k)
            e[k] = e[k] / c.target_axial(confining[k]) - 1.0;
        return e;
    };
    const double slope = c.targets.byerlee ? 0.75 : c.targets.friction;
    // Far below the confining stresses tension changes nothing, and the search would not see which
    // way to go.
    const double tension =
        std::max(0.1 * confining.front(), c.targets.byerlee ? 0.0 : c.targets.cohesion);
    const TwoParameters start{std::clamp(2.0 * (slope - 0.35), 0.05, 2.0), dem::logarithm(tension)};
    const GaussNewton search{.errors = errors,
                             .lower = {least_friction, dem::logarithm(least_tension)},
                             .upper = {greatest_friction, dem::logarithm(greatest_tension)},
                             .difference = {start[0] > 1.0 ? -0.4 : 0.3, dem::logarithm(2.0)},
                             .longest = {0.5, 1.5},
                             .rounds = 6,
                             .enough = 0.03,
                             .shortest = 0.01};
    const std::vector<double> e = errors(search.minimise(start));
    for (std::size_t k = 0; k < e.size(); ++k)
        if (std::abs(e[k]) > 0.15)
            c.misses.push_back(fmt::format(
                "strength at {:.0f} MPa: {:+.0f} % off; {}", confining[k] / 1e6, 100.0 * e[k],
                rock.material.friction >= greatest_friction
                    ? "disc friction is at its limit and discs roll"
                : rock.material.friction <= least_friction
                    ? "even frictionless discs interlock to more"
                    : "one disc friction and one tensile strength bend the envelope their way"));
}

RockMaterial fit_weak(Calibration& c, const RockMaterial& rock, const std::string& name,
                      double target) {
    c.log.say("weakened rock");
    RockMaterial weak = rock;
    weak.bonds.reset();
    weak.material.bondable = false;
    weak.name = name;
    const double softer =
        std::clamp(85.0 * Calibration::normal.back() / rock.material.normal_stiffness, 0.1, 1.0);
    weak.material.normal_stiffness = softer * rock.material.normal_stiffness;
    weak.material.shear_stiffness = softer * rock.material.shear_stiffness;
    const auto measure = [&](double friction) {
        weak.material.friction = friction;
        const auto r = c.bulk_friction(weak, rock);
        return 0.5 * (r[0] + r[1]);
    };
    double low = 0.0, high = 3.0;
    double last = 0.0, at_last = measure(0.0);
    if (at_last > target) {
        c.misses.push_back(fmt::format("bulk friction {:.2f}: frictionless discs interlock to "
                                       "{:.2f}; softer ones have less, but it then falls with the "
                                       "normal stress",
                                       target, at_last));
        return weak;
    }
    double x = 0.5, at_x = 0.0;
    for (int round = 0; round < 6; ++round) {
        at_x = measure(x);
        if (std::abs(at_x - target) < 0.02)
            return weak;
        (at_x < target ? low : high) = x;
        const double slope = (at_x - at_last) / (x - last);
        last = x;
        at_last = at_x;
        double next = slope > 1e-3 ? x + (target - at_x) / slope : high;
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        if (std::abs(next - x) < 1e-3)
            break;
        x = next;
    }
    if (std::abs(at_x - target) > 0.05)
        c.misses.push_back(fmt::format("bulk friction {:.2f}: {:.2f} is reached at a disc friction "
                                       "of {:.2f}; beyond it discs roll",
                                       target, at_x, weak.material.friction));
    return weak;
}

} // namespace listric
