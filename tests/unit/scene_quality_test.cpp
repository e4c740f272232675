// A draft has a coarser grid if the scene keeps its meaning on it.

#include <gtest/gtest.h>

#include "tests/support/scene_folder.hpp"

namespace drape {
namespace {

using test::SceneFolder;

class DraftGrid : public testing::Test {
 protected:
  /// Returns the number of vertices of a scene's cloth in draft quality.
  [[nodiscard]] Eigen::Index vertices(const std::string& mesh, const std::string& pins = "",
                                      std::vector<std::string> overrides = {}) const {
    overrides.insert(overrides.begin(), "look.quality=draft");
    const std::string cloth = "[cloth]\nmesh = " + mesh + "\nstiffness = 10\n" + pins;
    return folder_.load(cloth + "[time]\nstep = 0.01\n", overrides).simulation.cloth.vertex_count();
  }

  SceneFolder folder_;
};

TEST_F(DraftGrid, HasHalfTheColumnsAndRowsRoundedUp) {
  EXPECT_EQ(vertices("{ grid = [30, 21] }"), 16 * 12);
  EXPECT_EQ(vertices("{ grid = [21, 20], pattern = \"x\" }"), 12 * 11 + 11 * 10);
  EXPECT_EQ(vertices("{ grid = [30, 20] }", "pins = [\"corner:x-y+\", \"edge:x-\", \"border\"]\n"), 16 * 11);
}

TEST_F(DraftGrid, StaysWhereItIsCoarseOrItsVerticesAreChosenByNumberOrPlace) {
  EXPECT_EQ(vertices("{ grid = [20, 20] }"), 21 * 21);
  EXPECT_EQ(vertices("{ grid = [400, 1] }"), 401 * 2);
  EXPECT_EQ(vertices("{ grid = [30, 20] }", "pins = [0, \"corner:x+y+\"]\n"), 31 * 21);
  EXPECT_EQ(vertices("{ grid = [30, 20] }", "pins = [{ box = [[-1, -1, -1], [0, 1, 1]] }]\n"), 31 * 21);
  EXPECT_EQ(vertices("{ grid = [30, 20] }", "rest = { grid = [30, 20] }\n"), 31 * 21);
  EXPECT_EQ(vertices("{ grid = [2, 2] }", "", {"cloth.mesh.grid=[30, 20]"}), 31 * 21);
}

TEST_F(DraftGrid, IsOnlyADraftsAndThatOfAMotionAsItWas) {
  const std::string text = "[cloth]\nmesh = { grid = [30, 20] }\nstiffness = 10\n[time]\nstep = 0.01\n";
  EXPECT_EQ(folder_.load(text).simulation.cloth.vertex_count(), 31 * 21);
  EXPECT_EQ(folder_.load(text, {"look.quality=print"}).simulation.cloth.vertex_count(), 31 * 21);
  const auto file = folder_.write("a.toml", text);
  EXPECT_EQ(load_scene(file, {"look.quality=draft"}, Cells::as_written).simulation.cloth.vertex_count(), 31 * 21);
  EXPECT_EQ(load_scene(file, {"look.quality=print"}, Cells::of_draft).simulation.cloth.vertex_count(), 16 * 11);
}

}  // namespace
}  // namespace drape
