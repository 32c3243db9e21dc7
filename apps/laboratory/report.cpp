#include "apps/laboratory/report.hpp"

#include "apps/laboratory/envelope.hpp"
#include "apps/support/files/file.hpp"
#include "dem/contacts/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iostream>
#include <optional>

namespace listric {

using namespace dem;

namespace {

using Json = nlohmann::ordered_json;

constexpr double mega = 1e6, giga = 1e9;

void describe_samples(LaboratoryReport& r, const std::vector<Specimen>& samples) {
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

/// Lines through the mean strengths and, for their spread, through each sample's.
struct EnvelopeFit {
    fem::CoulombLine line;
    Spread friction, cohesion; ///< of the samples
};

/// @param peaks  by sample, then confining stress, Pa
EnvelopeFit fit_samples(const std::vector<double>& confining, const std::vector<double>& means,
                        const std::vector<std::vector<double>>& peaks) {
    std::vector<double> frictions, cohesions;
    for (const auto& of_sample : peaks) {
        const fem::CoulombLine one = fit_envelope(confining, of_sample);
        frictions.push_back(one.friction);
        cohesions.push_back(one.cohesion);
    }
    return {fit_envelope(confining, means), spread(frictions), spread(cohesions)};
}

void report_fit(LaboratoryReport& r, const EnvelopeFit& fit) {
    r.summary["friction"] = fit.line.friction;
    r.summary["friction_sd"] = fit.friction.deviation;
    r.summary["cohesion_pa"] = fit.line.cohesion;
    r.summary["cohesion_sd_pa"] = fit.cohesion.deviation;
    std::cout << fmt::format("friction {:.3f} +- {:.3f}, cohesion {:.1f} +- {:.1f} MPa\n",
                             fit.line.friction, fit.friction.deviation, fit.line.cohesion / mega,
                             fit.cohesion.deviation / mega);
}

/// Strengths from no confining stress to somewhat beyond the greatest, Pa.
std::string envelopes_csv(double greatest, const std::optional<EnvelopeFit>& fit) {
    constexpr int points = 200;
    std::string csv =
        fmt::format("confining_pa,byerlee_axial_pa{}\n", fit ? ",fitted_axial_pa" : "");
    for (int k = 0; k < points; ++k) {
        const double confining = 1.05 * greatest * k / (points - 1);
        csv += fmt::format("{},{}{}\n", confining, fem::byerlee_axial(confining),
                           fit ? fmt::format(",{}", fit->line.axial(confining)) : "");
    }
    return csv;
}

/// Results of the samples at one normal stress, by seed.
struct ShearSpreads {
    std::vector<double> mean, late, peak, collapse, share, broken, by_loading;

    ShearSpreads(const std::vector<ShearTest>& tests, double zone_width) {
        for (const ShearTest& t : tests) {
            mean.push_back(t.bulk_friction(0.1, 0.3));
            late.push_back(t.bulk_friction(0.3, 0.5));
            peak.push_back(t.peak_friction());
            collapse.push_back(t.collapse);
            share.push_back(t.share_in_zone(zone_width));
            broken.push_back(t.curve.back().broken);
            by_loading.push_back(t.broken_by_loading);
        }
    }

    std::string text(double normal) const {
        return fmt::format(
            "{:>13.0f} {:>14.3f} {:>6.3f} {:>11.3f} {:>6.3f} {:>13.0f} {:>9.2f} {:>12.2f}\n",
            normal / mega, spread(mean).mean, spread(mean).deviation, spread(late).mean,
            spread(peak).mean, spread(collapse).mean, spread(share).mean, spread(broken).mean);
    }

    Json json(double normal) const {
        return {{"normal_pa", normal},
                {"bulk_friction", spread(mean).mean},
                {"sd", spread(mean).deviation},
                {"late_bulk_friction", spread(late).mean},
                {"late_sd", spread(late).deviation},
                {"peak_bulk_friction", spread(peak).mean},
                {"peak_sd", spread(peak).deviation},
                {"collapse_m", spread(collapse).mean},
                {"displacement_share_in_zone", spread(share).mean},
                {"broken_outside_zone", spread(broken).mean},
                {"broken_outside_zone_by_loading", spread(by_loading).mean}};
    }
};

using ShearTests = std::vector<std::vector<ShearTest>>; ///< by normal stress, then seed

std::string shear_curves_csv(const ShearTests& tests, const std::vector<double>& normal,
                             std::uint64_t seed) {
    std::string csv = "normal_pa,seed,shear_strain,shear_stress_pa,normal_stress_pa,zone_width_m,"
                      "broken_outside\n";
    for (std::size_t n = 0; n < normal.size(); ++n)
        for (std::size_t k = 0; k < tests[n].size(); ++k)
            for (const ShearPoint& p : tests[n][k].curve)
                csv += fmt::format("{},{},{},{},{},{},{}\n", normal[n], seed + k, p.strain,
                                   p.shear_stress, p.normal_stress, p.zone_width, p.broken);
    return csv;
}

std::string shear_profiles_csv(const ShearTests& tests, const std::vector<double>& normal,
                               std::uint64_t seed) {
    std::string csv = "normal_pa,seed,y_m,displacement_m\n";
    for (std::size_t n = 0; n < normal.size(); ++n)
        for (std::size_t k = 0; k < tests[n].size(); ++k)
            for (const ShearProfilePoint& p : tests[n][k].profile)
                csv += fmt::format("{},{},{},{}\n", normal[n], seed + k, p.y, p.displacement);
    return csv;
}

} // namespace

Json to_json(const Spread& s) { return {{"mean", s.mean}, {"sd", s.deviation}}; }

void report_uniaxial(LaboratoryReport& r) {
    const auto samples = r.lab.make_samples(r.rock.material);
    describe_samples(r, samples);
    const auto curves = r.lab.uniaxial(r.rock, samples);
    std::vector<double> young, poisson, young_2d, poisson_2d;
    std::string csv = "seed,axial_strain,axial_stress_pa,gauge_axial_strain,gauge_lateral_strain\n";
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
            csv += fmt::format("{},{},{},{},{}\n", r.lab.seed + k, p.axial_strain, p.axial_stress,
                               p.gauge_axial, p.gauge_lateral);
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
    write_text(r.output / "curves.csv", csv);
}

void report_biaxial(LaboratoryReport& r, const std::vector<double>& confining) {
    assert(!confining.empty() && std::ranges::is_sorted(confining));
    const auto samples = r.lab.make_samples(r.rock.material);
    describe_samples(r, samples);
    const auto curves = r.lab.biaxial(r.rock, samples, confining);
    std::string csv = "confining_pa,seed,axial_strain,axial_stress_pa,lateral_strain,"
                      "lateral_stress_pa,broken_bonds\n";
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
                csv += fmt::format("{},{},{},{},{},{},{}\n", confining[c], r.lab.seed + k,
                                   p.axial_strain, p.axial_stress, p.lateral_strain,
                                   p.lateral_stress, p.broken);
        }
        const Spread s = spread(peaks);
        means.push_back(s.mean);
        const double byerlee = fem::byerlee_axial(confining[c]);
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
    std::optional<EnvelopeFit> fit;
    if (confining.size() > 1) {
        fit = fit_samples(confining, means, by_seed);
        report_fit(r, *fit);
    }
    write_text(r.output / "curves.csv", csv);
    write_text(r.output / "envelopes.csv", envelopes_csv(confining.back(), fit));
}

void report_shear_box(LaboratoryReport& r, const ShearBoxFilling& filling, const std::string& vice,
                      const std::vector<double>& normal) {
    assert(!normal.empty() && std::ranges::is_sorted(normal));
    std::cout << fmt::format("zone {}, vice {}, {:.0f} m x {:.0f} m\n", filling.zone.name, vice,
                             r.lab.sample.width, r.lab.sample.height);
    const auto samples = r.lab.make_samples(filling.vice.value_or(filling.zone).material);
    describe_samples(r, samples);
    const auto tests = r.lab.shear_box(filling, samples, normal);
    const double zone_width = ShearBoxParameters{}.zone_width;
    Json points = Json::array();
    std::cout << fmt::format("{:>13} {:>14} {:>6} {:>11} {:>6} {:>13} {:>9} {:>12}\n",
                             "normal (MPa)", "mu 0.1 to 0.3", "sd", "0.3 to 0.5", "peak",
                             "collapse (m)", "in zone", "vice broken");
    double least = 1e300, most = 0.0;
    for (std::size_t n = 0; n < normal.size(); ++n) {
        const ShearSpreads spreads(tests[n], zone_width);
        least = std::min(least, spread(spreads.mean).mean);
        most = std::max(most, spread(spreads.mean).mean);
        std::cout << spreads.text(normal[n]);
        points.push_back(spreads.json(normal[n]));
    }
    r.summary["zone"] = filling.zone.name;
    r.summary["vice"] = vice;
    r.summary["zone_width_m"] = zone_width;
    r.summary["points"] = points;
    if (normal.size() > 1 && least > 0.0) {
        r.summary["largest_over_smallest"] = most / least;
        std::cout << fmt::format("largest over smallest: {:.2f}\n", most / least);
    }
    write_text(r.output / "curves.csv", shear_curves_csv(tests, normal, r.lab.seed));
    write_text(r.output / "profiles.csv", shear_profiles_csv(tests, normal, r.lab.seed));
}

} // namespace listric
