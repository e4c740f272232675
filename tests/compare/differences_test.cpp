#include "compare/compare_scenes.hpp"

#include <gtest/gtest.h>

#include "tests/support/scene_folder.hpp"

namespace drape::compare_differences {
namespace {

using test::least_scene;
using Labels = std::vector<std::string>;

std::vector<LoadedScene> scenes(const test::SceneFolder& folder, const std::vector<std::vector<std::string>>& overrides,
                                const std::string& more = "") {
  std::vector<LoadedScene> all;
  for (const std::vector<std::string>& some : overrides) all.push_back(folder.load(least_scene + more, some));
  return all;
}

TEST(Differences, AreTheKeysWithOtherValuesGivenOrNot) {
  const test::SceneFolder folder;
  const auto all =
      scenes(folder, {{"integrator.method=quasi-newton"}, {"integrator.method=liu13", "integrator.tolerance=0.001"}});
  const std::vector<KeyDifference> found = differences(all);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].key, "integrator.method");
  EXPECT_EQ(found[0].values, (Labels{"quasi-newton", "liu13"}));
  EXPECT_EQ(found[1].key, "integrator.tolerance");
  EXPECT_EQ(found[1].values, (Labels{"default", "0.001"}));
  EXPECT_EQ(labels(all, found), (Labels{"quasi-newton, tolerance = default", "liu13, tolerance = 0.001"}));
}

TEST(Differences, ADefaultThatIsGivenIsNone) {
  const test::SceneFolder folder;
  EXPECT_TRUE(differences(scenes(folder, {{}, {"integrator.method=auto", "cloth.mass=1"}})).empty());
}

TEST(Differences, WhatIsTakenFromTheFirstSceneIsNone) {
  const test::SceneFolder folder;
  EXPECT_TRUE(
      differences(scenes(folder, {{}, {"camera.azimuth=3", "video.fps=5", "caption.text=a", "check.size=[32, 32]"}}))
          .empty());
}

TEST(Differences, AnEffectThatIsNotThereIsOneDifference) {
  const test::SceneFolder folder;
  const auto all = scenes(folder, {{}, {"effects.damping.factor=0.1"}});
  const std::vector<KeyDifference> found = differences(all);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].key, "effects.damping");
  EXPECT_EQ(labels(all, found), (Labels{"no damping", "damping"}));
  const auto both = scenes(folder, {{"effects.damping.factor=0.2"}, {"effects.damping.factor=0.1"}});
  EXPECT_EQ(labels(both, differences(both)), (Labels{"damping.factor = 0.2", "damping.factor = 0.1"}));
}

TEST(Differences, KeepTheNameOfEachOfSeveralCloths) {
  const test::SceneFolder folder;
  const std::string cloth = "[[cloth]]\nmesh = { grid = [2, 2] }\nstiffness = 10\nname = ";
  const std::string both = cloth + "\"a\"\n" + cloth + "\"b\"\n[time]\nstep = 0.01\n";
  const auto labels_of = [&](const std::string& text, const std::string& key) {
    const std::vector<LoadedScene> all{folder.load(text, {key + "=1"}), folder.load(text, {key + "=2"})};
    return labels(all, differences(all));
  };
  EXPECT_EQ(labels_of(both, "cloth.b.mass"), (Labels{"b.mass = 1", "b.mass = 2"}));
  EXPECT_EQ(labels_of(both, "cloth.a.transform.scale"), (Labels{"a.transform.scale = 1", "a.transform.scale = 2"}));
  EXPECT_EQ(labels_of(least_scene, "cloth.mass"), (Labels{"mass = 1", "mass = 2"}));
  EXPECT_EQ(labels_of(least_scene, "cloth.transform.scale"), (Labels{"scale = 1", "scale = 2"}));
}

TEST(Differences, WhatThingsLookLikeNeedsNoLabel) {
  const test::SceneFolder folder;
  const auto all = scenes(folder, {{}, {"look.mesh_lines=true"}});
  const std::vector<KeyDifference> found = differences(all);
  EXPECT_EQ(found.size(), 1U);
  EXPECT_EQ(labels(all, found), (Labels{"scene", "scene"}));
}

TEST(Differences, FilesTellScenesOfOneNameApart) {
  const test::SceneFolder folder;
  std::vector<LoadedScene> all = scenes(folder, {{}, {}});
  const auto labels_of = [&](const char* first, const char* second) {
    all[0].source.file = first;
    all[1].source.file = second;
    return labels(all, differences(all));
  };
  EXPECT_EQ(labels_of("scene.toml", "scene.drape"), (Labels{"scene.toml", "scene.drape"}));
  EXPECT_EQ(labels_of("old/scene.drape", "new/scene.drape"), (Labels{"old/scene.drape", "new/scene.drape"}));
}

}  // namespace
}  // namespace drape::compare_differences
