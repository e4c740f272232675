// Faults around goldens: damaged ones, files that are no golden, odd names, signals, a full standard output.

#include <gtest/gtest.h>
#include <signal.h>
#include <tinyxml2.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"
#include "tests/support/random.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

using test::drape;

const std::string golden_scene = test::swinging_scene + "[check]\nframes = [0, 10]\nsize = [64, 48]\n";

/// Returns the files of a folder.
std::map<std::string, std::string> files(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) all[fs::relative(entry.path(), folder)] = test::content(entry.path());
  }
  return all;
}

nlohmann::json json_of(const test::SceneFolder& folder) {
  return nlohmann::json::parse(test::content(folder.path() / "out/check/report.json"));
}

bool is_xml(const fs::path& file) {
  tinyxml2::XMLDocument xml;
  return xml.Parse(test::content(file).c_str()) == tinyxml2::XML_SUCCESS;
}

TEST(GoldenFaults, EverySceneIsJudgedWhateverIsWrongWithAnotherOne) {
  const test::SceneFolder folder;
  for (const char* name : {"a", "b", "c"}) folder.write(std::string(name) + ".toml", golden_scene);
  ASSERT_EQ(drape(folder, "bless a.toml b.toml c.toml").code, 0);
  folder.write("a.golden/motion.bin", "nonsense");
  fs::remove(folder.path() / "b.golden/frames/0010.png");
  const auto checked = drape(folder, "check c.toml a.toml b.toml");
  EXPECT_EQ(checked.code, 2) << checked.text;
  for (const char* line :
       {"c.toml: passed: motion same bits", "a.toml: error: a.golden/motion.bin: has been modified since it was",
        "b.toml: error: b.golden/frames/0010.png: is missing; restore it"}) {
    EXPECT_NE(checked.text.find(line), std::string::npos) << checked.text;
  }
  std::vector<std::string> verdicts;
  const nlohmann::json all = json_of(folder);
  for (const auto& of : all.at("scenes")) verdicts.push_back(of.at("verdict"));
  EXPECT_EQ(verdicts, (std::vector<std::string>{"passed", "error", "error"}));
  EXPECT_TRUE(is_xml(folder.path() / "out/check/junit.xml"));
  EXPECT_EQ(drape(folder, "check c.toml").code, 0);
}

TEST(GoldenFaults, WhatIsNoGoldenIsNeitherReplacedNorChecked) {
  const test::SceneFolder folder;
  folder.write("swing.toml", golden_scene);
  folder.write("swing.golden/letter.txt", "a letter");
  for (const char* command :
       {"bless swing.toml", "check swing.toml", "check swing.toml --update all", "check swing.toml --update none"}) {
    const auto finished = drape(folder, command);
    EXPECT_EQ(finished.code, 2) << command << ": " << finished.text;
    EXPECT_NE(finished.text.find("swing.golden: is not a golden"), std::string::npos) << finished.text;
    EXPECT_EQ(files(folder.path() / "swing.golden"), (std::map<std::string, std::string>{{"letter.txt", "a letter"}}));
  }
}

TEST(GoldenFaults, NothingIsRecordedIfOneOfTheGoldensCannotBe) {
  const test::SceneFolder folder;
  for (const char* name : {"a", "b"}) folder.write(std::string(name) + ".toml", golden_scene);
  folder.write("b.golden", "a letter");
  const auto finished = drape(folder, "bless a.toml b.toml");
  EXPECT_EQ(finished.code, 2) << finished.text;
  EXPECT_NE(finished.text.find("b.golden: is a file"), std::string::npos) << finished.text;
  EXPECT_FALSE(fs::exists(folder.path() / "a.golden"));
  EXPECT_EQ(test::content(folder.path() / "b.golden"), "a letter");
}

TEST(GoldenFaults, Kill9LeavesOneGoldenOrTheOther) {
  test::Random random(static_cast<std::uint64_t>(getpid()));
  const test::SceneFolder folder;
  const fs::path golden = folder.path() / "swing.golden";
  folder.write("swing.toml", golden_scene);
  ASSERT_EQ(drape(folder, "bless swing.toml").code, 0);
  fs::copy(golden, folder.path() / "first", fs::copy_options::recursive);
  const auto first = files(golden);
  folder.write("swing.toml", test::swinging_scene + "[check]\nframes = [0, 5]\nsize = [64, 48]\n");
  for (int attempt = 0; attempt < 6; ++attempt) {
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder.path().c_str()) != 0) _exit(99);
      execl(DRAPE_EXECUTABLE, DRAPE_EXECUTABLE, "bless", "swing.toml", "--quiet", static_cast<char*>(nullptr));
      _exit(99);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(random.between(0, 0.4)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    if (files(golden) == first) continue;
    EXPECT_EQ(drape(folder, "check swing.toml --update none").code, 0);
    EXPECT_EQ(files(golden).size(), first.size());
    fs::remove_all(golden);
    fs::copy(folder.path() / "first", golden, fs::copy_options::recursive);
  }
}

TEST(GoldenFaults, AMotionMayBeAnyDistanceAway) {
  const test::SceneFolder folder;
  folder.write("swing.toml", golden_scene + "[cloth.transform]\ntranslate = [1e12, 0, 0]\n");
  EXPECT_EQ(drape(folder, "check --update all swing.toml").code, 0);
  const auto finished = drape(folder, "check --update none swing.toml");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find("motion same bits"), std::string::npos) << finished.text;
}

TEST(GoldenFaults, ScenesOfAnyNameAreReportedBelowTheReport) {
  const test::SceneFolder folder;
  // The name of the last one is Latin-1.
  const std::vector<std::string> names{"...toml",        "report.html.toml", "junit.xml.toml", "{x}.toml",
                                       "a\x01\x1B.toml", ".hidden.toml",     "a/swing.toml",   "b/swing.toml",
                                       "b/a-swing.toml", "sw\xE4ng.toml"};
  std::string all;
  for (const std::string& name : names) {
    folder.write("scenes/" + name, golden_scene);
    all += " 'scenes/" + name + "'";
  }
  ASSERT_EQ(drape(folder, "bless" + all).code, 0);
  const auto before = files(folder.path() / "scenes");
  const auto finished = drape(folder, "check --update none --set look.color=red" + all);
  EXPECT_EQ(finished.code, 1) << finished.text;
  EXPECT_EQ(files(folder.path() / "scenes"), before);
  const fs::path out = folder.path() / "out";
  EXPECT_EQ(std::distance(fs::directory_iterator(out), {}), 1);
  EXPECT_TRUE(is_xml(out / "check/junit.xml"));
  std::set<std::string> reported;
  const nlohmann::json found = json_of(folder);
  for (const auto& of : found.at("scenes")) {
    const std::string name = of.at("name");
    EXPECT_TRUE(reported.insert(name).second) << name;
    EXPECT_TRUE(fs::is_regular_file(out / "check" / name / "difference.gif")) << name;
    const std::string expected = of.at("windows").at("frames")[0].at("files").at("expected");
    EXPECT_TRUE(fs::is_regular_file(out / "check" / expected)) << expected;
  }
  EXPECT_EQ(reported.size(), names.size());
}

TEST(GoldenFaults, AReportGoesIntoAFolderOfAnyName) {
  const test::SceneFolder folder;
  folder.write("swing.toml", golden_scene);
  ASSERT_EQ(drape(folder, "bless swing.toml").code, 0);
  for (const char* name : {"{x}", "a{scene}", "{frame}"}) {
    const auto finished = drape(folder, std::string("check swing.toml --set look.color=red --report '") + name + "'");
    EXPECT_EQ(finished.code, 1) << finished.text;
    EXPECT_TRUE(fs::exists(folder.path() / name / "swing/difference.gif"));
    EXPECT_TRUE(fs::exists(folder.path() / name / "report.html"));
  }
}

TEST(GoldenFaults, AVerdictThatCannotBePrintedIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  const test::SceneFolder folder;
  folder.write("swing.toml", golden_scene);
  ASSERT_EQ(drape(folder, "bless swing.toml").code, 0);
  const auto finished = drape(folder, "check swing.toml 2>err >/dev/full; exit $? #");
  EXPECT_EQ(finished.code, 4);
  EXPECT_NE(test::content(folder.path() / "err").find("standard output"), std::string::npos);
  EXPECT_EQ(json_of(folder).at("passed"), true);  // the report exists nevertheless
}

TEST(GoldenFaults, AReportThatCannotBeWrittenIsSaidBeforeAnythingIsComputed) {
  const test::SceneFolder folder;
  folder.write("swing.toml", golden_scene);
  folder.write("out/check", "a file where the folder should be");
  const auto finished = drape(folder, "check swing.toml");
  EXPECT_EQ(finished.code, 4) << finished.text;
  EXPECT_NE(finished.text.find("out/check"), std::string::npos) << finished.text;
  EXPECT_FALSE(fs::exists(folder.path() / "swing.golden"));
}

TEST(GoldenFaults, ThreadsAreANumber) {
  const test::SceneFolder folder;
  folder.write("swing.toml", golden_scene);
  for (const char* number : {"-1", "0", "1.5", "18446744073709551615", "many"}) {
    const auto finished = drape(folder, std::string("check swing.toml --threads ") + number);
    EXPECT_EQ(finished.code, 2) << finished.text;
    EXPECT_NE(finished.text.find("--threads"), std::string::npos) << finished.text;
  }
  ASSERT_EQ(drape(folder, "bless swing.toml").code, 0);
  EXPECT_EQ(drape(folder, "check swing.toml --threads 1000").code, 0);
}

}  // namespace
}  // namespace drape
