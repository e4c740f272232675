#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "tests/support/scene_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::scene_errors {
namespace {

using test::least_scene;
using test::SceneFolder;
using test::usage_error;
using test::with;

TEST(SceneErrors, TheLeastSceneLoads) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(least_scene), "(no error)");
}

TEST(SceneErrors, AnEmptyFileLacksTheCloth) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(""), "scene.toml:1:1: missing table [cloth]");
}

TEST(SceneErrors, AClothNeedsAMeshAndAStiffness) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems("\n  [cloth]\n"),
            "scene.toml:2:3: missing key 'mesh' in [cloth]\n"
            "scene.toml:2:3: missing key 'stiffness', 'modulus' or 'material' in [cloth]");
}

TEST(SceneErrors, AnUnknownKeyNamesTheNearest) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("cloth", "  stifness = 3")),
            "scene.toml:5:3: unknown key 'stifness' in [cloth]; did you mean 'stiffness'?");
  EXPECT_EQ(folder.problems(with("camera", "Field-Of-View = 3")),
            "scene.toml:5:1: unknown key 'Field-Of-View' in [camera]; did you mean 'field_of_view'?");
  EXPECT_EQ(folder.problems(with("cloth", "tranform = { scale = 2 }")),
            "scene.toml:5:1: unknown key 'tranform' in [cloth]; did you mean 'transform'?");
  EXPECT_EQ(folder.problems(with("effects.sphere", "center = [0, 0, 0]\nradius = 1\nradios = 2")),
            "scene.toml:7:1: unknown key 'radios' in [effects.sphere]; did you mean 'radius'?");
}

TEST(SceneErrors, AnUnknownKeyThatResemblesNoneGetsTheList) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("video", "resolution = 3")),
            "scene.toml:5:1: unknown key 'resolution' in [video]; the keys are 'fps', 'speed', 'size'");
}

TEST(SceneErrors, AKeyOfAnotherTableIsSentThere) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("integrator", "step = 0.01")),
            "scene.toml:5:1: unknown key 'step' in [integrator]; it belongs in [time]");
  EXPECT_EQ(folder.problems("mass = 2\n" + least_scene), "scene.toml:1:1: 'mass' belongs in [cloth]");
}

TEST(SceneErrors, AnUnknownTableNamesTheNearest) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("effect.gravity", "")),
            "scene.toml:4:2: unknown table 'effect'; did you mean 'effects'?");
  EXPECT_EQ(folder.problems(with("renderer", "")),
            "scene.toml:4:2: unknown table 'renderer'; the tables are 'cloth', 'seam', 'time', 'integrator', 'camera', "
            "'look', "
            "'video', 'caption', 'overlay', 'check', 'effects'");
}

TEST(SceneErrors, AnUnknownEffectNamesTheNearest) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("effects.gravty", "acceleration = [0, 0, 1]")),
            "scene.toml:4:10: unknown effect 'gravty'; did you mean 'gravity'?");
}

TEST(SceneErrors, AnUnknownChoiceNamesTheNearest) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("integrator", "method = \"implict\"")),
            "scene.toml:5:10: unknown method 'implict'; did you mean 'implicit'?");
  EXPECT_EQ(folder.problems(with("integrator", "method = \"verlett\"")),
            "scene.toml:5:10: unknown method 'verlett'; did you mean 'verlet'?");
  EXPECT_EQ(folder.problems(with("integrator", "scheme = \"sdirk\"")),
            "scene.toml:5:10: unknown scheme 'sdirk'; did you mean 'sdirk2'?");
  EXPECT_EQ(folder.problems(with("integrator", "method = \"verlet\"\nscheme = \"sdirk2\"")),
            "scene.toml:6:10: scheme: it applies to implicit methods, and verlet is a scheme of its own: omit it, or "
            "use method = \"implicit\", \"liu13\" or \"quasi-newton\"");
  EXPECT_EQ(folder.problems(with("integrator", "stop = \"never\"")),
            "scene.toml:5:8: unknown stop 'never'; the choices are 'change', 'gradient', 'error'");
}

TEST(SceneErrors, AMethodThatSolvesNothingHasNoErrorToStopAt) {
  const SceneFolder folder;
  const std::string problem = folder.problems(with("integrator", "method = \"semi-implicit\"\nstop = \"error\""));
  EXPECT_EQ(problem.substr(0, 39), "scene.toml:6:8: stop: semi-implicit com") << problem;
  EXPECT_NE(problem.find("use an implicit method"), std::string::npos) << problem;
  EXPECT_EQ(folder.problems(with("integrator", "method = \"semi-implicit\"")), "(no error)");
  EXPECT_EQ(folder.problems(with("integrator", "stop = \"error\"")), "(no error)");
}

TEST(SceneErrors, EveryKindOfValueIsChecked) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("cloth", "mass = \"heavy\"")),
            "scene.toml:5:8: mass: expected a number, found a string");
  EXPECT_EQ(folder.problems(with("cloth", "mass = true")),
            "scene.toml:5:8: mass: expected a number, found true or false");
  EXPECT_EQ(folder.problems(with("cloth", "mass = 2026-01-02")),
            "scene.toml:5:8: mass: expected a number, found a date or time");
  EXPECT_EQ(folder.problems(with("cloth", "mass = { kg = 2 }")),
            "scene.toml:5:8: mass: expected a number, found a table");
  EXPECT_EQ(folder.problems(with("integrator", "max_iterations = 3.0")),
            "scene.toml:5:18: max_iterations: expected a whole number, found a number");
  EXPECT_EQ(folder.problems(with("integrator", "method = 2")),
            "scene.toml:5:10: method: expected a string, found a whole number");
  EXPECT_EQ(folder.problems(with("look", "mesh_lines = 1")),
            "scene.toml:5:14: mesh_lines: expected true or false, found a whole number");
  EXPECT_EQ(folder.problems(with("camera", "position = 3")),
            "scene.toml:5:12: position: expected an array of 3 numbers, found a whole number");
  EXPECT_EQ(folder.problems(with("camera", "position = [1, 2]")),
            "scene.toml:5:12: position: expected an array of 3 numbers, found one of 2");
  EXPECT_EQ(folder.problems(with("camera", "position = [1, \"2\", 3]")),
            "scene.toml:5:16: position[1]: expected a number, found a string");
  EXPECT_EQ(folder.problems(with("video", "size = [480.5, 400]")),
            "scene.toml:5:9: size[0]: expected a whole number, found a number");
  EXPECT_EQ(folder.problems("cloth = 3\n"), "scene.toml:1:9: expected a table [cloth], found a whole number");
  EXPECT_EQ(folder.problems("effects = 3\n" + least_scene),
            "scene.toml:1:11: effects: expected tables like [effects.gravity], found a whole number");
}

TEST(SceneErrors, WholeNumbersAreNumbers) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("cloth", "mass = 2\nvelocity = [1, 2, 0x10]")), "(no error)");
}

TEST(SceneErrors, NumbersHaveTheirRange) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("cloth", "mass = -3")), "scene.toml:5:8: mass must be above 0, found -3");
  EXPECT_EQ(folder.problems(with("time", "step = 0.0")), "scene.toml:5:8: step must be above 0, found 0");
  EXPECT_EQ(folder.problems(with("time", "duration = -0.5")),
            "scene.toml:5:12: duration must be at least 0, found -0.5");
  EXPECT_EQ(folder.problems(with("video", "fps = 1001")),
            "scene.toml:5:7: fps must be above 0 and at most 1000, found 1001");
  EXPECT_EQ(folder.problems(with("video", "size = [15, 8193]")),
            "scene.toml:5:9: size[0] must be at least 16 and at most 8192, found 15\n"
            "scene.toml:5:13: size[1] must be at least 16 and at most 8192, found 8193");
  EXPECT_EQ(folder.problems(with("video", "size = [16, 8192]")), "(no error)");
  EXPECT_EQ(folder.problems(with("integrator", "max_iterations = 0")),
            "scene.toml:5:18: max_iterations must be at least 1, found 0");
  EXPECT_EQ(folder.problems(with("integrator", "max_iterations = 3000000000")),
            "scene.toml:5:18: max_iterations must be at least 1 and at most 2147483647, found 3000000000");
  EXPECT_EQ(folder.problems(with("integrator", "tolerance = 0")),
            "scene.toml:5:13: tolerance must be above 0, found 0");
  EXPECT_EQ(folder.problems(with("look", "samples = 3")), "scene.toml:5:11: samples must be 1, 2 or 4, found 3");
}

TEST(SceneErrors, AnAccuracyIsANumberAboveZeroAndStandsAlone) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("time", "accuracy = 0")), "scene.toml:5:12: accuracy must be above 0, found 0");
  EXPECT_EQ(folder.problems(with("time", "accuracy = -1e-3")),
            "scene.toml:5:12: accuracy must be above 0, found -0.001");
  const std::string asked = with("time", "accuracy = 1e-30");
  EXPECT_EQ(folder.problems(asked), "(no error)");
  for (const std::string value : {"tolerance = 1e-3", "stop = \"error\""}) {
    const std::string key = value.substr(0, value.find(' '));
    EXPECT_EQ(folder.problems(asked + "\n[integrator]\nmax_iterations = 30\n" + value + "\n"),
              "scene.toml:9:" + std::to_string(value.find('=') + 3) + ": " + key +
                  ": an accuracy in [time] already determines when a step is solved well enough: omit one of the two");
  }
}

// Explicit substeps of a required accuracy are velocity Verlet's, which all records then name.
TEST(SceneErrors, AnAccuracyIsReachedWithVerletInsteadOfSemiImplicitEuler) {
  const SceneFolder folder;
  const std::string method = "\n[integrator]\nmethod = \"semi-implicit\"\n";
  const LoadedScene asked = folder.load(with("time", "accuracy = 1e-3") + method);
  ASSERT_EQ(asked.source.warnings.size(), 1U);
  EXPECT_TRUE(asked.source.warnings[0].ends_with(
      "scene.toml:8:10: method: an accuracy in [time] is reached with \"verlet\", not with \"semi-implicit\""))
      << asked.source.warnings[0];
  EXPECT_EQ(asked.simulation.integrator.method, Method::verlet);

  const LoadedScene steps = folder.load(with("time", "step = 1e-3") + method);
  EXPECT_TRUE(steps.source.warnings.empty());
  EXPECT_EQ(steps.simulation.integrator.method, Method::semi_implicit);
}

TEST(SceneErrors, NoNumberIsNanOrInfinite) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("cloth", "mass = nan")), "scene.toml:5:8: mass must be finite, found nan");
  EXPECT_EQ(folder.problems(with("cloth", "mass = inf")), "scene.toml:5:8: mass must be finite, found inf");
  EXPECT_EQ(folder.problems(with("effects.gravity", "acceleration = [0, -inf, 0]")),
            "scene.toml:5:20: acceleration[1] must be finite, found -inf");
  EXPECT_EQ(folder.problems(with("cloth", "transform.scale = nan")),
            "scene.toml:5:19: scale must be finite, found nan");
  EXPECT_EQ(folder.problems(with("cloth", "pins = [{ box = [[0, 0, nan], [1, 1, 1]] }]")),
            "scene.toml:5:25: pins[0].box[0][2] must be finite, found nan");
  EXPECT_EQ(folder.problems(with("cloth", "transform = { rotate = [0, 0, 45], scale = 1.7e308 }")),
            "scene.toml:5:13: transform: positions are no longer finite");
}

TEST(SceneErrors, ColoursAreHexadecimalOrNamed) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("look", "color = \"#d9a62\"")),
            "scene.toml:5:9: color: expected a colour like '#d4a017' or '#fff', found '#d9a62'");
  EXPECT_EQ(folder.problems(with("look", "color = \"#-12345\"")),
            "scene.toml:5:9: color: expected a colour like '#d4a017' or '#fff', found '#-12345'");
  EXPECT_EQ(folder.problems(with("look", "color = \"marron\"")),
            "scene.toml:5:9: color: unknown colour 'marron'; did you mean 'maroon'?");
  EXPECT_EQ(folder.problems(with("look", "background_top = [255, 0, 0]")),
            "scene.toml:5:18: background_top: expected a string, found an array");

  const Scene scene = folder.load(with("look", "color = \"#0F8\"\nsphere_color = \"teal\"\nline_color = \"#ff0080\""));
  EXPECT_EQ(scene.look.color, (Rgb{0, 1, 136.0 / 255}));
  EXPECT_EQ(scene.look.sphere_color, (Rgb{0, 128.0 / 255, 128.0 / 255}));
  EXPECT_EQ(scene.look.line_color, (Rgb{1, 0, 128.0 / 255}));
}

TEST(SceneErrors, ATextureMustExistAndTheMeshMustTakeIt) {
  const SceneFolder folder;
  const std::string missing = folder.problems(with("look", "texture = \"plad.png\""));
  EXPECT_EQ(missing.substr(0, missing.find(" nor ")), "scene.toml:5:11: texture: no such file: neither plad.png");

  folder.write("pictures/mine.png", "");
  EXPECT_EQ(folder.problems(with("look", "texture = \"pictures\"")),
            "scene.toml:5:11: texture: expected a file, but pictures is a folder");
  EXPECT_EQ(folder.load(with("look", "texture = \"pictures/mine.png\"")).look.texture,
            folder.path() / "pictures/mine.png");
  EXPECT_TRUE(folder.load(with("look", "texture = \"\"")).look.texture.empty());

  folder.write("plain.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(folder.problems("[cloth]\nmesh = \"plain.obj\"\nstiffness = 1\n[look]\ntexture = \"pictures/mine.png\"\n"),
            "scene.toml:5:11: texture: the mesh has no texture coordinates");
}

TEST(SceneErrors, ATextureThatIsNotBesideTheSceneComesWithDrape) {
  const SceneFolder folder;
  EXPECT_EQ(folder.load(with("look", "texture = \"plaid.png\"")).look.texture,
            data_folder() / "textures" / "plaid.png");
}

TEST(SceneErrors, AFilmMustEnd) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("time", "duration = 1e300")),
            "scene.toml:5:12: duration: 1e+300 s in steps of 0.01 s are 1e+302 steps; the limit is 1e+09");
  EXPECT_EQ(folder.problems(with("video", "speed = 1e-300")),
            "scene.toml:4:1: the film would have 1.25e+302 frames; the limit is 1e+07");
  EXPECT_EQ(folder.problems(with("time", "step = 1e-320")),
            "scene.toml:4:1: duration: 5 s in steps of 9.99989e-321 s are inf steps; the limit is 1e+09");
  EXPECT_EQ(folder.problems(with("time", "step = 5e-9")), "(no error)");
}

TEST(SceneErrors, ACameraLooksSomewhere) {
  const SceneFolder folder;
  EXPECT_EQ(folder.problems(with("camera", "up = [0, 0, 0]")),
            "scene.toml:5:6: up: expected a direction, found [0, 0, 0]");
  EXPECT_EQ(folder.problems(with("camera", "position = [1, 2, 3]\ntarget = [1, 2, 3]")),
            "scene.toml:6:10: target: the camera's position and target are the same point");
}

TEST(SceneErrors, OnlySomeTablesMayBeGivenSeveralTimes) {
  const SceneFolder folder;
  const std::string sphere = "[[effects.sphere]]\ncenter = [0, 0, 1]\nradius = 1\n";
  EXPECT_EQ(folder.load(least_scene + sphere + sphere).simulation.effects.size(), 2U);
  EXPECT_EQ(folder.problems(least_scene + sphere + "[[effects.sphere]]\nradius = 0\n"),
            "scene.toml:9:1: missing key 'center', 'keyframes' or 'track' in [effects.sphere]\n"
            "scene.toml:10:10: radius must be above 0, found 0");
  EXPECT_EQ(folder.problems(least_scene + "[[effects.damping]]\nfactor = 0.5\n"),
            "scene.toml:6:1: [effects.damping] can only be given once, found an array");
  EXPECT_EQ(folder.problems(least_scene + "[[video]]\n"),
            "scene.toml:6:1: [video] can only be given once, found an array");
  EXPECT_EQ(folder.problems("effects.sphere = [1]\n" + least_scene),
            "scene.toml:1:19: expected a table [effects.sphere], found a whole number");
}

TEST(SceneErrors, EffectsCheckTheirValuesAgainstTheScene) {
  const SceneFolder folder;
  const std::string sphere = "[effects.sphere]\ncenter = [0, 0, 1]\nradius = 1\nstiffness = 160000\n";
  const std::vector<std::string> solved{"integrator.method=liu13"};
  const std::string problem = folder.problems(least_scene + sphere, solved);
  EXPECT_EQ(problem.substr(0, problem.find(" where")), "scene.toml:9:13: stiffness: a push is unstable");
  EXPECT_EQ(folder.problems(least_scene + sphere, {solved[0], "time.step=0.005"}), "(no error)");
  EXPECT_EQ(folder.problems(least_scene + sphere), "(no error)") << "shorter steps are chosen";
}

TEST(SceneErrors, NoRuleIsAskedOfAValueThatCouldNotBeRead) {
  const SceneFolder folder;
  const std::string sphere = "[effects.sphere]\ncenter = [0, 0, 1]\nradius = 1\nstiffness = 90000\n";
  EXPECT_EQ(folder.problems(least_scene + sphere, {"time.step=short"}),
            "--set time.step=short: step: expected a number, found a string");
}

}  // namespace
}  // namespace drape::scene_errors
