// Meshes made with Gmsh: the same answer as the program's own, and what is refused.

#include "tests/places.hpp"
#include "tests/verification/footwalls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace listric::fem_gmsh_test {

namespace {

namespace fs = std::filesystem;
using namespace support;
using testing::AllOf;
using testing::HasSubstr;

const std::string mesh_file = std::string(source_folder) + "/meshes/lis1-footwall.msh";

fem::FootwallRequest lis1_footwall() {
    fem::FootwallRequest request;
    request.detachment = listric_detachment();
    request.surface_spring = request.detachment_spring = 2700.0 * standard_gravity;
    request.base_spring = 600.0 * standard_gravity;
    request.cell_size = 2500.0;
    request.interface_end = 60e3;
    return request;
}

/// Displacement of the breakaway under a smooth load on the detachment.
fem::Vector breakaway(const fem::FootwallRequest& request) {
    const auto footwall = fem::make_footwall(request);
    fem::Load load;
    load.traction = [](fem::Vector p, fem::Vector n, fem::Boundary boundary) {
        const double pressure = 1e8 * std::exp(-std::pow((p.x - 10e3) / 8e3, 2));
        return boundary == fem::Boundary::detachment ? fem::Vector{pressure * n.x, pressure * n.y}
                                                     : fem::Vector{};
    };
    footwall->solve(load);
    const auto u = footwall->interface_displacement();
    return {u[0], u[1]};
}

TEST(Gmsh, GivesTheSameDisplacement) {
    fem::FootwallRequest request = lis1_footwall();
    const fem::Vector own = breakaway(request);
    request.mesh_file = mesh_file;
    const fem::Vector gmsh = breakaway(request);
    std::printf("breakaway: own mesh %.4f, %.4f m, Gmsh %.4f, %.4f m\n", own.x, own.y, gmsh.x,
                gmsh.y);
    // Discretisation: Q2 on cells of 2.5 km, about 1e-4 each.
    EXPECT_NEAR(gmsh.x, own.x, 1e-3 * std::hypot(own.x, own.y));
    EXPECT_NEAR(gmsh.y, own.y, 1e-3 * std::hypot(own.x, own.y));
}

/// Message about the mesh with its text changed.
std::string refusal(const std::function<void(std::string&, fem::FootwallRequest&)>& spoil) {
    std::ostringstream text;
    text << std::ifstream(mesh_file).rdbuf();
    std::string mesh = text.str();
    fem::FootwallRequest request = lis1_footwall();
    const fs::path file = fs::temp_directory_path() / ("gmsh-" + std::to_string(getpid()) + ".msh");
    request.mesh_file = file.string();
    spoil(mesh, request);
    std::ofstream(file) << mesh;
    std::string message;
    try {
        fem::make_footwall(request);
    } catch (const fem::FootwallError& error) {
        message = error.what();
    }
    fs::remove(file);
    return message;
}

TEST(Gmsh, RefusesWhatIsNoFootwall) {
    EXPECT_EQ(refusal([](auto&, auto&) {}), "");
    EXPECT_THAT(refusal([](auto& mesh, auto&) { mesh = "nonsense"; }),
                HasSubstr("is no Gmsh mesh of format 2.2"));
    EXPECT_THAT(refusal([](auto& mesh, auto&) {
                    // The last quadrilateral's nodes the other way round.
                    const auto end = mesh.find("\n$EndElements");
                    const auto start = mesh.rfind('\n', end - 1) + 1;
                    std::istringstream line(mesh.substr(start, end - start));
                    std::vector<std::string> words;
                    for (std::string word; line >> word;)
                        words.push_back(word);
                    std::swap(words[words.size() - 1], words[words.size() - 3]);
                    std::string turned;
                    for (const auto& word : words)
                        turned += word + " ";
                    mesh.replace(start, end - start, turned);
                }),
                HasSubstr("is inverted"));
    EXPECT_THAT(
        refusal([](auto&, auto& request) { request.detachment = listric_detachment(14e3); }),
        HasSubstr("does not match the scene: its detachment"));
    EXPECT_THAT(refusal([](auto&, auto& request) { request.depth = 31e3; }),
                HasSubstr("does not match the scene: its base"));
    EXPECT_THAT(refusal([](auto&, auto& request) { request.left = -290e3; }),
                HasSubstr("does not match the scene: its left side"));
    // All lines of a side (1, 3) or of the base (2) by the name of the surface (4).
    for (const auto& [boundary, name] :
         {std::pair("1", "left side"), std::pair("2", "base"), std::pair("3", "right side")})
        EXPECT_THAT(refusal([named = std::string(boundary)](auto& mesh, auto&) {
                        mesh = std::regex_replace(mesh, std::regex("(\n[0-9]+ 1 2) " + named + " "),
                                                  "$1 4 ");
                    }),
                    AllOf(HasSubstr(name), HasSubstr("is named surface (physical line 4)")));
    EXPECT_THAT(refusal([](auto&, auto& request) { request.mesh_file = "no-such.msh"; }),
                HasSubstr("no-such.msh: no such mesh file"));
}

} // namespace
} // namespace listric::fem_gmsh_test
