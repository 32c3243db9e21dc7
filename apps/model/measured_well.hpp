#pragma once

#include "apps/scene/parameters/effect.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

// What wells have in common, whatever an effect measures in them. A disc has x and depth, a point
// of a well x and y.

namespace listric {

/// The first of the deepest discs; null: there are none.
template <class Disc> const Disc* deepest_of(const std::vector<Disc>& discs) {
    const auto deepest = std::ranges::max_element(discs, {}, &Disc::depth);
    return deepest == discs.end() ? nullptr : &*deepest;
}

/// The depocentre and, from there toward the moving wall, the first place where the sediment's
/// floor is half as deep.
template <class Disc>
std::vector<WellPlace> places_of_wells(const std::vector<Disc>& discs, double right_end) {
    constexpr double half = 500.0; // m, of where the floor is looked for
    const Disc* const deepest = deepest_of(discs);
    if (!deepest)
        return {};
    const auto floor_about = [&](double x) {
        double floor = 0.0;
        for (const Disc& disc : discs)
            if (std::abs(disc.x - x) <= half)
                floor = std::max(floor, disc.depth);
        return floor;
    };
    std::vector<WellPlace> places{{"depocentre", deepest->x}};
    const double half_as_deep = 0.5 * floor_about(deepest->x);
    for (double x = deepest->x; x < right_end; x += half)
        if (const double floor = floor_about(x); floor > 0.0 && floor <= half_as_deep) {
            places.push_back({"flank", x});
            break;
        }
    return places;
}

/// A well whose points a function finds.
/// @param measures  of a point
template <class Point, const auto& measures,
          std::vector<Point> (*well_at)(const Observation& now, double x)>
MeasuredWell measured_well(std::vector<WellPlace> (*places)(const Observation& now)) {
    MeasuredWell well{{}, places, nullptr, nullptr};
    for (const Measure<Point>& measure : measures)
        well.parts.push_back(measure.quantity());
    well.numbers = [](const Observation& now, double x) {
        std::vector<NamedNumbers> rows;
        for (const Point& point : well_at(now, x)) {
            NamedNumbers& numbers = rows.emplace_back();
            for (const Measure<Point>& measure : measures)
                if (const auto value = measure.value(point))
                    numbers.emplace_back(measure.name, *value);
        }
        return rows;
    };
    well.points = [](const Observation& now, double x) {
        std::vector<dem::Point> points;
        for (const Point& point : well_at(now, x))
            points.push_back({point.x, point.y});
        return points;
    };
    return well;
}

} // namespace listric
