#pragma once

#include "dem/event.hpp"
#include "fem/footwall.hpp"

#include <span>
#include <vector>

namespace listric::coupling {

/// Pure shear of the lower crust, below and beyond the detachment: extension that the discs do not
/// have. Its crust stretches from width b to b + e and thins from h to h b / (b + e); mantle rises
/// by the difference, so that isostasy lowers what lies above (Kusznir et al. 1991: flexural
/// cantilever).
struct LowerCrustThinningParameters {
    double thickness = 20e3; ///< h, m
    double width = 100e3;    ///< b, m
    double centre = 15e3;    ///< x of its middle before extension, m
};

/// By how much the lower crust is thinner after an extension, m.
double lower_crust_thinning(const LowerCrustThinningParameters& parameters, double extension);

/// The load of the mantle that has risen, downward at the base: thinning times `contrast`, the
/// density contrast of mantle and crust times gravity, Pa/m. Its left end stays with the footwall,
/// its right end goes with the extension, so that its sum, contrast * h * e, is that of the area
/// that was drawn out.
fem::Load lower_crust_load(const LowerCrustThinningParameters& parameters, double contrast,
                           double extension);

/// What the load does, at extensions from 0 to `distance` in equal steps: rows of numbers, to be
/// interpolated in between.
struct LowerCrustResponse {
    double distance = 0.0;         ///< m
    std::size_t steps = 0;         ///< rows less 1
    std::vector<double> interface; ///< displacement of the interface's unknowns, m
    std::vector<double> uplift;    ///< of the knots of a SurfaceResponse, m; empty without one

    static std::vector<double> at(std::span<const double> rows, std::size_t steps, double share);
};

/// Loads of the extensions of a response's rows.
std::vector<fem::Load> lower_crust_loads(const LowerCrustThinningParameters& parameters,
                                         double contrast, double distance, std::size_t steps);

/// Puts the load of the present extension on the footwall.
class LowerCrustThinning : public dem::Event {
public:
    /// @param forces  equivalent to the response's interface displacements, by rows, N
    LowerCrustThinning(const LowerCrustResponse& response, std::vector<double> forces,
                       double extension_rate);

    void begin(dem::State& state) override;
    bool apply(dem::State& state, const dem::RigidBase& base) override;

private:
    double distance_;
    std::size_t steps_;
    std::vector<double> forces_;
};

} // namespace listric::coupling
