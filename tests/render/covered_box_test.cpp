#include "render/shot.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/render/backends.hpp"
#include "tests/render/drawing.hpp"
#include "tests/support/random.hpp"

// Only the covered part of a picture is cleared, drawn and read. Two invisible specks beyond opposite corners of the
// picture extend that part to the whole picture, which must stay the same.

namespace drape::test {
namespace {

Mesh crumpled(std::uint64_t seed) {
  Mesh mesh = make_grid(6, 6);
  Random random(seed);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    for (int axis = 0; axis < 3; ++axis) mesh.positions(i, axis) += random.between(-0.3, 0.3);
  }
  return mesh;
}

/// Returns the view from +z, with a point of the plane z = 0 in the middle.
View looking_at(double x, double y) {
  View view = from_above();
  view.position.head<2>() = view.target.head<2>() = Eigen::Vector2d(x, y);
  return view;
}

std::vector<Collider> with_specks(std::vector<Collider> colliders, const View& view) {
  for (const double side : {-100.0, 100.0}) {
    colliders.emplace_back(SphereShape{view.target + Eigen::Vector3d(side, side, 0), 1e-6});
  }
  return colliders;
}

/// Draws a ball and a crumpled cloth, and the cloth alone, clearing only their part of the picture and all of it.
void expect_all_is_drawn(const Eigen::Vector2i& size, int samples, const Eigen::Vector2d& middle, std::uint64_t seed,
                         GlBackend backend) {
  SCOPED_TRACE(::testing::Message() << size.transpose() << " pixels, " << samples << " samples, looking at "
                                    << middle.transpose());
  const View view = looking_at(middle.x(), middle.y());
  Look look;
  look.samples = samples;
  look.background = Rgb{0.2, 0.5, 0.9};
  look.background_top = Rgb{1, 1, 1};
  look.mesh_lines = seed % 2 == 0;
  const Mesh mesh = crumpled(seed);
  for (const auto& colliders : {std::vector<Collider>{}, {SphereShape{{0.7, -0.6, 0.1}, 0.5}}}) {
    const Image in_the_box = draw(mesh, view, look, size, colliders, backend);
    // Unlike EXPECT_EQ, this does not print all bytes.
    EXPECT_TRUE(in_the_box == draw(mesh, view, look, size, with_specks(colliders, view), backend));
  }
}

constexpr std::array<int, 3> sample_counts{1, 2, 4};

/// Views with the cloth whole, cut by an edge or a corner of the picture, and outside.
const std::array<Eigen::Vector2d, 5> middles{{{0, 0}, {1.1, 0.4}, {-0.8, 1.3}, {0.9, -2.2}, {7, 0}}};

class CoveredBoxOf : public WithBackend {};

TEST_P(CoveredBoxOf, HoldsAllThatIsDrawn) {
  std::uint64_t seed = 0;
  for (const Eigen::Vector2i& size : {Eigen::Vector2i(16, 16), {97, 131}, {301, 40}, {1024, 576}}) {
    for (const int samples : sample_counts) {
      for (int k = 0; k < 2; ++k, ++seed) expect_all_is_drawn(size, samples, middles[seed % 5], seed, GetParam());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, CoveredBoxOf, both_backends, name_of_backend);

class CoveredBoxOfAnySize : public WithBackend {};

TEST_P(CoveredBoxOfAnySize, HoldsAllThatIsDrawn) {
  std::uint64_t seed = 0;
  for (const Eigen::Vector2i& size : {Eigen::Vector2i(16, 16), {17, 4096}, {4095, 31}, {480, 400}, {1920, 1080}}) {
    for (const int samples : sample_counts) {
      for (const Eigen::Vector2d& middle : middles) expect_all_is_drawn(size, samples, middle, ++seed, GetParam());
    }
  }
  for (const int samples : sample_counts) {
    for (std::size_t k = 0; k < 2; ++k) expect_all_is_drawn({4096, 4096}, samples, middles[k], k, GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Nightly, CoveredBoxOfAnySize, both_backends, name_of_backend);

TEST(CoveredBox, ForgetsTheFrameBefore) {
  const Mesh mesh = crumpled(5);
  const View view = from_above();
  const auto renderer = [&] {
    return Renderer(data_folder(), {120, 100}, view, Look{}, static_cast<int>(mesh.positions.rows()), mesh.triangles,
                    mesh.uvs);
  };
  Frame small, large, away;
  large.positions = mesh.positions;
  small.positions = 0.2 * mesh.positions;
  away.positions = mesh.positions.rowwise() + Eigen::RowVector3d(100, 0, 0);
  Renderer used = renderer();
  for (const Frame* frame : {&large, &small, &large, &away, &small})
    EXPECT_EQ(used.draw(*frame), renderer().draw(*frame));
}

TEST(CoveredBox, IsTightAndEndsAtThePicture) {
  const auto box = [](double x, double y) {
    Frame frame;
    frame.positions = make_grid(2, 2).positions * 0.5;  // a square of side 1 around the origin
    const View view = looking_at(x, y);
    return covered_box(Shot(frame, view, 1), frame.positions, {100, 100});
  };
  const PixelBox middle = box(0, 0);
  EXPECT_LE(middle.corner.maxCoeff(), 25);
  EXPECT_GE(middle.corner.minCoeff(), 22);
  EXPECT_GE(middle.size.minCoeff(), 50);
  EXPECT_LE(middle.size.maxCoeff(), 55);
  EXPECT_TRUE(box(5, 0).empty());
  EXPECT_FALSE(box(1.4, 0).empty());
  EXPECT_EQ(box(1.2, 0).corner.x(), 0);
}

TEST(CoveredBox, IsThePictureWhereItCannotBeKnown) {
  Frame frame;
  frame.positions = make_grid(2, 2).positions;
  frame.positions(0, 2) = 6;  // behind the camera
  EXPECT_EQ(covered_box(Shot(frame, from_above(), 1), frame.positions, {100, 90}).size, Eigen::Vector2i(100, 90));
  frame.positions(0, 2) = 0;
  frame.colliders = {GroundShape{}};
  EXPECT_EQ(covered_box(Shot(frame, from_above(), 1), frame.positions, {100, 90}).size, Eigen::Vector2i(100, 90));
}

}  // namespace
}  // namespace drape::test
