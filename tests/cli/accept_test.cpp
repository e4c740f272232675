// The findings of a failed check become the golden: all of them, one scene or one picture, and nothing else.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <thread>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"
#include "tests/support/random.hpp"

namespace drape::accept {
namespace {

namespace fs = std::filesystem;
using test::drape;

/// @param look additional lines of the scene's table [look]
std::string scene(const std::string& look, double mass = 1) {
  std::string text = test::swinging_scene;
  text.insert(text.find("stiffness"), "mass = " + std::to_string(mass) + "\n");
  return text + "[look]\n" + look + "[check]\nframes = [0, 5, 10]\nsize = [64, 48]\n";
}

std::map<std::string, std::string> files(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) all[fs::relative(entry.path(), folder)] = test::content(entry.path());
  }
  return all;
}

/// Two scenes with goldens, whose looks have changed, and their failed check.
class Accept : public ::testing::Test {
 protected:
  Accept() {
    for (const char* name : {"a", "b"}) folder_.write(std::string(name) + ".toml", scene(""));
    EXPECT_EQ(drape(folder_, "bless a.toml b.toml").code, 0);
    for (const char* name : {"a", "b"}) folder_.write(std::string(name) + ".toml", scene("color = \"red\"\n"));
    EXPECT_EQ(drape(folder_, "check a.toml b.toml --update none").code, 1);
  }

  [[nodiscard]] std::map<std::string, std::string> golden(const char* name) const {
    return files(folder_.path() / (std::string(name) + ".golden"));
  }

  void expect_refused(const std::string& command, const std::string& why) {
    const auto a = golden("a"), b = golden("b");
    const auto finished = drape(folder_, command);
    EXPECT_EQ(finished.code, 2) << finished.text;
    EXPECT_NE(finished.text.find(why), std::string::npos) << finished.text;
    EXPECT_EQ(golden("a"), a);
    EXPECT_EQ(golden("b"), b);
  }

  test::SceneFolder folder_;
};

TEST_F(Accept, EverythingPassesAfterwards) {
  const auto accepted = drape(folder_, "accept out/check");
  EXPECT_EQ(accepted.code, 0) << accepted.text;
  const auto checked = drape(folder_, "check a.toml b.toml --update none");
  EXPECT_EQ(checked.code, 0) << checked.text;
  // A passed check has nothing to accept.
  expect_refused("accept out/check", "out/check: there is nothing to accept: this check found no scene changed");
}

TEST_F(Accept, KeepsTheGoldensToleranceAndFrames) {
  const auto without_frames = [](const std::string& look) {
    std::string text = scene(look);
    return text.erase(text.find("frames = "), std::string("frames = [0, 5, 10]\n").size());
  };
  folder_.write("a.toml", without_frames(""));
  ASSERT_EQ(drape(folder_, "bless a.toml --frames 1,3").code, 0);
  folder_.write("a.toml", without_frames("color = \"red\"\n"));
  ASSERT_EQ(drape(folder_, "check a.toml --update none --motion-tolerance 1e-3").code, 1);
  ASSERT_EQ(drape(folder_, "accept out/check").code, 0);
  const auto checked = drape(folder_, "check a.toml --update none");
  EXPECT_EQ(checked.code, 0) << checked.text;
  const auto files = golden("a");
  EXPECT_TRUE(files.contains("frames/0001.png"));
  EXPECT_TRUE(files.contains("frames/0003.png"));
  EXPECT_EQ(files.size(), 4U);
}

TEST_F(Accept, OneSceneLeavesTheOtherAlone) {
  const auto before = golden("a");
  EXPECT_EQ(drape(folder_, "accept out/check b").code, 0);
  EXPECT_EQ(golden("a"), before);
  EXPECT_EQ(drape(folder_, "check b.toml --update none").code, 0);
  EXPECT_EQ(drape(folder_, "check a.toml --update none").code, 1);
  expect_refused("accept out/check c", "out/check: there is nothing to accept of 'c'");
}

TEST_F(Accept, OnePictureLeavesTheOthersAlone) {
  const auto before = golden("a");
  const auto accepted = drape(folder_, "accept out/check a.toml --frames 5");
  EXPECT_EQ(accepted.code, 0) << accepted.text;
  auto after = golden("a");
  EXPECT_NE(after["frames/0005.png"], before.at("frames/0005.png"));
  for (const char* name : {"frames/0005.png", "manifest.json"}) after[name] = before.at(name);
  EXPECT_EQ(after, before);
  EXPECT_EQ(drape(folder_, "check a.toml --update none --frames 5").code, 0);
  EXPECT_EQ(drape(folder_, "check a.toml --update none --frames 5,10").code, 1);
  EXPECT_EQ(drape(folder_, "check b.toml --update none").code, 1);
  expect_refused("accept out/check b --frames 7", "--frames: its golden has no frame 7");
}

TEST_F(Accept, ASceneWhoseNameBeginsWithADash) {
  folder_.write("-c.toml", scene(""));
  ASSERT_EQ(drape(folder_, "bless ./-c.toml").code, 0);
  folder_.write("-c.toml", scene("color = \"red\"\n"));
  ASSERT_EQ(drape(folder_, "check ./-c.toml --update none").code, 1);
  const std::string page = test::content(folder_.path("out/check/report.html"));
  EXPECT_NE(page.find("drape accept out/check ./-c --frames 5"), std::string::npos);
  EXPECT_EQ(drape(folder_, "accept out/check ./-c --frames 5").code, 0);
  for (const char* shard : {"1/2", "2/2"}) {
    drape(folder_, std::string("check a.toml ./-c.toml --update none --report parts --shard ") + shard);
  }
  ASSERT_EQ(drape(folder_, "merge parts -o ./-r").code, 1);
  EXPECT_NE(test::content(folder_.path("-r/report.json")).find("\"drape accept ./-r ./-c\""), std::string::npos);
  EXPECT_EQ(drape(folder_, "accept ./-r ./-c").code, 0);
  EXPECT_EQ(drape(folder_, "check ./-c.toml --update none").code, 0);
}

TEST_F(Accept, TheSameMotionOnly) {
  folder_.write("a.toml", scene("", 1.1));
  EXPECT_EQ(drape(folder_, "check a.toml --update none").code, 1);
  expect_refused("accept out/check a --frames 5", "the motion or the size of the pictures has changed");
  EXPECT_EQ(drape(folder_, "accept out/check a").code, 0);
  EXPECT_EQ(drape(folder_, "check a.toml --update none").code, 0);
}

TEST_F(Accept, NothingThatWasNotChecked) {
  folder_.write("a.toml", scene("color = \"blue\"\n"));
  expect_refused("accept out/check", "a.toml: cannot be accepted: the scene has changed since the check");
  folder_.write("a.toml", scene("color = \"red\"\n"));
  const fs::path description = folder_.path() / "out/check/b/candidate.json";
  std::string text = test::content(description);
  text.replace(text.find("\"program\": \"") + 12, 4, "0000");
  folder_.write("out/check/b/candidate.json", text);
  expect_refused("accept out/check", "b.toml: cannot be accepted: it was checked by a different build of drape");
  fs::resize_file(folder_.path() / "out/check/a/candidate/frames/0005.png", 100);
  expect_refused("accept out/check a", "candidate/frames/0005.png: has been modified since it was recorded");
}

TEST_F(Accept, OnlyWhatTheReportLists) {
  folder_.write("b.toml", scene(""));
  EXPECT_EQ(drape(folder_, "check b.toml --update none").code, 0);
  expect_refused("accept out/check", "out/check: there is nothing to accept: this check found no scene changed");
  expect_refused("accept out/check a", "out/check: there is nothing to accept");
  folder_.write("b.toml", scene("color = \"blue\"\n"));
  EXPECT_EQ(drape(folder_, "check b.toml --update none").code, 1);
  const auto a = golden("a"), b = golden("b");
  const auto accepted = drape(folder_, "accept out/check");
  EXPECT_EQ(accepted.text, "b.golden: accepted\n");
  EXPECT_EQ(golden("a"), a);
  EXPECT_NE(golden("b"), b);
}

TEST_F(Accept, NotWhatALaterCheckHasLeft) {
  const std::string report = test::content(folder_.path("out/check/report.json"));
  folder_.write("a.toml", scene("color = \"blue\"\n"));
  EXPECT_EQ(drape(folder_, "check a.toml --update none").code, 1);
  folder_.write("out/check/report.json", report);  // as if that check had been interrupted before its report
  expect_refused("accept out/check", "a.toml: cannot be accepted: another check has left this since the report");
  for (const std::string text : {"", "[]", "{\"scenes\": [{\"name\": \"../a\", \"candidate\": \"0\"}]}"}) {
    folder_.write("out/check/report.json", text);
    expect_refused("accept out/check", "out/check/report.json: ");
  }
}

TEST_F(Accept, NothingOfOtherValues) {
  const auto checked = drape(folder_, "check a.toml --update none --set cloth.mass=1.1");
  EXPECT_EQ(checked.code, 1);
  EXPECT_NE(checked.text.find(
                "it was checked with --set cloth.mass=1.1: to make that golden, edit the scene and check it again"),
            std::string::npos)
      << checked.text;
  expect_refused("accept out/check",
                 "out/check: there is nothing to accept: this check found no scene changed, or ran with --set, whose "
                 "results cannot be accepted: edit the scene and check it again");
  EXPECT_FALSE(fs::exists(folder_.path("out/check/a/candidate")));
}

TEST_F(Accept, OnlyTheReportOfACheck) {
  const std::string expected = "; expected the report folder of a check: drape check SCENE writes out/check";
  folder_.write("empty", "");
  fs::create_directory(folder_.path() / "folder");
  expect_refused("accept nowhere", "nowhere: no such folder" + expected);
  expect_refused("accept folder", "folder: there is no report of drape check in this folder" + expected);
  for (const std::string file : {"empty", "a.toml", "a.golden/frames/0005.png", "out/check/report.json"}) {
    expect_refused("accept " + file, file + ": this is a file" + expected);
  }
  for (const std::string text : {"", "{", "\x89PNG\r\n\x1a\n"}) {
    folder_.write("out/check/a/candidate.json", text);
    expect_refused("accept out/check", "out/check/a/candidate.json: is not valid JSON");
  }
  fs::remove(folder_.path() / "out/check/a/candidate.json");
  fs::create_directory(folder_.path() / "out/check/a/candidate.json");
  expect_refused("accept out/check", "out/check/a/candidate.json: this is a folder, not a file");
}

TEST_F(Accept, Kill9LeavesOneGoldenOrTheOther) {
  test::Random random(static_cast<std::uint64_t>(getpid()));
  const fs::path golden_folder = folder_.path() / "a.golden";
  fs::copy(golden_folder, folder_.path() / "first", fs::copy_options::recursive);
  const auto old_one = golden("a"), new_one = files(folder_.path() / "out/check/a/candidate");
  for (int attempt = 0; attempt < 12; ++attempt) {
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder_.path().c_str()) != 0) _exit(99);
      execl(DRAPE_EXECUTABLE, DRAPE_EXECUTABLE, "accept", "out/check", "a", "--quiet", static_cast<char*>(nullptr));
      _exit(99);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(random.between(0, 0.1)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const auto now = golden("a");
    EXPECT_TRUE(now == old_one || now == new_one) << attempt;
    fs::remove_all(golden_folder);
    fs::copy(folder_.path() / "first", golden_folder, fs::copy_options::recursive);
  }
}

}  // namespace
}  // namespace drape::accept
