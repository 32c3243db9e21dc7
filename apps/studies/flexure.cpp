#include "apps/studies/flexure_plan.hpp"

#include "apps/archive/folder/json_file.hpp"
#include "apps/archive/folder/provenance.hpp"
#include "apps/figures/base_figure.hpp"
#include "apps/figures/sections/paraview.hpp"
#include "apps/run/options.hpp"
#include "apps/support/error.hpp"
#include "apps/support/files/file.hpp"
#include "apps/support/machine/memory.hpp"
#include "apps/support/stopwatch.hpp"
#include "apps/support/version.hpp"
#include "apps/support/words/log.hpp"
#include "dem/numbers/elementary.hpp"
#include "dem/numbers/hash.hpp"
#include "fem/elastic_layer.hpp"
#include "fem/footwall.hpp"
#include "fem/plate.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>

namespace listric {

namespace {

namespace fs = std::filesystem;

/// Downward deflection along the middle of the base.
struct Deflection {
    std::vector<double> x, w; ///< m

    double at_centre() const {
        const auto nearest = std::ranges::min_element(x, {}, [](double p) { return std::abs(p); });
        return w[static_cast<std::size_t>(nearest - x.begin())];
    }
};

struct Bulge {
    double height, x; ///< m
};

/// Highest point beside the load, between nodes by the parabola through three of them.
std::optional<Bulge> bulge(const Deflection& d) {
    std::size_t top = 0;
    for (std::size_t k = 1; k + 1 < d.x.size(); ++k)
        if (d.x[k] > 0.0 && d.w[k] <= d.w[k - 1] && d.w[k] <= d.w[k + 1] &&
            (top == 0 || d.w[k] < d.w[top]))
            top = k;
    if (top == 0 || d.w[top] >= 0.0)
        return std::nullopt;
    // Nodes of one row are evenly spaced.
    const double a = d.w[top - 1], b = d.w[top], c = d.w[top + 1];
    const double bend = a - 2.0 * b + c;
    const double shift = bend > 0.0 ? 0.5 * (a - c) / bend : 0.0;
    return Bulge{-(b - 0.25 * (a - c) * shift), d.x[top] + shift * (d.x[top + 1] - d.x[top])};
}

/// Plate, its supports and its comparison.
struct Case {
    fem::FootwallRequest request;
    fem::Plate plate;
    fem::ElasticLayer layer;
    double compared_to; ///< beyond this x, m, the sides disturb
};

fem::Plate plate_of(const FlexurePlan& plan) {
    const BendingBase& base = plan.bending();
    return {base.young_modulus, base.poisson_ratio, base.elastic_thickness,
            (base.floats_on() - base.infill_density) * plan.gravity};
}

Case make_case(const FlexurePlan& plan) {
    const FlexureParameters& flexure = plan.flexure;
    const BendingBase& base = plan.bending();
    const double te = base.elastic_thickness;
    Case c{};
    c.request.layers = {{0.0, base.young_modulus, base.poisson_ratio, base.crust_density}};
    c.request.depth = te;
    c.request.surface_spring = (base.crust_density - base.infill_density) * plan.gravity;
    c.request.base_spring = (base.floats_on() - base.crust_density) * plan.gravity;
    c.request.degree = base.degree;
    c.request.solver = base.solver;
    c.request.cell_size = te / base.cells;
    c.plate = plate_of(plan);
    c.layer = {base.young_modulus, base.poisson_ratio, te, c.request.surface_spring,
               c.request.base_spring};

    // Far enough for the sides not to be felt (e^-10), or at the sinusoid's crests.
    const double far = 10.0 * c.plate.alpha();
    c.request.left = -far;
    c.request.right = far;
    c.compared_to = 0.6 * far;
    switch (flexure.load) {
    case FlexureLoad::line:
        c.request.surface_breaks = {0.0};
        break;
    case FlexureLoad::broken:
        c.request.left = 0.0;
        c.request.left_side = fem::Side::free;
        break;
    case FlexureLoad::strip:
        c.request.right = flexure.half_width + far;
        c.request.left = -c.request.right;
        c.request.surface_breaks = {-flexure.half_width, 0.0, flexure.half_width};
        c.compared_to += flexure.half_width;
        break;
    case FlexureLoad::sinusoid:
        c.request.left = 0.0;
        c.request.right = c.compared_to = flexure.wavelength;
        c.request.cell_size = std::min(c.request.cell_size, flexure.wavelength / 16.0);
        break;
    }
    const double cells = (c.request.right - c.request.left) / c.request.cell_size;
    constexpr double most = 20e3;
    if (cells * te / c.request.cell_size > 1e6 || cells > most)
        throw UsageError(
            fmt::format("the base would have {:.0f} elements along it, allowed: {:.0f}; "
                        "a shorter load, fewer {}.cells or a thicker base",
                        cells, most, plan.base.effect->name));
    return c;
}

double pressure_at(const FlexureParameters& flexure, double x) {
    if (flexure.load == FlexureLoad::strip)
        return std::abs(x) < flexure.half_width ? flexure.pressure : 0.0;
    if (flexure.load == FlexureLoad::sinusoid)
        return flexure.pressure * dem::cosine(2.0 * std::numbers::pi * x / flexure.wavelength);
    return 0.0;
}

fem::Load make_load(const FlexureParameters& flexure, const Case& c, const fem::Footwall& base) {
    fem::Load load;
    const double te = c.request.depth;
    if (flexure.load == FlexureLoad::line) {
        const fem::PointForce force{{0.0, 0.0}, {0.0, -flexure.line_load}};
        load.interface = base.nodal_forces({&force, 1});
    } else if (flexure.load == FlexureLoad::broken) {
        // The parabola of shear of a beam: with a point force the end's corner would sink in.
        load.traction = [&flexure, te](fem::Vector p, fem::Vector, fem::Boundary boundary) {
            const double s = -p.y / te;
            return boundary == fem::Boundary::left
                       ? fem::Vector{0.0, -0.5 * flexure.line_load / te * 6.0 * s * (1.0 - s)}
                       : fem::Vector{};
        };
    } else {
        load.traction = [&flexure](fem::Vector p, fem::Vector, fem::Boundary boundary) {
            return boundary == fem::Boundary::surface ? fem::Vector{0.0, -pressure_at(flexure, p.x)}
                                                      : fem::Vector{};
        };
    }
    return load;
}

double plate_deflection(const FlexureParameters& flexure, const fem::Plate& plate, double x) {
    switch (flexure.load) {
    case FlexureLoad::line:
        return plate.line(x, flexure.line_load);
    case FlexureLoad::broken:
        return plate.broken(x, flexure.line_load);
    case FlexureLoad::strip:
        return plate.strip(x, flexure.pressure, flexure.half_width);
    case FlexureLoad::sinusoid:
        break;
    }
    return plate.sinusoid(x, flexure.pressure, flexure.wavelength);
}

/// Theory at the places of the solution.
struct Theory {
    Deflection plate;
    std::optional<Deflection>
        layer; ///< exact; none for a broken one, whose end has no such solution
};

Theory theory_of(const FlexureParameters& flexure, const Case& c, const std::vector<double>& x) {
    const auto at_places = [&](const std::function<double(double)>& deflection) {
        Deflection d{x, {}};
        std::ranges::transform(x, std::back_inserter(d.w), deflection);
        return d;
    };
    Theory theory;
    theory.plate = at_places([&](double p) { return plate_deflection(flexure, c.plate, p); });
    const double depth = 0.5 * c.layer.thickness;
    if (flexure.load == FlexureLoad::sinusoid) {
        const double q = 2.0 * std::numbers::pi / flexure.wavelength;
        const double amplitude = flexure.pressure * c.layer.response(q, depth);
        theory.layer = at_places([&](double p) { return amplitude * dem::cosine(q * p); });
    } else if (flexure.load != FlexureLoad::broken) {
        theory.layer = Deflection{x, c.layer.deflection(x, depth, [&](double q) {
                                      return flexure.load == FlexureLoad::line
                                                 ? flexure.line_load
                                                 : 2.0 * flexure.pressure *
                                                       dem::sine(q * flexure.half_width) / q;
                                  })};
    }
    return theory;
}

/// How the base bends, and the forces on it.
struct Bent {
    Deflection deflection;
    fem::Vector reaction, load; ///< N/m
};

/// Solves, and writes the field. Throws UsageError, fem::FootwallError.
Bent bend(const FlexurePlan& plan, const Case& c, const fs::path& output, Log& log) {
    const std::unique_ptr<fem::Footwall> base = fem::make_footwall(c.request);
    log.say(fmt::format("elastic base: {} elements, {} unknowns", base->mesh().cells,
                        base->mesh().unknowns));
    base->solve(make_load(plan.flexure, c, *base));
    const fem::Field field = base->field();
    const double middle = -0.5 * c.request.depth;
    Deflection d;
    for (std::size_t k = 0; k < field.place.size(); ++k)
        if (std::abs(field.place[k].y - middle) < 1e-3 * c.request.cell_size &&
            std::abs(field.place[k].x) <= c.compared_to * (1.0 + 1e-9)) {
            d.x.push_back(field.place[k].x);
            d.w.push_back(-field.displacement[k].y);
        }
    if (d.x.empty())
        throw UsageError(fmt::format("{}.cells: elements of degree 1 need an even number, so that "
                                     "nodes lie on the middle of the base",
                                     plan.base.effect->name));
    base->write(output.string(), "footwall");
    const std::pair<double, std::string> moment{0.0, "footwall.vtu"};
    fem::write_series((output / "footwall.pvd").string(), {&moment, 1});
    copy_view(output);
    return {d, base->reaction(), base->total_load()};
}

std::string deflection_csv(const Deflection& d, const Theory& theory) {
    std::string csv =
        theory.layer ? "x_m,deflection_m,plate_m,layer_m\n" : "x_m,deflection_m,plate_m\n";
    for (std::size_t k = 0; k < d.x.size(); ++k)
        csv += fmt::format("{},{},{}{}\n", d.x[k], d.w[k], theory.plate.w[k],
                           theory.layer ? fmt::format(",{}", theory.layer->w[k]) : "");
    return csv;
}

/// Adds how the solution compares with theory.
void add_comparison(const FlexureParameters& flexure, const Bent& bent, const Theory& theory,
                    nlohmann::ordered_json& json) {
    const Deflection& d = bent.deflection;
    if (theory.layer) {
        double worst = 0.0;
        for (std::size_t k = 0; k < d.x.size(); ++k)
            worst = std::max(worst, std::abs(d.w[k] - theory.layer->w[k]));
        json["exact_w0_m"] = theory.layer->at_centre();
        json["exact_relative_error"] = worst / std::abs(theory.layer->at_centre());
    }
    if (flexure.load == FlexureLoad::sinusoid)
        return;
    const auto add_bulge = [&](const std::string& prefix, const Deflection& of) {
        if (const auto top = bulge(of)) {
            json[prefix + "bulge_m"] = top->height;
            json[prefix + "bulge_x_m"] = top->x;
        }
    };
    add_bulge("", d);
    add_bulge("analytic_", theory.plate);
    if (theory.layer)
        add_bulge("exact_", *theory.layer);
    json["reaction_error"] = std::abs(bent.reaction.y / bent.load.y + 1.0);
}

nlohmann::ordered_json summary(const FlexurePlan& plan, int threads, const Case& c,
                               const Bent& bent, const Theory& theory) {
    const auto& load = std::get<Choice>(flexure_parameters()[0].value);
    const BendingBase& base = plan.bending();
    const double w0 = bent.deflection.at_centre();
    const double analytic = plate_deflection(plan.flexure, c.plate, 0.0);
    nlohmann::ordered_json json = {
        {"scene", plan.name},
        {"accuracy", plan.accuracy},
        {"seed", plan.seed},
        {"threads", threads},
        {"discs", 0},
        {"cycles", 0},
        {"wall_s", 0.0},
        {"predicted_wall_s", 3.0}, // loading the plug-in, solving, drawing
        {"disc_steps_per_s", 0.0},
        {"finished", true},
        {"state_hash", fmt::format("{:016x}", dem::fnv1a(bent.deflection.w))},
        {"extension_m", 0.0},
        {"load", load.get(&plan.flexure, load.names)},
        {"elastic_thickness_m", base.elastic_thickness},
        {"young_modulus_pa", base.young_modulus},
        {"poisson_ratio", base.poisson_ratio},
        {"restoring_pa_per_m", c.plate.restoring},
        {"alpha_m", c.plate.alpha()},
        {"w0_m", w0},
        {"analytic_w0_m", analytic},
        {"relative_error", std::abs(w0 / analytic - 1.0)},
    };
    add_comparison(plan.flexure, bent, theory, json);
    json["provenance"] = archive::provenance(to_toml(plan), plan.seed);
    json["effects"] = {plan.base.effect->name};
    return json;
}

} // namespace

void run_flexure(const FlexurePlan& plan, const RunOptions& options) {
    const fs::path& output = options.output;
    const auto lock = archive::take_output(
        {.parameters = to_toml(plan), .files = {plan.file}, .with_snapshots = false}, output,
        options.existing());
    if (!lock)
        return;
    Log log(output / "log.txt", options.quiet);
    log.say(fmt::format("listric {} bends {} into {}", version, plan.name, output.string()));
    write_text(output / "scene.toml", to_toml(plan));
    const auto start = SteadyClock::now();
    const Case c = make_case(plan);
    const Bent bent = [&] {
        try {
            return bend(plan, c, output, log);
        } catch (const fem::FootwallError& error) {
            throw UsageError(fmt::format("{}: {}", plan.base.effect->name, error.what()));
        }
    }();
    const double solving = seconds_since(start);

    const Theory theory = theory_of(plan.flexure, c, bent.deflection.x);
    write_text(output / "deflection.csv", deflection_csv(bent.deflection, theory));
    nlohmann::ordered_json json = summary(plan, options.threads, c, bent, theory);
    const auto write_summary = [&](double drawing) {
        const double all = seconds_since(start);
        json["wall_s"] = all;
        json["time_by_part_s"] = {{"base", solving},
                                  {"figures", drawing},
                                  {"other", std::max(0.0, all - solving - drawing)}};
        write_object(output / "summary.json", json);
    };
    write_summary(0.0); // the picture's legend reads it
    const auto drawing = SteadyClock::now();
    try {
        draw_flexure(output, output / "figures", {.provenance = json["provenance"]});
    } catch (const std::exception& error) {
        log.say(std::string("warning: no figure: ") + words_of(error));
    }
    write_summary(seconds_since(drawing));
    log.say(fmt::format(
        "deflection {:.2f} m, thin plate {:.2f} m{}; figure in {}", bent.deflection.at_centre(),
        json["analytic_w0_m"].get<double>(),
        theory.layer ? fmt::format(", exact layer {:.2f} m", theory.layer->at_centre()) : "",
        (output / "figures").string()));
}

std::string explain(const FlexurePlan& plan) {
    const BendingBase& base = plan.bending();
    const fem::Plate plate = plate_of(plan);
    return fmt::format(
        "{}: {}\n\nan elastic base without discs\n"
        "  elastic thickness {:g} km, rigidity {:.3g} N m, restoring {:.4g} Pa/m\n"
        "  flexural parameter {:.1f} km; {} elements of degree {} through the thickness\n"
        "  the load acts on the surface and nothing else does: deflections are relative to the\n"
        "  state without it; infill of {:g} kg/m3 fills them\n"
        "\na few seconds, with the plug-in for elastic bases (libdeal.ii-dev, petsc-dev)\n",
        plan.name, plan.description, base.elastic_thickness / 1e3, plate.rigidity(),
        plate.restoring, plate.alpha() / 1e3, base.cells, base.degree, base.infill_density);
}

} // namespace listric
