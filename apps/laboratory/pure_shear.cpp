#include "apps/laboratory/pure_shear.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/run_folder.hpp"
#include "apps/archive/snapshot/snapshot.hpp"
#include "apps/measures/dictionary.hpp"
#include "apps/model/measure_names.hpp"
#include "apps/scene/scene_file.hpp"
#include "apps/scene/toml/toml.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace listric {

using namespace archive;
using namespace dem;
using namespace measures;

namespace {

/// The scene's parameters that the test is about.
constexpr std::string_view weakening_rate = "fault_weakening.strain_rate_per_s";
constexpr std::string_view healing_rate = "bond_healing.strain_rate_per_s";

std::string table_of(std::string_view parameter) {
    return std::string(parameter.substr(0, parameter.find('.')));
}

using Pair = std::pair<std::int64_t, std::int64_t>; ///< ids of two discs, the smaller first

/// Calls visit(ids, row of the contact) for every pair that touches.
template <class Visit> void for_each_touching(const State& state, Visit&& visit) {
    const ConstDiscColumns d = disc_columns(state);
    const ConstContactColumns c = contact_columns(state);
    const std::vector<bool> touches = touching(state);
    for (std::size_t k = 0; k < touches.size(); ++k)
        if (touches[k])
            visit(Pair(std::minmax(d.id[static_cast<std::size_t>(c.first[k])],
                                   d.id[static_cast<std::size_t>(c.second[k])])),
                  k);
}

} // namespace

std::vector<std::string> assignments(const CriticalRates& rates) {
    return {fmt::format("{}={}", weakening_rate, rates.weakening),
            fmt::format("{}={}", healing_rate, rates.healing)};
}

CriticalRates critical_rates(const Scene& scene) {
    const toml::table document = toml::parse(to_toml(scene));
    const auto number = [&](std::string_view parameter) {
        const auto value = document.at_path(parameter).value<double>();
        assert(value);
        return *value;
    };
    return {number(weakening_rate), number(healing_rate)};
}

bool StretchedSlab::conjugate() const {
    return std::ranges::any_of(faults, &SlabFault::falls_right) &&
           !std::ranges::all_of(faults, &SlabFault::falls_right);
}

std::optional<double> healed_share(const State& start, const State& end) {
    std::vector<Pair> before;
    for_each_touching(start, [&](Pair ids, std::size_t) { before.push_back(ids); });
    std::ranges::sort(before);
    const ConstDiscColumns d = disc_columns(end);
    const ConstContactColumns c = contact_columns(end);
    const auto bondable = [&](std::int32_t row) {
        return end.materials[d.material[static_cast<std::size_t>(row)]].bondable;
    };
    double all = 0.0, healed = 0.0;
    for_each_touching(end, [&](Pair ids, std::size_t k) {
        if (std::ranges::binary_search(before, ids) || !bondable(c.first[k]) ||
            !bondable(c.second[k]))
            return;
        all += 1.0;
        healed += c.bonded[k];
    });
    return all > 0.0 ? std::optional(healed / all) : std::nullopt;
}

std::vector<SlabFault> trace_births(const std::vector<DiscPlaces>& states, const Chain& base) {
    FaultTraceOptions options;
    options.least_contrast = 2.0;
    std::vector<SlabFault> born;
    std::vector<FaultTrace> known;
    for (std::size_t k = 0; k + 1 < states.size(); ++k) {
        const ShearField field = shear_field(states[k], states[k + 1], {});
        const double reach = 5.0 * field.diameter;
        const std::size_t older = known.size();
        for (FaultTrace& trace : trace_faults(field, base, options)) {
            const auto followed = std::ranges::count_if(trace.points, [&](Point p) {
                return std::any_of(known.begin(),
                                   known.begin() + static_cast<std::ptrdiff_t>(older),
                                   [&](const FaultTrace& before) {
                                       return std::abs(place_on(before.points, p).distance) < reach;
                                   });
            });
            const bool falls_right = trace.points.back().x > trace.points.front().x;
            const double slip = std::accumulate(trace.slip.begin(), trace.slip.end(), 0.0);
            const bool normal = (slip > 0.0) == falls_right;
            if (normal && 2 * followed < std::ssize(trace.points))
                born.push_back(
                    {dip_of(trace.points), trace.length(), falls_right, states[k + 1].extension.m});
            known.push_back(std::move(trace));
        }
    }
    return born;
}

StretchedSlab stretch_slab(const Scene& scene, RunOptions options) {
    options.resume = true; // a sweep that was stopped goes on; finished runs are not made again
    options.quiet = true;
    options.report = false;
    if (run_scene(scene, options) != RunOutcome::finished)
        throw Interrupted{};
    const JsonObject summary = read_object(options.output / "summary.json");
    const auto number = [&](const std::string& name) {
        return number_at(summary, name.c_str()).value_or(0.0);
    };
    StretchedSlab slab;
    slab.strain_top10 = number(measures::name_of<&measures::Measures::strain_top10>());
    slab.strain_top10_cumulative =
        number(measures::name_of<&measures::Measures::strain_top10_cumulative>());
    slab.weak_fraction = number(effects::weak_fraction);
    slab.unbalanced_ratio = number(measures::name_of<&measures::Measures::unbalanced_ratio_mean>());
    const auto snapshots = run_moments(options.output).snapshots;
    std::vector<DiscPlaces> states;
    for (const auto& path : snapshots)
        states.emplace_back(read_snapshot(path).state);
    slab.faults = trace_births(states, make_rigid_base(scene).surfaces.front().chain);
    Snapshot end = read_snapshot(snapshots.back());
    slab.healed_share = healed_share(read_snapshot(snapshots.front()).state, end.state).value_or(0);
    for (double angle : end.event_memory.at(table_of(weakening_rate)).get<double>("angle_rad"))
        slab.segment_dips.push_back(std::min(angle, pi - angle) * 180.0 / pi);
    return slab;
}

std::optional<double> mean_dip(const std::vector<SlabFault>& faults) {
    double sum = 0.0, length = 0.0;
    for (const SlabFault& f : faults) {
        sum += f.dip_at_birth * f.length;
        length += f.length;
    }
    return length > 0.0 ? std::optional(sum / length) : std::nullopt;
}

double anderson_dip(double friction) {
    return 45.0 + 0.5 * dem::arc_tangent(friction) * 180.0 / pi;
}

} // namespace listric
