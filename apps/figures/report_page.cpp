#include "apps/figures/report_page.hpp"

#include "apps/scene/effect.hpp"
#include "apps/support/base64.hpp"
#include "apps/support/file.hpp"
#include "apps/support/resources.hpp"
#include "apps/support/version.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <sstream>

namespace listric {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Where Debian's libjs-dygraphs is.
constexpr const char* charts_folder = "/usr/share/javascript/dygraphs";

void replace_all(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// A text that no tag can end that stands within it.
std::string as_script(std::string text) {
    replace_all(text, "</script", "<\\/script");
    return text;
}

/// JSON in which nothing looks like a tag.
std::string as_data(std::string text) {
    replace_all(text, "<", "\\u003c");
    return text;
}

json picks_of(const std::vector<PickedLine>& lines) {
    json list = json::array();
    for (const PickedLine& line : lines) {
        json points = json::array();
        for (std::size_t k = 0; k < line.x.size(); ++k)
            points.push_back({line.x[k], line.depth[k]});
        list.push_back({{"name", line.name}, {"points", std::move(points)}});
    }
    return list;
}

/// Nothing where brackets are nested deeper than ours ever are, for writing them calls itself as
/// often.
json shallow(const std::string& text) {
    constexpr int deepest = 64;
    int depth = 0;
    bool quoted = false;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '"')
            quoted = !quoted;
        else if (quoted)
            k += c == '\\';
        else if ((c == '[' || c == '{') && ++depth > deepest)
            return {};
        else if (c == ']' || c == '}')
            --depth;
    }
    return json::parse(text, nullptr, false);
}

/// All of a run but its moments.
json head_of(const ReportPage::Run& run) {
    const Scene& scene = run.scene;
    json head{{"scene", scene.name},
              {"description", scene.description},
              {"accuracy", scene.accuracy},
              {"seed", scene.seed},
              {"effects", effect_names(scene)},
              {"length_m", scene.hanging_wall->length},
              {"thickness_m", scene.hanging_wall->thickness},
              {"extension_m", scene.extension.distance},
              {"rate_m_per_a", scene.extension.rate},
              {"mean_radius_m", run.mean_radius},
              {"scales", json::parse(report_scales(run.mean_radius))},
              {"history", run.history},
              {"summary", run.summary.empty() ? json() : shallow(run.summary)}};
    if (scene.observed)
        head["picks"] = {{"horizons", picks_of(scene.observed->horizons)},
                         {"faults", picks_of(scene.observed->faults)}};
    return head;
}

json underlay_of(const Underlay& underlay) {
    const std::string image = read_text(underlay.image);
    const auto* const bytes = reinterpret_cast<const unsigned char*>(image.data());
    return {{"image", "data:image/png;base64," + base64({bytes, image.size()})},
            {"corners_m", {underlay.left, underlay.top, underlay.right, underlay.bottom}}};
}

std::string data_of(const ReportPage& page) {
    json head{{"program", "listric " + std::string(version)},
              {"left_out", page.left_out},
              {"live", page.live}};
    const fs::path resources = resource_folder();
    std::string measures = read_text_if_there(resources / "measures.md");
    if (measures.empty())
        measures = read_text_if_there(resources / "../docs/measures.md"); // the source tree's
    head["definitions"] = json::parse(definitions_of(measures));
    if (page.underlay)
        head["underlay"] = underlay_of(*page.underlay);
    const auto dumped = [](const json& value) {
        return value.dump(-1, ' ', false, json::error_handler_t::replace);
    };
    std::string runs;
    for (const ReportPage::Run& run : page.runs) {
        std::string text = dumped(head_of(run));
        text.pop_back(); // the moments are text already
        runs += fmt::format("{}{},\"moments\":{}}}", runs.empty() ? "" : ",\n", text,
                            run.moments.json());
    }
    std::string text = dumped(head);
    text.pop_back();
    return as_data(fmt::format("{},\"runs\":[{}]}}", text, runs));
}

} // namespace

std::string definitions_of(const std::string& document) {
    json definitions = json::object();
    std::istringstream in(document);
    for (std::string row; std::getline(in, row);) {
        if (!row.starts_with("| `"))
            continue;
        const std::size_t bar = row.find(" | ", 2), end = row.rfind(" |");
        if (bar == row.npos || end <= bar + 3)
            continue;
        const std::string what = row.substr(bar + 3, end - bar - 3);
        for (std::size_t at = row.find('`'); at < bar; at = row.find('`', at + 1)) {
            const std::size_t close = row.find('`', at + 1);
            definitions[row.substr(at + 1, close - at - 1)] = what;
            at = close;
        }
    }
    return definitions.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string report_html(const ReportPage& page) {
    const fs::path folder = resource_folder() / "figures/report";
    std::string scripts;
    for (const char* name : {"data.js", "colours.js", "painter.js", "section.js", "charts.js",
                             "tables.js", "files.js", "page.js"})
        scripts += read_text(folder / name);
    const std::map<std::string, std::string> parts{
        {"style", read_text(folder / "report.css")},
        {"charts_style", read_text_if_there(fs::path(charts_folder) / "dygraph.min.css")},
        {"charts", as_script(read_text_if_there(fs::path(charts_folder) / "dygraph.min.js"))},
        {"palettes", read_text(folder / "palettes.json")},
        {"data", data_of(page)},
        {"scripts", as_script(scripts)}};
    const std::string frame = read_text(folder / "report.html");
    std::string html;
    std::size_t at = 0;
    for (std::size_t open = frame.find("{{"); open != frame.npos; open = frame.find("{{", at)) {
        const std::size_t close = frame.find("}}", open);
        html += frame.substr(at, open - at) + parts.at(frame.substr(open + 2, close - open - 2));
        at = close + 2;
    }
    return html + frame.substr(at);
}

} // namespace listric
