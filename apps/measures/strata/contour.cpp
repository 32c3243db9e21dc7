#include "apps/measures/strata/contour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace listric::measures {

using namespace dem;

double GridValues::at(Point p) const {
    const double x = (p.x - corner.x) / spacing, y = (p.y - corner.y) / spacing;
    if (!(x >= 0.0 && y >= 0.0 && x < static_cast<double>(columns - 1) &&
          y < static_cast<double>(rows - 1)))
        return std::numeric_limits<double>::quiet_NaN();
    const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
    const double s = x - static_cast<double>(column), t = y - static_cast<double>(row);
    const float* low = values.data() + row * columns + column;
    const float* high = low + columns;
    return (1.0 - t) * ((1.0 - s) * low[0] + s * low[1]) + t * ((1.0 - s) * high[0] + s * high[1]);
}

namespace {

/// Edges of the grid: that to the right of place k is 2 k, that above it 2 k + 1.
class ContourLines {
public:
    ContourLines(const GridValues& grid, double level) : grid_(grid), level_(level) {
        for (std::size_t row = 0; row + 1 < grid.rows; ++row)
            for (std::size_t column = 0; column + 1 < grid.columns; ++column)
                if (is_crossed(row * grid.columns + column))
                    cross_square(row * grid.columns + column);
        std::ranges::sort(steps_, {}, &Step::from);
    }

    std::vector<Polyline> lines() {
        std::vector<std::uint32_t> ends;
        for (const Step& step : steps_)
            ends.push_back(step.to);
        std::ranges::sort(ends);
        std::vector<Polyline> found;
        for (Step& step : steps_)
            if (!std::ranges::binary_search(ends, step.from))
                found.push_back(follow(step));
        for (Step& step : steps_)
            if (!step.taken)
                found.push_back(follow(step));
        return found;
    }

private:
    /// Step of a line through a square, from edge to edge.
    struct Step {
        std::uint32_t from, to;
        bool taken = false;
    };

    /// Whether some of a square's corners are high, but not all. What is not known is not high.
    bool is_crossed(std::size_t k) const {
        const float* low = grid_.values.data() + k;
        const float* above = low + grid_.columns;
        const int high =
            (low[0] > level_) + (low[1] > level_) + (above[0] > level_) + (above[1] > level_);
        return high % 4 != 0;
    }

    void cross_square(std::size_t k) {
        const std::array<std::size_t, 4> corners{k, k + 1, k + grid_.columns + 1,
                                                 k + grid_.columns};
        // Edges of the square, each from its corner to the next counter-clockwise.
        const std::array<std::size_t, 4> edges{2 * k, 2 * (k + 1) + 1, 2 * (k + grid_.columns),
                                               2 * k + 1};
        std::array<bool, 4> high{};
        double sum = 0.0;
        for (std::size_t c = 0; c < 4; ++c) {
            const float value = grid_.values[corners[c]];
            if (std::isnan(value))
                return;
            high[c] = value > level_;
            sum += value;
        }
        // Counter-clockwise a line leaves where values fall and enters where they rise: then the
        // larger are on its right.
        std::array<std::size_t, 2> rise{}, fall{};
        std::size_t rises = 0, falls = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            const bool from = high[c], to = high[(c + 1) % 4];
            if (!from && to)
                rise[rises++] = c;
            if (from && !to)
                fall[falls++] = c;
        }
        // In a saddle the middle says which corners belong together.
        const bool crossed = rises == 2 && ((sum > 4.0 * level_) == (fall[0] > rise[0]));
        for (std::size_t n = 0; n < rises; ++n)
            join(edges[rise[n]], edges[fall[crossed ? 1 - n : n]]);
    }

    void join(std::size_t from, std::size_t to) {
        steps_.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to)});
    }

    Point crossing(std::size_t edge) const {
        const std::size_t a = edge / 2, b = edge % 2 == 0 ? a + 1 : a + grid_.columns;
        const double share =
            (level_ - grid_.values[a]) / (double{grid_.values[b]} - grid_.values[a]);
        const std::size_t column = a % grid_.columns, row = a / grid_.columns;
        const Point p{grid_.corner.x + grid_.spacing * static_cast<double>(column),
                      grid_.corner.y + grid_.spacing * static_cast<double>(row)};
        const double step = share * grid_.spacing;
        return edge % 2 == 0 ? Point{p.x + step, p.y} : Point{p.x, p.y + step};
    }

    /// None: the line ends at that edge.
    Step* step_from(std::uint32_t edge) {
        const auto found = std::ranges::lower_bound(steps_, edge, {}, &Step::from);
        return found != steps_.end() && found->from == edge ? &*found : nullptr;
    }

    Polyline follow(Step& first) {
        Polyline line{crossing(first.from)};
        for (Step* step = &first; step && !step->taken; step = step_from(step->to)) {
            step->taken = true;
            line.push_back(crossing(step->to));
        }
        return line;
    }

    const GridValues& grid_;
    double level_;
    std::vector<Step> steps_; ///< by the edge they are from, which no two share
};

} // namespace

std::vector<Polyline> contours(const GridValues& grid, double level) {
    return ContourLines(grid, level).lines();
}

} // namespace listric::measures
