// Reads snapshots, out/lis1/snapshots/*.h5, and prints of each the extension, how much of it is
// sediment, and how much of the basement has been sheared by more than a tenth.

#include <listric/snapshot.hpp>

#include <cstdio>
#include <numbers>
#include <span>

using namespace listric;

int main(int argc, char** argv) {
    std::puts("extension_m  sediment_km2  sheared_km2");
    for (int k = 1; k < argc; ++k) {
        const dem::State state = archive::read_snapshot(argv[k]).state;
        const auto discs = disc_columns(state);
        const auto strain = state.discs.get<double>("total_strain");
        // Where faults are detected, weak discs are larger than their rock.
        std::span<const double> rock;
        if (state.discs.has("rock_radius"))
            rock = state.discs.get<double>("rock_radius");
        double sediment = 0.0, sheared = 0.0; // area of discs, m^2
        for (std::size_t i = 0; i < discs.x.size(); ++i) {
            const double r = rock.empty() || rock[i] == 0.0 ? discs.radius[i] : rock[i];
            const double area = std::numbers::pi * r * r;
            if (discs.stratum[i] > 0) // also where it is weak
                sediment += area;
            else if (strain[i] > 0.1)
                sheared += area;
        }
        std::printf("%11.0f %13.1f %12.1f\n", state.clock.extension.m, sediment / 1e6,
                    sheared / 1e6);
    }
}
