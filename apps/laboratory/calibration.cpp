#include "apps/laboratory/calibration.hpp"

#include "apps/laboratory/laboratory.hpp"
#include "apps/run/run.hpp"
#include "apps/support/file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>

namespace listric {

using namespace dem;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const std::vector<double> confining = {25e6, 100e6, 200e6}; // Pa
const std::vector<double> normal = {50e6, 200e6};           // Pa

// Where the search stays.
constexpr double least_ratio = 0.5, greatest_ratio = 8.0;       // of stiffnesses
constexpr double least_friction = 0.0, greatest_friction = 3.0; // of a disc
constexpr double least_tension = 1e3, greatest_tension = 1e9;   // Pa
constexpr double steepest = 0.9; ///< envelope that no disc friction reaches: 0.83 at 10

void check(const CalibrationTargets& t) {
    const auto refuse = [](const char* option, double value, const char* allowed) {
        throw UsageError(fmt::format("{} {}: allowed: {}", option, value, allowed));
    };
    if (!(t.young >= 1e6 && t.young <= 1e13))
        refuse("--young", t.young, "1e6 to 1e13 Pa");
    if (!(t.poisson > 0.0 && t.poisson < 0.5))
        refuse("--poisson", t.poisson, "above 0, below 0.5 (plane strain)");
    // nu_2D = nu / (1 - nu): a two-dimensional material reaches 0.5 when the rock has 1/3.
    if (t.poisson >= 1.0 / 3.0)
        refuse("--poisson", t.poisson,
               "below 1/3, which is 0.5 in 2D terms: contacts give less, however soft in shear");
    if (!t.byerlee && !(t.friction > 0.0 && t.friction <= steepest))
        refuse("--friction", t.friction,
               "above 0, at most 0.9: round discs roll, whatever their own friction");
    if (!t.byerlee && !(t.cohesion >= 0.0 && t.cohesion <= 1e9))
        refuse("--cohesion", t.cohesion, "0 to 1e9 Pa");
    if (t.bulk_friction && !(*t.bulk_friction > 0.0 && *t.bulk_friction <= 1.0))
        refuse("--bulk-friction", *t.bulk_friction, "above 0, at most 1");
}

/// Measurements, each made once: what history.json holds is not measured again. The search is
/// deterministic, so a resumed one takes the same way.
class History {
public:
    History(fs::path path, bool resume) : path_(std::move(path)) {
        std::ifstream in(path_);
        if (resume && in) {
            entries_ = nlohmann::json::parse(in, nullptr, false);
            if (!entries_.is_array())
                throw StorageError(path_.string() + ": not the history of a calibration");
        }
    }

    std::vector<double> measure(const std::string& what, const nlohmann::json& key,
                                const std::function<std::vector<double>()>& work) {
        for (const nlohmann::json& entry : entries_)
            if (entry["what"] == what && entry["of"] == key)
                return entry["result"].get<std::vector<double>>();
        const std::vector<double> result = work();
        entries_.push_back({{"what", what}, {"of", key}, {"result", result}});
        write_text(path_, entries_.dump(1) + "\n");
        return result;
    }

    std::size_t size() const { return entries_.size(); }

private:
    fs::path path_;
    nlohmann::json entries_ = nlohmann::json::array();
};

struct Calibration {
    const CalibrationRequest& request;
    Laboratory lab;
    History history;
    std::vector<std::string> misses = {}; ///< targets that were not reached, and why

    nlohmann::json key(const RockMaterial& rock, bool strengths) const {
        nlohmann::json k = {{"normal_stiffness_pa", rock.material.normal_stiffness},
                            {"shear_stiffness_pa", rock.material.shear_stiffness},
                            {"friction", rock.material.friction},
                            {"discs", lab.sample.discs},
                            {"seed", lab.seed},
                            {"seeds", lab.seeds}};
        if (strengths && rock.bonds) {
            k["tensile_strength_pa"] = rock.bonds->tensile_mean;
            k["shear_strength_pa"] = rock.bonds->shear_mean;
        }
        return k;
    }

    /// Plane-strain Young's modulus, Pa, and Poisson's ratio, means over the samples.
    void elastic(const RockMaterial& rock, double& young, double& poisson) {
        const auto r = history.measure("elasticity", key(rock, false), [&] {
            const auto curves = lab.uniaxial(rock, lab.make_samples(rock.material));
            std::vector<double> e, nu;
            for (const auto& curve : curves) {
                const Elasticity one = elasticity(curve);
                e.push_back(one.young());
                nu.push_back(one.poisson());
            }
            return std::vector<double>{spread(e).mean, spread(nu).mean};
        });
        young = r[0];
        poisson = r[1];
        std::cout << fmt::format("  k_n {:.4g}, k_n/k_s {:.3f}: E {:.2f} GPa, nu {:.3f}\n",
                                 rock.material.normal_stiffness,
                                 rock.material.normal_stiffness / rock.material.shear_stiffness,
                                 young / 1e9, poisson)
                  << std::flush;
    }

    /// Peak axial stress, Pa, at the confining stresses.
    std::vector<double> strength(const RockMaterial& rock) {
        const auto r = history.measure("strength", key(rock, true), [&] {
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
        std::cout << fmt::format("  friction {:.3f}, tension {:.3g} Pa: peak {:.0f}, {:.0f}, "
                                 "{:.0f} MPa\n",
                                 rock.material.friction, rock.bonds->tensile_mean, r[0] / 1e6,
                                 r[1] / 1e6, r[2] / 1e6)
                  << std::flush;
        return r;
    }

    /// Bulk friction over strain 0.1 to 0.3 at the normal stresses, between elastic blocks.
    std::vector<double> bulk_friction(const RockMaterial& weak, const RockMaterial& vice) {
        nlohmann::json k = key(weak, false);
        k["vice"] = key(vice, true);
        const auto r = history.measure("bulk friction", k, [&] {
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
        std::cout << fmt::format(
                         "  weak k_n {:.3g}, friction {:.3f}: bulk friction {:.3f}, {:.3f}\n",
                         weak.material.normal_stiffness, weak.material.friction, r[0], r[1])
                  << std::flush;
        return r;
    }

    double target_axial(double stress) const {
        const CalibrationTargets& t = request.targets;
        return t.byerlee ? byerlee_axial(stress) : Envelope{t.friction, t.cohesion}.axial(stress);
    }
};

/// E grows in proportion to k_n; nu with log(k_n/k_s), found by secants.
void fit_stiffness(Calibration& c, RockMaterial& rock) {
    std::cout << "stiffness and stiffness ratio\n";
    const CalibrationTargets& t = c.request.targets;
    double ratio = 2.66, young = 0.0, poisson = 0.0;
    double last_log = 0.0, last_poisson = 0.0;
    for (int round = 0; round < 8; ++round) {
        rock.material.shear_stiffness = rock.material.normal_stiffness / ratio;
        c.elastic(rock, young, poisson);
        const bool fits = std::abs(young / t.young - 1.0) < 0.02;
        rock.material.normal_stiffness *= t.young / young;
        rock.material.shear_stiffness = rock.material.normal_stiffness / ratio;
        if (std::abs(poisson - t.poisson) < 0.007) {
            if (fits || round > 0)
                break;
            continue;
        }
        const double now = std::log(ratio);
        // From 1 to 4, nu rises by about 0.09 per e-fold; later the secant knows better.
        double slope = 0.09;
        if (round > 0 && std::abs(now - last_log) > 1e-3)
            slope = std::clamp((poisson - last_poisson) / (now - last_log), 0.03, 0.3);
        last_log = now;
        last_poisson = poisson;
        const double next =
            std::clamp(std::exp(now + (t.poisson - poisson) / slope), least_ratio, greatest_ratio);
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

/// Disc friction and tensile strength for the envelope: Gauss-Newton on the relative errors of the
/// peaks, with Broyden's update of the Jacobian after one by differences.
void fit_strength(Calibration& c, RockMaterial& rock) {
    std::cout << "bond strength and disc friction\n";
    // Shear strength must not limit: a multiple of the greatest stress tested (calibration of the
    // paper's rock: ten times Table 1's).
    rock.bonds->shear_mean = std::max(2e9, 2.0 * c.target_axial(confining.back()));
    rock.bonds->shear_deviation = 0.25 * rock.bonds->shear_mean;
    using Two = std::array<double, 2>;
    const auto put = [&](const Two& x) {
        rock.material.friction = std::clamp(x[0], least_friction, greatest_friction);
        rock.bonds->tensile_mean = std::clamp(std::exp(x[1]), least_tension, greatest_tension);
        rock.bonds->tensile_deviation = 0.25 * rock.bonds->tensile_mean;
    };
    const auto errors = [&](const Two& x) {
        put(x);
        std::vector<double> e = c.strength(rock);
        for (std::size_t k = 0; k < e.size(); ++k)
            e[k] = e[k] / c.target_axial(confining[k]) - 1.0;
        return e;
    };
    const auto norm = [](const std::vector<double>& e) {
        double square = 0.0;
        for (double one : e)
            square += one * one;
        return std::sqrt(square / static_cast<double>(e.size()));
    };
    const double slope = c.request.targets.byerlee ? 0.75 : c.request.targets.friction;
    // Far below the confining stresses tension changes nothing, and the search would not see which
    // way to go.
    const double tension = std::max(0.1 * confining.front(),
                                    c.request.targets.byerlee ? 0.0 : c.request.targets.cohesion);
    Two x{std::clamp(2.0 * (slope - 0.35), 0.05, 2.0), std::log(tension)};
    std::vector<double> e = errors(x);
    const Two step{x[0] > 1.0 ? -0.4 : 0.3, std::log(2.0)};
    std::array<std::vector<double>, 2> jacobian;
    for (std::size_t p = 0; p < 2; ++p) {
        Two moved = x;
        moved[p] += step[p];
        const std::vector<double> there = errors(moved);
        jacobian[p].resize(e.size());
        for (std::size_t k = 0; k < e.size(); ++k)
            jacobian[p][k] = (there[k] - e[k]) / step[p];
    }
    Two best = x;
    double least = norm(e);
    for (int round = 0; round < 6 && least > 0.03; ++round) {
        double a = 1e-4, b = 0.0, d = 1e-4, u = 0.0, v = 0.0; // normal equations, barely damped
        for (std::size_t k = 0; k < e.size(); ++k) {
            a += jacobian[0][k] * jacobian[0][k];
            b += jacobian[0][k] * jacobian[1][k];
            d += jacobian[1][k] * jacobian[1][k];
            u -= jacobian[0][k] * e[k];
            v -= jacobian[1][k] * e[k];
        }
        const double det = a * d - b * b;
        Two move{std::clamp((d * u - b * v) / det, -0.5, 0.5),
                 std::clamp((a * v - b * u) / det, -1.5, 1.5)};
        Two next{std::clamp(x[0] + move[0], least_friction, greatest_friction),
                 std::clamp(x[1] + move[1], std::log(least_tension), std::log(greatest_tension))};
        move = {next[0] - x[0], next[1] - x[1]};
        const double length = move[0] * move[0] + move[1] * move[1];
        if (length < 1e-4)
            break;
        const std::vector<double> there = errors(next);
        for (std::size_t k = 0; k < e.size(); ++k) {
            const double predicted = e[k] + jacobian[0][k] * move[0] + jacobian[1][k] * move[1];
            for (std::size_t p = 0; p < 2; ++p)
                jacobian[p][k] += (there[k] - predicted) * move[p] / length;
        }
        x = next;
        e = there;
        if (norm(e) < least) {
            least = norm(e);
            best = x;
        }
    }
    e = errors(best);
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

/// Friction of the weakened discs, by secants. Softer than the rock they shear in a narrow zone; of
/// 85 times the largest normal stress, as mat18-w-calibrated has, their bulk friction hardly
/// depends on it.
RockMaterial fit_weak(Calibration& c, const RockMaterial& rock, double target) {
    std::cout << "weakened rock\n";
    RockMaterial weak = rock;
    weak.bonds.reset();
    weak.material.bondable = false;
    weak.name = c.request.name + "-weak";
    const double softer =
        std::clamp(85.0 * normal.back() / rock.material.normal_stiffness, 0.1, 1.0);
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

} // namespace

void run_calibration(const CalibrationRequest& request) {
    const CalibrationTargets& t = request.targets;
    check(t);
    check_sample(request.discs, request.seed, request.seeds);
    const fs::path output =
        request.output.empty() ? fs::path("out") / ("calibrate-" + request.name) : request.output;
    const fs::path history = output / "history.json";
    std::error_code error;
    fs::create_directories(output, error);
    if (error)
        throw StorageError(fmt::format("{}: {}", output.string(), error.message()));
    if (fs::exists(history) && !request.resume)
        throw UsageError(output.string() +
                         " holds a calibration: --resume continues it, --output writes elsewhere");

    Laboratory lab;
    lab.sample = compression_sample(static_cast<std::size_t>(request.discs));
    lab.seed = static_cast<std::uint64_t>(request.seed);
    lab.seeds = request.seeds;
    lab.threads = request.threads;
    Calibration c{request, lab, History(history, request.resume)};

    RockMaterial rock;
    rock.name = request.name;
    rock.bonds.emplace();
    rock.material.friction = 1.0;
    rock.material.normal_stiffness *= t.young / 50e9; // the paper's rock, scaled
    fit_stiffness(c, rock);
    fit_strength(c, rock);
    std::optional<RockMaterial> weak;
    if (t.bulk_friction)
        weak = fit_weak(c, rock, *t.bulk_friction);

    std::cout << "validation on other seeds\n";
    c.lab.seed += static_cast<std::uint64_t>(request.seeds);
    double young = 0.0, poisson = 0.0;
    c.elastic(rock, young, poisson);
    const std::vector<double> peaks = c.strength(rock);
    Json summary = {{"test", "calibrate"},
                    {"material", request.name},
                    {"discs", request.discs},
                    {"fitted_seeds", {request.seed, request.seed + request.seeds - 1}},
                    {"validation_seeds", {c.lab.seed, c.lab.seed + c.lab.seeds - 1u}},
                    {"evaluations", c.history.size()},
                    {"young_modulus_pa", {{"target", t.young}, {"validation", young}}},
                    {"poisson_ratio", {{"target", t.poisson}, {"validation", poisson}}}};
    std::cout << fmt::format("{:>24} {:>10} {:>10}\n{:>24} {:>10.2f} {:>10.2f}\n{:>24} {:>10.3f} "
                             "{:>10.3f}\n",
                             "", "target", "validation", "E (GPa)", t.young / 1e9, young / 1e9,
                             "nu", t.poisson, poisson);
    if (std::abs(young / t.young - 1.0) > 0.1)
        c.misses.push_back(fmt::format("E on other seeds: {:.2f} GPa", young / 1e9));
    if (std::abs(poisson - t.poisson) > 0.05)
        c.misses.push_back(fmt::format("nu on other seeds: {:.3f}", poisson));
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
    const Envelope line = fit_envelope(confining, peaks);
    summary["friction"] = line.friction;
    summary["cohesion_pa"] = line.cohesion;
    std::cout << fmt::format("envelope: friction {:.3f}, cohesion {:.1f} MPa\n", line.friction,
                             line.cohesion / 1e6);
    if (weak) {
        const auto mu = c.bulk_friction(*weak, rock);
        const double mean = 0.5 * (mu[0] + mu[1]);
        summary["bulk_friction"] = {{"target", *t.bulk_friction}, {"validation", mu}};
        for (std::size_t k = 0; k < normal.size(); ++k)
            std::cout << fmt::format("{:>24} {:>10.3f} {:>10.3f}\n",
                                     fmt::format("bulk fr. at {:.0f} MPa", normal[k] / 1e6),
                                     *t.bulk_friction, mu[k]);
        if (std::abs(mean - *t.bulk_friction) > 0.05)
            c.misses.push_back(fmt::format("bulk friction on other seeds: {:.3f}", mean));
        if (std::max(mu[0], mu[1]) > 1.25 * std::min(mu[0], mu[1]))
            c.misses.push_back(fmt::format(
                "bulk friction at any stress: {:.2f} at {:.0f} MPa, {:.2f} at {:.0f} MPa, where "
                "discs are pressed into each other",
                mu[0], normal[0] / 1e6, mu[1], normal[1] / 1e6));
        weak->description =
            fmt::format("Weakened rock of {}: bulk friction {:.2f}", request.name, mean);
        write_text(output / (weak->name + ".toml"), to_toml(*weak));
    }
    summary["not_reached"] = c.misses;
    rock.description = fmt::format(
        "Calibrated: plane-strain E {:.3g} GPa, nu {:.2f}, friction {:.2f}, cohesion {:.3g} MPa",
        young / 1e9, poisson, line.friction, line.cohesion / 1e6);
    write_text(output / (request.name + ".toml"), to_toml(rock));
    write_text(output / "summary.json", summary.dump(2) + "\n");
    for (const std::string& miss : c.misses)
        std::cout << "not reached: " << miss << '\n';
    std::cout << "written: " << (output / (request.name + ".toml")).string() << '\n';
}

} // namespace listric
