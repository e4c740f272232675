// Several scenes in one command: two films are made at once, without visible effect.

#include <gtest/gtest.h>

#include <regex>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"

namespace drape::several_films {
namespace {

using test::content;
using test::drape;
using test::Finished;
using test::SceneFolder;

/// Returns a run's output without machine-dependent figures.
std::string without_times(const std::string& text) {
  return std::regex_replace(text, std::regex("[0-9.]+ (µs|ms|s)\\b"), "some time");
}

TEST(SeveralFilms, AreAndSayWhatEachIsAndSaysByItself) {
  const SceneFolder folder;
  const std::string film = "[video]\nsize = [96, 80]\n";
  folder.write("first.toml", test::swinging_scene + film);
  folder.write("diverges.toml",
               "[cloth]\nmesh = { grid = [6, 6] }\nstiffness = 1e5\npins = [\"corner:x-y-\"]\n[time]\nstep = "
               "0.05\nduration = 200\n"
               "[integrator]\nmethod = \"semi-implicit\"\nallow_unstable = true\n[effects.gravity]\n" +
                   film);
  folder.write("third.toml", test::swinging_scene + "[look]\nmesh_lines = true\n" + film);
  folder.write("fourth.toml", test::swinging_scene + "[look]\nbackground = \"white\"\n" + film);
  std::string said;
  for (const std::string name : {"first", "diverges", "third", "fourth"}) {
    const Finished alone = drape(folder, "render " + name + ".toml -o '{scene}.gif'");
    EXPECT_EQ(alone.code, name == "diverges" ? 3 : 0) << alone.text;
    said += alone.text;
    folder.write("alone/" + name, content(folder.path() / (name + (name == "diverges" ? ".partial" : "") + ".gif")));
  }
  const Finished all = drape(folder, "render first.toml diverges.toml third.toml fourth.toml -o '{scene}.gif'");
  EXPECT_EQ(all.code, 3) << all.text;
  EXPECT_EQ(without_times(all.text), without_times(said));
  for (const std::string name : {"first", "diverges", "third", "fourth"}) {
    const std::string bytes = content(folder.path() / (name + (name == "diverges" ? ".partial" : "") + ".gif"));
    EXPECT_GT(bytes.size(), 1000U);
    EXPECT_TRUE(bytes == content(folder.path() / "alone" / name)) << name;
  }
}

TEST(SeveralFilms, ThatHaveNotBegunAreNotBegunByAnInterruption) {
  const SceneFolder folder;
  for (const std::string name : {"first", "second", "third", "fourth"}) {
    const std::string endless =
        std::regex_replace(test::swinging_scene, std::regex("duration = 0.4"), "duration = 1e5");
    folder.write(name + ".toml", endless + "[video]\nsize = [96, 80]\n[camera]\nposition = [0, -4, 1]\n");
  }
  const Finished run = drape(folder, "render first.toml second.toml third.toml fourth.toml -o '{scene}.gif'",
                             "timeout --foreground --preserve-status -s TERM 3");
  EXPECT_EQ(run.code, 130) << run.text;
  EXPECT_NE(run.text.find("drape: interrupted after"), std::string::npos) << run.text;
  EXPECT_EQ(run.text.find("third"), std::string::npos) << run.text;
  EXPECT_EQ(run.text.find("fourth"), std::string::npos) << run.text;
}

}  // namespace
}  // namespace drape::several_films
