// [[cloth]] and [[seam]] of a scene.

#include <gtest/gtest.h>

#include <algorithm>

#include "drape/scene/scene.hpp"
#include "drape/sim/cloth.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

using test::SceneFolder;

const std::string two_cloths =
    "[[cloth]]\n"
    "name = \"table\"\n"
    "mesh = { grid = [4, 3] }\n"
    "material = \"cotton\"\n"
    "pins = [0]\n"
    "color = \"navy\"\n"
    "[[cloth]]\n"
    "name = \"napkin\"\n"
    "mesh = { grid = [2, 2] }\n"
    "stiffness = 50\n"
    "mass = 0.1\n"
    "pins = [\"corner:x+y+\"]\n"
    "velocity = [0, 0, -1]\n"
    "[cloth.transform]\n"
    "translate = [0, 0, 1]\n";

std::string sewn(const std::string& seam) {
  return "[[cloth]]\nname = \"a\"\nmesh = { grid = [4, 3] }\nstiffness = 9\n"
         "[[cloth]]\nname = \"b\"\nmesh = { grid = [2, 6] }\nstiffness = 9\ntransform = { translate = [2.5, 0, 0] }\n"
         "[[seam]]\n" +
         seam + "\n";
}

TEST(SceneCloths, AreJoinedInOrder) {
  const SceneFolder folder;
  const std::string material(fabrics().front().name);
  std::string text = two_cloths;
  text.replace(text.find("cotton"), 6, material);
  const Scene scene = folder.load(text);
  const Cloth& cloth = scene.simulation.cloth;
  ASSERT_EQ(cloth.pieces.size(), 2U);
  EXPECT_EQ(cloth.pieces[0].name, "table");
  EXPECT_EQ(cloth.pieces[1].first_vertex, 20);
  EXPECT_EQ(cloth.pieces[1].vertex_count, 9);
  EXPECT_EQ(cloth.pieces[1].first_triangle, 24);
  EXPECT_EQ(cloth.pins, (std::vector<int>{0, 28}));
  EXPECT_EQ(cloth.velocities(20, 2), -1);
  EXPECT_EQ(cloth.positions(20, 2), 1);
  EXPECT_EQ(cloth.positions(0, 2), 0);
  EXPECT_NEAR(cloth.masses.tail(9).sum(), 0.1, 1e-15);
  EXPECT_NEAR(cloth.masses.head(20).sum(), 4 * fabrics().front().density, 1e-12);
  ASSERT_EQ(scene.look.cloths.size(), 2U);
  EXPECT_EQ(scene.look.cloths[1].first_triangle, 24);
  EXPECT_NE(scene.look.cloths[0].color, scene.look.cloths[1].color);
  const auto bending = std::ranges::find(scene.simulation.effects, "bending", &Effect::name);
  ASSERT_NE(bending, scene.simulation.effects.end());
  EXPECT_EQ(bending->as<Bending>()->cloth, "table");
}

TEST(SceneCloths, OneInDoubleBracketsIsTheSameAsOneInSingle) {
  const SceneFolder folder;
  const std::string rest = "mesh = { grid = [4, 3] }\nstiffness = 9\npins = [0, 4]\n";
  const LoadedScene single = folder.load("[cloth]\n" + rest), in_array = folder.load("[[cloth]]\n" + rest);
  EXPECT_EQ(physics_hash(physics_values(single)), physics_hash(physics_values(in_array)));
  EXPECT_TRUE(single.simulation.cloth.pieces.empty());
}

TEST(SceneCloths, AreSetAndCaptionedByName) {
  const SceneFolder folder;
  std::string text = two_cloths;
  text.replace(text.find("material = \"cotton\""), 19, "stiffness = 10");
  const Scene scene = folder.load(text + "[caption]\ntext = \"{cloth.napkin.mass} {cloth.table.mass}\"\n",
                                  {"cloth.napkin.mass=0.5", "cloth.0.mass=2"});
  EXPECT_NEAR(scene.simulation.cloth.masses.tail(9).sum(), 0.5, 1e-15);
  EXPECT_NEAR(scene.simulation.cloth.masses.head(20).sum(), 2, 1e-14);
  std::string caption;
  for (const TextTemplate::Piece& piece : scene.caption.filled.pieces()) caption += piece.text;
  EXPECT_EQ(caption, "0.5 2");
}

TEST(SceneCloths, ThePortableSceneIsTheSame) {
  const SceneFolder folder;
  const LoadedScene scene =
      folder.load(sewn("a = { cloth = \"a\", along = [\"edge:x+\"] }\n"
                       "b = { cloth = \"b\", along = [\"edge:x-\"] }\ntime = 0.5"));
  const LoadedScene again = folder.load(scene.source.portable.text);
  EXPECT_EQ(physics_hash(physics_values(scene)), physics_hash(physics_values(again)));
  EXPECT_EQ(again.simulation.cloth.seams.size(), 1U);
}

TEST(SceneCloths, PinsThatMoveAreThoseOfTheNamedCloth) {
  const SceneFolder folder;
  std::string text = two_cloths;
  text.replace(text.find("material = \"cotton\""), 19, "stiffness = 10");
  const std::string pins = "[effects.moving_pins]\npins = [\"corner:x+y+\"]\nrelease = 1\n";
  const Scene scene = folder.load(text + pins + "cloth = \"napkin\"\n");
  EXPECT_EQ(scene.simulation.effects[0].as<MovingPins>()->pins, std::vector<int>{28});
  EXPECT_EQ(folder.problems(text + pins),
            "scene.toml:17:8: pins: there are several cloths: say which one with 'cloth'");
}

TEST(SceneCloths, WrongNamesAreOneMessageEach) {
  const SceneFolder folder;
  const std::string a = "[[cloth]]\nname = \"a\"\nmesh = { grid = [2, 2] }\nstiffness = 9\n";
  EXPECT_EQ(folder.problems(a + "[[cloth]]\nmesh = { grid = [2, 2] }\nstiffness = 9\n"),
            "scene.toml:5:1: name: each of several cloths needs one");
  EXPECT_EQ(folder.problems(a + a), "scene.toml:6:8: name: there are two cloths 'a'");
  EXPECT_EQ(folder.problems("cloth = []\n"), "scene.toml:1:9: cloth: expected at least one");
  EXPECT_EQ(folder.problems("[cloth]\nname = \"1 a\"\nmesh = { grid = [2, 2] }\nstiffness = 9\n"),
            "scene.toml:2:8: name: expected letters, digits, '_' and '-' after a letter, found '1 a'");
  EXPECT_EQ(folder.problems(a + "[effects.bending]\nrigidity = 1\ncloth = \"c\"\n"),
            "scene.toml:7:9: cloth: unknown cloth 'c'; did you mean 'a'?");
  EXPECT_EQ(
      folder.problems(a + "[[effects.bending]]\nrigidity = 1\n[[effects.bending]]\nrigidity = 1\ncloth = \"a\"\n"),
      "scene.toml:9:9: cloth: another table [effects.bending] already acts on 'a'");
  EXPECT_EQ(folder.problems(a + "[effects.self_collision]\ncontact = [[\"a\", \"b\", { friction = 1 }]]\n"),
            "scene.toml:6:11: contact: unknown cloth 'b'; did you mean 'a'?");
  EXPECT_EQ(folder.problems(a + "[effects.self_collision]\ncontact = [[\"a\", { friction = 1 }]]\n"),
            "scene.toml:6:12: contact: expected [\"cloth\", \"cloth\", { friction = number }]");
}

TEST(SceneSeams, TieTheFinerSideToTheCoarserByLength) {
  const SceneFolder folder;
  const Scene scene =
      folder.load(sewn("a = { cloth = \"a\", along = [\"edge:x+\"] }\n"
                       "b = { cloth = \"b\", along = [\"edge:x-\"] }\ntime = 0.5"));
  const Cloth& cloth = scene.simulation.cloth;
  ASSERT_EQ(cloth.seams.size(), 1U);
  const Seam& seam = cloth.seams[0];
  EXPECT_EQ(seam.time, 0.5);
  ASSERT_EQ(seam.ties.size(), 7U);  // the finer side's vertices
  for (const SeamTie& tie : seam.ties) {
    EXPECT_TRUE(cloth.pieces[1].has(tie.vertex));
    EXPECT_TRUE(cloth.pieces[0].has(tie.edge[0]));
    EXPECT_NEAR(tie.length, 0.5, 1e-15);  // straight across: same heights
  }
  EXPECT_EQ(seam.sides[0].size(), 4U);
  const Scene turned =
      folder.load(sewn("a = { cloth = \"a\", along = [\"edge:x+\"] }\n"
                       "b = { cloth = \"b\", along = [\"edge:x-\"] }\nreverse = true"));
  EXPECT_NEAR(turned.simulation.cloth.seams[0].ties[0].length, std::hypot(0.5, 2), 1e-14);
}

TEST(SceneSeams, WrongOnesAreOneMessageEach) {
  const SceneFolder folder;
  const std::string b = "b = { cloth = \"b\", along = [\"edge:x-\"] }\n";
  EXPECT_EQ(folder.problems(sewn(b + "a = { cloth = \"c\", along = [\"edge:x+\"] }")),
            "scene.toml:12:15: a: unknown cloth 'c'; did you mean 'a'?");
  EXPECT_EQ(folder.problems(sewn(b + "a = { cloth = \"a\" }")),
            "scene.toml:12:5: a: 'along' is missing, the vertices of the side");
  EXPECT_EQ(folder.problems(sewn(b + "a = { cloth = \"a\", along = \"edge:x+\" }")),
            "scene.toml:12:28: a.along: expected an array, found a string");
  EXPECT_EQ(folder.problems(sewn(b + "a = { cloth = \"a\", along = [\"border\"] }")),
            "scene.toml:12:28: a: expected vertices in one open row along edges, found 14 that are not");
  EXPECT_EQ(folder.problems(sewn(b + "a = { cloth = \"a\", along = [14, 19], time = 1 }")),
            "scene.toml:12:38: a: unknown key 'time'; the keys are 'cloth', 'along'");
  EXPECT_EQ(folder.problems(sewn(b + "a = { cloth = \"b\", along = [\"edge:x-\"] }")),
            "scene.toml:10:1: [seam]: both sides are the same vertices");
  EXPECT_EQ(folder.problems(sewn(b)), "scene.toml:10:1: missing key 'a' in [seam]");
  EXPECT_EQ(folder.problems(sewn(b + "a = { cloth = \"a\", along = [\"edge:x+\"] }\ntime = -1")),
            "scene.toml:13:8: time must be at least 0, found -1");
}

TEST(SceneSeams, AreCheckedBesideAFaultyCloth) {
  const SceneFolder folder;
  EXPECT_EQ(
      folder.problems("[cloth]\nmesh = { grid = [2, 0] }\nstiffness = 9\n[seam]\na = { alon = [], clot = \"a\" }\n"
                      "b = 3\n"),
      "scene.toml:2:21: mesh.grid[1] must be at least 1, found 0\n"
      "scene.toml:5:7: a: unknown key 'alon'; did you mean 'along'?\n"
      "scene.toml:5:18: a: unknown key 'clot'; did you mean 'cloth'?\n"
      "scene.toml:6:5: b: expected { cloth = …, along = […] }, found a whole number");
}

TEST(SceneSeams, SidesThatCannotMeetAreErrors) {
  const SceneFolder folder;
  const std::string a = "[[cloth]]\nname = \"a\"\nmesh = { grid = [2, 2] }\nstiffness = 9\npins = [\"edge:x+\"]\n";
  const std::string b =
      "[[cloth]]\nname = \"b\"\nmesh = { grid = [2, 2] }\nstiffness = 9\npins = [\"edge:x-\"]\n"
      "transform = { scale = 1, translate = [3, 0, 0] }\n";
  const std::string seam =
      "[seam]\na = { cloth = \"a\", along = [\"edge:x+\"] }\nb = { cloth = \"b\", along = [\"edge:x-\"] }\n";
  EXPECT_EQ(folder.problems(a + b + seam),
            "scene.toml:12:1: [seam]: it cannot close: vertex 2 and the point it is sewn to are pinned 1 m apart");
  std::string small = b;
  small.replace(small.find("scale = 1"), 9, "scale = 0.2");
  EXPECT_EQ(
      folder.problems(a + small + seam),
      "scene.toml:12:1: [seam]: it cannot close: its sides are 2 m and 0.4 m long; a seam gathers at most 4 times "
      "its length");
}

}  // namespace
}  // namespace drape
