#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "tests/support/written_motion.hpp"

// Independent programs read the files. readers/ holds a script for each, which prints its findings:
//   f A B C       a triangle, before the first moment
//   t TIME        a time [s], followed by
//   v X Y Z       its vertices in order [m, z up]
//   s X Y Z R     its balls
// script/interop installs these programs and runs this; otherwise the test is skipped.

namespace drape::interop {
namespace {

struct Moment {
  double time = 0;
  std::vector<Eigen::RowVector3d> vertices;
  std::vector<Eigen::RowVector4d> balls;
};

struct Found {
  std::vector<Triangle> triangles;
  std::vector<Moment> moments;
};

/// Runs a reader, which must succeed, and parses its output.
Found read_by(const std::string& command) {
  Found found;
  std::string text;
  std::FILE* const output = ::popen((command + " 2>&1").c_str(), "r");
  if (output == nullptr) throw std::runtime_error("no shell");
  std::array<char, 4096> piece{};
  while (const std::size_t count = std::fread(piece.data(), 1, piece.size(), output)) text.append(piece.data(), count);
  const int status = ::pclose(output);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << command << "\n" << text;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.size() > 2 && line[1] == ' ' ? line.substr(1) : "");
    const auto number = [&] {
      std::string word;
      words >> word;
      return std::strtod(word.c_str(), nullptr);
    };
    if (line.starts_with("f ")) {
      Triangle triangle{};
      words >> triangle[0] >> triangle[1] >> triangle[2];
      found.triangles.push_back(triangle);
    } else if (line.starts_with("t ")) {
      found.moments.push_back({number(), {}, {}});
    } else if (line.starts_with("v ")) {
      const double x = number(), y = number(), z = number();
      found.moments.at(found.moments.size() - 1).vertices.emplace_back(x, y, z);
    } else if (line.starts_with("s ")) {
      const double x = number(), y = number(), z = number(), r = number();
      found.moments.at(found.moments.size() - 1).balls.emplace_back(x, y, z, r);
    }
  }
  return found;
}

/// An upright letter F, seen from −y, hanging from its upper left corner and hit by a ball from behind: any mirroring,
/// rotation, scaling or reordering is detected.
class Interop : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("DRAPE_INTEROP") == nullptr) GTEST_SKIP() << "script/interop installs the readers and runs this";
    folder_.write("F.obj",
                  "v 0 0 0\nv .2 0 0\nv .2 0 .4\nv .5 0 .4\nv .5 0 .6\nv .2 0 .6\nv .2 0 .8\nv .7 0 .8\nv .7 0 1\n"
                  "v 0 0 1\nv 0 0 .4\nv 0 0 .6\nv 0 0 .8\nvt 0 0\nvt .2 0\nvt .2 .4\nvt .5 .4\nvt .5 .6\nvt .2 .6\n"
                  "vt .2 .8\nvt .7 .8\nvt .7 1\nvt 0 1\nvt 0 .4\nvt 0 .6\nvt 0 .8\nf 1/1 2/2 3/3 11/11\n"
                  "f 11/11 3/3 6/6 12/12\nf 3/3 4/4 5/5 6/6\nf 12/12 6/6 7/7 13/13\nf 13/13 7/7 8/8 9/9 10/10\n");
    scene_ = folder_.load(
        "[cloth]\nmesh = \"F.obj\"\nstiffness = 50\npins = [9]\n[time]\nstep = 0.01\nduration = 0.4\n"
        "[video]\nfps = 20\n[effects.gravity]\n[effects.sphere]\ncenter = [0.3, 0.32, 0.3]\nradius = 0.25\n"
        "velocity = [0, -0.5, 0.125]\n[effects.ground]\nheight = -0.9\n");
  }

  test::WrittenMotion write(const std::vector<std::string>& outputs) const {
    std::vector<std::string> paths;
    for (const std::string& output : outputs) paths.push_back(folder_.path(output));
    test::WrittenMotion written = test::write_motion(scene_, paths);
    EXPECT_EQ(written.result.problems, std::vector<std::string>{});
    EXPECT_EQ(written.frames.size(), 9U);
    // The F turns: it is neither flat nor static, and no symmetry maps it onto itself.
    EXPECT_GT(written.frames.back().positions.col(1).cwiseAbs().maxCoeff(), 0.02);
    return written;
  }

  [[nodiscard]] static std::string reader(const std::string& name) {
    return std::string("'" DRAPE_SOURCE_DIR "/tests/interop/readers/") + name + "'";
  }

  [[nodiscard]] std::string quoted(const std::string& name) const { return " '" + folder_.path(name) + "'"; }

  /// @param precision precision of a number, relative to a metre
  void expect_same(const std::vector<Moment>& found, const std::vector<Frame>& frames, double precision) const {
    ASSERT_EQ(found.size(), frames.size());
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const Vertices& x = frames[k].positions;
      ASSERT_EQ(found[k].vertices.size(), static_cast<std::size_t>(x.rows())) << k;
      for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const double off = (found[k].vertices[static_cast<std::size_t>(i)] - x.row(i)).cwiseAbs().maxCoeff();
        EXPECT_LE(off, precision) << "vertex " << i << " of frame " << k;
      }
    }
  }

  void expect_same_balls(const std::vector<Moment>& found, const std::vector<Frame>& frames, double precision) const {
    for (std::size_t k = 0; k < frames.size(); ++k) {
      EXPECT_NEAR(found.at(k).time, frames[k].time, precision);
      const auto& sphere = std::get<SphereShape>(frames[k].colliders.at(0));
      ASSERT_EQ(found[k].balls.size(), 1U);
      EXPECT_LE((found[k].balls[0].head<3>() - sphere.center.transpose()).norm(), precision) << k;
      EXPECT_NEAR(found[k].balls[0][3], sphere.radius, precision);
    }
  }

  test::SceneFolder folder_;
  LoadedScene scene_;
};

constexpr double single_precision = 6e-8;

TEST_F(Interop, NumpyReadsTheArchiveToTheBit) {
  const test::WrittenMotion written = write({"x.npz"});
  const Found found = read_by("/usr/bin/python3 " + reader("read_npz.py") + quoted("x.npz"));
  EXPECT_EQ(found.triangles, scene_.simulation.cloth.triangles);
  expect_same(found.moments, written.frames, 0);
  expect_same_balls(found.moments, written.frames, 0);
}

TEST_F(Interop, VtkReadsTheCollectionToTheBit) {
  const test::WrittenMotion written = write({"x.pvd"});
  const Found found = read_by("/usr/bin/python3 " + reader("read_vtk.py") + quoted("x.pvd"));
  EXPECT_EQ(found.triangles, scene_.simulation.cloth.triangles);
  expect_same(found.moments, written.frames, 0);
  expect_same_balls(found.moments, written.frames, 1e-14);
}

TEST_F(Interop, ThreeAndTinyusdzReadTheStage) {
  const test::WrittenMotion written = write({"x.usda"});
  const Found found = read_by("node " + reader("read_usd.mjs") + " '" + std::getenv("DRAPE_INTEROP") +
                              "/node_modules'" + quoted("x.usda"));
  EXPECT_EQ(found.triangles, scene_.simulation.cloth.triangles);
  expect_same(found.moments, written.frames, single_precision);
  expect_same_balls(found.moments, written.frames, 1e-14);
}

TEST_F(Interop, KhronosValidatorAndThreeReadTheBinaryGltf) {
  const test::WrittenMotion written = write({"x.glb"});
  const Found found = read_by("node " + reader("read_glb.mjs") + " '" + std::getenv("DRAPE_INTEROP") +
                              "/node_modules'" + quoted("x.glb"));
  EXPECT_EQ(found.triangles.size(), scene_.simulation.cloth.triangles.size());
  expect_same(found.moments, written.frames, 3e-7);  // a displacement and its origin, each in single precision
  expect_same_balls(found.moments, written.frames, 1e-5);
}

TEST_F(Interop, BlenderShowsTheCacheOnItsMeshAndTheMeshes) {
  const test::WrittenMotion written = write({"x.pc2", "{frame}.ply", "{frame}.obj"});
  const std::size_t count = written.frames.size();
  std::string arguments = quoted("x.pc2") + " " + std::to_string(count);
  for (const std::string extension : {".ply", ".obj"}) {
    for (std::size_t k = 0; k < count; ++k) arguments += quoted(std::to_string(k) + extension);
  }
  const Found found = read_by("blender --background --factory-startup --python-exit-code 1 --python " +
                              reader("read_blender.py") + " --" + arguments);
  EXPECT_EQ(found.triangles, scene_.simulation.cloth.triangles);
  ASSERT_EQ(found.moments.size(), 3 * count);
  for (std::size_t form = 0; form < 3; ++form) {  // the cache, .ply, .obj
    const auto first = found.moments.begin() + static_cast<std::ptrdiff_t>(form * count);
    expect_same({first, first + static_cast<std::ptrdiff_t>(count)}, written.frames, single_precision);
  }
}

}  // namespace
}  // namespace drape::interop
