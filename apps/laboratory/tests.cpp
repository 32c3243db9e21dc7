#include "apps/laboratory/tests.hpp"

#include "apps/support/machine/memory.hpp"
#include "dem/threads/shared_loop.hpp"

#include <fmt/format.h>

#include <atomic>
#include <utility>

namespace listric {

using namespace dem;

namespace {

constexpr double axial_strain_rate = 2e-5; // per s
constexpr double shear_speed = 0.25;       // m/s

/// Runs work(k), counting for the report.
void for_each_reported(const Laboratory& lab, std::string_view stage, std::size_t count,
                       const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> done = 0;
    lab.report(stage, 0, count);
    const Team team(lab.threads);
    for_each_shared(count, [&](std::size_t k) {
        lab.stop.check();
        work(k);
        lab.report(stage, ++done, count);
    });
}

} // namespace

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
    constexpr double disc_price = 1e3; // bytes, with its contacts and the search's copies
    note_memory_need(disc_price * static_cast<double>(sample.discs) * (seeds + threads));
    std::vector<Specimen> samples(static_cast<std::size_t>(seeds));
    for_each_reported(*this, "samples", samples.size(), [&](std::size_t k) {
        SampleParameters p = sample;
        p.seed = seed + k;
        samples[k] = make_sample(p, material, stop);
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
                        "239, and fewer than 50 are no measure of a rock",
                        discs));
    if (seed < 0)
        throw UsageError(fmt::format("--seed {}: allowed: at least 0", seed));
    if (seeds < 1 || seeds > 1000)
        throw UsageError(fmt::format("--seeds {}: allowed: 1 to 1000", seeds));
}

} // namespace listric
