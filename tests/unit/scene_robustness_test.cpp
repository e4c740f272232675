#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

using test::least_scene;
using test::SceneFolder;

const std::string everything =
    "# every form once: größer\n"
    "[cloth]\n"
    "mesh = { grid = [2, 2] }\n"
    "rest = { grid = [2, 2] }\n"
    "mass = 1.5\n"
    "stiffness = 10\n"
    "pins = [0, \"corner:x+y-\", { box = [[-1, 1, 0], [1, 1, 0]] }]\n"
    "velocity = [0, 1e-3, 0]\n"
    "transform = { scale = [1, 2, 1], rotate = [10, 0, 0], translate = [0, 0, 1] }\n"
    "[time]\n"
    "step = 0.01\n"
    "duration = 1\n"
    "[integrator]\n"
    "method = \"implicit\"\n"
    "stop = \"gradient\"\n"
    "max_iterations = 7\n"
    "[effects.gravity]\n"
    "[[effects.sphere]]\n"
    "center = [0, 0, -0.5]\n"
    "radius = 0.4\n"
    "[look]\n"
    "color = \"#d9a621\"\n"
    "mesh_lines = true\n"
    "[video]\n"
    "size = [64, 48]\n";

/// Expects a scene to load or to be refused with a message; other exceptions fail the test.
void expect_loads_or_is_refused(const SceneFolder& folder, const std::string& text) {
  try {
    static_cast<void>(folder.load(text));
  } catch (const UsageError& error) {
    EXPECT_STRNE(error.what(), "") << text;
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what() << "\nfor\n" << text;
  }
}

TEST(SceneRobustness, AFileCutAnywhereLoadsOrIsRefused) {
  const SceneFolder folder;
  ASSERT_EQ(folder.problems(everything), "(no error)");
  for (std::size_t length = 0; length < everything.size(); ++length) {
    expect_loads_or_is_refused(folder, everything.substr(0, length));
  }
}

TEST(SceneRobustness, AFileWithAnyByteChangedLoadsOrIsRefused) {
  const SceneFolder folder;
  std::mt19937 random(1);
  const std::string bytes = std::string("[]{}=,.\"'#\n -+e0x9_a\\\xff\0", 23);
  for (std::size_t i = 0; i < everything.size(); ++i) {
    std::string text = everything;
    text[i] = bytes[random() % bytes.size()];
    expect_loads_or_is_refused(folder, text);
  }
}

TEST(SceneRobustness, AFileWithoutAnyOneLineLoadsOrIsRefused) {
  const SceneFolder folder;
  for (std::size_t begin = 0; begin < everything.size();) {
    const std::size_t end = everything.find('\n', begin) + 1;
    expect_loads_or_is_refused(folder, everything.substr(0, begin) + everything.substr(end));
    begin = end;
  }
}

TEST(SceneRobustness, DeepNestingIsRefused) {
  const SceneFolder folder;
  EXPECT_NE(folder.problems(least_scene + "[look]\ncolor = " + std::string(100000, '[')), "(no error)");
}

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

TEST(SceneRobustness, DeepKeysAreRefusedWithTheirPlace) {
  const SceneFolder folder;
  const std::string more = "expected a key of at most 16 names, found more", deep = repeated("a.", 200'000) + "b";
  EXPECT_EQ(folder.problems("[cloth]\n" + deep + " = 1\n"), "scene.toml:2:32: " + more);
  EXPECT_EQ(folder.problems("[" + deep + "]\n"), "scene.toml:1:33: " + more);
  EXPECT_EQ(folder.problems("[[" + deep + "]]\n"), "scene.toml:1:34: " + more);
  EXPECT_EQ(folder.problems("x = { y = [{ " + deep + " = 1 }] }\n"), "scene.toml:1:45: " + more);
  EXPECT_EQ(folder.problems(repeated("\"ö.=#\" . ", 17) + "b = 1\n"), "scene.toml:1:143: " + more);
  EXPECT_EQ(folder.problems(least_scene, {deep + "=1"}),
            "--set " + deep + "=1: expected names with dots between them before the '='");
  EXPECT_TRUE(folder.problems(least_scene, {"look={" + deep + "=1}"}).ends_with(more));
  EXPECT_EQ(folder.problems("x = " + repeated("{ a = [", 100'000)),
            "scene.toml:1:61: expected values nested at most 16 deep, found more");
}

TEST(SceneRobustness, DotsInTextAndCommentsAreNoKeys) {
  const SceneFolder folder;
  const std::string dots = repeated("a.", 100), more = "16 names";
  for (const std::string& text : {"# " + dots, "look.texture = \"\"  # " + dots, "look.texture = ''  # '" + dots,
                                  "[look] # \"\"\" " + dots, "video.size = [64, # " + dots + "\n 64.\n]"}) {
    EXPECT_EQ(folder.problems(least_scene + text + "\n").find(more), std::string::npos) << text;
  }
  for (const std::string quotes : {"\"", "'", "\"\"\"", "'''", "\"\"\"\"\"", "'''''"}) {
    const std::string value = "mesh = " + quotes + " #" + dots + quotes + " # " + dots + '\n';
    EXPECT_EQ(folder.problems("[cloth]\n" + value).find(more), std::string::npos) << value;
    EXPECT_NE(folder.problems("[cloth]\n" + value + dots + "b = 1").find(more), std::string::npos) << value;
  }
  EXPECT_EQ(folder.problems("mesh = \"\\\"" + dots + "\\\\\" # " + dots).find(more), std::string::npos);
}

TEST(SceneSteps, AreTheNearestWholeNumberToTheDuration) {
  Scene scene;
  const auto steps = [&scene](double duration, double step) {
    scene.duration = duration;
    scene.simulation.step = step;
    return scene.step_count();
  };
  EXPECT_EQ(steps(8.34, 0.02), 417);
  EXPECT_EQ(steps(8.334, 0.001), 8334);
  EXPECT_EQ(steps(0.3, 0.1), 3) << "0.3/0.1 is a little less than 3";
  EXPECT_EQ(steps(0, 0.1), 0);
  EXPECT_EQ(steps(1.4, 1), 1);
  EXPECT_EQ(steps(1.6, 1), 2);
  EXPECT_EQ(steps(1e9, 1), 1000000000);
}

TEST(DataFolder, IsTheSourceTreeUnlessAnotherIsNamed) {
  const SceneFolder folder;
  EXPECT_EQ(data_folder(), DRAPE_SOURCE_DIR);
  ASSERT_EQ(setenv("DRAPE_DATA", folder.path().c_str(), 1), 0);
  EXPECT_EQ(data_folder(), DRAPE_SOURCE_DIR) << "the environment is the command line's";
  ASSERT_EQ(unsetenv("DRAPE_DATA"), 0);
  use_data_folder(folder.path());
  EXPECT_EQ(data_folder(), folder.path());
  EXPECT_EQ(test::usage_error([&] { use_data_folder(folder.path() / "none"); }),
            "no such folder: " + (folder.path() / "none").string());
  EXPECT_EQ(data_folder(), folder.path()) << "it was refused";
  use_data_folder({});
  EXPECT_EQ(data_folder(), DRAPE_SOURCE_DIR);
}

}  // namespace
}  // namespace drape
