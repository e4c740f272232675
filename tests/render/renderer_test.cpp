#include "drape/render/renderer.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "drape/core/error.hpp"
#include "render/gl/context.hpp"
#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

/// Makes a cube of n×n cells per face, inflated to a sphere around the origin.
Mesh closed_surface(int n) {
  Mesh mesh;
  const Mesh face = make_grid(n, n);
  const auto count = face.positions.rows();
  mesh.positions.resize(6 * count, 3);
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1 : -1;
    for (Eigen::Index i = 0; i < count; ++i) {
      Eigen::Vector3d p;
      p[axis] = sign;
      p[(axis + 1) % 3] = face.positions(i, 0);
      p[(axis + 2) % 3] = face.positions(i, 1);
      mesh.positions.row(side * count + i) = p.normalized().transpose();
    }
    const int first = static_cast<int>(side * count);
    for (const Triangle& t : face.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return mesh;
}

TEST(Renderer, LeavesTheBackgroundsBytesExactWhereNothingIsDrawn) {
  for (const int samples : {1, 4}) {
    for (const int value : {0, 1, 17, 128, 254, 255}) {
      Look look;
      look.samples = samples;
      look.background = Rgb{value / 255.0, (255 - value) / 255.0, 0.5};
      const Image image = draw(nothing(), from_above(), look);
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
          ASSERT_EQ(image.at(x, y)[0], value);
          ASSERT_EQ(image.at(x, y)[1], 255 - value);
          ASSERT_EQ(image.at(x, y)[2], 128);
        }
      }
    }
  }
}

TEST(Renderer, DrawsAGradientWithItsTopColourAtTheTop) {
  Look look;
  look.background = Rgb{0, 0, 0};
  look.background_top = Rgb{1, 1, 1};
  const Image image = draw(nothing(), from_above(), look);
  EXPECT_GT(image.at(0, 0)[0], 250);
  EXPECT_LT(image.at(0, image.height - 1)[0], 5);
  for (int y = 1; y < image.height; ++y) EXPECT_LE(image.at(5, y)[0], image.at(5, y - 1)[0]);
}

TEST(Renderer, DrawsASphereAsLargeAsItsTangentConeIs) {
  const double distance = 5, radius = 0.6;
  const Eigen::Vector2i size{241, 201};
  Look look;
  look.background = Rgb{1, 1, 1};
  const Image image = draw(nothing(), from_above(), look, size, {SphereShape{{0, 0, 0}, radius}});
  const double expected = std::tan(std::asin(radius / distance)) / (1 / distance) * size.y() / 2;
  int half_covered = 0, row = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool covered = image.at(x, y)[1] < 230;  // on white, green fades where red covers
      half_covered += covered ? 1 : 0;
      row += covered && y == size.y() / 2 ? 1 : 0;
    }
  }
  EXPECT_NEAR(row, 2 * expected, 1.5);
  // The highlight is white and does not count, so the area is only bounded from above.
  EXPECT_LT(half_covered, M_PI * (expected + 0.5) * (expected + 0.5));
  EXPECT_GT(half_covered, 0.9 * M_PI * expected * expected);
}

TEST(Renderer, DrawsAFilmAsItDrawsItsFramesOneByOne) {
  const Mesh mesh = make_grid(4, 4);
  const std::vector<Rgb> colors(25, Rgb{0, 0.5, 1});
  View aside = from_above();
  aside.position.x() += 2;
  std::vector<Frame> frames(4, Frame{.positions = mesh.positions});
  for (std::size_t k = 0; k < frames.size(); ++k) {
    frames[k].positions.col(2).array() += 0.3 * static_cast<double>(k);
    // The last frame covers a smaller part of the picture.
    if (k < 3) frames[k].colliders = {SphereShape{{0.2 * static_cast<double>(k), 0, 1}, 0.5}};
  }
  for (const int samples : {1, 4}) {
    Look look;
    look.samples = samples;
    Renderer film(data_folder(), {120, 100}, from_above(), look, 25, mesh.triangles, mesh.uvs);
    Renderer alone(data_folder(), {120, 100}, from_above(), look, 25, mesh.triangles, mesh.uvs);
    std::optional<Image> previous;
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const View view = k == 1 ? aside : from_above();
      film.look_from(view);
      alone.look_from(view);
      const std::optional<Image> drawn = k == 2 ? film.start(frames[k], colors) : film.start(frames[k]);
      ASSERT_EQ(drawn.has_value(), previous.has_value());
      EXPECT_TRUE(!drawn || drawn->pixels == previous->pixels) << k;
      previous = k == 2 ? alone.draw(frames[k], colors) : alone.draw(frames[k]);
    }
    EXPECT_THROW(film.draw(frames[0]), std::logic_error);
    EXPECT_EQ(film.finish().value().pixels, previous->pixels);
    EXPECT_FALSE(film.finish());
    EXPECT_EQ(film.draw(frames[0]).pixels, alone.draw(frames[0]).pixels);
  }
}

TEST(Renderer, LightsBothSidesOfTheCloth) {
  const Mesh mesh = make_grid(2, 2);
  View below = from_above();
  below.position.z() *= -1;
  const Image front = draw(mesh, from_above(), Look{}), back = draw(mesh, below, Look{});
  // The lights move with the camera, so the back looks as bright as the front.
  EXPECT_GT(front.at(60, 50)[0], 120);
  EXPECT_NEAR(back.at(60, 50)[0], front.at(60, 50)[0], 12);
}

TEST(Renderer, LeavesNoCracksBetweenTriangles) {
  Look look;
  look.background = Rgb{1, 0, 1};
  look.color = {0, 0.4, 0};
  const View inside{{0.1, 0.2, 0.1}, {1, 0.7, 0.4}, {0, 0, 1}, 80};
  for (const auto& [lines, samples] : {std::pair(false, 1), {true, 1}, {false, 4}, {true, 4}}) {
    look.mesh_lines = lines;
    look.samples = samples;
    look.line_color = {0, 0, 0};
    const Image image = draw(closed_surface(12), inside, look, {301, 200});
    int red = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) red = std::max(red, int{image.at(x, y)[0]});
    }
    EXPECT_LT(red, 110) << "one sample in four of the background would give 137";
  }
}

TEST(Renderer, AveragesSamplesAsLightAndEncodesOnce) {
  Look look;
  look.samples = 4;
  look.color = {0, 0, 0};
  look.background = Rgb{1, 1, 1};
  look.thickness = 0;  // a hem is lit differently
  Mesh mesh = make_grid(1, 1);
  const Eigen::Rotation2D<double> turn(0.2);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d p = turn * mesh.positions.row(i).head<2>().transpose() * 0.5;
    mesh.positions.row(i).head<2>() = p.transpose();
  }
  const Image image = draw(mesh, from_above(), look, {240, 200});
  // The cloth's highlight makes its black vary by a few hundredths of light.
  const double inside = to_linear(image.at(120, 100)[0]);
  EXPECT_LT(inside, 0.1);
  std::set<int> seen;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double nearest = 1e9;
      int covered = 0;
      for (int k = 0; k <= 4; ++k) {
        const double error = std::abs((k * inside + (4 - k)) / 4 - to_linear(image.at(x, y)[0]));
        if (error < nearest) nearest = error, covered = k;
      }
      ASSERT_LT(nearest, 0.03) << "at " << x << ", " << y << ": not the mean of whole samples";
      seen.insert(covered);
    }
  }
  EXPECT_EQ(seen, (std::set<int>{0, 1, 2, 3, 4}));
}

TEST(Renderer, DrawsMeshLinesOfTheirWidth) {
  Look look;
  look.color = {0.5, 0.5, 0.5};
  const Mesh mesh = make_grid(4, 4);
  const Image plain = draw(mesh, from_above(), look, {400, 400});
  for (const double width : {1.0, 2.0}) {
    look.mesh_lines = true;
    look.line_color = {0, 0, 0};
    look.line_width = width;
    const Image image = draw(mesh, from_above(), look, {400, 400});
    double darkness = 0, boundary = 0;
    // Across the vertical edge at x = 0, and the border edge at x = -0.5 of a smaller picture of the cloth.
    for (int x = 190; x < 210; ++x) {
      darkness += 1 - to_linear(image.at(x, 180)[0]) / to_linear(plain.at(x, 180)[0]);
    }
    for (int x = 0; x < 10; ++x) boundary += 1 - to_linear(image.at(x, 180)[0]) / to_linear(plain.at(x, 180)[0]);
    EXPECT_NEAR(darkness, width, 0.25 * width);
    EXPECT_NEAR(boundary, width, 0.35 * width);
  }
}

TEST(Renderer, HidesTheSphereUnderClothThatDipsIntoIt) {
  // A dome 4 % inside the sphere, with the chords between its vertices even deeper.
  Mesh mesh = make_grid(20, 20);
  const double radius = 0.4;
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    const Eigen::Vector2d p = mesh.positions.row(i).head<2>().transpose();
    const double angle = p.norm(), scale = angle > 0 ? std::sin(angle) / angle : 1;
    mesh.positions.row(i) = 0.96 * radius * Eigen::RowVector3d(scale * p.x(), scale * p.y(), std::cos(angle));
  }
  Look look;
  look.color = {0, 0.5, 0};
  const Image image = draw(mesh, from_above(), look, {200, 200}, {SphereShape{{0, 0, 0}, radius}});
  for (int y = 75; y < 125; ++y) {
    for (int x = 75; x < 125; ++x) ASSERT_GT(image.at(x, y)[1], image.at(x, y)[0]) << "red at " << x << ", " << y;
  }
}

TEST(Renderer, GivesTheSameBytesAgainAndBesideAnotherRenderer) {
  const Mesh mesh = make_grid(10, 10);
  Frame frame;
  frame.positions = mesh.positions;
  frame.colliders.emplace_back(SphereShape{{0, 0, -0.5}, 0.4});
  const View view{{2, -4, 2}, {0, 0, 0}, {0, 0, 1}, 30};
  Renderer one(data_folder(), {120, 100}, view, Look{}, 121, mesh.triangles, mesh.uvs);
  const Image first = one.draw(frame);
  {
    Renderer other(data_folder(), {64, 48}, view, Look{}, 121, mesh.triangles, mesh.uvs);
    EXPECT_EQ(other.draw(frame).width, 64);
    EXPECT_EQ(one.draw(frame), first);
  }
  EXPECT_EQ(one.draw(frame), first);
  EXPECT_NE(one.description().find("OpenGL"), std::string::npos);
}

TEST(Renderer, RefusesAFrameWithAnotherNumberOfVertices) {
  const Mesh mesh = make_grid(2, 2);
  Renderer renderer(data_folder(), {32, 32}, from_above(), Look{}, 9, mesh.triangles, mesh.uvs);
  Frame frame;
  for (const int count : {0, 8, 10}) {
    frame.positions = Vertices::Zero(count, 3);
    EXPECT_THROW(renderer.draw(frame), std::invalid_argument) << count;
  }
}

TEST(Renderer, LooksAtNoVertexThatAFrameDoesNotHave) {
  const Mesh mesh = make_grid(300, 300);
  const auto count = static_cast<int>(mesh.positions.rows());
  Renderer renderer(data_folder(), {32, 32}, from_above(), Look{}, count, mesh.triangles, mesh.uvs);
  Frame frame;
  frame.positions = Vertices::Zero(1, 3);  // megabytes before the last triangle's positions
  EXPECT_THROW(renderer.draw(frame), std::invalid_argument);
}

/// Positions of cloth, obstacles and camera beyond any picture do no harm.
TEST(Renderer, DrawsNumbersOfAnySize) {
  const std::vector<double> sizes{0, 1e-300, 1e-162, 1e-40, 1e16, 1e39, 1e90, 1e154, 1e155, 1e308, INFINITY, NAN};
  const Mesh mesh = make_grid(3, 3), box = make_grid(2, 2);
  Look look;
  look.samples = 1;
  Renderer renderer(data_folder(), {24, 16}, from_above(), look, static_cast<int>(mesh.positions.rows()),
                    mesh.triangles, {});
  const auto draw_at = [&](double cloth, double obstacle, const View& view) {
    Frame frame;
    frame.positions = (mesh.positions.array() + cloth).matrix();
    const Eigen::Vector3d center(obstacle, -obstacle, 0);
    frame.colliders = {
        SphereShape{center, 0.5, 0.5}, GroundShape{Eigen::Vector3d::UnitZ(), -1 - obstacle},
        MeshShape{std::make_shared<std::vector<Triangle>>(box.triangles), (box.positions.array() + obstacle).matrix()}};
    renderer.look_from(view);
    EXPECT_EQ(renderer.draw(frame).width, 24);
    frame.positions = mesh.positions * cloth;
    EXPECT_EQ(renderer.draw(frame).width, 24);
  };
  for (const double size : sizes) {
    draw_at(size, 0, from_above());
    draw_at(0.1, size, from_above());
    View far = from_above(), near = from_above(), turned = from_above();
    far.position[0] = size;
    near.target = near.position + Eigen::Vector3d(size, 0, 0);
    turned.up = Eigen::Vector3d(0, size, 0);
    for (const View& view : {far, near, turned}) draw_at(0.1, 0, view);
  }
}

TEST(GlContext, NamesTheDebianPackageIfOsMesaIsMissing) {
  try {
    make_osmesa_context({"libOSMesa_that_is_not_there.so"});
    FAIL() << "a context came from nowhere";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("libosmesa6"), std::string::npos) << error.what();
  }
}

TEST(GlContext, RefusesVectorsOfWhichMesaCrashes) {
  setenv("LP_NATIVE_VECTOR_WIDTH", "512", 1);
  EXPECT_THROW(limit_llvmpipe_vector_width(), UsageError);
  setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
  EXPECT_NO_THROW(limit_llvmpipe_vector_width());
  unsetenv("LP_NATIVE_VECTOR_WIDTH");
  limit_llvmpipe_vector_width();
  EXPECT_STREQ(std::getenv("LP_NATIVE_VECTOR_WIDTH"), "256");
}

}  // namespace
}  // namespace drape::test
