#include "sim/collision/smooth_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

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

Vertices at_rest(const Cloth& cloth) { return Vertices::Zero(cloth.vertex_count(), 3); }

/// The smallest distance of features that share no vertex, while they move, and the smallest part that any keeps of
/// what it begins with: by looking at all pairs at many times.
struct Nearness {
  double distance = INFINITY, part = INFINITY;
};
Nearness nearness(const Cloth& cloth, const Vertices& from, const Vertices& moves) {
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
        p[k] = (from.row(vertices[k]) + time * moves.row(vertices[k])).transpose();
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

/// A hexagon of equilateral triangles, with so many of them along a side of 1 m.
Cloth hexagon(int count) {
  std::map<std::pair<int, int>, int> numbers;
  Mesh mesh;
  mesh.positions.resize(1 + 3 * count * (count + 1), 3);
  for (int r = -count; r <= count; ++r) {
    for (int q = std::max(-count, -r - count); q <= std::min(count, count - r); ++q) {
      const int number = static_cast<int>(numbers.size());
      mesh.positions.row(number) << (q + r / 2.0) / count, r * std::sqrt(0.75) / count, 0;
      numbers[{q, r}] = number;
    }
  }
  const auto add = [&](const std::array<std::pair<int, int>, 3>& corners) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = numbers.find(corners[k]);
      if (found == numbers.end()) return;
      triangle[k] = found->second;
    }
    mesh.triangles.push_back(triangle);
  };
  for (const auto& [place, number] : numbers) {
    const auto [q, r] = place;
    add({{{q, r}, {q + 1, r}, {q, r + 1}}});
    add({{{q, r}, {q + 1, r - 1}, {q + 1, r}}});
  }
  return make_cloth(mesh, mesh, 1, 10, {});
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

TEST(SmoothSheet, KnowsNothingOfWhatIsNotConvex) {
  Cloth cloth = square();
  cloth.triangles.erase(cloth.triangles.begin() + cells / 2);
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.01)) << "it has a notch";
  cloth = square();
  cloth.triangles.erase(cloth.triangles.begin() + std::ptrdiff_t{cells} * cells);
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.01)) << "it has a hole";
  cloth = square();
  cloth.rest(cells, 2) = 0.3;
  EXPECT_FALSE(SmoothSheet(cloth).stays_apart(cloth.rest, 0.01, at_rest(cloth), 0.01)) << "it is not flat";
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

/// Waves across a square and how they move, which other waves change.
struct Waves {
  static constexpr double h = 0.01;
  Cloth cloth;
  Vertices from = cloth.rest, moves = at_rest(cloth);

  void add(double bent, double fast, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int wave = 0; wave < 3; ++wave) {
      const Eigen::RowVector3d direction(uniform(random), uniform(random), uniform(random));
      const Eigen::RowVector3d drift(uniform(random), uniform(random), uniform(random));
      const double u = 3 * uniform(random), v = 3 * uniform(random), shift = uniform(random);
      for (int i = 0; i < cloth.vertex_count(); ++i) {
        const double phase = u * cloth.rest(i, 0) + v * cloth.rest(i, 1) + shift;
        from.row(i) += bent * std::sin(phase) * direction;
        moves.row(i) += fast * std::cos(phase) * direction + drift;
      }
    }
  }
};

/// Counts what a sheet says, and looks whether it is right when it says yes.
struct Answers {
  int yes = 0, no = 0;

  void count(SmoothSheet& sheet, const Waves& waves, double distance) {
    if (!sheet.stays_apart(waves.from, Waves::h, waves.moves / Waves::h, distance)) {
      ++no;
      return;
    }
    ++yes;
    const Nearness near = nearness(waves.cloth, waves.from, waves.moves);
    EXPECT_GE(near.distance, distance * (1 - 1e-9)) << yes << " and " << no;
    EXPECT_GE(near.part, 0.2 - 1e-9) << yes << " and " << no;
  }
};

TEST(SmoothSheet, IsRightWheneverItSaysYes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Answers answers;
  for (int trial = 0; trial < test::tries(60); ++trial) {
    Waves waves{.cloth = trial % 2 == 0 ? square() : hexagon(5)};
    const double bent = 0.3 * std::abs(uniform(random)), fast = 0.1 * std::abs(uniform(random));
    const double distance = 0.06 * (1 + uniform(random)) + 1e-3;
    waves.add(bent, fast, random);
    SmoothSheet sheet(waves.cloth);
    answers.count(sheet, waves, distance);
  }
  EXPECT_GE(answers.yes, test::tries(60) / 4);
  EXPECT_GE(answers.no, test::tries(60) / 12);
}

// What it knows of a step it takes for granted in those after it, as long as the cloth has not changed by as much.
TEST(SmoothSheet, IsRightInEveryStepOfAMotion) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Answers answers;
  for (int trial = 0; trial < test::tries(12); ++trial) {
    Waves waves{.cloth = trial % 2 == 0 ? square() : hexagon(5)};
    waves.add(0.2 * std::abs(uniform(random)), 0.02, random);
    SmoothSheet sheet(waves.cloth);
    for (int step = 0; step < 12; ++step) {
      answers.count(sheet, waves, 0.04);
      waves.from += waves.moves;
      waves.add(0, 0.01, random);
    }
  }
  EXPECT_GE(answers.yes, 12 * test::tries(12) / 6);
  EXPECT_GE(answers.no, 12 * test::tries(12) / 12);
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
