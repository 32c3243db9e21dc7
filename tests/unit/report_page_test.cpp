#include "apps/figures/report_page.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace listric {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ReportPage, TakesDefinitionsFromTables) {
    const auto found = nlohmann::json::parse(definitions_of("# Measures\n"
                                                            "| name | what |\n|---|---|\n"
                                                            "| `a_m` `b_m` | two `c` | of it |\n"
                                                            "| plain | no |\n| `d` |\n"));
    EXPECT_EQ(found, (nlohmann::json{{"a_m", "two `c` | of it"}, {"b_m", "two `c` | of it"}}));
}

TEST(ReportPage, NothingOfASceneIsATag) {
    Scene scene;
    scene.description = "</script><img src=x onerror=alert(1)>";
    scene.hanging_wall.emplace();
    const ReportMoments moments;
    const std::string html = report_html(
        {.runs = {{scene, moments, 75.0, "extension_m\n0\n", R"({"a": "<tag-of-mine>"})"}}});
    EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
    EXPECT_THAT(html, Not(HasSubstr("<tag-of-mine>")));
    EXPECT_THAT(html, HasSubstr(R"("description":"\u003c/script>\u003cimg src=x)"));
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
    EXPECT_THAT(html, Not(HasSubstr("{{data}}")));
}

TEST(ReportPage, ASummaryThatIsNoJsonIsNone) {
    Scene scene;
    scene.hanging_wall.emplace();
    const ReportMoments moments;
    EXPECT_NO_THROW(report_html({.runs = {{scene, moments, 75.0, "", "{\"cut"}}}));
}

} // namespace
} // namespace listric
