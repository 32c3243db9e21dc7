#include "apps/scene/svg/svg_path.hpp"

#include "apps/scene/svg/svg_text.hpp"
#include "apps/support/words/spelling.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hypotenuse.hpp"
#include "dem/numbers/units.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace listric {

namespace {

using Eigen::Vector2d;

char upper(char letter) { return letter >= 'a' ? static_cast<char>(letter - 'a' + 'A') : letter; }

/// Counts what is too much rather than to keep it.
class Pieces {
public:
    explicit Pieces(std::size_t most) : most_(most) {}

    void begin(const Vector2d& start) { path_.start = start; }
    void add(const SvgPiece& piece) {
        if (++count_ <= most_)
            path_.pieces.push_back(piece);
    }
    std::size_t count() const { return count_; }

    SvgPath taken(const SvgText& text) {
        if (count_ > most_)
            text.refuse(fmt::format("has {} nodes, allowed: at most {}; simplify the path "
                                    "(Inkscape: Path, Simplify), or keep every {} node",
                                    count_ + 1, most_ + 1, ordinal(1 + count_ / most_)));
        return std::move(path_);
    }

private:
    std::size_t most_, count_ = 0;
    SvgPath path_;
};

class PathReader {
public:
    PathReader(std::string_view data, const std::string& where, std::size_t most)
        : text_(data, where), pieces_(most) {}

    SvgPath read() {
        char command = 0;
        while (!text_.at_end()) {
            if (const auto letter = text_.letter())
                command = *letter;
            else if (command == 'M' || command == 'm')
                command = command == 'M' ? 'L' : 'l'; // further pairs are lines
            if (!begun_ && upper(command) != 'M')
                text_.refuse("the path does not begin with M or m");
            carry_out(command);
        }
        if (!begun_)
            text_.refuse("has no points");
        return pieces_.taken(text_);
    }

private:
    void carry_out(char command) {
        relative_ = command >= 'a';
        char curve = 0; // whose control point the next smooth one mirrors
        const char kind = upper(command);
        switch (kind) {
        case 'M':
            move();
            break;
        case 'L':
            straight(point());
            break;
        case 'H':
            straight({(relative_ ? here_.x() : 0.0) + text_.number(), here_.y()});
            break;
        case 'V':
            straight({here_.x(), (relative_ ? here_.y() : 0.0) + text_.number()});
            break;
        case 'C':
        case 'S': {
            curve = 'C';
            const Vector2d first = kind == 'C' ? point() : mirrored('C');
            const Vector2d second = point();
            cubic(first, second, point());
            control_ = second;
            break;
        }
        case 'Q':
        case 'T': {
            curve = 'Q';
            const Vector2d middle = kind == 'Q' ? point() : mirrored('Q');
            const Vector2d end = point();
            cubic(here_ + 2.0 / 3.0 * (middle - here_), end + 2.0 / 3.0 * (middle - end), end);
            control_ = middle;
            break;
        }
        case 'A':
            elliptic();
            break;
        case 'Z':
            text_.refuse("the path is closed, but a fault is open; break it at the breakaway");
        default:
            text_.refuse(fmt::format("the path has an unknown command {}", command));
        }
        last_curve_ = curve;
    }

    /// One that draws nothing before the next is no part of the path.
    void move() {
        if (pieces_.count() > 0)
            text_.refuse("the path has a second part; join the two, or name another path");
        here_ = point();
        begun_ = true;
        pieces_.begin(here_);
    }
    void straight(const Vector2d& end) { add({.end = end}); }
    void cubic(const Vector2d& first, const Vector2d& second, const Vector2d& end) {
        add({.kind = SvgPiece::Kind::cubic, .end = end, .first = first, .second = second});
    }
    void add(const SvgPiece& piece) {
        pieces_.add(piece);
        here_ = piece.end;
    }

    Vector2d point() {
        const double x = text_.number(), y = text_.number();
        return (relative_ ? here_ : Vector2d(0.0, 0.0)) + Vector2d(x, y);
    }
    Vector2d mirrored(char curve) const {
        return last_curve_ == curve ? Vector2d(2.0 * here_ - control_) : here_;
    }

    /// SVG 1.1, appendix F.6.5: from end points to centre.
    void elliptic() {
        double rx = std::abs(text_.number()), ry = std::abs(text_.number());
        const Eigen::Rotation2Dd axes(text_.number() * dem::pi / 180.0);
        const bool large = text_.flag(), sweep = text_.flag();
        const Vector2d from = here_, to = point();
        if (from == to)
            return;
        if (rx == 0.0 || ry == 0.0) {
            straight(to);
            return;
        }
        const Vector2d half = axes.inverse() * Vector2d(0.5 * (from - to));
        const auto needed = [&] {
            return half.x() * half.x() / (rx * rx) + half.y() * half.y() / (ry * ry);
        };
        if (const double enlarge = std::sqrt(std::max(1.0, needed())); enlarge > 1.0) {
            rx *= enlarge;
            ry *= enlarge;
        }
        const double size =
            std::sqrt(std::max(0.0, 1.0 / needed() - 1.0)) * (large == sweep ? -1.0 : 1.0);
        const Vector2d centre(size * rx * half.y() / ry, -size * ry * half.x() / rx);
        const auto angle = [&](const Vector2d& p) {
            return dem::arc_tangent((p.y() - centre.y()) / ry, (p.x() - centre.x()) / rx);
        };
        const double begin = angle(half);
        double turn = angle(-half) - begin;
        if (sweep && turn < 0.0)
            turn += 2.0 * dem::pi;
        else if (!sweep && turn > 0.0)
            turn -= 2.0 * dem::pi;
        add({.kind = SvgPiece::Kind::arc,
             .end = to,
             .first = axes * Vector2d(rx, 0.0),
             .second = axes * Vector2d(0.0, ry),
             .centre = 0.5 * (from + to) + axes * centre,
             .begin = begin,
             .turn = turn});
    }

    SvgText text_;
    Pieces pieces_;
    Vector2d here_{0.0, 0.0}, control_{0.0, 0.0};
    char last_curve_ = 0;
    bool relative_ = false, begun_ = false;
};

/// A bound of the second derivative by the parameter, which runs from 0 to 1.
double bend(const SvgPiece& piece, const Vector2d& start) {
    switch (piece.kind) {
    case SvgPiece::Kind::cubic:
        return 6.0 * std::max((start - 2.0 * piece.first + piece.second).norm(),
                              (piece.first - 2.0 * piece.second + piece.end).norm());
    case SvgPiece::Kind::arc:
        return piece.turn * piece.turn * std::max(piece.first.norm(), piece.second.norm()) *
               std::sqrt(2.0); // after a skew the axes are no longer at right angles
    case SvgPiece::Kind::line:
        break;
    }
    return 0.0;
}

/// A bound of the length.
double reach(const SvgPiece& piece, const Vector2d& start) {
    if (piece.kind == SvgPiece::Kind::cubic)
        return (piece.first - start).norm() + (piece.second - piece.first).norm() +
               (piece.end - piece.second).norm();
    if (piece.kind == SvgPiece::Kind::arc)
        return std::abs(piece.turn) * dem::hypotenuse(piece.first.norm(), piece.second.norm());
    return (piece.end - start).norm();
}

Vector2d point_on(const SvgPiece& piece, const Vector2d& start, double t) {
    const double s = 1.0 - t;
    switch (piece.kind) {
    case SvgPiece::Kind::cubic:
        return s * s * s * start + 3.0 * s * s * t * piece.first + 3.0 * s * t * t * piece.second +
               t * t * t * piece.end;
    case SvgPiece::Kind::arc: {
        const double angle = piece.begin + piece.turn * t;
        return piece.centre + dem::cosine(angle) * piece.first + dem::sine(angle) * piece.second;
    }
    case SvgPiece::Kind::line:
        break;
    }
    return s * start + t * piece.end;
}

} // namespace

SvgPath read_svg_path(std::string_view data, const std::string& where, std::size_t most) {
    return PathReader(data, where, most).read();
}

SvgPath read_svg_polyline(std::string_view points, const std::string& where, std::size_t most) {
    SvgText text(points, where);
    Pieces pieces(most);
    for (bool first = true; !text.at_end(); first = false) {
        const double x = text.number(), y = text.number();
        if (first)
            pieces.begin({x, y});
        else
            pieces.add({.end = {x, y}});
    }
    if (pieces.count() == 0)
        text.refuse("has fewer than two points");
    return pieces.taken(text);
}

std::vector<Vector2d> flattened(const SvgPath& path, double flatness, double step,
                                std::size_t most) {
    std::vector<Vector2d> points{path.start};
    for (const SvgPiece& piece : path.pieces) {
        const Vector2d start = points.back();
        // A chord is off by at most an eighth of the second derivative.
        const double wanted =
            std::max(std::sqrt(bend(piece, start) / (8.0 * flatness)), reach(piece, start) / step);
        const double count = std::ceil(std::clamp(wanted, 1.0, static_cast<double>(most)));
        for (double k = 1.0; k < count; ++k)
            points.push_back(point_on(piece, start, k / count));
        points.push_back(piece.end);
    }
    return points;
}

} // namespace listric
