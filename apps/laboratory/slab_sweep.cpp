#include "apps/laboratory/slab_sweep.hpp"

#include "apps/archive/tables/fault_fields.hpp"
#include "apps/laboratory/envelope.hpp"
#include "apps/measures/dictionary.hpp"
#include "apps/model/effects.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/scene/toml/toml.hpp"
#include "apps/support/files/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

namespace listric {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The slab of a call, with its rock (already in the output folder).
SceneRequest slab_request(const LaboratoryRequest& request, const LaboratoryReport& r,
                          std::uint64_t seed) {
    const std::string weakened = request.weakened.value_or(
        r.rock.name.ends_with("-calibrated") ? "mat18-w-calibrated" : "mat18-w");
    SceneRequest scene;
    scene.scene = "pure-shear";
    scene.set = {"materials.basement=" + quoted((r.output / "material.toml").string()),
                 "materials.weakened=" + quoted(weakened), "output.series=\"none\""};
    scene.accuracy = request.accuracy;
    scene.seed = static_cast<std::int64_t>(seed);
    return scene;
}

/// Friction of the rock: slope of each sample's envelope.
Spread measure_friction(const Laboratory& lab, const RockMaterial& rock,
                        const std::vector<double>& confining) {
    const auto samples = lab.make_samples(rock.material);
    const auto curves = lab.biaxial(rock, samples, confining);
    std::vector<double> frictions;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        std::vector<double> peaks;
        for (const auto& by_seed : curves)
            peaks.push_back(peak_stress(by_seed[k]));
        frictions.push_back(fit_envelope(confining, peaks).friction);
    }
    return spread(frictions);
}

/// Slabs stretched at one pair of rates, by seed.
struct SweepPoint {
    CriticalRates rates;
    std::vector<StretchedSlab> slabs;

    std::vector<double> values(double StretchedSlab::*member) const {
        std::vector<double> all;
        for (const StretchedSlab& slab : slabs)
            all.push_back(slab.*member);
        return all;
    }
    std::vector<double> fault_counts() const {
        std::vector<double> all;
        for (const StretchedSlab& slab : slabs)
            all.push_back(static_cast<double>(slab.faults.size()));
        return all;
    }
    std::vector<double> segment_dips() const {
        std::vector<double> all;
        for (const StretchedSlab& slab : slabs)
            all.insert(all.end(), slab.segment_dips.begin(), slab.segment_dips.end());
        return all;
    }
    auto conjugate() const { return std::ranges::count_if(slabs, &StretchedSlab::conjugate); }

    /// Mean dip of all faults; none without faults.
    std::optional<double> dip() const {
        std::vector<SlabFault> faults;
        for (const StretchedSlab& slab : slabs)
            faults.insert(faults.end(), slab.faults.begin(), slab.faults.end());
        return mean_dip(faults);
    }
    /// Standard deviation of the slabs' mean dips, degrees.
    double dip_deviation() const {
        std::vector<double> dips;
        for (const StretchedSlab& slab : slabs)
            if (const auto dip = mean_dip(slab.faults))
                dips.push_back(*dip);
        return dips.empty() ? 0.0 : spread(dips).deviation;
    }
};

std::vector<SweepPoint> stretch_slabs(const LaboratoryReport& r, const LaboratoryRequest& request,
                                      const std::vector<CriticalRates>& rates) {
    const auto seeds = static_cast<std::size_t>(r.lab.seeds);
    std::vector<SweepPoint> points;
    for (const CriticalRates& at : rates) {
        SweepPoint point{at, {}};
        for (std::size_t k = 0; k < seeds; ++k) {
            r.lab.report("slabs", points.size() * seeds + k, rates.size() * seeds);
            SceneRequest scene = slab_request(request, r, r.lab.seed + k);
            std::ranges::copy(assignments(at), std::back_inserter(scene.set));
            RunOptions options;
            options.output = r.output / fmt::format("slab-weakening-{:g}-healing-{:g}-seed-{}",
                                                    at.weakening, at.healing, r.lab.seed + k);
            options.threads = r.lab.threads;
            options.figures = points.empty() && k == 0;
            options.stop = r.lab.stop;
            point.slabs.push_back(stretch_slab(load_scene(scene), std::move(options)));
        }
        points.push_back(std::move(point));
    }
    return points;
}

void print(const std::vector<SweepPoint>& points) {
    std::cout << fmt::format(
        "{:>13} {:>11} {:>6} {:>9} {:>9} {:>5} {:>7} {:>5} {:>7} {:>7} {:>5}\n", "weakening (/s)",
        "healing", "faults", "conjugate", "dip (deg)", "sd", "top 10%", "sd", "weak", "healed",
        "sd");
    for (const SweepPoint& p : points) {
        const Spread top10 = spread(p.values(&StretchedSlab::strain_top10));
        const Spread healed = spread(p.values(&StretchedSlab::healed_share));
        const auto dip = p.dip();
        std::cout << fmt::format(
            "{:>13.0e} {:>11.0e} {:>6.1f} {:>6} / {} {:>9} {:>5.1f} {:>7.2f} {:>5.2f} {:>7.3f} "
            "{:>7.2f} {:>5.2f}\n",
            p.rates.weakening, p.rates.healing, spread(p.fault_counts()).mean, p.conjugate(),
            p.slabs.size(), dip ? fmt::format("{:.1f}", *dip) : "-", p.dip_deviation(), top10.mean,
            top10.deviation, spread(p.values(&StretchedSlab::weak_fraction)).mean, healed.mean,
            healed.deviation);
    }
}

Json to_json(const SweepPoint& p) {
    const auto of = [&](double StretchedSlab::*member) {
        return to_json(spread(p.values(member)));
    };
    Json row = {
        {"weakening_rate_per_s", p.rates.weakening},
        {"healing_rate_per_s", p.rates.healing},
        {"faults", to_json(spread(p.fault_counts()))},
        {"conjugate_seeds", p.conjugate()},
        {measures::name_of<&measures::Measures::strain_top10>(), of(&StretchedSlab::strain_top10)},
        {measures::name_of<&measures::Measures::strain_top10_cumulative>(),
         of(&StretchedSlab::strain_top10_cumulative)},
        {effects::weak_fraction, of(&StretchedSlab::weak_fraction)},
        {"healed_share", of(&StretchedSlab::healed_share)}};
    if (const auto dip = p.dip())
        row[archive::field_dip_at_birth] = {{"mean", *dip}, {"sd", p.dip_deviation()}};
    if (const auto dips = p.segment_dips(); !dips.empty())
        row["segment_dip_deg"] = to_json(spread(dips));
    return row;
}

std::string slabs_csv(const std::vector<SweepPoint>& points, std::uint64_t seed) {
    std::string csv = "weakening_rate_per_s,healing_rate_per_s,seed,faults,mean_dip_deg,"
                      "strain_top10,strain_top10_cumulative,weak_fraction,healed_share,"
                      "unbalanced_ratio\n";
    for (const SweepPoint& p : points)
        for (std::size_t k = 0; k < p.slabs.size(); ++k) {
            const StretchedSlab& slab = p.slabs[k];
            csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", p.rates.weakening,
                               p.rates.healing, seed + k, slab.faults.size(),
                               mean_dip(slab.faults).value_or(std::nan("")), slab.strain_top10,
                               slab.strain_top10_cumulative, slab.weak_fraction, slab.healed_share,
                               slab.unbalanced_ratio);
        }
    return csv;
}

std::string faults_csv(const std::vector<SweepPoint>& points, std::uint64_t seed) {
    std::string csv = "weakening_rate_per_s,healing_rate_per_s,seed,dip_at_birth_deg,length_m,"
                      "falls_right,born_at_m\n";
    for (const SweepPoint& p : points)
        for (std::size_t k = 0; k < p.slabs.size(); ++k)
            for (const SlabFault& f : p.slabs[k].faults)
                csv += fmt::format("{},{},{},{},{},{},{}\n", p.rates.weakening, p.rates.healing,
                                   seed + k, f.dip_at_birth, f.length, f.falls_right ? 1 : 0,
                                   f.born_at);
    return csv;
}

} // namespace

std::vector<CriticalRates> sweep_rates(const LaboratoryRequest& request,
                                       const CriticalRates& standard) {
    const auto wished = [](const std::vector<double>& given, const std::vector<double>& otherwise,
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

void report_pure_shear(LaboratoryReport& r, const LaboratoryRequest& request,
                       const std::vector<double>& confining) {
    const Scene standard = load_scene(slab_request(request, r, r.lab.seed));
    const CriticalRates rates = critical_rates(standard);
    const Spread friction = measure_friction(r.lab, r.rock, confining);
    const double predicted = anderson_dip(friction.mean);
    std::cout << fmt::format("biaxial test: friction {:.3f} +- {:.3f}, so faults should dip at "
                             "{:.1f} degrees\n",
                             friction.mean, friction.deviation, predicted);
    const auto points = stretch_slabs(r, request, sweep_rates(request, rates));
    print(points);
    r.summary["accuracy"] = request.accuracy;
    r.summary["friction"] = friction.mean;
    r.summary["friction_sd"] = friction.deviation;
    r.summary["predicted_dip_deg"] = predicted;
    r.summary["standard_weakening_rate_per_s"] = rates.weakening;
    r.summary["standard_healing_rate_per_s"] = rates.healing;
    r.summary["mean_radius_m"] = standard.hanging_wall.mean_radius;
    Json& table = r.summary["points"] = Json::array();
    for (const SweepPoint& point : points)
        table.push_back(to_json(point));
    write_text(r.output / "slabs.csv", slabs_csv(points, r.lab.seed));
    write_text(r.output / "faults.csv", faults_csv(points, r.lab.seed));
}

} // namespace listric
