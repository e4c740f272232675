// Cloth with a warp and a weft: moduli of its springs and energies of rolled sheets, compared with orthotropic theory.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "drape/sim/cloth.hpp"
#include "drape/sim/mesh.hpp"
#include "sim/bending/bending_energy.hpp"
#include "sim/spring_network.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"
#include "tests/support/sheets_to_bend.hpp"

namespace drape::test {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Returns the theory's √ of a property at an angle from the warp, mixed as cos²·a + sin²·b.
double mixed(double angle, double warp, double weft) {
  return std::pow(std::cos(angle), 2) * warp + std::pow(std::sin(angle), 2) * weft;
}

/// Returns the uniaxial modulus of a flat cloth in a direction of its plane: 1/(s:C⁻¹:s) for a unit pull s, with C of
/// springs that are strained evenly.
double modulus_along(const Cloth& cloth, double angle) {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  // of the strains xx, yy, 2xy
  for (const Spring& s : cloth.springs) {
    const Eigen::RowVector3d n = (cloth.rest.row(s.j) - cloth.rest.row(s.i)) / s.rest_length;
    const Eigen::Vector3d strained(n.x() * n.x(), n.y() * n.y(), n.x() * n.y());
    stiffness += s.stiffness * s.rest_length * s.rest_length * strained * strained.transpose();
  }
  double area = 0;
  for (const auto& [a, b, c] : cloth.triangles) {
    area += (cloth.rest.row(b) - cloth.rest.row(a)).cross(cloth.rest.row(c) - cloth.rest.row(a)).norm() / 2;
  }
  const double c = std::cos(angle), s = std::sin(angle);
  const Eigen::Vector3d pull(c * c, s * s, c * s);
  return 1 / pull.dot((stiffness / area).inverse() * pull);
}

Cloth woven(const Mesh& mesh, double degrees, WarpWeft modulus) {
  Cloth cloth = cloth_of(mesh, 1, 1, {});
  modulus.angle = degrees * degree;
  stiffen_as_woven(modulus, cloth);
  return cloth;
}

Mesh grid(GridPattern pattern) {
  return make_grid(Grid{.columns = 12, .rows = 10, .pattern = pattern, .size = {{1.2, 1}}});
}

Mesh delaunay() { return clamped_strip(Division::delaunay, 12, 6, 1).mesh; }

TEST(WovenCloth, HasItsModuliInEveryDirection) {
  const WarpWeft modulus(900, 300);
  const auto expect = [&](const Mesh& mesh, double warp) {
    const Cloth cloth = woven(mesh, warp, modulus);
    for (const double angle : {0.0, 20.0, 45.0, 90.0, 135.0}) {
      const double theory = std::pow(mixed(angle * degree, 1 / std::sqrt(900.0), 1 / std::sqrt(300.0)), -2);
      EXPECT_NEAR(modulus_along(cloth, (warp + angle) * degree), theory, 1e-9 * theory) << warp << " " << angle;
    }
  };
  for (const double warp : {0.0, 45.0, 90.0}) {
    expect(grid(GridPattern::alternating), warp);
    expect(grid(GridPattern::x), warp);
  }
  for (const double warp : {0.0, 17.0, 60.0}) expect(delaunay(), warp);
}

TEST(WovenCloth, IsIsotropicWithOneModulus) {
  const Mesh mesh = grid(GridPattern::alternating);
  const Cloth cloth = woven(mesh, 30, 500);
  Cloth even = cloth_of(mesh, 1, 1, {});
  stiffen_evenly(500, even);
  for (std::size_t i = 0; i < cloth.springs.size(); ++i) {
    EXPECT_NEAR(cloth.springs[i].stiffness, even.springs[i].stiffness, 1e-9 * even.springs[i].stiffness);
  }
}

// Turned triangles, and a rest shape seen from below, have the same warp.
TEST(WovenCloth, HasOneWarpWhicheverWayItsTrianglesFace) {
  const Mesh mesh = delaunay();
  Mesh turned = mesh;
  for (std::size_t t = 0; t < turned.triangles.size(); t += 2)
    std::swap(turned.triangles[t][0], turned.triangles[t][1]);
  const Cloth one = woven(mesh, 30, {900, 300}), other = woven(turned, 30, {900, 300});
  for (std::size_t i = 0; i < one.springs.size(); ++i) {
    EXPECT_NEAR(one.springs[i].stiffness, other.springs[i].stiffness, 1e-9 * one.springs[i].stiffness);
  }
}

std::string refused(const Mesh& mesh, double warp, const WarpWeft& modulus) {
  try {
    static_cast<void>(woven(mesh, warp, modulus));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(WovenCloth, RefusesWhatSpringsCannotRepresent) {
  EXPECT_NE(refused(grid(GridPattern::diagonal), 0, {900, 300}).find("too few directions"), std::string::npos);
  EXPECT_EQ(refused(grid(GridPattern::alternating), 0, {899, 100}), "");
  EXPECT_NE(refused(grid(GridPattern::alternating), 0, {901, 100}).find("would push"), std::string::npos);
  Mesh upright = grid(GridPattern::x);
  upright.positions.col(2) = upright.positions.col(0).eval();
  upright.positions.col(0).setZero();
  EXPECT_NE(refused(upright, 0, {900, 300}).find("has no direction"), std::string::npos);
  EXPECT_EQ(refused(upright, 90, {900, 300}), "");
}

// Cotton on a grid with one diagonal has E along the sides while shear is free: a fabric has E₁ and E₂ there.
TEST(WovenCloth, ByDirectionHasItsModuliAlongTheSidesOfAnyGrid) {
  for (const auto& [degrees, along, across] : {std::tuple{0.0, 900.0, 50.0}, {90.0, 50.0, 900.0}}) {
    Cloth cloth = cloth_of(grid(GridPattern::diagonal), 1, 1, {});
    stiffen_by_direction({900, 50, degrees * degree}, cloth);
    EXPECT_NEAR(modulus_along(cloth, 0), along, 1e-9 * along);
    EXPECT_NEAR(modulus_along(cloth, 90 * degree), across, 1e-9 * across);
  }
}

TEST(WovenCloth, ByDirectionIsThatOfItsAreasWithOneModulus) {
  const auto expect = [](const Mesh& mesh, const WarpWeft& modulus, double mean) {
    Cloth cloth = cloth_of(mesh, 1, 1, {}), even = cloth;
    stiffen_by_direction(modulus, cloth);
    stiffen_by_area(mean, even);
    for (std::size_t i = 0; i < cloth.springs.size(); ++i) {
      EXPECT_NEAR(cloth.springs[i].stiffness, even.springs[i].stiffness, 1e-9 * even.springs[i].stiffness);
    }
  };
  expect(delaunay(), 500, 500);
  // The warp has no direction in a sheet that is perpendicular to it.
  Mesh upright = grid(GridPattern::x);
  upright.positions.col(2) = upright.positions.col(0).eval();
  upright.positions.col(0).setZero();
  expect(upright, {900, 400}, 600);
}

/// Rolls the plane onto a cylinder of radius R; the roll runs at an angle to the x axis.
Vertices rolled(const Vertices& flat, double radius, double angle) {
  Vertices x = flat;
  for (Eigen::Index i = 0; i < flat.rows(); ++i) {
    const double u = std::cos(angle) * flat(i, 0) + std::sin(angle) * flat(i, 1);
    const double v = -std::sin(angle) * flat(i, 0) + std::cos(angle) * flat(i, 1);
    const double along = radius * std::sin(u / radius);
    x.row(i) << std::cos(angle) * along - std::sin(angle) * v, std::sin(angle) * along + std::cos(angle) * v,
        radius * (1 - std::cos(u / radius));
  }
  return x;
}

// As for a sheet of one rigidity, the border is a share of 1/n, which Richardson extrapolation removes.
TEST(WovenCloth, StoresTheEnergyOfItsRigidityWhenItIsRolledInAnyDirection) {
  constexpr double radius = 3, warp = 25 * degree;
  const WarpWeft rigidity(0.8, 0.2, warp);
  constexpr std::array counts{20, 40};
  std::vector<Mesh> meshes;
  std::vector<BendingEnergy> energies;
  for (const int n : counts) {
    const Cloth cloth = cloth_of(meshes.emplace_back(make_grid(n, n)), 1, 1, {});
    energies.emplace_back(curvature_elements(cloth, rigidity), cloth.vertex_count());
  }
  for (const double angle : {0.0, 30.0, 45.0, 90.0, 150.0}) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const Vertices& flat = meshes[i].positions;
      Vertices ignored = Vertices::Zero(flat.rows(), 3);
      const double energy = energies[i].add_gradient(rolled(flat, radius, warp + angle * degree), 0, ignored);
      const double theory = std::pow(mixed(angle * degree, std::sqrt(0.8), std::sqrt(0.2)), 2);
      ratios.push_back(energy / (theory * 4 / (2 * radius * radius)));
    }
    EXPECT_NEAR(2 * ratios[1] - ratios[0], 1, 0.01) << angle;
  }
}

TEST(WovenCloth, HasTheMeanRigidityWhereTheWarpHasNoDirection) {
  const Mesh flat = irregular_mesh(8);
  const auto energy = [&](const WarpWeft& rigidity) {
    Mesh upright = flat;
    upright.positions.col(2) = upright.positions.col(0).eval();
    upright.positions.col(0).setZero();
    const Cloth cloth = cloth_of(upright, 1, 1, {});
    Vertices ignored = Vertices::Zero(cloth.vertex_count(), 3);
    return BendingEnergy(curvature_elements(cloth, rigidity), cloth.vertex_count())
        .add_gradient(rolled(flat.positions, 3, 0.4), 0, ignored);
  };
  EXPECT_NEAR(energy({0.9, 0.4}), energy(0.6), 1e-12 * energy(0.6));
}

// A curved rest shape is at rest, too.
TEST(WovenCloth, HasNoEnergyInARolledRestShape) {
  Mesh mesh = irregular_mesh(12);
  mesh.positions = rolled(mesh.positions, 0.8, 0.4);
  const Cloth cloth = cloth_of(mesh, 1, 1, {});
  Vertices gradient = Vertices::Zero(cloth.vertex_count(), 3);
  const BendingEnergy energy(curvature_elements(cloth, WarpWeft(0.8, 0.2)), cloth.vertex_count());
  EXPECT_NEAR(energy.add_gradient(mesh.positions, 0, gradient), 0, 1e-9);
  EXPECT_LT(gradient.cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace drape::test
