// Bodies: cloth rests on a mesh, is carried along, and never passes through.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drape/sim/effects/body.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/physics/contact_settings.hpp"

namespace drape::test {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

constexpr double earth_gravity = 9.8;     // default gravity [m/s²]
constexpr double layer_thickness = 0.02;  // contact thickness [m]

/// Makes a sphere by dividing an octahedron's triangles and projecting the vertices.
Mesh ball(double radius, int divisions) {
  Mesh mesh;
  std::vector<RowVector3d> points;
  for (int side = 0; side < 8; ++side) {
    const Vector3d a((side & 1) != 0 ? -1 : 1, 0, 0), b(0, (side & 2) != 0 ? -1 : 1, 0),
        c(0, 0, (side & 4) != 0 ? -1 : 1);
    const bool mirrored = ((side & 1) + (side >> 1 & 1) + (side >> 2 & 1)) % 2 != 0;
    const auto number = [&](int i, int j) {
      const Vector3d p = (i * a + j * b + (divisions - i - j) * c).normalized();
      for (std::size_t k = 0; k < points.size(); ++k) {
        if ((points[k].transpose() - p).norm() < 1e-9) return static_cast<int>(k);
      }
      points.emplace_back(p.transpose());
      return static_cast<int>(points.size() - 1);
    };
    const auto add = [&](int p, int q, int r) {
      mesh.triangles.push_back(mirrored ? Triangle{p, r, q} : Triangle{p, q, r});
    };
    for (int i = 0; i < divisions; ++i) {
      for (int j = 0; i + j < divisions; ++j) {
        add(number(i, j), number(i + 1, j), number(i, j + 1));
        if (i + j + 1 < divisions) add(number(i + 1, j), number(i + 1, j + 1), number(i, j + 1));
      }
    }
  }
  mesh.positions.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k) mesh.positions.row(static_cast<Eigen::Index>(k)) = radius * points[k];
  return mesh;
}

std::shared_ptr<const MeshMotion> still(Mesh mesh) {
  return std::make_shared<MeshMotion>(MeshMotion{.mesh = std::move(mesh)});
}

/// Makes a square cloth around the z axis.
Cloth square(double side, int cells, double height) {
  Mesh mesh = make_grid(cells, cells);
  mesh.positions *= side / 2;
  mesh.positions.col(2).array() += height;
  return cloth_of(mesh, 0.2, 10, {});
}

class Bodies : public testing::TestWithParam<NamedMethod> {
 protected:
  SimulationSettings settings(Cloth cloth, double step) const {
    return contact_settings(GetParam(), std::move(cloth), step);
  }
  Body body() const { return {.thickness = layer_thickness}; }
};
INSTANTIATE_TEST_SUITE_P(With, Bodies, testing::ValuesIn(all_methods), method_name);

TEST_P(Bodies, TheFaceOfABoxIsAGround) {
  const double tangent = 0.5;
  const Vector3d up = Vector3d(tangent, 0, 1).normalized(), down = Vector3d(1, 0, -tangent).normalized();
  // Vertices on the contact layer and above it, some of them moving; also across the face's diagonal.
  Vertices x(4, 3);
  for (int i = 0; i < 4; ++i) {
    x.row(i) = ((layer_thickness - 0.002 + 0.01 * (i % 2)) * up + (0.1 * i - 0.2) * Vector3d::UnitY()).transpose();
  }
  for (const double friction : {0.3, 0.5 * (1 + 1e-9)}) {
    SimulationSettings on_ground = settings(loose(x), 0.01);
    on_ground.cloth.velocities.row(2) = 0.7 * down.transpose() + RowVector3d(0, 0.4, 0);
    SimulationSettings on_box = on_ground;
    on_ground.effects.add(Ground{.normal = up, .thickness = layer_thickness, .friction = friction});
    Body box = body();
    box.box = Vector3d(8, 4, 1);
    box.center = -0.5 * up;
    box.rotate = {0, std::atan(tangent) * 180 / std::numbers::pi, 0};
    box.friction = friction;
    on_box.effects.add(box);
    Simulation ground(on_ground), face(on_box);
    for (int step = 0; step < 60; ++step) {
      ground.step();
      face.step();
    }
    EXPECT_LT((ground.state().x - face.state().x).cwiseAbs().maxCoeff(), 1e-9) << friction;
    EXPECT_LT((ground.state().v - face.state().v).cwiseAbs().maxCoeff(), 1e-7) << friction;
  }
}

TEST_P(Bodies, AClothComesToRestOnABox) {
  SimulationSettings s = settings(square(0.4, 6, layer_thickness + 0.03), 0.01);
  s.integrator.tolerance = 1e-9;
  Body box = body();
  box.box = Vector3d(1, 1, 0.2);
  box.center = Vector3d(0, 0, -0.1);
  s.effects.add(box);
  Simulation simulation(s);
  for (int step = 0; step < 200; ++step) simulation.step();
  EXPECT_LT((simulation.state().x.col(2).array() - layer_thickness).abs().maxCoeff(), 1e-4);
}

TEST_P(Bodies, OneThatMovesFartherThanItIsThickPushesAClothAndDoesNotPass) {
  // 0.1 m in a step: ten thicknesses, and twice the body.
  SimulationSettings s = settings(square(0.4, 6, 0), 0.01);
  s.effects = {};
  Body plate = body();
  plate.thickness = 0.01;
  plate.box = Vector3d(1, 1, 0.05);
  plate.center = Vector3d(0, 0, -0.43);
  plate.velocity = Vector3d(0, 0, 10);
  s.effects.add(plate);
  Simulation simulation(s);
  for (int step = 0; step < 30; ++step) {
    simulation.step();
    const double top = plate.center->z() + 0.025 + 10 * simulation.time();
    ASSERT_GT(simulation.state().x.col(2).minCoeff(), top) << "step " << step;
  }
}

TEST_P(Bodies, ABallOfTrianglesIsASphere) {
  const double radius = 0.3;
  const int divisions = 12;
  SimulationSettings s = settings(square(0.8, 8, 0.34), 0.005);
  s.integrator.tolerance = 1e-9;
  SimulationSettings other = s;
  s.effects.add(Sphere{.center = Vector3d(0.02, 0.01, 0), .radius = radius, .thickness = layer_thickness});
  Body mesh = body();
  mesh.mesh = still(ball(radius, divisions));
  mesh.center = Vector3d(0.02, 0.01, 0);
  mesh.friction = 0;
  other.effects.add(mesh);
  Simulation sphere(s), triangles(other);
  for (int step = 0; step < 40; ++step) {
    sphere.step();
    triangles.step();
  }
  const double edge = radius * std::numbers::pi / 2 / divisions * 1.5;
  EXPECT_GT((sphere.state().x.col(2) - s.cloth.positions.col(2)).cwiseAbs().maxCoeff(), 0.1) << "it has fallen";
  EXPECT_LT((sphere.state().x - triangles.state().x).rowwise().norm().maxCoeff(), edge / 2);
}

TEST_P(Bodies, ACornerDoesNotPokeThroughAClothThatIsCoarserThanIt) {
  // One cell, whose vertices are far from a cube that stands on its corner.
  SimulationSettings s = settings(square(1, 1, 0.12), 0.01);
  Body cube = body();
  cube.thickness = 0.01;
  cube.box = Vector3d(0.1, 0.1, 0.1);
  cube.rotate = {45, std::atan(std::sqrt(0.5)) * 180 / std::numbers::pi, 0};
  cube.center = Vector3d(0.05, -0.1, 0);
  s.effects.add(cube);
  Simulation simulation(s);
  const double tip = 0.05 * std::sqrt(3.0);
  for (int step = 0; step < 40; ++step) {
    simulation.step();
    const Vertices& x = simulation.state().x;
    // The plane of the triangle above the tip must stay out of the tip's reach.
    for (const Triangle& t : s.cloth.triangles) {
      const RowVector3d a = x.row(t[0]), u = x.row(t[1]) - a, v = x.row(t[2]) - a;
      const RowVector3d to = RowVector3d(0.05, -0.1, tip) - a;
      const double area = u[0] * v[1] - u[1] * v[0];
      const double p = (to[0] * v[1] - to[1] * v[0]) / area, q = (u[0] * to[1] - u[1] * to[0]) / area;
      if (p < 0 || q < 0 || p + q > 1) continue;
      ASSERT_GT(a[2] + p * u[2] + q * v[2], tip) << "step " << step;
    }
  }
}

TEST_P(Bodies, WhatTurnsCarriesAlongWithTheSpeedThatItHasThere) {
  // On a turntable at 0.5 m from its axis: until it has that speed, friction accelerates by µ g.
  SimulationSettings s = settings(loose(RowVector3d(0.5, 0, layer_thickness)), 0.005);
  Body table = body();
  table.box = Vector3d(2, 2, 0.2);
  table.center = Vector3d(0, 0, -0.1);
  table.orbit_period = 4;
  table.friction = 0.2;
  s.effects.add(table);
  Simulation simulation(s);
  for (int step = 0; step < 20; ++step) simulation.step();
  const double t = simulation.time();
  EXPECT_NEAR(simulation.state().v(0, 1), 0.2 * earth_gravity * t, 0.05 * earth_gravity * t);
  for (int step = 20; step < 200; ++step) simulation.step();
  const RowVector3d x = simulation.state().x.row(0);
  const double turning = 2 * std::numbers::pi / 4;
  EXPECT_LT((simulation.state().v.row(0) - turning * RowVector3d(-x[1], x[0], 0)).norm(), 0.02);
}

TEST_P(Bodies, AShapeThatChangesCarriesAlong) {
  // A sheet that rises by 0.3 m/s at the vertex, and stretches sideways under it as fast.
  auto motion = std::make_shared<MeshMotion>(MeshMotion{.mesh = make_grid(3, 3)});
  motion->times = {0, 1};
  motion->samples = {motion->mesh.positions, motion->mesh.positions};
  motion->samples[1].col(0) *= 1.6;
  motion->samples[1].col(2).array() += 0.3;
  SimulationSettings s = settings(loose(RowVector3d(0.5, 0.1, layer_thickness)), 0.005);
  Body sheet = body();
  sheet.mesh = motion;
  sheet.friction = 1;
  s.effects.add(sheet);
  Simulation simulation(s);
  for (int step = 0; step < 150; ++step) simulation.step();
  const double t = simulation.time();
  EXPECT_NEAR(simulation.state().x(0, 2), layer_thickness + 0.3 * t, 2e-3);
  EXPECT_NEAR(simulation.state().x(0, 0), 0.5 * (1 + 0.6 * t), 0.02);
}

TEST_P(Bodies, AShellKeepsAClothOnTheSideOnWhichItIs) {
  for (const double side : {1.0, -1.0}) {
    SimulationSettings s = settings(square(0.4, 4, 0.05 * side), 0.01);
    s.effects = {};
    s.cloth.velocities.col(2).setConstant(-10 * side);
    Body sheet = body();
    sheet.mesh = still(make_grid(2, 2));
    s.effects.add(sheet);
    Simulation simulation(s);
    for (int step = 0; step < 5; ++step) simulation.step();
    EXPECT_GT((side * simulation.state().x.col(2)).minCoeff(), 0) << side;
  }
}

TEST(Body, SaysWhatIsWrongWithIt) {
  const SimulationSettings s = setup(square(1, 1, 0), {Method::semi_implicit}, 0.01);
  const auto of = [&](const Body& body) { return problems(body, s); };
  EXPECT_TRUE(of({.box = Vector3d(1, 1, 1)}).empty());
  EXPECT_EQ(of({.box = Vector3d(1, 1, 1), .mesh = still(make_box({1, 1, 1}))}).size(), 1U);
  EXPECT_EQ(of({.box = Vector3d(1, 1, 1), .prim = "/World/arm"}).size(), 1U);
  EXPECT_EQ(of({.mesh = still(Mesh{})}).size(), 1U);
  EXPECT_EQ(of({.box = Vector3d(1, 1, 1), .velocity = Vector3d(1, 0, 0), .orbit_period = 1}).size(), 1U);
  EXPECT_EQ(of({.box = Vector3d(1, 1, 1), .orbit_period = 0}).size(), 1U);
}

}  // namespace
}  // namespace drape::test
