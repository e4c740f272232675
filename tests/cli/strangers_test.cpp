// Untrusted folders and files: whatever they contain, nothing outside of the output changes.

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "check/manifest.hpp"
#include "core/sealed_json.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

namespace drape::strangers {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::drape;
using test::Finished;
using test::SceneFolder;

const std::string scene = test::swinging_scene + "[check]\nframes = [0, 10]\nsize = [64, 48]\n";

/// Returns every file with its bytes and every link with its target, except those in one place.
std::map<std::string, std::string> listing(const fs::path& folder, const std::string& but = "") {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name =
        fs::relative(
            entry.symlink_status().type() == fs::file_type::symlink ? entry.path().parent_path() : entry.path(),
            folder) /
        (entry.is_symlink() ? entry.path().filename() : fs::path());
    if (!but.empty() && (name == but || name.starts_with(but + "/"))) continue;
    all[name] = entry.is_symlink()        ? "-> " + fs::read_symlink(entry.path()).string()
                : entry.is_regular_file() ? test::content(entry.path())
                                          : "a folder";
  }
  return all;
}

json read(const fs::path& file) { return json::parse(test::content(file)); }

/// A folder with untrusted files and files that they must not change.
class Strangers : public testing::Test {
 protected:
  Strangers() {
    folder_.write("victim/hooks/pre-commit", "#!/bin/sh\n");
    folder_.write("victim/run.json", "{}");
  }

  /// Expects a command to fail with the given words in one line, and to change nothing.
  void expect_refused(const std::string& command, const std::string& words) {
    const auto before = listing(folder_.path());
    const Finished finished = drape(folder_, command);
    EXPECT_EQ(finished.code, 2) << finished.text;
    EXPECT_NE(finished.text.find(words), std::string::npos) << finished.text;
    EXPECT_EQ(std::count(finished.text.begin(), finished.text.end(), '\n'), 1) << finished.text;
    EXPECT_EQ(listing(folder_.path()), before) << command;
  }

  /// Expects a command to succeed and to change only its output, which is removed again.
  void expect_only_output(const std::string& command) {
    const auto before = listing(folder_.path(), "out");
    const Finished finished = drape(folder_, command);
    EXPECT_TRUE(finished.code >= 0 && finished.code <= 2) << finished.code << finished.text;
    EXPECT_EQ(listing(folder_.path(), "out"), before) << command;
    fs::remove_all(folder_.path("out"));
  }

  /// Replaces a text in a file.
  void replace(const std::string& file, const std::string& what, const std::string& by) {
    std::string text = test::content(folder_.path(file));
    ASSERT_NE(text.find(what), std::string::npos) << file << " " << what;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
      text.replace(at, what.size(), by);
    }
    folder_.write(file, text);
  }

  SceneFolder folder_;
};

class StrangersSweep : public Strangers {
 protected:
  StrangersSweep() {
    folder_.write("a.toml", test::swinging_scene);
    EXPECT_EQ(drape(folder_, "sweep a.toml --vary cloth.mass=1,2 --steps 5 -o in/shard-1-of-1 --quiet").code, 0);
    key_ = read(folder_.path("in/shard-1-of-1/sweep.json"))["plan"]["runs"][1]["key"];
  }
  [[nodiscard]] std::string part(const std::string& name) const { return "in/shard-1-of-1/" + name; }
  std::string key_;
};

TEST_F(StrangersSweep, HasKeysThatStayInItsFolder) {
  for (const std::string key : {"../../victim", "..", "/tmp", ".git", "a/b", "a\\nb", "\\u001b[2J", "\\u0000"}) {
    const std::string good = test::content(folder_.path(part("sweep.json")));
    replace(part("sweep.json"), key_, key);
    folder_.write(part("sweep.json"),
                  sealed_json(nlohmann::ordered_json::parse(test::content(folder_.path(part("sweep.json")))), 1));
    for (const std::string command : {"merge in -o out", "merge in", "sweep --report-only -o in/shard-1-of-1"}) {
      expect_refused(command, "sweep.json: plan.runs[1].key: expected a plain name");
    }
    folder_.write(part("sweep.json"), good);
  }
  const std::string record = part("runs/" + key_ + "/run.json");
  const std::string good = test::content(folder_.path(record));
  replace(record, key_, "../../victim");
  expect_refused("merge in -o out", "run.json: key: expected a plain name");
  json files = json::parse(good);
  files["files"] = {"film.gif", "../../../../victim/run.json"};
  folder_.write(record, files.dump());
  expect_refused("merge in -o out", "run.json: files[1]: expected a plain name");
  expect_refused("sweep a.toml --vary cloth.mass=1,2 --steps 5 --resume -o in/shard-1-of-1",
                 "run.json: files[1]: expected a plain name");
  folder_.write(record, good);
  EXPECT_EQ(drape(folder_, "merge in -o out").code, 0);
}

TEST_F(StrangersSweep, IsNotFollowedOutOfItsFolder) {
  fs::create_symlink("../../../../victim/run.json", folder_.path(part("runs/" + key_ + "/film.gif")));
  expect_refused("merge in -o out", "film.gif: a link leads from there out of in");
  fs::remove(folder_.path(part("runs/" + key_ + "/film.gif")));
  fs::create_directory(folder_.path("out"));
  fs::create_directory_symlink("../victim", folder_.path("out/runs"));
  expect_refused("merge in -o out", "out/runs: a link leads from there out of out");
  fs::create_symlink("../victim/run.json", folder_.path("in/report.html"));
  expect_refused("merge in", "in/report.html: a link leads from there out of in");
}

TEST_F(StrangersSweep, MayHaveAnythingInItsRuns) {
  const std::string run = part("runs/" + key_);
  fs::create_directories(folder_.path(run + "/folder/in it"));
  EXPECT_EQ(test::run(folder_, "mkfifo " + run + "/pipe").code, 0);
  json record = read(folder_.path(run + "/run.json"));
  std::string deep(100'000, '[');
  record["figures"] = {{"deep", nullptr}};
  std::string text = record.dump();
  text.replace(text.find("null"), 4, deep + std::string(deep.size(), ']'));
  folder_.write(run + "/run.json", text);
  const Finished finished = drape(folder_, "merge in -o out");
  EXPECT_EQ(finished.code, 2) << finished.text;
  EXPECT_NE(finished.text.find("run.json is damaged: --resume runs it again"), std::string::npos) << finished.text;
}

class StrangersCheck : public Strangers {
 protected:
  StrangersCheck() {
    for (const char* name : {"a.toml", "b.toml"}) folder_.write(name, scene);
    EXPECT_EQ(drape(folder_, "bless a.toml b.toml").code, 0);
    folder_.write("b.toml", scene + "[effects.damping]\nfactor = 0.9\n");
    EXPECT_EQ(drape(folder_, "check b.toml a.toml --report in --shard 1/2").code, 1);
    const std::string bytes = test::content(folder_.path(mark_));
    shard_ = json::from_cbor(bytes, false);  // a checksum follows
  }
  void write(const json& shard) {
    const std::vector<std::uint8_t> bytes = json::to_cbor(shard);
    folder_.write(mark_, seal_shard({bytes.begin(), bytes.end()}));
  }

  const std::string mark_ = "in/shard-1-of-2/check.cbor";
  json shard_;
};

TEST_F(StrangersCheck, HasNamesThatStayInItsFolder) {
  for (const std::string name : {"../.git", "../../victim", "..", "", "/tmp/x", "a\nb", "a\x1b[2J"}) {
    json shard = shard_;
    shard["report"]["scenes"][0]["name"] = name;
    write(shard);
    expect_refused("merge in", "check.cbor: report.scenes[0].name: expected a plain name");
  }
  json shard = shard_;
  shard["report"]["scenes"][0]["name"] = "report.html";
  write(shard);
  expect_refused("merge in -o out", "check.cbor: a scene is called as the report's report.html");
}

TEST_F(StrangersCheck, HasPlacesThatThereAre) {
  const auto refused = [&](const auto& change) {
    json shard = shard_;
    change(shard);
    write(shard);
    expect_refused("merge in -o out", "check.cbor: it is damaged");
  };
  refused([](json& s) { s["places"][0] = 7; });
  refused([](json& s) { s["places"][0] = -1; });
  refused([](json& s) { s["scenes"] = 0; });
  refused([](json& s) { s["places"].push_back(1); });
  refused([](json& s) {
    s["places"].push_back(s["places"][0]);
    s["report"]["scenes"].push_back(s["report"]["scenes"][0]);
  });
  refused([](json& s) { s["report"]["scenes"][0]["verdict"] = 99; });
  refused([](json& s) { s["report"]["scenes"][0]["windows"]["motion"] = -1; });
  refused([](json& s) { s["report"]["scenes"][0]["findings"][0]["kind"] = 99; });
  refused([](json& s) { s["report"]["scenes"][0]["windows"]["windows"][0]["other_bits"] = nullptr; });
  folder_.write(mark_, seal_shard(std::string(1'000'000, '\x81') + "\xf6"));  // deeply nested lists
  expect_refused("merge in -o out", "check.cbor: it is damaged");
  const std::vector<std::uint8_t> cbor = json::to_cbor(shard_);
  folder_.write(mark_, {cbor.begin(), cbor.end()});  // without a checksum
  expect_refused("merge in -o out", "check.cbor: it is damaged");
}

TEST_F(StrangersCheck, IsNotFollowedOutOfItsFolder) {
  const fs::path b = folder_.path("in/shard-1-of-2/b");
  fs::remove_all(b);
  fs::create_directory_symlink("../../victim", b);
  expect_refused("merge in", "in/shard-1-of-2/b: a link leads from there out of in");
  fs::remove(b);
  fs::create_directory(folder_.path("out"));
  fs::create_directory_symlink("../victim", folder_.path("out/b"));
  expect_refused("merge in -o out", "out/b: a link leads from there out of out");
}

TEST_F(Strangers, StudyHasNamesThatStayInItsFolder) {
  const std::string head = "scene,kind,method,scheme,setting,run,quantity,value\n";
  const std::string study = ",study,,,,,format,2\n,study,,,,,command,x\n,study,,,,,seconds,1\n";
  folder_.write("study/runs.csv", head + study + "../../victim/x,scene,,,,,file,a.toml\n,end,,,,,rows,4\n");
  expect_refused("study accuracy --report-only -o study", "study/runs.csv:5: ");
}

TEST_F(Strangers, SceneHasANameThatStaysInItsFolder) {
  folder_.write("in/...toml", test::swinging_scene);
  expect_refused("simulate in/...toml -o 'out/{scene}/m.drape'", "out/{scene}/m.drape: {scene}: expected a plain name");
}

/// A check deletes only its own files.
TEST_F(Strangers, CheckKeepsWhatIsNoGolden) {
  folder_.write("a.toml", scene);
  ASSERT_EQ(drape(folder_, "bless a.toml").code, 0);
  folder_.write("notes/a/candidate/thesis.tex", "years of work");
  const Finished finished = drape(folder_, "check a.toml --report notes");
  EXPECT_EQ(finished.code, 2) << finished.text;
  EXPECT_NE(finished.text.find("notes/a/candidate: is not a golden"), std::string::npos) << finished.text;
  EXPECT_EQ(test::content(folder_.path("notes/a/candidate/thesis.tex")), "years of work");
  fs::remove_all(folder_.path("notes/a"));
  folder_.write("notes/a/candidate.json", "{}");
  EXPECT_EQ(drape(folder_, "check a.toml --report notes").code, 2);
  EXPECT_EQ(test::content(folder_.path("notes/a/candidate.json")), "{}");
  fs::remove_all(folder_.path("notes/a"));
  fs::create_directories(folder_.path("notes/a"));
  fs::create_directory_symlink("../../a.golden", folder_.path("notes/a/candidate"));
  EXPECT_EQ(drape(folder_, "check a.toml --report notes").code, 2);
  EXPECT_TRUE(fs::exists(folder_.path("a.golden/manifest.json")));
}

TEST_F(Strangers, CandidateWithSomethingElseIsKept) {
  folder_.write("a.toml", scene);
  ASSERT_EQ(drape(folder_, "bless a.toml").code, 0);
  folder_.write("a.toml", scene + "[effects.damping]\nfactor = 0.9\n");
  ASSERT_EQ(drape(folder_, "check a.toml --report r").code, 1);
  ASSERT_TRUE(fs::exists(folder_.path("r/a/candidate/manifest.json")));
  ASSERT_EQ(drape(folder_, "check a.toml --report r").code, 1);
  folder_.write("r/a/candidate/notes.txt", "why");
  const Finished finished = drape(folder_, "check a.toml --report r");
  EXPECT_EQ(finished.code, 2) << finished.text;
  EXPECT_EQ(test::content(folder_.path("r/a/candidate/notes.txt")), "why");
  EXPECT_TRUE(fs::exists(folder_.path("r/a/candidate/manifest.json")));
}

TEST_F(Strangers, ReportIsNotFollowedOutOfItsFolder) {
  folder_.write("a.toml", scene);
  ASSERT_EQ(drape(folder_, "bless a.toml").code, 0);
  folder_.write("a.toml", scene + "[effects.damping]\nfactor = 0.9\n");
  ASSERT_EQ(drape(folder_, "check a.toml --report r").code, 1);
  fs::rename(folder_.path("r/a/candidate"), folder_.path("victim/candidate"));
  fs::create_directory_symlink("../../victim/candidate", folder_.path("r/a/candidate"));
  expect_refused("accept r", "r/a/candidate: a link leads from there out of r");
}

TEST_F(Strangers, SceneWhoseNameIsNotUtf8IsAccepted) {
  folder_.write("a\xff.toml", scene);
  ASSERT_EQ(drape(folder_, "bless a\xff.toml").code, 0);
  for (const std::string wanted : {"", " a\xff.toml"}) {
    folder_.write("a\xff.toml", scene + (wanted.empty() ? "[effects.damping]\nfactor = 0.9\n" : ""));
    ASSERT_EQ(drape(folder_, "check a\xff.toml --report r").code, 1);
    const Finished accepted = drape(folder_, "accept r" + wanted);
    EXPECT_EQ(accepted.code, 0) << accepted.text;
    EXPECT_EQ(drape(folder_, "check a\xff.toml --report r").code, 0);
  }
}

/// Shards with random bits flipped: effects stay within the output.
class TamperedCheck : public StrangersCheck, public testing::WithParamInterface<int> {};

TEST_P(TamperedCheck, ChangesNothingElse) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const std::string good = test::content(folder_.path(mark_));
  for (int i = 0; i < 8; ++i) {
    std::string bytes = good;
    for (int k = 0; k <= i % 3; ++k) bytes[random() % std::min<std::size_t>(bytes.size(), 4000)] ^= 1 << random() % 8;
    folder_.write(mark_, bytes);
    expect_only_output("merge in -o out");
  }
}

INSTANTIATE_TEST_SUITE_P(Few, TamperedCheck, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, TamperedCheck, testing::Range(1, 126));

class TamperedSweep : public StrangersSweep, public testing::WithParamInterface<int> {};

TEST_P(TamperedSweep, ChangesNothingElse) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const std::string characters = "0123456789-e.\"[]{},/\\n";
  for (int i = 0; i < 10; ++i) {
    const std::string file = part(i % 2 == 0 ? "sweep.json" : "runs/" + key_ + "/run.json");
    const std::string good = test::content(folder_.path(file));
    std::string text = good;
    for (int k = 0; k <= i % 3; ++k) text[random() % text.size()] = characters[random() % characters.size()];
    folder_.write(file, text);
    expect_only_output("merge in -o out");
    folder_.write(file, good);
  }
}

INSTANTIATE_TEST_SUITE_P(Few, TamperedSweep, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, TamperedSweep, testing::Range(1, 101));

}  // namespace
}  // namespace drape::strangers
