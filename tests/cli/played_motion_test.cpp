// Goldens of imported motions: drape bless, check, accept, compare and lint.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "drape/sim/mesh.hpp"
#include "tests/cli/run_drape.hpp"
#include "tests/support/files.hpp"
#include "tests/support/random.hpp"

namespace drape::played_motion {
namespace {

using test::drape;
using test::Finished;
using test::SceneFolder;

/// Returns a sheet of 8×8 cells that swings and falls, as OBJ; vertex i of the file is vertex order[i] of the sheet.
std::string falling(int frame, const std::vector<int>& order, double fault) {
  const Mesh grid = make_grid(8, 8);
  std::vector<int> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) number[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  std::string text;
  for (const int vertex : order) {
    Eigen::RowVector3d x = grid.positions.row(vertex);
    const double t = 0.02 * frame;
    x[2] += 0.1 * std::sin(3 * x[0] + 20 * t) - 4.9 * t * t + (vertex == 40 && frame >= 4 ? fault : 0);
    text += fmt::format("v {} {} {}\n", x[0], x[1], x[2]);
  }
  const auto of = [&](int vertex) { return number[static_cast<std::size_t>(vertex)] + 1; };
  for (const auto& [a, b, c] : grid.triangles) text += fmt::format("f {} {} {}\n", of(a), of(b), of(c));
  return text;
}

std::vector<int> as_they_are() {
  std::vector<int> order(81);
  std::iota(order.begin(), order.end(), 0);
  return order;
}

std::vector<int> shuffled() {
  std::vector<int> order = as_they_are();
  test::Random random(3);
  for (int i = 80; i > 0; --i)
    std::swap(order[static_cast<std::size_t>(i)], order[static_cast<std::size_t>(random.below(i + 1))]);
  return order;
}

void write_sequence(const SceneFolder& folder, const std::string& name, const std::vector<int>& order,
                    double fault = 0) {
  for (int frame = 0; frame < 10; ++frame) {
    folder.write(fmt::format("{}/{:02}.obj", name, frame), falling(frame, order, fault));
  }
}

const std::string scene =
    "[cloth]\nmotion = \"m/{frame:02}.obj\"\nfps = 50\n[look]\ncolor = \"navy\"\n[video]\nsize = [64, 48]\nfps = 25\n"
    "[check]\nmotion_tolerance = 1e-4\n";

TEST(PlayedMotion, IsGoldenUntilAVertexMoves) {
  const SceneFolder folder;
  write_sequence(folder, "m", as_they_are());
  folder.write("look.toml", scene);
  EXPECT_EQ(drape(folder, "bless look.toml").code, 0);
  const Finished same = drape(folder, "check look.toml");
  EXPECT_EQ(same.code, 0) << same.text;
  EXPECT_NE(same.text.find("motion same bits"), std::string::npos) << same.text;

  write_sequence(folder, "m", as_they_are(), 5e-5);
  const Finished within = drape(folder, "check look.toml");
  EXPECT_EQ(within.code, 0) << within.text;
  EXPECT_NE(within.text.find("within tolerance"), std::string::npos) << within.text;

  write_sequence(folder, "m", as_they_are(), 0.003);
  const Finished changed = drape(folder, "check look.toml");
  EXPECT_EQ(changed.code, 1) << changed.text;
  EXPECT_NE(changed.text.find("by 3 mm at vertex 40"), std::string::npos) << changed.text;
  const std::string page = test::content(folder.path("out/check/report.html"));
  EXPECT_NE(page.find("Turn the expected motion"), std::string::npos);
  EXPECT_NE(page.find("Turn the actual motion"), std::string::npos);
  EXPECT_EQ(drape(folder, "accept out/check").code, 0);
  EXPECT_EQ(drape(folder, "check look.toml").code, 0);
}

TEST(PlayedMotion, IsGoldenInEveryFrame) {
  const SceneFolder folder;
  write_sequence(folder, "m", as_they_are());
  folder.write("look.toml", scene);
  EXPECT_EQ(drape(folder, "bless look.toml").code, 0);
  for (int frame = 0; frame < 10; ++frame) {
    const std::string file = fmt::format("m/{:02}.obj", frame), before = test::content(folder.path(file));
    folder.write(file, "v -1 -1 0.3" + before.substr(before.find('\n')));
    const Finished changed = drape(folder, "check look.toml --update none");
    EXPECT_EQ(changed.code, 1) << frame << ": " << changed.text;
    EXPECT_NE(changed.text.find("at vertex 0"), std::string::npos) << changed.text;
    folder.write(file, before);
  }
  EXPECT_EQ(drape(folder, "check look.toml").code, 0);
}

TEST(PlayedMotion, NeedsNoScene) {
  const SceneFolder folder;
  write_sequence(folder, "m", as_they_are());
  EXPECT_EQ(drape(folder, "import 'm/{frame:02}.obj' --fps 50 -o motion.drape").code, 0);
  EXPECT_EQ(drape(folder, "bless motion.drape").code, 0);
  EXPECT_EQ(drape(folder, "check motion.drape").code, 0);
  write_sequence(folder, "m", as_they_are(), 0.003);
  EXPECT_EQ(drape(folder, "import 'm/{frame:02}.obj' --fps 50 -o motion.drape").code, 0);
  EXPECT_EQ(drape(folder, "check motion.drape").code, 1);
  EXPECT_EQ(drape(folder, "accept out/check").code, 0);
  EXPECT_EQ(drape(folder, "check motion.drape").code, 0);
}

TEST(PlayedMotion, IsMatchedByItsFirstFrameInAnotherOrder) {
  const SceneFolder folder;
  write_sequence(folder, "m", as_they_are());
  folder.write("look.toml", scene);
  EXPECT_EQ(drape(folder, "bless look.toml").code, 0);
  write_sequence(folder, "m", shuffled());
  const Finished other = drape(folder, "check look.toml");
  EXPECT_EQ(other.code, 0) << other.text;
  EXPECT_NE(test::content(folder.path("out/check/report.json")).find("matched by the first frame"), std::string::npos);
  write_sequence(folder, "m", shuffled(), 0.003);
  const Finished changed = drape(folder, "check look.toml");
  EXPECT_EQ(changed.code, 1);
  EXPECT_NE(changed.text.find("by 3 mm at vertex 40"), std::string::npos) << changed.text;

  write_sequence(folder, "a", as_they_are());
  const std::string films = " --set 'video.size=[64, 48]' --difference -o ab.html";
  const Finished compared = drape(folder, "compare 'a/{frame:02}.obj' 'm/{frame:02}.obj'" + films);
  EXPECT_EQ(compared.code, 0) << compared.text;
  EXPECT_NE(compared.text.find("matched by the first frame"), std::string::npos) << compared.text;
  EXPECT_NE(test::content(folder.path("ab.html")).find("at most 3 mm from the first"), std::string::npos);
}

TEST(PlayedMotion, HasASceneThatSaysWhatMeansNothing) {
  const SceneFolder folder;
  write_sequence(folder, "m", as_they_are());
  folder.write("look.toml", scene);
  EXPECT_EQ(drape(folder, "lint look.toml").code, 0);
  EXPECT_EQ(drape(folder, "render look.toml -o a.png").code, 0);
  const auto expect_refused = [&](const std::string& arguments, const std::string& message) {
    const Finished finished = drape(folder, arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_NE(finished.text.find(message), std::string::npos) << finished.text;
  };
  expect_refused("simulate look.toml", "nothing to simulate");
  expect_refused("render look.toml --set time.step=0.1 -o a.png", "[time]: the motion is read, not computed");
  expect_refused("sweep look.toml --vary look.color=red,blue", "plays a recorded motion");
  folder.write("bad.toml",
               "[cloth]\nmotion = \"m/{frame:02}.obj\"\nstiffness = 3\nfsp = 50\n[cloth.transform]\nscale = 2\n"
               "[time]\nstep = 0.01\n[effects.gravity]\n[camera]\nazimut = 3\n");
  const Finished bad = drape(folder, "render bad.toml -o a.png");
  EXPECT_EQ(bad.code, 2);
  for (const char* message :
       {"bad.toml:3:1: stiffness: the motion is read",
        "bad.toml:4:1: unknown key 'fsp' in [cloth]; did you mean 'fps'?", "bad.toml:5:8: transform",
        "bad.toml:7:2: [time]", "bad.toml:9:2: [effects]", "bad.toml:11:1: unknown key 'azimut' in [camera]"}) {
    EXPECT_NE(bad.text.find(message), std::string::npos) << message << "\n" << bad.text;
  }
}

TEST(PlayedMotion, ThatHasNotEveryStepCannotBeGolden) {
  const SceneFolder folder;
  folder.write("scene.toml", test::least_scene + "duration = 0.2\n[video]\nsize = [64, 48]\n");
  EXPECT_EQ(drape(folder, "simulate scene.toml --every 3 -o motion.drape").code, 0);
  const Finished refused = drape(folder, "bless motion.drape");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.text.find("a check needs all"), std::string::npos) << refused.text;
}

}  // namespace
}  // namespace drape::played_motion
