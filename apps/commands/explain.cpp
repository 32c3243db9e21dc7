#include "apps/commands/explain.hpp"

#include "apps/model/effects.hpp"
#include "apps/run/prediction.hpp"
#include "apps/scene/declaration.hpp"
#include "fem/plate.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace listric {

using namespace dem;

namespace {

std::string duration(double seconds) {
    if (seconds < 90.0)
        return fmt::format("{:.0f} s", seconds);
    if (seconds < 5400.0)
        return fmt::format("{:.1f} min", seconds / 60.0);
    if (seconds < 2 * 86400.0)
        return fmt::format("{:.1f} h", seconds / 3600.0);
    return fmt::format("{:.1f} d", seconds / 86400.0);
}

} // namespace

namespace {

/// A scene without discs is a matter of seconds.
std::string explain_flexure(const Scene& scene) {
    const ElasticBaseParameters& base = *scene.elastic_base;
    const double gravity = scene.gravity.value_or(GravityParameters{}).acceleration;
    const fem::Plate plate{base.young_modulus, base.poisson_ratio, base.elastic_thickness,
                           (base.mantle_density - base.infill_density) * gravity};
    return fmt::format(
        "{}: {}\n\nan elastic base without discs\n"
        "  elastic thickness {:g} km, rigidity {:.3g} N m, restoring {:.4g} Pa/m\n"
        "  flexural parameter {:.1f} km; {} elements of degree {} through the thickness\n"
        "  the load acts on the surface and nothing else does: deflections are relative to the\n"
        "  state without it; infill of {:g} kg/m3 fills them\n"
        "\na few seconds, with the plug-in for elastic bases (libdeal.ii-dev, petsc-dev)\n",
        scene.name, scene.description, base.elastic_thickness / 1e3, plate.rigidity(),
        plate.restoring, plate.alpha() / 1e3, base.cells, base.degree, base.infill_density);
}

} // namespace

/// What the footwall feels and what it does not.
std::string explain_elastic_base(const Scene& scene) {
    const ElasticBaseParameters& base = *scene.elastic_base;
    constexpr const char* schemes[] = {"modal", "lumped", "staggered", "strong"};
    std::string text = fmt::format(
        "elastic base\n"
        "  Te {:g} km, {:g} km thick, from x = {:g} to {:g} km; below Te the shear modulus is "
        "1/{:g},\n  but not within {:g} km of the detachment; scheme {}, every {} cycles\n"
        "  loaded by what changes in the discs' forces since they settled on it\n"
        "  loads that no disc carries\n"
        "    right of the right wall: the weight of the undisturbed hanging wall, up to where the\n"
        "    wall is; the wall takes this weight along\n"
        "    springs (density x gravity) where rock of other density moves in: {} kg/m3 above the\n"
        "    footwall and on the detachment, {} kg/m3 at the base\n"
        "    {}\n",
        base.elastic_thickness / 1e3, base.depth / 1e3, base.left / 1e3, base.right / 1e3,
        base.relaxation, base.skin_thickness / 1e3, schemes[static_cast<int>(base.scheme)],
        base.update_interval, base.crust_density, base.mantle_density - base.crust_density,
        base.infill_density > 0.0
            ? fmt::format("{} kg/m3 on the footwall's surface where it sinks", base.infill_density)
            : std::string("no infill of what sinks of the footwall's surface"));
    if (const auto& thinning = scene.lower_crust_thinning) {
        const double thinner = lower_crust_thinning(*thinning, scene.extension.distance);
        text += fmt::format(
            "    lower crust: {:g} km over {:g} km thins by {:.0f} m in the end; the mantle in its "
            "place\n    lowers a wide area by {:.0f} m\n",
            thinning->thickness / 1e3, thinning->width / 1e3, thinner,
            thinner * (base.mantle_density - base.crust_density) / base.mantle_density);
    }
    if (const auto& water = scene.basin_water)
        text += fmt::format("    basin: water of {} kg/m3 up to {:g} m\n", water->density,
                            water->level);
    if (const auto& erosion = scene.footwall_erosion)
        text += fmt::format("    footwall: over {:g} km to its target every {:g} a; {} kg/m3 go, "
                            "{} kg/m3 come\n",
                            erosion->width / 1e3, erosion->interval, base.crust_density,
                            erosion->sediment_density);
    return text + fmt::format("  not in the model: {}{}{}friction of the right wall;\n"
                              "  what leans on the backstop above the breakaway\n",
                              scene.footwall_erosion ? "" : "erosion of the footwall, ",
                              scene.lower_crust_thinning ? "" : "thinning of the lower crust, ",
                              scene.basin_water ? "" : "water, ");
}

std::string explain(const Scene& scene, int threads) {
    if (scene.flexure)
        return explain_flexure(scene);
    const CycleSpeed speed =
        measure_speed(estimated_discs(scene), threads, 1.0, scene.energy.has_value());
    const double rate = speed.disc_steps_per_second;
    const Prediction p = predict(scene, rate, threads);
    std::string text;
    const auto add = [&](auto format, const auto&... values) {
        text += fmt::format(fmt::runtime(format), values...) + "\n";
    };
    add("{}: {}", scene.name, scene.description);
    add("");
    Scene copy = scene;
    const std::vector<SceneTable> tables = scene_tables(copy);
    add("effects");
    for (const SceneTable& table : tables)
        if (table.is_effect)
            add("  {:<4} {:<20} {}", table.in_scene ? "on" : "off", table.name, table.doc);
    add("");
    add("size");
    add("  {} discs at the start, about {} at the end, mean radius {} m", p.discs_at_start,
        p.discs_at_end, scene.hanging_wall->mean_radius);
    add("  {:g} km of extension at {} m/a: {:g} Ma", scene.extension.distance / 1e3,
        scene.extension.rate, scene.extension.distance / scene.extension.rate / 1e6);
    add("  time step {:.3g} s, {:.3g} million cycles at {} m/s", p.time_step,
        static_cast<double>(p.cycles) / 1e6, scene.extension.speed);
    add("  {:.2g} disc-steps, about {:.0f} MB of memory", p.disc_steps, p.memory / 1e6);
    add("");
    if (scene.elastic_base)
        add("{}", explain_elastic_base(scene));
    if (scene.base_motion)
        add("the detachment moves as prescribed, at up to {:.2g} of the speed of extension\n",
            greatest_base_speed(*scene.base_motion, scene.extension.rate));
    add("on this machine when nothing else runs, {} {} ({:.0f} million disc-steps per second)",
        threads, threads == 1 ? "thread" : "threads", rate / 1e6);
    add("  {:<10} {:>10} {:>9} {:>12} {:>9}", "accuracy", "radius, m", "discs", "cycles", "time");
    for (const AccuracyLevel& level : accuracy_levels()) {
        Scene other = scene;
        other.hanging_wall->mean_radius = level.mean_radius;
        other.extension.speed = level.speed;
        const Prediction q = predict(other, rate, threads);
        add("  {:<10} {:>10.4g} {:>9} {:>12} {:>9}{}", level.name, level.mean_radius,
            q.discs_at_start, q.cycles, duration(q.seconds),
            level.mean_radius == scene.hanging_wall->mean_radius ? "   <- this call" : "");
    }
    add("  this call: {}{}", duration(p.seconds),
        speed.busy > 1.15
            ? fmt::format("; {} while other programs run as now", duration(speed.busy * p.seconds))
            : "");
    add("");
    add("accuracy, from runs of lis1: rotation, cutoff and basin area are right at draft (1 %);");
    add("faults are as narrow as three discs, so their number and place want standard or finer.");
    return text;
}

} // namespace listric
