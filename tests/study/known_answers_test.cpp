#include "study/known_answers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "study/elastica.hpp"
#include "study/validation_case.hpp"

namespace drape {
namespace {

// Romero et al. 2021, "Physical validation of simulators in computer graphics", cantilever: drop and reach.
TEST(HeavyElastica, HasThePublishedFigures) {
  const std::vector<std::array<double, 3>> published{
      {1, 0.1235, 0.9912}, {2, 0.2385, 0.9669}, {10, 0.7002, 0.6563}, {20, 0.8299, 0.4452}, {100, 0.9375, 0.1592}};
  for (const auto& [gamma, drop, reach] : published) {
    EXPECT_NEAR(heavy_elastica(gamma).drop, drop, 6e-5) << gamma;
    EXPECT_NEAR(heavy_elastica(gamma).reach, reach, 6e-5) << gamma;
  }
}

TEST(HeavyElastica, SinksAsABeamWhileItIsAlmostLevel) {
  constexpr double gamma = 1e-4;
  EXPECT_NEAR(heavy_elastica(gamma).drop, gamma / 8, 1e-11);
  EXPECT_NEAR(heavy_elastica(gamma).reach, 1, 1e-9);
}

TEST(KnownAnswers, BesselZerosAreThoseOfTables) {
  EXPECT_NEAR(bessel_zero(1), 2.404825557695773, 1e-13);
  EXPECT_NEAR(bessel_zero(2), 5.520078110286311, 1e-13);
  EXPECT_NEAR(bessel_zero(4), 11.791534439014281, 1e-13);
}

TEST(KnownAnswers, CatenaryAndPendulumHaveTheirLimits) {
  EXPECT_NEAR(catenary_sag(1.2), 0.72556, 1e-5);
  EXPECT_NEAR(catenary_sag(1e-6), 1, 1e-4);                   // folded
  EXPECT_NEAR(pendulum_period(90), 1.18034059901609, 1e-12);  // 2 K(½)/π
  EXPECT_NEAR(pendulum_period(1), 1 + std::pow(M_PI / 180, 2) / 16, 1e-9);
}

TEST(KnownAnswers, ACapstanHoldsEulersRatioWhereItsStrapIsLight) {
  EXPECT_NEAR(capstan_limit(0.3, 1, 1e-9) / std::exp(0.3 * M_PI), 1, 1e-8);
  EXPECT_NEAR(capstan_limit(0, 0.7, 0.2), 0.7, 1e-12);
  const ValidationCase of = validation_cases({"capstan"}).front();
  for (const ValidationProblem& problem : of.problems) {
    const double limit =
        capstan_limit(problem.given.at("friction"), problem.given.at("light"), problem.given.at("radius"));
    EXPECT_NEAR(problem.answers.front().x, problem.given.at("heavy") / limit, 1e-9) << problem.name;
  }
}

std::vector<std::string> all_case_names() {
  std::vector<std::string> names;
  for (const ValidationCase& one : validation_cases()) names.push_back(one.name);
  return names;
}

class EveryCase : public testing::TestWithParam<std::string> {
 protected:
  const ValidationCase case_ = validation_cases({GetParam()}).front();
};
INSTANTIATE_TEST_SUITE_P(, EveryCase, testing::ValuesIn(all_case_names()), [](const auto& tested) {
  std::string name = tested.param;
  std::erase(name, '-');
  return name;
});

// The values in case.json come from other programs: SciPy's integrator, root finders and elliptic integrals.
TEST_P(EveryCase, SaysWhatTheoryDoes) {
  int compared = 0;
  for (const ValidationProblem& problem : case_.problems) {
    for (const KnownAnswer& answer : problem.answers) {
      const KnownCurve curve = known_curve(case_.name, answer.curve);
      ASSERT_NE(curve.value, nullptr) << answer.curve;
      EXPECT_NEAR(curve.value(answer.x), answer.value, 1e-9 * std::max(1.0, std::abs(answer.value))) << problem.name;
      ++compared;
    }
  }
  EXPECT_GT(compared, 0);
}

TEST_P(EveryCase, NamesItsSourceAndItsProblemsOnce) {
  std::set<std::string> names;
  for (const ValidationProblem& problem : case_.problems) EXPECT_TRUE(names.insert(problem.name).second);
  EXPECT_GT(case_.source.size(), 20U);
  EXPECT_GT(case_.theory.size(), 20U);
  EXPECT_FALSE(case_.default_overrides.empty());
}

}  // namespace
}  // namespace drape
