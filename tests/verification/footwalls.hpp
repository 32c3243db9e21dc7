#pragma once

// Footwalls that the tests of elastic bases start from.

#include "dem/numbers/units.hpp"
#include "fem/footwall.hpp"

#include <cmath>
#include <numbers>
#include <vector>

namespace listric::support {

inline constexpr double right_angle = 0.5 * std::numbers::pi;
using dem::standard_gravity;

/// A bend of the detachment: radius, m, and turn, rad (> 0 left); or a line: length and no turn.
struct Bend {
    double size, turn;
};

inline std::vector<fem::Piece> detachment(double start_dip, const std::vector<Bend>& bends) {
    std::vector<fem::Piece> pieces;
    fem::Vector at;
    double direction = -start_dip;
    for (const Bend& bend : bends) {
        fem::Piece piece{at, direction, bend.size, 0.0};
        double chord = bend.size;
        if (bend.turn != 0.0) {
            piece.curvature = (bend.turn > 0.0 ? 1.0 : -1.0) / bend.size;
            piece.length = bend.size * std::abs(bend.turn);
            chord = 2.0 * bend.size * std::sin(0.5 * std::abs(bend.turn));
        }
        at.x += chord * std::cos(direction + 0.5 * bend.turn);
        at.y += chord * std::sin(direction + 0.5 * bend.turn);
        direction += bend.turn;
        pieces.push_back(piece);
    }
    return pieces;
}

/// Quarter circle from the vertical breakaway.
inline std::vector<fem::Piece> listric_detachment(double radius = 15e3) {
    return detachment(right_angle, {{radius, right_angle}});
}

/// Two quarter circles with a flat between them; its end is rounded off.
inline std::vector<fem::Piece> ramp_flat_ramp() {
    return detachment(
        right_angle,
        {{7e3, right_angle}, {4.7e3, 0.0}, {300.0, -right_angle}, {7.7e3, right_angle}});
}

/// Near the detachment only: a small footwall for orders of convergence.
inline fem::FootwallRequest small_footwall() {
    fem::FootwallRequest request;
    request.detachment = listric_detachment();
    request.left = -30e3;
    request.right = 45e3;
    request.depth = 40e3;
    request.layers = {{0.0, 50e9, 0.25, 2700.0}};
    request.surface_spring = request.detachment_spring = 2700.0 * standard_gravity;
    request.base_spring = 600.0 * standard_gravity;
    request.cell_size = 4000.0;
    return request;
}

/// A flat layer on springs at its base.
inline fem::FootwallRequest layer(double thickness, double left, double right, double cell_size) {
    fem::FootwallRequest request;
    request.left = left;
    request.right = right;
    request.depth = thickness;
    request.layers = {{0.0, 70e9, 0.25, 2700.0}};
    request.base_spring = 3300.0 * standard_gravity;
    request.cell_size = cell_size;
    return request;
}

/// Nodes of a field at a height, from left to right.
inline fem::Field row(const fem::Field& field, double y, double tolerance) {
    fem::Field row;
    for (std::size_t k = 0; k < field.place.size(); ++k)
        if (std::abs(field.place[k].y - y) < tolerance) {
            row.place.push_back(field.place[k]);
            row.displacement.push_back(field.displacement[k]);
        }
    return row;
}

} // namespace listric::support
