// Motion files on the command line: recorded, killed, resumed and drawn.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>
#include <random>
#include <regex>

#include "drape/scene/scene.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"
#include "tests/support/methods.hpp"

namespace drape::test {
namespace {

const std::filesystem::path source = DRAPE_SOURCE_DIR;

bool is_there(const SceneFolder& folder, const std::string& name) { return std::filesystem::exists(folder.path(name)); }

class HomeworkMotion : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Scene, HomeworkMotion, testing::Range(1, 6), testing::PrintToStringParamName());

TEST_P(HomeworkMotion, IsDrawnAsTheSceneIs) {
  const SceneFolder folder;
  const std::string scene = (source / "scenes/homework" / (std::to_string(GetParam()) + ".toml")).string();
  const std::string small = " --set video.size=[64,48] ";
  EXPECT_EQ(drape(folder, "simulate " + scene + " -o m.drape").code, 0);
  const Finished direct = drape(folder, "render " + scene + small + "-o direct.gif -o direct.obj");
  const Finished later = drape(folder, "render m.drape" + small + "-o later.gif -o later.obj");
  EXPECT_EQ(direct.code, 0) << direct.text;
  EXPECT_EQ(later.code, 0) << later.text;
  EXPECT_TRUE(content(folder.path("later.gif")) == content(folder.path("direct.gif")));
  EXPECT_EQ(content(folder.path("later.obj")), content(folder.path("direct.obj")));
}

/// Its sphere follows a USD file, which the motion file contains.
TEST(ShowcaseMotion, IsDrawnWhereItsFilesAreNot) {
  const SceneFolder folder;
  for (const std::string name : {"moving_sphere.toml", "swinging_sphere.usda"}) {
    folder.write(name, content(source / "scenes/showcase" / name));
  }
  const std::string small = " --set video.size=[64,48] --frames 20..30 ";
  EXPECT_EQ(drape(folder, "simulate moving_sphere.toml -o m.drape").code, 0);
  EXPECT_EQ(drape(folder, "render moving_sphere.toml" + small + "-o direct.gif").code, 0);
  std::filesystem::remove(folder.path("moving_sphere.toml"));
  std::filesystem::remove(folder.path("swinging_sphere.usda"));
  const Finished later = drape(folder, "render m.drape" + small + "-o later.gif");
  EXPECT_EQ(later.code, 0) << later.text;
  EXPECT_TRUE(content(folder.path("later.gif")) == content(folder.path("direct.gif")));
}

/// Returns a scene with all effects, long enough to be killed during its run.
std::string long_scene(const NamedMethod& method) {
  std::string text =
      "[cloth]\nmesh = { grid = [10, 10] }\nstiffness = 50\npins = [0, 10]\n[time]\nstep = 0.005\nduration = 3\n"
      "[integrator]\nmethod = \"" +
      std::string(method_names[static_cast<std::size_t>(method.method)]) + "\"\n";
  if (!method.is_explicit()) text += "scheme = \"" + scheme_name(method.scheme) + "\"\n";
  return text +
         "[effects.gravity]\n[effects.air]\nvelocity = [1, 2, 0]\ngust = 1\n[effects.damping]\nfactor = 0.5\n"
         "[effects.moving_pins]\npins = [0, 10]\nkeyframes = [{ time = 1, offset = [0, 0, 0.2] }]\nrelease = 2\n"
         "[effects.sphere]\nkeyframes = [{ time = 0, center = [0, 0, -0.4] }, { time = 2, center = [0, 0.5, -0.2] }]\n"
         "radius = 0.3\n[effects.ground]\nheight = -0.6\nfriction = 0.2\n[effects.strain_limit]\nmax_stretch = 1.1\n"
         "[effects.self_collision]\nthickness = 0.02\n[effects.bending]\nrigidity = 1e-4\n";
}

/// Starts drape, and signals it some seconds after it began to record, unless it has finished by then.
Finished signal_after(const SceneFolder& folder, const std::string& arguments, double seconds,
                      const std::string& name) {
  return run_shell(folder, std::string("{ ") + DRAPE_EXECUTABLE + " " + arguments +
                               " & p=$!; until [ -e m.drape.checkpoint ] || ! kill -0 $p; do sleep 0.01; done; sleep " +
                               std::to_string(seconds) + "; kill -" + name + " $p; wait $p; }");
}

/// Kills a run repeatedly until it reaches its end.
void expect_same_after_kills(const NamedMethod& method, int kills) {
  const SceneFolder folder;
  folder.write("scene.toml", long_scene(method));
  ASSERT_EQ(drape(folder, "simulate scene.toml -o whole.drape --energies whole.csv").code, 0);
  std::mt19937 random(static_cast<unsigned>(kills));
  std::uniform_real_distribution<double> moment(0, 0.15);
  signal_after(folder, "simulate scene.toml -o m.drape --checkpoint 0.02", moment(random), "KILL");
  for (int k = 1; k < kills && !is_there(folder, "m.drape"); ++k) {
    signal_after(folder, "simulate --resume m.drape --checkpoint 0.02", moment(random), "KILL");
  }
  if (!is_there(folder, "m.drape")) {
    const Finished ended = drape(folder, "simulate --resume m.drape --energies parts.csv");
    EXPECT_EQ(ended.code, 0) << ended.text;
    EXPECT_EQ(content(folder.path("parts.csv")), content(folder.path("whole.csv")));
  }
  EXPECT_TRUE(content(folder.path("m.drape")) == content(folder.path("whole.drape"))) << method.name;
  EXPECT_FALSE(is_there(folder, "m.drape.partial"));
  EXPECT_FALSE(is_there(folder, "m.drape.checkpoint"));
}

TEST(KilledRun, ComesToTheSameBytes) {
  for (const int k : {0, 4, 8}) expect_same_after_kills(all_methods[static_cast<std::size_t>(k)], 3);
}

class ManyKills : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(Nightly, ManyKills, testing::ValuesIn(all_methods), method_name);
TEST_P(ManyKills, ComeToTheSameBytes) { expect_same_after_kills(GetParam(), 20); }

TEST(InterruptedRun, SaysHowItGoesOn) {
  const SceneFolder folder;
  folder.write("scene.toml", long_scene(all_methods[4]));
  const Finished begun = signal_after(folder, "simulate scene.toml --steps 4000 -o m.drape", 0.3, "TERM");
  EXPECT_EQ(begun.code, 130);
  EXPECT_NE(begun.text.find("of 4000 steps; m.drape.partial has the motion so far, and drape simulate --resume "
                            "m.drape continues it"),
            std::string::npos)
      << begun.text;
  const Finished anew = drape(folder, "simulate scene.toml -o m.drape");
  EXPECT_EQ(anew.code, 2);
  EXPECT_NE(anew.text.find("drape simulate --resume m.drape completes it; to start over, remove it"),
            std::string::npos);
  const Finished drawn = drape(folder, "render m.drape.partial -o x.gif");
  EXPECT_EQ(drawn.code, 2);
  EXPECT_EQ(drawn.text,
            "drape: m.drape.partial is not complete: drape simulate --resume m.drape.partial continues it\n");
}

/// After any early end, one command completes the motion and all outputs of the run.
TEST(InterruptedRun, GoesOnToTheSameFilms) {
  const SceneFolder folder;
  folder.write("scene.toml", long_scene(all_methods[5]) + "[video]\nsize = [64, 48]\nfps = 2\n");
  ASSERT_EQ(drape(folder, "render scene.toml --steps 2000 -o whole.gif -o whole.npz").code, 0);
  for (const std::string signal : {"TERM", "KILL"}) {
    const Finished begun =
        signal_after(folder, "render scene.toml --steps 2000 -o m.drape -o film.gif --checkpoint 0.1", 0.2, signal);
    ASSERT_FALSE(is_there(folder, "m.drape")) << "it was over before: " << begun.text;
    if (signal == "TERM") {
      EXPECT_EQ(begun.code, 130);
      EXPECT_NE(begun.text.find("and drape render --resume m.drape -o film.gif continues it"), std::string::npos)
          << begun.text;
    }
    const Finished ended = drape(folder, "render --resume m.drape -o film.gif -o film.npz");
    EXPECT_EQ(ended.code, 0) << ended.text;
    EXPECT_TRUE(content(folder.path("film.gif")) == content(folder.path("whole.gif"))) << signal;
    EXPECT_TRUE(content(folder.path("film.npz")) == content(folder.path("whole.npz"))) << signal;
    for (const std::string name : {"m.drape", "film.gif", "film.npz"}) std::filesystem::remove(folder.path(name));
  }
}

/// The command that a run suggests at its early end has its records and the options that shape its films.
TEST(InterruptedRun, GoesOnWithItsOptionsAndRecords) {
  const SceneFolder folder;
  folder.write("scene.toml", long_scene(all_methods[5]) + "[video]\nsize = [64, 48]\n");
  const std::string rest = "-o film.gif --every 400 --max-size 1MB --start poster --poster --energies e.csv";
  const Finished begun = signal_after(folder, "render scene.toml --steps 2000 -o m.drape " + rest, 0.2, "TERM");
  ASSERT_EQ(begun.code, 130) << begun.text;
  EXPECT_NE(begun.text.find("and drape render --resume m.drape " + rest + " continues it"), std::string::npos)
      << begun.text;
  const Finished ended = drape(folder, "render --resume m.drape " + rest);
  EXPECT_EQ(ended.code, 0) << ended.text;
  for (const std::string name : {"m.drape", "film.gif", "film.poster.png", "e.csv"}) {
    EXPECT_TRUE(is_there(folder, name)) << name;
  }
}

TEST(InterruptedRun, DoesNotGoOnWhereItsFilmsCannotBeMade) {
  const SceneFolder folder;
  folder.write("scene.toml", long_scene(all_methods[4]));
  signal_after(folder, "simulate scene.toml --steps 4000 -o m.drape", 0.1, "TERM");
  const auto refused = [&](const std::string& arguments, int code = 2) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, code) << arguments;
    EXPECT_TRUE(is_there(folder, "m.drape.partial")) << arguments;
    return finished.text;
  };
  EXPECT_EQ(refused("simulate --resume m.drape -o x.gif"),
            "drape: drape simulate draws nothing, but -o x.gif has to be drawn: use drape render\n");
  EXPECT_EQ(refused("render --resume m.drape -o n.drape"), "drape: -o n.drape: m.drape is already a motion file\n");
  EXPECT_EQ(refused("render --resume m.drape -o x.gif --steps 4001"), "drape: --steps 4001: m.drape has 4000\n");
  EXPECT_EQ(refused("render --resume m.drape -o x.git"), refused("render scene.toml -o x.git"));
  EXPECT_NE(
      refused("render --resume m.drape -o x.gif --set cloth.stiffness=60").find("cloth.stiffness: 50, and 60 in --set"),
      std::string::npos);
  for (const auto& [arguments, files] :
       {std::pair("simulate --resume m.drape --energies x.csv --trace x.csv", "--energies x.csv and --trace x.csv"),
        std::pair("simulate --resume m.drape -o x.obj --energies x.obj", "-o x.obj and --energies x.obj"),
        std::pair("simulate --resume m.drape --energies m.drape", "-o m.drape and --energies m.drape")}) {
    EXPECT_EQ(refused(arguments), "drape: " + std::string(files) + " write the same file\n");
  }
  EXPECT_NE(refused("simulate --resume m.drape --frames 0..3").find("and there is no -o"), std::string::npos);
  EXPECT_EQ(refused("simulate scene.toml --resume m.drape"),
            "drape: --resume m.drape continues the run of its own scene, and takes no SCENE\n");
}

/// Returns the greatest memory of the finished child processes [kB].
double most_memory() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_maxrss);
}

TEST(RecordedRun, KeepsItsMemoryWhateverItsLength) {
#ifdef DRAPE_SANITIZED
  GTEST_SKIP() << "a sanitizer keeps what is freed";
#endif
  const SceneFolder folder;
  folder.write("scene.toml",
               "[cloth]\nmesh = { grid = [30, 30] }\nstiffness = 10\npins = [0]\n[time]\nstep = 0.001\nduration = 3\n"
               "[integrator]\nmethod = \"semi-implicit\"\n[effects.gravity]\n[video]\nsize = [64, 48]\n");
  const auto made = [&](const std::string& name, const std::string& steps) {
    ASSERT_EQ(drape(folder, "simulate scene.toml -o " + name + ".drape --steps " + steps).code, 0);
    ASSERT_EQ(drape(folder, "render " + name + ".drape --every 1 -o " + name + ".obj").code, 0);
    ASSERT_EQ(drape(folder, "render " + name + ".drape --every 50 -o " + name + ".gif").code, 0);
  };
  made("short", "10");
  const double small = most_memory();
  made("long", "3000");
  const double size = static_cast<double>(std::filesystem::file_size(folder.path("long.drape"))) / 1024;
  EXPECT_GT(size, 40000) << "kB of file, so that it would be seen beside what threads take on a busy machine";
  EXPECT_LT(most_memory(), small + 0.3 * size);
}

/// Compares everything except measured times.
TEST(MotionOnTheCommandLine, HasItsRecordsWhenItIsComplete) {
  const SceneFolder folder;
  folder.write("scene.toml", swinging_scene);
  ASSERT_EQ(drape(folder, "simulate scene.toml -o m.drape --energies e.csv --positions p.csv --trace t.csv").code, 0);
  const Finished again =
      drape(folder, "simulate --resume m.drape --energies e2.csv --positions p2.csv --trace t2.csv --stats s.json");
  EXPECT_EQ(again.code, 0) << again.text;
  EXPECT_NE(again.text.find("e2.csv"), std::string::npos) << again.text;
  EXPECT_EQ(content(folder.path("e2.csv")), content(folder.path("e.csv")));
  EXPECT_EQ(content(folder.path("p2.csv")), content(folder.path("p.csv")));
  const std::regex times("[0-9.]+\\n");
  EXPECT_EQ(std::regex_replace(content(folder.path("t.csv")), times, "\n"), content(folder.path("t2.csv")));
  EXPECT_NE(content(folder.path("s.json")).find("\"median\": null"), std::string::npos);
  EXPECT_EQ(drape(folder, "render --resume m.drape --energies e3.csv -o m.obj").code, 0);
  EXPECT_EQ(content(folder.path("e3.csv")), content(folder.path("e.csv")));
  EXPECT_TRUE(is_there(folder, "m.obj"));
  const std::string motion = content(folder.path("m.drape"));
  EXPECT_EQ(drape(folder, "simulate --resume m.drape --energies m.drape").code, 2);
  EXPECT_TRUE(content(folder.path("m.drape")) == motion);
}

TEST(MotionOnTheCommandLine, SaysWhatIsWrong) {
  const SceneFolder folder;
  folder.write("scene.toml", swinging_scene);
  folder.write("other.toml", std::regex_replace(swinging_scene, std::regex("stiffness = 50"), "stiffness = 60"));
  folder.write("look.toml", swinging_scene + "[look]\ncolor = \"red\"\n[video]\nfps = 10\nsize = [64, 48]\n");
  ASSERT_EQ(drape(folder, "--quiet simulate scene.toml -o m.drape").text, "");
  const auto text = [&](const std::string& arguments, int code = 2) {
    const Finished finished = drape(folder, "--quiet " + arguments);
    EXPECT_EQ(finished.code, code) << arguments;
    return finished.text;
  };
  EXPECT_EQ(text("simulate m.drape"),
            "drape: m.drape is already a motion: use drape render to draw it, or --resume m.drape for its records\n");
  EXPECT_EQ(
      text("render m.drape --energies e.csv"),
      "drape: --energies needs a simulation, and m.drape is only read: use drape simulate --resume m.drape --energies "
      "e.csv\n");
  EXPECT_EQ(text("render m.drape -o n.drape"), "drape: -o n.drape: m.drape is already a motion file\n");
  EXPECT_EQ(text("render m.drape --steps 30"), "drape: --steps 30: m.drape has 20\n");
  EXPECT_EQ(text("render m.drape --scene other.toml"),
            "drape: m.drape is a different motion from what other.toml gives: simulate again, or leave these values "
            "unchanged\n"
            "drape: cloth.stiffness: 50, and 60 in other.toml\n");
  EXPECT_NE(text("render m.drape --set cloth.stiffness=60").find("cloth.stiffness: 50, and 60 in --set"),
            std::string::npos);
  EXPECT_EQ(text("render m.drape --set look.colour=red"),
            "drape: --set look.colour=red: unknown key 'colour' in [look]; did you mean 'color'?\n");
  EXPECT_EQ(text("simulate scene.toml -o a.drape -o b.drape"),
            "drape: -o a.drape and -o b.drape: a run writes only one motion file\n");
  EXPECT_EQ(text("simulate scene.toml -o a.drape --every 0"),
            "drape: --every takes a number of steps of at least 1, a time such as 0.1s, or frames; found '0'\n");
  EXPECT_EQ(text("simulate scene.toml -o {frame}.drape"),
            "drape: '{frame}.drape' is one file for the whole run: it cannot contain {frame}\n");
  EXPECT_EQ(text("simulate"), "drape: SCENE is required; see drape --help\n");
  EXPECT_EQ(text("simulate --resume m.gif"),
            "drape: --resume m.gif: expected the name of a motion file, as in motion.drape\n");
  EXPECT_EQ(text("simulate --resume n.drape"), "drape: n.drape: nothing to resume: no n.drape.partial\n");
  EXPECT_EQ(text("simulate --resume m.drape", 0), "");
  EXPECT_EQ(drape(folder, "simulate --resume m.drape.partial").text, "drape: m.drape is complete\n");
  EXPECT_EQ(text("render m.drape --scene look.toml -o red.gif", 0), "");
  EXPECT_EQ(text("render look.toml -o direct.gif", 0), "");
  EXPECT_EQ(content(folder.path("red.gif")), content(folder.path("direct.gif")));
  EXPECT_EQ(text("render m.drape --set look.color=red --set video.fps=10 --set video.size=[64,48] -o set.gif", 0), "");
  EXPECT_EQ(content(folder.path("set.gif")), content(folder.path("direct.gif")));
}

TEST(MotionOnTheCommandLine, FindsTexturesOfOverridesBesideIt) {
  const SceneFolder folder;
  folder.write("s/a.toml", least_scene + "duration = 0.1\n[video]\nsize = [64, 48]\n[look]\ntexture = \"plaid.png\"\n");
  folder.write("s/m.png", content(source / "textures/gingham.png"));
  ASSERT_EQ(drape(folder, "simulate s/a.toml -o s/a.drape -o s/a.npz").code, 0);
  const auto picture = [&](const std::string& options) {
    const Finished finished = drape(folder, "render " + options + " -o x.png");
    EXPECT_EQ(finished.code, 0) << finished.text;
    return content(folder.path("x.png"));
  };
  const std::string own = picture("s/a.toml"), other = picture("s/a.toml --set look.texture=m.png");
  ASSERT_TRUE(own != other);
  EXPECT_TRUE(picture("s/a.drape") == own);
  EXPECT_TRUE(picture("s/a.drape --set look.texture=m.png") == other);
  EXPECT_TRUE(picture("s/a.drape --set cloth.texture=m.png") == other);
  EXPECT_TRUE(picture("s/a.drape --set look.texture=file-1.png") == own) << "from the motion";
  EXPECT_EQ(drape(folder, "render s/a.npz --set look.texture=m.png -o y.png").code, 0);
  for (const std::string motion : {"s/a.drape", "s/a.npz"}) {
    const Finished missing = drape(folder, "render " + motion + " --set look.texture=none.png -o x.png");
    EXPECT_EQ(missing.code, 2) << missing.text;
    EXPECT_NE(missing.text.find("no such file: neither s/none.png nor "), std::string::npos) << missing.text;
  }
}

TEST(MotionOnTheCommandLine, WarnsOfGaps) {
  const SceneFolder folder;
  folder.write("scene.toml", swinging_scene);
  ASSERT_EQ(drape(folder, "simulate scene.toml -o m.drape --every 10").code, 0);
  const Finished rendered = drape(folder, "render m.drape -o x{frame}.obj");
  EXPECT_EQ(rendered.code, 0);
  EXPECT_NE(
      rendered.text.find("m.drape: 8 frames lie between stored states more than a step apart and are interpolated"),
      std::string::npos)
      << rendered.text;
}

}  // namespace
}  // namespace drape::test
