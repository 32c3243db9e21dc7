#include "fem/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace listric::fem {

namespace {

using Path = std::function<Vector(double)>; ///< from 0 to 1

Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
Vector operator*(double f, Vector a) { return {f * a.x, f * a.y}; }

std::string metres(double x) { return std::to_string(std::lround(x)) + " m"; }

Path segment(Vector a, Vector b) {
    return [a, b](double t) { return a + t * (b - a); };
}

Path stretch(const Curve& curve, double from, double to) {
    return [&curve, from, to](double t) { return curve.at(from + t * (to - from)); };
}

/// Fractions 0 ... 1 of parts that are all about `size` long.
std::vector<double> even(double length, double size) {
    const int parts = std::max(1, static_cast<int>(std::lround(length / size)));
    std::vector<double> fractions;
    for (int k = 0; k <= parts; ++k)
        fractions.push_back(static_cast<double>(k) / parts);
    return fractions;
}

/// Parts that are `size` long up to `fine` and then grow, each by `ratio`, to at most `largest`.
std::vector<double> growing(double length, double size, double fine, double ratio, double largest) {
    std::vector<double> places{0.0};
    double part = size;
    while (places.back() < length) {
        if (places.back() >= fine)
            part = std::min(part * ratio, largest);
        places.push_back(places.back() + part);
    }
    const double whole = places.back();
    for (double& place : places)
        place /= whole;
    return places;
}

std::vector<double> reversed(std::vector<double> fractions) {
    std::ranges::reverse(fractions);
    for (double& f : fractions)
        f = 1.0 - f;
    return fractions;
}

/// Four sides of a block; bottom and top run to the right, left and right upward.
struct Block {
    Path bottom, top, left, right;
    int bottom_boundary = 0, top_boundary = 0, left_boundary = 0, right_boundary = 0;
    EdgeCurve bottom_curve = EdgeCurve::straight, top_curve = EdgeCurve::straight,
              left_curve = EdgeCurve::straight, right_curve = EdgeCurve::straight;
};

class Mesher {
public:
    explicit Mesher(double tolerance) : tolerance_(tolerance) {}

    /// Cells of a block at the fractions u to the right and v upward, by transfinite interpolation
    /// (Gordon & Hall 1973).
    void add(const Block& b, const std::vector<double>& u, const std::vector<double>& v) {
        const Vector sw = b.bottom(0), se = b.bottom(1), nw = b.top(0), ne = b.top(1);
        std::vector<unsigned> index;
        for (double t : v)
            for (double s : u)
                index.push_back(vertex((1 - t) * b.bottom(s) + t * b.top(s) + (1 - s) * b.left(t) +
                                       s * b.right(t) - (1 - s) * (1 - t) * sw - s * (1 - t) * se -
                                       (1 - s) * t * nw - s * t * ne));
        const std::size_t n = u.size(), m = v.size();
        const auto edge = [&](std::size_t a, std::size_t c, int boundary, EdgeCurve curve) {
            if (boundary != 0 || curve != EdgeCurve::straight)
                mesh.edges.push_back({index[a], index[c], boundary, curve});
        };
        for (std::size_t j = 0; j + 1 < m; ++j)
            for (std::size_t i = 0; i + 1 < n; ++i)
                mesh.cells.push_back({{index[j * n + i], index[j * n + i + 1],
                                       index[(j + 1) * n + i], index[(j + 1) * n + i + 1]}});
        for (std::size_t i = 0; i + 1 < n; ++i) {
            edge(i, i + 1, b.bottom_boundary, b.bottom_curve);
            edge((m - 1) * n + i, (m - 1) * n + i + 1, b.top_boundary, b.top_curve);
        }
        for (std::size_t j = 0; j + 1 < m; ++j) {
            edge(j * n, (j + 1) * n, b.left_boundary, b.left_curve);
            edge(j * n + n - 1, (j + 1) * n + n - 1, b.right_boundary, b.right_curve);
        }
    }

    BlockMesh mesh;

private:
    unsigned vertex(Vector p) {
        for (std::size_t k = 0; k < mesh.vertices.size(); ++k)
            if (std::abs(mesh.vertices[k].x - p.x) + std::abs(mesh.vertices[k].y - p.y) <
                tolerance_)
                return static_cast<unsigned>(k);
        mesh.vertices.push_back(p);
        return static_cast<unsigned>(mesh.vertices.size() - 1);
    }

    double tolerance_;
};

/// Depths of boundaries between layers inside (top, bottom), not closer than `apart` to the ends
/// or to each other.
std::vector<double> layer_depths(const FootwallRequest& request, double top, double bottom,
                                 double apart) {
    std::vector<double> candidates;
    for (const Layer& layer : request.layers)
        candidates.push_back(layer.top_depth);
    if (request.elastic_thickness > 0.0)
        candidates.push_back(request.elastic_thickness);
    std::ranges::sort(candidates);
    std::vector<double> depths;
    for (double depth : candidates)
        if (depth > (depths.empty() ? top : depths.back()) + apart && depth < bottom - apart)
            depths.push_back(depth);
    return depths;
}

constexpr int number(Boundary boundary) { return static_cast<int>(boundary); }

BlockMesh flat_blocks(const FootwallRequest& request) {
    const double width = request.right - request.left;
    const unsigned halvings = 1;
    const double size = request.cell_size * (1u << halvings);
    Mesher mesher(1e-6 * request.cell_size);
    std::vector<double> breaks{request.left};
    std::vector<double> inner = request.surface_breaks;
    std::ranges::sort(inner);
    for (double x : inner)
        if (x > breaks.back() + 1e-3 * request.cell_size && x < request.right - 1e-9 * width)
            breaks.push_back(x);
    breaks.push_back(request.right);
    std::vector<double> depths = layer_depths(request, 0.0, request.depth, 0.25 * size);
    depths.insert(depths.begin(), 0.0);
    depths.push_back(request.depth);
    for (std::size_t r = 0; r + 1 < depths.size(); ++r)
        for (std::size_t c = 0; c + 1 < breaks.size(); ++c) {
            const Vector nw{breaks[c], -depths[r]}, ne{breaks[c + 1], -depths[r]};
            const Vector sw{nw.x, -depths[r + 1]}, se{ne.x, -depths[r + 1]};
            Block b{segment(sw, se), segment(nw, ne), segment(sw, nw), segment(se, ne)};
            if (r == 0)
                b.top_boundary = number(Boundary::surface);
            if (r + 2 == depths.size())
                b.bottom_boundary = number(Boundary::base);
            if (c == 0)
                b.left_boundary = number(Boundary::left);
            if (c + 2 == breaks.size())
                b.right_boundary = number(Boundary::right);
            mesher.add(b, even(ne.x - nw.x, size), even(nw.y - sw.y, size));
        }
    mesher.mesh.halvings = halvings;
    return mesher.mesh;
}

} // namespace

Curve extended_detachment(const FootwallRequest& request) {
    std::vector<Piece> pieces = request.detachment;
    const Curve given(pieces);
    const Vector end = given.at(given.length());
    if (end.x > request.right + 1e-6 * request.cell_size)
        throw FootwallError("the detachment leaves the mesh: it ends at x = " + metres(end.x) +
                            ", beyond the right side at " + metres(request.right) +
                            "; move that side out or shorten the last line");
    if (std::abs(given.dip_at(given.length())) > 1e-6)
        throw FootwallError("the detachment ends inside the mesh with a dip; its last arc or line "
                            "must be horizontal, or reach the right side");
    if (end.x < request.right - 1e-6 * request.cell_size)
        pieces.push_back({end, 0.0, request.right - end.x, 0.0});
    Curve curve(std::move(pieces));
    const double deepest = -curve.at(curve.length()).y;
    if (deepest > request.depth - request.cell_size)
        throw FootwallError("the detachment leaves the mesh: it reaches a depth of " +
                            metres(deepest) + ", allowed: at least a cell (" +
                            metres(request.cell_size) + ") above the base at " +
                            metres(request.depth));
    return curve;
}

BlockMesh make_blocks(const FootwallRequest& request) {
    if (request.detachment.empty())
        return flat_blocks(request);

    const Curve chain = extended_detachment(request);
    const double lowest = -chain.at(chain.length()).y;
    double thickness = request.skin_thickness;
    if (thickness <= 0.0) // cells along the detachment all the same: they follow it better
        thickness = std::min(0.2 * lowest, 0.5 * (request.depth - lowest));
    if (lowest + thickness > request.depth - 0.5 * request.cell_size)
        throw FootwallError("the skin along the detachment reaches the base: depth " +
                            metres(lowest + thickness) + " of " + metres(request.depth));

    const std::vector<double> turns = chain.turns();
    const bool starts_steep = turns.size() % 2 == 1; // it ends flat
    Mesher mesher(1e-6 * request.cell_size);
    BlockMesh& mesh = mesher.mesh;
    mesh.detachment = chain;

    // The strip's lower edge. Beside a steep start it rises to the surface; below a flat start the
    // strip goes on below the surface.
    const Vector breakaway = chain.at(0.0);
    std::vector<Piece> top = chain.pieces();
    if (!starts_steep)
        top.insert(top.begin(),
                   {{request.left, breakaway.y}, 0.0, breakaway.x - request.left, 0.0});
    std::vector<Piece> below = Curve(top).offset(thickness).pieces();
    if (starts_steep) {
        Piece& first = below.front();
        const double rise = breakaway.y - first.start.y;
        if (rise > 1e-6 * thickness) {
            const double length = rise / -std::sin(first.direction);
            const Vector t = tangent_at(first, 0.0);
            const Piece line{first.start - length * t, first.direction, length, 0.0};
            below.insert(below.begin(), line);
        }
    }
    { // to the sides, exactly
        Piece& last = below.back();
        last.length += request.right - point_at(last, last.length).x;
    }
    mesh.skin = Curve(below);
    const Curve& skin = mesh.skin;
    const std::vector<double> inner = skin.turns();
    if (inner.size() != turns.size())
        throw FootwallError("the detachment bends too tightly for a skin of " + metres(thickness) +
                            "; make the skin thinner or the bends wider");

    const unsigned halvings = 2;
    mesh.halvings = halvings;
    const double size = request.cell_size * (1u << halvings);
    const double largest = 20.0 * size;
    constexpr double growth = 2.0;

    // Corners along the chain and the strip's lower edge, by arc length: flat part, steep part, ...
    std::vector<double> outer_at{0.0}, inner_at{0.0};
    for (std::size_t k = 0; k < turns.size(); ++k) {
        outer_at.push_back(turns[k]);
        inner_at.push_back(inner[k]);
    }
    outer_at.push_back(chain.length());
    inner_at.push_back(skin.length());
    const std::size_t parts = outer_at.size() - 1;
    const auto is_flat = [&](std::size_t part) { return (part % 2 == 0) != starts_steep; };

    // Cells along each part, by the strip's lower edge for the far parts that grow.
    std::vector<std::vector<double>> along(parts);
    for (std::size_t p = 0; p < parts; ++p) {
        const double length = outer_at[p + 1] - outer_at[p];
        if (p + 1 == parts) {
            const double fine = std::max(0.0, request.fine_until - chain.at(outer_at[p]).x);
            along[p] = growing(length, size, fine, growth, largest);
        } else {
            along[p] = even(length, size);
        }
    }
    const std::vector<double> far_left =
        reversed(growing(breakaway.x - request.left, size, 0.5 * lowest, growth, largest));

    const std::vector<double> across = even(thickness, size);
    const int detachment = number(Boundary::detachment), surface = number(Boundary::surface);

    // A steep part's cells end where layers meet.
    struct SteepPart {
        Vector upper, lower;        ///< ends of its lower edge
        std::vector<double> depths; ///< of layers that end at it
        std::vector<double> at;     ///< arc lengths of its top, these depths, its end
        std::vector<std::vector<double>> fractions; ///< cells between those, from above
        std::size_t part;
    };
    std::vector<SteepPart> steep;
    for (std::size_t p = 0; p < parts; ++p) {
        if (is_flat(p))
            continue;
        SteepPart s{skin.at(inner_at[p]), skin.at(inner_at[p + 1]), {}, {inner_at[p]}, {}, p};
        s.depths = layer_depths(request, -s.upper.y, -s.lower.y, 0.25 * size);
        for (double depth : s.depths)
            s.at.push_back(skin.where_y(-depth));
        s.at.push_back(inner_at[p + 1]);
        const double whole = inner_at[p + 1] - inner_at[p];
        along[p] = {0.0};
        for (std::size_t j = 0; j + 1 < s.at.size(); ++j) {
            s.fractions.push_back(even(s.at[j + 1] - s.at[j], size));
            for (std::size_t i = 1; i < s.fractions.back().size(); ++i)
                along[p].push_back(
                    (s.at[j] - inner_at[p] + s.fractions.back()[i] * (s.at[j + 1] - s.at[j])) /
                    whole);
        }
        steep.push_back(std::move(s));
    }

    // The strip.
    const auto strip_of = [&](std::size_t p) {
        const Path upper = stretch(chain, outer_at[p], outer_at[p + 1]);
        const Path lower = stretch(skin, inner_at[p], inner_at[p + 1]);
        const Path start = segment(lower(0), upper(0)), end = segment(lower(1), upper(1));
        if (is_flat(p)) {
            Block b{lower, upper, start, end};
            b.bottom_curve = EdgeCurve::skin;
            b.top_curve = EdgeCurve::detachment;
            b.top_boundary = detachment;
            if (p + 1 == parts)
                b.right_boundary = number(Boundary::right);
            mesher.add(b, along[p], across);
        } else { // upward is against the chain's direction
            const auto backward = [](const Path& path) {
                return [path](double t) { return path(1.0 - t); };
            };
            Block b{end, start, backward(lower), backward(upper)};
            b.left_curve = EdgeCurve::skin;
            b.right_curve = EdgeCurve::detachment;
            b.right_boundary = detachment;
            if (p == 0)
                b.top_boundary = surface;
            mesher.add(b, across, reversed(along[p]));
        }
    };
    if (starts_steep) {
        for (std::size_t p = 0; p < parts; ++p)
            strip_of(p);
    } else {
        // The first part of the strip's lower edge holds the part below the surface. Where the
        // detachment begins, the strip is cut along the bisector.
        double joint = skin.nearest(breakaway);
        const Curve surface_below(
            std::vector<Piece>{skin.pieces().front()}); // ends at the bisector
        joint = surface_below.length();
        const Path lower_left = stretch(skin, 0.0, joint);
        const Vector corner = skin.at(joint);
        Block b{lower_left, segment({request.left, breakaway.y}, breakaway),
                segment({request.left, breakaway.y - thickness}, {request.left, breakaway.y}),
                segment(corner, breakaway)};
        b.bottom_curve = EdgeCurve::skin;
        b.top_boundary = surface;
        b.left_boundary = number(Boundary::left);
        mesher.add(b, far_left, across);
        inner_at[0] = joint;
        for (std::size_t p = 0; p < parts; ++p)
            strip_of(p);
    }
    // Below the strip: columns k under its flat parts, rows r beside its steep parts, and the rows
    // below all of it. Column 0 reaches the left side.
    const std::size_t columns = steep.size() + 1;

    const auto column_left = [&](std::size_t k) {
        return k == 0 ? request.left : steep[k - 1].lower.x;
    };
    const auto column_right = [&](std::size_t k) {
        return k + 1 == columns ? request.right : steep[k].lower.x;
    };
    // Cells along the top of each column.
    std::vector<std::vector<double>> columns_u(columns);
    std::vector<Path> column_top(columns);
    std::vector<EdgeCurve> top_curve(columns, EdgeCurve::skin);
    for (std::size_t k = 0; k < columns; ++k) {
        if (k == 0 && starts_steep) {
            columns_u[0] = far_left;
            column_top[0] = segment({request.left, breakaway.y}, steep[0].upper);
            top_curve[0] = EdgeCurve::straight;
        } else if (k == 0) { // below the surface and the first flat part, joined
            const double joint = inner_at[0], end = inner_at[1];
            const double whole = end;
            for (double f : far_left)
                columns_u[0].push_back(f * joint / whole);
            for (std::size_t i = 1; i < along[0].size(); ++i)
                columns_u[0].push_back((joint + along[0][i] * (end - joint)) / whole);
            column_top[0] = stretch(skin, 0.0, end);
        } else {
            const std::size_t p = steep[k - 1].part + 1;
            columns_u[k] = along[p];
            column_top[k] = stretch(skin, inner_at[p], inner_at[p + 1]);
        }
    }

    // The bottom of a row is level; the first row of a column has the strip above it.
    const auto add_rows = [&](std::size_t r, double top_level, double bottom_level,
                              const std::vector<double>& breaks, bool is_last) {
        std::vector<double> levels{top_level};
        for (double depth : breaks)
            levels.push_back(-depth);
        levels.push_back(bottom_level);
        double row_size = size;
        for (std::size_t j = 0; j + 1 < levels.size(); ++j) {
            const double high = levels[j], low = levels[j + 1];
            std::vector<double> v;
            if (!is_last) {
                v = reversed(steep[r].fractions[j]);
            } else {
                v = reversed(growing(high - low, row_size, size, growth, 4.0 * size));
                row_size = std::min(4.0 * size, row_size * (j == 0 ? 1.0 : growth));
            }
            for (std::size_t k = 0; k <= std::min(r, columns - 1); ++k) {
                const bool has_top = j == 0 && k == r;
                const bool beside = !is_last && k == r; // its right side is the strip
                const double left = column_left(k), right = column_right(k);
                double right_low = right, right_high = right;
                Path right_path;
                if (beside) {
                    const double a = steep[r].at[j], b = steep[r].at[j + 1];
                    right_path = [&skin, a, b](double t) { return skin.at(b + t * (a - b)); };
                    right_low = skin.at(b).x;
                    right_high = skin.at(a).x;
                }
                const double left_high = has_top ? column_top[k](0).y : high;
                Block b{segment({left, low}, {right_low, low}),
                        has_top ? column_top[k] : segment({left, high}, {right_high, high}),
                        segment({left, low}, {left, left_high}),
                        {}};
                b.right = beside
                              ? right_path
                              : segment({right, low}, {right, has_top ? column_top[k](1).y : high});
                if (has_top)
                    b.top_curve = top_curve[k];
                if (has_top && k == 0 && starts_steep)
                    b.top_boundary = surface;
                if (beside)
                    b.right_curve = EdgeCurve::skin;
                if (k == 0)
                    b.left_boundary = number(Boundary::left);
                if (k + 1 == columns && !beside)
                    b.right_boundary = number(Boundary::right);
                if (is_last && j + 2 == levels.size())
                    b.bottom_boundary = number(Boundary::base);
                mesher.add(b, columns_u[k], v);
            }
        }
    };

    double level = starts_steep ? breakaway.y : breakaway.y - thickness;
    for (std::size_t r = 0; r < steep.size(); ++r) {
        const double bottom = steep[r].lower.y;
        add_rows(r, level, bottom, steep[r].depths, false);
        level = bottom;
    }
    const double flat_bottom = skin.at(skin.length()).y;
    add_rows(steep.size(), level, -request.depth,
             layer_depths(request, -flat_bottom, request.depth, 0.25 * size), true);
    return mesh;
}

} // namespace listric::fem
