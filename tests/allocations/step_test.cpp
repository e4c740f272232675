// Heap allocations of a step: our code makes none, for every method and effect.

#include <gtest/gtest.h>

#include <SuiteSparse_config.h>

#include <atomic>
#include <cstdlib>

#include "drape/sim/effects/acceleration.hpp"
#include "drape/sim/effects/air.hpp"
#include "drape/sim/effects/bending.hpp"
#include "drape/sim/effects/body.hpp"
#include "drape/sim/effects/damping.hpp"
#include "drape/sim/effects/ground.hpp"
#include "drape/sim/effects/moving_pins.hpp"
#include "drape/sim/effects/pressure.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "drape/sim/effects/strain_limit.hpp"
#include "drape/sim/simulation.hpp"
#include "sim/system.hpp"
#include "tests/support/closed_meshes.hpp"
#include "tests/support/setups.hpp"

// The C library's functions under the names that everyone calls, including Eigen and CHOLMOD. A sanitizer replaces
// them, so nothing can be counted then.
#ifdef DRAPE_SANITIZED
constexpr bool counted = false;
static std::atomic<long> allocations = 0;
#else
constexpr bool counted = true;
static std::atomic<long> allocations = 0;
extern "C" {
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
void* malloc(std::size_t size) noexcept { return ++allocations, __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) noexcept { return ++allocations, __libc_calloc(count, size); }
void* realloc(void* old, std::size_t size) noexcept { return ++allocations, __libc_realloc(old, size); }
void* memalign(std::size_t to, std::size_t size) noexcept { return ++allocations, __libc_memalign(to, size); }
void* aligned_alloc(std::size_t to, std::size_t size) noexcept { return ++allocations, __libc_memalign(to, size); }
int posix_memalign(void** result, std::size_t to, std::size_t size) noexcept {
  ++allocations;
  *result = __libc_memalign(to, size);
  return *result == nullptr ? 12 : 0;
}
}
#endif

namespace drape::test {
namespace {

using Eigen::Vector3d;

/// Counts CHOLMOD's allocations through its replaceable functions.
long cholmod_allocations = 0;
void* cholmod_malloc(std::size_t size) { return ++cholmod_allocations, std::malloc(size); }
void* cholmod_calloc(std::size_t count, std::size_t size) { return ++cholmod_allocations, std::calloc(count, size); }
void* cholmod_realloc(void* old, std::size_t size) { return ++cholmod_allocations, std::realloc(old, size); }

class Allocations : public testing::TestWithParam<NamedMethod> {
 protected:
  Allocations() {
    if (!counted) return;
    SuiteSparse_config.malloc_func = cholmod_malloc;
    SuiteSparse_config.calloc_func = cholmod_calloc;
    SuiteSparse_config.realloc_func = cholmod_realloc;
  }
  void SetUp() override {
    if (!counted) GTEST_SKIP() << "a sanitizer has an allocator of its own";
  }

  /// Counts the allocations of one step, ours and CHOLMOD's, once all buffers have their final size.
  static std::pair<long, long> steady_step(Simulation& simulation) {
    // After the step that follows, semi-implicit Euler checks for a blow-up.
    for (int step = 1; step < 256; ++step) simulation.step();
    const long all = allocations, cholmod = cholmod_allocations;
    simulation.step();
    return {(allocations - all) - (cholmod_allocations - cholmod), cholmod_allocations - cholmod};
  }
};
INSTANTIATE_TEST_SUITE_P(Of, Allocations, testing::ValuesIn(all_methods), method_name);

SimulationSettings falling(Solver solver) {
  SimulationSettings settings = setup(cloth_of(make_grid(10, 10), 1, 100, {0, 10}), solver, 0.005);
  settings.effects = {Gravity{}};
  return settings;
}

/// Makes settings with every effect except contact, including a pushing sphere and moving pins.
SimulationSettings eventful(Solver solver) {
  SimulationSettings settings = falling(solver);
  settings.effects = {Gravity{},
                      Wind{.acceleration = {1, 0, 0}},
                      Air{.velocity = {1, 2, 0}, .gusts = {.speed = 1}},
                      Field{.acceleration = {"8*vy", "-8*vx", "-0.1*vz*vz"}},
                      Bending{.rigidity = 1e-4, .cross_stiffness = 1},
                      InternalDamping{.relaxation_time = 0.01},
                      MovingPins{.pins = {0, 10},
                                 .keyframes = {{1, {0, 0, 0.2}}, {2, {0.1, 0, 0}}},
                                 .interpolation = Interpolation::smooth,
                                 .turns = {{1, {0, 0, 30}}}},
                      Sphere{.center = Vector3d(0, 0, -0.3), .radius = 0.3},
                      StrainLimit{.max_stretch = 1.1},
                      Damping{.factor = 0.5}};
  return settings;
}

TEST_P(Allocations, ASteadyStepTakesNothing) {
  SimulationSettings settings = falling(GetParam());
  for (const bool at_an_error : {false, true}) {
    if (at_an_error) settings.integrator.tolerance.reset();
    Simulation simulation(settings);
    const auto [ours, cholmod] = steady_step(simulation);
    EXPECT_EQ(ours, 0) << at_an_error;
    EXPECT_EQ(cholmod, 0) << at_an_error;
  }
}

TEST_P(Allocations, AStepWithEveryEffectButContactTakesNothing) {
  Simulation simulation(eventful(GetParam()));
  const auto [ours, cholmod] = steady_step(simulation);
  EXPECT_EQ(ours, 0);
}

TEST_P(Allocations, AStepUnderPressureTakesNothing) {
  SimulationSettings settings = setup(cloth_of(ball(4, 0.5), 1, 100, {0}), GetParam(), 0.001);
  settings.effects = {Gravity{}, Pressure{.pressure = 10, .gas = Gas::ideal, .ambient = 100}};
  Simulation simulation(settings);
  const auto [ours, cholmod] = steady_step(simulation);
  EXPECT_EQ(ours, 0);
}

TEST_P(Allocations, AbsentEffectsTakeNothing) {
  // The system contains only what gravity installs.
  const SimulationSettings settings = falling(GetParam());
  const System system = make_system(settings);
  EXPECT_EQ(system.forces.size(), 1U);
  EXPECT_EQ(system.forces.capacity(), 1U);
  EXPECT_EQ(system.energies.capacity() + system.corrections.capacity() + system.filters.capacity() +
                system.colliders.capacity() + system.pin_motions.capacity() + system.pin_releases.capacity(),
            0U);
  // Making a system allocates the same for the same scene, independent of the number of registered effects.
  const auto made = [&] {
    const long before = allocations;
    const System another = make_system(settings);
    return allocations - before;
  };
  EXPECT_EQ(made(), 3) << "the springs' copy, the list of forces and gravity";
}

TEST(AllocationCounter, Counts) {
  if (!counted) GTEST_SKIP() << "a sanitizer has an allocator of its own";
  const long before = allocations;
  const Eigen::VectorXd eigen = Eigen::VectorXd::Zero(100);
  const std::vector<int> standard(100);
  EXPECT_GE(allocations - before, 2);
}

}  // namespace
}  // namespace drape::test
