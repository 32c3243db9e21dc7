#include "apps/studies/dataset/dataset_card.hpp"

#include "apps/support/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace listric {

namespace {

using Json = nlohmann::ordered_json;

struct ArrayDoc {
    const char *name, *type, *doc;
};

constexpr ArrayDoc array_docs[] = {
    {"image", "float32", "amplitude with noise; the reflections alone have an rms of 1"},
    {"fault", "uint8",
     "0 no fault, 1 a fault that slipped in the run's last window, 2 one that slipped before, 3 "
     "the detachment, 4 doubtful: rock is offset, and less than a certain fault's"},
    {"fault_throw", "float32",
     "vertical offset of rock at samples of labels 1, 2 and 4, m; above 0: normal"},
    {"layer", "int16",
     "number of the layer: above 0 strata, the oldest 1; 0 and below pre-rift, by depth at the "
     "start; -32768 footwall. Horizons are where it changes down a trace"},
    {"strain", "float32", "total shear strain; NaN outside rock"},
    {"reflectivity", "float32", "sum of reflection coefficients in a sample"},
};

/// Values of the parameter that are in a split, each once.
std::string values_in(const DatasetPlan& plan, std::string_view split) {
    std::string text;
    for (const SweepValue& value : plan.sweep.parameters[plan.split_parameter].values) {
        SweepPoint point(plan.split_parameter + 1);
        point.back() = value;
        if (plan.split_of(point) == split)
            text += (text.empty() ? "" : ", ") + value.text;
    }
    return text;
}

std::string drawn_text(const Drawn& ends) { return fmt::format("{:g} to {:g}", ends[0], ends[1]); }

std::string tables_of(const DatasetPlan& plan, std::span<const SplitCount> splits) {
    std::string text = fmt::format(
        "| split | sections | faults | MB | {} |\n|---|---|---|---|---|\n", plan.settings.split_by);
    for (const SplitCount& split : splits)
        text += fmt::format("| {} | {} | {} | {:.1f} | {} |\n", split.name, split.sections,
                            split.faults, static_cast<double>(split.bytes) / 1e6,
                            values_in(plan, split.name));
    text += "\n| array | type | content |\n|---|---|---|\n";
    for (const ArrayDoc& array : array_docs)
        text += fmt::format("| `{}` | {} | {} |\n", array.name, array.type, array.doc);
    text += "\n| varied between runs | values |\n|---|---|\n";
    for (const SweepParameter& parameter : plan.sweep.parameters) {
        std::string values;
        for (const SweepValue& value : parameter.values)
            values += (values.empty() ? "" : ", ") + value.text;
        if (parameter.range)
            values = fmt::format("{:g} to {:g}", parameter.range->first, parameter.range->second);
        text += fmt::format("| `{}` | {} |\n", parameter.name, values);
    }
    const DatasetSettings& s = plan.settings;
    text += "\n| drawn for each section | from |\n|---|---|\n";
    text +=
        fmt::format("| peak frequency of Ricker's wavelet, Hz | {} |\n", drawn_text(s.frequency));
    text +=
        fmt::format("| Q of rock, which stretches it with time | {} |\n", drawn_text(s.quality));
    text += fmt::format("| noise over reflections, rms | {} |\n", drawn_text(s.noise));
    text += fmt::format("| width of the lateral point spread, m | {} |\n", drawn_text(s.lateral));
    text += fmt::format("| thickness of pre-rift layers, m | {} |\n", drawn_text(s.layer));
    return text;
}

} // namespace

std::string card_of(const DatasetPlan& plan, std::span<const SplitCount> splits,
                    std::size_t missing) {
    const DatasetSettings& s = plan.settings;
    const std::string interval = s.in_depth ? fmt::format("{:g} m of depth", s.depth_interval)
                                            : fmt::format("{:g} ms", 1e3 * s.sample_interval);
    std::string text = fmt::format(
        "# {}: seismic sections with their faults\n\n"
        "Synthetic, made by `listric dataset {}` (Listric {}) from simulated halfgrabens. Licence: "
        "{}.{}\n\n"
        "A section is a file of `sections`, HDF5 with an array of {} traces of {} samples for each "
        "name, {:g} m and {} apart; attributes say how it was made. `index.csv` has a row for each "
        "run. Splits share no value of `{}`, so that a network is tested on what it has not "
        "seen.{}\n\n",
        plan.sweep.name, plan.sweep.name, version, s.licence,
        s.author.empty() ? "" : " Author: " + s.author + ".", s.traces, s.samples, s.trace_spacing,
        interval, s.split_by,
        missing > 0 ? fmt::format(" {} runs of the plan have no section.", missing) : "");
    text += tables_of(plan, splits);
    text += fmt::format(
        "\n## How labels come about\n\n"
        "The simulation knows the motion of every disc of rock. Faults are lines across which "
        "discs of one stratum have come apart in height within a few diameters, without the tilt "
        "of the blocks. Where their throw is {:g} m or more, over {:g} m of height or more, the "
        "fault is marked, {:g} samples wide; if the median is below {:g} m or the height below "
        "{:g} m, as doubtful. Leave doubtful samples out of a loss.\n\n",
        s.least_throw, s.least_height, s.fault_width, s.certain_throw, s.certain_height);
    text +=
        "## What is wrong with it\n\n"
        "- Two dimensions, one tectonic style: extension over a detachment, no salt, no strike "
        "slip.\n"
        "- Convolution of vertical rays: no diffractions, multiples, migration errors or "
        "acquisition footprint. The noise is random, alike between neighbouring traces.\n"
        "- Velocities follow porosity and a random contrast of each layer: no facies, no fluids, "
        "no lateral change but by weakened rock.\n"
        "- Discs are coarse: a fault is a zone of two to eight discs, in which horizons bend, "
        "where rock has a plane. The line is the middle of the zone, known to about one disc.\n"
        "- Faults that slip less than the limit are in the image and not in the mask. Faults "
        "in young sediment end lower in the mask than in the rock.\n"
        "- Of 91 lines in 21 sections 11 lie where an eye sees no offset; 4 faults that are to be "
        "seen are not marked and 6 only as doubtful.\n"
        "- Bedding-parallel slip in weak layers is no fault here.\n\n"
        "`sha256` in the index is of a section's arrays, in the order above, as little-endian "
        "bytes. The same plan and version give the same.\n";
    return text;
}

Json description_of(const DatasetPlan& plan) {
    const DatasetSettings& s = plan.settings;
    Json json{{"made_by", fmt::format("listric dataset, {}", version)},
              {"name", plan.sweep.name},
              {"licence", s.licence},
              {"author", s.author},
              {"shape", {s.traces, s.samples}},
              {"rows", "traces"},
              {"columns", s.in_depth ? "samples of depth" : "samples of two-way time"},
              {"split_by", s.split_by},
              {"fault_labels", {"none", "active", "resting", "detachment", "doubtful"}}};
    for (const char* split : {"train", "validation", "test"})
        json["splits"][split] = values_in(plan, split);
    for (const ArrayDoc& array : array_docs)
        json["arrays"][array.name] = {{"type", array.type}, {"content", array.doc}};
    return json;
}

} // namespace listric
