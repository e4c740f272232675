// Messages about a scene's errors: their order, places and files.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "tests/support/scene_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::scene_messages {
namespace {

using test::least_scene;
using test::SceneFolder;
using test::usage_error;
using test::with;

TEST(SceneMessages, AllOfThemAreReportedInTheOrderOfTheFile) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems("[video]\n"
                            "size = [480]\n"
                            "[effects.gravity]\n"
                            "acceleration = 9.8\n"
                            "[clot]\n"
                            "[cloth]\n"
                            "pins = [9, \"corner:w\"]\n"
                            "mesh = { grid = [0, 2] }\n"
                            "[effects.damping]\n"
                            "factor = 2\n",
                            {"time.stp=3", "cloth.mass=0"}),
            "scene.toml:2:8: size: expected an array of 2 whole numbers, found one of 1\n"
            "scene.toml:4:16: acceleration: expected an array of 3 numbers, found a number\n"
            "scene.toml:5:2: unknown table 'clot'; did you mean 'cloth'?\n"
            "scene.toml:6:1: missing key 'stiffness', 'modulus' or 'material' in [cloth]\n"
            "scene.toml:7:12: pins[1]: expected a corner like 'corner:x-y-', an edge like 'edge:x-' or 'border', found "
            "'corner:w'\n"
            "scene.toml:8:18: mesh.grid[0] must be at least 1, found 0\n"
            "scene.toml:10:10: factor must be above 0 and at most 1, found 2\n"
            "--set time.stp=3: unknown key 'stp' in [time]; did you mean 'step'?\n"
            "--set cloth.mass=0: mass must be above 0, found 0");
}

TEST(SceneMessages, AClothSaysItsMassAndItsStiffnessOnce) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems("[cloth]\nmesh = { grid = [2, 2] }\nmass = 1\ndensity = 1\nmodulus = 9\nstiffness = 9\n"),
            "scene.toml:4:11: density: 'mass' already sets it; give only one of them\n"
            "scene.toml:5:11: modulus: 'stiffness' already sets it; give only one of them");
  EXPECT_EQ(folder.problems("[cloth]\nmesh = { grid = [2, 2] }\nmaterial = \"denym\"\n"),
            "scene.toml:3:12: unknown material 'denym'; did you mean 'denim'?");
  EXPECT_EQ(folder.problems("[cloth]\nmesh = { grid = [2, 2] }\nmaterial = \"denim\"\n"), "(no error)");
}

TEST(SceneMessages, AFormulaIsNamedWithItsPlace) {
  const SceneFolder folder;
  const std::string field = "[effects.field]\nacceleration = ";
  EXPECT_EQ(folder.problems(least_scene + field + "[\"-x\", \"yy\", 1]\n"),
            "scene.toml:7:23: acceleration[1]: 'yy': unknown name 'yy' at its character 1; did you mean 'vy'?");
  EXPECT_EQ(folder.problems(least_scene + field + "[\"-x\", 0]\n"),
            "scene.toml:7:16: acceleration: expected an array of 3 formulas, found one of 2");
  EXPECT_EQ(folder.problems(least_scene + field + "[\"-x\", 0, true]\n"),
            "scene.toml:7:26: acceleration[2]: expected a formula or a number, found true or false");
  EXPECT_EQ(folder.problems(least_scene + field + "[\"sin\", 0, 1]\n"),
            "scene.toml:7:17: acceleration[0]: 'sin': 'sin' at its character 1 is a function: write what it is of in "
            "brackets, as in sin(x)");
}

TEST(SceneMessages, TheOrderDoesNotDependOnTheNumberOfDigitsOfALine) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems("[time]\nstep = 0\n\n\n\n\n\n\n\n[cloth]\nmesh = { grid = [1, 1] }\nstiffness = 0\n"),
            "scene.toml:2:8: step must be above 0, found 0\n"
            "scene.toml:12:13: stiffness must be above 0, found 0");
}

TEST(SceneMessages, ComparedFramesBeyondTheFilmAreNamed) {
  const SceneFolder folder;
  const std::string scene = least_scene + "duration = 0.4\n[video]\nfps = 25\n[check]\nframes = [0, 10";
  EXPECT_EQ(folder.problems(scene + "]\n"), "(no error)");
  EXPECT_EQ(folder.problems(scene + ", 99]\n"), "scene.toml:10:18: frames: the film ends with frame 10, found 99");
  EXPECT_EQ(folder.problems(scene + "]\n", {"check.frames=[11]"}),
            "--set check.frames=[11]: frames: the film ends with frame 10, found 11");
  // A film shortened by an override does not affect compared frames.
  EXPECT_EQ(folder.problems(scene + "]\n", {"time.duration=0.1"}), "(no error)");
  EXPECT_EQ(folder.problems(scene + "]\n", {"video.fps=5"}), "(no error)");
  EXPECT_EQ(folder.problems(scene + "]\n", {"time.duration=0.1", "check.frames=[0, 9]"}),
            "--set check.frames=[0, 9]: frames: the film ends with frame 2, found 9");
}

TEST(SceneMessages, ASyntaxErrorHasItsPlace) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems("[cloth]\nmesh = { grid = [2, 2 }\n").substr(0, 17), "scene.toml:2:23: ");
  EXPECT_EQ(folder.problems("[cloth]\nmass = 1\nmass = 2\n"),
            "scene.toml:3:8: Error while parsing key-value pair: cannot redefine existing integer 'mass'");
  EXPECT_EQ(folder.problems("[cloth]\nmass = \xff\n"), "scene.toml:2:7: Encountered invalid utf-8 sequence");
}

TEST(SceneMessages, PlacesCountCharactersAndLinesOfAnyEnding) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems("\xef\xbb\xbf[cloth]\r\nmesh = { grid = [2, 2] }\r\nstiffness = 10 # größer als 0 €\r\n"
                            "\"größe\" = 1\r\n"),
            "scene.toml:4:1: unknown key 'größe' in [cloth]; the keys are 'name', 'mesh', 'rest', 'mass', 'density', "
            "'stiffness', 'modulus', 'warp', 'material', 'spring', 'shear_stiffness', 'bend_stiffness', 'pins', "
            "'velocity', 'color', 'texture', 'transform'");
  EXPECT_EQ(folder.problems(with("cloth", "transform.\"größe\" = 1")).substr(0, 16), "scene.toml:5:11:");
  EXPECT_EQ(folder.problems(with("look", "texture = \"tüch.png\" \nsamples = 3")).substr(0, 16), "scene.toml:5:11:");
}

TEST(SceneMessages, AFolderAndAMissingFileAreNoScenes) {
  const SceneFolder folder;
  const auto load = [](const std::filesystem::path& file) { return usage_error([&] { load_scene(file); }); };
  EXPECT_EQ(folder.without_folder(load(folder.path() / "none.toml")), "none.toml: no such file");
  EXPECT_EQ(load(folder.path()), folder.path().string() + ": this is a folder, not a file");
}

TEST(SceneMessages, OfManyTheFirstHundredAreTold) {
  const SceneFolder folder;
  std::string keys, pins;
  for (int i = 0; i < 1000; ++i) {
    keys += "key" + std::to_string(i) + " = 1\n";
    pins += std::to_string(i + 9) + ",";
  }
  for (const std::string& lines : {keys, "pins = [" + pins + "]\n"}) {
    const std::string message = folder.problems(with("cloth", lines));
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 100);
    EXPECT_TRUE(message.ends_with("\nand 900 more")) << message;
  }
}

TEST(SceneMessages, AZeroDoesNotEndTheMessages) {
  const SceneFolder folder;
  const std::string color = "color = \"a\\u0000\\u001b[31m\"\nsamples = 9";
  const std::string message = folder.problems(with("look", color));
  EXPECT_NE(message.find("unknown colour 'a\\x00\\x1b[31m'; "), std::string::npos) << message;
  EXPECT_NE(message.find("\nscene.toml:6:11: samples must be at least 1 and at most 4, found 9"), std::string::npos);
  const std::string texture = folder.problems(with("look", "texture = \"plaid.png\\u0000\""));
  EXPECT_TRUE(texture.starts_with("scene.toml:5:11: texture: no such file: neither plaid.png\\x00 nor ")) << texture;
}

TEST(SceneMessages, ASceneIsATextInUtf8) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(std::string("\xff\xfe[\0c\0", 6)),
            "scene.toml: the file is text in UTF-16: save it as UTF-8");
  EXPECT_EQ(usage_error([] { load_scene("/dev/zero"); }), "/dev/zero: this is a device or socket, not a file");
}

}  // namespace
}  // namespace drape::scene_messages
