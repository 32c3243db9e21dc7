#include "apps/figures/sections/export_seismic.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/files/npy.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/spelling.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

namespace listric {

namespace {

/// Bytes in which numbers stand at their places, the most significant byte first. Places begin at
/// 1, as the standard counts.
class Block {
public:
    explicit Block(std::size_t bytes) : text(bytes, '\0') {}

    template <class T> void put(std::size_t place, T value) {
        const auto bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
        for (std::size_t k = 0; k < sizeof(T); ++k)
            text[place - 1 + k] = static_cast<char>(bits >> 8 * (sizeof(T) - 1 - k) & 255u);
    }
    void put16(std::size_t place, double value) {
        put(place, static_cast<std::int16_t>(std::lround(value)));
    }
    void put32(std::size_t place, double value) {
        put(place, static_cast<std::int32_t>(std::lround(value)));
    }

    std::string text;
};

/// A letter in EBCDIC (code page 037); a blank where it has none.
char ebcdic(char letter) {
    static constexpr std::string_view ascii = " .<(+|&!$*);-/,%_>?:#@'=\"abcdefghijklmnopqrstuvwxyz"
                                              "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    static constexpr unsigned char codes[] = {
        0x40, 0x4b, 0x4c, 0x4d, 0x4e, 0x4f, 0x50, 0x5a, 0x5b, 0x5c, 0x5d, 0x5e, 0x60, 0x61, 0x6b,
        0x6c, 0x6d, 0x6e, 0x6f, 0x7a, 0x7b, 0x7c, 0x7d, 0x7e, 0x7f, 0x81, 0x82, 0x83, 0x84, 0x85,
        0x86, 0x87, 0x88, 0x89, 0x91, 0x92, 0x93, 0x94, 0x95, 0x96, 0x97, 0x98, 0x99, 0xa2, 0xa3,
        0xa4, 0xa5, 0xa6, 0xa7, 0xa8, 0xa9, 0xc1, 0xc2, 0xc3, 0xc4, 0xc5, 0xc6, 0xc7, 0xc8, 0xc9,
        0xd1, 0xd2, 0xd3, 0xd4, 0xd5, 0xd6, 0xd7, 0xd8, 0xd9, 0xe2, 0xe3, 0xe4, 0xe5, 0xe6, 0xe7,
        0xe8, 0xe9, 0xf0, 0xf1, 0xf2, 0xf3, 0xf4, 0xf5, 0xf6, 0xf7, 0xf8, 0xf9};
    static_assert(ascii.size() == std::size(codes));
    const auto at = ascii.find(letter);
    return static_cast<char>(at == ascii.npos ? 0x40 : codes[at]);
}

std::string text_header(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t line = 0; line < 40; ++line) {
        std::string card =
            fmt::format("C{:>2} {}", line + 1, line < words.size() ? words[line] : "");
        if (line == 38)
            card = "C39 SEG Y REV1";
        if (line == 39)
            card = "C40 END TEXTUAL HEADER";
        card.resize(80, ' ');
        for (const char letter : card)
            text += ebcdic(letter);
    }
    return text;
}

} // namespace

void write_segy(const std::filesystem::path& file, const SeismicSection& section,
                const std::vector<std::string>& words) {
    const double interval = section.options.in_depth ? 1e3 * section.options.sample_interval
                                                     : 1e6 * section.options.sample_interval;
    const auto samples = static_cast<double>(section.samples);
    // segyio and others add it to the samples; of bytes 215 and 216, its scalar, few know.
    const double delay = (section.options.in_depth ? 1.0 : 1e3) * section.first_sample;
    std::string all = text_header(words);
    Block binary(400);     // places less 3200
    binary.put32(5, 1.0);  // line
    binary.put16(13, 1.0); // traces of an ensemble
    binary.put16(17, interval);
    binary.put16(21, samples);
    binary.put16(25, 5.0);    // IEEE numbers of four bytes
    binary.put16(27, 1.0);    // ensemble fold
    binary.put16(29, 4.0);    // sorted: stacked
    binary.put16(55, 1.0);    // metres
    binary.put16(301, 256.0); // revision 1.0
    binary.put16(303, 1.0);   // all traces are of this length
    all += binary.text;
    for (std::size_t trace = 0; trace < section.traces; ++trace) {
        const auto number = static_cast<double>(trace) + 1.0;
        Block head(240);
        head.put32(1, number);
        head.put32(5, number);
        head.put32(21, number);                        // CDP
        head.put16(29, 1.0);                           // seismic data
        head.put32(41, 100.0 * section.ground[trace]); // elevation of the receivers,
        head.put32(45, 100.0 * section.ground[trace]); // and of the ground at the source
        head.put32(53, 0.0);                           // of the datum at the receivers,
        head.put32(57, 0.0);                           // and at the source
        head.put16(69, -100.0);                        // elevations are in hundredths,
        head.put16(71, -100.0);                        // and coordinates
        head.put32(73, 100.0 * section.x(trace));
        head.put32(81, 100.0 * section.x(trace));
        head.put16(89, 1.0); // lengths
        head.put16(109, delay);
        head.put16(115, samples);
        head.put16(117, interval);
        head.put32(181, 100.0 * section.x(trace)); // of the CDP
        all += head.text;
        Block values(4 * section.samples);
        for (std::size_t k = 0; k < section.samples; ++k)
            values.put(4 * k + 1, std::bit_cast<std::uint32_t>(
                                      section.amplitude[trace * section.samples + k]));
        all += values.text;
    }
    write_text(file, all);
}

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
