#include "apps/model/effects/base_motion/measures.hpp"

#include "apps/model/effects/base_motion/ground.hpp"
#include "apps/model/effects/base_motion/trishear.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/units.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace listric::effects::base_motion {

namespace {

constexpr double degrees = 180.0 / dem::pi;

/// A number of a slipped fault; none where no fault cuts the base, and no number where there is
/// none yet: a column of history.csv is there from the first row on.
template <class Number> std::optional<double> of_fault(const Observation& now, Number number) {
    const auto fault = slipped_fault(now.parts.base, now.state.clock.extension.m);
    const auto* record = dem::find<const GroundRecord>(now.events);
    if (!fault || !record)
        return std::nullopt;
    const std::optional<double> value = number(*fault, *record);
    return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/// Dip of the straight line from the basement's fault to where the surface broke, or breaks now.
double path_dip(const SlippedFault& fault, double x) {
    return dem::arc_tangent(fault.height, fault.foot.x - x) * degrees;
}

std::optional<double> of_trishear(const Observation& now,
                                  double (*number)(const TrishearFit&, const SlippedFault&)) {
    return of_fault(now, [&](const SlippedFault& fault, const GroundRecord&) {
        const auto fit = fit_trishear(marker_tops(now.state, fault), fault);
        return fit ? std::optional(number(*fit, fault)) : std::nullopt;
    });
}

std::vector<Measure<Observation>> measures_of_offset() {
    using Fault = const SlippedFault&;
    using Record = const GroundRecord&;
    return {
        {"basement_fault_slip_m", "m", "slip of the basement fault",
         "slip of the basement fault; below 0 where the block on its right has moved up",
         [](const Observation& now) {
             return of_fault(now, [](Fault f, Record) { return std::optional(f.slip); });
         }},
        {"surface_offset_share", "1", "share of the slip on a step at the surface",
         "share of the last tenth of a mean diameter of slip on one step at the top of the "
         "rock: the greatest difference of mean displacements, over three diameters each and five "
         "apart",
         [](const Observation& now) {
             return of_fault(now, [](Fault, Record r) { return r.share(); });
         }},
        {"surface_offset_x_m", "m", "step at the surface, x", "x of that step",
         [](const Observation& now) {
             return of_fault(now, [](Fault, Record r) { return r.x(); });
         }},
        {"breakthrough_slip_m", "m", "slip at breakthrough",
         "slip of the basement at which the fault broke the surface: two windows of a tenth of a "
         "mean diameter in succession have half of their slip on one step there",
         [](const Observation& now) {
             return of_fault(now, [](Fault, Record r) {
                 const auto at = r.breakthrough();
                 return at ? std::optional(at->size) : std::nullopt;
             });
         }},
        {"breakthrough_throw_ratio", "1", "throw at breakthrough over thickness",
         "throw of the basement at breakthrough over the thickness of its cover",
         [](const Observation& now) {
             return of_fault(now, [](Fault f, Record r) {
                 const auto at = r.breakthrough();
                 return at ? std::optional(at->size * dem::sine(f.dip) / f.height) : std::nullopt;
             });
         }},
        {"fault_path_dip_deg", "deg", "dip from the basement's fault to the surface's",
         "dip of the straight line from the basement's fault at the base of the cover to where the "
         "surface broke: above the basement's dip the fault steepens upward, below it flattens",
         [](const Observation& now) {
             return of_fault(now, [](Fault f, Record r) {
                 const auto at = r.breakthrough();
                 return at ? std::optional(path_dip(f, at->x)) : std::nullopt;
             });
         }},
    };
}

std::vector<Measure<Observation>> measures_of_fold() {
    return {
        {"monocline_width_m", "m", "width of the monocline",
         "way along the top of the rock from a tenth to nine tenths of the basement's throw",
         [](const Observation& now) {
             return of_fault(now, [&](const SlippedFault& f, const GroundRecord&) {
                 return f.slip != 0.0 ? measure_monocline(now.state, f).width : std::nullopt;
             });
         }},
        {"monocline_slope_deg", "deg", "greatest slope of the monocline",
         "greatest slope of the top of the rock over five mean diameters, by its vertical "
         "displacement",
         [](const Observation& now) {
             return of_fault(now, [&](const SlippedFault& f, const GroundRecord&) {
                 return std::optional(measure_monocline(now.state, f).slope);
             });
         }},
        {"trishear_apical_angle_deg", "deg", "trishear: apical angle",
         "trishear of the basement's fault and slip that comes closest to the tops of four marker "
         "horizons, at a fifth to four fifths of the cover, its tip beginning at the base of the "
         "cover: angle of its triangle",
         [](const Observation& now) {
             return of_trishear(now, [](const TrishearFit& fit, const SlippedFault&) {
                 return fit.apical_angle * degrees;
             });
         }},
        {"trishear_propagation_ratio", "1", "trishear: propagation over slip",
         "way of that trishear's tip up the fault over slip (P/S)",
         [](const Observation& now) {
             return of_trishear(
                 now, [](const TrishearFit& fit, const SlippedFault&) { return fit.propagation; });
         }},
        {"trishear_tip_z_m", "m", "trishear: depth of the tip",
         "depth of that trishear's tip below the ground at the start; below 0 above it",
         [](const Observation& now) {
             return of_trishear(now, [](const TrishearFit& fit, const SlippedFault& fault) {
                 return -fit.tip_of(fault).y;
             });
         }},
        {"trishear_misfit_m", "m", "trishear: misfit",
         "root mean square of vertical distances between those tops and that trishear",
         [](const Observation& now) {
             return of_trishear(
                 now, [](const TrishearFit& fit, const SlippedFault&) { return fit.misfit; });
         }},
    };
}

} // namespace

std::vector<Measure<Observation>> measures_of_fault() {
    std::vector<Measure<Observation>> all = measures_of_offset();
    const std::vector<Measure<Observation>> folds = measures_of_fold();
    all.insert(all.end(), folds.begin(), folds.end());
    return all;
}

} // namespace listric::effects::base_motion
