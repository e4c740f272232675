// Newton's method for compressed cloth, whose Hessians have negative eigenvalues.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/bending.hpp"
#include "sim/kernels/kernels.hpp"
#include "sim/linear/newton_cholesky.hpp"
#include "sim/solvers/newton.hpp"
#include "sim/system.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

namespace drape::test {
namespace {

/// Makes a quarter of a cylinder with a rest curvature, whose springs and curvature are slightly compressed.
SimulationSettings compressed_shell(double stiffness) {
  Mesh mesh = make_grid(8, 8);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    const double angle = 0.8 * mesh.positions(i, 0);
    mesh.positions.row(i) << std::sin(angle), mesh.positions(i, 1), std::cos(angle);
  }
  SimulationSettings settings = setup(cloth_of(mesh, 1, stiffness, {0, 8}), Method::implicit, 0.01);
  settings.cloth.positions *= 0.98;
  settings.effects = {Gravity{}, Bending{.rigidity = 0.01}};
  return settings;
}

/// Makes a strip in the xy plane, held at both ends `compression` closer than at rest, and bent out of its plane by a
/// thousandth of a millimetre.
SimulationSettings compressed_strip(double compression) {
  Mesh mesh = make_grid(20, 1);
  SimulationSettings settings = setup(cloth_of(mesh, 0.1, 1e4, {0, 20, 21, 41}), Method::implicit, 0.1);
  Vertices& x = settings.cloth.positions;
  for (Eigen::Index i = 0; i < x.rows(); ++i) x(i, 2) = 1e-6 * std::cos(std::numbers::pi / 2 * x(i, 0));
  x.col(0) *= 1 - compression;
  settings.effects = {Bending{.rigidity = 1e-3}};
  settings.integrator.stop = StoppingRule::error;
  settings.integrator.tolerance = 1e-11;
  settings.integrator.linear_solver = LinearSolver::cholesky;
  return settings;
}

/// A step from rest, whose solution is to be found.
struct RestingStep {
  SimulationSettings settings;
  System system = make_system(settings);
  StepObjective objective{system, system.step};

  explicit RestingStep(SimulationSettings of) : settings(std::move(of)) {
    const Vertices none = Vertices::Zero(settings.cloth.vertex_count(), 3);
    objective.begin(settings.cloth.positions, none, none, system.step);
  }
  [[nodiscard]] Iterate at(const Vertices& x) const {
    Iterate point{.x = x, .gradient = x};
    point.value = objective.evaluate(x, point.gradient);
    return point;
  }
  /// Returns the iterate after `iterations` from the start.
  [[nodiscard]] Iterate after(int iterations) const {
    IntegratorSettings integrator = settings.integrator;
    integrator.max_iterations = iterations;
    Iterate point = at(settings.cloth.positions);
    Newton(system, objective, integrator).minimise(point, [] { return true; });
    return point;
  }
  /// Returns random forces on the free vertices [N].
  [[nodiscard]] Vertices forces(int seed = 3) const {
    Vertices b = random_vertices(settings.cloth.vertex_count(), seed);
    for (const int pin : settings.cloth.pins) b.row(pin).setZero();
    return b;
  }
  /// Returns H p by differences of ∇g.
  [[nodiscard]] Vertices product(const Vertices& x, const Vertices& p) const {
    const double e = 1e-6 / norm(p);
    return (at(x + e * p).gradient - at(x - e * p).gradient) / (2 * e);
  }
};

struct Solvers {
  NewtonCholesky cholesky;
  ConjugateGradients iterated;
  CheaperNewton cheaper;

  explicit Solvers(const RestingStep& step)
      : cholesky(step.system, step.objective),
        iterated(step.system, step.objective),
        cheaper(step.system, step.objective) {}
  std::array<NewtonSolver*, 3> all() { return {&cholesky, &iterated, &cheaper}; }
};

TEST(Concavity, OfOneMakesTheHessianTheSlopeOfTheGradientAlsoWhereClothIsCompressed) {
  const RestingStep step(compressed_shell(200));
  const Vertices &x = step.settings.cloth.positions, b = step.forces();
  Vertices p(x.rows(), 3);
  Solvers solvers(step);
  solvers.cholesky.solve(x, b, 0, p);
  EXPECT_GT(norm(step.product(x, p) - b), 0.05 * norm(b)) << "nothing is compressed";
  for (NewtonSolver* solver : solvers.all()) {
    solver->solve(x, b, 1, p);
    EXPECT_LT(norm(step.product(x, p) - b), (solver == &solvers.cholesky ? 1e-5 : 1.01e-2) * norm(b));
  }
}

TEST(Concavity, LeavesADirectionOfDescentWhereTheHessianIsIndefinite) {
  const RestingStep step(compressed_shell(1e7));
  const Vertices x = 0.9 * step.settings.cloth.positions;
  const Vertices b = step.forces();
  Vertices p = x;
  Solvers solvers(step);
  for (NewtonSolver* solver : solvers.all()) {
    solver->solve(x, b, 1, p);
    EXPECT_TRUE(p.allFinite());
    EXPECT_GT(dot(b, p), 0);
    for (const int pin : step.settings.cloth.pins) EXPECT_EQ(p.row(pin).norm(), 0);
  }
}

// A compressed plane strip is a saddle of g: it must buckle, and at its end no direction leads further down.
TEST(Concavity, LetsACompressedStripBuckle) {
  const RestingStep step(compressed_strip(0.01));
  const Iterate start = step.at(step.settings.cloth.positions), end = step.after(100);
  EXPECT_LT(end.value, 0.2 * start.value);
  EXPECT_GT(end.x.col(2).cwiseAbs().maxCoeff(), 0.01) << "n half-waves of the strip's length are 0.13 m/n high";
  for (int seed = 0; seed < 20; ++seed) {
    const Vertices p = seed == 0 ? end.x - start.x : step.forces(seed);
    EXPECT_GT(dot(p, step.product(end.x, p)), 0);
  }
}

// Near the minimum ‖∇g‖ is proportional to the square of the previous iteration's.
TEST(Concavity, LetsIterationsConvergeQuadratically) {
  const RestingStep step(compressed_strip(0.01));
  const double scale = norm(step.at(step.settings.cloth.positions).gradient);
  int iterations = 0;
  while (norm(step.after(iterations).gradient) > 1e-8 * scale && iterations < 100) ++iterations;
  ASSERT_LT(iterations, 100);
  const double last = norm(step.after(iterations).gradient), before = norm(step.after(iterations - 1).gradient),
               first = norm(step.after(iterations - 2).gradient);
  EXPECT_GT(std::log(last / before) / std::log(before / first), 1.5) << last << " " << before << " " << first;
}

TEST(TheCheaperSolver, CountsToTheSameChoiceWithEveryInstructionSet) {
  for (const double stiffness : {1.0, 1e8}) {
    const RestingStep step(setup(cloth_of(irregular_mesh(14), 1, stiffness, {0, 5}), Method::implicit, 0.02));
    const Vertices x = step.settings.cloth.positions + 0.1 * step.forces(4), b = step.forces();
    Vertices p = x, exact = x;
    for (const Kernels* version : all_kernels()) {
      if (version->supported() == 0) continue;
      const Kernels& usual = replace_kernels(*version);
      CheaperNewton cheaper(step.system, step.objective);
      cheaper.solve(x, b, 0, p);
      EXPECT_EQ(cheaper.factors(), stiffness > 1) << version->name;
      NewtonCholesky(step.system, step.objective).solve(x, b, 0, exact);
      EXPECT_EQ(same_bits(p, exact), cheaper.factors()) << version->name;
      cheaper.begin();
      EXPECT_FALSE(cheaper.factors()) << "each minimisation begins with conjugate gradients";
      replace_kernels(usual);
    }
  }
}

}  // namespace
}  // namespace drape::test
