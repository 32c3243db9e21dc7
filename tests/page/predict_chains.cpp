// Geometry and kinematics of detachments: a JSON list of {start_dip, pieces, length, extension,
// angle} on standard input, an answer for each on standard output.
// tests/regression/draw_test.py compares the drawing page with them.

#include "apps/measures/basin/kinematics.hpp"
#include "dem/genesis/detachment.hpp"
#include "dem/genesis/genesis.hpp"

#include <nlohmann/json.hpp>

#include <iostream>

namespace {

using namespace listric;
using nlohmann::json;

dem::DetachmentParameters detachment_of(const json& given) {
    dem::DetachmentParameters detachment;
    detachment.start_dip = given.at("start_dip");
    for (const json& piece : given.at("pieces")) {
        const auto kink = piece.contains("start_dip") ? std::optional<double>(piece.at("start_dip"))
                                                      : std::nullopt;
        detachment.segments.push_back(
            piece.contains("radius")
                ? dem::arc_to_dip(piece.at("end_dip"), piece.at("radius"), kink)
                : dem::straight(piece.at("length"), kink));
    }
    return detachment;
}

json point(dem::Point p) { return {p.x, p.y}; }

json every(const std::vector<dem::Point>& points, std::size_t step) {
    json list = json::array();
    for (std::size_t k = 0; k < points.size(); k += step)
        list.push_back(point(points[k]));
    return list;
}

json answer(const json& given) {
    const dem::DetachmentParameters detachment = detachment_of(given);
    const double length = given.at("length"), extension = given.at("extension");
    const dem::Chain chain = dem::detachment_chain(detachment, 3.0 * length);
    const double end = dem::length_of(chain), right = length + extension;
    json points = json::array();
    for (int k = 0; k <= 20; ++k)
        points.push_back(point(dem::point_at(chain, end * k / 20.0)));
    const auto shear = measures::inclined_shear_top(chain, extension, given.at("angle"), right);
    const auto normals = measures::normals_top(chain, extension, right);
    return {{"depth", -chain.back().end.y},
            {"points", points},
            {"area", dem::hanging_wall_area({.length = length}, chain)},
            {"tilt", measures::normals_tilt(chain, extension)},
            {"turns", measures::head_block_turns(chain, extension)},
            {"cutoff", point(dem::point_at(chain, extension))},
            {"shear", every(shear, 50)},
            {"shear_points", shear.size()},
            {"normals", every(normals, 50)},
            {"normals_points", normals.size()}};
}

} // namespace

int main() {
    const json given = json::parse(std::cin);
    json answers = json::array();
    for (const json& one : given)
        answers.push_back(answer(one));
    std::cout << answers << '\n';
}
