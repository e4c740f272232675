#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "drape/sim/effects/air.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/linear/constant_factor.hpp"
#include "sim/parallel/vectors.hpp"
#include "sim/schemes/registry.hpp"
#include "sim/spring_network.hpp"
#include "sim/step_objective.hpp"
#include "sim/system.hpp"
#include "tests/support/random.hpp"
#include "tests/support/setups.hpp"

// Results computed by several threads have the same bits for any number of threads.

namespace drape::test {
namespace {

constexpr int cells = 92;  // enough vertices to be divided, and few more
constexpr std::array counts{2, 3, 8};

Cloth large_cloth() { return cloth_of(make_grid(cells, cells), 1, 180, {0, cells}); }

/// Makes the same cloth with shuffled vertex numbers: hardly two springs have the same distance of indices.
Cloth shuffled_cloth() {
  const Mesh grid = make_grid(cells, cells);
  std::vector<int> places(static_cast<std::size_t>(grid.positions.rows()));
  std::iota(places.begin(), places.end(), 0);
  Random random(7);
  for (std::size_t left = places.size(); left > 1; --left) {
    std::swap(places[left - 1], places[static_cast<std::size_t>(random.below(static_cast<int>(left)))]);
  }
  const auto place = [&](Eigen::Index vertex) { return places[static_cast<std::size_t>(vertex)]; };
  Mesh mesh = grid;
  for (Eigen::Index v = 0; v < grid.positions.rows(); ++v) mesh.positions.row(place(v)) = grid.positions.row(v);
  for (Triangle& triangle : mesh.triangles) {
    for (int& vertex : triangle) vertex = place(vertex);
  }
  return cloth_of(mesh, 1, 180, {std::min(place(0), place(cells)), std::max(place(0), place(cells))});
}

void expect_what_one_thread_computes(const auto& compute) {
  const Vertices alone = compute(one_thread());
  for (const int count : counts) {
    const Threads threads(count);
    EXPECT_TRUE(same_bits(compute(threads), alone)) << count << " threads";
  }
}

TEST(Threads, ComputeEveryPartOnce) {
  for (const int count : {1, 2, 3, 8}) {
    const Threads threads(count);
    for (int loop = 0; loop < 200; ++loop) {
      std::vector<int> calls(static_cast<std::size_t>(loop), 0);
      threads.for_each(loop, [&](int part) { ++calls[static_cast<std::size_t>(part)]; });
      ASSERT_EQ(calls, std::vector<int>(static_cast<std::size_t>(loop), 1)) << count << " threads";
    }
  }
}

// A part may wait for earlier parts, which have begun. A deadlock would keep the test from ending.
TEST(Threads, BeginPartsInTheirOrder) {
  const Threads threads(3);
  std::vector<std::atomic<bool>> done(100);
  threads.for_each(100, [&](int part) {
    for (int before = 0; before < part; ++before) {
      while (!done[static_cast<std::size_t>(before)]) {
      }
    }
    done[static_cast<std::size_t>(part)] = true;
  });
  for (const auto& each : done) EXPECT_TRUE(each);
}

TEST(Threads, HandOnWhatTheFirstPartThrows) {
  const Threads threads(3);
  for (int loop = 0; loop < 50; ++loop) {
    std::atomic<int> calls = 0;
    try {
      threads.for_each(20, [&](int part) {
        ++calls;
        if (part == 7 || part == 13) throw std::runtime_error(std::to_string(part));
      });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
    EXPECT_EQ(calls, 20);
  }
}

TEST(Threads, SumVectorsToTheSameBits) {
  const Vertices a = random_vertices(20'000, 1), b = random_vertices(20'000, 2);
  const double product = dot(one_thread(), a, b);
  EXPECT_NEAR(product, a.cwiseProduct(b).sum(), 1e-9);
  for (const int count : counts) {
    const Threads threads(count);
    EXPECT_EQ(dot(threads, a, b), product);
    EXPECT_EQ(norm(threads, a), norm(one_thread(), a));
    Vertices sums(a.rows(), 3);
    sum(threads, a, 0.3, b, sums);
    EXPECT_TRUE(same_bits(sums, Vertices(a + 0.3 * b))) << count << " threads";
  }
}

/// One pass of each kind over a cloth's springs.
struct SpringPasses {
  Vertices gradient, moved, velocities, product;
  Eigen::Matrix<double, Eigen::Dynamic, 6> diagonal;
  double value, energy;

  SpringPasses(const Cloth& cloth, const Threads& threads) {
    const SpringNetwork springs(cloth.springs, cloth.vertex_count(), threads);
    const Eigen::Index n = cloth.vertex_count();
    const Vertices x = cloth.positions + 0.002 * random_vertices(n, 1), y = x + 0.001 * random_vertices(n, 2);
    const Eigen::VectorXd inertia = Eigen::VectorXd::Constant(n, 3.0), factor = Eigen::VectorXd::Constant(n, -0.01);
    gradient.resize(n, 3);
    value = springs.evaluate(inertia, y, x, gradient);
    product = random_vertices(n, 3);
    energy = springs.add_value_gradient(x, product);
    SpringNetwork::Blocks blocks;
    springs.compute_blocks(x, 0, blocks);
    springs.add_product(blocks, y, product);
    diagonal.setZero(n, 6);
    springs.add_diagonal(blocks, diagonal);
    moved = x;
    velocities = random_vertices(n, 4);
    for (int step = 0; step < 3; ++step)
      springs.kick_and_drift(factor, y, {.h = 0.01, .before = 0.9, .after = 0.8}, velocities, moved);
  }
};

/// Takes steps of a large cloth one by one.
void step_alone(const SpringNetwork& springs, int count, const Drift& drift_by, const Drift& between, Vertices& v,
                Vertices& x) {
  const Vertices force = random_vertices(x.rows(), 3);
  const Eigen::VectorXd factor = Eigen::VectorXd::Constant(x.rows(), -0.001);
  for (int step = 0; step < count; ++step) {
    if (step > 0 && between.h != 0) drift(one_thread(), between, v, x);
    springs.kick_and_drift(factor, force, drift_by, v, x);
  }
}

TEST(Threads, TakeSeveralStepsAtOnceWithTheBitsOfSingleSteps) {
  const Cloth cloth = cloth_of(make_grid(250, 240), 1, 180, {0, 250});
  const Eigen::Index n = cloth.vertex_count();
  const Drift move{.h = 0.01, .before = 0.9, .after = 0.8};
  for (const Drift& between : {Drift{.h = 0}, Drift{.h = 0.02, .before = 0.7}}) {
    for (const int count : {1, 2, 5, 8}) {
      Vertices x = cloth.positions + 0.002 * random_vertices(n, 1), v = random_vertices(n, 2);
      const Vertices start_x = x, start_v = v;
      step_alone(SpringNetwork(cloth.springs, cloth.vertex_count()), count, move, between, v, x);
      for (const int threads_count : {1, 2, 3, 8, 50}) {
        const Threads threads(threads_count);
        const SpringNetwork springs(cloth.springs, cloth.vertex_count(), threads);
        ASSERT_GE(springs.most_steps(), count);
        Vertices together_x = start_x, together_v = start_v;
        const double squares = springs.kick_and_drift_times(
            count, Eigen::VectorXd::Constant(n, -0.001), random_vertices(n, 3), move, between, together_v, together_x);
        EXPECT_TRUE(same_bits(together_x, x)) << count << " steps, " << threads_count << " threads";
        EXPECT_TRUE(same_bits(together_v, v)) << count << " steps, " << threads_count << " threads";
        EXPECT_NEAR(squares, x.squaredNorm(), 1e-10 * squares);
      }
    }
  }
}

void expect_the_same_bits(const Cloth& cloth) {
  const SpringPasses alone(cloth, one_thread());
  for (const int count : {2, 3, 8, 50}) {
    const Threads threads(count);
    const SpringPasses together(cloth, threads);
    EXPECT_EQ(together.value, alone.value);
    EXPECT_EQ(together.energy, alone.energy);
    EXPECT_TRUE(same_bits(together.gradient, alone.gradient)) << count << " threads";
    EXPECT_TRUE(same_bits(together.product, alone.product)) << count << " threads";
    EXPECT_EQ(together.diagonal, alone.diagonal) << count << " threads";
    EXPECT_TRUE(same_bits(together.moved, alone.moved)) << count << " threads";
    EXPECT_TRUE(same_bits(together.velocities, alone.velocities)) << count << " threads";
  }
}

TEST(Threads, ComputeSpringsToTheSameBits) {
  Cloth cloth = large_cloth();
  // Adds springs outside all bands, and more parts than a band's offset leaves whole.
  cloth.springs.push_back({.i = 5, .j = cloth.vertex_count() - 7, .rest_length = 1, .stiffness = 10});
  expect_the_same_bits(cloth);
}

TEST(Threads, ComputeIrregularSpringsToTheSameBits) {
  Cloth cloth = shuffled_cloth();
  EXPECT_EQ(SpringNetwork(cloth.springs, cloth.vertex_count()).gathered(), cloth.springs.size());
  cloth.springs.push_back(cloth.springs.front());
  expect_the_same_bits(cloth);
}

TEST(Threads, SolveToTheSameBits) {
  const Cloth cloth = large_cloth();
  const Vertices b = random_vertices(cloth.vertex_count(), 1);
  for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
    const auto solution = [&](const Threads& threads) {
      const System system(cloth, 0.02, threads);
      ConstantFactor factor(system, system.step, precision);
      EXPECT_GT(factor.parts(), 8);
      Vertices x = b, y = b;
      factor.solve(b, x);
      EXPECT_NEAR(factor.subtract_solution(b, y), x.norm(), 1e-9 * x.norm());
      EXPECT_TRUE(same_bits(y, Vertices(b - x)));
      return x;
    };
    expect_what_one_thread_computes(solution);
  }
}

// A cloth so large that a step is also solved in patches.
TEST(Threads, SettlePatchesToTheSameBits) {
  SimulationSettings settings = setup(cloth_of(make_grid(142, 142), 1, 180, {0, 142}), Method::quasi_newton, 0.02);
  settings.integrator.stop = StoppingRule::error;
  settings.effects = {Gravity{}};
  const auto run = [&](int count) {
    settings.threads = count;
    Simulation simulation(settings);
    simulation.step();
    return simulation.state();
  };
  EXPECT_TRUE(same_bits(run(3).x, run(1).x));
}

/// Returns the state of a cloth thrown at a sphere after a few steps.
State thrown(Cloth cloth, const NamedMethod& method, int count) {
  SimulationSettings settings = setup(std::move(cloth), method, 0.0005);
  settings.cloth.velocities.rowwise() = Eigen::RowVector3d(0.5, 0, -6);
  settings.effects = {Gravity{}, homework_sphere(), homework_damping()};
  settings.threads = count;
  if (!is_explicit(settings.integrator.method)) {
    Simulation simulation(settings);
    for (int step = 0; step < 3; ++step) simulation.step();
    return simulation.state();
  }
  // Skips the search for the safe step, which would take most of the time here.
  const Threads threads(count);
  const System system = make_system(settings, nullptr, {}, threads);
  State state{.x = settings.cloth.positions, .v = settings.cloth.velocities, .step = 0};
  StepForces forces(system, state);
  const auto scheme = method_type(settings.integrator.method).make(settings.integrator, system);
  for (; state.step < 3; ++state.step) scheme->advance(state, forces);
  return state;
}

void expect_the_same_motion(const Cloth& cloth, const NamedMethod& method) {
  const State alone = thrown(cloth, method, 1);
  for (const int count : counts) {
    const State together = thrown(cloth, method, count);
    EXPECT_TRUE(same_bits(together.x, alone.x)) << count << " threads";
    EXPECT_TRUE(same_bits(together.v, alone.v)) << count << " threads";
  }
}

class ThreadsOfASimulation : public testing::TestWithParam<NamedMethod> {};
INSTANTIATE_TEST_SUITE_P(Of, ThreadsOfASimulation,
                         testing::Values(all_methods[0], all_methods[1], all_methods[3], all_methods[4], all_methods[5],
                                         all_methods[8]),
                         method_name);

TEST_P(ThreadsOfASimulation, GiveTheSameBits) { expect_the_same_motion(large_cloth(), GetParam()); }

TEST(Threads, OfGustyAirGiveTheSameBits) {
  for (const Cloth& cloth : {large_cloth(), shuffled_cloth()}) {
    const State state{.x = cloth.positions + 0.002 * random_vertices(cloth.vertex_count(), 1),
                      .v = random_vertices(cloth.vertex_count(), 2),
                      .step = 0};
    const auto force = [&](const Threads& threads) {
      System system(cloth, 0.01, threads);
      Air{.velocity = {3, 1, 0}, .gusts = {.speed = 2}}.install(system);
      Vertices sum = random_vertices(cloth.vertex_count(), 3);
      system.forces.front()->add(state, 0.3, sum);
      return sum;
    };
    expect_what_one_thread_computes(force);
  }
}

// With background priority, threads may be dropped at any unpredictable time.
TEST(Threads, ThatSpareOthersGiveTheSameBits) {
  const Vertices a = random_vertices(20'000, 1), b = random_vertices(20'000, 2);
  const double product = dot(one_thread(), a, b);
  const Threads threads(8, true);
  for (int loop = 0; loop < 300; ++loop) ASSERT_EQ(dot(threads, a, b), product);
}

TEST(Threads, OfNewtonOnAnIrregularMeshGiveTheSameBits) { expect_the_same_motion(shuffled_cloth(), all_methods[1]); }

}  // namespace
}  // namespace drape::test
