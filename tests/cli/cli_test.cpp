#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <set>

#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"
#include "tests/support/gif_file.hpp"
#include "tests/support/read_picture.hpp"

namespace drape::cli {
namespace {

namespace fs = std::filesystem;
using test::drape;
using test::Finished;

const std::string scene = test::swinging_scene + "[video]\nsize = [64, 48]\n";

TEST(CommandLine, PrintsItsVersion) {
  const test::SceneFolder folder;
  const Finished finished = drape(folder, "--version");
  EXPECT_EQ(finished.code, 0);
  EXPECT_TRUE(finished.text.starts_with("drape ")) << finished.text;
}

TEST(CommandLine, NamesTheNearestOptionAndCommand) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  Finished finished = drape(folder, "simulate scene.toml --stpes 3");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.text.find("did you mean '--steps'"), std::string::npos) << finished.text;
  finished = drape(folder, "rendr scene.toml");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.text.find("did you mean 'render'"), std::string::npos) << finished.text;
}

TEST(CommandLine, RefusesNumbersOfThreadsAndFramesThatAreNone) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  const auto expect = [&](const std::string& arguments, const std::string& message) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_TRUE(finished.text.starts_with("drape: " + message)) << finished.text;
    EXPECT_EQ(std::ranges::count(finished.text, '\n'), 1) << finished.text;
  };
  for (const std::string number : {"0", "-1", "257", "9999999999", "99999999999999999999", "x", "1.5", "2x", "''"}) {
    const std::string text = number == "''" ? "" : number;
    for (const std::string command : {"simulate", "render"}) {
      expect(command + " scene.toml --threads " + number,
             "--threads: expected auto or a whole number from 1 to 256, found '" + text + "'\n");
    }
    expect("sweep scene.toml --threads " + number,
           "--threads: expected a whole number at least 1 and at most 256, found '" + text + "'");
  }
  for (const std::string range : {"9..3", "-1..3", "3", "3..", "..3", "a..b", "1..2..3", "0..9999999999"}) {
    for (const std::string command : {"render", "simulate -o x.obj"}) {
      expect(command + " scene.toml --frames " + range,
             "--frames takes A..B, two frame numbers with 0 ≤ A ≤ B; found '" + range + "'\n");
    }
  }
  expect("render scene.toml --frames 0..99999", "--frames 0..99999: the film ends with frame 10\n");
  EXPECT_EQ(folder.file_count(), 1);
}

TEST(CommandLine, RefusesAFactorThatCannotFitBeforeItIsBegun) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  const Finished finished = drape(folder,
                                  "simulate scene.toml --steps 1 --set 'cloth.mesh={ grid = [200, 200] }' --set "
                                  "'integrator.method=\"implicit\"' --set 'integrator.linear_solver=\"cholesky\"'",
                                  "ulimit -v 280000;");
  EXPECT_EQ(finished.code, 2) << finished.text;
  EXPECT_NE(finished.text.find("a sparse factor of 121197 rows would take"), std::string::npos) << finished.text;
}

// Independent of the available memory: quasi-Newton on patches of a large cloth is never left out.
TEST(CommandLine, EitherRefusesWhatCannotFitOrComesToTheSameBits) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  const std::string command =
      "simulate scene.toml --quiet --steps 1 --set cloth.mesh.grid=[145,145] --set "
      "'integrator={stop=\"error\",tolerance=1e-3}' --positions ";
  ASSERT_EQ(drape(folder, command + "any.csv").code, 0);
  int patches_refused = 0;
  for (int kilobytes = 110'000;; kilobytes += 5'000) {
    const Finished finished = drape(folder, command + "few.csv", "ulimit -v " + std::to_string(kilobytes) + ";");
    if (finished.code == 0) break;
    ASSERT_EQ(finished.code, 2) << finished.text;
    patches_refused += finished.text.find("patches of 5329 vertices would take 0.03 GB") != std::string::npos ? 1 : 0;
  }
  EXPECT_GT(patches_refused, 0);
  EXPECT_EQ(test::content(folder.path("few.csv")), test::content(folder.path("any.csv")));
}

TEST(CommandLine, SaysWhatErrorTheStepsLeftAndThatAStandingClothIsNoEquilibrium) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene + "[effects.damping]\nfactor = 1e-4\n");
  const std::string stiff = "simulate scene.toml --set cloth.stiffness=1e6 --set time.duration=6 ";
  Finished finished = drape(folder, stiff + "--set integrator.tolerance=1");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find(", estimated error "), std::string::npos) << finished.text;
  EXPECT_NE(finished.text.find("its weight out of balance, so this is not an equilibrium"), std::string::npos)
      << finished.text;
  // With the default settings it reports an error estimate, without a warning.
  finished = drape(folder, "simulate scene.toml --set integrator={} --set integrator.method=quasi-newton");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find(", estimated error "), std::string::npos) << finished.text;
  EXPECT_EQ(finished.text.find("equilibrium"), std::string::npos) << finished.text;
}

// The summary and each step report it, with the actual number of substeps.
TEST(CommandLine, SaysOfAnAbsurdlySmallAccuracyThatStepsMissedIt) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  folder.write("input", "\n\n\n");
  const Finished finished = drape(folder,
                                  "simulate scene.toml --steps 2 --step-by-step --set time.accuracy=1e-30 --set "
                                  "'integrator={method=\"verlet\"}' < input");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_NE(finished.text.find(", 4096 substeps each (at most 4096), 2 steps missed "), std::string::npos)
      << finished.text;
  EXPECT_NE(finished.text.find(", above the requested accuracy, "), std::string::npos) << finished.text;
}

TEST(CommandLine, ReportsTheProblemsOfAllScenesTogether) {
  const test::SceneFolder folder;
  folder.write("a.toml", "[cloth]\nstifness = 1\n");
  folder.write("b.toml", "[tiem]\n");
  const Finished finished = drape(folder, "simulate a.toml b.toml");
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.text.find("a.toml:2:1: "), std::string::npos) << finished.text;
  EXPECT_NE(finished.text.find("did you mean 'stiffness'"), std::string::npos) << finished.text;
  EXPECT_NE(finished.text.find("b.toml:1:"), std::string::npos) << finished.text;
}

TEST(CommandLine, QuietPrintsNothingWhenAllIsWell) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  const Finished finished = drape(folder, "simulate scene.toml --quiet");
  EXPECT_EQ(finished.code, 0);
  EXPECT_EQ(finished.text, "");
}

TEST(CommandLine, WritesAllOutputsFromOnePass) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  const Finished finished =
      drape(folder, "render scene.toml -o a.gif -o b.mp4 -o frames/{frame:04}.png -o still.png --stats '{scene}.json'");
  EXPECT_EQ(finished.code, 0) << finished.text;
  for (const char* name : {"a.gif", "b.mp4", "frames/0000.png", "frames/0010.png", "still.png", "scene.json"}) {
    EXPECT_TRUE(fs::exists(folder.path() / name)) << name;
  }
  EXPECT_FALSE(fs::exists(folder.path() / "frames/0011.png"));
  const cv::Mat last = test::read_picture(folder.path() / "frames/0010.png");
  const cv::Mat still = test::read_picture(folder.path() / "still.png");
  EXPECT_EQ(last.size(), cv::Size(64, 48));
  EXPECT_EQ(cv::norm(last, still, cv::NORM_INF), 0);
}

TEST(CommandLine, RendersIntoOutByDefault) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  EXPECT_EQ(drape(folder, "render scene.toml --frames 2..3").code, 0);
  EXPECT_TRUE(fs::exists(folder.path() / "out/scene.gif"));
}

TEST(CommandLine, DrawsAFrameOfTheFilmWhicheverRangeItIsIn) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);  // its camera frames the whole motion
  EXPECT_EQ(drape(folder, "render scene.toml -o all/{frame:02}.png").code, 0);
  EXPECT_EQ(drape(folder, "render scene.toml -o some/{frame:02}.png --frames 4..6").code, 0);
  const cv::Mat all = test::read_picture(folder.path() / "all/05.png");
  const cv::Mat some = test::read_picture(folder.path() / "some/05.png");
  ASSERT_FALSE(all.empty());
  ASSERT_FALSE(some.empty());
  EXPECT_EQ(cv::norm(all, some, cv::NORM_INF), 0);
  EXPECT_FALSE(fs::exists(folder.path() / "some/03.png"));
}

TEST(CommandLine, TakesAFrameAfterEverySoManySteps) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);  // 20 steps
  EXPECT_EQ(drape(folder, "simulate scene.toml -o {frame}.obj --every 6 --frames 1..3 --positions end.csv").code, 0);
  EXPECT_FALSE(fs::exists(folder.path() / "0.obj"));
  for (const int k : {1, 2, 3}) {
    EXPECT_EQ(drape(folder, "simulate scene.toml -o still.obj --every 1 --steps " + std::to_string(6 * k)).code, 0);
    const auto vertices = [&](const std::string& file) {
      const std::string text = test::content(folder.path(file));
      return text.substr(text.find('\n'));  // skips the line with the frame's number
    };
    EXPECT_EQ(vertices(std::to_string(k) + ".obj"), vertices("still.obj")) << k;
  }
  EXPECT_EQ(drape(folder, "simulate scene.toml -o {frame}.obj --every 6 --frames 0..4").code, 2);
  EXPECT_EQ(drape(folder, "simulate scene.toml -o x.obj --every 0").code, 2);
}

TEST(CommandLine, TakesTheStepsAfterTheLastFrame) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);  // 20 steps
  EXPECT_EQ(drape(folder, "simulate scene.toml --positions whole.csv").code, 0);
  EXPECT_EQ(drape(folder, "simulate scene.toml -o x.npz --every 30 --positions every.csv").code, 0);
  EXPECT_EQ(test::content(folder.path("every.csv")), test::content(folder.path("whole.csv")));
}

TEST(CommandLine, ReadsASceneFromAPipe) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  const test::Finished piped = test::run_shell(
      folder, "cat scene.toml | " + std::string(DRAPE_EXECUTABLE) + " simulate /dev/stdin --positions piped.csv");
  EXPECT_EQ(piped.code, 0) << piped.text;
  EXPECT_EQ(drape(folder, "simulate scene.toml --positions whole.csv").code, 0);
  EXPECT_EQ(test::content(folder.path("piped.csv")), test::content(folder.path("whole.csv")));
}

TEST(CommandLine, TakesFramesByTime) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);  // 20 steps of 0.02 s, and a frame every 0.04 s
  const auto frames = [&](const std::string& options) {
    std::filesystem::remove_all(folder.path("f"));
    const auto finished = drape(folder, "simulate scene.toml -o f/{frame}.obj " + options);
    EXPECT_EQ(finished.code, 0) << finished.text;
    std::set<int> numbers;
    for (const auto& entry : fs::directory_iterator(folder.path("f"))) {
      numbers.insert(std::stoi(entry.path().stem().string()));
    }
    return numbers;
  };
  EXPECT_EQ(frames("--at 0.2s"), (std::set{5}));
  EXPECT_EQ(frames("--at 0.4s"), (std::set{10}));
  EXPECT_EQ(frames("--from 0.1s --to 240ms"), (std::set{3, 4, 5, 6}));
  EXPECT_EQ(frames("--from 0.36s"), (std::set{9, 10}));
  EXPECT_EQ(frames("--every 0.1s"), (std::set{0, 1, 2, 3, 4}));
  EXPECT_EQ(frames("--every 0.1s --at 0.3s"), (std::set{3}));
  const auto refused = [&](const std::string& options) {
    const auto finished = drape(folder, "simulate scene.toml -o x.obj " + options);
    EXPECT_EQ(finished.code, 2) << finished.text;
    return finished.text;
  };
  EXPECT_EQ(refused("--at 2"), "drape: --at takes a time such as 2.5s or 250ms; found '2'\n");
  EXPECT_EQ(refused("--to 9s"), "drape: --to 9s: the film of scene.toml ends at 0.4 s\n");
  EXPECT_EQ(refused("--from 0.21s --to 0.22s"),
            "drape: there is no frame between --from 0.21s and --to 0.22s: frames are 0.04 s apart\n");
  EXPECT_EQ(refused("--every 0.05s"),
            "drape: --every 0.05s: a step is 0.02 s long; expected a whole number of them, such as 0.04s or 0.06s\n");
  EXPECT_NE(refused("--at 0.2s --from 0.1s").find("--at excludes --from"), std::string::npos);
}

TEST(CommandLine, MakesAFilmNoLargerThanItMayBe) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  const std::string render = "render scene.toml -o x.gif --set 'video.size=[160,120]' --max-size ";
  const Finished finished = drape(folder, render + "12kB");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_LE(fs::file_size(folder.path() / "x.gif"), 12000U);
  EXPECT_NE(finished.text.find(" pixels instead of 160x120"), std::string::npos) << finished.text;
  EXPECT_EQ(drape(folder, render + "100B").code, 4);
  for (const char* nonsense : {"5XB", "MB", "0", "-3kB", "nan"}) {
    const Finished refused = drape(folder, render + nonsense);
    EXPECT_EQ(refused.code, 2) << nonsense;
    EXPECT_NE(refused.text.find("--max-size takes a size such as 5MB"), std::string::npos) << refused.text;
  }
  EXPECT_EQ(drape(folder, "render scene.toml -o x.png --max-size 5MB").code, 2);
  const Finished fewer = drape(folder, render + "12kB --keep size");
  EXPECT_EQ(fewer.text.find(" pixels instead of"), std::string::npos) << fewer.text;
  EXPECT_EQ(drape(folder, "render scene.toml -o x.gif --keep size").text, "drape: --keep size needs --max-size\n");
}

TEST(CommandLine, PutsAPosterBesideEachFilm) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  const Finished finished = drape(folder, "render scene.toml -o a.gif -o b.avi -o {frame}.png --poster");
  EXPECT_EQ(finished.code, 0) << finished.text;
  const std::size_t at = finished.text.find(", frame ");
  ASSERT_NE(at, std::string::npos) << finished.text;
  char number[3] = {};
  std::snprintf(number, sizeof number, "%02d", std::stoi(finished.text.substr(at + 8)));
  const std::string picture = test::content(folder.path(std::string(number) + ".png"));
  EXPECT_FALSE(picture.empty());
  EXPECT_EQ(test::content(folder.path("a.poster.png")), picture);
  EXPECT_EQ(test::content(folder.path("b.poster.png")), picture);
  EXPECT_EQ(drape(folder, "render scene.toml -o a.gif -o a.avi --poster").code, 2);  // one poster for both
}

TEST(CommandLine, StepByStepPrintsEveryStepAndEndsAtQ) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  const std::string command = "simulate scene.toml --step-by-step --quiet --stats stats.json";
  folder.write("input", "\n\nq");
  const Finished finished = drape(folder, command + " < input");
  EXPECT_EQ(finished.code, 130);
  EXPECT_NE(finished.text.find("step 3: total "), std::string::npos) << finished.text;
  EXPECT_EQ(finished.text.find("step 4: "), std::string::npos) << finished.text;
  EXPECT_TRUE(fs::exists(folder.path() / "stats.partial.json"));
}

TEST(CommandLine, ADivergedRunExitsWith3AndKeepsItsFilm) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene + "[look]\nsamples = 1\n");
  folder.write("film.gif", "old");
  const Finished finished = drape(
      folder,
      "render scene.toml -o film.gif --set integrator.method=semi-implicit "
      "--set integrator.allow_unstable=true --set cloth.stiffness=1e5 --set time.step=0.05 --set time.duration=200");
  EXPECT_EQ(finished.code, 3) << finished.text;
  EXPECT_NE(finished.text.find("diverged at step"), std::string::npos) << finished.text;
  // The GIF is valid and complete up to there, with fewer frames than requested, under a name that marks it as partial.
  EXPECT_EQ(test::content(folder.path() / "film.gif"), "old");
  const std::size_t frames = test::read_gif(folder.path() / "film.partial.gif").delays.size();
  EXPECT_GE(frames, 1U);
  EXPECT_LT(frames, 5001U);
}

TEST(CommandLine, SeveralScenesNeedNamesOfTheirOwn) {
  const test::SceneFolder folder;
  folder.write("a.toml", scene);
  folder.write("b.toml", scene);
  EXPECT_EQ(drape(folder, "render a.toml b.toml -o film.gif").code, 2);
  EXPECT_EQ(drape(folder, "render a.toml b.toml -o {scene}.png --frames 1..1").code, 0);
  EXPECT_TRUE(fs::exists(folder.path() / "a.png"));
  EXPECT_TRUE(fs::exists(folder.path() / "b.png"));
}

TEST(CommandLine, AnUnwritableFolderExitsWith4) {
  const test::SceneFolder folder;
  folder.write("scene.toml", scene);
  folder.write("file", "");
  const Finished finished = drape(folder, "render scene.toml -o file/film.gif");
  EXPECT_EQ(finished.code, 4) << finished.text;
}

}  // namespace
}  // namespace drape::cli
