#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "drape/scene/scene.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/simulation.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::test {
namespace {

SimulationSettings hanging(StepMethod how) {
  const Mesh square = make_grid(4, 4);
  return {.cloth = make_cloth(square, square, 1, 50, {0, 4}),
          .step = 0.002,
          .integrator = {.method = how.method, .scheme = how.scheme},
          .effects = {Gravity{}}};
}

TEST(StateHash, DiffersWithEveryBit) {
  const State state{.x = Vertices::Ones(5, 3), .v = Vertices::Zero(5, 3), .step = 7};
  EXPECT_EQ(hash_of(state), hash_of(State(state)));
  State other = state;
  other.x(4, 1) = std::nextafter(1.0, 2.0);
  EXPECT_NE(hash_of(other), hash_of(state));
  other = state;
  other.v(0, 2) = -0.0;
  EXPECT_NE(hash_of(other), hash_of(state)) << "to the bit";
  other = state;
  other.step = 8;
  EXPECT_NE(hash_of(other), hash_of(state));
  other = {.x = state.v, .v = state.x, .step = 7};
  EXPECT_NE(hash_of(other), hash_of(state));
}

TEST(SimulationSettings, ThatMakeNoSenseAreRefused) {
  const auto problem = [](const auto& change) {
    SimulationSettings settings = hanging(Method::liu13);
    change(settings);
    return usage_error([&] { const Simulation simulation(settings); });
  };
  using Settings = SimulationSettings;
  EXPECT_EQ(problem([](Settings& s) { s.step = -1; }), "the step must be above 0 s, found -1 s");
  EXPECT_EQ(problem([](Settings& s) { s.step = 0; }), "the step must be above 0 s, found 0 s");
  EXPECT_EQ(problem([](Settings& s) { s.step = NAN; }), "the step must be above 0 s, found nan s");
  EXPECT_EQ(problem([](Settings& s) { s.cloth.pins = {25}; }), "a pin has vertex 25, but the vertices are 0 to 24");
  EXPECT_EQ(problem([](Settings& s) { s.cloth.pins = {4, 0}; }), "the pins must be ascending, each once");
  EXPECT_EQ(problem([](Settings& s) { s.cloth.triangles[7][2] = -1; }),
            "a triangle has vertex -1, but the vertices are 0 to 24");
  EXPECT_EQ(problem([](Settings& s) { s.cloth.springs[7].j = 99; }),
            "a spring has vertex 99, but the vertices are 0 to 24");
  EXPECT_EQ(problem([](Settings& s) { s.cloth.masses.conservativeResize(24); }),
            "the cloth has 25 vertices and 24 masses");
}

TEST(MovedSimulation, GoesOnToTheSameBits) {
  for (const StepMethod how : step_methods) {
    SCOPED_TRACE(step_method_name(how));
    Simulation stays(hanging(how)), first(hanging(how));
    EXPECT_EQ(first.hash(), stays.hash());
    for (int i = 0; i < 10; ++i) stays.step();
    for (int i = 0; i < 5; ++i) first.step();
    EXPECT_NE(first.hash(), stays.hash());
    Simulation moved(std::move(first));
    for (int i = 0; i < 3; ++i) moved.step();
    Simulation other(hanging({Method::liu13}));
    other = std::move(moved);
    for (int i = 0; i < 2; ++i) other.step();
    EXPECT_EQ(other.hash(), stays.hash());
    EXPECT_EQ(other.energies().total(), stays.energies().total());
  }
}

}  // namespace
}  // namespace drape::test
