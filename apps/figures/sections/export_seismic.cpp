#include "apps/figures/sections/export_seismic.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/figures/sections/segy.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/npy.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace listric {

namespace fs = std::filesystem;

namespace {

/// Lines of at most 76 letters on how the section was made.
std::vector<std::string> words_of(const archive::ExportedMoment& at,
                                  const SeismicSection& section) {
    const SeismicOptions& o = section.options;
    const measures::SeismicLaw& law = o.law;
    return {
        fmt::format("LISTRIC {}: SYNTHETIC SEISMIC SECTION OF A MODEL", version),
        fmt::format("SCENE {}, SEED {}, {} DISCS", at.now.scene.name, at.now.scene.seed,
                    at.now.state.discs.rows()),
        at.now.parts.base.motion.stages.empty()
            ? fmt::format("EXTENSION {:.2f} M", at.now.state.clock.travel.m)
            : fmt::format("EXTENSION {:.2f} M AFTER A WAY OF {:.2f} M",
                          at.now.state.clock.extension.m, at.now.state.clock.travel.m),
        fmt::format("RICKER WAVELET, ZERO PHASE, {:g} HZ", o.frequency),
        o.in_depth
            ? fmt::format("SAMPLES BY DEPTH, {:g} M; HEADERS HAVE MILLIMETRES", o.sample_interval)
            : fmt::format("SAMPLES BY TWO-WAY TIME, {:g} MS", 1e3 * o.sample_interval),
        fmt::format("POINT-SPREAD FUNCTION ALONG X: {:g} M", o.lateral),
        "DATUM, ELEVATION 0: THE ORIGINAL SURFACE, Y = 0; ELEVATIONS POSITIVE UP",
        o.in_depth
            ? fmt::format("FIRST SAMPLE AT A DEPTH OF {:.0f} M (BYTES 109-110); POSITIVE DOWN",
                          section.first_sample)
            : fmt::format("FIRST SAMPLE AT {:.0f} MS (BYTES 109-110) FROM THE DATUM",
                          1e3 * section.first_sample),
        "X FROM THE BREAKAWAY, CM (BYTES 181-184); GROUND, CM (BYTES 41-48)",
        "POSITIVE AMPLITUDE: THE ROCK BELOW IS HARDER",
        "VELOCITY: WYLLIE'S TIME AVERAGE (GEOPHYSICS 21, 41, 1956)",
        fmt::format("MATRIX {:g} M/S, {:g} KG/M3; FLUID {:g} M/S, {:g} KG/M3", law.matrix_velocity,
                    law.grain_density, law.fluid_velocity, law.fluid_density),
        fmt::format("WEAKENED ROCK: VELOCITY TIMES {:g}", law.weak_factor),
        fmt::format("LAYERS BY TURNS FASTER AND SLOWER BY {:g} PERCENT (ASSUMED)",
                    100.0 * law.contrast),
        "CONVOLUTION OF REFLECTIVITY: NO MIGRATION, NO DIFFRACTION, NO MULTIPLES,",
        "NO NOISE, NO ATTENUATION",
    };
}

/// Options in the names of files: those that are not the usual ones.
std::string seismic_suffix(const SeismicOptions& options) {
    const SeismicOptions usual;
    std::string suffix = options.in_depth ? "-depth" : "";
    if (options.frequency != usual.frequency)
        suffix += fmt::format("-{}Hz", text(options.frequency));
    if (options.lateral != usual.lateral)
        suffix += fmt::format("-lateral-{}m", text(options.lateral));
    return suffix;
}

/// SEG-Y counts samples and intervals in 16 bits. Throws UsageError.
void require_room(const SeismicSection& section) {
    const SeismicOptions& o = section.options;
    constexpr auto most = static_cast<std::size_t>(std::numeric_limits<std::int16_t>::max());
    if (section.samples > most)
        throw UsageError(fmt::format("export seismic: {} samples per trace, of which SEG-Y allows "
                                     "{}: lower --frequency {:g}",
                                     section.samples, most, o.frequency));
    // One of 16 bits, of which a depth in millimetres needs more below 2.3 Hz.
    const double interval = (o.in_depth ? 1e3 : 1e6) * o.sample_interval;
    if (interval > static_cast<double>(most))
        throw UsageError(fmt::format("export seismic: samples are too far apart for SEG-Y: raise "
                                     "--frequency {:g}",
                                     o.frequency));
}

template <class T>
void write_rows(const fs::path& file, const std::vector<T>& values, const SeismicSection& section) {
    write_npy<T>(file, std::span<const T>(values), section.samples);
}

} // namespace

std::vector<fs::path> export_seismic(const archive::ExportedMoment& at, const std::string& name,
                                     const fs::path& folder,
                                     const std::vector<std::string>& formats,
                                     SeismicOptions options) {
    const auto wants = [&](const char* format) {
        return std::ranges::find(formats, format) != formats.end();
    };
    options.has_labels = wants("npy");
    const SeismicSection section =
        seismic_section(at.now, at.faults.faults, seismic_horizons(at.now), options);
    const std::string stem = fmt::format("seismic-{}{}", name, seismic_suffix(section.options));
    std::vector<fs::path> files;
    if (wants("segy")) {
        require_room(section);
        files.push_back(folder / (stem + ".segy"));
        write_segy(files.back(), section, words_of(at, section));
    }
    if (!wants("npy"))
        return files;
    const auto file = [&](const char* end) {
        files.push_back(folder / (stem + end));
        return files.back();
    };
    write_rows(file("-image.npy"), section.amplitude, section);
    write_rows(file("-faults.npy"), section.fault, section);
    write_rows(file("-strain.npy"), section.strain, section);
    const SeismicOptions& o = section.options;
    const std::string unit = o.in_depth ? "m" : "s";
    write_object(file(".json"), {{"rows", "traces"},
                                 {"columns", "samples"},
                                 {"first_x_m", section.first_x},
                                 {"trace_spacing_m", o.trace_spacing},
                                 {"sample_interval_" + unit, o.sample_interval},
                                 {"first_sample_" + unit, section.first_sample},
                                 {"depth_reference", archive::depth_reference},
                                 {"highest_rock_m", section.top},
                                 {"frequency_hz", o.frequency},
                                 {"lateral_m", o.lateral},
                                 {"words", words_of(at, section)}});
    return files;
}

} // namespace listric
