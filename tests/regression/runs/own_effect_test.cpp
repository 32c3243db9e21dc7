// An effect in one place: one that the program does not have, handed in by its description and one
// line of a list, is in everything that the program's own are in.

#include "apps/archive/tables/dictionary.hpp"
#include "apps/commands/explain.hpp"
#include "apps/model/model.hpp"
#include "apps/run/forecast/prediction.hpp"
#include "apps/run/genesis_cache.hpp"
#include "tests/message_of.hpp"
#include "tests/regression/runs/speed_gauge.hpp"
#include "tests/scene_runs.hpp"

#include <gmock/gmock.h>

#include <ranges>

namespace listric::own_effect_test {

using namespace dem;
namespace {

using namespace support;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class OwnEffect : public SceneRuns {
protected:
    static Scene with(const std::vector<std::string>& set = {"speed_gauge.interval_a=500"},
                      const std::vector<std::string>& without = {}) {
        return load_scene(
            {.scene = test_scene("every-effect.toml"), .set = set, .without = without},
            effects_and_gauge());
    }
    static Scene without() { return with({}); }

    RunOptions without_figures(const std::string& name) const {
        RunOptions o = options(name);
        o.figures = false;
        return o;
    }

    static std::string refusal(const SceneRequest& request, EffectList effects) {
        return support::message_of<SceneError>([&] { load_scene(request, effects); });
    }
};

std::vector<std::string> event_names(const Scene& scene) {
    std::vector<std::string> names;
    for (const auto& event : make_events(scene, make_parts(scene)))
        names.push_back(event->name());
    return names;
}

TEST_F(OwnEffect, IsReadAndRefusedByItsDescription) {
    EXPECT_EQ(with().find<SpeedGaugeParameters>()->interval, 500.0);
    EXPECT_EQ(with({"speed_gauge={}"}).find<SpeedGaugeParameters>()->interval, 1000.0);

    SceneRequest request{.scene = test_scene("every-effect.toml")};
    request.set = {"speed_gauge.interval_a=0"};
    EXPECT_THAT(refusal(request, effects_and_gauge()),
                AllOf(HasSubstr("speed_gauge.interval_a"), HasSubstr("at least 1")));
    request.set = {"speed_gage={}"};
    EXPECT_THAT(refusal(request, effects_and_gauge()), HasSubstr("did you mean speed_gauge?"));
    request.set = {"speed_gauge={}"};
    EXPECT_THAT(refusal(request, program_effects()), HasSubstr("unknown table"));
    request.without = {"speed_gauge"};
    EXPECT_THAT(refusal(request, effects_and_gauge()),
                HasSubstr("which --without speed_gauge leaves out"));
}

TEST_F(OwnEffect, IsExplainedPricedAndInTheReference) {
    const EffectList list = effects_and_gauge();
    const std::string line = "speed_gauge          remembers the greatest speed of each disc\n";
    EXPECT_THAT(explain(with(), 1, list),
                AllOf(HasSubstr("  on   " + line), HasSubstr("speed gauge: looks every 500 a\n")));
    EXPECT_THAT(explain(without(), 1, list),
                AllOf(HasSubstr("  off  " + line), Not(HasSubstr("speed gauge: looks"))));

    const std::string reference = parameter_reference(list);
    const std::size_t table =
        reference.find("\n[speed_gauge] (effect): remembers the greatest speed of each disc\n");
    ASSERT_NE(table, std::string::npos);
    EXPECT_THAT(reference.substr(table),
                AllOf(HasSubstr("interval_a"), HasSubstr("time between looks at speeds")));

    EXPECT_GT(predict(with()).seconds, predict(without()).seconds);
    // Genesis does not depend on parameters that the effect does not name for it.
    EXPECT_EQ(genesis_cache_path(with(), make_parts(with())),
              genesis_cache_path(without(), make_parts(without())));
}

TEST_F(OwnEffect, IsInAllThatARunLeaves) {
    const Scene scene = with();
    const RunOptions o = without_figures("with");
    const nlohmann::json summary = run(scene, o);
    EXPECT_THAT(summary["effects"], Contains("speed_gauge"));
    EXPECT_GT(summary["greatest_speed_m_per_s"].get<double>(), scene.extension.speed / 2.0);
    EXPECT_EQ(summary["speed_gauge"]["looks"], 40); // 200 m at 0.01 m/a: 20,000 a
    EXPECT_TRUE(summary["time_by_part_s"].contains("speed_gauge"));

    const std::string toml = contents(o.output / "scene.toml");
    EXPECT_THAT(toml, HasSubstr("\n[speed_gauge]  # remembers the greatest speed of each disc\n"));
    const Scene again =
        load_scene({.scene = (o.output / "scene.toml").string()}, effects_and_gauge());
    EXPECT_EQ(again.find<SpeedGaugeParameters>()->interval, 500.0);
    EXPECT_EQ(to_toml(again), toml);

    const std::string history = contents(o.output / "history.csv");
    EXPECT_THAT(history.substr(0, history.find('\n')), HasSubstr(",greatest_speed_m_per_s"));

    // Its measure is declared as the program's own are.
    EXPECT_EQ(unit_of("greatest_speed_m_per_s", scene), "m/s");
    const Snapshot newest = read_snapshot(list_snapshots(o.output).back());
    for (const Column& column : newest.record.history.columns())
        EXPECT_EQ(column.unit, unit_of(column.name, scene)) << column.name;
    const auto words = dictionary_json(effects_and_gauge());
    EXPECT_TRUE(std::ranges::any_of(words, [](const auto& entry) {
        return entry["name"] == "speed_gauge" && entry["parts"][0]["name"] == "looks";
    }));
    EXPECT_EQ(
        objection_to_measure("greatest_speed_m_per_s", true, {"speed_gauge"}, effects_and_gauge()),
        "");
    EXPECT_THAT(
        objection_to_measure("greatest_sped_m_per_s", true, {"speed_gauge"}, effects_and_gauge()),
        HasSubstr("did you mean greatest_speed_m_per_s?"));
    EXPECT_THAT(objection_to_measure("greatest_speed_m_per_s", true, {}, effects_and_gauge()),
                HasSubstr("[speed_gauge]"));

    const RunFolder left(o.output, scene); // whence the last sheet of figures is drawn
    EXPECT_EQ(
        std::ranges::count(left.read(left.snapshots.back()).events, "speed_gauge", &Event::name),
        1);

    Snapshot last = read_snapshot(list_snapshots(o.output).back());
    EXPECT_EQ(last.event_applied.at("speed_gauge"), 40);
    EXPECT_EQ(last.event_memory.at("speed_gauge").rows(), 40u);
    const auto speeds = last.state.discs.get<double>("greatest_speed");
    EXPECT_GT(std::ranges::count_if(speeds, [](double v) { return v > 0.0; }), 300);
    EXPECT_LE(std::ranges::max(speeds), summary["greatest_speed_m_per_s"].get<double>());
}

TEST_F(OwnEffect, IsResumed) {
    const nlohmann::json at_once = run(with(), without_figures("at-once"));
    RunOptions o = without_figures("in-parts");
    o.until = 100.0;
    run(with(), o);
    o.until = {};
    o.resume = true;
    const nlohmann::json in_parts = run(with(), o);
    EXPECT_EQ(in_parts["state_hash"], at_once["state_hash"]);
    EXPECT_EQ(in_parts["speed_gauge"], at_once["speed_gauge"]);
    EXPECT_EQ(contents(o.output / "history.csv"), contents(folder / "at-once/history.csv"));
    const auto speeds = [&](const std::string& name) {
        const Snapshot last = read_snapshot(list_snapshots(folder / name).back());
        const auto column = last.state.discs.get<double>("greatest_speed");
        return std::vector<double>(column.begin(), column.end());
    };
    EXPECT_EQ(speeds("in-parts"), speeds("at-once"));

    // Without its table it is another run.
    RunOptions other = without_figures("in-parts");
    other.resume = true;
    EXPECT_THROW(run_scene(without(), other), UsageError);
}

TEST_F(OwnEffect, IsNowhereWithoutItsTable) {
    EXPECT_THAT(event_names(with()), Contains("speed_gauge"));
    EXPECT_THAT(event_names(without()), Not(Contains("speed_gauge")));
    EXPECT_THAT(to_toml(without()), Not(HasSubstr("speed_gauge")));

    const RunOptions o = without_figures("without");
    const nlohmann::json summary = run(without(), o);
    EXPECT_THAT(summary["effects"], Not(Contains("speed_gauge")));
    EXPECT_THAT(contents(o.output / "summary.json"),
                AllOf(Not(HasSubstr("speed_gauge")), Not(HasSubstr("greatest_speed"))));
    EXPECT_THAT(contents(o.output / "history.csv"), Not(HasSubstr("greatest_speed")));
    const Snapshot last = read_snapshot(list_snapshots(o.output).back());
    EXPECT_FALSE(last.state.discs.has("greatest_speed"));
    EXPECT_FALSE(last.event_memory.contains("speed_gauge"));

    // The list alone changes nothing; neither does an effect that only looks, but for its column.
    const Scene own = load_scene({.scene = test_scene("every-effect.toml")});
    EXPECT_EQ(run(own, without_figures("own-list"))["state_hash"], summary["state_hash"]);
    run(with(), without_figures("with"));
    Snapshot seen = read_snapshot(list_snapshots(folder / "with").back());
    EXPECT_NE(hash(seen.state), hash(last.state));
    seen.state.discs.remove("greatest_speed");
    EXPECT_EQ(hash(seen.state), hash(last.state));
}

} // namespace
} // namespace listric::own_effect_test
