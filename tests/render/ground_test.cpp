#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "render/ground_shadow.hpp"
#include "render/view.hpp"
#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

const GroundShape level{{0, 0, 1}, -1, 0.02};

/// How much light the shadow takes at a point of the ground, 0 to 1.
double taken(const GroundShadow& shadow, const Vector3d& point) {
  const Vector4d p(point[0], point[1], point[2], 1);
  const int column = static_cast<int>(shadow.u().dot(p) * GroundShadow::size);
  const int row = static_cast<int>(shadow.v().dot(p) * GroundShadow::size);
  if (column < 0 || row < 0 || column >= GroundShadow::size || row >= GroundShadow::size) return 0;
  return shadow.pixels()[static_cast<std::size_t>(row * GroundShadow::size + column)] / 65535.0;
}

/// The area of the shadow [m²].
double area(const GroundShadow& shadow) {
  double sum = 0;
  for (const std::uint16_t pixel : shadow.pixels()) sum += pixel / 65535.0;
  const double texel = 1 / (GroundShadow::size * shadow.u().head<3>().norm());
  return sum * texel * texel;
}

TEST(GroundShadow, LiesWhereTheLightIsHeldUp) {
  const Mesh square = make_grid(4, 4);  // of 2 m × 2 m, a metre above the ground
  GroundShadow shadow(square.triangles);
  shadow.cast(square.positions, level, Vector3d(0, 0, 1));
  EXPECT_NEAR(taken(shadow, {0, 0, -1}), 1, 1e-3);
  EXPECT_NEAR(taken(shadow, {1, 0, -1}), 0.5, 0.1) << "the middle of its edge";
  EXPECT_EQ(taken(shadow, {1.6, 0, -1}), 0);
  EXPECT_NEAR(area(shadow), 4, 0.05);

  // Light from +x at 45° throws it a metre towards −x.
  shadow.cast(square.positions, level, Vector3d(1, 0, 1).normalized());
  EXPECT_NEAR(taken(shadow, {-1, 0, -1}), 1, 1e-3);
  EXPECT_NEAR(taken(shadow, {-1.9, 0.5, -1}), 1, 0.15);
  EXPECT_LT(taken(shadow, {0.3, 0, -1}), 0.1);
  EXPECT_NEAR(area(shadow), 4, 0.05);
}

TEST(GroundShadow, LiesOnTiltedGroundsToo) {
  const Mesh square = make_grid(4, 4);
  GroundShadow shadow(square.triangles);
  const Vector3d normal = Vector3d(1, 0, 2).normalized();
  shadow.cast(square.positions, {normal, -1, 0.02}, normal);
  EXPECT_NEAR(taken(shadow, -normal), 1, 1e-3);
  EXPECT_NEAR(area(shadow), 4 * normal[2], 0.05);
}

TEST(GroundShadow, ItsEdgeIsSharperWhereTheClothIsNear) {
  Mesh square = make_grid(4, 4);
  GroundShadow shadow(square.triangles);
  const auto softness = [&](double height) {
    square.positions.col(2).setConstant(-1 + height);
    shadow.cast(square.positions, level, Vector3d(0, 0, 1));
    return taken(shadow, {0.95, 0, -1}) - taken(shadow, {1.05, 0, -1});
  };
  EXPECT_GT(softness(0.0), 1.5 * softness(1.5));
}

TEST(GroundShadow, SurvivesAClothWithoutASize) {
  Mesh point = make_grid(1, 1);
  point.positions.setZero();
  GroundShadow shadow(point.triangles);
  shadow.cast(point.positions, level, Vector3d(0, 0, 1));
  EXPECT_EQ(std::accumulate(shadow.pixels().begin(), shadow.pixels().end(), 0L), 0);
}

TEST(Ground, IsNotFramed) {
  Framing framing({}, 1.2);
  framing.add(Collider(level));
  EXPECT_TRUE(framing.empty());
}

View from_the_side() { return {{0, -8, 3}, {0, 0, -0.5}, {0, 0, 1}, 30}; }

TEST(Ground, FadesIntoTheBackground) {
  Look look;
  look.background = {0.2, 0.4, 0.6};
  look.ground_grid = 0;
  View view = from_the_side();
  view.target = {0, 0, 2.5};  // the horizon is in the picture
  const Image image = draw(nothing(), view, look, {120, 400}, {level});
  EXPECT_EQ(image.at(60, 0)[2], 153) << "the sky has the background's bytes";
  EXPECT_NE(image.at(60, 399)[2], 153) << "below, there is ground";
  for (int y = 1; y < 400; ++y) {
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_LT(std::abs(image.at(60, y)[channel] - image.at(60, y - 1)[channel]), 12) << "no edge at row " << y;
    }
  }
}

TEST(Ground, CarriesTheShadowOfWhatIsAboveIt) {
  Look look;
  look.ground_grid = 0;
  const auto brightness = [&](const Mesh& mesh, const std::vector<Collider>& colliders) {
    const Image image = draw(mesh, from_the_side(), look, {240, 200}, colliders);
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / static_cast<double>(image.pixels.size());
  };
  EXPECT_LT(brightness(make_grid(4, 4), {level}), brightness(make_grid(4, 4), {}) - 5);
  // A ball above the middle darkens the ground beside its own picture as well.
  const Image with = draw(nothing(), from_the_side(), look, {240, 200}, {level, SphereShape{{0, 0, 0}, 0.5}});
  const Image without = draw(nothing(), from_the_side(), look, {240, 200}, {level});
  int darker = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 240; ++x) {
      const bool red = with.at(x, y)[0] > with.at(x, y)[1] + 30;
      darker += !red && with.at(x, y)[0] + 20 < without.at(x, y)[0] ? 1 : 0;
    }
  }
  EXPECT_GT(darker, 300);
}

TEST(Ground, HidesWhatIsBelowItAndIsNotSeenFromThere) {
  Look look;
  Mesh below = make_grid(2, 2);
  below.positions.col(2).setConstant(-2);
  Look red = look;
  red.color = {1, 0, 0};
  const Image plain = draw(nothing(), from_the_side(), red, {120, 100}, {level});
  const Image hiding = draw(below, from_the_side(), red, {120, 100}, {level});
  int reddish = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 120; ++x) reddish += hiding.at(x, y)[0] > hiding.at(x, y)[1] + 60 ? 1 : 0;
  }
  EXPECT_EQ(reddish, 0);

  View from_below = from_the_side();
  from_below.position[2] = -4;
  EXPECT_EQ(draw(below, from_below, red, {120, 100}, {level}).pixels,
            draw(below, from_below, red, {120, 100}, {}).pixels);
}

TEST(Ground, ASphereIsCutWhereItIsSunk) {
  Look look;
  look.sphere_color = {1, 0, 0};
  look.ground_grid = 0;
  const auto red_pixels = [&](const std::vector<Collider>& colliders) {
    const Image image = draw(nothing(), from_the_side(), look, {240, 200}, colliders);
    int count = 0;
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 240; ++x) count += image.at(x, y)[0] > image.at(x, y)[1] + 60 ? 1 : 0;
    }
    return count;
  };
  const SphereShape half_sunk{{0, 0, -1}, 0.6};
  const int whole = red_pixels({half_sunk}), cut = red_pixels({half_sunk, level});
  EXPECT_GT(cut, whole / 2) << "seen from above, more than half of it";
  EXPECT_LT(cut, 0.8 * whole);
}

TEST(Ground, TwoOfThemMeetWhereTheyCross) {
  Look look;
  look.ground_grid = 0;
  const GroundShape ramp{Vector3d(1, 0, 1).normalized(), -std::sqrt(0.5), 0.02};  // meets the level one at x = 0
  const View view = from_the_side();
  const Image both = draw(nothing(), view, look, {240, 200}, {level, ramp});
  const Image other = draw(nothing(), view, look, {240, 200}, {ramp, level});
  EXPECT_EQ(both.pixels, other.pixels) << "the order does not matter";
  const Image alone = draw(nothing(), view, look, {240, 200}, {level});
  EXPECT_EQ(both.at(200, 150)[0], alone.at(200, 150)[0]) << "at the right the level one is above";
  EXPECT_NE(both.at(40, 150)[0], alone.at(40, 150)[0]);
}

}  // namespace
}  // namespace drape::test
