#include "apps/scene/scene.hpp"

#include "apps/scene/stages.hpp"

#include <algorithm>
#include <cmath>

namespace listric {

using namespace dem;

bool is_drawn_at(const Scene& scene, double extension) {
    return std::ranges::any_of(scene.output.figures, [&](double mark) {
        return std::abs(mark - extension) <= 0.5 * scene.output.interval;
    });
}

RigidBase make_rigid_base(const Scene& scene) {
    const Extent extent{scene.hanging_wall.length, scene.hanging_wall.thickness,
                        greatest_extension(scene)};
    const Motion motion = make_motion(scene);
    return scene.stretching ? make_stretching_box(*scene.stretching, extent, scene.basement, motion)
                            : make_halfgraben(*scene.detachment, extent, scene.basement, motion);
}

double hanging_wall_area(const Scene& scene) {
    const bool has_base =
        scene.stretching || (scene.detachment && !scene.detachment->segments.empty());
    return has_base ? hanging_wall_area(scene.hanging_wall,
                                        make_rigid_base(scene).surfaces.front().chain)
                    : 0.0;
}

std::size_t estimated_discs(const Scene& scene) {
    return disc_count(scene.hanging_wall, hanging_wall_area(scene));
}

} // namespace listric
