#include "apps/scene/scene_checks.hpp"

#include "apps/scene/toml/tables.hpp"
#include "apps/support/words/spelling.hpp"
#include "apps/support/words/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace listric {

using namespace dem;

std::string objection_to_pieces(const DetachmentParameters& detachment) {
    if (detachment.segments.empty())
        return "has no arc and no line, needs at least one, for example "
               "segments = [{arc = {radius_m = 15000.0, end_dip_deg = 0.0}}]";
    double dip = detachment.start_dip;
    if (const auto first = detachment.segments.front().start_dip; first && *first != dip)
        return fmt::format("does not join: the first piece has start_dip_deg = {}, but the "
                           "detachment start_dip_deg = {}; both are the dip at the breakaway, give "
                           "one",
                           text(*first), text(dip));
    for (const DetachmentSegment& segment : detachment.segments) {
        const double start = segment.start_dip.value_or(dip);
        const bool is_arc = segment.kind == DetachmentSegment::Kind::arc;
        dip = is_arc ? segment.end_dip : start;
        if (is_arc && start == dip)
            return fmt::format("has an arc that starts and ends with a dip of {} degrees, needs an "
                               "end_dip_deg that differs, or a line",
                               text(dip));
    }
    return dip == 0.0 ? ""
                      : fmt::format("ends with a dip of {} degrees, allowed: 0; let the last arc "
                                    "have end_dip_deg = 0.0",
                                    text(dip));
}

Entry entry_at(const toml::table& document, const std::string& path) {
    const toml::node* node = document.at_path(path).node();
    if (!node)
        node = document.at_path(path.substr(0, path.find('.'))).node();
    if (!node)
        node = document.get(path.substr(0, path.find_first_of(".[")));
    return {node ? *node : document, path};
}

namespace {

void check_detachment(const Scene& scene, const toml::table& document) {
    const DetachmentParameters& detachment = *scene.detachment;
    const double thickness = scene.hanging_wall.thickness;
    const double tolerance = std::min(1.0, 1e-3 * thickness); // m
    const Entry entry = entry_at(document, "detachment.segments");
    if (const std::string why = objection_to_pieces(detachment); !why.empty())
        fail(entry, why);
    if (scene.picked_fault)
        if (const std::string why = too_sharp(detachment, scene.hanging_wall.mean_radius);
            !why.empty()) {
            const bool drawn = document.at_path("detachment.svg").node() != nullptr;
            const Entry file = entry_at(document, drawn ? "detachment.svg" : "detachment.csv");
            fail(file, fmt::format("{}: {}", file.node.value_or(""), why));
        }
    const double depth =
        -make_rigid_base(scene).surfaces.front().chain.back().end.y; // it never rises
    if (scene.picked_fault && std::abs(depth - thickness) > tolerance)
        fail(entry_at(document, "hanging_wall.thickness_m"),
             fmt::format("the picked fault is flat at a depth of {:.1f} m; leave out "
                         "hanging_wall.thickness_m, which follows from it",
                         depth));
    if (std::abs(depth - thickness) > tolerance)
        fail(entry, fmt::format("reaches a depth of {:.1f} m, allowed: hanging_wall.thickness_m = "
                                "{} within {} m; change the thickness, or radii and lengths; an "
                                "arc of radius R from dip a to dip b descends R |cos b - cos a|",
                                depth, text(thickness), tolerance));
    if (!(hanging_wall_area(scene) > 0.0))
        fail(entry, "stays at the surface up to the moving wall, needs to descend before "
                    "hanging_wall.length_m");
}

/// That the ground before extension is one line, below the original surface.
void check_ground(const Scene& scene, const toml::table& document) {
    const HangingWallParameters& wall = scene.hanging_wall;
    if (!wall.ground.empty() && wall.ground_slope != 0.0)
        fail(entry_at(document, "hanging_wall.ground_slope_deg"),
             fmt::format("is {} beside hanging_wall.ground; both shape the ground, give one",
                         text(wall.ground_slope)));
    const bool falls_left = wall.ground_slope < 0.0;
    if (wall.ground_slope != 0.0 &&
        (falls_left ? wall.ground_slope_from <= 0.0 : wall.ground_slope_from >= wall.length))
        fail(entry_at(document, "hanging_wall.ground_slope_from_m"),
             fmt::format("is {}, but with ground_slope_deg = {} the ground falls to the {} of it, "
                         "allowed: {}",
                         text(wall.ground_slope_from), text(wall.ground_slope),
                         falls_left ? "left" : "right",
                         falls_left ? "above 0"
                                    : "below hanging_wall.length_m = " + text(wall.length)));
    for (std::size_t k = 0; k < wall.ground.size(); ++k) {
        const Entry point = entry_at(document, fmt::format("hanging_wall.ground[{}]", k));
        if (wall.ground[k].y > wall.thickness)
            fail(point, fmt::format("is {} deep, allowed: at most hanging_wall.thickness_m = {}",
                                    text(wall.ground[k].y), text(wall.thickness)));
        if (k > 0 && wall.ground[k].x <= wall.ground[k - 1].x)
            fail(point, fmt::format("is not sorted: x = {} comes after {}; sort the points by x, "
                                    "each x once",
                                    text(wall.ground[k].x), text(wall.ground[k - 1].x)));
    }
}

void check_resolution(const Scene& scene, const toml::table& document) {
    constexpr double fewest = 100, most = 5e6;
    const double radius = scene.hanging_wall.mean_radius;
    const double area = hanging_wall_area(scene);
    // Counted with so many discs that the count's being whole does not matter.
    HangingWallParameters fine = scene.hanging_wall;
    fine.mean_radius = 1e-4 * std::sqrt(area);
    const double fine_discs = static_cast<double>(disc_count(fine, area));
    const auto radius_for = [&](double discs) {
        return fine.mean_radius * std::sqrt(fine_discs / discs);
    };
    const auto refuse = [&](const char* what, const char* bound, double allowed, double discs) {
        fail(entry_at(document, "hanging_wall.mean_radius_m"),
             fmt::format("too {} ({}), gives {} discs, allowed: at {} {:.4g} ({} discs)", what,
                         text(radius), estimated_discs(scene), bound, allowed, text(discs)));
    };
    // The advised value keeps away from the bound, because it is rounded.
    if (radius > radius_for(fewest))
        refuse("large", "most", 0.999 * radius_for(fewest), fewest);
    if (radius < radius_for(most))
        refuse("small", "least", 1.001 * radius_for(most), most);
}

/// That the base on which discs slide is there, once.
void check_base(const Scene& scene, const toml::table& document) {
    if (!document.contains("hanging_wall"))
        fail(entry_at(document, "hanging_wall"), "is missing, every scene needs [hanging_wall]");
    if (scene.detachment && scene.stretching)
        fail(entry_at(document, "stretching"),
             "stands in place of [detachment]; leave out one of the two");
    const auto brings_base = [](const EffectPart& part) { return part.effect->brings_base; };
    if (!scene.detachment && !scene.stretching && std::ranges::none_of(scene.effects, brings_base))
        fail(entry_at(document, "hanging_wall"),
             "needs [detachment], the surface on which it slides, or [stretching]; add one");
    if (scene.picked_fault && !scene.detachment)
        fail(entry_at(document, "picked_fault"),
             "has the points that a [detachment] was fitted to, which the scene does not have; "
             "leave out [picked_fault]");
    if (scene.detachment)
        check_detachment(scene, document);
}

void check_needs(const Scene& scene, const toml::table& document, EffectList effects) {
    const std::vector<SceneTable> tables = scene_tables(effects);
    for (const EffectPart& part : scene.effects)
        for (const std::string_view needed : needed_tables(*part.effect, effects)) {
            const auto table = std::ranges::find(tables, needed, &SceneTable::name);
            if (table == tables.end() || !table->in(scene))
                fail(entry_at(document, std::string(part.effect->name)),
                     fmt::format("needs [{1}], which the scene does not have; add [{1}] or leave "
                                 "out [{0}]",
                                 part.effect->name, needed));
        }
}

/// That at most one effect moves the base's nodes.
void check_drivers(const Scene& scene, const toml::table& document) {
    const Effect* first = nullptr;
    for (const EffectPart& part : scene.effects) {
        if (!part.effect->drive_base)
            continue;
        if (first)
            fail(entry_at(document, std::string(part.effect->name)),
                 fmt::format("beside [{}]; both move the detachment, give one", first->name));
        first = part.effect;
    }
}

/// That picked points have both coordinates: files have them, but a scene.toml may be edited.
void check_picks(const Scene& scene, const toml::table& document) {
    const auto check = [&](const char* path, std::size_t x, std::size_t depth) {
        if (x != depth)
            fail(entry_at(document, path),
                 fmt::format("has points of {} x_m and {} depth_m, needs as many", x, depth));
    };
    if (scene.picked_fault)
        check("picked_fault", scene.picked_fault->x.size(), scene.picked_fault->depth.size());
    if (!scene.observed)
        return;
    for (const PickedLine& line : scene.observed->horizons)
        check("observed.horizon_lines", line.x.size(), line.depth.size());
    for (const PickedLine& line : scene.observed->faults)
        check("observed.fault_lines", line.x.size(), line.depth.size());
}

/// That a picture has its place.
void check_picture(const Observed& observed, const toml::table& document) {
    if (observed.picture.empty())
        return;
    if (const std::string why = objection_to_corners(observed.corners); !why.empty())
        fail(entry_at(document, "observed.corners_m"),
             fmt::format("{}; needs [x0, z0, x1, z1] in metres, of the picture's upper left and "
                         "lower right corner, depth positive down",
                         why));
}

} // namespace

void check_name(const Heading& heading, const toml::table& document,
                const std::filesystem::path& file) {
    const std::string why = objection_to_name(heading.name);
    if (why.empty())
        return;
    constexpr const char* allowed = "allowed: the name of one folder, such as \"basin-1\"; "
                                    "--output writes elsewhere";
    if (const toml::node* node = document.get("name"))
        fail({*node, "name"}, fmt::format("\"{}\" {}, {}", heading.name, why, allowed));
    fail(fmt::format("{}:1: name: the file's own, \"{}\", {}, {}; add name = \"...\" or rename the "
                     "file",
                     file.string(), heading.name, why, allowed));
}

void check_scene(const Scene& scene, const toml::table& document, EffectList effects) {
    check_picks(scene, document);
    if (scene.observed)
        check_picture(*scene.observed, document);
    check_ground(scene, document);
    check_base(scene, document);
    check_needs(scene, document, effects);
    check_drivers(scene, document);
    check_resolution(scene, document);
    const Refuse refuse = [&](const std::string& path, const std::string& message) {
        fail(entry_at(document, path), message);
    };
    for (const EffectPart& part : scene.effects)
        if (part.effect->check)
            part.effect->check(scene, refuse);
}

void take_out_former_keys(toml::table& document, EffectList effects) {
    for (const Effect* effect : effects)
        for (const FormerKey& former : effect->former) {
            const std::string path = fmt::format("{}.{}", effect->name, former.key);
            const toml::node* const node = document.at_path(path).node();
            if (!node)
                continue;
            const std::string word = node->value_or(std::string());
            if (former.stays.empty())
                fail({*node, path}, fmt::format("is no key any more, use {}", former.instead));
            if (word != former.stays)
                fail({*node, path},
                     fmt::format("is no key any more{}, allowed: {}, which is done without it; "
                                 "leave it out",
                                 word.empty() ? "" : ", and " + quoted(word) + " is gone",
                                 quoted(std::string(former.stays))));
            document[effect->name].as_table()->erase(former.key);
        }
}

} // namespace listric
