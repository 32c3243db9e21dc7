#pragma once

#include "coupling/footwall_loads.hpp"
#include "dem/event.hpp"
#include "fem/footwall.hpp"

#include <utility>
#include <vector>

namespace listric::coupling {

/// Names of what the load measures; its description declares them.
inline constexpr const char* lower_crust_thinning_name = "lower_crust_thinning_m";

/// Pure shear of the lower crust, below and beyond the detachment: extension that the discs do not
/// have. Its crust stretches from width b to b + e and thins from h to h b / (b + e); mantle rises
/// by the difference, so that isostasy lowers what lies above (Kusznir et al. 1991: flexural
/// cantilever).
struct LowerCrustThinningParameters {
    double thickness = 20e3; ///< h, m
    double width = 100e3;    ///< b, m
    double centre = 15e3;    ///< x of its middle before extension, m
    double share = 1.0;      ///< of the hanging wall's extension by which it stretches
};

/// By how much the lower crust is thinner after an extension of the hanging wall, m.
double lower_crust_thinning(const LowerCrustThinningParameters& parameters, double extension);

/// The load of the mantle that has risen, downward at the base: thinning times `contrast`, the
/// density contrast of mantle and crust times gravity, Pa/m. Its left end stays with the footwall,
/// its right end goes with the extension, so that its sum, contrast * h * e, is the weight of the
/// area that was drawn out.
fem::Load lower_crust_load(const LowerCrustThinningParameters& parameters, double contrast,
                           double extension);

/// Loads at extensions from `least` to `greatest`, m, in equal steps: small ones, for the load's
/// change with extension, h e / (b + e), to be straight between them to 1e-3. Below 0 the crust is
/// thicker.
std::vector<fem::Load> lower_crust_loads(const LowerCrustThinningParameters& parameters,
                                         double contrast, double greatest, double least = 0.0);

/// Weights of these loads at an extension, which is given as a share of the way from the least to
/// the greatest: two neighbours interpolated.
std::vector<double> lower_crust_amounts(double share);

/// Puts the load of the present extension on the footwall, every 25 m of travel. Memory: the
/// extension whose load acts.
class LowerCrustThinning : public dem::Event {
public:
    /// @param forces    equivalent to lower_crust_loads(), by rows, N
    /// @param greatest  extension of the last of them, m
    /// @param least     of the first, m
    LowerCrustThinning(std::vector<double> forces, double greatest, double least,
                       double extension_rate);

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

    void take_forces(std::vector<double> forces) { forces_ = std::move(forces); }

    /// Extension whose load acts now, m.
    double extension(const dem::State& state) const;

    /// How much of each of lower_crust_loads() acts now.
    std::vector<double> amounts(const dem::State& state) const;

private:
    std::vector<double> forces_;
    double greatest_, least_;
};

/// @param contrast  density contrast of mantle and crust times gravity, Pa/m
/// @param greatest  extension of the run, m
/// @param least     extension of the run, m: below 0 in net shortening
FootwallLoad lower_crust_thinning_load(const LowerCrustThinningParameters& parameters,
                                       double contrast, double greatest, double least,
                                       double extension_rate);

} // namespace listric::coupling
