#include "thermal/site_cells.hpp"

#include "dem/contacts/power_polygon.hpp"
#include "dem/threads/shared_loop.hpp"
#include "thermal/near_sites.hpp"

#include <algorithm>
#include <utility>

namespace listric::thermal {

using namespace dem;

void Sites::add(Point p, double disc_radius, double its_reach) {
    x.push_back(p.x);
    y.push_back(p.y);
    radius.push_back(disc_radius);
    reach.push_back(its_reach);
}

namespace {

/// Cuts one cell after the other.
class Cutter {
public:
    Cutter(const Sites& sites, const SectionEnds& ends, const GroundLine& ground,
           const NearSites& tree)
        : sites_(sites), ends_(ends), ground_(ground), tree_(tree), top_(ground.highest()),
          largest_(std::ranges::max(sites.radius)) {}

    const PowerPolygon& cut(std::size_t i) {
        const double whole = (ends_.right - ends_.left) + (top_ - ends_.floor) + sites_.reach[i];
        for (double reach = sites_.reach[i];; reach *= 2.0)
            if (cut_within(i, reach) || reach > whole)
                return polygon_;
    }

private:
    /// False if sites beyond the reach may still cut it.
    bool cut_within(std::size_t i, double reach) {
        const Point centre{sites_.x[i], sites_.y[i]};
        near_.clear();
        tree_.within(centre, reach, [&](std::int32_t site, double square) {
            if (square > 0.0)
                near_.emplace_back(square, site);
        });
        std::ranges::sort(near_);
        const double r = sites_.radius[i];
        // Cells at the ground end there, or they would reach over all of it.
        const auto foot = ground_.nearest(centre, reach);
        const double top = std::max(top_ - centre.y, foot ? foot->distance : 0.0) + sites_.reach[i];
        const PowerPolygon::Corner box[] = {
            {{ends_.left - centre.x, ends_.floor - centre.y}, facet_on_base},
            {{ends_.right - centre.x, ends_.floor - centre.y}, facet_open},
            {{ends_.right - centre.x, top}, facet_open},
            {{ends_.left - centre.x, top}, facet_open}};
        polygon_.begin(box);
        if (foot)
            polygon_.clip({-foot->normal.x, -foot->normal.y}, std::max(foot->distance, 0.5 * r),
                          facet_on_lid);
        double corners = polygon_.reach();
        const auto cannot_cut = [&](double square) {
            const double nearest_cut = 0.5 * (square + r * r - largest_ * largest_);
            return nearest_cut > 0.0 && nearest_cut * nearest_cut > corners * square;
        };
        for (const auto& [square, site] : near_) {
            if (cannot_cut(square))
                return true;
            const auto j = static_cast<std::size_t>(site);
            polygon_.clip({sites_.x[j] - centre.x, sites_.y[j] - centre.y},
                          0.5 * (square + r * r - sites_.radius[j] * sites_.radius[j]), site);
            corners = polygon_.reach();
        }
        return cannot_cut(reach * reach);
    }

    const Sites& sites_;
    const SectionEnds& ends_;
    const GroundLine& ground_;
    const NearSites& tree_;
    double top_, largest_;
    PowerPolygon polygon_;
    std::vector<std::pair<double, std::int32_t>> near_; // square of the distance; site
};

void add_parts(const PowerPolygon& polygon, double x, std::size_t cell,
               std::span<const double> lines, std::vector<CellPart>& parts) {
    double left = 0.0, right = 0.0;
    polygon.for_each_edge([&](const auto& a, const auto&) {
        left = std::min(left, a.p.x);
        right = std::max(right, a.p.x);
    });
    const auto next = std::ranges::upper_bound(lines, x + left) - lines.begin();
    for (auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(next, 1));
         k < lines.size() && lines[k - 1] < x + right; ++k) {
        PowerPolygon part = polygon;
        part.clip({1.0, 0.0}, lines[k] - x, facet_open);
        part.clip({-1.0, 0.0}, x - lines[k - 1], facet_open);
        double moment = 0.0;
        part.for_each_edge([&](const auto& a, const auto& b) {
            moment += (a.p.x + b.p.x) * (a.p.x * b.p.y - b.p.x * a.p.y) / 6.0;
        });
        if (const double area = part.cell().area; area > 0.0)
            parts.push_back({cell, k - 1, area, x + moment / area});
    }
}

} // namespace

CutCells cut_cells(const Sites& sites, const SectionEnds& ends, const GroundLine& ground,
                   std::span<const double> lines) {
    if (sites.count() == 0)
        return {{{}, {}, {0}}, {}};
    const NearSites tree(sites.x, sites.y);
    struct Piece {
        FacetedPiece faceted;
        std::vector<CellPart> parts;
    };
    std::vector<Piece> pieces = by_piece(sites.count(), 64, [&](std::size_t i, std::size_t end) {
        Piece piece;
        Cutter cutter(sites, ends, ground, tree);
        for (; i < end; ++i) {
            const PowerPolygon& polygon = cutter.cut(i);
            piece.faceted.add(polygon, i, sites.x, sites.y);
            add_parts(polygon, sites.x[i], i, lines, piece.parts);
        }
        return piece;
    });
    std::vector<CellPart> parts = joined(pieces, &Piece::parts);
    std::vector<FacetedPiece> faceted;
    for (Piece& piece : pieces)
        faceted.push_back(std::move(piece.faceted));
    return {joined_cells(faceted), std::move(parts)};
}

} // namespace listric::thermal
