#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "scene/mesh_value.hpp"
#include "scene/usd/mesh.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::mesh_motion_file {
namespace {

using Eigen::RowVector3d;
using test::usage_error;

const std::string body_header = "#usda 1.0\n( metersPerUnit = 1\nupAxis = \"Z\"\ntimeCodesPerSecond = 10 )\n";
const std::string one_face = "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n";
const std::string three_points = "point3f[] points = [(0, 0, 0), (0, 0, 2), (0, 0, 4)]\n";

MeshMotion parse(const std::string& text) { return read_usd_mesh_motion(SourceText("body.usda", text)); }
std::string error_of(const std::string& text) {
  return usage_error([&] { parse(text); });
}
std::string mesh(const std::string& lines) { return "def Mesh \"m\" {\n" + one_face + lines + "}\n"; }

Vertices at(const MeshMotion& motion, double time) {
  Vertices x;
  motion.place(time, x);
  return x;
}

TEST(MeshMotionFile, HasNoSamplesWhereNothingMoves) {
  const MeshMotion still = parse(body_header + mesh(three_points));
  EXPECT_TRUE(still.samples.empty());
  EXPECT_EQ(still.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(at(still, 7).row(2), RowVector3d(0, 0, 4));
}

TEST(MeshMotionFile, MovesByTheSamplesOfItsPoints) {
  const MeshMotion motion =
      parse(body_header + mesh("point3f[] points.timeSamples = {\n10: [(0, 0, 0), (1, 0, 0), (0, 1, 8)],\n"
                               "0: [(0, 0, 0), (1, 0, 0), (0, 1, 0)] }\n"));
  EXPECT_EQ(motion.times, (std::vector<double>{0, 1}));
  EXPECT_EQ(motion.mesh.positions.row(2), RowVector3d(0, 1, 0));
  EXPECT_EQ(at(motion, 0.25).row(2), RowVector3d(0, 1, 2));
  EXPECT_EQ(at(motion, 9).row(2), RowVector3d(0, 1, 8));
}

// A parent turns by 90° within 8 time codes: without intermediate samples, points would cut the corner by 30 %.
TEST(MeshMotionFile, TurnsWithItsParentsWithoutShrinking) {
  const MeshMotion motion = parse(body_header +
                                  "def Xform \"turntable\" {\nfloat xformOp:rotateX.timeSamples = { 0: 0, 8: 90 }\n"
                                  "uniform token[] xformOpOrder = [\"xformOp:rotateX\"]\n" +
                                  mesh(three_points) + "}\n");
  EXPECT_EQ(motion.times.size(), 9U);
  EXPECT_TRUE(at(motion, 0.8).row(2).isApprox(RowVector3d(0, -4, 0)));
  for (const double time : {0.1, 0.35, 0.4, 0.79}) EXPECT_NEAR(at(motion, time).row(2).norm(), 4, 4 * 0.005) << time;
}

/// Returns an upper arm and a forearm along z, whose elbow at z = 2 turns about x by 90° from time code 0 to 8.
std::string arm(const std::string& skin, const std::string& animation, const std::string& of_skeleton = "") {
  return body_header + "def SkelRoot \"Arm\" {\ndef Skeleton \"Skel\" {\n" + of_skeleton +
         "uniform token[] joints = [\"Shoulder\", \"Shoulder/Elbow\"]\nuniform matrix4d[] bindTransforms = [\n"
         "((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1)), ((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,2,1))]\n"
         "uniform matrix4d[] restTransforms = [\n"
         "((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1)), ((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,2,1))]\n"
         "rel skel:animationSource = </Arm/Bend>\n}\n" +
         animation + mesh(three_points + "rel skel:skeleton = </Arm/Skel>\n" + skin) + "}\n";
}

const std::string elbow_motion =
    "def SkelAnimation \"Bend\" {\nuniform token[] joints = [\"Shoulder/Elbow\"]\nfloat3[] translations = [(0, 0, 2)]\n"
    "quatf[] rotations.timeSamples = { 0: [(1, 0, 0, 0)], 8: [(0.5, 0.5, 0, 0)] }\nhalf3[] scales = [(1, 1, 1)]\n}\n";
const std::string arm_skin =
    "int[] primvars:skel:jointIndices = [0, 1, 0, 1, 0, 1] ( interpolation = \"vertex\" elementSize = 2 )\n"
    "float[] primvars:skel:jointWeights = [1, 0, 0.5, 0.5, 0, 1] ( interpolation = \"vertex\" elementSize = 2 )\n";

// p' = Σ wⱼ Sⱼ Bⱼ⁻¹ p: the hand, 2 behind the elbow, moves to (0, −2, 2). A point shared by both bones moves half-way
// between both results, and stays in place if it is on the elbow's axis.
TEST(MeshMotionFile, BendsASkinnedMeshAsTheFormulaSays) {
  const MeshMotion motion = parse(arm(arm_skin, elbow_motion));
  EXPECT_EQ(motion.times.front(), 0);
  EXPECT_EQ(motion.times.back(), 0.8);
  const Vertices bound = at(motion, 0), bent = at(motion, 0.8);
  EXPECT_TRUE(bound.row(2).isApprox(RowVector3d(0, 0, 4)));
  EXPECT_EQ(bent.row(0), RowVector3d(0, 0, 0));
  EXPECT_TRUE(bent.row(1).isApprox(RowVector3d(0, 0, 2)));
  EXPECT_TRUE(bent.row(2).isApprox(RowVector3d(0, -2, 2)));
  const double half = std::numbers::pi / 4;
  EXPECT_TRUE(at(motion, 0.4).row(2).isApprox(RowVector3d(0, -2 * std::sin(half), 2 + 2 * std::cos(half)), 1e-12))
      << "quaternions turn steadily";

  std::string shared = arm_skin;
  shared.replace(shared.find("[1, 0, 0.5, 0.5, 0, 1]"), 22, "[1, 0, 0.5, 0.5, 3, 3]");
  EXPECT_TRUE(at(parse(arm(shared, elbow_motion)), 0.8).row(2).isApprox(RowVector3d(0, -1, 3))) << "weights of any sum";
}

// UsdSkel binds in the skeleton's space: transforms of the skeleton move the mesh, and the mesh's own do not.
TEST(MeshMotionFile, CarriesTheSkinWithTheSkeleton) {
  const std::string raised =
      "double3 xformOp:translate.timeSamples = { 8: (0, 0, 10) }\nuniform token[] xformOpOrder = "
      "[\"xformOp:translate\"]\n";
  const std::string elsewhere =
      "double3 xformOp:translate = (99, 0, 0)\nuniform token[] xformOpOrder = [\"xformOp:translate\"]\n"
      "matrix4d primvars:skel:geomBindTransform = ((1,0,0,0),(0,1,0,0),(0,0,1,0),(3,0,0,1))\n";
  const Vertices bent = at(parse(arm(arm_skin + elsewhere, elbow_motion, raised)), 0.8);
  EXPECT_TRUE(bent.row(0).isApprox(RowVector3d(3, 0, 10)));
  EXPECT_TRUE(bent.row(2).isApprox(RowVector3d(3, -2, 12)));
}

// A mesh may have its own list of joints; unanimated joints rest, and points without a joint stay.
TEST(MeshMotionFile, TakesTheMeshsOwnListOfJoints) {
  const std::string own =
      "uniform token[] skel:joints = [\"Shoulder/Elbow\"]\n"
      "int[] primvars:skel:jointIndices = [0, 0, 0] ( interpolation = \"vertex\" )\n"
      "float[] primvars:skel:jointWeights = [1, 0, 1] ( interpolation = \"vertex\" )\n";
  const Vertices bent = at(parse(arm(own, elbow_motion)), 0.8);
  EXPECT_TRUE(bent.row(0).isApprox(RowVector3d(0, 2, 2)));
  EXPECT_EQ(bent.row(1), RowVector3d(0, 0, 2));
  const std::string rigid =
      "int[] primvars:skel:jointIndices = [1] ( interpolation = \"constant\" )\n"
      "float[] primvars:skel:jointWeights = [1] ( interpolation = \"constant\" )\n";
  EXPECT_TRUE(at(parse(arm(rigid, elbow_motion)), 0.8).row(2).isApprox(RowVector3d(0, -2, 2)));
}

TEST(MeshMotionFile, SaysWhatIsWrongWithASkin) {
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(error_of(arm(replaced(arm_skin, "0, 1, 0, 1, 0, 1", "0, 1, 0, 1, 0, 2"), elbow_motion)),
            "body.usda:25:52: jointIndices: expected one of the 2 joints, found 2");
  EXPECT_EQ(error_of(arm(replaced(arm_skin, "0, 0.5", "0.5"), elbow_motion)),
            "body.usda:26:38: jointWeights: expected 6 elements, found 5");
  EXPECT_EQ(error_of(arm(replaced(arm_skin, "elementSize = 2", "elementSize = 3"), elbow_motion)),
            "body.usda:26:1: jointWeights: expected the elementSize of jointIndices, 3, found 2");
  EXPECT_EQ(error_of(arm(arm_skin, replaced(elbow_motion, "[(0, 0, 2)]", "[(0, 0, 2), (0, 0, 0)]"))),
            "body.usda:16:25: translations: expected 1 elements, found 2");
  EXPECT_EQ(error_of(arm(arm_skin, replaced(elbow_motion, "\"Bend\"", "\"Wave\""))),
            "body.usda:6:1: the skel:animationSource of 'Skel' names '/Arm/Bend', and there is no such prim");
  EXPECT_EQ(
      error_of(body_header + mesh("point3f[] points.timeSamples = { 0: [(0, 0, 0), (1, 0, 0), (0, 1, 8)],\n1: [] }\n")),
      "body.usda:9:4: points: expected 3 as in the first sample, found 0: a mesh that moves keeps its points");
}

// A referenced prim keeps its own skeleton, with the paths of its file, and its own frame rate.
TEST(MeshMotionFile, FollowsReferencesWithTheirSkeletonsAndTimes) {
  const test::ScratchFolder folder;
  folder.put(folder.path() / "arm.usda", arm(arm_skin, elbow_motion));
  const MeshMotion motion =
      read_mesh_motion(folder.put(folder.path() / "scene.usda",
                                  "#usda 1.0\n( metersPerUnit = 1\nupAxis = \"Z\"\ntimeCodesPerSecond = 20 )\ndef "
                                  "\"Left\" ( references = @arm.usda@</Arm> (offset = 5; scale = 0.5) ) {}\n"));
  EXPECT_DOUBLE_EQ(motion.times.front(), 0.25);
  EXPECT_DOUBLE_EQ(motion.times.back(), 0.25 + 0.4);
  EXPECT_TRUE(at(motion, 9).row(2).isApprox(RowVector3d(0, -2, 2)));
}

TEST(MeshMotionFile, PlaysASequenceOfObjFiles) {
  const test::ScratchFolder folder;
  const auto put = [&](const std::string& name, const std::string& z, const std::string& faces = "f 1 2 3\n") {
    folder.put(folder.path() / name, "v 0 0 0\nv 1 0 0\nv 0 1 " + z + "\n" + faces);
  };
  put("body0008.obj", "0");
  put("body0009.obj", "1");
  put("body0010.obj", "5");
  put("body10.obj", "9");
  const std::filesystem::path files = folder.path() / "body{frame:04}.obj";
  std::vector<std::filesystem::path> inputs;
  const MeshMotion motion = read_mesh_motion(files, {.frames_per_second = 2}, &inputs);
  EXPECT_EQ(motion.times, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(at(motion, 0.75).row(2), RowVector3d(0, 1, 3));
  EXPECT_EQ(inputs.size(), 3U);
  EXPECT_EQ(at(read_mesh_motion(files, {.up = MeshOptions::Up::y}), 9).row(2), RowVector3d(0, -5, 1));

  const auto error = [&](const std::string& name) {
    return usage_error([&] { read_mesh_motion(folder.path() / name); }).substr(folder.path().string().size() + 1);
  };
  EXPECT_EQ(error("arm{frame}.obj"), "arm{frame}.obj: there is no such file; the first could be arm1.obj");
  EXPECT_EQ(error("body{frame:4}.obj"), "body{frame:4}.obj: expected {frame} or {frame:04} in the name");
  put("body0012.obj", "0");
  EXPECT_EQ(error("body{frame:04}.obj"), "body{frame:04}.obj: body0011.obj is missing before body0012.obj");
  put("body0011.obj", "0", "f 1 3 2\n");
  EXPECT_EQ(error("body{frame:04}.obj"),
            "body0011.obj: expected the triangles of the first frame, but triangle 1 has other vertices");
  put("body0011.obj", "0", "f 1 2 3\nf 1 3 2\n");
  EXPECT_EQ(
      error("body{frame:04}.obj"),
      "body0011.obj: expected the 3 vertices and 1 triangles of the first frame, found 3 vertices and 2 triangles");
  // A single file has no frame rate.
  const auto with_fps =
      usage_error([&] { read_mesh_motion(folder.path() / "body0012.obj", {.frames_per_second = 2}); });
  EXPECT_NE(with_fps.find("body0012.obj: a single OBJ does not move: omit 'fps'"), std::string::npos) << with_fps;
}

TEST(MeshMotionFile, RefusesWhatAFormatDoesNotHave) {
  const test::ScratchFolder folder;
  const auto obj = folder.put(folder.path() / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 2\nf 1 2 3\n");
  EXPECT_EQ(read_mesh(obj, {.up = MeshOptions::Up::y}).positions.row(2), RowVector3d(0, -2, 1));
  EXPECT_EQ(usage_error([&] { read_mesh(obj, {.prim = "/a"}); }), obj.string() + ": an OBJ has no prims: omit 'prim'");
  const auto usd = folder.put(folder.path() / "a.usda", body_header + mesh(three_points));
  EXPECT_EQ(usage_error([&] { read_mesh(usd, {.up = MeshOptions::Up::z}); }),
            usd.string() + ": a USD file says itself which axis is up: omit 'up'");
}

// The homework's arm: from time code 1 to 10 the elbow turns by 90° about x; its unit is the centimetre, and y is up.
TEST(MeshMotionFile, MovesARealArm) {
  const std::filesystem::path folder(DRAPE_SOURCE_DIR "/../shared/reference/real");
  const std::filesystem::path file = folder / "arm.usda", with_cloth = folder / "arm_with_cloth.usda";
  if (!exists(file) || !exists(with_cloth)) GTEST_SKIP() << "no " << file << " or no " << with_cloth;
  const MeshMotion motion = read_mesh_motion(file);
  EXPECT_EQ(motion.times.size(), 10U);
  EXPECT_TRUE(at(motion, 0).row(0).isApprox(RowVector3d(0.005, -0.04, -0.005)));
  // (0.5, −0.5, 4) is (0.5, −0.5, 2) relative to the elbow, turned (0.5, −2, −0.5), and finally (0.5, −2, 1.5).
  EXPECT_TRUE(at(motion, 1).row(0).isApprox(RowVector3d(0.005, -0.015, -0.02), 1e-4));
  const MeshMotion bent = read_mesh_motion(with_cloth, {.prim = "/root/Model"});
  EXPECT_EQ(bent.mesh.positions.rows(), 12);
  EXPECT_EQ(bent.mesh.triangles.size(), 20U);
  EXPECT_GT((bent.samples.back() - bent.samples.front()).norm(), 0.1);
}

}  // namespace
}  // namespace drape::mesh_motion_file
