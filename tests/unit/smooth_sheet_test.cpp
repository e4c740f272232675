#include "sim/collision/smooth_sheet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/sheets.hpp"

namespace drape {
namespace {

using test::at_rest;
using test::cells;
using test::cut_square;
using test::height;
using test::hexagon;
using test::holed;
using test::nearness;
using test::notched;
using test::square;

TEST(SmoothSheet, IsApartAsFarAsItsTrianglesAreHigh) {
  const Cloth cloth = square();
  SmoothSheet sheet(cloth);
  EXPECT_TRUE(sheet.stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.99 * height));
  EXPECT_FALSE(sheet.stays_apart(cloth.rest, 0.01, at_rest(cloth), 1.01 * height)) << "neighbours are nearer";
}

TEST(SmoothSheet, IsNearerWhereItIsShearedOrShrinks) {
  const Cloth cloth = square();
  Vertices sheared = cloth.rest;
  sheared.col(0) += 3 * sheared.col(1);
  const double near = nearness(cloth, sheared, at_rest(cloth)).distance;
  EXPECT_LT(near, 0.5 * height);
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(sheared, 0.01, at_rest(cloth), 1.01 * near));
  EXPECT_TRUE(SmoothSheet(cloth).stays_apart(sheared, 0.01, at_rest(cloth), 0.5 * near));

  const auto shrinking = [&](double part) {
    return SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, -part / 0.01 * cloth.rest, 0.4 * height);
  };
  EXPECT_TRUE(shrinking(0.3));
  EXPECT_FALSE(shrinking(0.7)) << "three tenths are left";
}

TEST(SmoothSheet, KnowsWhatIsConvex) {
  for (const int count : {1, 4, 7}) {
    const Cloth cloth = hexagon(count);
    const double high = std::sqrt(0.75) / count;
    EXPECT_TRUE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.99 * high)) << count;
    EXPECT_FALSE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 1.01 * high)) << count;
    Vertices folded = cloth.rest;
    folded.col(0) = folded.col(0).cwiseAbs();
    EXPECT_FALSE(SmoothSheet(cloth).stays_apart(folded, 0.01, at_rest(cloth), 0.01)) << count;
  }
  Cloth cloth = square();
  cloth.triangles.pop_back();
  EXPECT_TRUE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.01)) << "a corner is cut off";
}

TEST(SmoothSheet, FillsHolesAndNotches) {
  const Cloth corner = cut_square(cells, -0.25, 2, -0.25, 2), slit = cut_square(cells, -2, 0.6, 0, 0.25);
  for (const Cloth& cloth : {holed(), notched(), corner, slit}) {
    EXPECT_TRUE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.99 * height));
    EXPECT_FALSE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 1.01 * height));
  }
}

// Two tongues, which only the cut between them parts: 5 cm wide at its mouth, where triangles are 18 cm high.
TEST(SmoothSheet, KnowsHowWideANotchIs) {
  Mesh mesh = make_grid(cells, cells);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    const Eigen::RowVector3d middle =
        (mesh.positions.row(t[0]) + mesh.positions.row(t[1]) + mesh.positions.row(t[2])) / 3;
    return middle[0] < 0.5 && std::abs(middle[1]) < 0.25;
  });
  for (int i = 0; i < mesh.positions.rows(); ++i) {
    if (mesh.positions(i, 0) < -0.99 && std::abs(mesh.positions(i, 1)) == 0.25) mesh.positions(i, 1) /= 10;
  }
  const Cloth cloth = make_cloth(mesh, mesh, 1, 10, {});
  EXPECT_NEAR(nearness(cloth, cloth.rest, at_rest(cloth)).distance, 0.05, 1e-12);
  EXPECT_TRUE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.049));
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.051));
}

TEST(SmoothSheet, KnowsNothingOfWhatIsNotFlatOrNotOnePiece) {
  Cloth cloth = square();
  cloth.rest(cells, 2) = 0.3;
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.01)) << "it is not flat";
  cloth = cut_square(cells, -2, 2, -0.25, 0.25);
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.01)) << "it is two pieces";
  cloth = square();
  cloth.triangles.insert(cloth.triangles.end(), {cloth.triangles.back()[0], cloth.triangles.back()[2], 0});
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.01)) << "a triangle lies on others";
}

// It computes in single precision, which has seven digits and ends at 1e38.
TEST(SmoothSheet, IsRightFarAwayAndKnowsNothingOfWhatIsTooLarge) {
  const Cloth cloth = square();
  Vertices far_away = cloth.rest, huge = 1e17 * cloth.rest;
  far_away.array() += 1e6;
  EXPECT_TRUE(SmoothSheet(cloth).stays_apart(far_away, 0.01, at_rest(cloth), 0.99 * height));
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(far_away, 0.01, at_rest(cloth), 1.01 * height));
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(huge, 0.01, at_rest(cloth), 0.01));
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, huge, 0.01));
}

/// Half a turn of a cylinder around the y axis, whose edges are above each other.
constexpr double radius = 2 / 3.141592653589793;
Vertices half_pipe(const Cloth& cloth) {
  Vertices places = cloth.rest;
  places.col(0) = radius * (cloth.rest.col(0) / radius).array().cos();
  places.col(2) = radius * (cloth.rest.col(0) / radius).array().sin();
  return places;
}

TEST(SmoothSheet, KnowsHowFarLayersAreApart) {
  const Cloth cloth = square(20);
  SmoothSheet sheet(cloth);
  EXPECT_TRUE(sheet.stays_apart(half_pipe(cloth), 0.01, at_rest(cloth), 0.01));
  Vertices flat = half_pipe(cloth);
  flat.col(2) /= 200;
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(flat, 0.01, at_rest(cloth), 0.01)) << "they are 6 mm apart";
}

// It bends evenly, and slowly enough for each of its windows.
TEST(SmoothSheet, SeesLayersThatMeet) {
  const Cloth cloth = square(20);
  const auto closing = [&](double way) {
    Vertices velocities = at_rest(cloth);
    velocities.col(2) = -way / 0.01 * cloth.rest.col(0);
    return SmoothSheet(cloth).stays_apart(half_pipe(cloth), 0.01, velocities, 0.01);
  };
  EXPECT_TRUE(closing(0.05));
  EXPECT_FALSE(closing(1.01 * radius)) << "its edges pass through each other";
}

// Half a pipe is bent together until its edges meet, ever faster.
TEST(SmoothSheet, SeesInTimeThatLayersMeet) {
  const Cloth cloth = square(20);
  for (const double start : {0.002, 0.01, 0.05}) {
    SmoothSheet sheet(cloth);
    Vertices x = half_pipe(cloth);
    double left = 2 * radius;  // between the edges
    int certain = 0;
    for (double way = start; left > 2 * way; way *= 1.1) {
      const Vertices moves = Eigen::Vector3d(0, 0, -way)
                                 .transpose()
                                 .replicate(cloth.vertex_count(), 1)
                                 .cwiseProduct(cloth.rest.col(0).replicate(1, 3));
      const bool apart = sheet.stays_apart(x, 0.01, moves / 0.01, 0.01);
      certain += static_cast<int>(apart);
      x += moves;
      left -= 2 * way;
      if (left < 0.01) {
        EXPECT_FALSE(apart) << left << " m after a step of " << way << " m";
      }
    }
    Vertices through = at_rest(cloth);
    through.col(2) = -cloth.rest.col(0);
    EXPECT_FALSE(sheet.stays_apart(x, 0.01, through / 0.01, 0.01));
    EXPECT_GE(certain, 4) << start;
  }
}

}  // namespace
}  // namespace drape
