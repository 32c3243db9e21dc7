// Effects, output, threads, cycles and seeds in combination. A covering array: every pair of
// choices that go together occurs in at least one run. Each run must finish, stay finite and keep
// its mass; pairs that do not go together are refused by name.

#include "apps/model/effects.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <fmt/ranges.h>

#include <array>
#include <set>

namespace listric {

using namespace dem;
namespace {

using namespace support;

// A run is a set of these.
enum Choice {
    gravity,
    bonds,
    fault_weakening,
    bond_healing,
    sedimentation,
    compaction,
    energy,
    series,
    threads,
    plain,
    other_seed,
    count
};
constexpr std::array<const char*, 7> effects{
    "gravity", "bonds", "fault_weakening", "bond_healing", "sedimentation", "compaction", "energy"};

using Chosen = unsigned; // bit k: choice k

bool has(Chosen run, int choice) { return run >> choice & 1u; }

bool allowed(Chosen run) {
    return (!has(run, bond_healing) || has(run, bonds)) &&
           (!has(run, compaction) || has(run, sedimentation));
}

/// Pairs of two choices taken or left, as numbers.
std::set<int> pairs(Chosen run) {
    std::set<int> found;
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < a; ++b)
            found.insert(((a * count + b) * 2 + has(run, a)) * 2 + has(run, b));
    return found;
}

/// Greedily: the run that adds most pairs, until none adds any.
std::vector<Chosen> covering_array() {
    std::vector<Chosen> chosen;
    for (std::set<int> covered;;) {
        Chosen best = 0;
        std::size_t most = 0;
        for (Chosen run = 0; run < 1u << count; ++run) {
            if (!allowed(run))
                continue;
            const std::set<int> all = pairs(run);
            const auto adds = static_cast<std::size_t>(
                std::ranges::count_if(all, [&](int pair) { return !covered.contains(pair); }));
            if (adds > most) {
                most = adds;
                best = run;
            }
        }
        if (most == 0)
            return chosen;
        chosen.push_back(best);
        covered.merge(pairs(best));
    }
}

class Combination : public SceneRuns {
protected:
    static SceneRequest request(Chosen run) {
        SceneRequest r{.scene = test_scene("every-effect.toml")};
        for (int k = 0; k < energy; ++k)
            if (!has(run, k))
                r.without.push_back(effects[static_cast<std::size_t>(k)]);
        if (has(run, energy))
            r.set.push_back("energy={}");
        if (has(run, series))
            r.set.push_back("output.series=paraview");
        r.set.push_back("extension.distance_m=130");
        r.seed = has(run, other_seed) ? 2 : 1;
        return r;
    }
};

TEST_F(Combination, EveryPairRuns) {
    const std::vector<Chosen> array = covering_array();
    std::set<int> covered;
    for (const Chosen choice : array) {
        covered.merge(pairs(choice));
        std::vector<std::string> on;
        for (int k = 0; k <= energy; ++k)
            if (has(choice, k))
                on.push_back(effects[static_cast<std::size_t>(k)]);
        SCOPED_TRACE(
            fmt::format("{}{}{}{}{}", fmt::join(on, " "), has(choice, series) ? " series" : "",
                        has(choice, threads) ? " threads" : "", has(choice, plain) ? " plain" : "",
                        has(choice, other_seed) ? " seed 2" : ""));
        RunOptions o = options("run");
        o.force = true;
        o.threads = has(choice, threads) ? 3 : 1;
        o.plain = has(choice, plain);
        const nlohmann::json summary = run(load_scene(request(choice)), o);
        EXPECT_EQ(summary["finished"], true);
        EXPECT_EQ(summary["effects"], nlohmann::json(on));
        EXPECT_EQ(summary["seed"], has(choice, other_seed) ? 2 : 1);
        EXPECT_NEAR(summary["extension_m"].get<double>(), 130.0, 0.05);
        // Sums of some hundred masses, each rounded by 1e-16.
        EXPECT_LT(summary["mass_error_fraction"].get<double>(), 1e-13);
        EXPECT_EQ(summary.contains("energy_residual"), has(choice, energy));
        EXPECT_EQ(std::filesystem::exists(o.output / "paraview.pvd"), has(choice, series));
        const Snapshot last = read_snapshot(list_snapshots(o.output).back());
        for (const Table* table :
             {&last.state.discs, &last.state.contacts, &last.state.base_contacts})
            EXPECT_TRUE(all_finite(*table));
        for (const auto& [name, value] : summary.items())
            EXPECT_FALSE(value.is_null()) << name;
    }
    // 11 choices of two, of which two pairs (healing without bonds, compaction without sediment)
    // cannot be.
    EXPECT_EQ(covered.size(), 4u * 55u - 2u);
    EXPECT_LT(array.size(), 20u);
}

TEST_F(Combination, PrescribedMotionGoesWithEachOfThem) {
    const std::string motion = "base_motion.uplift=[{time_a=0.0, points=[[0.0, 0.0]]},"
                               "{time_a=20000.0, points=[[0.0, 40.0], [4000.0, 0.0]]}]";
    const Chosen all = (1u << count) - 1u;
    for (const Chosen choice : {all & ~(1u << plain), (1u << gravity) | (1u << plain)}) {
        SceneRequest r = request(choice);
        r.set.push_back(motion);
        RunOptions o = options("moved");
        o.force = true;
        o.threads = has(choice, threads) ? 3 : 1;
        o.plain = has(choice, plain);
        const nlohmann::json summary = run(load_scene(r), o);
        EXPECT_EQ(summary["finished"], true);
        EXPECT_THAT(summary["effects"], testing::Contains("base_motion"));
        EXPECT_LT(summary["mass_error_fraction"].get<double>(), 1e-13);
        const Snapshot last = read_snapshot(list_snapshots(o.output).back());
        for (const Table* table :
             {&last.state.discs, &last.state.contacts, &last.state.base_contacts})
            EXPECT_TRUE(all_finite(*table));
    }
}

TEST_F(Combination, PairsThatDoNotGoTogetherAreRefused) {
    const auto refusal = [](std::vector<std::string> without) -> std::string {
        try {
            load_scene({.scene = test_scene("every-effect.toml"), .without = std::move(without)});
        } catch (const SceneError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_THAT(refusal({"bonds"}),
                testing::HasSubstr("bond_healing: needs [bonds], which the scene does not have"));
    EXPECT_THAT(refusal({"sedimentation"}),
                testing::HasSubstr("compaction: needs [sedimentation]"));
    EXPECT_EQ(refusal({"bonds", "bond_healing"}), "accepted");
    EXPECT_EQ(refusal({"sedimentation", "compaction"}), "accepted");
}

} // namespace
} // namespace listric
