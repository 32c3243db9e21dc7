#pragma once

#include "dem/numbers/point.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace listric::thermal {

/// A k-d tree: places near a point, whatever the distance. Where they are sparse a grid of one
/// width would have few, and where they are dense too many.
class NearSites {
public:
    NearSites(std::span<const double> x, std::span<const double> y)
        : x_(x), y_(y), order_(x.size()) {
        std::iota(order_.begin(), order_.end(), 0);
        sort(0, order_.size(), 0);
    }

    /// Calls visit(site, square of the distance) for all within a distance, in no order that
    /// counts.
    template <class Visit> void within(dem::Point p, double distance, Visit&& visit) const {
        search(0, order_.size(), 0, p, distance * distance, visit);
    }

private:
    static constexpr std::size_t leaf = 8;

    double coordinate(std::int32_t site, int depth) const {
        return depth % 2 == 0 ? x_[static_cast<std::size_t>(site)]
                              : y_[static_cast<std::size_t>(site)];
    }

    void sort(std::size_t begin, std::size_t end, int depth) {
        if (end - begin <= leaf)
            return;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t k) {
            return order_.begin() + static_cast<std::ptrdiff_t>(k);
        };
        std::nth_element(at(begin), at(middle), at(end), [&](std::int32_t a, std::int32_t b) {
            const double u = coordinate(a, depth), v = coordinate(b, depth);
            return u != v ? u < v : a < b;
        });
        sort(begin, middle, depth + 1);
        sort(middle + 1, end, depth + 1);
    }

    template <class Visit>
    void search(std::size_t begin, std::size_t end, int depth, dem::Point p, double square,
                Visit& visit) const {
        const auto look = [&](std::size_t k) {
            const auto i = static_cast<std::size_t>(order_[k]);
            const double dx = x_[i] - p.x, dy = y_[i] - p.y;
            if (dx * dx + dy * dy <= square)
                visit(order_[k], dx * dx + dy * dy);
        };
        if (end - begin <= leaf) {
            for (std::size_t k = begin; k < end; ++k)
                look(k);
            return;
        }
        const std::size_t middle = begin + (end - begin) / 2;
        const double beyond = (depth % 2 == 0 ? p.x : p.y) - coordinate(order_[middle], depth);
        look(middle);
        if (beyond <= 0.0 || beyond * beyond <= square)
            search(begin, middle, depth + 1, p, square, visit);
        if (beyond >= 0.0 || beyond * beyond <= square)
            search(middle + 1, end, depth + 1, p, square, visit);
    }

    std::span<const double> x_, y_;
    std::vector<std::int32_t> order_;
};

} // namespace listric::thermal
