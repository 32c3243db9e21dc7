#include "apps/measures/paper/block_edges.hpp"

#include "apps/measures/basin/kinematics.hpp"
#include "apps/measures/paper/blocks.hpp"
#include "apps/measures/rigid_motion.hpp"
#include "apps/measures/split.hpp"
#include "dem/numbers/units.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace listric::measures {

using namespace dem;

namespace {

// Numbers chosen on made fields (tests/verification/measures/block_edges_test.cpp) and on seeds 1
// to 10.
constexpr double least_layer = 400.0;   ///< m
constexpr double layer_diameters = 2.0; ///< or this, if it is more
constexpr double most_off = 120.0;      ///< discs of a block are off its motion by at most, m
constexpr double off = 0.03;            ///< and over the extension in which it moved
constexpr double core_width = 5e3;      ///< of the outer block, at the moving wall, m
constexpr double behind = 3e3;          ///< an edge, discs whose turn is that of the edge, m
/// Height over the flat, of its depth, below which the edge is not followed: there rock that comes
/// round the bend moves as the outer block does, to `off`.
constexpr double around_bend = 1.0 / 7.0;
constexpr double most_wrong = 0.25;      ///< points of a layer on the wrong side of an edge
constexpr std::size_t fewest_layers = 6; ///< of an edge that has a shape

/// The best parabola through points, as an offset from an axis.
class Parabola {
public:
    Parabola(std::span<const Point> points, Point axis)
        : along_(unit(axis)), across_{-along_.y, along_.x} {
        const auto n = static_cast<double>(points.size());
        for (const Point p : points)
            middle_ = middle_ + (1.0 / n) * p;
        double square = 0.0, cube = 0.0, slope = 0.0;
        for (const Point p : points) {
            const double s = dot(p - middle_, along_), w = dot(p - middle_, across_);
            square += s * s;
            cube += s * s * s;
            slope += s * w;
        }
        // Polynomials that are orthogonal over the points.
        slope_ = slope / square;
        skew_ = cube / square;
        offset_ = square / n;
        double all = 0.0, bow = 0.0;
        for (const Point p : points) {
            const double b = bent(dot(p - middle_, along_));
            all += b * b;
            bow += b * dot(p - middle_, across_);
        }
        bow_ = bow / all;
    }

    /// x where it comes to a height, m.
    double x_at(double y) const {
        constexpr int steps = 10; // Newton's; the curve is almost straight
        double s = (y - middle_.y) / along_.y;
        for (int n = 0; n < steps; ++n)
            s -= (at(s).y - y) / (along_.y + (slope_ + bow_ * (2.0 * s - skew_)) * across_.y);
        return at(s).x;
    }

private:
    double bent(double s) const { return s * s - skew_ * s - offset_; }
    Point at(double s) const {
        return middle_ + s * along_ + (slope_ * s + bow_ * bent(s)) * across_;
    }

    Point along_, across_, middle_;
    double slope_ = 0.0, bow_ = 0.0, skew_ = 0.0, offset_ = 0.0;
};

/// The longest part of an edge without a step between layers that is flatter than one in five: a
/// layer above the block's top, or with a hole in it, has its edge elsewhere.
Polyline without_steps(const Polyline& edge) {
    constexpr double flattest = 5.0; // dx over dy
    std::size_t best = 0, longest = 0;
    for (std::size_t begin = 0, k = 0; k < edge.size(); ++k) {
        if (k > 0 && std::abs(edge[k].x - edge[k - 1].x) > flattest * (edge[k - 1].y - edge[k].y))
            begin = k;
        if (k + 1 - begin > longest) {
            longest = k + 1 - begin;
            best = begin;
        }
    }
    const auto first = edge.begin() + static_cast<std::ptrdiff_t>(best);
    return {first, first + static_cast<std::ptrdiff_t>(longest)};
}

/// The basement's discs and where they were, m.
struct Basement {
    std::vector<std::size_t> rows;
    std::vector<Point> start, now;
};

Basement basement_of(const RunSoFar& run) {
    Basement rock;
    for (std::size_t i = 0; i < run.discs.x.size(); ++i)
        if (run.discs.stratum[i] == 0) {
            rock.rows.push_back(i);
            rock.start.push_back({run.discs.start_x[i], run.discs.start_y[i]});
            rock.now.push_back({run.discs.x[i], run.discs.y[i]});
        }
    return rock;
}

/// Where the discs that are there now were; basement is never added.
std::vector<Point> places_then(const RunSoFar& run, const Basement& rock, const DiscPlaces& then) {
    std::vector<Point> places;
    for (const std::size_t i : rock.rows) {
        const auto row = then.row_of[static_cast<std::size_t>(run.discs.id[i])];
        assert(row >= 0);
        places.push_back(
            {then.x[static_cast<std::size_t>(row)], then.y[static_cast<std::size_t>(row)]});
    }
    return places;
}

/// A block and the fault at its edge.
struct Block {
    const char* attitude; ///< of the fault
    BlockSide side;
    std::vector<char> core; ///< by disc of the basement
    double lowest = 0.0;    ///< height to which the edge is the fault's, m
};

/// The outer block and the head block, which may be none.
std::array<Block, 2> blocks_of(const RunSoFar& run, const Basement& rock, bool has_head) {
    const double flat = run.detachment.back().end.y;
    Block outer{"antithetic", BlockSide::right, {}, (1.0 - around_bend) * flat};
    Block head{"synthetic", BlockSide::left, std::vector<char>(rock.rows.size(), 0), 0.5 * flat};
    for (const Point p : rock.start)
        outer.core.push_back(p.x > run.setting.length - core_width);
    if (has_head)
        for (const std::size_t row : head_block(run.now, run.detachment, run.setting.thickness))
            head.core[static_cast<std::size_t>(std::ranges::lower_bound(rock.rows, row) -
                                               rock.rows.begin())] = 1;
    return {std::move(outer), std::move(head)};
}

/// The edge of a block and its discs.
struct Edge {
    std::vector<char> inside; ///< by disc of the basement
    Polyline points;
};

/// @param extension  between the moments
std::optional<Edge> find_edge(const Block& block, const std::vector<Point>& before,
                              const std::vector<Point>& after, Extension extension,
                              double diameter) {
    auto inside = followers(before, after, block.core, std::min(most_off, off * extension.m));
    if (!inside)
        return std::nullopt;
    Polyline points = block_edge(after, *inside, block.side, edge_layer(diameter), block.lowest);
    if (points.size() < fewest_layers)
        return std::nullopt;
    return Edge{std::move(*inside), std::move(points)};
}

/// Rotation since the start of the block's discs near its edge, degrees, counter-clockwise. None
/// for fewer than 8 discs.
std::optional<double> turn_behind(const Edge& edge, BlockSide side, const Basement& rock) {
    constexpr std::size_t fewest = 8;
    RigidMotion motion;
    for (std::size_t k = 0; k < rock.now.size(); ++k) {
        const Point p = rock.now[k];
        if (!edge.inside[k] || p.y > edge.points.front().y || p.y < edge.points.back().y)
            continue;
        const Point beside = *std::ranges::min_element(
            edge.points, {}, [&](Point q) { return std::abs(q.y - p.y); });
        const double distance = side == BlockSide::right ? p.x - beside.x : beside.x - p.x;
        if (distance > 0.0 && distance < behind)
            motion.add(rock.start[k], p);
    }
    if (motion.size() < fewest)
        return std::nullopt;
    motion.fit();
    return motion.angle() * 180.0 / pi;
}

constexpr Measure<Polyline> of_edge[] = {
    {"_dip_deg", "deg", "dip",
     "dip of the best straight line through a block's edge. Antithetic: outer block, above the "
     "lowest seventh of the flat's depth. Synthetic: head block, above half of it, where zones "
     "branch",
     [](const Polyline& edge) { return std::optional(dip_of(edge)); }},
    {"_bow", "1", "bow",
     "greatest distance of the best parabola through a block's edge, in the depths of the edge's "
     "dip, from its chord, over the chord, positive convex upward",
     [](const Polyline& edge) {
         return std::optional(curvature_of(edge) * norm(edge.back() - edge.front()) / 8.0);
     }},
};

/// Names of edges behind the attitude, and what they are the edges of.
struct KindOfEdge {
    const char* name;
    const char* label;
    const char* doc;
};
constexpr KindOfEdge kinds[] = {
    {"_edge", " block's edge since the start, ",
     "; the block since the start (discs within 3 % of the extension, at most 120 m, of its "
     "core's rigid motion)"},
    {"_active_edge", " block's edge in the last window, ",
     "; the block in the last window alone (discs within 3 % of the window's extension of its "
     "core's rigid motion), where the fault is active"}};

constexpr Quantity foot{
    "antithetic_edge_foot_m", "m", "foot of the outer block's edge beyond the sole-out",
    "place where the antithetic fault nucleated, beyond the point where the detachment soles out: "
    "the parabola through the outer block's edge since the start meets the flat there; less the "
    "extension"};
constexpr Quantity place{"antithetic_edge_x_m", "m", "outer block's edge, x",
                         "x of the outer block's edge since the start at half the flat's depth"};
constexpr Quantity shift{
    "antithetic_edge_shift", "1", "shift of the outer block's edge over extension",
    "change of `antithetic_edge_x_m` over that of extension, since half of the extension: 1 for a "
    "fault that moves with the wall"};
constexpr Quantity outer_turn{
    "antithetic_edge_turn_deg", "deg", "turn behind the outer block's edge",
    "rotation since the start, toward the detachment, of the outer block's discs within 3 km "
    "behind its edge in the last window"};
constexpr Quantity head_turn{
    "synthetic_edge_turn_over_head_block", "1",
    "turn behind the head block's edge over the block's",
    "rotation since the start of the head block's discs within 3 km behind its edge in the last "
    "window, over `rollover_tilt_deg`: 0 translated, 1 rotated with the block"};

std::string edge_name(const char* attitude, const KindOfEdge& kind, const Measure<Polyline>& m) {
    return std::string(attitude).append(kind.name).append(m.name);
}

/// Index of the past moment nearest to half of the extension; none before the second window.
std::optional<std::size_t> half_way(const RunSoFar& run) {
    std::optional<std::size_t> nearest;
    const auto distance = [&](std::size_t k) {
        return std::abs((run.past[k].places.extension - 0.5 * run.extension).m);
    };
    for (std::size_t k = 0; k < run.past.size(); ++k)
        if (run.past[k].places.extension.m > 0.0 && (!nearest || distance(k) < distance(*nearest)))
            nearest = k;
    return nearest;
}

/// Foot and shift of the outer block's edge since the start.
NamedNumbers measure_translation(const RunSoFar& run, const Basement& rock, const Block& block,
                                 const Edge& edge) {
    const double flat = run.detachment.back().end.y;
    NamedNumbers numbers;
    add(numbers, foot,
        edge_at(edge.points, flat) - run.extension.m - run.detachment.back().start.x);
    const double x = edge_at(edge.points, 0.5 * flat);
    add(numbers, place, x);
    if (const auto k = half_way(run)) {
        const DiscPlaces& then = run.past[*k].places;
        if (const auto former = find_edge(block, rock.start, places_then(run, rock, then),
                                          then.extension, run.diameter))
            add(numbers, shift,
                (x - edge_at(former->points, 0.5 * flat)) / (run.extension - then.extension).m);
    }
    return numbers;
}

} // namespace

std::optional<std::vector<char>> followers(std::span<const Point> before,
                                           std::span<const Point> after, std::span<const char> core,
                                           double tolerance) {
    constexpr std::size_t fewest = 20; // points of a core
    constexpr int rounds = 3;          // the last without those that the first ones found astray
    assert(before.size() == after.size() && core.size() == before.size());
    std::vector<char> inside(core.begin(), core.end());
    const auto all = std::ranges::count(core, char{1});
    for (int round = 0; round < rounds; ++round) {
        RigidMotion motion;
        for (std::size_t k = 0; k < before.size(); ++k)
            if (core[k] && inside[k])
                motion.add(before[k], after[k]);
        if (motion.size() < fewest)
            return std::nullopt;
        motion.fit();
        for (std::size_t k = 0; k < before.size(); ++k)
            inside[k] = norm(motion.move(before[k]) - after[k]) <= tolerance;
    }
    std::ptrdiff_t kept = 0;
    for (std::size_t k = 0; k < core.size(); ++k)
        kept += core[k] && inside[k];
    return 3 * kept >= 2 * all ? std::optional(std::move(inside)) : std::nullopt;
}

double edge_layer(double diameter) { return std::max(least_layer, layer_diameters * diameter); }

Polyline block_edge(std::span<const Point> points, std::span<const char> inside, BlockSide side,
                    double layer, double lowest) {
    assert(points.size() == inside.size() && layer > 0.0);
    const auto count = static_cast<std::size_t>(std::max(0.0, std::round(-lowest / layer)));
    std::vector<std::vector<std::size_t>> layers(count);
    for (std::size_t k = 0; k < points.size(); ++k)
        if (const double below = -points[k].y / layer; below >= 0.0)
            if (const auto n = static_cast<std::size_t>(below); n < count)
                layers[n].push_back(k);
    const double out = side == BlockSide::left ? 1.0 : -1.0;
    Polyline edge;
    // Within a layer an edge that dips gently goes far: the second time x is that beside the first
    // edge's parabola.
    for (int round = 0; round < 2; ++round) {
        std::optional<Parabola> beside;
        if (round > 0 && edge.size() >= fewest_layers)
            beside.emplace(edge, edge.back() - edge.front());
        const auto offset = [&](double y) { return beside ? beside->x_at(y) : 0.0; };
        edge.clear();
        for (std::size_t n = 0; n < count; ++n) {
            // From the block outward.
            std::vector<MarkedPlace> row;
            for (const std::size_t k : layers[n])
                row.push_back({out * (points[k].x - offset(points[k].y)), inside[k] != 0});
            const double middle = -(static_cast<double>(n) + 0.5) * layer;
            if (const auto split = best_split(std::move(row)); split && split->wrong <= most_wrong)
                edge.push_back({out * split->at + offset(middle), middle});
        }
        edge = without_steps(edge);
    }
    return edge;
}

double edge_at(const Polyline& edge, double y) {
    assert(edge.size() >= fewest_layers);
    double x = Parabola(edge, edge.back() - edge.front()).x_at(y);
    // Beyond the edge's end the axis is the chord as far as it is wanted.
    constexpr int rounds = 3;
    for (int n = 0; n < rounds && y < edge.back().y; ++n)
        x = Parabola(edge, Point{x, y} - edge.front()).x_at(y);
    return x;
}

std::vector<Polyline> trace_block_edges(const RunSoFar& run) {
    if (!run.setting.has_detachment || !(run.extension.m > 0.0))
        return {};
    const Basement rock = basement_of(run);
    const bool has_head =
        head_block_turns(run.detachment, run.extension.m) &&
        head_block_tilt(run.now, run.detachment, run.setting.thickness).has_value();
    std::vector<Polyline> edges;
    for (const Block& block : blocks_of(run, rock, has_head))
        if (auto edge = find_edge(block, rock.start, rock.now, run.extension, run.diameter))
            edges.push_back(std::move(edge->points));
    return edges;
}

NamedNumbers measure_block_edges(const RunSoFar& run, std::optional<double> rollover_tilt) {
    constexpr double least_tilt = 1.0; // degrees
    if (run.past.empty() || !run.setting.has_detachment || !(run.extension.m > 0.0))
        return {};
    const Basement rock = basement_of(run);
    const std::vector<Point> before = places_then(run, rock, run.past.back().places);
    const auto [outer, head] = blocks_of(run, rock, rollover_tilt.has_value());
    NamedNumbers numbers;
    for (const Block* block : {&outer, &head}) {
        const auto whole = find_edge(*block, rock.start, rock.now, run.extension, run.diameter);
        const auto active =
            find_edge(*block, before, rock.now, run.extension - run.past.back().places.extension,
                      run.diameter);
        const std::optional<Edge>* edges[] = {&whole, &active};
        for (std::size_t k = 0; k < std::size(kinds); ++k)
            if (*edges[k])
                for (const Measure<Polyline>& m : of_edge)
                    add(numbers, edge_name(block->attitude, kinds[k], m),
                        m.value((*edges[k])->points));
        const auto turn =
            active ? turn_behind(*active, block->side, rock) : std::optional<double>();
        if (block == &outer) {
            if (whole)
                append(numbers, measure_translation(run, rock, outer, *whole));
            add(numbers, outer_turn, turn);
        } else if (turn && *rollover_tilt > least_tilt) {
            add(numbers, head_turn, *turn / *rollover_tilt);
        }
    }
    return numbers;
}

std::vector<Quantity> block_edge_quantities() {
    struct Texts {
        std::string name, label, doc;
    };
    static const std::vector<Texts> texts = [] {
        std::vector<Texts> composed;
        for (const char* attitude : {"antithetic", "synthetic"})
            for (const KindOfEdge& kind : kinds)
                for (const Measure<Polyline>& m : of_edge)
                    composed.push_back({edge_name(attitude, kind, m),
                                        std::string(attitude).append(kind.label).append(m.label),
                                        std::string(m.doc).append(kind.doc)});
        return composed;
    }();
    std::vector<Quantity> all{foot, place, shift, outer_turn, head_turn};
    for (std::size_t k = 0; k < texts.size(); ++k)
        all.push_back(
            {texts[k].name, of_edge[k % std::size(of_edge)].unit, texts[k].label, texts[k].doc});
    return all;
}

} // namespace listric::measures
