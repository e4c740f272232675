#include "study/validation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "scene/scene.hpp"
#include "study/validation_answers.hpp"
#include "study/validation_measures.hpp"
#include "study/validation_report.hpp"
#include "study/validation_runs.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape {
namespace {

template <class Call>
void expect_usage_error(Call&& call, const std::string& message) {
  const std::string found = test::usage_error(std::forward<Call>(call));
  EXPECT_NE(found.find(message), std::string::npos) << found;
}

std::vector<std::string> names_of_cases() {
  std::vector<std::string> names;
  for (const ValidationCase& one : validation_cases()) {
    if (!one.quick.empty()) names.push_back(one.name);
  }
  return names;
}

ValidationStudy measured(const ValidationOptions& options) {
  ValidationStudy study = plan_validation(options);
  Progress progress;
  EXPECT_TRUE(measure_validation(study, options, {}, progress, [] {}));
  return study;
}

class QuickValidation : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(, QuickValidation, testing::ValuesIn(names_of_cases()), [](const auto& tested) {
  std::string name = tested.param;
  std::erase(name, '-');
  return name;
});

TEST_P(QuickValidation, IsMet) {
  const ValidationStudy study = measured({.cases = {GetParam()}, .quick = true, .patience = 1000});
  const ValidationVerdict verdict = verdict_of(study, study.cases.front(), scene_factor);
  EXPECT_TRUE(verdict.met) << verdict.worst_problem << " " << verdict.worst_answer << ": " << verdict.worst
                           << " of what is allowed; " << study.runs.front().failure;
  EXPECT_GT(verdict.answers, 0);
}

TEST(Validation, AWrongProblemIsNotMet) {
  ValidationStudy study = plan_validation({.cases = {"catenary"}, .quick = true});
  study.runs.front().what.overrides.emplace_back("cloth.mesh={grid=[8,1],pattern=\"alternating\",size=[2,0.05]}");
  Progress progress;
  ASSERT_TRUE(measure_validation(study, {}, {}, progress, [] {}));
  EXPECT_FALSE(all_met(study));
  EXPECT_NE(validation_report(study).headline.find("0 of 1"), std::string::npos);
}

TEST(Validation, HasFewerThan400RunsAndDefaultsWithoutAKeyAboutHow) {
  const ValidationStudy study = plan_validation({});
  EXPECT_LE(study.runs.size(), 400U);
  EXPECT_GE(study.cases.size(), 12U);
  const IntegratorSettings otherwise;
  for (const ValidationRun& run : study.runs) {
    if (run.factor != default_factor) continue;
    const SimulationSettings settings = run.what.load().simulation;
    EXPECT_EQ(settings.step, SimulationSettings{}.step) << run.name;
    EXPECT_FALSE(settings.accuracy) << run.name;
    EXPECT_EQ(settings.integrator.method, otherwise.method) << run.name;
    EXPECT_FALSE(settings.integrator.tolerance || settings.integrator.stop) << run.name;
  }
}

TEST(Validation, AMethodAloneIsVaried) {
  const ValidationStudy study = plan_validation({.cases = {"pendulum"}, .methods = {"semi-implicit"}});
  int varied = 0;
  for (const ValidationRun& run : study.runs) {
    if (run.factor != "method") continue;
    EXPECT_EQ(run.setting, "semi-implicit");
    ++varied;
  }
  EXPECT_EQ(varied, 1);
  expect_usage_error([] { plan_validation({.methods = {"verlett"}}); }, "did you mean 'verlet'?");
  expect_usage_error([] { plan_validation({.cases = {"catenery"}}); }, "did you mean 'catenary'?");
}

class ValidationRuns : public test::InScratchFolder {};

TEST_F(ValidationRuns, GoOnWhereTheyEnded) {
  const ValidationOptions options{.cases = {"pattern-stiffness"}, .quick = true};
  ValidationStudy study = measured(options);
  study.command = "drape study validation pattern-stiffness --quick";
  study.runs.back().measured = false;
  put(path("runs.csv"), validation_runs(study));
  ValidationStudy again = plan_validation(options);
  again.command = study.command;
  read_validation_runs(path("runs.csv"), again);
  EXPECT_FALSE(again.runs.back().measured);
  again.runs.back().measured = study.runs.back().measured = true;
  again.runs.back().seconds = study.runs.back().seconds;
  again.runs.back().names = study.runs.back().names;
  again.runs.back().values = study.runs.back().values;
  again.runs.back().step = study.runs.back().step;
  again.runs.back().cell = study.runs.back().cell;
  again.runs.back().vertices = study.runs.back().vertices;
  again.runs.back().rest_speed = study.runs.back().rest_speed;
  EXPECT_EQ(validation_runs(again), validation_runs(study));
  again.command = "drape study validation";
  expect_usage_error([&] { read_validation_runs(path("runs.csv"), again); }, "is of another command");
}

TEST_F(ValidationRuns, OfCsvAnswersAreJudged) {
  const ValidationCase of = validation_cases({"heavy-cantilever"}).front();
  put(path("a.csv"), "problem,quantity,value\ngamma-10,drop,0.7012\ngamma-10,reach,0.66\r\n");
  const std::vector<GivenAnswer> given = read_answers(of, path("a.csv"), "");
  ASSERT_EQ(given.size(), 2U);
  EXPECT_TRUE(given[0].met());
  EXPECT_FALSE(given[1].met());
  const auto expect_error = [&](const std::string& text, const std::string& message) {
    put(path("b.csv"), text);
    expect_usage_error([&] { read_answers(of, path("b.csv"), ""); }, message);
  };
  expect_error("", "there is no answer in it");
  expect_error("gamma-10,drop,0.7\n", "b.csv:1: expected the line problem,quantity,value");
  expect_error("problem,quantity,value\ngama-10,drop,0.7\n", "b.csv:2: heavy-cantilever has no problem 'gama-10'; did");
  expect_error("problem,quantity,value\ngamma-10,drip,0.7\n",
               "b.csv:2: problem 'gamma-10' has no quantity 'drip'; did");
  expect_error("problem,quantity,value\ngamma-10,drop,0.7m\n", "b.csv:2: expected a number, found '0.7m'");
  put(path("c.csv"), "problem,quantity,value\ngamma-10,drop,nan\n");
  EXPECT_FALSE(read_answers(of, path("c.csv"), "").front().met());
}

TEST(Measures, ComputeWhatPositionsSay) {
  // A pendulum of 1 m that swings as cos 3t.
  ObservedMotion motion;
  motion.cloth.rest.resize(2, 3);
  motion.cloth.rest << 0, 0.5, 0, 0, -0.5, 0;
  motion.cloth.pins = {0};
  for (int i = 0; i <= 2000; ++i) {
    const double time = 1e-3 * i, angle = 0.1 * std::cos(3 * time);
    Vertices x(2, 3);
    x << 0, 0, 0, 0, std::sin(angle), -std::cos(angle);
    motion.times.push_back(time);
    motion.positions.push_back(x);
  }
  const double measured = measure_motion("pendulum", motion, {{"g", 9.0}}).at("period");
  EXPECT_NEAR(measured, 1, 1e-6);
  expect_usage_error([&] { measure_motion("pendulum", motion, {}); }, "the case gives no number 'g'");
  expect_usage_error([&] { measure_motion("pendulun", motion, {}); }, "did you mean 'pendulum'?");
}

}  // namespace
}  // namespace drape
