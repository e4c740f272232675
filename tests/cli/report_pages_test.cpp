#include <gtest/gtest.h>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

// Commands on pages, and the style of their diagrams' files.

namespace drape::report_pages_cli {
namespace {

using test::content;
using test::drape;
using test::SceneFolder;

const std::string scene = test::swinging_scene + "[video]\nsize = [64, 48]\n";

/// Returns true if a page has a command to copy.
bool has_command(const std::string& page, const std::string& command) {
  return page.find(">" + command + "</code>") != std::string::npos;
}

TEST(ReportPage, NamesTheCommandAsItWasTyped) {
  const SceneFolder folder;
  folder.write("a b.toml", scene);
  drape(folder, "bless 'a b.toml'");
  const std::string check = "check 'a b.toml' --flip-limit 0.5 --threads 2 --report out/it --style paper --quiet";
  EXPECT_EQ(drape(folder, check).code, 0);
  const std::string report = content(folder.path("out/it/report.html"));
  const auto escaped = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 5) text.replace(at, 1, "&#39;");
    return text;
  };
  EXPECT_TRUE(has_command(report, escaped("drape " + check))) << report.substr(report.find("<h1"), 1000);
  EXPECT_TRUE(has_command(
      report, escaped("drape check 'a b.toml' --flip-limit 0.5 --report out/it --style paper --threads 2")));
  EXPECT_EQ(report.find("Accept the change"), std::string::npos) << "nothing changed";

  const std::string compare = "compare 'a b.toml' --vary integrator.method=liu13,implicit --quality draft -o ab.html";
  EXPECT_EQ(drape(folder, compare).code, 0);
  EXPECT_TRUE(has_command(content(folder.path("ab.html")), escaped("drape " + compare)));
}

TEST(ReportPage, NamesTheCommandOfAStudyAsItWasTyped) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  const auto page = [&](const char* place) { return content(folder.path(place)); };
  const std::string accuracy =
      "study accuracy a.toml --parts asked --times 0.1 --steps 0.02 --accuracies 1e-3 --methods liu13 --runs 1 "
      "--animate none -o acc --style paper --quiet";
  ASSERT_EQ(drape(folder, accuracy).code, 0);
  EXPECT_TRUE(has_command(page("acc/report.html"), "drape " + accuracy));
  const std::string validation = "study validation rolled-sheet --quick --jobs 1 --patience 60 -o val --quiet";
  ASSERT_EQ(drape(folder, validation).code, 0);
  EXPECT_TRUE(has_command(page("val/report.html"), "drape " + validation));
  // A report that is recreated, or resumed, is still of the command that measured.
  for (const char* again : {"study accuracy --report-only -o acc", "study validation --report-only -o val"}) {
    ASSERT_EQ(drape(folder, again).code, 0);
  }
  ASSERT_EQ(drape(folder, "study validation rolled-sheet --quick --resume -o val").code, 0);
  EXPECT_TRUE(has_command(page("acc/report.html"), "drape " + accuracy));
  EXPECT_TRUE(has_command(page("val/report.html"), "drape " + validation));
}

TEST(ReportPage, HasARunsOwnCommandThatMakesIt) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  ASSERT_EQ(drape(folder, "sweep a.toml --vary cloth.mass=1,2 --set time.duration=0.1 --steps 3").code, 0);
  const std::string command = "simulate a.toml --set time.duration=0.1 --set cloth.mass=2 --steps 3";
  EXPECT_TRUE(has_command(content(folder.path("out/sweep/report.html")), "drape " + command));
  EXPECT_EQ(drape(folder, command).code, 0);
}

TEST(ReportPage, SaysAfterSetThatTheSceneHasToBeEdited) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  drape(folder, "bless a.toml");
  EXPECT_EQ(drape(folder, "check a.toml --set cloth.mass=3").code, 1);
  const std::string report = content(folder.path("out/check/report.html"));
  EXPECT_EQ(report.find("Accept the change"), std::string::npos);
  EXPECT_EQ(report.find("Accept all changes"), std::string::npos);
  EXPECT_NE(report.find("First edit the scene files"), std::string::npos);
  EXPECT_TRUE(has_command(report, "drape check a.toml --set cloth.mass=3"));
}

TEST(ReportPage, HasDiagramsForPapersAsFiles) {
  const SceneFolder folder;
  folder.write("a.toml", scene);
  const auto exists = [&](const char* file) { return std::filesystem::exists(folder.path(file)); };
  EXPECT_EQ(drape(folder, "compare a.toml --vary integrator.method=liu13,implicit -o ab.html --style paper").code, 0);
  for (const char* file : {"ab-diagrams/energy.svg", "ab-diagrams/energy.dat", "ab-diagrams/energy.tikz.tex"}) {
    EXPECT_TRUE(exists(file)) << file;
  }
  EXPECT_FALSE(exists("ab-diagrams/energy.png"));
  EXPECT_NE(content(folder.path("ab-diagrams/energy.svg")).find("width=\"3.3in\""), std::string::npos);
  EXPECT_EQ(drape(folder, "sweep a.toml --vary cloth.mass=1,2 --style paper-wide").code, 0);
  EXPECT_TRUE(exists("out/sweep/diagrams/iterations.mean-over-cloth.mass.tikz.tex"));
  const test::Finished refused = drape(folder, "sweep a.toml --vary cloth.mass=1,2 --style papre");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.text.find("did you mean 'paper'"), std::string::npos) << refused.text;
}

}  // namespace
}  // namespace drape::report_pages_cli
