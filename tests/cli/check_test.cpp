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

TEST(CheckCommand, ItsPagesRepeatWhatWasTyped) {
  const test::SceneFolder folder;
  folder.write("swing.toml", scene);
  ASSERT_EQ(drape(folder, "bless swing.toml").code, 0);
  const std::string typed = "check swing.toml --set cloth.mass=1.1 --update none --motion-tolerance 1e-05";
  ASSERT_EQ(drape(folder, typed + " --report r --threads 1 --jobs 2").code, 1);
  const std::string page = test::content(folder.path("r/report.html")),
                    junit = test::content(folder.path("r/junit.xml"));
  EXPECT_NE(page.find("drape " + typed + " --report r --threads 1 --jobs 2<"), std::string::npos);
  for (const std::string& text : {page, junit, test::content(folder.path("r/report.json"))}) {
    EXPECT_NE(text.find("drape " + typed + " --report r"), std::string::npos);
    EXPECT_NE(text.find("hecked with --set cloth.mass=1.1: to make that golden, edit the scene"), std::string::npos);
    EXPECT_EQ(text.find("drape bless"), std::string::npos);
    EXPECT_EQ(text.find("he scene file has changed"), std::string::npos);
  }
  EXPECT_EQ(junit.find("accept:"), std::string::npos) << junit;

  folder.write("swing.toml", scene + "[look]\ncolor = \"red\"\n");
  const auto both = drape(folder, "check swing.toml --set cloth.mass=1.1 --update none");
  EXPECT_NE(both.text.find("the scene file has changed since"), std::string::npos) << both.text;
}

TEST(CheckCommand, RecordsNoGoldenOfOtherValues) {
  const test::SceneFolder folder;
  folder.write("swing.toml", scene);
  const auto missing = drape(folder, "check swing.toml --set cloth.mass=1.1");
  EXPECT_EQ(missing.code, 1);
  EXPECT_NE(missing.text.find("swing.toml: missing: there is no golden to compare with\n"), std::string::npos)
      << missing.text;
  const auto all = drape(folder, "check swing.toml --set cloth.mass=1.1 --update all");
  EXPECT_EQ(all.code, 2);
  EXPECT_EQ(all.text,
            "drape: --update all records what the scene files say: edit them instead of giving --set cloth.mass=1.1\n");
  EXPECT_FALSE(fs::exists(folder.path("swing.golden")));
}

TEST(CheckCommand, DoesNotCallExactWhatItDidNotJudge) {
  const test::SceneFolder folder;
  folder.write("swing.toml", scene);
  ASSERT_EQ(drape(folder, "bless swing.toml").code, 0);
  for (const char* ignored : {"ignore = [[0, 0, 64, 48]]", "ignore_frames = [0, 10]"}) {
    folder.write("swing.toml", scene + ignored + "\n[look]\ncolor = \"red\"\n");
    const auto finished = drape(folder, "check swing.toml --update none");
    EXPECT_EQ(finished.code, 0) << finished.text;
    EXPECT_NE(finished.text.find("2 pictures not judged"), std::string::npos) << finished.text;
    EXPECT_EQ(finished.text.find("exact"), std::string::npos) << finished.text;
  }
}

TEST(CheckCommand, NamesTheSceneThatHasNoSuchKey) {
  const test::SceneFolder folder;
  folder.write("a.toml", scene);
  folder.write("b.toml", scene + "[effects.sphere]\ncenter = [0, 0, 0]\nradius = 0.1\n");
  const std::string problem =
      "--set effects.sphere.radius=1: missing key 'center', 'keyframes' or 'track' in [effects.sphere]\n";
  for (const char* command : {"check", "render", "simulate"}) {
    EXPECT_EQ(drape(folder, std::string(command) + " a.toml b.toml --set effects.sphere.radius=1").text,
              "drape: a.toml: " + problem);
    EXPECT_EQ(drape(folder, std::string(command) + " a.toml b.toml --set foo").text,
              "drape: --set foo: expected key.path=value, found no '='\n");
  }
  EXPECT_EQ(drape(folder, "check a.toml --set effects.sphere.radius=1").text, "drape: " + problem);
  EXPECT_EQ(drape(folder, "compare a.toml b.toml --vary effects.sphere.radius=1").text,
            "drape: a.toml: --vary effects.sphere.radius=1: missing key 'center', 'keyframes' or 'track' in "
            "[effects.sphere]\n");
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
  expect("check swing.drape", "swing.drape: it ends after step 1, its scene after step 20: record it without --steps");
  EXPECT_EQ(drape(folder, "simulate swing.toml --steps 30 -o swing.drape").code, 0);
  expect("check swing.drape", "swing.drape: it ends after step 30, its scene after step 20: record it without --steps");
  EXPECT_EQ(drape(folder, "simulate swing.toml --every 4 -o swing.drape").code, 0);
  expect("check swing.drape", "swing.drape: it has 6 states of 20 steps, and a check needs all");
  EXPECT_EQ(drape(folder, "bless swing.toml").code, 0);
  std::ofstream(folder.path() / "swing.golden/motion.bin", std::ios::binary) << "nonsense";
  expect("check swing.toml", "swing.golden/motion.bin: has been modified since it was recorded");
}

}  // namespace
}  // namespace drape
