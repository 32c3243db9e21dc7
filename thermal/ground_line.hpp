#pragma once

#include "dem/base.hpp"
#include "dem/base/sediment_film.hpp"
#include "dem/state.hpp"

#include <functional>
#include <optional>
#include <vector>

namespace listric::thermal {

/// The ground that heat leaves through, from left to right: a line through points whose x ascends,
/// level beyond its ends. Two of one x are a cliff.
class GroundLine {
public:
    /// @param sediment  by point: see sediment(); none: nowhere
    explicit GroundLine(std::vector<dem::Point> points, std::vector<double> sediment = {});

    double height(double x) const;
    double depth(dem::Point p) const { return height(p.x) - p.y; }
    double highest() const;

    /// Thickness of the sediment that lies on rock without discs beside the hanging wall, m. It is
    /// below the ground.
    double sediment(double x) const;

    /// The nearest place within a distance, m, and the way into the rock from there; its distance
    /// is below 0 above the ground.
    std::optional<dem::Foot> nearest(dem::Point p, double within) const;

private:
    std::size_t after(double x) const;

    std::vector<dem::Point> points_;
    std::vector<double> sediment_;
};

/// What deposition and erosion have done to rock without discs, m: height that they have added, and
/// thickness of the sediment that is there.
struct Cover {
    double height = 0.0, sediment = 0.0;
};

/// Height of the ground beside the hanging wall before extension, and what comes onto it.
struct GroundBeside {
    double left = 0.0, right = 0.0; ///< m
    double wall_x = 0.0;            ///< right end of the hanging wall before extension, m
    std::function<Cover(double x)> cover = {};  ///< left of the hanging wall; none: nothing
    std::optional<dem::SedimentFilm> film = {}; ///< none: no sediment comes
};

/// The ground of the discs, of the base where it is bare, and of the rock on both sides. Right of
/// the wall, where no discs are, the sediment beside it goes on: up to its target, and no thicker
/// than there.
/// @param least_age  of sediment that counts: travel since it was laid down, m
GroundLine ground_line(const dem::State& state, const dem::RigidBase& base,
                       const GroundBeside& beside, double least_age = 0.0);

/// What the discs rest on, as it stands, as a line of points not further apart than `step`, m.
std::vector<dem::Point> base_points(const dem::State& state, const dem::RigidBase& base,
                                    double step);

/// Upward displacement of the base's nodes at x, m; 0 where it is rigid. Beyond their ends, where
/// nothing knows how the base bends, it falls to an e-th in 50 km, somewhat more than a plate of 10
/// km bends in.
double uplift_at(const dem::State& state, double x);

} // namespace listric::thermal
