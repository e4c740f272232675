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
  const std::string check = "check 'a b.toml' --flip-limit 0.5 --threads 2 --report out/it --quiet";
  EXPECT_EQ(drape(folder, check).code, 0);
  const std::string report = content(folder.path("out/it/report.html"));
  const auto escaped = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 5) text.replace(at, 1, "&#39;");
    return text;
  };
  EXPECT_TRUE(has_command(report, escaped("drape " + check))) << report.substr(report.find("<h1"), 1000);
  EXPECT_TRUE(has_command(report, escaped("drape check 'a b.toml' --flip-limit 0.5 --report out/it --threads 2")));
  EXPECT_EQ(report.find("Accept the change"), std::string::npos) << "nothing changed";

  const std::string compare = "compare 'a b.toml' --vary integrator.method=liu13,implicit --quality draft -o ab.html";
  EXPECT_EQ(drape(folder, compare).code, 0);
  EXPECT_TRUE(has_command(content(folder.path("ab.html")), escaped("drape " + compare)));
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
