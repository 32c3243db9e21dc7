// Traces the faults of points that are no discs: a grid with a straight fault through (0, 0) that
// dips by 60 degrees to the right and slips by 3 spacings. Prints dip, slip, throw and greatest
// distance from the truth, in spacings, of each.

#include <listric/measures.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace listric;

int main() {
    const double spacing = 10.0, slip = 30.0, dip = std::acos(0.5);
    const dem::Point down{std::cos(dip), -std::sin(dip)};
    measures::MovedPoints points;
    for (int i = -40; i <= 40; ++i)
        for (int j = -40; j <= 0; ++j) {
            const dem::Point at{spacing * i, spacing * j};
            const bool above = dem::cross(down, at) > 0.0;
            points.x.push_back(at.x);
            points.y.push_back(at.y);
            points.dx.push_back(above ? slip * down.x : 0.0);
            points.dy.push_back(above ? slip * down.y : 0.0);
        }
    for (const measures::TracedFault& fault : measures::trace_faults(points)) {
        double misfit = 0.0;
        for (const dem::Point& at : fault.trace.points)
            misfit = std::max(misfit, std::abs(dem::cross(down, at)) / spacing);
        std::printf("%.1f %.1f %.1f %.2f\n", fault.dip, fault.slip, fault.throw_down, misfit);
    }
}
