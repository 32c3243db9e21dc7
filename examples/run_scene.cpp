// Runs LIS1 to 1 km of extension, prints its faults and some measures, saves it and reads it
// back. The hash is the `state_hash` of `listric run lis1 --accuracy draft --until 1km`.

#include <listric/run.hpp>

#include <cinttypes>
#include <cstdio>

int main() {
    listric::Run run(listric::load_scene({.scene = "lis1", .accuracy = "draft"}));
    run.extend_to(1e3, [](const listric::Run& now) {
        std::fprintf(stderr, "\r%.0f m ", now.extension());
        return true;
    });
    for (const auto& fault : run.faults().faults)
        std::printf("fault at %.0f m: dip %.0f degrees, %s\n", fault.foot.x, fault.dip,
                    fault.synthetic ? "synthetic" : "antithetic");
    for (const auto& [name, value] : run.measures())
        if (name == "basin_area_m2" || name == "rollover_tilt_deg")
            std::printf("%s %g\n", name.c_str(), value);
    run.save("lis1-1km.h5");
    const auto saved = listric::archive::read_snapshot("lis1-1km.h5");
    std::printf("%zu discs, %016" PRIx64 "\n", saved.state.discs.rows(),
                listric::archive::run_hash(saved));
}
