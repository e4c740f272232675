// drape check with several scenes at once; checks and studies in shards that are merged.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

namespace drape::check_shards {
namespace {

namespace fs = std::filesystem;
using test::drape;
using test::Finished;
using test::SceneFolder;

const std::string scene = test::swinging_scene + "[check]\nframes = [0, 10]\nsize = [64, 48]\n";

/// Writes two scenes, the second changed since it was blessed.
void write_scenes(const SceneFolder& folder) {
  for (const char* name : {"a.toml", "b.toml"}) folder.write(name, scene);
  ASSERT_EQ(drape(folder, "bless a.toml b.toml").code, 0);
  folder.write("b.toml", scene + "[effects.damping]\nfactor = 0.9\n");
}

/// Returns the report in a folder without measured times.
nlohmann::json report_in(const SceneFolder& folder, const std::string& place) {
  nlohmann::json json = nlohmann::json::parse(test::content(folder.path(place + "/report.json")));
  json.erase("date");
  json.erase("seconds");
  json.erase("command");  // contains --jobs
  for (nlohmann::json& result : json["scenes"]) {
    result.erase("seconds");
    result["candidate"] = !result["candidate"].get<std::string>().empty();  // its hash depends on the time
  }
  return json;
}

// Starting to draw takes a fifth of a second, so one process answers as many questions as possible.
TEST(CheckShards, AndJobsFindWhatOneCheckFinds) {
  const SceneFolder folder;
  write_scenes(folder);
  ASSERT_EQ(drape(folder, "check a.toml b.toml --report r").code, 1);
  const nlohmann::json whole = report_in(folder, "r");
  ASSERT_EQ(drape(folder, "check a.toml b.toml --report r --jobs 2").code, 1);
  EXPECT_EQ(report_in(folder, "r"), whole);
  fs::remove_all(folder.path("r"));

  int worst = 0;
  for (const char* shard : {"1/2", "2/2"}) {
    const Finished part = drape(folder, std::string("check a.toml b.toml --report r --shard ") + shard);
    worst = std::max(worst, part.code);
  }
  EXPECT_EQ(worst, 1);
  const Finished merged = drape(folder, "merge r");
  EXPECT_EQ(merged.code, 1) << merged.text;
  EXPECT_NE(merged.text.find("b.toml: changed: "), std::string::npos) << merged.text;
  EXPECT_EQ(report_in(folder, "r"), whole);
  for (const char* file : {"report.html", "junit.xml", "b/difference.gif"}) {
    EXPECT_TRUE(fs::exists(folder.path(std::string("r/") + file))) << file;
  }

  const Finished less = drape(folder, "merge r/shard-1-of-2 -o less");
  EXPECT_EQ(less.code, 130) << less.text;
  EXPECT_NE(less.text.find("are in none of the shards"), std::string::npos) << less.text;

  EXPECT_EQ(drape(folder, "accept r").code, 0);
  EXPECT_EQ(drape(folder, "check b.toml").code, 0);
}

TEST(CheckShards, OfAnEarlierCheckDoNotCount) {
  const SceneFolder folder;
  write_scenes(folder);
  ASSERT_LE(drape(folder, "check a.toml b.toml --report r --shard 1/2").code, 1);
  ASSERT_TRUE(fs::exists(folder.path("r/shard-1-of-2/check.cbor")));
  // A folder in the place of a diagram ends the check early.
  for (const std::string scene : {"a", "b"}) {
    const std::string diagram = "r/shard-1-of-2/" + scene + "/motion.svg";
    fs::remove(folder.path(diagram));
    folder.write(diagram + "/in-the-way", "");
  }
  EXPECT_EQ(drape(folder, "check a.toml b.toml --report r --shard 1/2").code, 4);
  EXPECT_FALSE(fs::exists(folder.path("r/shard-1-of-2/check.cbor")));
}

TEST(CheckShards, OfAnotherNumberAreNotMerged) {
  const SceneFolder folder;
  write_scenes(folder);
  drape(folder, "check a.toml b.toml --report r --shard 1/2");
  drape(folder, "check a.toml b.toml --report r --shard 1/1");
  drape(folder, "check a.toml b.toml --report r --shard 2/3");
  const Finished refused = drape(folder, "merge r");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.text.find("are not of one check"), std::string::npos) << refused.text;
}

TEST(CheckShards, OfOtherScenesAreNotMerged) {
  const SceneFolder folder;
  for (const char* name : {"a.toml", "b.toml", "c.toml"}) folder.write(name, scene);
  drape(folder, "check a.toml b.toml --report one --shard 1/2");
  drape(folder, "check a.toml c.toml --report two --shard 2/2");
  const Finished refused = drape(folder, "merge one two");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.text.find("are not of one check"), std::string::npos) << refused.text;
  folder.write("one/shard-1-of-2/check.cbor", "\xa1");
  EXPECT_NE(drape(folder, "merge one").text.find("it is damaged"), std::string::npos);
}

TEST(StudyShards, AreKnownByWhatIsInTheFolder) {
  const SceneFolder folder;
  folder.write("s/shard-1-of-2/stability-runs.csv", "scene,kind\n");
  const Finished refused = drape(folder, "merge s");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.text.find("stability-runs.csv:1: expected the runs of a study"), std::string::npos) << refused.text;
  EXPECT_EQ(drape(folder, "study stability --shard 3/2").code, 2);
}

TEST(CheckOnGithub, SaysWhatFailedWhereItIsSeen) {
  const SceneFolder folder;
  write_scenes(folder);
  const Finished finished = drape(folder, "check a.toml b.toml", "GITHUB_ACTIONS=true GITHUB_STEP_SUMMARY=summary.md");
  EXPECT_EQ(finished.code, 1);
  EXPECT_NE(finished.text.find("\n::error file=b.toml,title=drape check%3A changed::"), std::string::npos)
      << finished.text;
  EXPECT_EQ(finished.text.find("::error file=a.toml"), std::string::npos) << finished.text;
  const std::string summary = test::content(folder.path("summary.md"));
  EXPECT_NE(summary.find("### drape check: 1 of 2 scenes failed\n"), std::string::npos) << summary;
  EXPECT_LT(summary.find("| b.toml | ❌ changed |"), summary.find("| a.toml | ✅ passed |")) << summary;
  drape(folder, "check a.toml", "GITHUB_STEP_SUMMARY=summary.md");
  EXPECT_TRUE(test::content(folder.path("summary.md")).starts_with(summary)) << "other steps' summaries stay";
}

}  // namespace
}  // namespace drape::check_shards
