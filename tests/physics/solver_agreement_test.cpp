// The implicit methods minimise the same g: at convergence they give the same cloth.

#include <gtest/gtest.h>

#include <filesystem>

#include "drape/sim/simulation.hpp"
#include "scene/mesh_value.hpp"
#include "sim/step_objective.hpp"
#include "tests/support/cloths.hpp"

namespace drape {
namespace {

struct Case {
  const char* name;
  Cloth (*cloth)();  // every process lists all tests; only its own cloths are made
  bool with_sphere;
  double agreement;  ///< [m]
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

SimulationSettings settings(const Case& c, Method method) {
  SimulationSettings result;
  result.cloth = c.cloth();
  result.step = 0.02;
  result.integrator = {.method = method, .stop = StoppingRule::gradient, .tolerance = 1e-9, .max_iterations = 100000};
  result.effects = {Gravity{}};
  if (c.with_sphere) result.effects.add(test::sphere());
  return result;
}

Cloth disc_from_obj() {
  const Mesh disc = read_mesh(std::filesystem::path(DRAPE_SOURCE_DIR) / "tests/data/disc.obj");
  return make_cloth(disc, disc, 1.0, 180, {0, 1, 2});
}

class Agreement : public ::testing::TestWithParam<Case> {};

// A cloth that moves without being crumpled: g has a single minimum.
State moving_state(const Case& c) {
  SimulationSettings s = settings(c, Method::implicit);
  Simulation simulation(s);
  for (int step = 0; step < 10; ++step) simulation.step();
  return simulation.state();
}

TEST_P(Agreement, EveryMethodFindsTheSameStep) {
  const State start = moving_state(GetParam());
  Vertices expected;
  const auto compare = [&](const SimulationSettings& s, const std::string& name) {
    Simulation simulation(s);
    simulation.restore(start);
    const StepReport report = simulation.step();
    EXPECT_TRUE(report.converged) << name << ", residual " << simulation.residual();
    if (expected.size() == 0) expected = simulation.state().x;
    EXPECT_LT((simulation.state().x - expected).cwiseAbs().maxCoeff(), GetParam().agreement) << name;
  };
  SimulationSettings direct = settings(GetParam(), Method::implicit);
  direct.integrator.linear_solver = LinearSolver::cholesky;
  compare(direct, "Newton with a direct factor");
  compare(settings(GetParam(), Method::implicit), "Newton");
  compare(settings(GetParam(), Method::quasi_newton), "quasi-Newton");
  compare(settings(GetParam(), Method::liu13), "Liu13");
}

// The value of g after 1, 2, 3 … iterations from the same state.
TEST_P(Agreement, NoIterationRaisesTheObjective) {
  const State start = moving_state(GetParam());
  for (const Method method : {Method::implicit, Method::quasi_newton, Method::liu13}) {
    SimulationSettings s = settings(GetParam(), method);
    System system(s.cloth, s.step);
    for (const Effect& effect : s.effects) effect.install(system);
    StepObjective objective(system, system.step);
    Vertices force = Vertices::Zero(start.x.rows(), 3), gradient = force;
    for (const auto& f : system.forces) f->add(start, 0, force);
    objective.begin(start.x, start.v, force, system.step);
    double before = objective.evaluate(objective.y(), gradient);
    for (int iterations = 1; iterations <= 40; ++iterations) {
      s.integrator.max_iterations = iterations;
      Simulation simulation(s);
      simulation.restore(start);
      const StepReport report = simulation.step();
      EXPECT_LE(report.rise, 0);
      if (report.kept < 1) continue;  // reduced because the last iterate had too much energy
      const double after = objective.evaluate(simulation.state().x, gradient);
      EXPECT_LE(after, before + objective.rounding(before))
          << "iteration " << iterations << " of method " << static_cast<int>(method);
      before = after;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Agreement,
                         ::testing::Values(Case{"soft_grid", [] { return test::grid_cloth(20, 18); }, false, 1e-8},
                                           Case{"grid", [] { return test::grid_cloth(20, 180); }, false, 1e-8},
                                           Case{"stiff_grid", [] { return test::grid_cloth(20, 1800); }, false, 1e-7},
                                           Case{"grid_on_sphere", [] { return test::grid_cloth(10, 180); }, true, 1e-8},
                                           Case{"irregular", [] { return test::irregular_cloth(); }, true, 1e-8},
                                           Case{"irregular_obj", disc_from_obj, false, 1e-8},
                                           Case{"non_manifold", [] { return test::non_manifold_cloth(); }, false,
                                                1e-8}),
                         [](const auto& tested) { return tested.param.name; });

// The homework's cloth in contact with a sphere: vertices lie still and do not sink in.
TEST(SphereContact, NeitherJittersNorSinks) {
  for (const Method method : {Method::implicit, Method::quasi_newton}) {
    const Case c{"cloth", [] { return test::grid_cloth(20); }, false, 0};
    SimulationSettings s = settings(c, method);
    s.integrator = {.method = method};
    s.effects.add(Sphere{.center = Eigen::Vector3d(0, 0, -0.5), .radius = 0.4, .thickness = 0.02});
    Simulation simulation(s);
    std::vector<Eigen::VectorXd> radii;
    double nearest = 1, sum = 0;
    int count = 0;
    for (int step = 1; step <= 130; ++step) {
      simulation.step();
      radii.emplace_back((simulation.state().x.rowwise() - Eigen::RowVector3d(0, 0, -0.5)).rowwise().norm());
      nearest = std::min(nearest, radii.back().minCoeff());
    }
    for (std::size_t t = 60; t + 1 < radii.size(); ++t) {
      for (Eigen::Index v = 0; v < radii[t].size(); ++v) {
        const double a = radii[t - 1][v], b = radii[t][v], d = radii[t + 1][v];
        if (std::max({a, b, d}) >= 0.4201) continue;
        sum += (a - 2 * b + d) * (a - 2 * b + d);
        ++count;
      }
    }
    ASSERT_GT(count, 1000);
    EXPECT_LE(std::sqrt(sum / count), 5e-4);
    EXPECT_GE(nearest, 0.42 - 1e-4);
  }
}

}  // namespace
}  // namespace drape
