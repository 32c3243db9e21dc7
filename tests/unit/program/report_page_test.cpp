#include "apps/archive/tables/dictionary.hpp"
#include "apps/figures/report_page.hpp"
#include "apps/model/effects.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace listric::report_page_test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ReportPage, HasTheDictionarysDefinitionsAndFaultColumns) {
    Scene scene;
    const ReportMoments moments;
    const std::string html = report_html({.runs = {{scene, moments, 75.0, "extension_m\n0\n"}}});
    for (const archive::DictionaryEntry& entry : archive::dictionary(program_effects()))
        if (entry.quantity.name != "faults") { // a number from snapshots, a list in summary.json
            EXPECT_THAT(html, HasSubstr(nlohmann::json(entry.quantity.name).dump() + ":" +
                                        nlohmann::json(entry.quantity.doc).dump()));
        }
    EXPECT_THAT(html, HasSubstr(R"j("label":"dip at birth (°)","name":"dip_at_birth_deg")j"));
}

TEST(ReportPage, EveryMeasureHasALabelForPeople) {
    for (const archive::DictionaryEntry& entry : archive::dictionary(program_effects())) {
        EXPECT_THAT(entry.quantity.label, Not(testing::IsEmpty())) << entry.quantity.name;
        EXPECT_THAT(entry.quantity.label, Not(HasSubstr("_"))) << entry.quantity.name;
        EXPECT_EQ(archive::label_of(entry.quantity.name), entry.quantity.label)
            << entry.quantity.name;
    }
}

TEST(ReportPage, NamesRocksAsTheyWereRecordedAndGuessesNone) {
    Scene scene; // the numbers of mat18-b
    const ReportMoments moments;
    const auto rock = [&](std::optional<RockOrigins> origins) {
        const std::string html = report_html({.runs = {{.scene = scene,
                                                        .moments = moments,
                                                        .mean_radius = 75.0,
                                                        .history = "extension_m\n0\n",
                                                        .rocks = std::move(origins)}}});
        const std::size_t at = html.find("\"rock\":\"");
        return html.substr(at + 8, html.find('"', at + 8) - at - 8);
    };
    EXPECT_EQ(rock(std::nullopt), "rock: not recorded");
    EXPECT_EQ(rock(RockOrigins{{"basement", "granite", {"bonds.friction"}}}),
              "rock: granite, friction changed");
}

TEST(ReportPage, NothingOfASceneIsATag) {
    Scene scene;
    scene.description = "</script><img src=x onerror=alert(1)>";
    const ReportMoments moments;
    const std::string html = report_html(
        {.runs = {{scene, moments, 75.0, "extension_m\n0\n", R"({"a": "<tag-of-mine>"})"}}});
    EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
    EXPECT_THAT(html, Not(HasSubstr("<tag-of-mine>")));
    EXPECT_THAT(html, HasSubstr(R"("description":"\u003c/script>\u003cimg src=x)"));
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
    EXPECT_THAT(html, Not(HasSubstr("{{data}}")));
}

TEST(ReportPage, WhatIsDamagedIsMissingAndThePageSaysSo) {
    Scene scene;
    const ReportMoments moments;
    const std::string history = "extension_m,x\n0,\n1,2\n";
    const auto page = [&](const std::string& table, const std::string& summary, bool there = true) {
        return ReportPage{.runs = {{scene, moments, 75.0, table, summary, "out/a/", there}}};
    };
    for (const char* damaged : {R"({"finished": tr)", R"({"a": 1e999})", "[]", "null", "3", "\"a\"",
                                "", "{\"a\": \"\xff\"}", R"({"a": NaN})", "{} {}"}) {
        const ReportPage bad = page(history, damaged);
        const std::string html = report_html(bad);
        EXPECT_THAT(html, HasSubstr(R"("summary":null)")) << damaged;
        EXPECT_THAT(html, HasSubstr(R"("lacks":["out/a/summary.json is damaged)")) << damaged;
        EXPECT_THAT(html, Not(HasSubstr("discarded>"))) << damaged;
        EXPECT_THAT(lacks_of(bad), testing::ElementsAre(HasSubstr("summary.json is damaged")));
    }
    EXPECT_NO_THROW(report_html(
        page(history, "{\"a\": " + std::string(300'000, '[') + std::string(300'000, ']') + "}")));
    EXPECT_THAT(lacks_of(page(history, "{}")), testing::IsEmpty());
    EXPECT_THAT(lacks_of(page(history, "", false)), testing::IsEmpty()); // the run goes on
    EXPECT_THAT(lacks_of(page("", "", false)), testing::IsEmpty());
}

} // namespace
} // namespace listric::report_page_test
