#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "sim/linear/sparse_cholesky.hpp"
#include "sim/solvers/newton.hpp"
#include "sim/solvers/quasi_newton.hpp"
#include "tests/support/cloths.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

constexpr double tolerance = 1e-3;  // [m]

/// The first step of a cloth that begins to hang from its corners.
struct FirstStep {
  Cloth cloth;
  System system;
  StepObjective objective;

  explicit FirstStep(int cells, std::unique_ptr<Energy> energy = nullptr)
      : cloth(grid_cloth(cells)), system(with(std::move(energy))), objective(system, system.step) {
    begin(cloth.positions, cloth.velocities, 0);
  }
  /// Begins another step of the same cloth.
  void begin(const Vertices& x, const Vertices& v, int step) {
    Vertices weight = Vertices::Zero(cloth.vertex_count(), 3);
    weight.col(2) = -9.8 * cloth.masses;
    objective.begin(x, v, weight, (step + 1) * system.step);
  }
  System with(std::unique_ptr<Energy> energy) const {
    System result(cloth, 0.02);
    if (energy) result.energies.push_back(std::move(energy));
    return result;
  }
  [[nodiscard]] Iterate at(const Vertices& x) const {
    Iterate point{.x = x, .gradient = Vertices::Zero(x.rows(), 3)};
    point.value = objective.evaluate(point.x, point.gradient);
    return point;
  }
  /// Returns the point at which a method stops for an error.
  template <class Solver>
  [[nodiscard]] Iterate solved(double error, StepReport* report = nullptr, const Vertices* start = nullptr) const {
    IntegratorSettings settings;
    settings.stop = StoppingRule::error;
    settings.tolerance = error;
    settings.max_iterations = 1000;
    Iterate point = at(start == nullptr ? objective.y() : *start);
    Solver solver(system, objective, settings);
    const StepReport done = solver.minimise(point, [] { return true; });
    EXPECT_TRUE(done.converged);
    EXPECT_LE(solver.error(point), error);
    if (report != nullptr) *report = done;
    return point;
  }
};

double largest_distance(const Vertices& a, const Vertices& b) { return (a - b).rowwise().norm().maxCoeff(); }

/// An energy that is always zero.
struct Nothing final : Energy {
  struct Hessian final : EnergyHessian {
    void linearise(const Vertices&, double, double) override {}
    void add_product(const Vertices&, Vertices&) const override {}
    void add_blocks(HessianBlocks&) const override {}
  };
  double add_gradient(const Vertices&, double, Vertices&) const override { return 0; }
  void add_bound(StiffnessBound&) const override {}
  [[nodiscard]] std::unique_ptr<EnergyHessian> make_hessian() const override { return std::make_unique<Hessian>(); }
};

TEST(PatchNewton, BringsAStrayVertexBackAndLeavesTheRestAlone) {
  constexpr int cells = 40, stray = 5 * (cells + 1) + 5;
  const FirstStep step(cells);
  const Vertices minimum = step.solved<Newton>(1e-7).x;
  Iterate point = step.at(minimum);
  point.x.row(stray) += Eigen::RowVector3d(0.005, -0.01, 0.02);
  point = step.at(point.x);
  const Vertices before = point.x;
  const double height = point.value;
  PatchNewton patches(step.system, step.objective);
  double moved = patches.minimise_patches(point, 1, tolerance);
  for (int round = 1; round < 4; ++round) moved += patches.minimise_patches(point, 1, tolerance);
  EXPECT_GT(moved, 0.02);
  EXPECT_LT(point.value, height);
  EXPECT_EQ(point.value, step.at(point.x).value);
  EXPECT_TRUE(same_bits(point.gradient, step.at(point.x).gradient));
  EXPECT_LT(largest_distance(point.x, minimum), tolerance);
  for (int i = 0; i < step.cloth.vertex_count(); ++i) {
    const int away = std::max(std::abs(i % (cells + 1) - 5), std::abs(i / (cells + 1) - 5));
    if (away > 16) {
      EXPECT_TRUE(point.x.row(i) == before.row(i)) << i;
    }
  }
  for (const int pin : step.cloth.pins) EXPECT_TRUE(point.x.row(pin) == before.row(pin));
}

TEST(PatchNewton, MovesNothingWhereTooMuchOrNothingIsAboveTheTolerance) {
  const FirstStep step(20);
  PatchNewton patches(step.system, step.objective);
  Iterate far = step.at(step.cloth.positions + 0.1 * random_vertices(step.cloth.vertex_count(), 1));
  const Vertices before = far.x;
  EXPECT_EQ(patches.minimise_patches(far, 0.5, tolerance), 0);
  EXPECT_TRUE(same_bits(far.x, before));
  Iterate there = step.solved<Newton>(1e-7);
  const Vertices minimum = there.x;
  EXPECT_EQ(patches.minimise_patches(there, 1, tolerance), 0);
  EXPECT_TRUE(same_bits(there.x, minimum));
}

/// Iterations of the first steps of a large cloth by quasi-Newton; each step ends within the tolerance of its minimum.
struct FirstSteps {
  static constexpr double near = 1e-4;  // the first Newton step is longer [m]
  int iterations = 0;
  int by_newton = 0;  // steps whose end the gradient would not detect

  explicit FirstSteps(std::unique_ptr<Energy> energy = nullptr) {
    FirstStep step(142, std::move(energy));
    EXPECT_GE(FreeVertices(step.cloth).count(), large_cloth);
    Vertices x = step.cloth.positions, v = step.cloth.velocities;
    for (int i = 0; i < std::max(1, tries(4)); ++i) {
      step.begin(x, v, i);
      StepReport report;
      const Iterate end = step.solved<QuasiNewton>(near, &report);
      EXPECT_LT(largest_distance(end.x, step.solved<Newton>(1e-6, nullptr, &end.x).x), near);
      iterations += report.iterations;
      by_newton += step.objective.error_bound(end.gradient) > near ? 1 : 0;
      v = (end.x - x) / step.system.step;
      x = end.x;
    }
  }
};

// A Newton iteration detects the minimum long before the gradient does, and iterations on patches come nearer.
TEST(QuasiNewton, EndsStepsOfALargeClothWithinTheToleranceOfTheirMinima) {
  const FirstSteps in_patches, as_a_whole(std::make_unique<Nothing>());
  // A sanitized build takes only the first step, in which the gradient may detect it as well.
  EXPECT_GE(as_a_whole.by_newton, tries(4) > 1 ? 1 : 0);
  EXPECT_LT(in_patches.iterations, as_a_whole.iterations);
}

}  // namespace
}  // namespace drape::test
