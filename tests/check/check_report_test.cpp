// Reports of a check's results.

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <nlohmann/json.hpp>

#include "check/html_report.hpp"
#include "check/report.hpp"
#include "cli/exit_code.hpp"
#include "core/text.hpp"
#include "tests/check/checked_scene.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

class CheckReports : public test::CheckedScene {};

TEST_F(CheckReports, ReportsToMachines) {
  bless();
  CheckReport report;
  report.date = "2026-01-31T12:00:00Z";
  report.scenes.push_back(check());
  for (const char* change : {"look.color=red", "cloth.mass=1.2"}) report.scenes.push_back(check({change}));
  report.scenes[1].name = "red & <blue>";
  EXPECT_FALSE(report.passed());
  const auto json = nlohmann::json::parse(json_report(report));
  EXPECT_EQ(json.at("passed"), false);
  EXPECT_EQ(json.at("scenes")[0].at("windows").at("motion"), "same bits");
  EXPECT_EQ(json.at("scenes")[1].at("windows").at("picture"), "changed");
  EXPECT_EQ(json.at("scenes")[1].at("windows").at("motion"), "same bits");
  EXPECT_EQ(json.at("scenes")[2].at("windows").at("windows")[0].at("deviations").size(), 3u);

  write_frame_files(report, folder_ / "report");
  const std::string difference = json.at("scenes")[1].at("windows").at("frames")[0].at("files").at("difference");
  EXPECT_TRUE(test::content(folder_ / "report" / difference).starts_with("\x89PNG"));

  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(junit_report(report).c_str()), tinyxml2::XML_SUCCESS);
  const auto* suite = xml.RootElement()->FirstChildElement("testsuite");
  EXPECT_EQ(suite->IntAttribute("tests"), 6);
  EXPECT_EQ(suite->IntAttribute("failures"), 2);
  int cases = 0, failures = 0;
  for (const auto* test = suite->FirstChildElement("testcase"); test != nullptr; test = test->NextSiblingElement()) {
    ++cases;
    failures += test->FirstChildElement("failure") != nullptr ? 1 : 0;
  }
  EXPECT_EQ(cases, 6);
  EXPECT_EQ(failures, 2);
}

TEST_F(CheckReports, ReportAFilmAtAnotherSpeedAsAFailure) {
  bless();
  CheckReport report;
  report.scenes.push_back(check({"video.speed=0.5", "video.fps=15"}));
  EXPECT_EQ(exit_code(report), ExitCode::differs);
  const auto scene = nlohmann::json::parse(json_report(report)).at("scenes")[0];
  const std::string change = sentences(report.scenes[0]).at(0);
  EXPECT_EQ(scene.at("film"), change);
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(junit_report(report).c_str()), tinyxml2::XML_SUCCESS);
  const auto* suite = xml.RootElement()->FirstChildElement("testsuite");
  EXPECT_EQ(suite->IntAttribute("failures"), 1);
  const auto* film = suite->LastChildElement("testcase");
  EXPECT_STREQ(film->Attribute("name"), "film");
  EXPECT_EQ(film->FirstChildElement("failure")->Attribute("message"), change);
}

TEST_F(CheckReports, ReportsWhatCannotBeJudged) {
  bless();
  put(golden() / "motion.bin", "drape motion 2\n");
  CheckReport report;
  report.date = "2026-01-31T12:00:00Z";
  LoadedScene odd = scene();
  odd.source.file = folder_ / "sw\xE4ng\x01.toml";  // Latin-1, and a control character
  try {
    check();
  } catch (const UsageError& error) {
    report.scenes.push_back(unjudged_scene(odd, "swing", odd.check, error));
  }
  ASSERT_EQ(report.scenes.size(), 1u);
  EXPECT_EQ(exit_code(report), ExitCode::usage);

  const auto json = nlohmann::json::parse(json_report(report));
  EXPECT_EQ(json.at("passed"), false);
  EXPECT_EQ(json.at("scenes")[0].at("verdict"), "error");
  EXPECT_NE(json.at("scenes")[0].at("findings")[0].get<std::string>().find(
                "motion.bin: has been modified since it was recorded"),
            std::string::npos);

  const std::string junit = junit_report(report);
  EXPECT_EQ(junit, printable(junit));
  tinyxml2::XMLDocument xml;
  ASSERT_EQ(xml.Parse(junit.c_str()), tinyxml2::XML_SUCCESS);
  const auto* suite = xml.RootElement()->FirstChildElement("testsuite");
  EXPECT_EQ(suite->IntAttribute("errors"), 1);
  EXPECT_EQ(suite->IntAttribute("failures"), 0);
  EXPECT_NE(suite->FirstChildElement("testcase")->FirstChildElement("error"), nullptr);

  const std::string page = html_report(report);
  EXPECT_EQ(page, printable(page));
  EXPECT_NE(page.find("The scene could not be judged"), std::string::npos);
}

TEST(CheckReport, IsAsBadAsItsWorstScene) {
  CheckReport report;
  EXPECT_EQ(exit_code(report), ExitCode::ok);
  const auto add = [&](SceneVerdict verdict, ErrorKind error = ErrorKind::usage) {
    report.scenes.emplace_back().verdict = verdict;
    report.scenes.back().error = error;
    return exit_code(report);
  };
  EXPECT_EQ(add(SceneVerdict::updated), ExitCode::ok);
  EXPECT_EQ(add(SceneVerdict::missing), ExitCode::differs);
  EXPECT_EQ(add(SceneVerdict::error, ErrorKind::diverged), ExitCode::diverged);
  EXPECT_EQ(add(SceneVerdict::error, ErrorKind::usage), ExitCode::diverged);
  EXPECT_EQ(add(SceneVerdict::passed), ExitCode::diverged);
}

}  // namespace
}  // namespace drape
