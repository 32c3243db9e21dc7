#include "apps/scene/pieces.hpp"

namespace listric {

const std::vector<Parameter>& segment_parameters(dem::DetachmentSegment::Kind kind) {
    using Segment = dem::DetachmentSegment;
    static const Parameter start_dip{
        "start_dip_deg",
        at<&Segment::start_dip>,
        "deg",
        ranges::dip,
        "",
        "dip at the near end, where the chain has a kink; 0 is flat, 90 straight down"};
    static const std::vector<Parameter> line{
        {"length_m", at<&Segment::length>, "m", ranges::length, "", "length of the line"},
        start_dip};
    static const std::vector<Parameter> arc{
        {"radius_m", at<&Segment::radius>, "m", {.from = 1e-3, .to = 1e9}, "", "radius of the arc"},
        {"end_dip_deg", at<&Segment::end_dip>, "deg", ranges::dip, "",
         "dip at the far end; 0 is flat, 90 straight down"},
        start_dip};
    return kind == Segment::Kind::line ? line : arc;
}

const std::vector<Parameter>& picked_line_parameters() {
    using L = PickedLine;
    static const std::vector<Parameter> parameters{
        {"name", at<&L::name>, "", {}, "", "what it is called"},
        {"age_a", at<&L::age>, "a", {.from = 0, .to = 1e10}, "", "before the end of extension"},
        {"x_m", at<&L::x>, "m", {.from = -1e7, .to = 1e7}, "", "of its points"},
        {"depth_m", at<&L::depth>, "m", {.from = -1e6, .to = 1e6}, "", "of its points"},
    };
    return parameters;
}

const std::vector<Parameter>& layer_parameters() {
    using fem::Layer;
    static const std::vector<Parameter> parameters{
        {"top_depth_m", at<&Layer::top_depth>, "m", {.from = 0, .to = 1e6}, "", "where it begins"},
        {"young_modulus_pa",
         at<&Layer::young_modulus>,
         "Pa",
         {.from = 1e6, .to = 1e13},
         "E",
         "Young's modulus"},
        {"poisson_ratio",
         at<&Layer::poisson_ratio>,
         "",
         {.from = 0, .below = 0.5},
         "nu",
         "Poisson's ratio"},
        {"density_kg_per_m3", at<&Layer::density>, "kg/m3", ranges::density, "",
         "for pictures; what carries is crust_density_kg_per_m3"},
    };
    return parameters;
}

} // namespace listric
