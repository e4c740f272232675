// drape's references in time compared with an independent integrator: CVODE of SUNDIALS (Hindmarsh et al. 2005), Adams
// formulas of variable order, to 1e-12.

#include <gtest/gtest.h>

#include "drape/scene/scene.hpp"
#include "drape/sim/effects/acceleration.hpp"
#include "study/reference.hpp"

#ifdef DRAPE_HAS_CVODE
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#endif

namespace drape {
namespace {

constexpr double gravity = 9.8;     // [m/s²]
constexpr double agreement = 1e-8;  // [m]

#ifdef DRAPE_HAS_CVODE

/// Computes springs and gravity, written independently.
void accelerate(const Cloth& cloth, const double* places, double* accelerations) {
  const auto n = cloth.positions.rows();
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Eigen::Map<const Rows> x(places, n, 3);
  Eigen::Map<Rows> a(accelerations, n, 3);
  a.setZero();
  for (const Spring& spring : cloth.springs) {
    const Eigen::RowVector3d way = x.row(spring.j) - x.row(spring.i);
    const Eigen::RowVector3d pull = spring.stiffness * (1 - spring.rest_length / way.norm()) * way;
    a.row(spring.i) += pull;
    a.row(spring.j) -= pull;
  }
  a.array().colwise() /= cloth.masses.array();
  a.col(2).array() -= gravity;
  for (const int pin : cloth.pins) a.row(pin).setZero();
}

int derivative(realtype, N_Vector y, N_Vector slope, void* data) {
  const Cloth& cloth = *static_cast<const Cloth*>(data);
  const auto n = 3 * cloth.positions.rows();
  const double* const from = N_VGetArrayPointer(y);
  double* const to = N_VGetArrayPointer(slope);
  std::copy(from + n, from + 2 * n, to);
  accelerate(cloth, from, to + n);
  return 0;
}

/// Returns the positions of a cloth after some seconds.
Vertices integrate(Cloth cloth, double seconds) {
  const auto n = cloth.positions.rows();
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  N_Vector y = N_VNew_Serial(6 * n, context);
  double* const values = N_VGetArrayPointer(y);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) {
      values[3 * i + k] = cloth.positions(i, k);
      values[3 * n + 3 * i + k] = cloth.velocities(i, k);
    }
  }
  void* const solver = CVodeCreate(CV_ADAMS, context);
  CVodeInit(solver, derivative, 0, y);
  CVodeSStolerances(solver, 1e-12, 1e-13);
  CVodeSetUserData(solver, &cloth);
  CVodeSetMaxNumSteps(solver, 10'000'000);
  SUNNonlinearSolver iteration = SUNNonlinSol_FixedPoint(y, 0, context);
  CVodeSetNonlinearSolver(solver, iteration);
  CVodeSetStopTime(solver, seconds);
  double reached = 0;
  EXPECT_GE(CVode(solver, seconds, y, &reached, CV_NORMAL), 0);
  EXPECT_DOUBLE_EQ(reached, seconds);
  Vertices x(n, 3);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) x(i, k) = values[3 * i + k];
  }
  SUNNonlinSolFree(iteration);
  void* freed = solver;
  CVodeFree(&freed);
  N_VDestroy(y);
  SUNContext_Free(&context);
  return x;
}

/// Returns the distance of drape's reference from CVODE's after `steps` steps of the settings.
double apart(const SimulationSettings& settings, std::int64_t steps) {
  Progress progress;
  const auto reference = extrapolate_steps(settings, {steps}, 64, 1e-9, {}, progress);
  EXPECT_TRUE(reference);
  const Vertices x = integrate(settings.cloth, static_cast<double>(steps) * settings.step);
  EXPECT_GT((x - settings.cloth.positions).cwiseAbs().maxCoeff(), 0.1) << "nothing moved";
  return distance(x, reference->x.front()).max;
}

TEST(Cvode, AgreesWithTheReferenceOfTheHomeworksCloth) {
  const Scene scene = load_scene(data_folder() / "scenes/homework/3.toml");
  EXPECT_LT(apart(scene.simulation, 21), agreement);  // 0.42 s
}

TEST(Cvode, AgreesWithTheReferenceOfAHangingChain) {
  constexpr int links = 20;
  SimulationSettings settings;
  settings.step = 0.02;
  settings.effects = {Gravity{}};
  Cloth& chain = settings.cloth;
  chain.positions = chain.velocities = chain.rest = Vertices::Zero(links + 1, 3);
  chain.masses.setConstant(links + 1, 0.01);
  for (int i = 0; i <= links; ++i) chain.rest.row(i) << 0.05 * i, 0, 0;
  chain.positions = chain.rest;  // level: it swings down
  for (int i = 0; i < links; ++i) {
    chain.springs.push_back({.i = i, .j = i + 1, .rest_length = 0.05, .stiffness = 500});
  }
  chain.pins = {0};
  EXPECT_LT(apart(settings, 21), agreement);
}

#else

TEST(Cvode, AgreesWithDrapesReferences) {
  GTEST_SKIP() << "built without SUNDIALS: libsundials-dev (" << gravity << ", " << agreement << ")";
}

#endif

}  // namespace
}  // namespace drape
