#pragma once

#include "dem/base.hpp"
#include "dem/genesis/genesis.hpp"

#include <optional>
#include <vector>

namespace listric::dem {

/// One piece of the detachment, joined tangentially to the piece before unless it says otherwise.
struct DetachmentSegment {
    enum class Kind { arc, line } kind = Kind::line;
    double radius = 0.0;                  ///< arc: radius, m
    double end_dip = 0.0;                 ///< arc: dip at the far end, degrees
    double length = 0.0;                  ///< line: length, m
    std::optional<double> start_dip = {}; ///< dip at the near end, degrees; default: no kink
};

/// Pieces of the detachment; `start_dip` as in DetachmentSegment.
DetachmentSegment arc_to_dip(double end_dip, double radius, std::optional<double> start_dip = {});
DetachmentSegment straight(double length, std::optional<double> start_dip = {});

/// What of the base moves with the right wall, and pulls; what rests resists.
enum class BaseKind {
    sheet, ///< the whole detachment
    rests, ///< nothing: the footwall is at rest
    ramp   ///< the flat alone, from the sole-out point on
};

/// The rigid surface on which the hanging wall slides, from the breakaway at (0, 0) down.
struct DetachmentParameters {
    double start_dip = 90.0; ///< dip at the breakaway, degrees
    BaseKind base = BaseKind::sheet;
    double friction = 0.5; ///< between discs and the base
    FrictionRule friction_rule = FrictionRule::wall;
    std::vector<DetachmentSegment> segments;
    /// Length of level ground behind the breakaway, at rest whatever the base does, m; none: a
    /// backstop stands there.
    std::optional<double> footwall_top = {};
    double footwall_friction = 0.5; ///< of that ground
};

/// A flat base that stretches uniformly between the walls, in place of a detachment: pure shear.
struct StretchingParameters {
    double friction = 0.3; ///< between discs and the base
};

/// A fault of rigid basement that cuts a flat base and dips to the right. The block on its right,
/// with the right wall, moves along it.
struct BasementFault {
    double x = 0.0;    ///< where it meets the base before it slips, m
    double dip = 60.0; ///< above 0, up to 90 degrees
    double slip = 1.0; ///< down the dip, over the extension; below 0: up, a reverse fault
};

/// A flat base between two walls, in place of a detachment. It stretches, a fault cuts it, both, or
/// it rests.
struct FlatBase {
    double friction = 0.3;  ///< between discs and the base
    bool stretches = false; ///< the walls move apart by the extension
    std::optional<BasementFault> fault = {};
};

/// Room that the base must offer: the hanging wall and how far it is pulled.
struct Extent {
    double length = 0.0;    ///< of the hanging wall, m
    double thickness = 0.0; ///< m
    double distance = 0.0;  ///< total extension, m

    /// x beyond the right wall's last position, m.
    double reach() const { return length + 1.5 * distance + thickness; }
};

/// The detachment's pieces end to end, continued by a flat to x = `reach`, m.
Chain detachment_chain(const DetachmentParameters& detachment, double reach);

/// x from which on a detachment's material runs with the wall, m.
double runs_from(BaseKind base, const DetachmentParameters& detachment);

/// Detachment, backstop above the breakaway or the footwall's top, and right wall.
RigidBase make_halfgraben(const DetachmentParameters& detachment, const Extent& extent,
                          const Material& material, const Motion& motion);

/// Puts a backstop in place of the footwall's top, for genesis.
void stand_backstop(RigidBase& base);

/// Flat base, left wall and right wall, and the basement's block on the right of a fault.
RigidBase make_box(const FlatBase& flat, const Extent& extent, const Material& material,
                   const Motion& motion);

/// Lets the detachment of a halfgraben be the line through the state's nodes (State::base_nodes)
/// and the backstop, or the footwall's top, go with the first of them.
/// @param degree  of the faces between nodes
void follow_nodes(RigidBase& base, int degree);

} // namespace listric::dem
