// A footwall solved by as many processes as mpirun starts; the first prints what it found, with all
// digits. tests/verification/base/fem_parallel_test.cpp compares.

#include "tests/verification/footwalls.hpp"

#include <cstdio>

using namespace listric;

int main() {
    fem::FootwallRequest request = support::small_footwall();
    request.elastic_thickness = 10e3;
    request.skin_thickness = 3e3;
    request.interface_end = 30e3;
    const auto footwall = fem::make_footwall(request);
    const fem::PointForce force{{2e3, -7e3}, {3e11, 8e11}};
    fem::Load load;
    load.interface = footwall->nodal_forces({&force, 1});
    footwall->solve(load);
    std::vector<double> numbers = footwall->interface_displacement();
    numbers.push_back(footwall->reaction().y);
    const fem::Guard guard = footwall->guard(2.7e4);
    for (double number : {guard.strong_strain, guard.rotation, guard.beyond_byerlee})
        numbers.push_back(number);
    for (const auto& u : footwall->field().displacement)
        numbers.push_back(u.y);
    for (double c : footwall->compliance())
        numbers.push_back(c);
    footwall->refine(0.2); // the same cells, whoever owns them
    numbers.push_back(static_cast<double>(footwall->mesh().cells));
    request.elastic_thickness = 0.0; // layers so different take multigrid hundreds of iterations
    request.solver = fem::Solver::gamg;
    const auto multigrid = fem::make_footwall(request);
    multigrid->solve(load);
    for (double u : multigrid->interface_displacement())
        numbers.push_back(u);
    if (footwall->process() == 0)
        for (double number : numbers)
            std::printf("%.17g\n", number);
}
