#include "fem/blocks.hpp"

#include "fem/mesh_scan.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

namespace listric::fem {

namespace {

std::string metres(double x) { return std::to_string(std::lround(x)) + " m"; }

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

BlockMesh flat_blocks(const FootwallRequest& request) {
    const double width = request.right - request.left;
    const unsigned halvings = 1;
    const double size = request.cell_size * (1u << halvings);
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

    BlockMesher mesher(1e-6 * request.cell_size);
    for (std::size_t r = 0; r + 1 < depths.size(); ++r)
        for (std::size_t c = 0; c + 1 < breaks.size(); ++c) {
            const Vector nw{breaks[c], -depths[r]}, ne{breaks[c + 1], -depths[r]};
            const Vector sw{nw.x, -depths[r + 1]}, se{ne.x, -depths[r + 1]};
            Block b{{segment(sw, se)}, {segment(nw, ne)}, {segment(sw, nw)}, {segment(se, ne)}};
            if (r == 0)
                b.top.boundary = Boundary::surface;
            if (r + 2 == depths.size())
                b.bottom.boundary = Boundary::base;
            if (c == 0)
                b.left.boundary = Boundary::left;
            if (c + 2 == breaks.size())
                b.right.boundary = Boundary::right;
            mesher.add(b, even(ne.x - nw.x, size), even(nw.y - sw.y, size));
        }
    BlockMesh mesh = mesher.take();
    mesh.halvings = halvings;
    return mesh;
}

/// Thickness of the strip of cells along a detachment whose lowest point is at a depth.
double strip_thickness(const FootwallRequest& request, double lowest) {
    double thickness = request.skin_thickness;
    if (thickness <= 0.0) // cells along the detachment all the same: they follow it better
        thickness = std::min(0.2 * lowest, 0.5 * (request.depth - lowest));
    if (lowest + thickness > request.depth - 0.5 * request.cell_size)
        throw FootwallError("the skin along the detachment reaches the base: depth " +
                            metres(lowest + thickness) + " of " + metres(request.depth));
    return thickness;
}

/// Lower edge of the strip, from side to side. Beside a steep start of the detachment it rises to
/// the surface; below a flat start it goes on below the surface to the left side.
Curve strip_edge(const FootwallRequest& request, const Curve& detachment, double thickness,
                 bool starts_steep) {
    const Vector breakaway = detachment.at(0.0);
    std::vector<Piece> upper = detachment.pieces();
    if (!starts_steep)
        upper.insert(upper.begin(),
                     {{request.left, breakaway.y}, 0.0, breakaway.x - request.left, 0.0});
    std::vector<Piece> pieces = Curve(upper).offset(thickness).pieces();
    if (starts_steep) {
        const Piece first = pieces.front();
        const double rise = breakaway.y - first.start.y;
        if (rise > 1e-6 * thickness) {
            const double length = rise / -std::sin(first.direction);
            pieces.insert(pieces.begin(), {first.start - length * tangent_at(first, 0.0),
                                           first.direction, length, 0.0});
        }
    }
    Piece& last = pieces.back();
    last.length += request.right - point_at(last, last.length).x; // to the right side, exactly
    return Curve(std::move(pieces));
}

/// Blocks of a footwall with a detachment. The detachment is cut where it passes through 45
/// degrees. A strip of cells lies along it; its lower edge is that of the skin, if there is one.
/// Below the strip are columns, one under each flat part (the first reaches the left side, below
/// the surface), and rows, one beside each steep part and the last below all of it.
class DetachmentBlocks {
public:
    explicit DetachmentBlocks(const FootwallRequest& request)
        : request_(request), detachment_(extended_detachment(request)),
          mesher_(1e-6 * request.cell_size) {
        find_parts();
        find_columns();
    }
    DetachmentBlocks(const DetachmentBlocks&) = delete;
    DetachmentBlocks& operator=(const DetachmentBlocks&) = delete;

    BlockMesh mesh() {
        add_strip();
        add_rows();
        BlockMesh mesh = mesher_.take();
        mesh.detachment = detachment_;
        mesh.skin = edge_;
        mesh.halvings = halvings;
        return mesh;
    }

private:
    static constexpr unsigned halvings = 2;
    static constexpr double growth = 2.0; ///< of cells far away, each over its neighbour

    /// Stretch of the strip's lower edge beside one layer of rock.
    struct Section {
        double start = 0.0, end = 0.0; ///< arc lengths along the edge
        double bottom = 0.0;           ///< y of its end, m
        Fractions cells;
    };

    /// Stretch of the detachment, and of the strip's lower edge under it, that is flat or steep.
    struct Part {
        bool is_flat = false;
        double start = 0.0, end = 0.0;           ///< arc lengths along the detachment
        double edge_start = 0.0, edge_end = 0.0; ///< arc lengths along the strip's lower edge
        Fractions cells = {};
        std::vector<Section> sections = {}; ///< of a steep part, from above
    };

    struct Column {
        Fractions cells;
        MeshSide top;
        double left = 0.0, right = 0.0; ///< x, m
    };

    /// Cells of one height in the columns of a row.
    struct Level {
        double top = 0.0, bottom = 0.0; ///< y, m
        Fractions cells;                ///< upward
        bool is_first = false;          ///< of its row: the row's last column begins here
        bool is_on_base = false;
        const Section* beside = nullptr; ///< at the last column's right end; none: the right side
    };

    void find_parts() {
        std::vector<double> turns = detachment_.turns(), edge_turns = edge_.turns();
        if (edge_turns.size() != turns.size())
            throw FootwallError("the detachment bends too tightly for a skin of " +
                                metres(thickness_) + "; make the skin thinner or the bends wider");
        turns.insert(turns.begin(), 0.0);
        turns.push_back(detachment_.length());
        // Below a flat start, the edge's first piece lies under the surface. It ends where the
        // strip is cut, at the bisector.
        edge_turns.insert(edge_turns.begin(), starts_steep_ ? 0.0 : edge_.pieces().front().length);
        edge_turns.push_back(edge_.length());
        for (std::size_t p = 0; p + 1 < turns.size(); ++p) {
            Part part{(p % 2 == 0) != starts_steep_, turns[p], turns[p + 1], edge_turns[p],
                      edge_turns[p + 1]};
            const double length = part.end - part.start;
            if (!part.is_flat)
                cut_by_layers(part);
            else if (p + 2 == turns.size())
                part.cells =
                    growing(length, size_,
                            std::max(0.0, request_.fine_until - detachment_.at(part.start).x),
                            growth, largest_);
            else
                part.cells = even(length, size_);
            parts_.push_back(std::move(part));
        }
    }

    /// A steep part's cells end where layers meet.
    void cut_by_layers(Part& part) const {
        const double top = edge_.at(part.edge_start).y, bottom = edge_.at(part.edge_end).y;
        double start = part.edge_start;
        const auto cut = [&](double end, double y) {
            part.sections.push_back({start, end, y, even(end - start, size_)});
            start = end;
        };
        for (double depth : layer_depths(request_, -top, -bottom, 0.25 * size_))
            cut(edge_.where_y(-depth), -depth);
        cut(part.edge_end, bottom);

        const double whole = part.edge_end - part.edge_start;
        part.cells = {0.0};
        for (const Section& s : part.sections)
            for (std::size_t i = 1; i < s.cells.size(); ++i)
                part.cells.push_back((s.start - part.edge_start + s.cells[i] * (s.end - s.start)) /
                                     whole);
    }

    void find_columns() {
        if (starts_steep_)
            columns_.push_back(
                {far_left_,
                 {segment({request_.left, breakaway_.y}, edge_.at(0.0)), Boundary::surface}});
        for (const Part& part : parts_)
            if (part.is_flat)
                columns_.push_back(columns_.empty() ? column_below_surface_and(part)
                                                    : column_below(part));
        // They are parted at the feet of the steep parts.
        columns_.front().left = request_.left;
        std::size_t k = 0;
        for (const Part& part : parts_)
            if (!part.is_flat) {
                columns_[k].right = edge_.at(part.edge_end).x;
                ++k;
                columns_[k].left = columns_[k - 1].right;
            }
        columns_.back().right = request_.right;
    }

    Column column_below(const Part& part) const {
        return {part.cells, {stretch(edge_, part.edge_start, part.edge_end), {}, EdgeCurve::skin}};
    }

    Column column_below_surface_and(const Part& part) const {
        const double joint = part.edge_start, whole = part.edge_end;
        Fractions cells;
        for (double f : far_left_)
            cells.push_back(f * joint / whole);
        for (std::size_t i = 1; i < part.cells.size(); ++i)
            cells.push_back((joint + part.cells[i] * (whole - joint)) / whole);
        return {cells, {stretch(edge_, 0.0, whole), {}, EdgeCurve::skin}};
    }

    void add_strip() {
        if (!starts_steep_)
            add_strip_below_surface(parts_.front().edge_start);
        for (const Part& part : parts_)
            if (part.is_flat)
                add_flat_strip(part);
            else
                add_steep_strip(part);
    }

    void add_strip_below_surface(double joint) {
        const Vector left{request_.left, breakaway_.y};
        const Vector below_left{request_.left, breakaway_.y - thickness_};
        mesher_.add({{stretch(edge_, 0.0, joint), {}, EdgeCurve::skin},
                     {segment(left, breakaway_), Boundary::surface},
                     {segment(below_left, left), Boundary::left},
                     {segment(edge_.at(joint), breakaway_)}},
                    far_left_, across_);
    }

    void add_flat_strip(const Part& part) {
        const Path upper = stretch(detachment_, part.start, part.end);
        const Path lower = stretch(edge_, part.edge_start, part.edge_end);
        Block b{{lower, {}, EdgeCurve::skin},
                {upper, Boundary::detachment, EdgeCurve::detachment},
                {segment(lower(0), upper(0))},
                {segment(lower(1), upper(1))}};
        if (&part == &parts_.back())
            b.right.boundary = Boundary::right;
        mesher_.add(b, part.cells, across_);
    }

    /// Upward is against the detachment's direction.
    void add_steep_strip(const Part& part) {
        const Path upper = stretch(detachment_, part.start, part.end);
        const Path lower = stretch(edge_, part.edge_start, part.edge_end);
        Block b{{segment(lower(1), upper(1))},
                {segment(lower(0), upper(0))},
                {reversed(lower), {}, EdgeCurve::skin},
                {reversed(upper), Boundary::detachment, EdgeCurve::detachment}};
        if (&part == &parts_.front())
            b.top.boundary = Boundary::surface;
        mesher_.add(b, across_, reversed(part.cells));
    }

    void add_rows() {
        double top = starts_steep_ ? breakaway_.y : breakaway_.y - thickness_;
        std::size_t row = 0;
        for (const Part& part : parts_) {
            if (part.is_flat)
                continue;
            for (const Section& section : part.sections) {
                add_level(row, {top, section.bottom, reversed(section.cells),
                                &section == &part.sections.front(), false, &section});
                top = section.bottom;
            }
            ++row;
        }
        add_last_row(row, top);
    }

    /// Its cells grow toward the base.
    void add_last_row(std::size_t row, double top) {
        std::vector<double> depths =
            layer_depths(request_, -edge_.at(edge_.length()).y, request_.depth, 0.25 * size_);
        depths.push_back(request_.depth);
        const double largest = 4.0 * size_;
        double size = size_;
        for (std::size_t j = 0; j < depths.size(); ++j) {
            const double bottom = -depths[j];
            add_level(row,
                      {top, bottom, reversed(growing(top - bottom, size, size_, growth, largest)),
                       j == 0, j + 1 == depths.size(), nullptr});
            size = std::min(largest, size * (j == 0 ? 1.0 : growth));
            top = bottom;
        }
    }

    void add_level(std::size_t row, const Level& level) {
        for (std::size_t k = 0; k <= row; ++k) {
            const Column& column = columns_[k];
            const Section* beside = k == row ? level.beside : nullptr;
            const double right_top = beside ? edge_.at(beside->start).x : column.right;
            const double right_bottom = beside ? edge_.at(beside->end).x : column.right;
            Block b;
            b.bottom.path = segment({column.left, level.bottom}, {right_bottom, level.bottom});
            if (k == row && level.is_first)
                b.top = column.top;
            else
                b.top.path = segment({column.left, level.top}, {right_top, level.top});
            b.left.path = segment({column.left, level.bottom}, {column.left, b.top.path(0).y});
            if (beside)
                b.right = {stretch(edge_, beside->end, beside->start), {}, EdgeCurve::skin};
            else
                b.right.path =
                    segment({column.right, level.bottom}, {column.right, b.top.path(1).y});
            if (k == 0)
                b.left.boundary = Boundary::left;
            if (k + 1 == columns_.size() && !beside)
                b.right.boundary = Boundary::right;
            if (level.is_on_base)
                b.bottom.boundary = Boundary::base;
            mesher_.add(b, column.cells, level.cells);
        }
    }

    const FootwallRequest& request_;
    const double size_ = request_.cell_size * (1u << halvings); ///< of a block's cells, m
    const double largest_ = 20.0 * size_;                       ///< far away
    const Curve detachment_;                                    ///< extended to the right side
    const Vector breakaway_ = detachment_.at(0.0);
    const double lowest_ = -detachment_.at(detachment_.length()).y; ///< its depth
    const double thickness_ = strip_thickness(request_, lowest_);
    const bool starts_steep_ = detachment_.turns().size() % 2 == 1; ///< it ends flat
    const Curve edge_ = strip_edge(request_, detachment_, thickness_, starts_steep_);
    const Fractions across_ = even(thickness_, size_); ///< the strip
    const Fractions far_left_ =
        reversed(growing(breakaway_.x - request_.left, size_, 0.5 * lowest_, growth, largest_));
    std::vector<Part> parts_;     ///< from the breakaway on, flat and steep by turns
    std::vector<Column> columns_; ///< from the left; their tops refer to edge_
    BlockMesher mesher_;
};

void require_unfolded(const BlockMesh& mesh) {
    for (const BlockMesh::Cell& cell : mesh.cells) {
        std::array<Vector, 4> corners;
        for (std::size_t k = 0; k < 4; ++k)
            corners[k] = mesh.vertices[cell.vertices[k]];
        if (!(least_corner(corners) > 0.0))
            throw FootwallError("no mesh: cells fold over near x = " + metres(corners[0].x) +
                                ", y = " + metres(corners[0].y) +
                                "; move the left side out, make the skin thinner, the bends of "
                                "the detachment wider or the base deeper");
    }
}

} // namespace

Curve extended_detachment(const FootwallRequest& request) {
    assert(!request.detachment.empty());
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
    BlockMesh mesh =
        request.detachment.empty() ? flat_blocks(request) : DetachmentBlocks(request).mesh();
    require_unfolded(mesh);
    return mesh;
}

} // namespace listric::fem
