// A draft has a coarser grid if the scene keeps its meaning on it. Pictures of all qualities look alike.

#include <fmt/format.h>
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

class ScaledPicture : public testing::Test {
 protected:
  /// @param size size of the picture
  [[nodiscard]] LoadedScene load(const std::string& size, int caption,
                                 const std::vector<std::string>& overrides) const {
    const std::string look = "[look]\nmesh_lines = true\nline_width = 3\n";
    return folder_.load(fmt::format("{}{}[video]\nsize = {}\n[caption]\ntext = \"a\"\nsize = {}\n", test::least_scene,
                                    look, size, caption),
                        overrides);
  }
  [[nodiscard]] Eigen::Vector2i size(const std::string& size, const std::string& quality) const {
    return load(size, 40, {"look.quality=" + quality}).video.size;
  }

  SceneFolder folder_;
};

TEST_F(ScaledPicture, HasACaptionAndMeshLinesOfItsScale) {
  const auto lengths = [&](const std::vector<std::string>& overrides) {
    const LoadedScene scene = load("[480, 400]", 40, overrides);
    return std::pair(*scene.caption.size, scene.look.line_width);
  };
  EXPECT_EQ(lengths({"look.quality=draft"}), std::pair(20, 1.5));
  EXPECT_EQ(lengths({"look.quality=film"}), std::pair(40, 3.0));
  EXPECT_EQ(lengths({"look.quality=print"}), std::pair(80, 6.0));
  EXPECT_EQ(lengths({"look.quality=draft", "video.size=[480, 400]"}), std::pair(40, 3.0));
  EXPECT_EQ(lengths({"look.quality=draft", "caption.size=30", "look.line_width=2"}), std::pair(30, 2.0));
}

TEST_F(ScaledPicture, KeepsItsShapeWithinTheLimits) {
  EXPECT_EQ(size("[101, 81]", "draft"), Eigen::Vector2i(50, 40));
  EXPECT_EQ(size("[24, 100]", "draft"), Eigen::Vector2i(16, 66));
  EXPECT_EQ(size("[16, 300]", "draft"), Eigen::Vector2i(16, 300));
  EXPECT_EQ(size("[5000, 20]", "print"), Eigen::Vector2i(8192, 32));
  EXPECT_EQ(size("[8192, 300]", "print"), Eigen::Vector2i(8192, 300));
  EXPECT_EQ(load("[480, 400]", 7, {"look.quality=draft"}).caption.size, 6);
  EXPECT_EQ(load("[480, 400]", 500, {"look.quality=print"}).caption.size, 512);
}

}  // namespace
}  // namespace drape
