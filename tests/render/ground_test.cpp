#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "drape/render/view.hpp"
#include "render/shadows.hpp"
#include "render/shot.hpp"
#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

const GroundShape level{{0, 0, 1}, -1, 0.02};

/// Returns the light blocked by the shadow at a point of the ground, 0 to 1.
double taken(const GroundShadow& shadow, const Vector3d& point) {
  const Vector4d p(point[0], point[1], point[2], 1);
  const int column = static_cast<int>(std::floor(shadow.u().dot(p) * shadow.columns()));
  const int row = static_cast<int>(std::floor(shadow.v().dot(p) * shadow.rows()));
  if (column < 0 || row < 0 || column >= shadow.columns() || row >= shadow.rows()) return 0;
  return shadow.pixels()[static_cast<std::size_t>(row) * static_cast<std::size_t>(shadow.columns()) +
                         static_cast<std::size_t>(column)] /
         65535.0;
}

/// Casts the shadow of a mesh, with a map of texels of half a centimetre.
GroundShadow cast(const Mesh& mesh, const GroundShape& ground, const Vector3d& to_light) {
  DepthMap map;
  map.look(to_light, Vector3d::UnitY());
  map.draw(mesh.positions, mesh.triangles, 0.005, 1024);
  GroundShadow shadow;
  shadow.cast(map, ground, to_light, 0.3);
  return shadow;
}

/// Returns the area of the shadow on a ground [m²].
double area(const GroundShadow& shadow, const GroundShape& ground, const Vector3d& to_light) {
  double sum = 0;
  for (const std::uint16_t pixel : shadow.pixels()) sum += pixel / 65535.0;
  const double width = 1 / (shadow.columns() * shadow.u().head<3>().norm());
  const double height = 1 / (shadow.rows() * shadow.v().head<3>().norm());
  return sum * width * height / ground.normal.dot(to_light);
}

TEST(GroundShadow, LiesWhereTheLightIsHeldUp) {
  const Mesh square = make_grid(4, 4);  // of 2 m × 2 m, a metre above the ground
  const Vector3d above(0, 0, 1), aside = Vector3d(1, 0, 1).normalized();
  GroundShadow shadow = cast(square, level, above);
  EXPECT_NEAR(taken(shadow, {0, 0, -1}), 1, 1e-3);
  EXPECT_NEAR(taken(shadow, {1, 0, -1}), 0.5, 0.1) << "the middle of its edge";
  EXPECT_EQ(taken(shadow, {1.6, 0, -1}), 0);
  EXPECT_NEAR(area(shadow, level, above), 4, 0.05);

  // Light from +x at 45° moves it by a metre towards −x.
  shadow = cast(square, level, aside);
  EXPECT_NEAR(taken(shadow, {-1, 0, -1}), 1, 1e-3);
  EXPECT_NEAR(taken(shadow, {-1.9, 0.5, -1}), 1, 0.15);
  EXPECT_LT(taken(shadow, {0.3, 0, -1}), 0.1);
  EXPECT_NEAR(area(shadow, level, aside), 4, 0.05);
}

TEST(GroundShadow, LiesOnTiltedGroundsToo) {
  const Mesh square = make_grid(4, 4);
  const Vector3d normal = Vector3d(1, 0, 2).normalized();
  const GroundShape tilted{normal, -1, 0.02};
  const GroundShadow shadow = cast(square, tilted, normal);
  EXPECT_NEAR(taken(shadow, -normal), 1, 1e-3);
  EXPECT_NEAR(area(shadow, tilted, normal), 4 * normal[2], 0.05);
  for (const Vector3d& corner : shadow.corners(tilted)) EXPECT_NEAR(normal.dot(corner), -1, 1e-12);
}

TEST(GroundShadow, ItsEdgeIsSharperWhereTheClothIsNear) {
  Mesh square = make_grid(4, 4);
  const auto softness = [&](double height) {
    square.positions.col(2).setConstant(-1 + height);
    const GroundShadow shadow = cast(square, level, Vector3d(0, 0, 1));
    return taken(shadow, {0.95, 0, -1}) - taken(shadow, {1.05, 0, -1});
  };
  EXPECT_GT(softness(0.0), 1.5 * softness(1.5));
}

TEST(GroundShadow, IsOnlyOfWhatTheGroundDoesNotHide) {
  const Vector3d aside = Vector3d(1, 0, 1).normalized();
  Mesh square = make_grid(4, 4);
  square.positions.col(2).setConstant(level.height - 2 * level.thickness);  // penetrates, but is drawn
  EXPECT_NEAR(area(cast(square, level, aside), level, aside), 4, 0.05);
  square.positions.col(2).setConstant(level.height - 4 * level.thickness);
  EXPECT_EQ(area(cast(square, level, aside), level, aside), 0);
}

TEST(GroundShadow, SurvivesAClothWithoutASize) {
  Mesh point = make_grid(1, 1);
  point.positions.setZero();
  const GroundShadow shadow = cast(point, level, Vector3d(0, 0, 1));
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
  look.background = Rgb{0.2, 0.4, 0.6};
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
  look.background = Rgb{1, 1, 1};
  look.ground_grid = 0;
  const auto brightness = [&](const Mesh& mesh, const std::vector<Collider>& colliders) {
    const Image image = draw(mesh, from_the_side(), look, {240, 200}, colliders);
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / static_cast<double>(image.pixels.size());
  };
  EXPECT_LT(brightness(make_grid(4, 4), {level}), brightness(make_grid(4, 4), {}) - 5);
  // A ball above the middle also darkens the ground beside its own picture.
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

// The ground is drawn with shadows only where they may lie; the border of that part is invisible.
TEST(Ground, ShadowsEndSoftly) {
  Look look;
  look.ground_grid = 0;
  Mesh sheet = make_grid(4, 4);
  sheet.positions = (0.3 * sheet.positions).rowwise() + Eigen::RowVector3d(-1.6, 0.8, 2.6);
  const View view = from_the_side();
  for (const double height : {0.5, 2.0, 4.0}) {
    const Vector3d light = Shot(Frame{}, view, 1.2).key_direction.cast<double>().normalized();
    const Vector3d center = Vector3d(0, 0, -1) + height / light[2] * light;
    const Image image = draw(sheet, view, look, {240, 200}, {level, SphereShape{center, 0.4}});
    const Image without = draw(nothing(), view, look, {240, 200}, {level});
    int darker = 0;
    for (int y = 100; y < 200; ++y) {
      for (int x = 1; x < 240; ++x) {
        const auto is_ground = [&](int column) {
          return std::abs(image.at(column, y)[0] - image.at(column, y)[2]) < 12;
        };
        if (!is_ground(x) || !is_ground(x - 1)) continue;
        darker += image.at(x, y)[1] < without.at(x, y)[1] - 10 ? 1 : 0;
        ASSERT_LT(std::abs(image.at(x, y)[1] - image.at(x - 1, y)[1]), height < 1 ? 60 : 14) << x << ", " << y;
      }
    }
    EXPECT_GT(darker, 200) << height;
  }
}

// Invisible specks far away extend the part drawn with shadows to the whole picture. The cloth is hidden in the ball.
TEST(Ground, HasAllOfABallsShadow) {
  const View view = from_the_side();
  const Vector3d light = Shot(Frame{}, view, 1.2).key_direction.cast<double>().normalized();
  for (const double height : {0.5, 2.0, 4.0}) {
    const Vector3d center = Vector3d(0, 0, -1) + height / light[2] * light;
    Mesh within = make_grid(4, 4);
    within.positions = (0.05 * within.positions).rowwise() + center.transpose();
    std::vector<Collider> colliders{level, SphereShape{center, 0.4}};
    const Image part = draw(within, view, Look{}, {240, 200}, colliders);
    for (const double side : {-50.0, 50.0}) colliders.emplace_back(SphereShape{{side, side, -1}, 1e-6});
    const Image whole = draw(within, view, Look{}, {240, 200}, colliders);
    int most = 0;
    for (std::size_t i = 0; i < part.pixels.size(); ++i) {
      most = std::max(most, std::abs(part.pixels[i] - whole.pixels[i]));
    }
    EXPECT_LE(most, 1) << "at a height of " << height << " m";
  }
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
