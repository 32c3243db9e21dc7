#include "dem/events/measure_circle.hpp"
#include "dem/numbers/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace listric::dem {

namespace {

using Members = std::span<const std::int32_t>;

constexpr int fewest = 3; ///< discs on a side of a cut

/// |dX1|^2 + |dX2|^2 over dX1 x dX2 of usable halves: 2 in a full circle, infinite for discs in
/// line.
constexpr double most_elongated = 4.0;

/// Sums over the discs of a part of the circle.
struct Part {
    double discs = 0.0;
    Point place, displacement; ///< m

    void add(Point at, Point u) {
        discs += 1.0;
        place = place + at;
        displacement = displacement + u;
    }
};

Part operator+(const Part& a, const Part& b) {
    return {a.discs + b.discs, a.place + b.place, a.displacement + b.displacement};
}

/// The discs of a circle.
class Circle {
public:
    Circle(const Displacements& s, Members members, Point centre)
        : s_(s), members_(members), centre_(centre) {
        if (s.compaction.empty() || members.empty())
            return;
        for (const std::int32_t member : members)
            compaction_ += s.compaction[static_cast<std::size_t>(member)];
        compaction_ /= static_cast<double>(members.size());
    }

    /// Calls visit(place, displacement) for every disc: the place from the centre, and the
    /// displacement without compaction, m.
    template <class Visit> void for_each(Visit&& visit) const {
        for (const std::int32_t member : members_) {
            const auto k = static_cast<std::size_t>(member);
            const Point place = Point{s_.x[k], s_.y[k]} - centre_;
            visit(place, Point{s_.ux[k], s_.uy[k] - compaction_ * place.y});
        }
    }

    /// Sums over all of them.
    Part all() const {
        Part part;
        for_each([&](Point place, Point u) { part.add(place, u); });
        return part;
    }

private:
    const Displacements& s_;
    Members members_;
    Point centre_;
    double compaction_ = 0.0;
};

/// Mean of one part less the mean of another.
struct Difference {
    Point place, displacement; ///< m

    Difference(const Part& a, const Part& b)
        : place((1.0 / a.discs) * a.place - (1.0 / b.discs) * b.place),
          displacement((1.0 / a.discs) * a.displacement - (1.0 / b.discs) * b.displacement) {}
};

/// Slip of the plane along t, m, from the halves on both sides of it and of the plane across it.
double slip_along(Point t, const Difference& sides, const Difference& ends, double diameter) {
    const Point x1 = sides.place, x2 = ends.place;
    const double area = cross(x1, x2);
    if (dot(x1, x1) + dot(x2, x2) > most_elongated * std::abs(area))
        return 0.0;
    // H v, where v = a dX1 + b dX2
    const auto gradient_along = [&](Point v) {
        const double a = cross(v, x2) / area, b = cross(x1, v) / area;
        return a * sides.displacement + b * ends.displacement;
    };
    const Point n{-t.y, t.x};
    const double strain = dot(t, gradient_along(n)) + dot(n, gradient_along(t));
    return strain * std::min(half_distance * diameter, std::sqrt(std::abs(area)));
}

/// Slip of two halves along a plane, besides a common translation and rotation.
struct TwoBlocks {
    double slip = 0.0;      ///< of the left half against the right one, m
    double explained = 0.0; ///< sum of squared displacements less those that it leaves, m^2
};

/// @param t  direction of the plane
TwoBlocks fit_two_blocks(const Circle& circle, Point t) {
    const auto side_of = [&](Point place) { return cross(t, place) > 0.0 ? 0.5 : -0.5; };
    const Part all = circle.all();
    double sides = 0.0;
    circle.for_each([&](Point place, Point) { sides += side_of(place); });
    // Least squares of u = rotation * r + slip * q, all less their means.
    double rr = 0.0, rq = 0.0, qq = 0.0, ru = 0.0, qu = 0.0;
    circle.for_each([&](Point place, Point displacement) {
        const Point dx = place - (1.0 / all.discs) * all.place;
        const Point u = displacement - (1.0 / all.discs) * all.displacement;
        const Point r{-dx.y, dx.x}, q = (side_of(place) - sides / all.discs) * t;
        rr += dot(r, r);
        rq += dot(r, q);
        qq += dot(q, q);
        ru += dot(r, u);
        qu += dot(q, u);
    });
    const double determinant = rr * qq - rq * rq;
    return {(rr * qu - rq * ru) / determinant,
            (qq * ru * ru - 2.0 * rq * ru * qu + rr * qu * qu) / determinant};
}

double angle_of(std::span<const Point> planes, std::size_t plane) {
    return pi * static_cast<double>(plane) / static_cast<double>(planes.size());
}

} // namespace

std::vector<Point> plane_directions(int angles) {
    std::vector<Point> planes;
    for (int a = 0; a < angles; ++a) {
        const double angle = pi * a / angles;
        planes.push_back({cosine(angle), sine(angle)});
    }
    return planes;
}

FaultSegment most_active_plane(const Displacements& s, Members members, Point centre,
                               double diameter, std::span<const Point> planes) {
    const Circle circle(s, members, centre);
    FaultSegment best{centre};
    for (std::size_t a = 0; 2 * a < planes.size(); ++a) { // beyond are the conjugate planes
        const Point t = planes[a];
        Part quarter[2][2]; // [left of the plane][behind the centre]
        circle.for_each([&](Point place, Point u) {
            quarter[cross(t, place) > 0.0][dot(t, place) < 0.0].add(place, u);
        });
        const Part left = quarter[1][0] + quarter[1][1], right = quarter[0][0] + quarter[0][1];
        const Part behind = quarter[0][1] + quarter[1][1], ahead = quarter[0][0] + quarter[1][0];
        if (std::min({left.discs, right.discs, behind.discs, ahead.discs}) < fewest)
            continue;
        const double slip = slip_along(t, {left, right}, {behind, ahead}, diameter);
        if (std::abs(slip) > std::abs(best.slip)) {
            best.angle = angle_of(planes, a);
            best.slip = slip;
        }
    }
    return best;
}

FaultSegment along_fault(const Displacements& s, Members members, const FaultSegment& f,
                         std::span<const Point> planes) {
    const Circle circle(s, members, f.centre);
    FaultSegment along = f;
    double most = 0.0;
    for (std::size_t a = 0; a < planes.size(); ++a) {
        const TwoBlocks fit = fit_two_blocks(circle, planes[a]);
        if (fit.explained > most) {
            most = fit.explained;
            along.angle = angle_of(planes, a);
            along.slip = std::copysign(f.slip, fit.slip);
        }
    }
    return along;
}

double slip_bound(const Displacements& s, Members members, Point centre) {
    const Circle circle(s, members, centre);
    const Part all = circle.all();
    if (all.discs == 0.0)
        return 0.0;
    const Point middle = (1.0 / all.discs) * all.place;
    double turn = 0.0, inertia = 0.0;
    circle.for_each([&](Point place, Point u) {
        turn += cross(place - middle, u);
        inertia += dot(place - middle, place - middle);
    });
    const double rotation = inertia > 0.0 ? turn / inertia : 0.0;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Point low{infinity, infinity}, high{-infinity, -infinity};
    circle.for_each([&](Point place, Point displacement) {
        const Point dx = place - middle;
        const Point u = displacement - rotation * Point{-dx.y, dx.x};
        low = {std::min(low.x, u.x), std::min(low.y, u.y)};
        high = {std::max(high.x, u.x), std::max(high.y, u.y)};
    });
    // With e = most_elongated, d this difference and A = dX1 x dX2: |a|, |b| of slip_along are
    // |dX2| / A and |dX1| / A, so the strain is at most 2 d (|dX1| + |dX2|) / A and thus
    // 2 d sqrt(2 e / A); the slip, at most sqrt(A) times as large, is at most 2 d sqrt(2 e).
    return 2.0 * std::sqrt(2.0 * most_elongated) * norm(high - low);
}

} // namespace listric::dem
