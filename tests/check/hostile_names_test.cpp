// Names with a special meaning for pages, reports or build servers, in all outputs of a check.

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>

#include "check/html_report.hpp"
#include "check/report.hpp"
#include "core/text.hpp"
#include "tests/support/hostile_names.hpp"

namespace drape {
namespace {

/// Makes a check of two scenes, one failed, with the name in all of its texts.
CheckReport report_of(const std::string& name) {
  CheckReport report;
  report.date = "2026-01-31T12:00:00Z";
  report.command = "drape check '" + name + "'";
  report.accept_command = "drape accept '" + name + "'";
  report.machine.processor = report.machine.renderer = name;
  for (const bool passed : {true, false}) {
    SceneResult scene;
    scene.name = name;
    scene.file = name + ".toml";
    scene.golden = name + ".golden";
    scene.verdict = passed ? SceneVerdict::passed : SceneVerdict::changed;
    scene.findings = {{FindingKind::error, name}, {FindingKind::method, "today's " + name, name}};
    scene.recorded_at = name;
    scene.recorded_on = {name, name, name, name, name, name, name};
    scene.checked_on.renderer = "another " + name;
    scene.rerun_command = scene.accept_command = "drape check '" + name + "'";
    scene.size = {64, 48};
    scene.windows.motion = passed ? MotionVerdict::same_bits : MotionVerdict::changed;
    WindowResult window;
    window.problem = {.fault = WindowFault::moved_body, .of = name};
    window.verdict = scene.windows.motion;
    scene.windows.windows = {window};
    report.scenes.push_back(scene);
  }
  return report;
}

std::ptrdiff_t count(const std::string& text, char sign) { return std::count(text.begin(), text.end(), sign); }

class HostileName : public testing::TestWithParam<std::string> {};

TEST_P(HostileName, IsTextOnThePage) {
  const std::string page = html_report(report_of(GetParam())), plain = html_report(report_of("plain"));
  EXPECT_EQ(page, printable(page));
  EXPECT_FALSE(test::has_controls(page));
  EXPECT_EQ(count(page, '<'), count(plain, '<'));
  EXPECT_EQ(count(page, '>'), count(plain, '>'));
  EXPECT_EQ(count(page, '"'), count(plain, '"'));
}

TEST_P(HostileName, IsTextInJUnit) {
  const std::string junit = junit_report(report_of(GetParam()));
  EXPECT_FALSE(test::has_controls(junit));
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(junit.c_str()), tinyxml2::XML_SUCCESS);
  const auto* test = xml.RootElement()->FirstChildElement("testsuite")->FirstChildElement("testcase");
  EXPECT_EQ(test->Attribute("classname"), printable(GetParam() + ".toml"));
}

TEST_P(HostileName, IsOneCellOfGitHubsSummary) {
  const std::string summary = github_summary(report_of(GetParam())), plain = github_summary(report_of("plain"));
  EXPECT_FALSE(test::has_controls(summary));
  EXPECT_EQ(count(summary, '\n'), count(plain, '\n'));
  std::string unescaped;  // Markdown's special characters in the table without a backslash before them
  for (std::size_t i = 0; i < summary.rfind("\nTo accept"); ++i) {
    if (summary[i] == '\\') {
      ++i;
    } else {
      unescaped += summary[i];
    }
  }
  EXPECT_EQ(unescaped.find_first_of("<>`*_[]&$~"), std::string::npos) << unescaped;
  EXPECT_EQ(count(unescaped, '|'), count(plain, '|'));
}

TEST_P(HostileName, IsOneAnnotation) {
  const std::string lines = github_annotations(report_of(GetParam()));
  EXPECT_FALSE(test::has_controls(lines));
  EXPECT_EQ(count(lines, '\n'), 1);
  EXPECT_TRUE(lines.starts_with("::error file="));
  // The properties end at the first "::" after the start; the name's own colons and commas are written as %3A and %2C.
  const std::string properties = lines.substr(8, lines.find("::", 2) - 8);
  EXPECT_EQ(count(properties, ','), 1) << properties;
  EXPECT_EQ(count(properties, '='), 2 + count(GetParam(), '=')) << properties;
}

INSTANTIATE_TEST_SUITE_P(All, HostileName, testing::ValuesIn(test::hostile_names),
                         [](const auto& instance) { return std::to_string(instance.index); });

}  // namespace
}  // namespace drape
