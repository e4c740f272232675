#include <gtest/gtest.h>

#include "drape/scene/scene.hpp"
#include "scene/scene_values.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape::scene_caption {
namespace {

using test::least_scene;
using test::SceneFolder;

std::string with_caption(const std::string& text) { return least_scene + "[caption]\ntext = \"" + text + "\"\n"; }

std::string filled(const std::string& scene, const Frame& frame = {}) {
  const SceneFolder folder;
  const Scene loaded = folder.load(scene);
  return loaded.caption.filled.fill(
      [&](const std::string& name) { return moment_value(name, frame, loaded.simulation.step); });
}

TEST(SceneCaption, NamesAnyKeyBeItGivenOrNot) {
  EXPECT_EQ(filled(with_caption("{integrator.method}, h = {time.step} s, {cloth.stiffness:.1f} N/m")),
            "verlet, h = 0.01 s, 10.0 N/m");
  EXPECT_EQ(filled(with_caption("{scene}: {cloth.mesh}, tolerance {integrator.tolerance:.1e}, {camera.up}")),
            "scene: { grid = [2, 2] }, tolerance default, [0, 0, 1]");
  EXPECT_EQ(filled(with_caption("{effects.damping.factor}") + "[effects.damping]\nfactor = 0.25\n"), "0.25");
  EXPECT_EQ(filled(with_caption("{effects.sphere.1.radius}") +
                   "[[effects.sphere]]\ncenter = [0, 0, 0]\nradius = 1\n[[effects.sphere]]\ncenter = [0, 0, 5]\n"
                   "radius = 2\n"),
            "2");
}

TEST(SceneCaption, NamesASingleEffectWithItsNumberToo) {
  const std::string sphere = "[effects.sphere]\ncenter = [0, 0, 5]\nradius = 2\n";
  EXPECT_EQ(filled(with_caption("{effects.sphere.0.radius:.1f}, {effects.sphere.radius}") + sphere), "2.0, 2");
  const SceneFolder folder;
  EXPECT_NE(folder.problems(with_caption("{effects.sphere.1.radius}") + sphere).find("unknown name"),
            std::string::npos);
}

TEST(SceneCaption, FollowsOverrides) {
  const SceneFolder folder;
  const Scene scene = folder.load(with_caption("ε = {integrator.tolerance}"), {"integrator.tolerance=0.004"});
  EXPECT_EQ(scene.caption.filled.fill({}), "ε = 0.004");
}

TEST(SceneCaption, NamesWhatChangesWithTime) {
  Frame frame;
  frame.index = 7;
  frame.time = 0.125;
  frame.iterations = 12;
  frame.energies = Energies{.kinetic = 1.5, .gravity = -4, .elastic = 0.25};
  EXPECT_EQ(
      filled(with_caption("{time:.2f} {frame:03} {step} {iterations} {energy.total} {energy.gravity:.1f}"), frame),
      "0.12 007 13 12 -2.25 -4.0");
}

TEST(SceneCaption, MistakesAreFoundWhenTheSceneIsRead) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with_caption("{integrater.method}")),
            "scene.toml:7:8: text: unknown name 'integrater.method'; did you mean 'integrator.method'?");
  EXPECT_EQ(folder.problems(with_caption("{method}")),
            "scene.toml:7:8: text: unknown name 'method'; did you mean 'integrator.method'?");
  EXPECT_EQ(folder.problems(with_caption("t = {time:.2q}")),
            "scene.toml:7:8: text: {time:.2q}: unknown format '.2q'; a number takes one like ':.2f', ':.1e', ':.3g', "
            "':6.1f' or, if it is whole, ':04'");
  EXPECT_EQ(folder.problems(with_caption("{integrator.method:.2f}")).substr(0, 59),
            "scene.toml:7:8: text: {integrator.method:.2f}: unknown form");
  EXPECT_EQ(folder.problems(with_caption("{time")), "scene.toml:7:8: text: '{time' has no '}'; write '{{' for a brace");
  EXPECT_EQ(folder.problems(least_scene + "[caption]\nplace = \"top\"\n"),
            "scene.toml:6:1: missing key 'text' in [caption]");
  EXPECT_NE(folder.problems(with_caption("{quite something}")).find("values that change with time are 'time', 'frame'"),
            std::string::npos);
}

TEST(SceneCaption, IsNoPartOfWhatAGoldenIsOf) {
  const SceneFolder folder;
  const std::string plain = folder.load(least_scene).source.digest;
  EXPECT_EQ(folder.load(with_caption("t = {time}") + "[overlay]\nenergies = true\n").source.digest, plain);
  EXPECT_NE(folder.load(least_scene + "[look]\ncolor = \"#000\"\n").source.digest, plain);
}

}  // namespace
}  // namespace drape::scene_caption
