#include "fem/footwall.hpp"

#include "fem/blocks.hpp"
#include "fem/plugin.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <system_error>
#include <unistd.h>

#ifndef LISTRIC_FEM_PLUGIN
#define LISTRIC_FEM_PLUGIN ""
#endif

namespace listric::fem {

namespace {

std::string number(double x) {
    std::ostringstream text;
    text << x;
    return text.str();
}

[[noreturn]] void refuse(const std::string& message) { throw FootwallError(message); }

/// Cure of a plug-in that cannot be loaded: memory, or the package that brings it; an
/// installed program has its files beside it.
std::string cure(const std::string& problem) {
    // Where memory is limited, or files of a folder may not be executed.
    if (problem.find("failed to map") != problem.npos)
        return "raise the limit of memory (ulimit -v), or allow its folder to hold programs";
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    const auto files = program.parent_path().parent_path() / "share/listric";
    const std::string libraries = "libdeal.ii-dev petsc-dev libopenmpi-dev openmpi-bin gmsh";
    return std::filesystem::is_directory(files, error)
               ? "install the package listric-elastic-base, or " + libraries +
                     " where you build it yourself, and build again"
               : "install " + libraries + " and build again";
}

MakeFootwall load_plugin() {
    // Threads of the linear algebra would fight with those of the discs.
    setenv("OPENBLAS_NUM_THREADS", "1", 0);
    const LoadedPlugin plugin = load({.variable = "LISTRIC_FEM_PLUGIN",
                                      .installed = LISTRIC_FEM_INSTALLED,
                                      .built = LISTRIC_FEM_PLUGIN,
                                      .entry = LISTRIC_FEM_ENTRY});
    if (!plugin.problem.empty())
        refuse("the plug-in for elastic bases cannot be loaded (" + plugin.problem + "); " +
               cure(plugin.problem));
    if (!plugin.entry)
        refuse(plugin.file + ": is no plug-in for elastic bases of this build; build again");
    return reinterpret_cast<MakeFootwall>(plugin.entry);
}

void check_layers(const FootwallRequest& r) {
    if (r.layers.empty())
        refuse("there are no layers, at least one is needed");
    if (r.layers.front().top_depth != 0.0)
        refuse("the first layer begins at a depth of " + number(r.layers.front().top_depth) +
               " m, allowed: 0");
    for (std::size_t k = 0; k < r.layers.size(); ++k) {
        const Layer& layer = r.layers[k];
        const std::string name = "layer " + std::to_string(k + 1);
        if (!(layer.young_modulus > 0.0) || !std::isfinite(layer.young_modulus))
            refuse(name + ": Young's modulus " + number(layer.young_modulus) +
                   " Pa, allowed: above 0");
        if (!(layer.poisson_ratio > -1.0 && layer.poisson_ratio < 0.5))
            refuse(name + ": Poisson's ratio " + number(layer.poisson_ratio) +
                   ", allowed: above -1, below 0.5");
        if (!(layer.density > 0.0))
            refuse(name + ": density " + number(layer.density) + " kg/m3, allowed: above 0");
        if (layer.viscosity && !(*layer.viscosity > 0.0 && std::isfinite(*layer.viscosity)))
            refuse(name + ": viscosity " + number(*layer.viscosity) + " Pa s, allowed: above 0");
        if (k > 0 && !(layer.top_depth > r.layers[k - 1].top_depth))
            refuse(name + " overlaps the one before: it begins at a depth of " +
                   number(layer.top_depth) + " m, allowed: above " +
                   number(r.layers[k - 1].top_depth));
        if (layer.top_depth >= r.depth)
            refuse(name + " begins at a depth of " + number(layer.top_depth) +
                   " m, allowed: above the base at " + number(r.depth));
    }
}

/// Springs and sides: what holds the footwall in place.
void check_supports(const FootwallRequest& r) {
    for (double spring : {r.surface_spring, r.detachment_spring, r.base_spring})
        if (!(spring >= 0.0) || !std::isfinite(spring))
            refuse("springs must be at least 0 Pa/m");
    if (r.surface_spring + r.detachment_spring + r.base_spring == 0.0)
        refuse("nothing holds the footwall: surface, detachment or base needs a spring");
    if (r.left_side == Side::free && r.right_side == Side::free)
        refuse("nothing holds the footwall sideways: one side needs rollers or springs");
}

void check_detachment(const FootwallRequest& r) {
    const Vector start = r.detachment.front().start;
    if (!(start.x > r.left) || std::abs(start.y) > 1e-6 * r.cell_size)
        refuse("the detachment leaves the mesh: it must begin at y = 0, right of the left side");
    constexpr double slack = 1e-9, right_angle = 0.5 * std::numbers::pi;
    for (const Piece& piece : r.detachment)
        for (double s : {0.0, piece.length}) {
            const double direction = direction_at(piece, s);
            if (direction > slack || direction < -right_angle - slack)
                refuse("the detachment rises or overhangs; allowed are dips from 0 to 90 "
                       "degrees");
        }
    extended_detachment(r); // checks its end
}

} // namespace

void check(const FootwallRequest& r) {
    if (!(r.right > r.left))
        refuse("the right side must lie right of the left side");
    if (!(r.depth > 0.0))
        refuse("the base must have a depth above 0");
    if (!(r.cell_size > 0.0) || (r.right - r.left) / r.cell_size > 1.0 / least_cell_share ||
        r.depth / r.cell_size > 1.0 / least_cell_share)
        refuse("the cell size (" + number(r.cell_size) +
               " m) must be above 0 and at least 1e-5 of the footwall's width and depth");
    if (r.degree != 1 && r.degree != 2)
        refuse("elements of degree " + std::to_string(r.degree) + ", allowed: 1 and 2");
    check_layers(r);
    if (!(r.step >= 0.0) || !std::isfinite(r.step))
        refuse("the step of relaxation must be at least 0");
    if (r.elastic_thickness < 0.0 || !(r.relaxation >= 1.0) || r.skin_thickness < 0.0)
        refuse("elastic and skin thickness must be at least 0, the relaxation at least 1");
    if (!std::ranges::is_sorted(r.isotherm, {}, &Vector::x))
        refuse("the isotherm must go from left to right");
    check_supports(r);
    if (!r.detachment.empty())
        check_detachment(r);
}

std::unique_ptr<Footwall> make_footwall(const FootwallRequest& request) {
    check(request);
    static const MakeFootwall entry = load_plugin();
    std::string message;
    std::unique_ptr<Footwall> footwall(entry(request, message));
    if (!footwall)
        refuse(message);
    return footwall;
}

void write_series(const std::string& pvd, std::span<const std::pair<double, std::string>> moments) {
    const std::string temporary = pvd + "." + std::to_string(getpid()) + ".part";
    std::error_code error;
    std::filesystem::remove(temporary, error); // a link of this name would be written through
    errno = 0;
    std::ofstream out(temporary);
    out.precision(17);
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
           "byte_order=\"LittleEndian\">\n<Collection>\n";
    for (const auto& [time, file] : moments)
        out << "<DataSet timestep=\"" << time << "\" part=\"0\" name=\"footwall\" file=\"" << file
            << "\"/>\n";
    out << "</Collection>\n</VTKFile>\n";
    out.close();
    error.clear();
    if (out)
        std::filesystem::rename(temporary, pvd, error);
    if (!out || error) {
        const std::string cause = error ? error.message() : std::strerror(errno ? errno : EIO);
        std::filesystem::remove(temporary, error);
        throw WriteError("cannot write " + pvd + ": " + cause);
    }
}

} // namespace listric::fem
