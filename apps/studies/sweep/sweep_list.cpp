#include "apps/archive/folder/output_folder.hpp"
#include "apps/model/model.hpp"
#include "apps/run/forecast/prediction.hpp"
#include "apps/scene/toml/json_text.hpp"
#include "apps/studies/sweep/sweep.hpp"
#include "apps/studies/sweep/sweep_plan.hpp"
#include "apps/studies/sweep/sweep_table.hpp"
#include "apps/support/machine/shell.hpp"
#include "dem/numbers/elementary.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>

namespace listric {

namespace {

/// Speeds of the machine by the discs that a run has; runs of about as many share one.
class Speeds {
public:
    explicit Speeds(int threads) : threads_(threads) {}

    CycleSpeed of(const Scene& scene) {
        const std::size_t discs = estimated_discs(scene);
        const bool accounted = make_parts(scene).accounts_energy;
        const std::pair key(
            static_cast<int>(4.0 * dem::logarithm_to_base_2(static_cast<double>(discs))),
            accounted);
        const auto known = known_.find(key);
        return known != known_.end()
                   ? known->second
                   : known_.emplace(key, measure_speed(discs, threads_, 0.2, accounted))
                         .first->second;
    }

private:
    int threads_;
    std::map<std::pair<int, bool>, CycleSpeed> known_;
};

/// Cost of a lean run, which draws nothing.
struct Price {
    double seconds = 0.0, memory_mib = 0.0, disk_mb = 0.0;
};

Price price_of(Scene scene, Speeds& speeds) {
    scene.output.series = SeriesFormat::none;
    scene.output.report = false;
    const Prediction p = predict(scene, speeds.of(scene));
    return {p.seconds - p.forecast.after, p.memory / (1024.0 * 1024.0), p.disk / 1e6};
}

/// The words of the call that makes a run.
std::vector<std::string> call_of(const SweepPlan& plan, const SweepPoint& point,
                                 const SweepRow& row, int threads) {
    const char* program = std::getenv("LISTRIC_CALL"); // how the launcher was called
    std::vector<std::string> words{program ? program : "listric", "run", plan.scene};
    const auto add = [&](const char* option, const std::string& value) {
        words.emplace_back(option);
        words.push_back(value);
    };
    if (!plan.accuracy.empty())
        add("--accuracy", plan.accuracy);
    for (const std::string& change : plan.set)
        add("--set", change);
    for (const SweepValue& value : point)
        for (const std::string& change : value.changes)
            add("--set", change);
    for (const std::string& table : plan.without)
        add("--without", table);
    add("--seed", std::to_string(row.seed));
    add("--threads", std::to_string(threads));
    add("--output", row.folder.string());
    words.emplace_back(plan.needs_moments() ? "--lean=all" : "--lean");
    words.emplace_back("--quiet");
    return words;
}

/// A word as a shell takes it; most need no quotes.
std::string shell_word(const std::string& word) {
    const bool is_plain = !word.empty() && std::ranges::all_of(word, [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               std::string_view("-_./=+,:%@").find(c) != std::string_view::npos;
    });
    return is_plain ? word : shell_quoted(word);
}

} // namespace

void list_sweep(const SweepRequest& request, bool as_json) {
    const SweepPlan plan = load_sweep_plan(request.plan);
    const std::vector<SweepPoint> points = sweep_points(plan);
    Speeds speeds(request.threads);
    auto list = nlohmann::ordered_json::array();
    for (const SweepRow& row : sweep_rows(plan, points, sweep_folder(request, plan))) {
        request.stop.check();
        const SweepPoint& point = points[row.run - 1];
        const Price price = price_of(scene_of_row(plan, request.plan, points, row), speeds);
        const std::vector<std::string> words = call_of(plan, point, row, request.threads);
        if (as_json) {
            list.push_back({{"run", row.run},
                            {"seed", row.seed},
                            {"folder", row.folder.string()},
                            {"call", words},
                            {"threads", request.threads},
                            {"seconds", std::ceil(price.seconds)},
                            {"memory_mib", std::ceil(price.memory_mib)},
                            {"disk_mb", std::ceil(price.disk_mb)}});
            continue;
        }
        std::string line;
        for (const std::string& word : words)
            line += shell_word(word) + " ";
        std::cout << fmt::format("{} # {:.0f} s, {:.0f} MiB, {:.0f} MB of disk\n", line,
                                 std::ceil(price.seconds), std::ceil(price.memory_mib),
                                 std::ceil(price.disk_mb));
    }
    if (as_json)
        std::cout << to_text(list, 2) << "\n";
}

} // namespace listric
