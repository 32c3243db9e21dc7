#include "apps/laboratory/laboratory.hpp"

#include "apps/archive/snapshot.hpp"
#include "apps/figures/figures.hpp"
#include "apps/laboratory/pure_shear.hpp"
#include "apps/run/run.hpp"
#include "apps/support/python.hpp"
#include "dem/contacts.hpp"
#include "dem/monitor.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <mutex>
#include <thread>
#include <unistd.h>

namespace listric {

using namespace dem;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double mega = 1e6, giga = 1e9;
constexpr double axial_strain_rate = 2e-5; // per s
constexpr double shear_speed = 0.25;       // m/s

const std::vector<std::string_view> tests = {"uniaxial", "biaxial", "shear-box", "pure-shear"};

/// Share of the work that is done, for people, on stderr.
class Progress {
public:
    explicit Progress(bool quiet) : quiet_(quiet || !isatty(STDERR_FILENO)) {}
    ~Progress() {
        if (!quiet_)
            std::fputs("\r\x1b[K", stderr);
    }
    void operator()(std::string_view stage, std::size_t done, std::size_t all) {
        if (quiet_)
            return;
        const std::lock_guard lock(mutex_);
        std::fputs(fmt::format("\r\x1b[K{}: {} of {}", stage, done, all).c_str(), stderr);
    }

private:
    bool quiet_;
    std::mutex mutex_;
};

Json to_json(const Spread& s) { return {{"mean", s.mean}, {"sd", s.deviation}}; }

/// Runs work(k), counting for the report.
void for_each_reported(const Laboratory& lab, std::string_view stage, std::size_t count,
                       const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> done = 0;
    lab.report(stage, 0, count);
    for_each_on_threads(count, lab.threads, [&](std::size_t k) {
        work(k);
        lab.report(stage, ++done, count);
    });
}

/// What is known of a finished call, on its way into summary.json.
struct Results {
    const LaboratoryRequest& request;
    const Laboratory& lab;
    const RockMaterial& rock;
    fs::path output;
    Json summary;
};

std::string rows(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += line + '\n';
    return text;
}

void describe_samples(Results& r, const std::vector<Specimen>& samples) {
    std::vector<double> contacts;
    for (const Specimen& s : samples) {
        const std::vector<bool> touches = touching(s.state);
        contacts.push_back(2.0 * static_cast<double>(std::ranges::count(touches, true)) /
                           static_cast<double>(s.state.discs.rows()));
    }
    r.summary["mean_radius_m"] = mean_radius(r.lab.sample);
    r.summary["sample_width_m"] = r.lab.sample.width;
    r.summary["sample_height_m"] = r.lab.sample.height;
    r.summary["contacts_per_disc"] = to_json(spread(contacts));
}

void test_uniaxially(Results& r) {
    const auto samples = r.lab.make_samples(r.rock.material);
    describe_samples(r, samples);
    const auto curves = r.lab.uniaxial(r.rock, samples);
    std::vector<double> young, poisson, young_2d, poisson_2d;
    std::vector<std::string> csv{"seed,axial_strain,axial_stress_pa,gauge_axial_strain,"
                                 "gauge_lateral_strain"};
    std::cout << fmt::format("{:>6} {:>9} {:>7} {:>9} {:>7}\n", "seed", "E (GPa)", "nu", "E 2D",
                             "nu 2D");
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const Elasticity e = elasticity(curves[k]);
        young.push_back(e.young());
        poisson.push_back(e.poisson());
        young_2d.push_back(e.young_2d);
        poisson_2d.push_back(e.poisson_2d);
        std::cout << fmt::format("{:>6} {:>9.2f} {:>7.3f} {:>9.2f} {:>7.3f}\n", r.lab.seed + k,
                                 young[k] / giga, poisson[k], young_2d[k] / giga, poisson_2d[k]);
        for (const CompressionPoint& p : curves[k])
            csv.push_back(fmt::format("{},{},{},{},{}", r.lab.seed + k, p.axial_strain,
                                      p.axial_stress, p.gauge_axial, p.gauge_lateral));
    }
    const Spread e = spread(young), nu = spread(poisson), e2 = spread(young_2d),
                 nu2 = spread(poisson_2d);
    std::cout << fmt::format("{:>6} {:>9.2f} {:>7.3f} {:>9.2f} {:>7.3f}\n{:>6} {:>9.2f} {:>7.3f} "
                             "{:>9.2f} {:>7.3f}\n",
                             "mean", e.mean / giga, nu.mean, e2.mean / giga, nu2.mean, "sd",
                             e.deviation / giga, nu.deviation, e2.deviation / giga, nu2.deviation);
    r.summary["young_modulus_pa"] = to_json(e);
    r.summary["poisson_ratio"] = to_json(nu);
    r.summary["young_modulus_2d_pa"] = to_json(e2);
    r.summary["poisson_ratio_2d"] = to_json(nu2);
    write_text(r.output / "curves.csv", rows(csv));
}

void test_biaxially(Results& r, const std::vector<double>& confining) {
    const auto samples = r.lab.make_samples(r.rock.material);
    describe_samples(r, samples);
    const auto curves = r.lab.biaxial(r.rock, samples, confining);
    std::vector<std::string> csv{"confining_pa,seed,axial_strain,axial_stress_pa,lateral_strain,"
                                 "lateral_stress_pa,broken_bonds"};
    std::vector<double> means;
    std::vector<std::vector<double>> by_seed(samples.size());
    Json points = Json::array();
    std::cout << fmt::format("{:>16} {:>16} {:>8} {:>14} {:>6} {:>7}\n", "confining (MPa)",
                             "peak axial (MPa)", "sd", "Byerlee (MPa)", "ratio", "broken");
    for (std::size_t c = 0; c < confining.size(); ++c) {
        std::vector<double> peaks, broken;
        for (std::size_t k = 0; k < curves[c].size(); ++k) {
            peaks.push_back(peak_stress(curves[c][k]));
            broken.push_back(curves[c][k].back().broken);
            by_seed[k].push_back(peaks.back());
            for (const CompressionPoint& p : curves[c][k])
                csv.push_back(fmt::format("{},{},{},{},{},{},{}", confining[c], r.lab.seed + k,
                                          p.axial_strain, p.axial_stress, p.lateral_strain,
                                          p.lateral_stress, p.broken));
        }
        const Spread s = spread(peaks);
        means.push_back(s.mean);
        const double byerlee = byerlee_axial(confining[c]);
        std::cout << fmt::format("{:>16.0f} {:>16.1f} {:>8.1f} {:>14.1f} {:>6.2f} {:>7.2f}\n",
                                 confining[c] / mega, s.mean / mega, s.deviation / mega,
                                 byerlee / mega, s.mean / byerlee, spread(broken).mean);
        points.push_back({{"confining_pa", confining[c]},
                          {"peak_axial_pa", s.mean},
                          {"sd_pa", s.deviation},
                          {"byerlee_axial_pa", byerlee},
                          {"broken_bonds", spread(broken).mean}});
    }
    r.summary["points"] = points;
    if (confining.size() > 1) {
        const Envelope line = fit_envelope(confining, means);
        std::vector<double> frictions, cohesions;
        for (const auto& peaks : by_seed) {
            const Envelope one = fit_envelope(confining, peaks);
            frictions.push_back(one.friction);
            cohesions.push_back(one.cohesion);
        }
        r.summary["friction"] = line.friction;
        r.summary["friction_sd"] = spread(frictions).deviation;
        r.summary["cohesion_pa"] = line.cohesion;
        r.summary["cohesion_sd_pa"] = spread(cohesions).deviation;
        std::cout << fmt::format("friction {:.3f} +- {:.3f}, cohesion {:.1f} +- {:.1f} MPa\n",
                                 line.friction, spread(frictions).deviation, line.cohesion / mega,
                                 spread(cohesions).deviation / mega);
    }
    write_text(r.output / "curves.csv", rows(csv));
}

/// What the zone is held by: the call's wish, or the basement rock that goes with it.
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

void shear_samples(Results& r, const std::vector<double>& normal) {
    const ShearBoxFilling filling = make_filling(r.request, r.rock);
    const RockMaterial& outside = filling.vice.value_or(filling.zone);
    const std::string vice = !filling.vice          ? "none"
                             : filling.elastic_vice ? "elastic (" + outside.name + ")"
                                                    : outside.name;
    std::cout << fmt::format("zone {}, vice {}, {:.0f} m x {:.0f} m\n", filling.zone.name, vice,
                             r.lab.sample.width, r.lab.sample.height);
    const auto samples = r.lab.make_samples(outside.material);
    describe_samples(r, samples);
    const auto sheared = r.lab.shear_box(filling, samples, normal);
    const double zone_width = ShearBoxParameters{}.zone_width;
    std::vector<std::string> csv{"normal_pa,seed,shear_strain,shear_stress_pa,normal_stress_pa,"
                                 "zone_width_m,broken_outside"};
    std::vector<std::string> profiles{"normal_pa,seed,y_m,displacement_m"};
    Json points = Json::array();
    std::cout << fmt::format("{:>13} {:>14} {:>6} {:>11} {:>6} {:>13} {:>9} {:>12}\n",
                             "normal (MPa)", "mu 0.1 to 0.3", "sd", "0.3 to 0.5", "peak",
                             "collapse (m)", "in zone", "vice broken");
    double least = 1e300, most = 0.0;
    for (std::size_t n = 0; n < normal.size(); ++n) {
        std::vector<double> mean, late, peak, collapse, share, broken, by_loading;
        for (std::size_t k = 0; k < sheared[n].size(); ++k) {
            const ShearTest& t = sheared[n][k];
            mean.push_back(t.bulk_friction(0.1, 0.3));
            late.push_back(t.bulk_friction(0.3, 0.5));
            peak.push_back(t.peak_friction());
            collapse.push_back(t.collapse);
            share.push_back(t.share_in_zone(zone_width));
            broken.push_back(t.curve.back().broken);
            by_loading.push_back(t.broken_by_loading);
            for (const ShearPoint& p : t.curve)
                csv.push_back(fmt::format("{},{},{},{},{},{},{}", normal[n], r.lab.seed + k,
                                          p.strain, p.shear_stress, p.normal_stress, p.zone_width,
                                          p.broken));
            for (const ShearProfilePoint& p : t.profile)
                profiles.push_back(
                    fmt::format("{},{},{},{}", normal[n], r.lab.seed + k, p.y, p.displacement));
        }
        const Spread mu = spread(mean);
        least = std::min(least, mu.mean);
        most = std::max(most, mu.mean);
        std::cout << fmt::format(
            "{:>13.0f} {:>14.3f} {:>6.3f} {:>11.3f} {:>6.3f} {:>13.0f} {:>9.2f} {:>12.2f}\n",
            normal[n] / mega, mu.mean, mu.deviation, spread(late).mean, spread(peak).mean,
            spread(collapse).mean, spread(share).mean, spread(broken).mean);
        points.push_back({{"normal_pa", normal[n]},
                          {"bulk_friction", mu.mean},
                          {"sd", mu.deviation},
                          {"late_bulk_friction", spread(late).mean},
                          {"late_sd", spread(late).deviation},
                          {"peak_bulk_friction", spread(peak).mean},
                          {"peak_sd", spread(peak).deviation},
                          {"collapse_m", spread(collapse).mean},
                          {"displacement_share_in_zone", spread(share).mean},
                          {"broken_outside_zone", spread(broken).mean},
                          {"broken_outside_zone_by_loading", spread(by_loading).mean}});
    }
    r.summary["zone"] = filling.zone.name;
    r.summary["vice"] = vice;
    r.summary["zone_width_m"] = zone_width;
    r.summary["points"] = points;
    if (normal.size() > 1 && least > 0.0) {
        r.summary["largest_over_smallest"] = most / least;
        std::cout << fmt::format("largest over smallest: {:.2f}\n", most / least);
    }
    write_text(r.output / "curves.csv", rows(csv));
    write_text(r.output / "profiles.csv", rows(profiles));
}

/// The rates at which slabs are stretched: one varies, the other has the scene's value.
std::vector<CriticalRates> sweep(const LaboratoryRequest& request, const CriticalRates& standard) {
    const auto wished = [](const std::vector<double>& given, std::vector<double> otherwise,
                           std::string_view option) {
        for (double rate : given)
            if (!(rate > 0.0 && rate <= 1e-3))
                throw UsageError(fmt::format("--{} {}: allowed: above 0, at most 1e-3 per second",
                                             option, rate));
        return given.empty() ? otherwise : given;
    };
    std::vector<CriticalRates> points{standard};
    const auto add = [&](const CriticalRates& rates) {
        if (std::ranges::find(points, rates) == points.end())
            points.push_back(rates);
    };
    for (double rate :
         wished(request.weakening_rates, {1e-14, 3e-14, 1e-13, 3e-13, 1e-12}, "weakening-rates"))
        add({rate, standard.healing});
    for (double rate :
         wished(request.healing_rates, {1e-17, 1e-16, 1e-15, 1e-14, 1e-13}, "healing-rates"))
        add({standard.weakening, rate});
    return points;
}

/// The slab of a call, with its rock (already in the output folder).
Scene slab_scene(const LaboratoryRequest& request, const fs::path& output, const RockMaterial& rock,
                 std::uint64_t seed) {
    const std::string weakened = request.weakened.value_or(
        rock.name.ends_with("-calibrated") ? "mat18-w-calibrated" : "mat18-w");
    SceneRequest scene;
    scene.scene = "pure-shear";
    scene.set = {"materials.basement=" + quoted((output / "material.toml").string()),
                 "materials.weakened=" + quoted(weakened), "output.series=\"none\""};
    scene.accuracy = request.accuracy;
    scene.seed = static_cast<std::int64_t>(seed);
    return load_scene(scene);
}

/// One row of the sweep: mean and spread over the seeds of one pair of rates.
struct SweepPoint {
    CriticalRates rates;
    std::vector<SlabFault> faults;
    std::vector<double> dips, count, top10, cumulative, weak, healed, segments;
    int conjugate = 0;
};

void stretch_slabs(Results& r, const std::vector<double>& confining) {
    const Scene standard = slab_scene(r.request, r.output, r.rock, r.lab.seed);
    const CriticalRates rates{standard.fault_weakening->strain_rate,
                              standard.bond_healing->strain_rate};
    const std::vector<CriticalRates> points = sweep(r.request, rates);
    const auto samples = r.lab.make_samples(r.rock.material);
    const auto curves = r.lab.biaxial(r.rock, samples, confining);
    std::vector<double> frictions;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        std::vector<double> peaks;
        for (const auto& by_seed : curves)
            peaks.push_back(peak_stress(by_seed[k]));
        frictions.push_back(fit_envelope(confining, peaks).friction);
    }
    const Spread friction = spread(frictions);
    const double predicted = anderson_dip(friction.mean);
    std::cout << fmt::format("biaxial test: friction {:.3f} +- {:.3f}, so faults should dip at "
                             "{:.1f} degrees\n",
                             friction.mean, friction.deviation, predicted);

    const auto seeds = static_cast<std::size_t>(r.lab.seeds);
    std::vector<std::string> csv{"weakening_rate_per_s,healing_rate_per_s,seed,faults,mean_dip_deg,"
                                 "strain_top10,strain_top10_cumulative,weak_fraction,healed_share,"
                                 "unbalanced_ratio"};
    std::vector<std::string> list{"weakening_rate_per_s,healing_rate_per_s,seed,dip_at_birth_deg,"
                                  "length_m,falls_right,born_at_m"};
    std::vector<SweepPoint> rows_of_table;
    for (std::size_t n = 0; n < points.size(); ++n) {
        SweepPoint point;
        point.rates = points[n];
        for (std::size_t k = 0; k < seeds; ++k) {
            r.lab.report("slabs", n * seeds + k, points.size() * seeds);
            Scene scene = slab_scene(r.request, r.output, r.rock, r.lab.seed + k);
            scene.fault_weakening->strain_rate = points[n].weakening;
            scene.bond_healing->strain_rate = points[n].healing;
            const StretchedSlab slab = stretch_slab(
                scene,
                r.output / fmt::format("slab-weakening-{:g}-healing-{:g}-seed-{}",
                                       points[n].weakening, points[n].healing, r.lab.seed + k),
                r.lab.threads, n == 0 && k == 0);
            const auto dip = mean_dip(slab.faults);
            if (dip)
                point.dips.push_back(*dip);
            point.count.push_back(static_cast<double>(slab.faults.size()));
            point.top10.push_back(slab.strain_top10);
            point.cumulative.push_back(slab.strain_top10_cumulative);
            point.weak.push_back(slab.weak_fraction);
            point.healed.push_back(slab.healed_share);
            point.conjugate += slab.conjugate();
            point.faults.insert(point.faults.end(), slab.faults.begin(), slab.faults.end());
            point.segments.insert(point.segments.end(), slab.segment_dips.begin(),
                                  slab.segment_dips.end());
            csv.push_back(fmt::format("{},{},{},{},{},{},{},{},{},{}", points[n].weakening,
                                      points[n].healing, r.lab.seed + k, slab.faults.size(),
                                      dip.value_or(std::nan("")), slab.strain_top10,
                                      slab.strain_top10_cumulative, slab.weak_fraction,
                                      slab.healed_share, slab.unbalanced_ratio));
            for (const SlabFault& f : slab.faults)
                list.push_back(fmt::format("{},{},{},{},{},{},{}", points[n].weakening,
                                           points[n].healing, r.lab.seed + k, f.dip_at_birth,
                                           f.length, f.falls_right ? 1 : 0, f.born_at));
        }
        rows_of_table.push_back(std::move(point));
    }

    std::cout << fmt::format(
        "{:>13} {:>11} {:>6} {:>9} {:>9} {:>5} {:>7} {:>5} {:>7} {:>7} {:>5}\n", "weakening (/s)",
        "healing", "faults", "conjugate", "dip (deg)", "sd", "top 10%", "sd", "weak", "healed",
        "sd");
    Json table = Json::array();
    for (const SweepPoint& p : rows_of_table) {
        const Spread top10 = spread(p.top10), healed = spread(p.healed);
        const auto dip = mean_dip(p.faults);
        const double dip_sd = p.dips.empty() ? 0.0 : spread(p.dips).deviation;
        std::cout << fmt::format(
            "{:>13.0e} {:>11.0e} {:>6.1f} {:>6} / {} {:>9} {:>5.1f} {:>7.2f} {:>5.2f} {:>7.3f} "
            "{:>7.2f} {:>5.2f}\n",
            p.rates.weakening, p.rates.healing, spread(p.count).mean, p.conjugate, seeds,
            dip ? fmt::format("{:.1f}", *dip) : "-", dip_sd, top10.mean, top10.deviation,
            spread(p.weak).mean, healed.mean, healed.deviation);
        Json row = {{"weakening_rate_per_s", p.rates.weakening},
                    {"healing_rate_per_s", p.rates.healing},
                    {"faults", to_json(spread(p.count))},
                    {"conjugate_seeds", p.conjugate},
                    {"strain_top10", to_json(top10)},
                    {"strain_top10_cumulative", to_json(spread(p.cumulative))},
                    {"weak_fraction", to_json(spread(p.weak))},
                    {"healed_share", to_json(healed)}};
        if (dip)
            row["dip_at_birth_deg"] = {{"mean", *dip}, {"sd", dip_sd}};
        if (!p.segments.empty())
            row["segment_dip_deg"] = to_json(spread(p.segments));
        table.push_back(std::move(row));
    }
    r.summary["accuracy"] = r.request.accuracy;
    r.summary["friction"] = friction.mean;
    r.summary["friction_sd"] = friction.deviation;
    r.summary["predicted_dip_deg"] = predicted;
    r.summary["standard_weakening_rate_per_s"] = rates.weakening;
    r.summary["standard_healing_rate_per_s"] = rates.healing;
    r.summary["mean_radius_m"] = standard.hanging_wall->mean_radius;
    r.summary["points"] = table;
    write_text(r.output / "slabs.csv", rows(csv));
    write_text(r.output / "faults.csv", rows(list));
}

std::vector<double> stresses(const LaboratoryRequest& request, std::vector<double> standard,
                             std::string_view option) {
    std::vector<double> result;
    for (double s : request.stresses.empty() ? standard : request.stresses) {
        if (!(s >= 0.5 && s <= 2000.0))
            throw UsageError(fmt::format("--{} {}: allowed: 0.5 to 2000 MPa", option, s));
        result.push_back(s * mega);
    }
    std::ranges::sort(result);
    return result;
}

} // namespace

void for_each_on_threads(std::size_t count, int threads,
                         const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next = 0;
    std::vector<std::exception_ptr> failures(count);
    const auto take = [&] {
        for (std::size_t k; (k = next++) < count;)
            try {
                work(k);
            } catch (...) {
                failures[k] = std::current_exception();
            }
    };
    {
        std::vector<std::jthread> others;
        for (int t = 1; t < threads && static_cast<std::size_t>(t) < count; ++t)
            others.emplace_back(take);
        take();
    }
    for (const std::exception_ptr& failure : failures)
        if (failure)
            std::rethrow_exception(failure);
}

SampleParameters compression_sample(std::size_t discs) {
    SampleParameters p;
    p.discs = discs;
    return p;
}

SampleParameters shear_box_sample(std::size_t discs) {
    // The zone is about three disc diameters wide [paper], so discs keep their size and the box is
    // as long as they fill.
    SampleParameters p;
    p.discs = discs;
    p.height = 2000.0;
    const double radius = HangingWallParameters{}.mean_radius;
    p.width = 1000.0;
    p.width *= radius * radius / (mean_radius(p) * mean_radius(p));
    return p;
}

std::vector<Specimen> Laboratory::make_samples(const Material& material) const {
    std::vector<Specimen> samples(static_cast<std::size_t>(seeds));
    for_each_reported(*this, "samples", samples.size(), [&](std::size_t k) {
        SampleParameters p = sample;
        p.seed = seed + k;
        samples[k] = make_sample(p, material);
    });
    return samples;
}

std::vector<std::vector<CompressionPoint>>
Laboratory::uniaxial(const RockMaterial& rock, const std::vector<Specimen>& samples) const {
    std::vector<std::vector<CompressionPoint>> curves(samples.size());
    for_each_reported(*this, "uniaxial tests", samples.size(), [&](std::size_t k) {
        Specimen s = samples[k];
        consolidate(s, rock, true);
        CompressionParameters p;
        p.strain_rate = axial_strain_rate * speed;
        curves[k] = compress_elastically(std::move(s), p);
    });
    return curves;
}

std::vector<std::vector<std::vector<CompressionPoint>>>
Laboratory::biaxial(const RockMaterial& rock, const std::vector<Specimen>& samples,
                    const std::vector<double>& confining) const {
    std::vector<std::vector<std::vector<CompressionPoint>>> curves(
        confining.size(), std::vector<std::vector<CompressionPoint>>(samples.size()));
    for_each_reported(*this, "biaxial tests", confining.size() * samples.size(),
                      [&](std::size_t n) {
                          const std::size_t c = n / samples.size(), k = n % samples.size();
                          Specimen s = samples[k];
                          consolidate(s, rock, false);
                          CompressionParameters p;
                          p.confining = confining[c];
                          p.strain_rate = axial_strain_rate * speed;
                          curves[c][k] = compress_to_failure(std::move(s), p);
                      });
    return curves;
}

std::vector<std::vector<ShearTest>> Laboratory::shear_box(const ShearBoxFilling& filling,
                                                          const std::vector<Specimen>& samples,
                                                          const std::vector<double>& normal) const {
    std::vector<std::vector<ShearTest>> sheared(normal.size(),
                                                std::vector<ShearTest>(samples.size()));
    for_each_reported(*this, "shear tests", normal.size() * samples.size(), [&](std::size_t n) {
        const std::size_t c = n / samples.size(), k = n % samples.size();
        ShearBoxParameters p;
        p.normal_stress = normal[c];
        p.speed = shear_speed * speed;
        sheared[c][k] = shear(samples[k], filling, p);
    });
    return sheared;
}

void check_sample(std::int64_t discs, std::int64_t seed, int seeds) {
    if (discs < 50 || discs > 100000)
        throw UsageError(
            fmt::format("--discs {}: a sample has 50 to 100,000 discs; the paper's has "
                        "239, and fewer than 50 say nothing about a rock",
                        discs));
    if (seed < 0)
        throw UsageError(fmt::format("--seed {}: allowed: at least 0", seed));
    if (seeds < 1 || seeds > 1000)
        throw UsageError(fmt::format("--seeds {}: allowed: 1 to 1000", seeds));
}

void run_laboratory(const LaboratoryRequest& request) {
    const auto started = std::chrono::steady_clock::now();
    if (std::ranges::find(tests, request.test) == tests.end())
        throw UsageError(fmt::format("no test {}, {}", request.test, advice(request.test, tests)));
    check_sample(request.discs, request.seed, request.seeds);
    if (!(request.speed > 0.0 && request.speed <= 100.0))
        throw UsageError(fmt::format("--speed {}: allowed: above 0, at most 100", request.speed));
    std::vector<std::string> changes = request.set;
    if (request.reading)
        changes.push_back("bonds.strength_is=" + *request.reading);
    const RockMaterial rock = load_material(request.material, changes);
    const bool in_box = request.test == "shear-box";
    const bool in_slab = request.test == "pure-shear";
    if ((request.test == "biaxial" || in_slab) && !rock.bonds)
        throw UsageError(fmt::format("{}: this test needs a rock with [bonds]; the shear box "
                                     "takes materials without (listric laboratory shear-box {})",
                                     rock.name, request.material));
    if (!in_slab && (request.weakened || !request.weakening_rates.empty() ||
                     !request.healing_rates.empty() || request.accuracy != "draft"))
        throw UsageError("--weakened, --weakening-rates, --healing-rates, --accuracy: only the "
                         "pure-shear test has them");
    if (!in_box && request.vice)
        throw UsageError("--vice: only the shear box has one");
    const std::vector<double> levels =
        in_box ? stresses(request, {10.0, 50.0, 100.0, 200.0}, "normal")
        : in_slab // stresses on the sides of a slab of 10 km that yields
            ? stresses(request, {10.0, 25.0, 50.0, 100.0}, "confining")
            : stresses(request, {10.0, 25.0, 50.0, 100.0, 200.0}, "confining");
    if (in_box)
        make_filling(request, rock); // complains before any work
    if (in_slab)
        sweep(request, {});

    const auto discs = static_cast<std::size_t>(request.discs);
    Laboratory lab;
    lab.sample = in_box ? shear_box_sample(discs) : compression_sample(discs);
    lab.sample.floaters_grow = request.floaters == "grown";
    lab.seed = static_cast<std::uint64_t>(request.seed);
    lab.seeds = request.seeds;
    lab.threads = request.threads;
    lab.speed = request.speed;
    Progress progress(request.quiet);
    lab.report = std::ref(progress);

    const fs::path output = request.output.empty()
                                ? fs::path("out") / (request.test + "-" + rock.name)
                                : request.output;
    std::error_code error;
    fs::create_directories(output, error);
    if (error)
        throw StorageError(fmt::format("{}: {}", output.string(), error.message()));
    write_text(output / "material.toml", to_toml(rock));
    Results results{request, lab, rock, output, {}};
    Json& summary = results.summary;
    summary = {{"test", request.test},         {"material", rock.name},
               {"discs", request.discs},       {"seed", request.seed},
               {"seeds", request.seeds},       {"threads", request.threads},
               {"floaters", request.floaters}, {"set", changes}};
    if (request.test == "uniaxial")
        test_uniaxially(results);
    else if (request.test == "biaxial")
        test_biaxially(results, levels);
    else if (in_slab)
        stretch_slabs(results, levels);
    else
        shear_samples(results, levels);
    summary["wall_s"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    write_text(output / "summary.json", summary.dump(2) + "\n");
    if (const std::string problem = run_drawing_script("laboratory.py", {output.string()});
        !problem.empty())
        std::fputs(fmt::format("listric: warning: no figure: {}\n", problem).c_str(), stderr);
}

} // namespace listric
