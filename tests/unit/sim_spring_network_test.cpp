#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <vector>

#include "sim/spring_network.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/plain_springs.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test::sim_spring_network {
namespace {

struct Case {
  int vertices;
  std::vector<Spring> springs;
};

Spring random_spring(Random& random, int i, int j) {
  return {.i = i, .j = j, .rest_length = random.between(0, 0.5), .stiffness = random.between(1, 500)};
}

Case springs_of(const Mesh& mesh) {
  Case result{static_cast<int>(mesh.positions.rows()), cloth_of(mesh, 1, 180, {}).springs};
  Random random;
  for (Spring& spring : result.springs) spring.stiffness = random.between(1, 500);
  return result;
}

/// Makes springs (i, i + offset) in runs of every length, separated by gaps of every size.
Case runs_and_gaps() {
  Case result{0, {}};
  Random random;
  int i = 0;
  for (const int length : {1, 2, 3, 7, 8, 15, 16, 17, 20, 33, 64, 255, 256, 257, 300, 520}) {
    for (int t = 0; t < length; ++t) result.springs.push_back(random_spring(random, i + t, i + t + 5));
    i += length + length % 6;
  }
  result.vertices = i + 6;
  return result;
}

Case duplicates() {
  Case result = springs_of(make_grid(20, 6));
  Random random;
  const std::size_t count = result.springs.size();
  for (std::size_t s = 0; s < count; s += 2) {
    for (int copy = 0; copy < 1 + static_cast<int>(s) % 3; ++copy) {
      result.springs.push_back(random_spring(random, result.springs[s].i, result.springs[s].j));
    }
  }
  return result;
}

Case shuffled() {
  Case result = springs_of(make_grid(13, 9));
  Random random;
  for (std::size_t s = result.springs.size(); s > 1; --s) {
    std::swap(result.springs[s - 1], result.springs[static_cast<std::size_t>(random.below(static_cast<int>(s)))]);
  }
  return result;
}

Case scattered() {
  Case result{500, {}};
  Random random;
  for (int s = 0; s < 1500; ++s) {
    const int i = random.below(499);
    result.springs.push_back(random_spring(random, i, i + 1 + random.below(499 - i)));
  }
  return result;
}

double energy_of(const SpringNetwork& network, const Vertices& x) {
  Vertices ignored = Vertices::Zero(x.rows(), 3);
  return network.add_value_gradient(x, ignored);
}

/// Case that only its tests make: every process lists all tests first.
struct NamedCase {
  const char* name;
  Case (*make)();
};
void PrintTo(const NamedCase& tested, std::ostream* out) { *out << tested.name; }

constexpr NamedCase cases[] = {
    {"HomeworksGrid", [] { return springs_of(make_grid(20, 20)); }},
    {"LongGrid", [] { return springs_of(make_grid(300, 2)); }},
    {"SmallGrid", [] { return springs_of(make_grid(1, 1)); }},
    {"Irregular", [] { return springs_of(irregular_mesh(15)); }},
    {"ThreeTrianglesOnAnEdge", [] { return springs_of(three_sheets(9)); }},
    {"RunsAndGaps", runs_and_gaps},
    {"Duplicates", duplicates},
    {"Shuffled", shuffled},
    {"Scattered", scattered},
    {"Single",
     [] {
       Random random;
       return Case{2, {random_spring(random, 0, 1)}};
     }},
    {"Empty",
     [] {
       return Case{3, {}};
     }},
};

class SpringNetworkOf : public testing::TestWithParam<NamedCase> {
 protected:
  const Case case_ = GetParam().make();
};
INSTANTIATE_TEST_SUITE_P(Springs, SpringNetworkOf, testing::ValuesIn(cases),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(SpringNetworkOf, HasTheEnergyOfTheFormula) {
  const Vertices x = random_vertices(case_.vertices, 77);
  const double expected = plain_energy(case_.springs, x);
  EXPECT_NEAR(energy_of(SpringNetwork(case_.springs, case_.vertices), x), expected, 1e-13 * expected);
}

TEST_P(SpringNetworkOf, AddsTheGradientOfTheFormula) {
  const Vertices x = random_vertices(case_.vertices, 77);
  const Vertices already = random_vertices(case_.vertices, 78);
  Vertices gradient = already;
  const SpringNetwork network(case_.springs, case_.vertices);
  const double value = network.add_value_gradient(x, gradient);
  const Vertices expected = already + plain_gradient(case_.springs, x);
  EXPECT_LE((gradient - expected).cwiseAbs().maxCoeff(), 1e-13 * (1 + expected.cwiseAbs().maxCoeff()));
  EXPECT_NEAR(value, plain_energy(case_.springs, x), 1e-13 * value);
}

TEST_P(SpringNetworkOf, AddsInertiaToTheObjective) {
  const Vertices x = random_vertices(case_.vertices, 77), y = random_vertices(case_.vertices, 78);
  const Eigen::VectorXd inertia = random_vertices(case_.vertices, 79).col(0).cwiseAbs();
  Vertices gradient = Vertices::Constant(x.rows(), 3, 1e9);  // old content is overwritten
  const double value = SpringNetwork(case_.springs, case_.vertices).evaluate(inertia, y, x, gradient);
  const Vertices pull = (x - y).array().colwise() * inertia.array();
  const Vertices expected = plain_gradient(case_.springs, x) + pull;
  EXPECT_LE((gradient - expected).cwiseAbs().maxCoeff(), 1e-13 * (1 + expected.cwiseAbs().maxCoeff()));
  const double energy = plain_energy(case_.springs, x) + 0.5 * pull.cwiseProduct(x - y).sum();
  EXPECT_NEAR(value, energy, 1e-13 * energy);
}

TEST_P(SpringNetworkOf, KicksWithTheGradientOfWhereTheClothWas) {
  const Vertices start = random_vertices(case_.vertices, 77), velocity = random_vertices(case_.vertices, 78);
  const Vertices force = random_vertices(case_.vertices, 79);
  const Eigen::VectorXd factor = random_vertices(case_.vertices, 80).col(0);
  constexpr double h = 0.01;
  constexpr double before = 0.9, after = 0.8;
  Vertices x = start, v = velocity;
  const double squares = SpringNetwork(case_.springs, case_.vertices)
                             .kick_and_drift(factor, force, {.h = h, .before = before, .after = after}, v, x);
  const Vertices change = (plain_gradient(case_.springs, start) - force).array().colwise() * factor.array();
  const Vertices moving = before * (velocity + change);
  EXPECT_LE((v - after * moving).cwiseAbs().maxCoeff(), 1e-13 * (1 + change.cwiseAbs().maxCoeff()));
  EXPECT_LE((x - start - h * moving).cwiseAbs().maxCoeff(), 1e-13 * (1 + moving.cwiseAbs().maxCoeff()));
  EXPECT_NEAR(squares, x.squaredNorm(), 1e-13 * squares);
}

TEST_P(SpringNetworkOf, HasTheGradientOfItsEnergy) {
  if (case_.springs.empty()) return;
  const SpringNetwork network(case_.springs, case_.vertices);
  const Vertices x = random_vertices(case_.vertices, 77);
  Vertices gradient = Vertices::Zero(x.rows(), 3);
  network.add_value_gradient(x, gradient);
  // Along a direction that differs at every vertex: (E(x + εd) − E(x − εd))/2ε has an error of ε²‖E'''‖/6 plus the
  // rounding of E over ε.
  constexpr double epsilon = 1e-6;
  for (const int seed : {1, 2, 3}) {
    const Vertices direction = random_vertices(x.rows(), seed);
    const double slope =
        (energy_of(network, x + epsilon * direction) - energy_of(network, x - epsilon * direction)) / (2 * epsilon);
    const double scale = gradient.cwiseProduct(direction).cwiseAbs().sum();
    EXPECT_NEAR(slope, gradient.cwiseProduct(direction).sum(), 1e-7 * scale);
  }
}

TEST_P(SpringNetworkOf, RemembersTheSpringsAsGiven) {
  const SpringNetwork network(case_.springs, case_.vertices);
  ASSERT_EQ(network.springs().size(), case_.springs.size());
  for (std::size_t s = 0; s < case_.springs.size(); ++s) {
    EXPECT_EQ(network.springs()[s].i, case_.springs[s].i);
    EXPECT_EQ(network.springs()[s].j, case_.springs[s].j);
  }
}

TEST(SpringNetwork, PullsNowhereBetweenVerticesInOnePlace) {
  const Mesh grid = make_grid(20, 4);
  const std::vector<Spring> springs = cloth_of(grid, 1, 180, {}).springs;
  const SpringNetwork network(springs, static_cast<int>(grid.positions.rows()));
  const Vertices x = Vertices::Constant(grid.positions.rows(), 3, 0.25);
  Vertices gradient = Vertices::Zero(x.rows(), 3);
  network.add_value_gradient(x, gradient);
  EXPECT_EQ(gradient.cwiseAbs().maxCoeff(), 0);
  EXPECT_NEAR(energy_of(network, x), plain_energy(springs, x), 1e-13 * energy_of(network, x));
}

TEST(SpringNetwork, StaysFiniteHoweverNearTwoVerticesAre) {
  const SpringNetwork network({{.i = 0, .j = 1, .rest_length = 0.5, .stiffness = 100}}, 2);
  for (const double distance : {1e-8, 1e-20, 1e-100, 1e-139, 1e-140, 1e-141, 1e-160, 1e-300, 5e-324}) {
    Vertices x = Vertices::Zero(2, 3), gradient = Vertices::Zero(2, 3);
    x(1, 0) = distance;
    network.add_value_gradient(x, gradient);
    EXPECT_TRUE(gradient.allFinite()) << distance;
    EXPECT_LE(gradient.cwiseAbs().maxCoeff(), 50 * (1 + 1e-15)) << "no more than the force at length zero";
    EXPECT_NEAR(energy_of(network, x), 100 * 0.25 / 2, 1e-6);
  }
}

TEST(SpringNetwork, OfRestLengthZeroIsLinear) {
  const SpringNetwork network({{.i = 0, .j = 1, .rest_length = 0, .stiffness = 100}}, 2);
  Vertices x = Vertices::Zero(2, 3), gradient = Vertices::Zero(2, 3);
  x.row(1) << 1, 2, -3;
  network.add_value_gradient(x, gradient);
  EXPECT_LT((gradient.row(1) - 100 * x.row(1)).norm(), 1e-12);
  EXPECT_LT((gradient.row(0) + 100 * x.row(1)).norm(), 1e-12);
}

}  // namespace
}  // namespace drape::test::sim_spring_network
