#include "scene/usd/motion.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::usd_motion {
namespace {

using Eigen::Vector3d;
using test::usage_error;

const std::string ball_header =
    "#usda 1.0\n( metersPerUnit = 1\nupAxis = \"Z\"\nstartTimeCode = 10\ntimeCodesPerSecond = 20 )\n";

TransformTrack parse(const std::string& text) { return read_usd_motion(SourceText("ball.usda", text)); }

std::string error_of(const std::string& text) {
  return usage_error([&] { parse(text); });
}

/// Returns a sphere with these lines from line 7 on.
std::string ball(const std::string& lines) { return ball_header + "def Sphere \"ball\" {\n" + lines + "\n}\n"; }

/// Applies the operations in this order to a point.
Vector3d moved(const std::string& attributes, const std::string& order, const Vector3d& point) {
  return parse(ball(attributes + "\nuniform token[] xformOpOrder = [" + order + "]")).at(0) * point;
}

TEST(UsdTransform, AppliesTheLastOperationOfTheOrderFirst) {
  const std::string ops = "double3 xformOp:translate = (1, 2, 3)\nfloat3 xformOp:scale = (2, 3, 4)\n";
  EXPECT_EQ(moved(ops, "\"xformOp:translate\", \"xformOp:scale\"", {1, 1, 1}), Vector3d(3, 5, 7));
  EXPECT_EQ(moved(ops, "\"xformOp:scale\", \"xformOp:translate\"", {1, 1, 1}), Vector3d(4, 9, 16));
  EXPECT_EQ(moved(ops, "", {1, 1, 1}), Vector3d(1, 1, 1)) << "an operation out of the order does nothing";
}

TEST(UsdTransform, ReadsMatricesThatActOnRowVectors) {
  const std::string matrix = "matrix4d xformOp:transform = ( (0, 2, 0, 0), (-2, 0, 0, 0), (0, 0, 2, 0), (5, 6, 7, 1) )";
  EXPECT_EQ(moved(matrix, "\"xformOp:transform\"", {1, 0, 0}), Vector3d(5, 8, 7));
  EXPECT_EQ(moved(matrix, "\"xformOp:transform\"", {0, 1, 0}), Vector3d(3, 6, 7));
}

TEST(UsdTransform, TurnsCounterclockwiseByDegrees) {
  const auto turned = [](const std::string& op, const std::string& angle, const Vector3d& point) {
    return moved((angle[0] == '(' ? "float3 " : "float ") + op + " = " + angle, '"' + op + '"', point);
  };
  EXPECT_TRUE(turned("xformOp:rotateX", "90", {0, 1, 0}).isApprox(Vector3d(0, 0, 1)));
  EXPECT_TRUE(turned("xformOp:rotateY", "90", {0, 0, 1}).isApprox(Vector3d(1, 0, 0)));
  EXPECT_TRUE(turned("xformOp:rotateZ", "90", {1, 0, 0}).isApprox(Vector3d(0, 1, 0)));
  // About x first: z → −y, then about y nothing, then about z: −y → x. In the opposite order: z, then z → x, then x.
  EXPECT_TRUE(turned("xformOp:rotateXYZ", "(90, 0, 90)", {0, 0, 1}).isApprox(Vector3d(1, 0, 0)));
  EXPECT_TRUE(turned("xformOp:rotateZYX", "(90, 0, 90)", {0, 0, 1}).isApprox(Vector3d(0, -1, 0)));
  EXPECT_TRUE(turned("xformOp:rotateYZX", "(0, 90, 90)", {0, 0, 1}).isApprox(Vector3d(0, 1, 0)));
}

TEST(UsdTransform, ReadsQuaternionsRealPartFirst) {
  const std::string s = std::to_string(std::numbers::sqrt2 / 2);
  const Vector3d result = moved("quatf xformOp:orient = (" + s + ", 0, 0, " + s + ")", "\"xformOp:orient\"", {1, 0, 0});
  EXPECT_TRUE(result.isApprox(Vector3d(0, 1, 0)));
}

TEST(UsdTransform, TurnsAboutAPivotThatIsTakenBack) {
  const std::string ops = "float3 xformOp:translate:pivot = (1, 0, 0)\nfloat xformOp:rotateZ:spin = 180\n";
  const std::string order =
      "\"xformOp:translate:pivot\", \"xformOp:rotateZ:spin\", \"!invert!xformOp:translate:pivot\"";
  EXPECT_TRUE(moved(ops, order, {1, 0, 0}).isApprox(Vector3d(1, 0, 0)));
  EXPECT_TRUE(moved(ops, order, {0, 0, 0}).isApprox(Vector3d(2, 0, 0)));
}

TEST(UsdTransform, ComposesAncestorsUntilOneResetsTheStack) {
  const auto text = [](const std::string& first) {
    return ball_header + "def Xform \"a\" {\ndouble3 xformOp:translate = (10, 0, 0)\n" +
           "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n" + "def Xform \"b\" {\n" +
           "double3 xformOp:scale = (2, 2, 2)\nuniform token[] xformOpOrder = [" + first + "\"xformOp:scale\"]\n" +
           "def Sphere \"s\" {}\n}\n}\n";
  };
  EXPECT_EQ(parse(text("")).at(0) * Vector3d(1, 0, 0), Vector3d(12, 0, 0));
  EXPECT_EQ(parse(text("\"!resetXformStack!\", ")).at(0) * Vector3d(1, 0, 0), Vector3d(2, 0, 0));
}

TEST(UsdTransform, NamesTheOperationAtFault) {
  EXPECT_EQ(error_of(ball("uniform token[] xformOpOrder = [\"xformOp:scale\"]")),
            "ball.usda:7:33: the prim 'ball' has no operation 'xformOp:scale'");
  EXPECT_EQ(error_of(ball("float xformOp:scale = 2\nuniform token[] xformOpOrder = [\"xformOp:scale\"]")),
            "ball.usda:7:1: xformOp:scale: expected a type of 3 numbers, found float");
  EXPECT_NE(error_of(ball("float xformOp:rotateXX = 2\nuniform token[] xformOpOrder = [\"xformOp:rotateXX\"]"))
                .find("ball.usda:7:1: unknown operation 'xformOp:rotateXX': expected xformOp:translate, "),
            std::string::npos);
  EXPECT_EQ(
      error_of(ball("float3 xformOp:scale = (1, 0, 1)\nuniform token[] xformOpOrder = [\"!invert!xformOp:scale\"]")),
      "ball.usda:7:24: xformOp:scale cannot be inverted");
  EXPECT_EQ(error_of(ball("matrix4d xformOp:transform = ( (1, 0, 0, 1), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1) )\n"
                          "uniform token[] xformOpOrder = [\"xformOp:transform\"]")),
            "ball.usda:7:30: the matrix is not affine: its last column must be 0, 0, 0, 1");
  EXPECT_EQ(error_of(ball("matrix4d xformOp:transform = ( (1, 0, 0, 0), (0, 1, 0, 0) )")),
            "ball.usda:7:59: expected ',' and 4 rows in a matrix of xformOp:transform, found ')'");
}

const std::string falling_ball =
    "double radius = 0.5\ndouble3 xformOp:translate.timeSamples = { 30: (0, 0, -4), 10: (0, 0, 0), 20: (2, 0, 0), }\n"
    "uniform token[] xformOpOrder = [\"xformOp:translate\"]";

TEST(UsdMotion, CountsSecondsFromTheStartTimeCode) {
  const TransformTrack track = parse(ball(falling_ball));
  EXPECT_EQ(track.times, (std::vector<double>{0, 0.5, 1}));
  ASSERT_EQ(track.transforms.size(), 3U);
  EXPECT_EQ(track.transforms[1].translation(), Vector3d(2, 0, 0));
}

TEST(UsdMotion, InterpolatesLinearlyAndStaysAtItsEnds) {
  const TransformTrack track = parse(ball(falling_ball));
  EXPECT_EQ(track.at(0.25).translation(), Vector3d(1, 0, 0));
  EXPECT_EQ(track.at(0.75).translation(), Vector3d(1, 0, -2));
  EXPECT_EQ(track.at(0.5).translation(), Vector3d(2, 0, 0));
  EXPECT_EQ(track.at(-1).translation(), Vector3d(0, 0, 0));
  EXPECT_EQ(track.at(99).translation(), Vector3d(0, 0, -4));
}

TEST(UsdMotion, JoinsTheSamplesOfAllAncestors) {
  const TransformTrack track = parse(ball_header +
                                     "def Xform \"a\" {\nfloat3 xformOp:scale.timeSamples = {10: (1, 1, 1), 30: (3, 3, "
                                     "3)}\nuniform token[] xformOpOrder = [\"xformOp:scale\"]\n" +
                                     "def Sphere \"ball\" {\n" + falling_ball + "\n}\n}\n");
  EXPECT_EQ(track.times, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(track.transforms[1].translation(), Vector3d(4, 0, 0));
  EXPECT_DOUBLE_EQ(track.sphere_at(0.5).radius, 1);
}

TEST(UsdMotion, PrefersTheShapeThatMoves) {
  const std::string still = "def Sphere \"still\" {}\n", empty = "def Xform \"empty\" {\n" + falling_ball + "\n}\n";
  EXPECT_EQ(parse(ball_header + still + ball(falling_ball).substr(ball_header.size())).times.size(), 3U);
  EXPECT_EQ(parse(ball_header + empty + still).times.size(), 1U) << "a shape that stands before an empty that moves";
  EXPECT_EQ(parse(ball_header + empty).times.size(), 3U);
  EXPECT_EQ(parse(ball_header + still).times, std::vector<double>{0});
  EXPECT_EQ(error_of(ball_header), "ball.usda: there is neither a Mesh nor a Sphere nor a moving prim in the file");
}

// A static prim is no track, nor is one moved only by its skeleton.
TEST(UsdMotion, OfNothingIsNoTrack) {
  const test::ScratchFolder folder;
  const auto error_of_track = [&](const std::string& text) {
    const std::filesystem::path file = folder.put(folder.path() / "ball.usda", text);
    return usage_error([&] { read_sphere_track(file); }).substr(folder.path().string().size() + 1);
  };
  const std::string message =
      "ball.usda: nothing moves in the file: expected a Mesh, a Sphere or an Xform with time samples of its transform";
  EXPECT_EQ(error_of_track(ball("")), message);
  const std::string deforms = " changes its shape: use [[effects.body]] with file and prim = \"/m\"",
                    of = "a track moves a sphere, but the Mesh 'm'";
  EXPECT_EQ(
      error_of_track(ball_header + "def Mesh \"m\" {\npoint3f[] points.timeSamples = { 1: [(0, 0, 0)], 2: [(1, 0, "
                                   "0)] }\n}\n"),
      "ball.usda:6:1: " + of + deforms);
  EXPECT_EQ(error_of_track(ball_header +
                           "def Mesh \"m\" {\nrel skel:skeleton = </s>\nint[] primvars:skel:jointIndices = [0]\n" +
                           "double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 2: (0, 0, 1) }\nuniform token[] "
                           "xformOpOrder = [\"xformOp:translate\"]\n}\n"),
            "ball.usda:6:1: " + of + deforms);
  EXPECT_EQ(error_of_track(ball("double3 xformOp:translate.timeSamples = { 1: (0, 0, 0) }\nuniform token[] "
                                "xformOpOrder = [\"xformOp:translate\"]")),
            message);
}

TEST(UsdMotion, BoundsTheShapeByASphereThatFollowsUnitsAndUpAxis) {
  const TransformTrack track = parse(
      "#usda 1.0\n( metersPerUnit = 0.1\nupAxis = \"Y\" )\ndef Mesh \"m\" {\n"
      "point3f[] points = [(1, 0, 0), (3, 0, 0), (2, 1, 0), (2, -1, 0), (2, 0, 1), (2, 0, -1)]\n"
      "double3 xformOp:translate = (0, 5, 0)\nuniform token[] xformOpOrder = [\"xformOp:translate\"]\n}\n");
  EXPECT_EQ(track.center, Vector3d(2, 0, 0));
  EXPECT_EQ(track.radius, 1);
  EXPECT_TRUE(track.sphere_at(0).center.isApprox(Vector3d(0.2, 0, 0.5)));
  EXPECT_NEAR(track.sphere_at(0).radius, 0.1, 1e-16);
}

// A sphere of its own radius over time, which may move or stand still.
TEST(UsdMotion, ChangesTheRadiusOfASphere) {
  const std::string radius = "double radius.timeSamples = { 10: 0.2, 30: 0.6 }\n";
  for (const std::string moves : {"",
                                  "double3 xformOp:translate.timeSamples = { 10: (0, 0, 0), 30: (0, 0, 1) }\n"
                                  "uniform token[] xformOpOrder = [\"xformOp:translate\"]"}) {
    const test::ScratchFolder folder;
    const auto track = read_sphere_track(folder.put(folder.path() / "ball.usda", ball(radius + moves)));
    EXPECT_NEAR(track->at(0).radius, 0.2, 1e-15);
    EXPECT_NEAR(track->at(0.5).radius, 0.4, 1e-15);
    EXPECT_NEAR(track->at(2).radius, 0.6, 1e-15);
  }
}

// The result is a sphere that must contain all points of the stretched shape.
TEST(UsdMotion, HoldsAStretchedShapeWhole) {
  for (const char* scale : {"(2, 3, 5)", "(5, 2, 3)", "(-5, 3, 2)"}) {
    const TransformTrack track = parse(
        ball(std::string("double radius = 0.5\nfloat3 xformOp:rotateXYZ = (20, -50, 70)\nfloat3 xformOp:scale = ") +
             scale + "\nuniform token[] xformOpOrder = [\"xformOp:rotateXYZ\", \"xformOp:scale\"]"));
    EXPECT_NEAR(track.sphere_at(0).radius, 2.5, 1e-12) << scale;
  }
}

TEST(UsdMotion, SaysWhatIsWrongWithASample) {
  EXPECT_EQ(error_of(ball("double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 1: (1, 0, 0) }")),
            "ball.usda:7:60: the time 1 appears twice in the time samples of xformOp:translate");
  EXPECT_EQ(error_of(ball("double3 xformOp:translate.timeSamples = { 1: (0, 0) }")),
            "ball.usda:7:51: expected ',' and 3 numbers in a tuple of xformOp:translate, found ')'");
  EXPECT_EQ(error_of(ball("double3 xformOp:translate.timeSamples = { nan: (0, 0, 0) }")),
            "ball.usda:7:43: expected '}' or a finite time in the time samples of xformOp:translate, found 'nan'");
}

TEST(UsdMotion, SwingsTheShowcaseSphereOnItsRope) {
  const TransformTrack track =
      read_usd_motion(std::filesystem::path(DRAPE_SOURCE_DIR "/scenes/showcase/swinging_sphere.usda"));
  EXPECT_NEAR(track.radius, 0.3, 1e-6);
  EXPECT_EQ(track.times.back(), 4);
  for (const double time : track.times) {
    EXPECT_NEAR((track.sphere_at(time).center - Vector3d(0, 0, 1.2)).norm(), 2, 2e-6) << "at " << time << " s";
  }
}

/// Tests with the homework's animated sphere, which is not part of the project; see DRAPE_REFERENCE_MESHES.
class AnimatedSphere : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("DRAPE_REFERENCE_MESHES");
    file_ = std::filesystem::path(folder != nullptr ? folder : DRAPE_SOURCE_DIR "/../shared/reference/meshes") /
            "animated_sphere.usda";
    if (!std::filesystem::exists(file_)) GTEST_SKIP() << "no " << file_ << ": set DRAPE_REFERENCE_MESHES to its folder";
  }
  std::filesystem::path file_;
};

/// Returns the last row of the matrix in a line "   12: ( (…), (…), (…), (x, y, z, 1) )" of the file.
Vector3d translation_in_text(const SourceText& source, int time_code) {
  const std::string_view text = source.text();
  const std::size_t line = text.find("\n            " + std::to_string(time_code) + ": (");
  const std::size_t row = text.rfind('(', text.find('\n', line + 1));
  Vector3d result;
  const char* next = text.data() + row + 1;
  for (double& number : result) next = std::from_chars(next, text.data() + text.size(), number).ptr + 2;
  return result;
}

TEST_F(AnimatedSphere, PlaysAsItsTextSays) {
  const SourceText source = SourceText::read(file_);
  const TransformTrack track = read_usd_motion(file_);
  ASSERT_EQ(track.times.size(), 240U);
  EXPECT_EQ(track.times.front(), 0);
  EXPECT_NEAR(track.at(0).translation().y(), 0.000833, 1e-6);
  EXPECT_NEAR(track.at(79 / 24.0).translation().y(), 1.792, 1e-6);
  EXPECT_EQ(track.at(1000).translation(), Vector3d(0, -2, 0));
  for (int code = 1; code <= 240; ++code) {
    const double time = (code - 1) / 24.0;
    EXPECT_EQ(track.at(time).translation(), translation_in_text(source, code)) << "time code " << code;
    EXPECT_EQ(track.at(time).linear(), Eigen::Matrix3d::Identity());
  }
  const Vector3d halfway = (translation_in_text(source, 40) + translation_in_text(source, 41)) / 2;
  EXPECT_TRUE(track.at(39.5 / 24).translation().isApprox(halfway, 1e-12));
}

TEST_F(AnimatedSphere, IsASphereOfRadiusOne) {
  const TransformTrack track = read_usd_motion(file_);
  EXPECT_NEAR(track.radius, 1, 1e-6);
  EXPECT_LT(track.center.norm(), 1e-6);
}

}  // namespace
}  // namespace drape::usd_motion
