#include "sim/collision/smooth_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/random.hpp"

namespace drape {
namespace {

/// A square of 2×2 m with cells of 25 cm, so that the smallest height of a triangle is 25 cm/√2.
constexpr int cells = 8;
constexpr double height = 0.25 / 1.4142135623730951;

Cloth square(int count = cells) {
  const Mesh mesh = make_grid(count, count);
  return make_cloth(mesh, mesh, 1, 10, {});
}

std::vector<Point> places_of(const Cloth& cloth) {
  std::vector<Point> places;
  for (Eigen::Index i = 0; i < cloth.rest.rows(); ++i) places.emplace_back(cloth.rest.row(i).transpose());
  return places;
}

std::vector<Point> at_rest(const Cloth& cloth) {
  return std::vector<Point>(static_cast<std::size_t>(cloth.vertex_count()), Point::Zero());
}

/// The smallest distance of features that share no vertex, while they move, and the smallest part that any keeps of
/// what it begins with: by looking at all pairs at many times.
struct Nearness {
  double distance = INFINITY, part = INFINITY;
};
Nearness nearness(const Cloth& cloth, const std::vector<Point>& from, const std::vector<Point>& moves) {
  std::vector<std::pair<Feature, std::array<int, 4>>> pairs;
  for (int i = 0; i < cloth.vertex_count(); ++i) {
    for (const auto& [a, b, c] : cloth.triangles) {
      if (i != a && i != b && i != c) pairs.push_back({Feature::vertex_triangle, {i, a, b, c}});
    }
  }
  const std::vector<Edge> edges = unique_edges(cloth.triangles);
  for (std::size_t k = 0; k < edges.size(); ++k) {
    for (std::size_t l = k + 1; l < edges.size(); ++l) {
      const auto& [a, b] = edges[k];
      const auto& [c, d] = edges[l];
      if (a != c && a != d && b != c && b != d) pairs.push_back({Feature::edge_edge, {a, b, c, d}});
    }
  }
  Nearness found;
  for (const auto& [feature, vertices] : pairs) {
    double before = 0;
    for (const double time : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      FourPoints p;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto i = static_cast<std::size_t>(vertices[k]);
        p[k] = from[i] + time * moves[i];
      }
      const double distance = std::sqrt(nearest(feature, p).squared);
      if (time == 0) before = distance;
      found.distance = std::min(found.distance, distance);
      found.part = std::min(found.part, distance / before);
    }
  }
  return found;
}

TEST(SmoothSheet, IsApartAsFarAsItsTrianglesAreHigh) {
  const Cloth cloth = square();
  SmoothSheet sheet(cloth);
  EXPECT_TRUE(sheet.stays_apart(places_of(cloth), 0.01, at_rest(cloth), 0.99 * height));
  EXPECT_FALSE(sheet.stays_apart(places_of(cloth), 0.01, at_rest(cloth), 1.01 * height)) << "neighbours are nearer";
}

TEST(SmoothSheet, IsNearerWhereItIsShearedOrShrinks) {
  const Cloth cloth = square();
  std::vector<Point> sheared = places_of(cloth);
  for (Point& p : sheared) p.x() += 3 * p.y();
  const double near = nearness(cloth, sheared, at_rest(cloth)).distance;
  EXPECT_LT(near, 0.5 * height);
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(sheared, 0.01, at_rest(cloth), 1.01 * near));
  EXPECT_TRUE(SmoothSheet(cloth).stays_apart(sheared, 0.01, at_rest(cloth), 0.5 * near));

  const auto shrinking = [&](double part) {
    std::vector<Point> velocities = places_of(cloth);
    for (Point& velocity : velocities) velocity *= -part / 0.01;
    return SmoothSheet(cloth).stays_apart(places_of(cloth), 0.01, velocities, 0.4 * height);
  };
  EXPECT_TRUE(shrinking(0.3));
  EXPECT_FALSE(shrinking(0.7)) << "three tenths are left";
}

TEST(SmoothSheet, KnowsNothingOfWhatIsNoRectangle) {
  Cloth cloth = square();
  cloth.triangles.pop_back();
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(places_of(cloth), 0.01, at_rest(cloth), 0.01)) << "a corner is cut off";
  cloth = square();
  cloth.triangles.erase(cloth.triangles.begin() + std::ptrdiff_t{cells} * cells);
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(places_of(cloth), 0.01, at_rest(cloth), 0.01)) << "it has a hole";
  cloth = square();
  cloth.rest(cells, 2) = 0.3;
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(places_of(cloth), 0.01, at_rest(cloth), 0.01)) << "it is not flat";
}

/// Half a turn of a cylinder around the y axis, whose edges are above each other.
constexpr double radius = 2 / 3.141592653589793;
std::vector<Point> half_pipe(const Cloth& cloth) {
  std::vector<Point> places = places_of(cloth);
  for (Point& p : places) p = {radius * std::cos(p.x() / radius), p.y(), radius * std::sin(p.x() / radius)};
  return places;
}

TEST(SmoothSheet, KnowsHowFarLayersAreApart) {
  const Cloth cloth = square(20);
  SmoothSheet sheet(cloth);
  EXPECT_TRUE(sheet.stays_apart(half_pipe(cloth), 0.01, at_rest(cloth), 0.01));
  std::vector<Point> flat = half_pipe(cloth);
  for (Point& p : flat) p.z() /= 200;
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(flat, 0.01, at_rest(cloth), 0.01)) << "they are 6 mm apart";
}

// It bends evenly, and slowly enough for each of its windows.
TEST(SmoothSheet, SeesLayersThatMeet) {
  const Cloth cloth = square(20);
  const auto closing = [&](double way) {
    std::vector<Point> velocities = at_rest(cloth);
    for (int i = 0; i < cloth.vertex_count(); ++i) {
      velocities[static_cast<std::size_t>(i)].z() = -way * cloth.rest(i, 0) / 0.01;
    }
    return SmoothSheet(cloth).stays_apart(half_pipe(cloth), 0.01, velocities, 0.01);
  };
  EXPECT_TRUE(closing(0.05));
  EXPECT_FALSE(closing(1.01 * radius)) << "its edges pass through each other";
}

TEST(SmoothSheet, IsRightWheneverItSaysYes) {
  const Cloth cloth = square();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int yes = 0, no = 0;
  for (int trial = 0; trial < test::tries(60); ++trial) {
    // Waves across the cloth, and a motion of such waves.
    const double bent = 0.3 * std::abs(uniform(random)), fast = 0.1 * std::abs(uniform(random));
    const double distance = 0.06 * (1 + uniform(random)) + 1e-3;
    std::vector<Point> from = places_of(cloth), moves = at_rest(cloth);
    for (int wave = 0; wave < 3; ++wave) {
      const Point direction(uniform(random), uniform(random), uniform(random));
      const Point drift(uniform(random), uniform(random), uniform(random));
      const double u = 3 * uniform(random), v = 3 * uniform(random), shift = uniform(random);
      for (int i = 0; i < cloth.vertex_count(); ++i) {
        const double phase = u * cloth.rest(i, 0) + v * cloth.rest(i, 1) + shift;
        from[static_cast<std::size_t>(i)] += bent * std::sin(phase) * direction;
        moves[static_cast<std::size_t>(i)] += fast * std::cos(phase) * direction + drift;
      }
    }
    constexpr double h = 0.01;
    std::vector<Point> velocities = moves;
    for (Point& velocity : velocities) velocity /= h;
    SmoothSheet sheet(cloth);
    if (!sheet.stays_apart(from, h, velocities, distance)) {
      ++no;
      continue;
    }
    ++yes;
    const Nearness near = nearness(cloth, from, moves);
    EXPECT_GE(near.distance, distance * (1 - 1e-9)) << trial;
    EXPECT_GE(near.part, 0.2 - 1e-9) << trial;
  }
  EXPECT_GE(yes, test::tries(60) / 4);
  EXPECT_GE(no, test::tries(60) / 12);
}

}  // namespace
}  // namespace drape
