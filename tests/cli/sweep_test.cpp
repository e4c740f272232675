// drape sweep and drape merge on the command line: killed, resumed, divided, refused.

#include <gtest/gtest.h>

#include <random>

#include "core/sealed_json.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"
#include "tests/sweep/sweep_runs.hpp"

namespace drape::sweep_cli {
namespace {

using test::drape;
using test::Finished;
using test::SceneFolder;
using test::without_times;

std::vector<std::string> rows(const SceneFolder& folder, const std::string& sweep) {
  return without_times(test::content(folder.path(sweep + "/runs.csv")));
}

/// Writes a scene whose runs take long enough to be killed.
SceneFolder& with_scene(SceneFolder& folder) {
  folder.write("a.toml", test::swinging_scene +
                             "[sweep.vary]\ncloth.stiffness = \"10..80/8\"\n"
                             "integrator.method = [\"liu13\", \"implicit\"]\n");
  return folder;
}

TEST(SweepCommand, ListsWhatWouldRunAndWritesNothing) {
  SceneFolder folder;
  const Finished finished = drape(with_scene(folder), "sweep a.toml --dry-run");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_EQ(std::count(finished.text.begin(), finished.text.end(), '\n'), 17) << finished.text;
  EXPECT_NE(finished.text.find("cloth.stiffness = 80, integrator.method = implicit"), std::string::npos);
  EXPECT_EQ(folder.file_count(), 1U);
}

TEST(SweepCommand, ComesToTheSameAfterKills) {
  SceneFolder folder;
  with_scene(folder);
  ASSERT_EQ(drape(folder, "sweep a.toml --steps 400 -o whole --quiet").code, 0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> moment(0.02, 0.4);
  for (int k = 0; k < 10; ++k) {
    test::run(folder, "{ " DRAPE_EXECUTABLE " sweep a.toml --steps 400 -o killed --resume --quiet & p=$!; sleep " +
                          std::to_string(moment(random)) + "; kill -9 $p; wait $p; }");
  }
  ASSERT_EQ(drape(folder, "sweep a.toml --steps 400 -o killed --resume --quiet").code, 0);
  EXPECT_EQ(rows(folder, "whole"), rows(folder, "killed"));
  ASSERT_EQ(rows(folder, "whole").size(), 17U);
  // The report alone is recreated from the folders.
  std::filesystem::remove(folder.path("killed/runs.csv"));
  ASSERT_EQ(drape(folder, "sweep --report-only -o killed --quiet").code, 0);
  EXPECT_EQ(rows(folder, "whole"), rows(folder, "killed"));
}

TEST(SweepCommand, EndsInOrderOnCtrlC) {
  SceneFolder folder;
  with_scene(folder);
  const Finished finished =
      test::run(folder, "{ " DRAPE_EXECUTABLE
                        " sweep a.toml --steps 1000000 -o out & p=$!; until [ -e out/sweep.json ]; do "
                        "sleep 0.01; done; sleep 0.3; kill -TERM $p; wait $p; }");
  EXPECT_EQ(finished.code, 130) << finished.text;
  EXPECT_NE(finished.text.find("--resume continues"), std::string::npos) << finished.text;
  EXPECT_EQ(rows(folder, "out").size(), 17U);
}

TEST(SweepCommand, IsMergedFromShards) {
  SceneFolder folder;
  with_scene(folder);
  const std::string arguments = "sweep a.toml --vary time.step=0.01,0.02 --vary integrator.method=verlet,liu13 --quiet";
  const int code = drape(folder, arguments + " -o whole").code;
  for (const char* shard : {"1/3", "2/3", "3/3"}) drape(folder, arguments + " -o parts --shard " + shard);
  const Finished merged = drape(folder, "merge parts");
  EXPECT_EQ(merged.code, code) << merged.text;
  EXPECT_EQ(rows(folder, "whole"), rows(folder, "parts"));
  EXPECT_EQ(rows(folder, "parts").size(), 33U);
}

TEST(SweepCommand, MergingLeavesNothingHiddenOnCtrlC) {
  SceneFolder folder;
  with_scene(folder);
  const std::string arguments = "sweep a.toml --steps 1 --vary cloth.mass=1..2/6 --quiet -o parts --shard ";
  for (const char* shard : {"1/2", "2/2"}) drape(folder, arguments + shard);
  for (const char* delay : {"0.02", "0.04", "0.08", "0.12", "0.16"}) {
    const Finished finished = test::run(
        folder, std::string("{ rm -rf whole; " DRAPE_EXECUTABLE " merge parts -o whole & p=$!; sleep ") + delay +
                    "; kill -TERM $p; wait $p; find whole -name '.?*' ! -name .lock -printf 'hidden: %p\\n'; }");
    EXPECT_EQ(finished.text.find("hidden: "), std::string::npos) << delay << finished.text;
  }
  EXPECT_NE(drape(folder, "merge parts -o whole").code, 130);
  EXPECT_EQ(rows(folder, "whole").size(), 97U);
}

TEST(SweepCommand, RefusesInOneMessageWithExitCode2) {
  SceneFolder folder;
  with_scene(folder);
  const auto message = [&](const std::string& arguments) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, 2) << arguments << finished.text;
    return finished.text;
  };
  EXPECT_EQ(message("sweep"), "drape: SCENE is required; see drape sweep --help\n");
  EXPECT_NE(message("sweep a.toml --vary cloth.stifness=1,2").find("did you mean 'stiffness'?"), std::string::npos);
  EXPECT_NE(message("sweep a.toml --vary cloth.mass").find("--vary takes key.path=value"), std::string::npos);
  EXPECT_NE(message("sweep a.toml --shard 3/2").find("as in 2/5"), std::string::npos);
  EXPECT_NE(message("sweep a.toml --film gfi").find("did you mean '.gif'?"), std::string::npos);
  EXPECT_NE(message("merge .").find(".: there is no sweep, check or study of stability or validation in it"),
            std::string::npos);
  EXPECT_NE(message("merge a.toml").find("a.toml: this is a file; expected a folder"), std::string::npos);
  EXPECT_NE(message("merge nowhere").find("nowhere: cannot be read: No such file"), std::string::npos);
  EXPECT_NE(message("sweep --report-only -o none").find("contains no sweep"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.path("out")));

  // A report is of the scene that is named.
  ASSERT_EQ(drape(folder, "sweep a.toml -o out --steps 1 --quiet").code, 0);
  folder.write("b.toml", test::content(folder.path("a.toml")));
  EXPECT_NE(message("sweep b.toml -o out --report-only").find("out contains another sweep: drape sweep a.toml"),
            std::string::npos);
  EXPECT_EQ(drape(folder, "sweep a.toml -o out --report-only --quiet").code, 0);

  // A folder of another program's version is not resumed, and stays unchanged.
  std::string json = test::content(folder.path("out/sweep.json"));
  json.replace(json.find("revision "), 9, "revision x");
  json = sealed_json(nlohmann::ordered_json::parse(json), 1);
  folder.write("out/sweep.json", json);
  EXPECT_NE(message("sweep a.toml -o out --steps 1 --resume").find("choose another folder with -o"), std::string::npos);
  EXPECT_EQ(test::content(folder.path("out/sweep.json")), json);
}

TEST(SweepCommand, WritesJobsForSlurm) {
  SceneFolder folder;
  const Finished finished =
      drape(with_scene(folder), "sweep a.toml -o 'my out' --slurm 100 --slurm-option --partition=short");
  EXPECT_EQ(finished.code, 0) << finished.text;
  const std::string array = test::content(folder.path("my out/sweep.sbatch"));
  EXPECT_NE(array.find("#SBATCH --array=1-16\n"), std::string::npos) << array;  // no more tasks than runs
  EXPECT_NE(array.find("#SBATCH --partition=short\n"), std::string::npos) << array;
  for (const char* script : {"sweep.sbatch", "merge.sbatch", "submit.sh"}) {
    EXPECT_EQ(test::run(folder, std::string("sh -n 'my out/") + script + "'").code, 0) << script;
  }
  // A task executes the script in a shell.
  EXPECT_EQ(test::run(folder, "for i in $(seq 16); do SLURM_ARRAY_TASK_ID=$i sh 'my out/sweep.sbatch'; done").code, 0);
  EXPECT_EQ(test::run(folder, "sh 'my out/merge.sbatch'").code, 0);
  EXPECT_EQ(rows(folder, "my out").size(), 17U);
}

}  // namespace
}  // namespace drape::sweep_cli
