#include "apps/scene/pieces.hpp"

#include "apps/scene/sediment_pores.hpp"

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
    using coupling::Permeability;
    static const std::vector<Parameter> parameters{
        {"surface_porosity", at<&S::surface_porosity>, "", between(0, 0.9), "Phi_ini",
         "porosity of fresh sediment",
         "Raising it makes fresh sediment lighter, and lets it compact more."},
        {"coefficient_per_km",
         at<&S::coefficient>,
         "1/km",
         between(0, 10),
         "c",
         "decay of porosity with depth",
         "Raising it compacts sediment more, so that the basin takes more of it.",
         {},
         1e3},
        {"permeability_m2",
         at<&S::permeability, &Permeability::at_fifth>,
         "m2",
         {.from = 1e-22, .to = 1e-12, .reason = "1e-18 is mud, 1e-15 silt; 1 darcy is 1e-12"},
         "",
         "permeability at a porosity of 0.2; of law mudstone not used",
         "Lowering it keeps water in the pores: pressure rises, sediment stays porous and light.",
         between(1e-20, 1e-13)},
        {"permeability_law",
         one_of<&S::permeability, &Permeability::law>({"kozeny_carman", "constant", "mudstone"}),
         "", ranges::any, "", "how permeability falls with porosity",
         "\"constant\" lets fresh mud drain too slowly: pressure is greatest near the ground."},
        {"clay_fraction", at<&S::permeability, &Permeability::clay_fraction>, "",
         between(0.12, 0.97), "", "clay of law mudstone: mass below 2 micrometres, over all",
         "Raising it lowers permeability by some orders of magnitude."},
    };
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
    };
    return parameters;
}

} // namespace listric
