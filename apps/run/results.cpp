#include "apps/run/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace listric {

using namespace measures;

namespace {

std::string km(double metres) { return fmt::format("{:.1f} km", metres / 1e3); }

/// "head block turned by 38.1 degrees; cutoff at x = 9.3 km, 3.2 km deep"
std::string head_block(const Measures& m) {
    std::vector<std::string> parts;
    if (m.rollover_tilt)
        parts.push_back(fmt::format("tilt of the head block {:.1f} degrees", *m.rollover_tilt));
    if (m.cutoff)
        parts.push_back(fmt::format("cutoff at x = {}, {} deep", km(m.cutoff->x), km(m.cutoff->y)));
    return fmt::format("{}", fmt::join(parts, "; "));
}

std::string basin(const Results& r) {
    std::string line = fmt::format("basin {:.1f} km2", r.measures.basin_area / 1e6);
    if (r.basin_depth)
        line += fmt::format(", {} deep", km(*r.basin_depth));
    if (r.measures.area_balance)
        line += fmt::format("; area balance {:.2f}", *r.measures.area_balance);
    return line;
}

std::string depocentres_of(const std::vector<Depocentre>& all) {
    if (all.empty())
        return "no depocentre";
    std::vector<std::string> parts;
    for (const Depocentre& one : all)
        parts.push_back(fmt::format("{} of sediment at x = {}", km(one.thickness), km(one.x)));
    return fmt::format("{} depocentre{}: {}", all.size(), all.size() == 1 ? "" : "s",
                       fmt::join(parts, ", "));
}

std::string main_fault(const char* name, const Fault& fault) {
    const auto& line = fault.trace.points;
    std::string text =
        fmt::format("{} at x = {}, dip {:.0f} degrees", name, km(line.front().x), fault.dip);
    if (const auto thrown = pre_rift_throw_of(fault.cutoffs))
        text += fmt::format(", throw {}", km(*thrown));
    return text;
}

/// "; 12 % of what is weakened is of no fault", from a hundredth on
std::string off_faults(const FaultReport& report) {
    const double share = report.weak_off_fault_fraction.value_or(0.0);
    return share < 0.01
               ? ""
               : fmt::format("; {:.0f} % of what is weakened is of no fault", 100.0 * share);
}

/// The main faults, or why there is none.
std::string main_faults(const FaultReport& report) {
    std::vector<std::string> parts;
    if (report.main_antithetic)
        parts.push_back(main_fault("antithetic", report.faults[*report.main_antithetic]));
    if (report.main_synthetic)
        parts.push_back(main_fault("synthetic", report.faults[*report.main_synthetic]));
    if (!parts.empty())
        return fmt::format("main faults: {}", fmt::join(parts, "; "));
    return report.faults.empty()
               ? "no fault is traced in the last window"
               : fmt::format("{} faults are traced, but none is a main one: normal and steeper "
                             "than {:g} degrees",
                             report.faults.size(), least_main_dip);
}

} // namespace

std::vector<std::string> result_lines(const Results& r) {
    std::vector<std::string> lines{head_block(r.measures), basin(r)};
    if (r.measures.depocentres)
        lines.push_back(depocentres_of(*r.measures.depocentres));
    lines.push_back(main_faults(r.faults) + off_faults(r.faults));
    std::ranges::copy(archive::verdict_lines(r.quality), std::back_inserter(lines));
    std::erase(lines, "");
    return lines;
}

} // namespace listric
