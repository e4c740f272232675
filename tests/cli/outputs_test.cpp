// Files that a run writes: no file replaces another output or an input, and no result is lost through an unrelated
// error.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/cli/run_drape.hpp"
#include "tests/cli/without_opengl.hpp"
#include "tests/support/files.hpp"

namespace drape::outputs {
namespace {

namespace fs = std::filesystem;
using test::content;
using test::drape;
using test::Finished;
using test::SceneFolder;

const std::string scene = test::swinging_scene + "[video]\nsize = [64, 48]\n";
/// A scene with a fixed camera, so that its motion needs no second run for framing.
const std::string framed = scene + "[camera]\nposition = [4, 4, 3]\ntarget = [0, 0, 0]\n";

/// Runs a line of shell in the folder, in which $drape is the built drape.
int shell(const SceneFolder& folder, const std::string& line) {
  const std::string command = "cd '" + folder.path().string() + "' && drape=" + DRAPE_EXECUTABLE + " && " + line;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::size_t lines(const std::string& text) { return static_cast<std::size_t>(std::ranges::count(text, '\n')); }

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(StandardStreams, AClosedOneIsNotMistakenForAFile) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  ASSERT_EQ(shell(folder, "$drape render scene.toml -o open.avi -o open.mp4 --energies open.csv --quiet"), 0);
  EXPECT_EQ(shell(folder, "$drape render scene.toml -o closed.avi -o closed.mp4 2>&-"), 0);
  EXPECT_EQ(shell(folder, "$drape simulate scene.toml --step-by-step --quiet --energies closed.csv <&- >&- 2>&-"), 0);
  for (const std::string name : {".avi", ".mp4", ".csv"}) {
    EXPECT_EQ(content(folder.path("closed" + name)), content(folder.path("open" + name))) << name;
  }
}

TEST(StandardStreams, OneThatTakesNothingCostsNothing) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  EXPECT_EQ(shell(folder, "$drape simulate scene.toml --energies table.csv 2>/dev/full"), 0);
  EXPECT_EQ(lines(content(folder.path("table.csv"))), 22U);
}

TEST(StandardStreams, OutputThatIsLostIsAnErrorUnlessItsReaderHasHadEnough) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  const std::string steps = "$drape simulate scene.toml --quiet --step-by-step --steps 3000 </dev/null --energies ";
  EXPECT_EQ(shell(folder, "$drape --version >/dev/full 2>message"), 4);
  EXPECT_EQ(shell(folder, "$drape render --help >/dev/full 2>message"), 4);
  EXPECT_EQ(shell(folder, steps + "full.csv >/dev/full 2>message"), 4);
  EXPECT_EQ(content(folder.path("message")), "drape: cannot write to standard output: No space left on device\n");
  EXPECT_EQ(shell(folder, "{ " + steps + "read.csv 2>message; echo $? >code; } | head -n 1 >first"), 0);
  EXPECT_EQ(content(folder.path("code")), "0\n");
  EXPECT_EQ(content(folder.path("message")), "");
  for (const char* table : {"full.csv", "read.csv"}) EXPECT_EQ(lines(content(folder.path(table))), 3002U) << table;
}

TEST(Outputs, AreRefusedWhereTwoAreOneFile) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  folder.write("a/x.toml", scene);
  folder.write("b/x.toml", scene);
  fs::create_symlink("still.png", folder.path("one.png"));
  fs::create_symlink("still.png", folder.path("two.png"));
  fs::create_symlink("a", folder.path("c"));
  const auto files_before = folder.file_count();
  for (const auto& [arguments, named] : std::vector<std::pair<std::string, std::string>>{
           {"render a/x.toml b/x.toml", "out/x.gif"},
           {"render a/x.toml a/x.toml", "out/x.gif"},
           {"render a/x.toml scene.toml -o film.gif", "put {scene} into the name"},
           {"simulate scene.toml --energies x.csv --trace x.csv", "--energies x.csv and --trace x.csv"},
           {"render scene.toml -o x.png -o ./x.png", "-o x.png and -o ./x.png"},
           {"render scene.toml -o a/x.png -o c/x.png", "-o a/x.png and -o c/x.png"},
           {"render scene.toml -o new/x.png -o new/../new/x.png", "new/../new/x.png is new/x.png"},
           {"render scene.toml -o one.png -o two.png", "-o one.png and -o two.png"},
           {"render scene.toml -o {frame:04}.png -o 0003.png", "-o {frame:04}.png and -o 0003.png"},
           {"simulate scene.toml -o {frame:04}.obj -o 0003.obj", "-o {frame:04}.obj and -o 0003.obj"},
           {"simulate a/x.toml scene.toml -o end.obj", "put {scene} into the name"},
           {"simulate scene.toml -o end.obj --positions end.obj", "-o end.obj and --positions end.obj"}}) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_TRUE(contains(finished.text, named)) << finished.text;
    EXPECT_FALSE(contains(finished.text, "steps of")) << "it has begun: " << finished.text;
  }
  EXPECT_EQ(folder.file_count(), files_before);
}

TEST(Outputs, AreRefusedWhereTheyAreRead) {
  const SceneFolder folder;
  folder.write("cloth.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  folder.write(
      "ball.usda",
      "#usda 1.0\ndef Sphere \"Ball\"\n{\n    double radius = 0.1\n    double3 xformOp:translate.timeSamples = {\n"
      "        0: (0, 0, 5),\n        24: (0, 0, 6),\n    }\n"
      "    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n");
  folder.write("picture.png", content(fs::path(DRAPE_SOURCE_DIR) / "textures/plaid.png"));
  folder.write("scene.toml",
               "[cloth]\nmesh = \"cloth.obj\"\nstiffness = 10\n[time]\nstep = 0.01\nduration = 0.1\n[look]\ntexture = "
               "\"picture.png\"\n[effects.sphere]\ntrack = \"ball.usda\"\n");
  ASSERT_EQ(drape(folder, "simulate scene.toml --quiet").text, "");
  fs::create_symlink("picture.png", folder.path("link.png"));
  for (const auto& [option, file] : std::vector<std::pair<std::string, std::string>>{
           {"--stats", "scene.toml"}, {"--trace", "./cloth.obj"}, {"--energies", "ball.usda"}, {"-o", "link.png"}}) {
    const std::string before = content(folder.path(file));
    const Finished finished =
        drape(folder, (option == "-o" ? "render" : "simulate") + std::string(" scene.toml ") + option + " " + file);
    EXPECT_EQ(finished.code, 2) << option;
    EXPECT_TRUE(contains(finished.text, option + " " + file + " would overwrite")) << finished.text;
    EXPECT_EQ(content(folder.path(file)), before);
  }
}

/// The motions of other programs are read from several files, and as the frames are drawn.
TEST(Outputs, AreRefusedWhereTheirMotionIsRead) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  const std::string shorter = " --steps 4 --every 1 ";
  ASSERT_EQ(
      drape(folder, "simulate scene.toml -o s/{frame:04}.obj -o m.npz -o m.usda -o m.pvd -o m.pc2" + shorter).code, 0);
  folder.write("played.toml", "[cloth]\nmotion = \"m.npz\"\nbody = \"s/{frame:04}.obj\"\n");
  for (const auto& [motion, output] :
       std::vector<std::pair<std::string, std::string>>{{"m.pc2", "m.obj"},
                                                        {"m.pc2", "m.pc2"},
                                                        {"m.npz", "m.npz"},
                                                        {"m.usda", "m.usda"},
                                                        {"m.pvd", "m/0.vtp"},
                                                        {"s/{frame:04}.obj", "s/0000.obj"},
                                                        {"s/{frame:04}.obj", "s/{frame:04}.obj"},
                                                        {"played.toml", "m.npz"},
                                                        {"played.toml", "s/0002.obj"}}) {
    const Finished finished = drape(folder, "render '" + motion + "' --frames 0..1 -o '" + output + "'");
    EXPECT_EQ(finished.code, 2) << motion;
    EXPECT_TRUE(contains(finished.text, "-o " + output + " would overwrite ")) << finished.text;
  }
}

TEST(Outputs, ThatCannotBeWrittenDoNotKeepTheOthersFromIt) {
  const SceneFolder folder;
  folder.write("scene.toml", framed);
  folder.write("small.toml", framed);
  // Only the film of large frames exceeds the shell's limit for a file's size.
  const std::string outputs = " -o {scene}.avi -o {scene}.png --energies {scene}.csv ";
  const Finished finished = drape(folder,
                                  "render scene.toml small.toml" + outputs +
                                      "--set video.size=[320,240] --set video.fps=50 --set look.mesh_lines=true",
                                  "ulimit -f 100;");
  EXPECT_EQ(finished.code, 4) << finished.text;
  EXPECT_TRUE(contains(finished.text, "cannot write scene.avi: File too large")) << finished.text;
  for (const std::string name : {"scene", "small"}) {
    EXPECT_FALSE(fs::exists(folder.path(name + ".avi")));
    EXPECT_TRUE(fs::exists(folder.path(name + ".png")));
    EXPECT_EQ(lines(content(folder.path(name + ".csv"))), 22U);
  }
  EXPECT_EQ(folder.file_count(), 2U + 4U);
}

TEST(Outputs, OfAllScenesAreLookedAtBeforeTheFirstRuns) {
  const SceneFolder folder;
  const fs::path plaid = fs::path(DRAPE_SOURCE_DIR) / "textures/plaid.png";
  folder.write("cut.png", content(plaid).substr(0, 2000));
  folder.write("a.toml", scene);
  folder.write("b.toml", scene + "[look]\ntexture = \"cut.png\"\n");
  for (const auto& [arguments, code, named] : std::vector<std::tuple<std::string, int, std::string>>{
           {"render a.toml b.toml", 2, "b.toml:15:11: the texture cut.png is damaged"},
           {"render a.toml ./b.toml --set look.texture=cut.png", 2, "--set look.texture=cut.png: the texture"},
           {"render a.toml -o deep/a.gif -o a.mov", 2, "unknown extension '.mov'"},
           {"render a.toml -o ''", 2, "has no extension"},
           {"simulate a.toml -o {frame}.objj", 2, "did you mean '.obj'?"},
           {"simulate a.toml -o {frame}.gif -o {frme}.obj", 2, "use drape render"},
           {"simulate a.toml -o {frme}.obj", 2, "did you mean '{frame}'?"},
           {"simulate a.toml -o /proc/{frame}.obj", 4, "/proc/"},
           {"render a.toml --stats /proc/stats.json", 4, "/proc/stats.json"}}) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, code) << finished.text;
    EXPECT_TRUE(contains(finished.text, named)) << finished.text;
    EXPECT_FALSE(contains(finished.text, "steps of")) << "it has begun: " << finished.text;
  }
  EXPECT_EQ(folder.file_count(), 3U);
  EXPECT_FALSE(fs::exists(folder.path() / "deep"));
}

TEST(Outputs, OfASceneThatFailsDoNotKeepTheNextFromItsOwn) {
  const SceneFolder folder;
  folder.write("a.toml", framed + "[look]\nsamples = 1\n");
  folder.write("b.toml", framed);
  // The first run's missing memory is detected only when it starts.
  const Finished finished =
      drape(folder,
            "simulate a.toml b.toml --stats {scene}.json --set 'cloth.mesh={ grid = [200, 200] }' "
            "--set integrator.method=implicit --set integrator.linear_solver=cholesky --steps 1",
            "ulimit -v 280000;");
  EXPECT_EQ(finished.code, 2) << finished.text;
  EXPECT_TRUE(contains(finished.text, "a.toml: implicit")) << finished.text;
  EXPECT_TRUE(contains(finished.text, "b.toml: implicit")) << finished.text;
}

TEST(MotionOutputs, NeedNoOpenGl) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  const std::string environment = test::without_opengl(folder);
  for (const std::string command : {"simulate", "render"}) {
    const Finished finished = drape(folder, command + " scene.toml -o " + command + "/{frame:04}.obj", environment);
    EXPECT_EQ(finished.code, 0) << finished.text;
    EXPECT_TRUE(contains(finished.text, "/0000.obj … " + command + "/0010.obj  11 files")) << finished.text;
    EXPECT_EQ(lines(content(folder.path(command + "/0010.obj"))), 1U + 49U + 49U + 72U);
  }
  EXPECT_EQ(drape(folder, "render scene.toml -o film.gif -o {frame}.obj", environment).code, 4);
}

TEST(MotionOutputs, ComeFromThePassThatDrawsTheFilm) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  ASSERT_EQ(drape(folder, "render scene.toml -o alone.gif --quiet").text, "");
  ASSERT_EQ(drape(folder, "simulate scene.toml -o alone/{frame}.obj --quiet").text, "");
  ASSERT_EQ(drape(folder, "render scene.toml -o both.gif -o both/{frame}.obj --quiet").text, "");
  EXPECT_EQ(content(folder.path("both.gif")), content(folder.path("alone.gif")));
  for (const std::string frame : {"00", "07", "10"}) {
    EXPECT_EQ(content(folder.path("both/" + frame + ".obj")), content(folder.path("alone/" + frame + ".obj")));
  }
}

TEST(MotionOutputs, GoOnWhereAFilmCannot) {
  const SceneFolder folder;
  folder.write("scene.toml", framed);
  const Finished finished = drape(folder,
                                  "render scene.toml -o film.avi -o {frame:02}.obj --set video.size=[320,240] "
                                  "--set video.fps=50 --set look.mesh_lines=true",
                                  "ulimit -f 100;");
  EXPECT_EQ(finished.code, 4) << finished.text;
  EXPECT_TRUE(contains(finished.text, "cannot write film.avi: File too large")) << finished.text;
  EXPECT_EQ(folder.file_count(), 1U + 21U) << finished.text;
}

TEST(MotionOutputs, ThatDoNotFitOnTheDiskLeaveTheOldOne) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  folder.write("end.obj", "old");
  const Finished finished = drape(folder, "simulate scene.toml -o end.obj", "ulimit -f 1;");
  EXPECT_EQ(finished.code, 4) << finished.text;
  EXPECT_TRUE(contains(finished.text, "cannot write end.obj: File too large")) << finished.text;
  EXPECT_EQ(content(folder.path("end.obj")), "old");
  EXPECT_EQ(folder.file_count(), 2U);
}

TEST(MotionOutputs, OfAMotionThatEndsEarlyAreCalledPartial) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  folder.write("end.obj", "old");
  folder.write("input", "\n\n\n\nq");
  const Finished finished =
      drape(folder, "simulate scene.toml --step-by-step --quiet -o end.obj -o {frame:02}.obj < input");
  EXPECT_EQ(finished.code, 130) << finished.text;
  EXPECT_EQ(content(folder.path("end.obj")), "old");
  EXPECT_EQ(content(folder.path("end.partial.obj")),
            content(folder.path("02.obj")));  // after five frames of 0.04 s / 0.02 s steps
}

TEST(Outputs, OfASequenceAreToldInOneLine) {
  const SceneFolder folder;
  folder.write("scene.toml", framed);
  const Finished finished = drape(folder, "render scene.toml -o frames/{frame:02}.png");
  EXPECT_EQ(finished.code, 0) << finished.text;
  EXPECT_TRUE(contains(finished.text, "frames/00.png … frames/10.png  11 files")) << finished.text;
  EXPECT_EQ(lines(finished.text), 4U) << finished.text;
}

TEST(Outputs, OfARunWithoutStepsAreTold) {
  const SceneFolder folder;
  folder.write("scene.toml", framed);
  for (const std::string command :
       {"simulate scene.toml --steps 0 -o start.obj", "render scene.toml --at 0s -o start.png"}) {
    const Finished finished = drape(folder, command);
    EXPECT_EQ(finished.code, 0) << finished.text;
    EXPECT_TRUE(contains(finished.text, "0 steps\nsimulate 0")) << finished.text;
    EXPECT_TRUE(contains(finished.text, command.substr(command.find("start")) + "  ")) << finished.text;
    EXPECT_FALSE(contains(finished.text, "per step")) << finished.text;
  }
}

TEST(Numbers, OfTheCommandLineAreCheckedWithTheirLimits) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
           {"simulate scene.toml --steps -1",
            "--steps: expected a whole number at least 0 and at most 1000000000, found '-1'"},
           {"simulate scene.toml --steps nan", "found 'nan'"},
           {"study accuracy scene.toml --tolerances 0", "--tolerances: expected a number above 0, found '0'"},
           {"study accuracy scene.toml --steps 0.1,nan", "--steps: expected a number above 0, found 'nan'"},
           {"check scene.toml --pixel-limit nan", "expected a number at least 0 and at most 1, found 'nan'"},
           {"check scene.toml --motion-tolerance inf", "expected a number at least 0, found 'inf'"}}) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, 2) << finished.text;
    EXPECT_TRUE(contains(finished.text, message)) << finished.text;
  }
}

TEST(Environment, ARendererThatMesaDoesNotHaveIsNamed) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  for (const char* backend : {"auto", "osmesa", "egl"}) {
    const Finished finished = drape(folder, std::string("render scene.toml -o x.png --quiet --backend ") + backend,
                                    "GALLIUM_DRIVER=nonsense");
    EXPECT_EQ(finished.code, 4) << finished.text;
    EXPECT_EQ(lines(finished.text), 1U) << finished.text;
    EXPECT_TRUE(contains(finished.text, "GALLIUM_DRIVER is \"nonsense\"")) << finished.text;
  }
}

}  // namespace
}  // namespace drape::outputs
