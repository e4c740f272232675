// A cloth defined by density, modulus and rigidity is independent of its mesh: compared with elasticity theory for
// strips and sheets.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "drape/sim/effects/bending.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"
#include "tests/support/sheets_to_bend.hpp"

namespace drape::materials_test {
namespace {

using test::cloth_of;
using test::setup;

constexpr double g = 9.8, density = 0.2;
constexpr double weight = density * g;  // per area [N/m²]

/// Makes a cloth of a mesh from values per area.
Cloth by_area(const Mesh& mesh, double modulus, std::vector<int> pins) {
  Cloth cloth = cloth_of(mesh, 1, 1, std::move(pins));
  share_mass_by_area(density, cloth);
  stiffen_by_area(modulus, cloth);
  return cloth;
}

/// Returns a cloth at rest, after steps so long that backward Euler removes all motion.
Vertices at_rest(Cloth cloth, Effects effects, Method method = Method::quasi_newton) {
  SimulationSettings settings = setup(std::move(cloth), method, 0.5);
  settings.effects = std::move(effects);
  settings.effects.add(Gravity{.acceleration = {0, 0, -g}});
  settings.integrator.stop = StoppingRule::gradient;
  settings.integrator.tolerance = 1e-5;
  settings.integrator.max_iterations = 20000;
  Simulation simulation(std::move(settings));
  const auto speed = [&] { return simulation.state().v.cwiseAbs().maxCoeff(); };
  for (int i = 0; i < 200 && (i < 3 || speed() > 1e-5); ++i) simulation.step();
  EXPECT_LE(speed(), 1e-5) << "still moving";
  return simulation.state().x;
}

/// Makes a grid from the origin to (length, width) in the xy plane.
Mesh rectangle(int columns, int rows, double length, double width) {
  Mesh mesh = make_grid(columns, rows);
  mesh.positions.col(0) = ((mesh.positions.col(0).array() + 1) * (length / 2)).eval();
  mesh.positions.col(1) = ((mesh.positions.col(1).array() + 1) * (width / 2)).eval();
  return mesh;
}

/// Returns the distance of a clamped strip's tip from the elastica's, for unit length. Cells are square, with values
/// per area: the error of a border of one cell, which is too soft, falls with the cell size too.
double elastica_error(int cells, double lambda, double x, double z) {
  const double cell = 1.0 / cells;
  const int across = 2 * cells / 5;
  Mesh mesh = rectangle(cells + 1, across, 1 + cell, across * cell);
  mesh.positions.col(0).array() -= cell;  // the first column of cells is in the clamp
  std::vector<int> clamp;
  for (int j = 0; j <= across; ++j) clamp.insert(clamp.end(), {j * (cells + 2), j * (cells + 2) + 1});
  const Vertices rest = at_rest(by_area(mesh, 4e3 * weight, clamp), {Bending{.rigidity = weight / lambda}});
  const Eigen::RowVector3d tip = rest.row(across / 2 * (cells + 2) + cells + 1);
  return std::hypot(tip[0] - x, tip[2] - z);
}

struct Elastica {
  double lambda, x, z;  // w L³/D, and the tip's position relative to L
};
constexpr std::array elasticas{Elastica{2, 0.9669, -0.2385}, Elastica{4, 0.8901, -0.4252},
                               Elastica{20, 0.4452, -0.8299}};

// A clamped strip bends under its own weight as the elastica does, to the second order of its cells.
void expect_second_order(const Elastica& exact, int cells) {
  const double coarse = elastica_error(cells, exact.lambda, exact.x, exact.z);
  const double fine = elastica_error(2 * cells, exact.lambda, exact.x, exact.z);
  EXPECT_GT(coarse, 3 * fine) << "with " << cells << " cells " << coarse << ", with twice as many " << fine;
  EXPECT_LT(fine, 2.0 / (cells * cells));
}

class HeavyElastica : public testing::TestWithParam<Elastica> {};
INSTANTIATE_TEST_SUITE_P(Of, HeavyElastica, testing::ValuesIn(elasticas));
TEST_P(HeavyElastica, IsMetThreeTimesAsWellWithTwiceTenCells) { expect_second_order(GetParam(), 10); }

/// Returns the sag of the tip of a clamped strip of 40 cells, w L³/D = 1.
/// @param stiffness E L²/D
double sag(test::Division division, double stiffness, Method method) {
  const test::Sheet sheet = test::clamped_strip(division, 40, 12, 1);
  const Cloth cloth = by_area(sheet.mesh, stiffness * weight, sheet.pins);
  const Vertices rest = at_rest(cloth, {Bending{.rigidity = weight}}, method);
  return test::tip_drop(sheet, rest);
}

// Nearly inextensible cloth, and cloth with springs a hundred times stiffer, on every mesh.
class HeavyStripOnEveryMesh : public testing::TestWithParam<test::Division> {};
INSTANTIATE_TEST_SUITE_P(, HeavyStripOnEveryMesh, testing::ValuesIn(test::all_divisions()),
                         [](const auto& tested) { return test::name_of(tested.param); });
TEST_P(HeavyStripOnEveryMesh, SagsAsTheElastica) {
  constexpr double drop = 0.1235;  // Romero et al. 2021, "Physical validation of simulators in computer graphics"
  EXPECT_NEAR(sag(GetParam(), 1e5, Method::quasi_newton), drop, 0.01 * drop);
  EXPECT_NEAR(sag(GetParam(), 1e7, Method::implicit), drop, 0.01 * drop);
}

class FineElastica : public testing::TestWithParam<Elastica> {};
INSTANTIATE_TEST_SUITE_P(Nightly, FineElastica, testing::ValuesIn(elasticas));
TEST_P(FineElastica, IsMetThreeTimesAsWellWithTwiceTwentyCells) { expect_second_order(GetParam(), 20); }

// 2 m of chain between two points 1.2 m apart: a = 0.6/u with sinh(u)/u = 2/1.2 sags by a (cosh(u) − 1).
TEST(Catenary, IsWhatAStripWithoutRigidityHangsIn) {
  constexpr int cells = 60;
  const Mesh flat = rectangle(cells, 1, 2, 2.0 / cells);
  std::vector<int> ends{0, cells, cells + 1, 2 * cells + 1};
  Cloth cloth = by_area(flat, 1e4 * weight, ends);
  for (int i = 0; i < cloth.vertex_count(); ++i) {  // starts folded into a V of the same length
    const double along = flat.positions(i, 0), half = along < 1 ? along : 2 - along;
    cloth.positions.row(i) << 0.6 * along, flat.positions(i, 1), -0.8 * half;
  }
  const Vertices rest = at_rest(std::move(cloth), {});
  EXPECT_NEAR(-rest.col(2).minCoeff(), 0.72556, 0.001);
}

/// Makes rows of equilateral triangles with edge 1/count, about 1 m wide and high, with inner vertices moved by up to
/// `uneven` edges.
Mesh triangular_lattice(int count, double uneven) {
  const double edge = 1.0 / count, height = edge * std::sqrt(3.0) / 2;
  const int rows = 2 * static_cast<int>(std::lround(0.5 / height));
  Mesh mesh;
  mesh.positions.setZero(Eigen::Index{rows + 1} * (count + 1), 3);
  test::Random random(3);
  const auto at = [&](int i, int j) { return j * (count + 1) + i; };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= count; ++i) {
      const bool inner = i > 0 && j > 0 && i < count && j < rows;
      const double dx = inner ? uneven * edge * random.between(-1, 1) : 0;
      const double dy = inner ? uneven * edge * random.between(-1, 1) : 0;
      mesh.positions.row(at(i, j)) << edge * (i + (j % 2 == 0 ? 0 : 0.5)) + dx, j * height + dy, 0;
      if (i == count || j == rows) continue;
      if (j % 2 == 0) {
        mesh.triangles.insert(mesh.triangles.end(), {Triangle{at(i, j), at(i + 1, j), at(i, j + 1)},
                                                     Triangle{at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {Triangle{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                                     Triangle{at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
      }
    }
  }
  return mesh;
}

/// Returns the springs' energy per area of a cloth strained by these parts along x, y and in shear.
double energy_by_area(const Cloth& cloth, double xx, double yy, double xy) {
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  map(0, 0) += xx;
  map(1, 1) += yy;
  map(0, 1) = map(1, 0) = xy;
  const Vertices x = cloth.rest * map;
  double energy = 0, area = 0;
  for (const Spring& s : cloth.springs) {
    const double stretch = (x.row(s.i) - x.row(s.j)).norm() - s.rest_length;
    energy += s.stiffness / 2 * stretch * stretch;
  }
  for (const auto& [a, b, c] : cloth.triangles) {
    const Eigen::RowVector3d p = cloth.rest.row(b) - cloth.rest.row(a), q = cloth.rest.row(c) - cloth.rest.row(a);
    area += (p[0] * q[1] - p[1] * q[0]) / 2;
  }
  return energy / area;
}

constexpr double modulus = 100, strain = 1e-5;
constexpr double uniaxial = modulus / 2 * strain * strain;

TEST(Modulus, IsTheStiffnessOfAGridAlongItsEdgesWhileShearIsFree) {
  // The diagonals from (0, 1) to (1, 0) keep their length if the shear compensates half of the strain.
  EXPECT_NEAR(energy_by_area(by_area(make_grid(8, 8), modulus, {}), strain, 0, strain / 2), uniaxial, 1e-3 * uniaxial);
}

TEST(Modulus, IsAFifthMoreOnAGridWhoseShearIsHeld) {
  EXPECT_NEAR(energy_by_area(by_area(make_grid(8, 8), modulus, {}), strain, -strain / 5, 0), 1.2 * uniaxial,
              1e-3 * uniaxial);
}

TEST(Modulus, OfEquilateralTrianglesHasAPoissonsRatioOfAThird) {
  const Cloth cloth = by_area(triangular_lattice(20, 0), modulus, {});
  EXPECT_NEAR(energy_by_area(cloth, strain, -strain / 3, 0), uniaxial, 1e-3 * uniaxial);
  for (const double ratio : {0.3, 0.37}) EXPECT_GT(energy_by_area(cloth, strain, -ratio * strain, 0), uniaxial);
}

TEST(Modulus, IsTheSameWithinAFewPercentOnUnevenTriangles) {
  const Cloth cloth = by_area(triangular_lattice(20, 0.2), modulus, {});
  EXPECT_NEAR(energy_by_area(cloth, strain, -strain / 3, 0), uniaxial, 0.03 * uniaxial);
  EXPECT_NEAR(energy_by_area(cloth, -strain / 3, strain, 0), uniaxial, 0.03 * uniaxial);
}

TEST(Density, GivesEveryMeshTheMassOfItsArea) {
  for (const Mesh& mesh : {triangular_lattice(9, 0.2), make_grid(7, 3)}) {
    const Cloth cloth = by_area(mesh, modulus, {});
    const double width = mesh.uvs.empty() ? 1 : 2,
                 height = mesh.positions.col(1).maxCoeff() - mesh.positions.col(1).minCoeff();
    EXPECT_NEAR(cloth.masses.sum(), density * width * height, 1e-12);
  }
}

/// Returns the sag of the lower border of a sheet that hangs by its upper one, stretched by its own weight.
double sinks(Mesh mesh, double height) {
  mesh.positions.col(2) = mesh.positions.col(1).eval();  // upright
  mesh.positions.col(1).setZero();
  std::vector<int> top, bottom;
  for (int i = 0; i < mesh.positions.rows(); ++i) {
    if (mesh.positions(i, 2) > height * (1 - 1e-9)) top.push_back(i);
    if (mesh.positions(i, 2) < height * 1e-9) bottom.push_back(i);
  }
  const Vertices rest = at_rest(by_area(mesh, 20 * weight, top), {});
  double sum = 0;
  for (const int i : bottom) sum -= rest(i, 2);
  return sum / static_cast<double>(bottom.size());
}

// Its upper border cannot contract, so the sag is between that of a sheet free to contract, ½ w H²/E, and that of one
// that cannot contract at all. Only independence of the cell size is tested here.
TEST(HungSheet, SinksByTheSameOnThreeRefinementsOfEachKindOfMesh) {
  for (const double uneven : {-1.0, 0.0, 0.2}) {  // a grid, and two lattices
    std::vector<double> depths;
    for (const int count : {12, 24, 48}) {
      const Mesh mesh = uneven < 0 ? rectangle(count, count, 1, 1) : triangular_lattice(count, uneven);
      const double height = mesh.positions.col(1).maxCoeff();
      depths.push_back(sinks(mesh, height) / (height * height));
    }
    EXPECT_NEAR(depths[0], depths[2], 0.02 * depths[2]) << uneven;
    EXPECT_NEAR(depths[1], depths[2], 0.02 * depths[2]) << uneven;
    EXPECT_NEAR(depths[2], 1.0 / 40, 0.25 / 40) << uneven;  // relative to ½ w/E
  }
}

}  // namespace
}  // namespace drape::materials_test
