// Scenes whose names have a special meaning for a terminal, a build server, a shell or Slurm.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/console.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"
#include "tests/support/hostile_names.hpp"

namespace drape::hostile_cli {
namespace {

namespace fs = std::filesystem;
using test::drape, test::Finished, test::SceneFolder;

/// Returns the names as file names.
std::vector<std::string> file_names() {
  constexpr std::size_t longest = 200;  // [bytes]; a file system accepts 255
  std::vector<std::string> names;
  for (std::string name : test::hostile_names) {
    std::ranges::replace(name, '/', '_');
    names.push_back(name.substr(0, longest) + ".toml");
  }
  return names;
}

/// Writes a scene of each name, and returns all names as the words of a command.
std::string write_scenes(const SceneFolder& folder) {
  std::string words;
  for (const std::string& name : file_names()) {
    folder.write(name, test::swinging_scene);
    words += " " + shell_word("./" + name);
  }
  return words;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(HostileNames, AreALineEachOfACheck) {
  const SceneFolder folder;
  const std::string scenes = write_scenes(folder);
  const Finished finished =
      drape(folder, "check --update none" + scenes, "GITHUB_ACTIONS=true GITHUB_STEP_SUMMARY=summary.md");
  EXPECT_EQ(finished.code, 1) << finished.text;
  EXPECT_FALSE(test::has_controls(finished.text)) << finished.text;
  std::size_t verdicts = 0, annotations = 0;
  for (const std::string& line : lines_of(finished.text)) {
    if (line.starts_with("::error file=")) {
      ++annotations;
    } else if (line.find(": missing: there is no golden") != std::string::npos) {
      ++verdicts;
    } else {
      EXPECT_TRUE(line == "out/check/report.html" || line.starts_with("drape: ")) << line;
    }
  }
  EXPECT_EQ(verdicts, file_names().size()) << finished.text;
  EXPECT_EQ(annotations, file_names().size());
  EXPECT_FALSE(test::has_controls(test::content(folder.path("summary.md"))));
  EXPECT_FALSE(test::has_controls(test::content(folder.path("out/check/report.html"))));
  EXPECT_FALSE(test::has_controls(test::content(folder.path("out/check/junit.xml"))));
}

TEST(HostileNames, AreALineEachOfAnError) {
  const SceneFolder folder;
  for (const std::string& name : file_names()) {
    const Finished finished = drape(folder, "simulate " + shell_word("./" + name));
    EXPECT_EQ(finished.code, 2) << finished.text;
    EXPECT_FALSE(test::has_controls(finished.text)) << finished.text;
    EXPECT_EQ(lines_of(finished.text).size(), 1U) << finished.text;
    EXPECT_TRUE(finished.text.starts_with("drape: ")) << finished.text;
  }
}

TEST(HostileNames, RunInScriptsForSlurm) {
  const SceneFolder folder;
  const std::string scenes = write_scenes(folder);
  const Finished written = drape(folder, "sweep" + scenes + " --steps 1 -o out --slurm 2");
  ASSERT_EQ(written.code, 0) << written.text;
  for (const char* task : {"1", "2"}) {
    const Finished run = test::run(folder, std::string("SLURM_ARRAY_TASK_ID=") + task + " sh out/sweep.sbatch");
    EXPECT_EQ(run.code, 0) << run.text;
  }
  const Finished merged = test::run(folder, "sh out/merge.sbatch");
  EXPECT_EQ(merged.code, 0) << merged.text;
  EXPECT_FALSE(test::has_controls(written.text + merged.text)) << merged.text;
  EXPECT_NE(merged.text.find(std::to_string(file_names().size()) + " completed"), std::string::npos) << merged.text;
  for (const char* report : {"out/report.html", "out/report.md", "out/table.tex"}) {
    EXPECT_FALSE(test::has_controls(test::content(folder.path(report)))) << report;
  }
  EXPECT_FALSE(fs::exists(folder.path("owned")));
}

TEST(HostileNames, AreToldByFilesWithoutHarm) {
  const SceneFolder folder;
  folder.write("a.toml", test::swinging_scene);
  // A motion contains the name of its scene, and a run's record the reason of its end.
  const std::string odd = shell_word("red \x1b[31m\n::error::owned.toml");
  ASSERT_EQ(test::run(folder, "cp a.toml " + odd).code, 0);
  const Finished written = drape(folder, "simulate " + odd + " --steps 2 -o m.drape");
  const Finished drawn = drape(folder, "render m.drape -o m.png");
  EXPECT_FALSE(test::has_controls(written.text + drawn.text)) << written.text << drawn.text;
  EXPECT_EQ((written.text + drawn.text).find("\n::"), std::string::npos) << written.text << drawn.text;

  ASSERT_EQ(drape(folder, "sweep a.toml --steps 1 -o out --quiet").code, 0);
  for (const auto& run : fs::directory_iterator(folder.path("out/runs"))) {
    auto record = nlohmann::json::parse(test::content(run.path() / "run.json"));
    record["outcome"] = "diverged";
    for (const std::string& name : test::hostile_names) {
      record["reason"] = name;
      folder.write("out/runs/" + run.path().filename().string() + "/run.json",
                   record.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
      const Finished told = drape(folder, "sweep --report-only -o out");
      EXPECT_FALSE(test::has_controls(told.text)) << told.text;
      for (const std::string& line : lines_of(told.text)) EXPECT_FALSE(line.starts_with("::")) << told.text;
      const std::string csv = test::content(folder.path("out/runs.csv"));
      EXPECT_EQ(csv.find(",=1+1,"), std::string::npos) << csv;
    }
  }
}

/// Returns the value of an option in a script's #SBATCH lines, as sbatch parses it (slurm-23.11.0, src/sbatch/opt.c,
/// _get_argument).
std::string sbatch_value(const std::string& script, const std::string& option) {
  const std::string head = "#SBATCH " + option + "=";
  std::string value;
  for (const std::string& line : lines_of(script)) {
    if (!line.starts_with(head)) continue;
    bool kept = false;
    char quote = 0;
    for (const char c : line.substr(head.size())) {
      if (quote == 0 && c == ' ') break;
      if (kept) {
        kept = false;
      } else if (c == '\\') {
        kept = true;
        continue;
      } else if (quote != 0) {
        if (c == quote) {
          quote = 0;
          continue;
        }
      } else if (c == '"' || c == '\'') {
        quote = c;
        continue;
      } else if (c == '#') {
        break;
      }
      value += c;
    }
  }
  return value;
}

TEST(HostileNames, OfFoldersReachSlurmWhole) {
  const SceneFolder folder;
  const std::string odd = "it's \"my\" \\ #1 $(touch owned) 50%j";
  const std::string inside = "mkdir -p " + shell_word(odd) + " && cd " + shell_word(odd);
  folder.write("a.toml", test::swinging_scene);
  const Finished written = test::run(
      folder, inside + " && " + DRAPE_EXECUTABLE + " sweep ../a.toml --steps 1 --slurm 2 -o " + shell_word(odd));
  ASSERT_EQ(written.code, 0) << written.text;
  const std::string script = test::content(folder.path() / odd / odd / "sweep.sbatch");
  EXPECT_EQ(sbatch_value(script, "--chdir"), (folder.path() / odd).string()) << script;
  EXPECT_EQ(sbatch_value(script, "--output"), "it's \"my\" \\ #1 $(touch owned) 50%%j/slurm-%a.log") << script;
  EXPECT_EQ(test::run(folder, inside + " && SLURM_ARRAY_TASK_ID=1 sh " + shell_word(odd + "/sweep.sbatch")).code, 0);
  EXPECT_FALSE(fs::exists(folder.path() / odd / "owned"));
}

TEST(HostileNames, OfFoldersHaveNoLineFeeds) {
  const SceneFolder folder;
  folder.write("a.toml", test::swinging_scene);
  const std::string feed = shell_word("x\n#SBATCH --wrap=owned");
  for (const std::string& arguments :
       {"sweep a.toml --slurm 2 -o " + feed, "sweep a.toml --slurm 2 --slurm-option " + feed,
        "render a.toml -o " + feed + ".gif", "compare a.toml a.toml -o " + feed + ".gif",
        "check a.toml --report " + feed, "merge out -o " + feed, "study homework -o " + feed}) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, 2) << finished.text;
    EXPECT_NE(finished.text.find("expected a text without control characters, found 'x\\x0a#SBATCH"), std::string::npos)
        << finished.text;
  }
  const Finished inside = test::run(
      folder, "mkdir " + feed + " && cd " + feed + " && " + DRAPE_EXECUTABLE + " sweep ../a.toml --slurm 2 -o out");
  EXPECT_EQ(inside.code, 2) << inside.text;
  EXPECT_NE(inside.text.find("a script of Slurm cannot name '"), std::string::npos) << inside.text;
  EXPECT_FALSE(fs::exists(folder.path("out")));
}

}  // namespace
}  // namespace drape::hostile_cli
