#include <gtest/gtest.h>

#include <fstream>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;
using test::drape;

const std::string scene = test::swinging_scene + "[check]\nframes = [0, 10]\nsize = [64, 48]\n";

TEST(CheckCommand, BlessesChecksAndFails) {
  const test::SceneFolder folder;
  folder.write("swing.toml", scene);
  const auto blessed = drape(folder, "bless swing.toml");
  EXPECT_EQ(blessed.code, 0) << blessed.text;
  EXPECT_TRUE(fs::exists(folder.path() / "swing.golden/frames/0010.png"));

  const auto passed = drape(folder, "check swing.toml --end-to-end");
  EXPECT_EQ(passed.code, 0) << passed.text;
  EXPECT_NE(passed.text.find("swing.toml: passed: motion same bits, 2 pictures exact; end to end same bits, exact"),
            std::string::npos)
      << passed.text;
  for (const char* file : {"report.json", "junit.xml", "report.html", "swing/motion.svg", "swing/pictures.csv",
                           "swing/end_to_end.motion.tex", "swing/end_to_end.pictures.md"}) {
    EXPECT_TRUE(fs::exists(folder.path() / "out/check" / file)) << file;
  }

  const auto failed = drape(folder, "check swing.toml --set cloth.mass=1.1 --report elsewhere");
  EXPECT_EQ(failed.code, 1) << failed.text;
  EXPECT_NE(failed.text.find("swing.toml: changed: the motion changed at step "), std::string::npos) << failed.text;
  EXPECT_NE(test::content(folder.path() / "elsewhere/report.json").find("drape check swing.toml --set cloth.mass=1.1"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(folder.path() / "elsewhere/swing/difference.gif"));
}

TEST(CheckCommand, AMissingGoldenIsWrittenAndFails) {
  const test::SceneFolder folder;
  folder.write("swing.toml", scene);
  EXPECT_EQ(drape(folder, "check swing.toml --update none").code, 1);
  EXPECT_FALSE(fs::exists(folder.path() / "swing.golden"));
  const auto written = drape(folder, "check swing.toml");
  EXPECT_EQ(written.code, 1) << written.text;
  EXPECT_NE(written.text.find("swing.toml: missing: there was no golden"), std::string::npos) << written.text;
  EXPECT_EQ(drape(folder, "check swing.toml").code, 0);
}

TEST(CheckCommand, QuietPrintsOnlyWhatChanged) {
  const test::SceneFolder folder;
  folder.write("swing.toml", scene);
  EXPECT_EQ(drape(folder, "bless swing.toml --quiet").text, "");
  EXPECT_EQ(drape(folder, "check swing.toml --quiet").text, "");
  const auto failed = drape(folder, "check swing.toml --quiet --set look.color=red");
  EXPECT_EQ(failed.code, 1);
  EXPECT_NE(failed.text.find("swing.toml: changed: 2 of 2 pictures changed"), std::string::npos) << failed.text;
  EXPECT_NE(failed.text.find("the motion did not change"), std::string::npos) << failed.text;
}

TEST(CheckCommand, LimitsCanBeWiderOnTheCommandLine) {
  const test::SceneFolder folder;
  folder.write("swing.toml", scene + "[look]\nbackground = \"white\"\n");
  EXPECT_EQ(drape(folder, "bless swing.toml").code, 0);
  const std::string check = "check swing.toml --set look.background=#fefefe";
  EXPECT_EQ(drape(folder, check).code, 1);
  const auto wide = drape(folder, check + " --pixel-limit 1 --flip-limit 1");
  EXPECT_EQ(wide.code, 0) << wide.text;
  EXPECT_NE(wide.text.find("2 pictures noise"), std::string::npos) << wide.text;
  const auto slow = drape(folder, "check swing.toml --set cloth.stiffness=50.000001 --motion-tolerance 0.01");
  EXPECT_EQ(slow.code, 0) << slow.text;
  EXPECT_NE(slow.text.find("motion within tolerance"), std::string::npos) << slow.text;
}

TEST(CheckCommand, SaysWhatIsWrongWithItsOptions) {
  const test::SceneFolder folder;
  folder.write("swing.toml", scene);
  const auto expect = [&](const std::string& arguments, const std::string& message) {
    const auto finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_NE(finished.text.find(message), std::string::npos) << finished.text;
  };
  expect("check swing.toml --update misssing", "--update: unknown 'misssing'; did you mean 'missing'?");
  expect("check swing.toml --update changed",
         "--update changed no longer exists: look at the report of a check, then accept");
  expect("check swing.toml --set check.window=20",
         "'window' in [check] no longer exists: the whole motion is compared now, in windows of 'window_time' seconds");
  expect("accept out/check", "out/check: no such folder; expected the report folder of a check");
  expect("check swing.toml --frames 1,,2", "--frames takes frame numbers A,B,C, counted from 0; found '1,,2'");
  expect("bless swing.toml --frames 1000", "the film ends with frame 10");
  expect("check nowhere.toml", "nowhere.toml: no such file");
  EXPECT_EQ(drape(folder, "simulate swing.toml --steps 1 -o swing.drape").code, 0);
  expect("check swing.drape", "swing.drape: this is a binary file, not a text");
  EXPECT_EQ(drape(folder, "bless swing.toml").code, 0);
  std::ofstream(folder.path() / "swing.golden/motion.bin", std::ios::binary) << "nonsense";
  expect("check swing.toml", "swing.golden/motion.bin: has been modified since it was recorded");
}

}  // namespace
}  // namespace drape
