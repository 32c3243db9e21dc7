// Effects, output, threads, cycles and seeds in combination. A covering array: every pair of
// choices that go together occurs in at least one run. Each run must finish, stay finite and keep
// its mass; pairs that do not go together are refused by name.

#include "apps/model/model.hpp"
#include "tests/message_of.hpp"
#include "tests/regression/runs/speed_gauge.hpp"
#include "tests/scene_runs.hpp"
#include "tests/xml_files.hpp"

#include <gmock/gmock.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <random>
#include <set>

namespace listric::combination_test {

using namespace dem;
namespace {

using namespace support;

/// An effect by its name; null: what is needed is a table of another kind.
const Effect* find_effect(std::string_view name) {
    const EffectList all = effects_and_gauge();
    const auto found = std::ranges::find(all, name, &Effect::name);
    return found == all.end() ? nullptr : *found;
}

std::vector<std::string_view> needs_of(const Effect& effect) {
    return needed_tables(effect, effects_and_gauge());
}

/// Whether an effect needs the other, if only because one that it needs does.
bool depends(const Effect& effect, std::string_view other) {
    return std::ranges::any_of(needs_of(effect), [&](std::string_view name) {
        const Effect* const needed = find_effect(name);
        return name == other || (needed && depends(*needed, other));
    });
}

const Scene& shipped() {
    static const Scene scene = load_scene({.scene = test_scene("every-effect.toml")});
    return scene;
}

/// Whether the base deforms where an effect is on.
bool moves_base(const Effect& effect) {
    Scene scene = shipped();
    scene.effects.push_back({&effect, effect.defaults()});
    return make_parts(scene).base_moves ||
           std::ranges::any_of(needs_of(effect), [](std::string_view name) {
               const Effect* const needed = find_effect(name);
               return needed && moves_base(*needed);
           });
}

/// All effects, and one of the tests' own, but those that make the base deform or need it to: their
/// combinations are tested below and in fem_combination_test.
const std::vector<const Effect*>& effects() {
    static const std::vector<const Effect*> list = [] {
        std::vector<const Effect*> some;
        std::ranges::copy_if(effects_and_gauge(), std::back_inserter(some),
                             [](const Effect* effect) { return !moves_base(*effect); });
        return some;
    }();
    return list;
}

// A run is a set of choices: the effects, by their place in the list, and then these.
enum Other { series, threads, plain, other_seed, others };

using Chosen = unsigned; // bit k: choice k

std::size_t count() { return effects().size() + others; }

Chosen bit(Other choice) { return 1u << (effects().size() + choice); }
Chosen bit(std::string_view name) {
    return 1u << (std::ranges::find(effects(), name, &Effect::name) - effects().begin());
}
bool has(Chosen run, auto choice) { return (run & bit(choice)) != 0; }

bool allowed(Chosen run) {
    if (has(run, "stage") && has(run, "energy")) // the account is of one way
        return false;
    return std::ranges::all_of(effects(), [&](const Effect* effect) {
        return !has(run, effect->name) ||
               std::ranges::all_of(needs_of(*effect), [&](std::string_view needed) {
                   return !find_effect(needed) || has(run, needed);
               });
    });
}

/// Pairs of two choices taken or left, as numbers.
std::vector<std::size_t> pairs(Chosen run) {
    std::vector<std::size_t> found;
    for (std::size_t a = 0; a < count(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            found.push_back(((a * count() + b) * 2 + (run >> a & 1u)) * 2 + (run >> b & 1u));
    return found;
}

/// How many pairs cannot be: an effect without one that it depends on, stages with the account.
std::size_t impossible_pairs() {
    std::size_t number = 1;
    for (const Effect* effect : effects())
        number += static_cast<std::size_t>(std::ranges::count_if(
            effects(), [&](const Effect* other) { return depends(*effect, other->name); }));
    return number;
}

/// All pairs of two choices but those that cannot be.
std::size_t possible_pairs() { return 2 * count() * (count() - 1) - impossible_pairs(); }

/// Choices by lot, with what they need; the account of energy or stages, not both.
Chosen drawn(std::mt19937& dice) {
    Chosen run = dice() & ((1u << count()) - 1u);
    if (has(run, "stage") && has(run, "energy"))
        run &= ~bit(dice() % 2 == 0 ? "stage" : "energy");
    for (const Effect* effect : effects())
        for (const Effect* needed : effects())
            if (has(run, effect->name) && depends(*effect, needed->name))
                run |= bit(needed->name);
    return run;
}

/// Greedily: of some hundred runs by lot the one that adds most pairs, until all are there.
std::vector<Chosen> covering_array() {
    std::mt19937 dice(1);
    std::vector<Chosen> chosen;
    for (std::set<std::size_t> covered; covered.size() < possible_pairs() && chosen.size() < 100;) {
        const auto adds = [&](Chosen run) {
            return std::ranges::count_if(pairs(run),
                                         [&](std::size_t pair) { return !covered.contains(pair); });
        };
        std::vector<Chosen> some(300);
        std::ranges::generate(some, [&] { return drawn(dice); });
        chosen.push_back(std::ranges::max(some, {}, adds));
        std::ranges::copy(pairs(chosen.back()), std::inserter(covered, covered.end()));
    }
    return chosen;
}

std::vector<std::string> names_of(Chosen run) {
    std::vector<std::string> names;
    for (const Effect* effect : effects())
        if (has(run, effect->name))
            names.emplace_back(effect->name);
    return names;
}

/// The least that a scene says of an effect, as --set takes it.
std::string tables_of(std::string_view effect) {
    if (effect == "layer")
        return R"([{name="mica", material="mica", top_m=400.0, thickness_m=300.0}])";
    if (effect == "bed")
        return R"([{material="mud", until_a=6e3}, {material="sand", permeability_ratio=3.0}])";
    if (effect == "old_fault")
        return "[{points=[[2000.0, 300.0], [2400.0, 1200.0]]}]";
    if (effect == "stage")
        return "[{distance_m=150.0}, {distance_m=-20.0}]";
    return "{}";
}

class Combination : public SceneRuns {
protected:
    /// The scene as shipped with the effects that are chosen: those that it lacks with their
    /// defaults.
    static Scene scene(Chosen run, std::vector<std::string> set = {}) {
        SceneRequest r{.scene = test_scene("every-effect.toml"), .set = std::move(set)};
        for (const Effect* effect : effects()) {
            const bool there = has_effect(shipped(), effect->name);
            if (there && !has(run, effect->name))
                r.without.emplace_back(effect->name);
            if (!there && has(run, effect->name))
                r.set.push_back(fmt::format("{}={}", effect->name, tables_of(effect->name)));
        }
        if (has(run, series))
            r.set.push_back("output.series=paraview");
        if (has(run, "stage"))
            r.set.push_back("detachment.footwall_top_m=1000");
        r.set.push_back(has(run, "stage") ? "extension.distance_m=170"
                                          : "extension.distance_m=130");
        r.seed = has(run, other_seed) ? 2 : 1;
        return load_scene(r, effects_and_gauge());
    }

    RunOptions how(Chosen run, const std::string& name) const {
        RunOptions o = options(name);
        o.force = true;
        o.threads = has(run, threads) ? 3 : 1;
        o.plain = has(run, plain);
        return o;
    }
};

TEST_F(Combination, ArrayIsOfEveryEffectThatLeavesTheBaseAlone) {
    EXPECT_THAT(names_of(~0u),
                testing::IsSupersetOf({"gravity", "bonds", "fault_weakening", "bond_healing",
                                       "sedimentation", "compaction", "energy", "speed_gauge"}));
    for (const Effect* effect : effects_and_gauge())
        EXPECT_EQ(std::ranges::count(effects(), effect), moves_base(*effect) ? 0 : 1)
            << effect->name;
}

TEST_F(Combination, EveryPairRuns) {
    const std::vector<Chosen> array = covering_array();
    std::set<std::size_t> covered;
    for (const Chosen choice : array) {
        ASSERT_TRUE(allowed(choice));
        std::ranges::copy(pairs(choice), std::inserter(covered, covered.end()));
        const std::vector<std::string> on = names_of(choice);
        SCOPED_TRACE(
            fmt::format("{}{}{}{}{}", fmt::join(on, " "), has(choice, series) ? " series" : "",
                        has(choice, threads) ? " threads" : "", has(choice, plain) ? " plain" : "",
                        has(choice, other_seed) ? " seed 2" : ""));
        const RunOptions o = how(choice, "run");
        const nlohmann::json summary = run(scene(choice), o);
        EXPECT_EQ(summary["finished"], true);
        EXPECT_EQ(summary["effects"], nlohmann::json(on));
        EXPECT_EQ(summary["seed"], has(choice, other_seed) ? 2 : 1);
        EXPECT_NEAR(summary["extension_m"].get<double>(), 130.0, 0.05);
        // Sums of some hundred masses, each rounded by 1e-16.
        EXPECT_LT(summary["mass_error_fraction"].get<double>(), 1e-13);
        EXPECT_EQ(summary.contains("energy_residual"), has(choice, "energy"));
        EXPECT_EQ(summary.contains("greatest_speed_m_per_s"), has(choice, "speed_gauge"));
        EXPECT_EQ(std::filesystem::exists(o.output / "paraview.pvd"), has(choice, series));
        EXPECT_EQ(xml_files(o.output).starts_with("1 of .pvd\n"), has(choice, series))
            << xml_files(o.output);
        const Snapshot last = read_snapshot(list_snapshots(o.output).back());
        for (const Table* table :
             {&last.state.discs, &last.state.contacts, &last.state.base_contacts})
            EXPECT_TRUE(all_finite(*table));
        for (const auto& [name, value] : summary.items())
            EXPECT_FALSE(value.is_null()) << name;
    }
    EXPECT_EQ(covered.size(), possible_pairs());
    EXPECT_GE(impossible_pairs(), 2u); // healing without bonds, compaction without sediment
    EXPECT_LT(array.size(), 20u);
}

TEST_F(Combination, PrescribedMotionGoesWithEachOfThem) {
    const std::string motion = "base_motion.uplift=[{time_a=0.0, points=[[0.0, 0.0]]},"
                               "{time_a=20000.0, points=[[0.0, 40.0], [4000.0, 0.0]]}]";
    const Chosen all = (1u << count()) - 1u;
    for (const Chosen choice : {all & ~bit(plain) & ~bit("energy"), bit("gravity") | bit(plain)}) {
        const RunOptions o = how(choice, "moved");
        const nlohmann::json summary = run(scene(choice, {motion}), o);
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
        return support::message_of<SceneError>([&] {
            load_scene({.scene = test_scene("every-effect.toml"), .without = std::move(without)});
        });
    };
    EXPECT_THAT(refusal({"bonds"}),
                testing::HasSubstr("bond_healing: needs [bonds], which the scene does not have"));
    EXPECT_THAT(refusal({"sedimentation"}),
                testing::HasSubstr("compaction: needs [sedimentation]"));
    EXPECT_EQ(refusal({"bonds", "bond_healing"}), "accepted");
    EXPECT_EQ(refusal({"sedimentation", "compaction"}), "accepted");
}

} // namespace
} // namespace listric::combination_test
