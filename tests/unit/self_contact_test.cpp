#include "sim/collision/self_contact.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "sim/collision/distance.hpp"
#include "sim/effects/self_collision.hpp"
#include "tests/support/setups.hpp"

namespace drape::self_contact {
namespace {

/// A cloth of two triangles, 0 1 2 and 3 4 5, the first of them pinned; far apart at rest.
Cloth two_triangles(const std::vector<Point>& places) {
  Cloth cloth;
  cloth.positions.resize(6, 3);
  for (int i = 0; i < 6; ++i) cloth.positions.row(i) = places[static_cast<std::size_t>(i)].transpose();
  cloth.rest = cloth.positions;
  cloth.rest.bottomRows(3).array() += 100;
  cloth.velocities = Vertices::Zero(6, 3);
  cloth.triangles = {{0, 1, 2}, {3, 4, 5}};
  cloth.masses = Eigen::VectorXd::LinSpaced(6, 0.5, 2);
  cloth.pins = {0, 1, 2};
  return cloth;
}

/// The velocities that self-collision makes of some in a step of one second.
Vertices collided(const Cloth& cloth, const SelfCollision& values, Vertices v) {
  SelfContact(values, cloth).apply(cloth.positions, 0, 1, v);
  return v;
}

// Nearer than the thickness they part, further they may come as near as that, and further away they feel nothing.
TEST(SelfContact, KeepsLayersTheThicknessApart) {
  const SelfCollision values{.thickness = 0.1, .repulsion = 0.5, .friction = 0};
  for (const double height : {0.06, 0.11, 0.15, 0.25}) {
    for (const double speed : {0.0, -0.01, -0.03, -0.08, -1.0}) {
      const Cloth cloth = two_triangles({Point(-9, -5, 0), Point(9, -5, 0), Point(0, 9, 0), Point(-0.5, 0, height),
                                         Point(0.5, 0, height), Point(0, 0.5, height)});
      Vertices v = Vertices::Zero(6, 3);
      v.bottomRows(3).col(2).setConstant(speed);
      const double least = height < 0.1 ? 0.5 * (0.1 - height) : 0.1 - height;  // [m/s]
      v = collided(cloth, values, v);
      EXPECT_LT((v.bottomRows(3).col(2).array() - std::max(speed, least)).abs().maxCoeff(), 1e-9)
          << height << " m apart at " << speed << " m/s";
    }
  }
}

// A vertex that slides over a triangle which tips up and hits it, first of all in the middle of the step. What that
// changes without friction is the impulse; with friction Coulomb's share of it is added, against the slip.
TEST(SelfContact, AnImpactHasCoulombsFriction) {
  const Cloth cloth = two_triangles({Point(0, 0, 0), Point(10, -3, 0), Point(10, 3, 0), Point(0.5, 0, 0.2),
                                     Point(0.5, -0.3, 1.2), Point(0.5, 0.3, 1.2)});
  Vertices v = Vertices::Zero(6, 3);
  v(1, 2) = v(2, 2) = 1;
  v.bottomRows(3).col(0).setConstant(5);
  SelfCollision values{.thickness = 0.001, .friction = 0};
  const Eigen::RowVector3d slippery = (collided(cloth, values, v) - v).row(3);
  EXPECT_GT(slippery[2], 0.5) << "no impact";
  values.friction = 0.3;
  const Eigen::RowVector3d friction = (collided(cloth, values, v) - v).row(3) - slippery;
  EXPECT_NEAR(friction.norm(), 0.3 * slippery.norm(), 1e-9);
  EXPECT_NEAR(friction.dot(slippery), 0, 1e-9);
  EXPECT_LT(friction[0], 0);
}

// Pins go their way, with the velocities that they have, whatever runs into them.
TEST(SelfContact, ChangesNoVelocityOfAPin) {
  const Cloth cloth = two_triangles({Point(-9, -5, 0), Point(9, -5, 0), Point(0, 9, 0), Point(-0.5, 0, 0.05),
                                     Point(0.5, 0, 0.3), Point(0, 0.5, 0.2)});
  for (const double thickness : {0.1, 1e-3}) {
    Vertices v = test::random_vertices(6, 1);
    v.bottomRows(3).col(2).array() -= 20;
    const Vertices after = collided(cloth, {.thickness = thickness}, v);
    EXPECT_TRUE(test::same_bits(after.topRows(3), v.topRows(3))) << thickness;
    EXPECT_GT((after - v).bottomRows(3).norm(), 1) << "nothing ran into them";
  }
}

}  // namespace
}  // namespace drape::self_contact
