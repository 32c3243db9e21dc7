#include "apps/scene/toml/pieces.hpp"

#include "apps/scene/parameters/sediment_pores.hpp"

#include <algorithm>
#include <iterator>

namespace listric {

const std::vector<Parameter>& segment_parameters(dem::DetachmentSegment::Kind kind) {
    using Segment = dem::DetachmentSegment;
    static const Parameter start_dip{
        "start_dip_deg",
        at<&Segment::start_dip>,
        "deg",
        ranges::dip,
        "",
        "dip at the near end, where the chain has a kink; 0 is flat, 90 straight down",
        "Makes a kink, above which rock breaks; without it the piece continues the one before."};
    static const std::vector<Parameter> line{
        {"length_m", at<&Segment::length>, "m", ranges::length, "", "length of the line",
         "Raising it makes a flat or ramp longer; the last one must reach beyond the moving wall."},
        start_dip};
    static const std::vector<Parameter> arc{
        {"radius_m", at<&Segment::radius>, "m", between(1e-3, 1e9), "", "radius of the arc",
         "Raising it lowers the rotation of the rock that slides along it: extension over radius.",
         between(300, 30e3)},
        {"end_dip_deg", at<&Segment::end_dip>, "deg", ranges::dip, "",
         "dip at the far end; 0 is flat, 90 straight down",
         "Ends the arc; above 0 the chain goes on as a ramp."},
        start_dip};
    return kind == Segment::Kind::line ? line : arc;
}

const std::vector<Parameter>& pore_parameters() {
    using S = SedimentPores;
    static const std::vector<Parameter> parameters = [] {
        std::vector<Parameter> all{surface_porosity_parameter<&S::surface_porosity>(),
                                   porosity_decay_parameter<&S::coefficient>()};
        std::ranges::copy(permeability_parameters<&S::permeability>(), std::back_inserter(all));
        return all;
    }();
    return parameters;
}

const std::vector<Parameter>& picked_line_parameters() {
    using L = PickedLine;
    static const std::vector<Parameter> parameters{
        {"name", at<&L::name>, "", ranges::any, "", "name of the line"},
        {"age_a", at<&L::age>, "a", between(0, 1e10), "", "age before the end of extension"},
        {"x_m", at<&L::x>, "m", between(-1e7, 1e7), "", "x of its points"},
        {"depth_m", at<&L::depth>, "m", between(-1e6, 1e6), "", "depth of its points"},
    };
    return parameters;
}

const std::vector<Parameter>& layer_parameters() {
    using fem::Layer;
    static const std::vector<Parameter> parameters{
        {"top_depth_m", at<&Layer::top_depth>, "m", between(0, 1e6), "", "depth of its top",
         "Moves the top of the layer; the first begins at 0."},
        {"young_modulus_pa", at<&Layer::young_modulus>, "Pa", between(1e6, 1e13), "E",
         "Young's modulus of the layer",
         "Raising it stiffens the plate as far as the layer is above Te."},
        {"poisson_ratio", at<&Layer::poisson_ratio>, "", ranges::poisson_ratio, "nu",
         "Poisson's ratio of the layer", "Raising it stiffens the layer slightly."},
        {"density_kg_per_m3", at<&Layer::density>, "kg/m3", ranges::density, "",
         "density for pictures; crust_density_kg_per_m3 is the one that carries",
         "Changes pictures only."},
        {"viscosity_pa_s", at<&Layer::viscosity>, "Pa s", between(1e16, 1e30), "eta",
         "viscosity with which shear stress relaxes, beyond skin_thickness_m from the detachment; "
         "none: the layer is elastic",
         "Lowering it lets the layer shed its stress sooner: it takes viscosity over shear "
         "modulus.",
         between(1e19, 1e25)},
    };
    return parameters;
}

} // namespace listric
