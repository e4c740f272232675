// Faults around drape: full disks, broken files, signals, many processes. A film is always complete or absent, and the
// file that it would replace stays intact.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>

#include "output/registry.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"
#include "tests/support/gif_file.hpp"
#include "tests/support/random.hpp"

namespace drape::faults {
namespace {

namespace fs = std::filesystem;
using test::content;
using test::drape;
using test::Finished;
using test::SceneFolder;

const std::string scene = test::least_scene +
                          "duration = 2\n[effects.gravity]\n[video]\nsize = [64, 48]\n[look]\nsamples = 1\n[camera]\n"
                          "position = [4, 4, 3]\ntarget = [0, 0, 0]\n";

std::vector<std::string> names(const SceneFolder& folder) {
  std::vector<std::string> result;
  for (const auto& entry : fs::directory_iterator(folder.path())) result.push_back(entry.path().filename());
  std::sort(result.begin(), result.end());
  return result;
}

/// Starts a long film in the folder.
pid_t start_film(const SceneFolder& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{DRAPE_EXECUTABLE,       "render", "scene.toml", "--quiet", "--set",
                                 "time.duration=100000", "-o",     "film.gif"};
  words.insert(words.end(), more.begin(), more.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child != 0) return child;
  if (chdir(folder.path().c_str()) != 0) _exit(99);
  execv(DRAPE_EXECUTABLE, arguments.data());
  _exit(99);
}

/// Sends a signal after a time and returns the exit code as a shell reports it.
int end_with(pid_t child, int signal, double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Returns for each kind of file its name, or a part of it, and a command that writes it.
std::vector<std::pair<std::string, std::string>> all_kinds_of_files() {
  std::vector<std::pair<std::string, std::string>> kinds{
      {"0000.png", "render scene.toml -o FOLDER/{frame:04}.png"},
      {"0000.obj", "simulate scene.toml -o FOLDER/{frame:04}.obj"},
      {"sheet.png", "render scene.toml --sheet 2x2 -o FOLDER/sheet.png"},
      {"page.html", "compare scene.toml scene.toml -o FOLDER/page.html"}};
  for (const OutputFormat& format : output_formats()) {
    const std::string film = "film" + std::string(format.extension);
    kinds.emplace_back(film, "render scene.toml -o FOLDER/" + film);
  }
  for (const std::string record : {"energies", "trace", "positions", "stats"}) {
    kinds.emplace_back(record, "simulate scene.toml --" + record + " FOLDER/" + record);
  }
  return kinds;
}

std::string in_folder(std::string command, const std::string& folder) {
  return command.replace(command.find("FOLDER"), 6, folder);
}

TEST(AddressSpace, ThatIsTooSmallForDrawingIsAnError) {
#ifdef DRAPE_SANITIZED
  GTEST_SKIP() << "a sanitizer maps terabytes";
#endif
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  for (const int megabytes : {600, 950, 1050}) {
    const Finished finished = drape(folder, "render scene.toml --set time.duration=0.1 -o film.gif",
                                    "ulimit -v " + std::to_string(1000 * megabytes) + " &&");
    EXPECT_EQ(finished.code, 4) << finished.text;
    EXPECT_FALSE(fs::exists(folder.path("film.gif")));
  }
  const Finished most = drape(folder, "simulate scene.toml --set time.duration=0.1", "ulimit -v 950000 &&");
  EXPECT_EQ(most.code, 0) << most.text;
}

TEST(Faults, AFullDiskExitsWith4AndLeavesTheOldFile) {
  for (const auto& [file, command] : all_kinds_of_files()) {
    SCOPED_TRACE(command);
    const SceneFolder folder;
    folder.write("scene.toml", scene);
    folder.write(file, "old");
    // The shell forbids any file to grow, and drape inherits the limit.
    const Finished finished = drape(folder, in_folder(command, "."), "ulimit -f 0;");
    EXPECT_EQ(finished.code, 4) << finished.text;
    EXPECT_NE(finished.text.find("cannot write "), std::string::npos) << finished.text;
    EXPECT_EQ(content(folder.path() / file), "old");
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
      const std::string name = entry.path().filename();
      const bool known = entry.is_directory() || name == "scene.toml" || name == file || name == "film.drape.partial";
      EXPECT_TRUE(known) << name;
    }
  }
}

TEST(Faults, AFolderThatCannotBeWrittenExitsWith4BeforeAnythingIsComputed) {
  const SceneFolder folder;
  std::string minutes = scene;
  minutes.replace(minutes.find("duration = 2"), 12, "duration = 1e3");
  folder.write("scene.toml", minutes);
  folder.write("file", "old");
  for (const auto& [file, command] : all_kinds_of_files()) {
    for (const std::string place : {"/proc", "file"}) {
      SCOPED_TRACE(in_folder(command, place));
      const Finished finished = drape(folder, in_folder(command, place));
      EXPECT_EQ(finished.code, 4) << finished.text;
      EXPECT_TRUE(finished.text.starts_with("drape: cannot write " + place + "/")) << finished.text;
    }
  }
  EXPECT_EQ(content(folder.path() / "file"), "old");
  EXPECT_EQ(names(folder), (std::vector<std::string>{"file", "scene.toml"}));
}

TEST(Faults, ATextureThatIsMissingOrCutIsNamed) {
  const SceneFolder folder;
  const fs::path plaid = fs::path(DRAPE_SOURCE_DIR) / "textures/plaid.png";
  folder.write("cut.png", content(plaid).substr(0, 2000));
  folder.write("scene.toml", scene);
  for (const char* texture : {"nowhere.png", "cut.png"}) {
    const Finished finished = drape(folder, std::string("render scene.toml -o film.gif --set look.texture=") + texture);
    EXPECT_EQ(finished.code, 2) << finished.text;
    EXPECT_NE(finished.text.find(texture), std::string::npos) << finished.text;
    EXPECT_FALSE(fs::exists(folder.path() / "film.gif"));
  }
}

TEST(Faults, ATextureThatCannotBeReadIsNamedWithItsPlaceByWhateverDraws) {
  const SceneFolder folder;
  folder.write("cut.png", content(fs::path(DRAPE_SOURCE_DIR) / "textures/plaid.png").substr(0, 2000));
  folder.write("scene.toml", test::least_scene + "[look]\ntexture = \"cut.png\"\n");
  for (const char* command : {"render", "bless", "check", "study accuracy"}) {
    const Finished finished = drape(folder, std::string(command) + " scene.toml");
    EXPECT_EQ(finished.code, 2) << command << finished.text;
    EXPECT_NE(finished.text.find("scene.toml:"), std::string::npos) << command << finished.text;
    EXPECT_NE(finished.text.find("the texture"), std::string::npos) << command << finished.text;
    EXPECT_FALSE(fs::exists(folder.path() / "scene.golden")) << command;
  }
}

TEST(Faults, CtrlCAtAnyMomentLeavesAPlayableFilmOrNone) {
  test::Random random(static_cast<std::uint64_t>(getpid()));
  for (int attempt = 0; attempt < 6; ++attempt) {
    const SceneFolder folder;
    folder.write("scene.toml", scene);
    const double moment = random.between(0, 1.2);
    SCOPED_TRACE(moment);
    const int code = end_with(start_film(folder), SIGTERM, moment);
    EXPECT_TRUE(code == 130 || code == 128 + SIGTERM) << code;  // the latter before drape handles signals
    std::vector<std::string> expected{"scene.toml"};
    if (fs::exists(folder.path() / "film.partial.gif")) {
      EXPECT_GT(test::read_gif(folder.path() / "film.partial.gif").delays.size(), 0U);
      expected.insert(expected.begin(), "film.partial.gif");
    }
    EXPECT_EQ(names(folder), expected);
  }
}

/// An unreachable strain limit with a huge number of sweeps, once the cloth has fallen on the sphere.
TEST(Faults, CtrlCEndsAStepThatWouldTakeForEver) {
  const SceneFolder folder;
  folder.write(
      "scene.toml",
      "[cloth]\nmesh = { grid = [20, 20] }\nstiffness = 50\n[time]\nstep = 0.02\nduration = 9\n"
      "[integrator]\nmethod = \"liu13\"\n[effects.gravity]\n[effects.sphere]\ncenter = [0.5, 0.5, -0.6]\n"
      "radius = 0.4\n[effects.strain_limit]\nmax_stretch = 1.001\niterations = 2000000000\ntolerance = 1e-300\n"
      "[video]\nfps = 25\nsize = [64, 48]\n[camera]\nposition = [4, 4, 3]\ntarget = [0, 0, 0]\n");
  const pid_t child = start_film(folder, {"-o", "{frame}.png", "--set", "time.duration=9"});
  const auto pictures = [&] {
    return std::ranges::count_if(names(folder), [](const std::string& name) { return name.ends_with(".png"); });
  };
  while (pictures() < 3 && kill(child, 0) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(end_with(child, SIGTERM, 1), 130);
  const auto drawn = pictures();
  EXPECT_GE(drawn, 3);
  EXPECT_EQ(static_cast<std::ptrdiff_t>(test::read_gif(folder.path() / "film.partial.gif").delays.size()), drawn);
}

// A camera without a position needs the motion before anything is drawn: here the part simulated so far.
TEST(Faults, CtrlCDrawsWhatWasSimulatedWhereTheCameraLooksAtTheMotion) {
  const SceneFolder folder;
  folder.write("scene.toml", test::least_scene + "duration = 2\n[effects.gravity]\n[video]\nsize = [64, 48]\n");
  folder.write("film.gif", "old");
  const pid_t child = start_film(
      folder, {"--set", "cloth.mesh.grid=[40, 40]", "--set", "integrator.method=implicit", "--set", "video.fps=1"});
  EXPECT_EQ(end_with(child, SIGTERM, 4), 130);
  EXPECT_EQ(content(folder.path() / "film.gif"), "old");
  EXPECT_GT(test::read_gif(folder.path() / "film.partial.gif").delays.size(), 1U);
}

TEST(Faults, CtrlCPutsWhatWasDrawnBesideACompleteFilm) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  folder.write("film.gif", "old");
  EXPECT_EQ(end_with(start_film(folder), SIGTERM, 3), 130);
  EXPECT_EQ(content(folder.path() / "film.gif"), "old");
  EXPECT_GT(test::read_gif(folder.path() / "film.partial.gif").delays.size(), 0U);
  EXPECT_EQ(names(folder), (std::vector<std::string>{"film.gif", "film.partial.gif", "scene.toml"}));
}

// A motion that is simulated much faster than it is drawn.
TEST(Faults, CtrlCDrawsForSomeSecondsAtMost) {
  const SceneFolder folder;
  folder.write("scene.toml", scene.substr(0, scene.find("[camera]")));
  // Simulates several times as many frames as can be drawn after Ctrl-C, even on a busy machine.
  constexpr double long_enough = 6;
  EXPECT_EQ(end_with(start_film(folder, {"--energies", "energies.csv"}), SIGTERM, long_enough), 130);
  const std::string rows = content(folder.path() / "energies.partial.csv");
  const auto steps = std::ranges::count(rows, '\n') - 2;
  EXPECT_LT(test::read_gif(folder.path() / "film.partial.gif").delays.size(), 0.01 * 25 * static_cast<double>(steps));
}

TEST(Faults, Kill9LeavesTheOldFilmWhole) {
  test::Random random(static_cast<std::uint64_t>(getpid()));
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  ASSERT_EQ(drape(folder, "render scene.toml --quiet -o film.gif").code, 0);
  const std::string old = content(folder.path() / "film.gif");
  for (int attempt = 0; attempt < 6; ++attempt) {
    EXPECT_EQ(end_with(start_film(folder), SIGKILL, random.between(0, 1.2)), 128 + SIGKILL);
    EXPECT_EQ(content(folder.path() / "film.gif"), old);
  }
  // The next run removes leftovers of the killed ones.
  EXPECT_EQ(drape(folder, "render scene.toml --quiet -o film.gif").code, 0);
  EXPECT_EQ(content(folder.path() / "film.gif"), old);
  EXPECT_EQ(names(folder), (std::vector<std::string>{"film.gif", "scene.toml"}));
}

TEST(Faults, ThirtyTwoAtOnceWriteTheSameFilm) {
  const SceneFolder folder;
  folder.write("scene.toml", scene);
  const std::string frames = "render scene.toml --quiet --frames 0..3 -o ";
  ASSERT_EQ(drape(folder, frames + "alone.gif").code, 0);
  std::vector<int> codes(32, -1);
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      threads.emplace_back(
          [&, i] { codes[i] = drape(folder, frames + (i % 2 == 0 ? "shared.gif" : "own{scene}.gif")).code; });
    }
  }
  EXPECT_EQ(codes, std::vector<int>(32, 0));
  EXPECT_EQ(content(folder.path() / "shared.gif"), content(folder.path() / "alone.gif"));
  EXPECT_EQ(names(folder), (std::vector<std::string>{"alone.gif", "ownscene.gif", "scene.toml", "shared.gif"}));
}

}  // namespace
}  // namespace drape::faults
