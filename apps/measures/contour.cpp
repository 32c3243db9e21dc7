#include "apps/measures/contour.hpp"

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
    ContourLines(const GridValues& grid, double level)
        : grid_(grid), level_(level), next_(2 * grid.values.size(), none),
          before_(2 * grid.values.size(), none) {
        for (std::size_t row = 0; row + 1 < grid.rows; ++row)
            for (std::size_t column = 0; column + 1 < grid.columns; ++column)
                cross_square(row * grid.columns + column);
    }

    std::vector<Polyline> lines() {
        std::vector<Polyline> found;
        for (std::size_t edge = 0; edge < next_.size(); ++edge)
            if (next_[edge] != none && before_[edge] == none)
                found.push_back(follow(edge));
        for (std::size_t edge = 0; edge < next_.size(); ++edge)
            if (next_[edge] != none)
                found.push_back(follow(edge));
        return found;
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

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
        next_[from] = static_cast<std::uint32_t>(to);
        before_[to] = static_cast<std::uint32_t>(from);
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

    Polyline follow(std::size_t edge) {
        Polyline line{crossing(edge)};
        while (next_[edge] != none) {
            const std::size_t to = next_[edge];
            next_[edge] = none;
            edge = to;
            line.push_back(crossing(edge));
        }
        return line;
    }

    const GridValues& grid_;
    double level_;
    std::vector<std::uint32_t> next_, before_; ///< by edge: the next edge of its line
};

} // namespace

std::vector<Polyline> contours(const GridValues& grid, double level) {
    return ContourLines(grid, level).lines();
}

} // namespace listric::measures
