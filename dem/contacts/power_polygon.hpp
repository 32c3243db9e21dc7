#pragma once

#include "dem/numbers/point.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace listric::dem {

/// The part of the plane that belongs to a disc: the points whose power |p - c|^2 - r^2 is least
/// for it. Unlike a disc's own area it contains its share of the pores, and cells fill the plane.
struct PowerCell {
    double area = 0.0;   ///< m^2
    bool closed = false; ///< bounded by other discs and the base on all sides
};

/// What is beyond the edge of a cell, if no disc.
inline constexpr std::int32_t facet_on_base = -1, facet_open = -2, facet_on_lid = -3;

/// A power cell about its centre while it is cut.
class PowerPolygon {
public:
    struct Corner {
        Point p;
        std::int32_t beyond; ///< the edge that leaves this corner, as PowerFacet::neighbour
    };

    /// Begins with any convex shape, counter-clockwise.
    void begin(std::span<const Corner> shape) { corners_.assign(shape.begin(), shape.end()); }

    /// Begins with the square that reaches `half` to each side.
    void begin(double half) {
        corners_ = {{{-half, -half}, facet_open},
                    {{half, -half}, facet_open},
                    {{half, half}, facet_open},
                    {{-half, half}, facet_open}};
    }

    /// Keeps what has n . p <= offset.
    void clip(Point n, double offset, std::int32_t beyond) {
        scratch_.clear();
        for (std::size_t k = 0; k < corners_.size(); ++k) {
            const Corner& a = corners_[k];
            const Corner& b = corners_[(k + 1) % corners_.size()];
            const double outside_a = n.x * a.p.x + n.y * a.p.y - offset;
            const double outside_b = n.x * b.p.x + n.y * b.p.y - offset;
            if (outside_a <= 0.0)
                scratch_.push_back(a);
            if ((outside_a <= 0.0) == (outside_b <= 0.0))
                continue;
            const double share = outside_a / (outside_a - outside_b);
            const Point cut{a.p.x + share * (b.p.x - a.p.x), a.p.y + share * (b.p.y - a.p.y)};
            scratch_.push_back({cut, outside_a <= 0.0 ? beyond : a.beyond});
        }
        corners_.swap(scratch_);
    }

    PowerCell cell() const {
        double twice = 0.0;
        bool closed = true;
        for_each_edge([&](const Corner& a, const Corner& b) {
            twice += a.p.x * b.p.y - a.p.y * b.p.x;
            closed = closed && a.beyond != facet_open;
        });
        return {0.5 * twice, closed && corners_.size() > 2};
    }

    /// Square of the greatest distance of a corner from the centre, m^2.
    double reach() const {
        double greatest = 0.0;
        for (const Corner& c : corners_)
            greatest = std::max(greatest, c.p.x * c.p.x + c.p.y * c.p.y);
        return greatest;
    }

    /// Calls visit(a, b) for the corners of every edge.
    template <class Visit> void for_each_edge(Visit&& visit) const {
        for (std::size_t c = 0; c < corners_.size(); ++c)
            visit(corners_[c], corners_[(c + 1) % corners_.size()]);
    }

private:
    std::vector<Corner> corners_, scratch_;
};

} // namespace listric::dem
