#include "apps/figures/window_strain.hpp"

#include "dem/columns.hpp"
#include "dem/events/strain.hpp"

#include <cstddef>
#include <limits>
#include <utility>

namespace listric {

namespace {

using Values = std::optional<std::vector<double>>;

/// Sediment that has been there for a window has moved, if ever so little.
/// @param moved  0 where it has not
void forget_young(const Observation& now, const std::vector<double>& moved,
                  std::vector<double>& values) {
    const dem::ConstDiscColumns d = dem::disc_columns(now.state);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (d.stratum[i] > 0 && moved[i] == 0.0)
            values[i] = std::numeric_limits<double>::quiet_NaN();
}

/// A column, or none where there is none.
Values column(const Observation& now, std::string_view name) {
    if (!now.state.discs.has(name))
        return std::nullopt;
    const auto values = now.state.discs.get<double>(name);
    return std::vector<double>(values.begin(), values.end());
}

bool has_ended_a_window(const Observation& now) {
    const auto* const strain = dem::find<dem::Strain>(now.events);
    return strain && strain->applied > 0;
}

std::vector<double> with_zeros(const Observation& now) {
    return has_ended_a_window(now) ? column(now, dem::columns::window_strain).value()
                                   : dem::shear_strain(now.state);
}

/// A column without settling, or where nothing settles the one with all of the strain.
Values tectonic_column(const Observation& now, std::string_view name, std::string_view all) {
    return column(now, now.state.discs.has(name) || !settling_of(now.scene).empty() ? name : all);
}

} // namespace

std::vector<double> window_strain(const Observation& now) {
    std::vector<double> values = with_zeros(now);
    forget_young(now, std::vector<double>(values), values);
    return values;
}

std::vector<double> total_strain(const Observation& now) {
    return column(now, dem::columns::total_strain).value_or(window_strain(now));
}

Values window_tectonic_strain(const Observation& now) {
    Values values = has_ended_a_window(now)
                        ? tectonic_column(now, dem::columns::window_tectonic_strain,
                                          dem::columns::window_strain)
                        : dem::tectonic_strain(now.state);
    if (values)
        forget_young(now, with_zeros(now), *values);
    return values;
}

std::map<std::string, std::vector<double>> strains_of(const Observation& now) {
    std::map<std::string, std::vector<double>> strains{{"window_strain", window_strain(now)}};
    if (auto total = column(now, dem::columns::total_strain))
        strains["total_strain"] = std::move(*total);
    if (settling_of(now.scene).empty())
        return strains;
    if (auto window = window_tectonic_strain(now))
        strains["window_tectonic_strain"] = std::move(*window);
    if (auto total = column(now, dem::columns::total_tectonic_strain))
        strains["total_tectonic_strain"] = std::move(*total);
    return strains;
}

std::string strain_remark(const Observation& now, bool is_tectonic) {
    const std::string settling = settling_of(now.scene);
    return settling.empty() ? "" : (is_tectonic ? " without " : " with ") + settling;
}

} // namespace listric
