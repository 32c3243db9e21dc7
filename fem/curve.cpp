#include "fem/curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace listric::fem {

namespace {

constexpr double steep = 0.25 * std::numbers::pi; ///< dip, rad

/// Arc length of the point of a piece that is closest to p.
double nearest_on(const Piece& piece, Vector p) {
    const Vector d = p - piece.start;
    if (piece.curvature == 0.0) {
        const Vector t = tangent_at(piece, 0.0);
        return std::clamp(dot(d, t), 0.0, piece.length);
    }
    const double radius = 1.0 / piece.curvature;
    const Vector centre{piece.start.x - radius * std::sin(piece.direction),
                        piece.start.y + radius * std::cos(piece.direction)};
    const Vector out = p - centre;
    // Angle from the start's radius, counted in the direction of travel.
    const Vector first = piece.start - centre;
    double angle = std::atan2(cross(first, out), dot(first, out));
    double s = angle * radius;
    const double round = 2.0 * std::numbers::pi * std::abs(radius);
    if (s < -0.5 * (round - piece.length))
        s += round;
    return std::clamp(s, 0.0, piece.length);
}

/// Where two pieces cross: arc lengths on both. Of several crossings the first on `a`.
std::optional<std::pair<double, double>> crossing(const Piece& a, const Piece& b) {
    constexpr int parts = 256;
    for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j) {
            double s = a.length * i / parts, t = b.length * j / parts;
            const Vector p = point_at(a, s), q = point_at(b, t);
            const Vector u = point_at(a, a.length * (i + 1) / parts) - p;
            const Vector v = point_at(b, b.length * (j + 1) / parts) - q;
            const double area = cross(u, v);
            if (area == 0.0)
                continue;
            const double along = cross(q - p, v) / area, across = cross(q - p, u) / area;
            constexpr double slack = 1e-9;
            if (along < -slack || along > 1 + slack || across < -slack || across > 1 + slack)
                continue;
            s += along * a.length / parts;
            t += across * b.length / parts;
            for (int step = 0; step < 20; ++step) { // Newton, from the chords' crossing
                const Vector gap = point_at(b, t) - point_at(a, s);
                const Vector ta = tangent_at(a, s), tb = tangent_at(b, t);
                const double det = cross(ta, tb);
                s += cross(gap, tb) / det;
                t += cross(gap, ta) / det;
            }
            return std::pair(s, t);
        }
    return std::nullopt;
}

void cut_end(Piece& piece, double arc_length) { piece.length = arc_length; }

void cut_start(Piece& piece, double arc_length) {
    piece.start = point_at(piece, arc_length);
    piece.direction = direction_at(piece, arc_length);
    piece.length -= arc_length;
}

/// Makes the path meet the next piece: both are cut where they cross; a gap is bridged along their
/// tangents.
void join(std::vector<Piece>& path, Piece& next, double distance) {
    Piece& last = path.back();
    const Vector end = point_at(last, last.length);
    if (!(norm(next.start - end) > 1e-6 * distance))
        return;
    if (const auto cut = crossing(last, next)) {
        cut_end(last, cut->first);
        cut_start(next, cut->second);
        return;
    }
    const Vector ta = tangent_at(last, last.length), tb = tangent_at(next, 0.0);
    const Vector gap = next.start - end;
    const double det = cross(ta, tb);
    const double a = det == 0.0 ? -1.0 : cross(gap, tb) / det;
    const double b = det == 0.0 ? -1.0 : -cross(gap, ta) / det;
    if (a < 0.0 || b < 0.0)
        throw FootwallError("the detachment bends too tightly for a skin of " +
                            std::to_string(distance) + " m; make the skin thinner");
    path.push_back({end, direction_at(last, last.length), a, 0.0});
    path.push_back({point_at(path.back(), a), next.direction, b, 0.0});
}

} // namespace

double direction_at(const Piece& piece, double arc_length) {
    return piece.direction + piece.curvature * arc_length;
}

Vector tangent_at(const Piece& piece, double arc_length) {
    const double direction = direction_at(piece, arc_length);
    return {std::cos(direction), std::sin(direction)};
}

Vector point_at(const Piece& piece, double arc_length) {
    // The chord of an arc: its length 2 R sin(turn / 2), its direction half the turn further.
    const double half_turn = 0.5 * piece.curvature * arc_length;
    const double chord =
        half_turn == 0.0 ? arc_length : arc_length * std::sin(half_turn) / half_turn;
    return {piece.start.x + chord * std::cos(piece.direction + half_turn),
            piece.start.y + chord * std::sin(piece.direction + half_turn)};
}

Curve::Curve(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {
    double end = 0.0;
    for (const Piece& piece : pieces_)
        ends_.push_back(end += piece.length);
}

std::pair<const Piece&, double> Curve::on_piece(double arc_length) const {
    assert(!empty());
    const auto k = static_cast<std::size_t>(
        std::min<std::ptrdiff_t>(std::ranges::lower_bound(ends_, arc_length) - ends_.begin(),
                                 static_cast<std::ptrdiff_t>(pieces_.size()) - 1));
    return {pieces_[k], arc_length - (k ? ends_[k - 1] : 0.0)};
}

Vector Curve::at(double arc_length) const {
    const auto [piece, s] = on_piece(arc_length);
    const double inside = std::clamp(s, 0.0, piece.length);
    const Vector p = point_at(piece, inside), t = tangent_at(piece, inside);
    return p + (s - inside) * t;
}

double Curve::dip_at(double arc_length) const {
    const auto [piece, s] = on_piece(arc_length);
    return -direction_at(piece, s);
}

double Curve::nearest(Vector p) const {
    assert(!empty());
    double best = 0.0, least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
        const double s = nearest_on(pieces_[k], p);
        const double d = norm(p - point_at(pieces_[k], s));
        if (d < least) {
            least = d;
            best = (k ? ends_[k - 1] : 0.0) + s;
        }
    }
    return best;
}

double Curve::distance(Vector p) const { return norm(p - at(nearest(p))); }

std::vector<double> Curve::turns() const {
    std::vector<double> turns;
    constexpr double slack = 1e-9;
    const auto is_steep = [](double direction) { return -direction > steep + slack; };
    double start = 0.0;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
        const Piece& piece = pieces_[k];
        if (k > 0) {
            const Piece& before = pieces_[k - 1];
            if (is_steep(direction_at(before, before.length)) != is_steep(piece.direction))
                turns.push_back(start);
        }
        const double end = direction_at(piece, piece.length);
        if (is_steep(piece.direction) != is_steep(end))
            turns.push_back(start + (-steep - piece.direction) / piece.curvature);
        start += piece.length;
    }
    return turns;
}

double Curve::where_y(double y) const {
    assert(!empty() && at(0.0).y >= at(length()).y);
    double low = 0.0, high = length();
    for (int step = 0; step < 200 && high - low > 1e-14 * length(); ++step) {
        const double middle = 0.5 * (low + high);
        (at(middle).y > y ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

Curve Curve::offset(double distance) const {
    std::vector<Piece> result;
    for (const Piece& piece : pieces_) {
        const double stretch = 1.0 + piece.curvature * distance;
        if (stretch <= 0.0 || piece.length == 0.0)
            continue; // a convex bend tighter than the distance
        const Vector t = tangent_at(piece, 0.0);
        Piece moved{{piece.start.x + distance * t.y, piece.start.y - distance * t.x},
                    piece.direction,
                    piece.length * stretch,
                    piece.curvature / stretch};
        if (!result.empty())
            join(result, moved, distance);
        result.push_back(moved);
    }
    return Curve(std::move(result));
}

} // namespace listric::fem
