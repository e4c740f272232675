// Several simultaneous runs in one process, as in drape sweep --jobs.

#include <gtest/gtest.h>

#include "core/parallel.hpp"
#include "run/run_scene.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

/// Runs share libraries that load at first use: codecs, fonts, OpenGL, kernels. Each run is another scene with a
/// caption, an automatic camera and colour scale, a film, a still and a motion.
std::string scene_of(std::size_t i) {
  const std::vector<std::string> methods{"liu13", "implicit", "verlet"};
  return "[cloth]\nmesh = { grid = [4, 4] }\nstiffness = 20\npins = [\"corner:x-y-\"]\n[time]\nstep = 0.005\n"
         "duration = 0.1\n[integrator]\nmethod = \"" +
         methods.at(i) +
         "\"\n[effects.gravity]\n[effects.self_collision]\n[look]\ncolor_by = \"stretch\"\n[video]\nsize = [64, 48]\n"
         "[caption]\ntext = \"{integrator.method}\"\n";
}

TEST(RunsAtOnce, HaveTheSameBitsAsAlone) {
  constexpr std::size_t count = 3;
  const test::SceneFolder folder;
  const auto run = [&](const std::string& place, std::size_t i) {
    const LoadedScene scene = load_scene(folder.path(std::to_string(i) + ".toml"));
    const std::string to = folder.path(place + std::to_string(i));
    RunOptions options;
    options.outputs = {to + "/film.gif", to + "/still.png"};
    options.motion = {.path = to + "/motion.drape"};
    options.time_effects = true;
    Progress progress;
    const RunResult result = run_scene(scene, options, {}, progress);
    EXPECT_EQ(result.problems, std::vector<std::string>());
  };
  for (std::size_t i = 0; i < count; ++i) folder.write(std::to_string(i) + ".toml", scene_of(i));
  // Before anything is loaded.
  for_each_in_parallel(count, count, {}, [&](std::size_t, std::size_t i) { run("beside-", i); });
  for (std::size_t i = 0; i < count; ++i) {
    run("alone-", i);
    for (const char* file : {"/film.gif", "/still.png"}) {
      const std::string bytes = test::content(folder.path("alone-" + std::to_string(i)) + file);
      EXPECT_FALSE(bytes.empty()) << file;
      EXPECT_EQ(bytes, test::content(folder.path("beside-" + std::to_string(i)) + file)) << file << " of " << i;
    }
  }
}

}  // namespace
}  // namespace drape
