#include "sim/spring_network.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "drape/sim/mesh.hpp"
#include "tests/support/scene_folder.hpp"
#include "tests/support/setups.hpp"

namespace drape::grid_springs_test {
namespace {

constexpr double modulus = 300;

/// Returns the in-plane elasticity of a cloth for small strains xx, yy and √2 xy: Σ k l² m mᵀ per area.
Eigen::Matrix3d elasticity(const Cloth& cloth) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Spring& s : cloth.springs) {
    const Eigen::RowVector3d n = (cloth.rest.row(s.j) - cloth.rest.row(s.i)).normalized();
    const Eigen::Vector3d m(n.x() * n.x(), n.y() * n.y(), std::numbers::sqrt2 * n.x() * n.y());
    sum += s.stiffness * s.rest_length * s.rest_length * m * m.transpose();
  }
  const Eigen::RowVector3d size = cloth.rest.colwise().maxCoeff() - cloth.rest.colwise().minCoeff();
  return sum / (size.x() * size.y());
}

/// Returns the force per width and strain of a pull at an angle, with free sides.
double pulled(const Cloth& cloth, double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const Eigen::Vector3d m(c * c, s * s, std::numbers::sqrt2 * c * s);
  return 1 / m.dot(elasticity(cloth).inverse() * m);
}

Cloth grid_cloth(GridPattern pattern, double width) {
  const Mesh mesh = make_grid({.columns = 8, .rows = 6, .pattern = pattern, .size = Eigen::Vector2d(8 * width, 6)});
  return test::cloth_of(mesh, 1, 1, {});
}

class EvenGrid : public testing::TestWithParam<GridPattern> {};
INSTANTIATE_TEST_SUITE_P(, EvenGrid, testing::Values(GridPattern::alternating, GridPattern::x));

// Isotropic with E and 1/3: 9/8 E along a held strain, 3/8 E across it, and 3/4 E for √2 xy.
TEST_P(EvenGrid, IsTheSameInAllDirections) {
  for (const double width : {1.0, 1.6, 0.6}) {
    Cloth cloth = grid_cloth(GetParam(), width);
    stiffen_evenly(modulus, cloth);
    Eigen::Matrix3d expected;
    expected << 1.125, 0.375, 0, 0.375, 1.125, 0, 0, 0, 0.75;
    EXPECT_LT((elasticity(cloth) / modulus - expected).cwiseAbs().maxCoeff(), 1e-12) << width;
    for (const double degrees : {0.0, 22.5, 45.0, 70.0}) EXPECT_NEAR(pulled(cloth, degrees), modulus, 1e-9);
  }
}

TEST_P(EvenGrid, OfCellsTooLongHasNoSpringThatPushes) {
  Cloth cloth = grid_cloth(GetParam(), 3), by_area = cloth;
  stiffen_evenly(modulus, cloth);
  stiffen_by_area(modulus, by_area);
  for (std::size_t s = 0; s < cloth.springs.size(); ++s) {
    EXPECT_EQ(cloth.springs[s].stiffness, by_area.springs[s].stiffness);
  }
}

// The table in docs/reference/scene-format.md.
TEST(DiagonalGrid, IsThreeTimesAsStiffAcrossItsDiagonals) {
  Cloth cloth = grid_cloth(GridPattern::diagonal, 1);
  stiffen_by_area(modulus, cloth);
  EXPECT_NEAR(pulled(cloth, 0) / modulus, 1, 1e-9);
  EXPECT_NEAR(pulled(cloth, 22.5) / modulus, 0.453, 1e-3);
  EXPECT_NEAR(pulled(cloth, 45) / modulus, 1.0 / 3, 1e-9);
  EXPECT_NEAR(pulled(cloth, -22.5) / modulus, 1.261, 1e-3);
  EXPECT_NEAR(pulled(cloth, -45) / modulus, 1, 1e-9);
}

TEST(SceneSprings, OfAGridHaveTheirOwnStiffnesses) {
  const test::SceneFolder folder;
  const Cloth cloth = folder
                          .load(
                              "[cloth]\nmesh = { grid = [3, 4], size = [3, 8] }\nspring = \"edges+bend\"\n"
                              "stiffness = 7\nshear_stiffness = 5\nbend_stiffness = 2\n")
                          .simulation.cloth;
  int structural = 0, shear = 0, bend = 0;
  for (const Spring& s : cloth.springs) {
    const Eigen::RowVector3d along = (cloth.rest.row(s.j) - cloth.rest.row(s.i)).cwiseAbs();
    EXPECT_DOUBLE_EQ(s.rest_length, along.norm());
    EXPECT_LT(s.i, s.j);
    const Eigen::RowVector2i cells(static_cast<int>(std::lround(along.x())),
                                   static_cast<int>(std::lround(along.y() / 2)));
    EXPECT_EQ(s.stiffness, cells.sum() == 1 ? 7 : cells.maxCoeff() == 2 ? 2 : 5);
    structural += cells.sum() == 1 ? 1 : 0;
    shear += cells == Eigen::RowVector2i(1, 1) ? 1 : 0;
    bend += cells.sum() == 2 && cells.maxCoeff() == 2 ? 1 : 0;
  }
  EXPECT_EQ(structural, 3 * 5 + 4 * 4);
  EXPECT_EQ(shear, 2 * 3 * 4);
  EXPECT_EQ(bend, 2 * 5 + 4 * 3);
  EXPECT_EQ(cloth.springs.size(), static_cast<std::size_t>(structural + shear + bend));
}

TEST(SceneSprings, OfAGridNeedOne) {
  const test::SceneFolder folder;
  const auto problem = [&](const std::string& mesh, const std::string& keys) {
    return folder.problems("[cloth]\nmesh = { " + mesh + " }\n" + keys);
  };
  EXPECT_EQ(problem("grid = [2, 2], pattern = \"x\"", "spring = \"edges+bend\"\nstiffness = 1\n"),
            "scene.toml:3:10: spring: \"edges+bend\" needs a grid, of pattern \"diagonal\" or \"alternating\"");
  EXPECT_EQ(problem("grid = [2, 2]", "spring = \"edges+bend\"\nmodulus = 1\n"),
            "scene.toml:3:10: spring: \"edges+bend\" needs a 'stiffness'");
  EXPECT_EQ(problem("grid = [2, 2]", "bend_stiffness = 1\nstiffness = 1\n"),
            "scene.toml:3:18: bend_stiffness: only with spring = \"edges+bend\"");
}

TEST(SceneSprings, OfMaterialsAreEvenOnGridsOfBothDiagonals) {
  const test::SceneFolder folder;
  const auto cloth = [&](const std::string& pattern) {
    return folder
        .load("[cloth]\nmesh = { grid = [16, 16], pattern = \"" + pattern + "\" }\ndensity = 0.2\nmodulus = 300\n")
        .simulation.cloth;
  };
  for (const char* pattern : {"alternating", "x"}) {
    for (const double degrees : {0.0, 30.0, 45.0}) EXPECT_NEAR(pulled(cloth(pattern), degrees), modulus, 1e-9);
  }
  EXPECT_NEAR(pulled(cloth("diagonal"), 45), modulus / 3, 1e-9);
  EXPECT_NEAR(pulled(cloth("equilateral"), 20), modulus, 0.05 * modulus);
}

}  // namespace
}  // namespace drape::grid_springs_test
