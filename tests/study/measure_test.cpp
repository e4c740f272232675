#include "study/measure.hpp"
#include "drape/scene/scene.hpp"

#include <gtest/gtest.h>

#include "study/homework.hpp"

namespace drape {
namespace {

TEST(Measure, RunsEveryStepOfEveryCaseAsOftenAsAsked) {
  const std::vector<StudyCase> cases{{"a", "scenes/homework/3.toml", {}, 31}, {"b", "scenes/homework/1.toml", {}, 100}};
  Progress progress;
  const std::vector<Measured> measured = measure(cases, 2, {}, progress);
  ASSERT_EQ(measured.size(), 2U);
  EXPECT_EQ(measured[0].iterations.size(), 31U);
  EXPECT_EQ(measured[1].height.size(), 100U);
  EXPECT_EQ(measured[0].microseconds.size(), 2U);
  EXPECT_EQ(progress.done, progress.total);
  // The unsupported part falls freely: the damped cloth is a little above −g t²/2.
  const double time = 0.1;
  EXPECT_LT(measured[1].height.back(), -0.4 * 9.8 * time * time);
  EXPECT_GT(measured[1].height.back(), -0.51 * 9.8 * time * time);
}

TEST(Measure, RunsEachCaseUntilItsMedianIsKnownAndNoMoreThanThirtyTimes) {
  Progress progress;
  const std::vector<Measured> measured = measure({{"a", "scenes/homework/3.toml", {}, 5}}, {}, {}, progress);
  const std::vector<double>& all = measured.front().microseconds;
  EXPECT_GE(all.size(), fewest_for_interval);
  EXPECT_LE(all.size(), 30U);
  EXPECT_TRUE(all.size() == 30 || measured.front().time().narrow());
  EXPECT_FALSE(is_enough({all.begin(), all.end() - 1}, {}));  // it was not enough before the last run
}

TEST(Measure, GivesUpACaseThatDivergesOrTakesTooLongIfItMayFail) {
  const std::vector<std::string> unstable{"integrator={method=\"semi-implicit\",allow_unstable=true}", "time.step=0.1"};
  StudyCase diverges{"a", "scenes/homework/3.toml", unstable, 50}, slow{"b", "scenes/homework/3.toml", {}, 50};
  Progress progress;
  EXPECT_THROW(measure({diverges}, 1, {}, progress), DivergedError);
  diverges.patience = 60;
  slow.patience = 1e-9;
  const std::vector<Measured> measured =
      measure({diverges, slow, {"c", "scenes/homework/3.toml", {}, 5}}, 1, {}, progress);
  EXPECT_NE(measured[0].failure.find("diverged"), std::string::npos) << measured[0].failure;
  EXPECT_NE(measured[1].failure.find("more than"), std::string::npos) << measured[1].failure;
  EXPECT_TRUE(measured[1].microseconds.empty());
  EXPECT_EQ(measured[1].iterations.size(), 1U);
  EXPECT_TRUE(measured[2].failure.empty());
  EXPECT_EQ(measured[2].microseconds.size(), 1U);
}

TEST(Measure, ReturnsNothingWhenItIsStopped) {
  std::stop_source stop;
  stop.request_stop();
  Progress progress;
  EXPECT_TRUE(measure({{"a", "scenes/homework/3.toml", {}, 31}}, 1, stop.get_token(), progress).empty());
}

// The tables' headings, in the report's words, compared with the cases' scenes and overrides.
TEST(HomeworkCases, AreThoseOfTheReport) {
  for (const HomeworkRow& row : homework_rows()) {
    SCOPED_TRACE(row.study_case.command());
    const SimulationSettings s = row.study_case.load().simulation;
    const bool semi = row.method == "semi-implicit";
    EXPECT_EQ(method_name(s.integrator.method), row.method);
    EXPECT_EQ(s.step, row.step);
    EXPECT_EQ(s.cloth.vertex_count(), 441);
    EXPECT_EQ(s.cloth.springs.front().stiffness, row.table == 1 ? 18 : 180);
    std::vector<std::string> effects;
    for (const Effect& effect : s.effects) effects.emplace_back(effect.name());
    const auto has = [&](const char* name) { return std::count(effects.begin(), effects.end(), name) == 1; };
    EXPECT_TRUE(has("gravity"));
    EXPECT_EQ(has("sphere"), row.table == 2);
    EXPECT_EQ(has("damping"), semi);
    const std::int64_t whole = semi ? 8334 : 417;
    EXPECT_EQ(row.study_case.steps, row.table == 2 && row.method == "implicit" ? 167 : whole);
    if (semi) continue;
    EXPECT_EQ(s.integrator.tolerance, std::stod(row.tolerance));
    EXPECT_EQ(s.integrator.max_iterations, row.method == "liu13" ? 100 : 20);
  }
  EXPECT_EQ(homework_rows().size(), 18U);
}

/// Makes invented results, one per row, without swings, flips or differences between the cases.
std::vector<Measured> dull_results(const std::vector<StudyCase>& cases) {
  std::vector<Measured> results;
  for (const StudyCase& one : cases) {
    Measured m;
    m.study_case = one;
    m.step = one.load().simulation.step;
    m.iterations.assign(static_cast<std::size_t>(one.steps), 3);
    for (std::int64_t i = 0; i < one.steps; ++i) m.height.push_back(-static_cast<double>(i) * m.step);
    m.microseconds = {10, 10, 10};
    results.push_back(std::move(m));
  }
  return results;
}

TEST(Conclusions, AreNotConfirmedByResultsThatDoNotShowThem) {
  const std::vector<HomeworkRow> rows = homework_rows();
  std::vector<StudyCase> cases;
  for (const HomeworkRow& row : rows) cases.push_back(row.study_case);
  std::vector<Measured> tables = dull_results(cases);
  const std::vector<Measured> extras = dull_results(homework_extras());
  std::vector<bool> confirmed;
  for (const Conclusion& c : judge_conclusions(rows, tables, extras)) confirmed.push_back(c.confirmed);
  // Without flips the implicit method looks right, and equal motions are judged equal.
  EXPECT_EQ(confirmed, (std::vector<bool>{true, false, false, false, false, true, true}));

  tables[find_row(rows, 3, "implicit", "1")].flipped_pairs = 4;
  for (double& height : tables[find_row(rows, 1, "implicit")].height) height *= 2;
  for (double& height : tables[find_row(rows, 1, "semi-implicit")].height) height *= 1.1;
  confirmed.clear();
  for (const Conclusion& c : judge_conclusions(rows, tables, extras)) confirmed.push_back(c.confirmed);
  EXPECT_EQ(confirmed, (std::vector<bool>{false, false, false, false, false, false, false}));
}

}  // namespace
}  // namespace drape
